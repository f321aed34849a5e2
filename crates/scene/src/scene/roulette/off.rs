//! No roulette.
use super::Survival;
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters},
    math::{F, Lanes, V},
};

/// Paths end only at the cap, in the background, or when they carry no more light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Off;

impl Kind for Off {
    const KIND: Parameter = Parameter::new("off", "Paths end only at the cap, or when they carry no more light.");

    fn chosen(&mut self, _: &mut dyn Parameters) {}
}

impl Declare for Off {
    fn parameters(&mut self, _: &mut dyn Parameters) {}
}

impl Survival for Off {
    #[inline(always)]
    fn plays_at(self, _: u32) -> bool {
        false
    }

    #[inline(always)]
    fn probability<L: Lanes>(self, l: L, _: V<L>, _: F<L>) -> F<L> {
        l.f(1.0)
    }

    fn words(self) -> String {
        "no roulette".to_owned()
    }

    fn survival(self) -> f32 {
        1.0
    }

    fn survival_words(self) -> String {
        "paths without roulette".to_owned()
    }
}
