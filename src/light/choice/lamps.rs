//! Samples of lamps without surface among the lights, and whether light arrives.
use super::{LightSample, Lights};
use crate::{
    geometry::{MISS, Nearest},
    light::{LightCoordinates, ReferencePoint, lamp::LampSample},
    math::{Lanes, M, Pick, U, V},
};

impl Lights {
    /// A direction towards a lamp without surface, as if there were no other lights. There must be one.
    #[inline(always)]
    pub fn sample_lamps<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, u: &LightCoordinates<L>) -> LightSample<L> {
        let (lamp, pmf) = self.selection_of_lamps.choose(l, at, u);
        // Where no lamp shines, none is chosen.
        let target = lamp.is(MISS).pick(lamp, lamp + self.count as u32);
        let mut sample = LightSample { wi: at.n, radiance: V::splat(l, [0.0; 3]), pdf: l.f(0.0), delta: l.first(0), target };
        self.add_lamps(l, at, &mut sample);
        sample.pdf = sample.pdf * pmf;
        sample
    }

    /// Completes the samples whose target is a lamp without surface, up to the probability of choosing it.
    #[inline(always)]
    pub(super) fn add_lamps<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, sample: &mut LightSample<L>) {
        let lamps = self.are_lamps(sample.target);
        if !lamps.any() {
            return;
        }
        let LampSample { wi, irradiance } = self.lamps.sample(l, self.lamp(l, lamps, sample.target), at.p);
        sample.wi = lamps.pick(wi, sample.wi);
        sample.radiance = lamps.pick(irradiance, sample.radiance);
        sample.pdf = lamps.pick(l.f(1.0), sample.pdf);
        sample.delta = lamps;
    }

    /// Lanes whose light is a lamp without surface.
    #[inline(always)]
    fn are_lamps<L: Lanes>(&self, light: U<L>) -> M<L> {
        let first = self.count as u32;
        light.below(first + self.lamps.len() as u32) & !light.below(first)
    }

    /// The numbers of the lamps of `lights` in the lanes of `lamps`, and the first lamp in the others.
    #[inline(always)]
    fn lamp<L: Lanes>(&self, l: L, lamps: M<L>, lights: U<L>) -> U<L> {
        lamps.pick(lights + (self.count as u32).wrapping_neg(), l.u(0))
    }

    /// The lamp without surface of this light, by its place among all lamps.
    pub fn lamp_at(&self, light: u32) -> Option<usize> {
        let lamp = (light as usize).checked_sub(self.count)?;
        (lamp < self.lamps.len()).then_some(lamp)
    }

    /// Whether the light `target` arrives at `o` from the direction in which `nearest` is the first hit: it is the target, or the
    /// target is a lamp without surface that is not farther away. `nearest` then ends at the lamp.
    #[inline(always)]
    pub fn arrives<L: Lanes>(&self, l: L, target: U<L>, o: V<L>, nearest: &mut Nearest<L>) -> M<L> {
        let hit = self.light_at(l, nearest.primitive, nearest.element).equals(target);
        if self.lamps.is_empty() {
            return hit;
        }
        let lamps = self.are_lamps(target);
        let distance = self.lamps.distance(l, self.lamp(l, lamps, target), o);
        let free = lamps & nearest.t.ge(distance);
        nearest.t = free.pick(distance, nearest.t);
        nearest.primitive = free.pick(l.u(MISS), nearest.primitive);
        free | (hit & !lamps)
    }
}
