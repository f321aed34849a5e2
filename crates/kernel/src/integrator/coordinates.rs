//! The random numbers of a reflection, besides those of its light sample.
use fearless_simd_macros::simd;

use super::Stream;
use super::work::Work;
use noisefall_base::math::{F, Lanes, U};
use noisefall_scene::sampling::Dimension;

/// The random numbers of a reflection.
pub(super) struct ReflectionCoordinates<L: Lanes> {
    /// The numbers of the light sample are still to be read from it.
    pub stream: Stream<L>,
    /// Selects the next direction.
    pub direction: (F<L>, F<L>),
    /// Selects the lobe; 0 if there is only one.
    pub lobe: F<L>,
    /// Decides about survival; 0 if there is no roulette.
    pub roulette: F<L>,
}

impl<L: Lanes> ReflectionCoordinates<L> {
    /// [`ReflectionCoordinates::of`] as a call. It is compiled once per SIMD level, and not once more for each shading stage; the
    /// most frequent stage is faster without the call.
    #[simd]
    pub fn call_of(l: L, work: &Work, slot: U<L>, reflection: u32, several_lobes: bool) -> Self {
        Self::of(l, work, slot, reflection, several_lobes)
    }

    /// The random numbers of the `reflection`-th reflection of the paths in some slots, from surfaces with several lobes or with
    /// one.
    #[inline(always)]
    pub fn of(l: L, work: &Work, slot: U<L>, reflection: u32, several_lobes: bool) -> Self {
        let stream = work.stream(l, slot);
        let unused = l.f(0.0);
        ReflectionCoordinates {
            direction: stream.two(Dimension::direction(reflection)),
            lobe: if several_lobes { stream.one(Dimension::lobe(reflection)) } else { unused },
            roulette: if work.settings.roulette.plays_at(reflection) {
                stream.one(Dimension::roulette(reflection))
            } else {
                unused
            },
            stream,
        }
    }
}
