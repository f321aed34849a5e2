//! Samples of punctual lights among the lights, and whether light arrives.
use fearless_simd_macros::simd;

use super::{LightSample, Lights};
use crate::{
    geometry::{MISS, Nearest},
    light::{LightCoordinates, ReferencePoint},
};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

impl Lights {
    /// A direction towards a punctual light, as if there were no other lights. There must be one.
    #[simd]
    pub fn sample_punctual<L: Lanes>(&self, l: L, at: ReferencePoint<L>, u: LightCoordinates<L>) -> LightSample<L> {
        let (punctual_light, pmf) = self.selection_of_punctual.choose(l, &at, &u);
        // Where no light shines, none is chosen.
        let target = punctual_light.is(MISS).pick(punctual_light, punctual_light + self.count as u32);
        let sample = LightSample { wi: at.n, radiance: V::splat(l, [0.0; 3]), pdf: l.f(0.0), target };
        let sample = self.with_punctual(l, at.p, sample);
        LightSample { pdf: sample.pdf * pmf, ..sample }
    }

    /// Completes the samples whose target is a punctual light, up to the probability of choosing it. A call, with the sample by
    /// value; otherwise it would be kept in memory even for scenes without lights.
    #[simd]
    pub(super) fn with_punctual<L: Lanes>(&self, l: L, p: V<L>, sample: LightSample<L>) -> LightSample<L> {
        let LightSample { wi, radiance, pdf, target } = sample;
        let punctual_lights = self.are_punctual(target);
        if !punctual_lights.any() {
            return sample;
        }
        let of_punctual = self.punctual_lights.sample(l, self.punctual_light(l, punctual_lights, target), p);
        LightSample {
            wi: punctual_lights.pick(of_punctual.wi, wi),
            radiance: punctual_lights.pick(of_punctual.irradiance, radiance),
            pdf: punctual_lights.pick(l.f(1.0), pdf),
            target,
        }
    }

    /// Lanes whose light is a punctual light: no other strategy could have sampled the direction towards it.
    #[inline(always)]
    pub fn are_punctual<L: Lanes>(&self, light: U<L>) -> M<L> {
        let first = self.count as u32;
        light.below(first + self.punctual_lights.len() as u32) & !light.below(first)
    }

    /// Distances of the lights among `lights` in the lanes of `lights` from the points `p`.
    #[inline(always)]
    pub fn distance_of_punctual<L: Lanes>(&self, l: L, punctual_lights: M<L>, lights: U<L>, p: V<L>) -> F<L> {
        self.punctual_lights.distance(l, self.punctual_light(l, punctual_lights, lights), p)
    }

    /// The numbers of the lights of `lights` in the lanes of `lights`, and the first light in the others.
    #[inline(always)]
    pub(super) fn punctual_light<L: Lanes>(&self, l: L, punctual_lights: M<L>, lights: U<L>) -> U<L> {
        punctual_lights.pick(lights + (self.count as u32).wrapping_neg(), l.u(0))
    }

    /// The punctual light of this light, by its place among all lights.
    pub fn punctual_at(&self, light: u32) -> Option<usize> {
        let punctual_light = (light as usize).checked_sub(self.count)?;
        (punctual_light < self.punctual_lights.len()).then_some(punctual_light)
    }

    /// Whether the light `target` arrives at `o` from the direction in which `nearest` is the first hit: it is the target, or the
    /// target is a punctual light that is not farther away. The ray then ends at the light.
    #[inline(always)]
    pub fn arrives<L: Lanes>(&self, l: L, target: U<L>, o: V<L>, nearest: Nearest<L>) -> (M<L>, Nearest<L>) {
        let hit = self.light_at(l, nearest.primitive, nearest.element).equals(target);
        if self.punctual_lights.is_empty() {
            return (hit, nearest);
        }
        self.arrives_from_punctual(l, target, o, nearest, hit)
    }

    /// A call by value, for the same reason as [`Lights::with_lamps`].
    #[simd]
    fn arrives_from_punctual<L: Lanes>(&self, l: L, target: U<L>, o: V<L>, nearest: Nearest<L>, hit: M<L>) -> (M<L>, Nearest<L>) {
        let punctual_lights = self.are_punctual(target);
        let distance = self.punctual_lights.distance(l, self.punctual_light(l, punctual_lights, target), o);
        let free = punctual_lights & nearest.t.ge(distance);
        let end = Nearest {
            t: free.pick(distance, nearest.t),
            primitive: free.pick(l.u(MISS), nearest.primitive),
            element: nearest.element,
        };
        (free | hit, end)
    }
}
