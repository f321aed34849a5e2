//! Samples of lamps without surface among the lights, and whether light arrives.
use fearless_simd_macros::simd;

use super::{LightSample, Lights};
use crate::{
    geometry::{MISS, Nearest},
    light::{LightCoordinates, ReferencePoint},
};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

impl Lights {
    /// A direction towards a lamp without surface, as if there were no other lights. There must be one.
    #[simd]
    pub fn sample_lamps<L: Lanes>(&self, l: L, at: ReferencePoint<L>, u: LightCoordinates<L>) -> LightSample<L> {
        let (lamp, pmf) = self.selection_of_lamps.choose(l, &at, &u);
        // Where no lamp shines, none is chosen.
        let target = lamp.is(MISS).pick(lamp, lamp + self.count as u32);
        let sample = LightSample { wi: at.n, radiance: V::splat(l, [0.0; 3]), pdf: l.f(0.0), target };
        let sample = self.with_lamps(l, at.p, sample);
        LightSample { pdf: sample.pdf * pmf, ..sample }
    }

    /// Completes the samples whose target is a lamp without surface, up to the probability of choosing it. A call, with the sample by
    /// value; otherwise it would be kept in memory even for scenes without lamps.
    #[simd]
    pub(super) fn with_lamps<L: Lanes>(&self, l: L, p: V<L>, sample: LightSample<L>) -> LightSample<L> {
        let LightSample { wi, radiance, pdf, target } = sample;
        let lamps = self.are_lamps(target);
        if !lamps.any() {
            return sample;
        }
        let of_lamp = self.lamps.sample(l, self.lamp(l, lamps, target), p);
        LightSample {
            wi: lamps.pick(of_lamp.wi, wi),
            radiance: lamps.pick(of_lamp.irradiance, radiance),
            pdf: lamps.pick(l.f(1.0), pdf),
            target,
        }
    }

    /// Lanes whose light is a lamp without surface: no other strategy could have sampled the direction towards it.
    #[inline(always)]
    pub fn are_lamps<L: Lanes>(&self, light: U<L>) -> M<L> {
        let first = self.count as u32;
        light.below(first + self.lamps.len() as u32) & !light.below(first)
    }

    /// Distances of the lamps among `lights` in the lanes of `lamps` from the points `p`.
    #[inline(always)]
    pub fn distance_of_lamps<L: Lanes>(&self, l: L, lamps: M<L>, lights: U<L>, p: V<L>) -> F<L> {
        self.lamps.distance(l, self.lamp(l, lamps, lights), p)
    }

    /// The numbers of the lamps of `lights` in the lanes of `lamps`, and the first lamp in the others.
    #[inline(always)]
    pub(super) fn lamp<L: Lanes>(&self, l: L, lamps: M<L>, lights: U<L>) -> U<L> {
        lamps.pick(lights + (self.count as u32).wrapping_neg(), l.u(0))
    }

    /// The lamp without surface of this light, by its place among all lamps.
    pub fn lamp_at(&self, light: u32) -> Option<usize> {
        let lamp = (light as usize).checked_sub(self.count)?;
        (lamp < self.lamps.len()).then_some(lamp)
    }

    /// Whether the light `target` arrives at `o` from the direction in which `nearest` is the first hit: it is the target, or the
    /// target is a lamp without surface that is not farther away. The ray then ends at the lamp.
    #[inline(always)]
    pub fn arrives<L: Lanes>(&self, l: L, target: U<L>, o: V<L>, nearest: Nearest<L>) -> (M<L>, Nearest<L>) {
        let hit = self.light_at(l, nearest.primitive, nearest.element).equals(target);
        if self.lamps.is_empty() {
            return (hit, nearest);
        }
        self.arrives_from_lamps(l, target, o, nearest, hit)
    }

    /// A call by value, for the same reason as [`Lights::with_lamps`].
    #[simd]
    fn arrives_from_lamps<L: Lanes>(&self, l: L, target: U<L>, o: V<L>, nearest: Nearest<L>, hit: M<L>) -> (M<L>, Nearest<L>) {
        let lamps = self.are_lamps(target);
        let distance = self.lamps.distance(l, self.lamp(l, lamps, target), o);
        let free = lamps & nearest.t.ge(distance);
        let end = Nearest {
            t: free.pick(distance, nearest.t),
            primitive: free.pick(l.u(MISS), nearest.primitive),
            element: nearest.element,
        };
        (free | hit, end)
    }
}
