//! Roulette with a constant survival probability.
use serde::{Deserialize, Serialize};

use super::{Roulette, Survival};
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Range},
    math::{F, Lanes, V},
};

/// Roulette with the same survival probability at every bounce.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Fixed {
    /// From [`Roulette::LEAST`] to 1.
    pub survival: f32,
}

impl Roulette {
    /// Roulette with the same survival probability at every bounce, from [`Roulette::LEAST`] to 1.
    pub const fn fixed(survival: f32) -> Roulette {
        Roulette::Fixed(Fixed { survival })
    }
}

impl Default for Fixed {
    fn default() -> Self {
        Fixed { survival: 0.8 }
    }
}

impl Kind for Fixed {
    const KIND: Parameter =
        Parameter::new("fixed", "Survival probability at every bounce.").title("Fixed probability").symbol("q").required();

    fn chosen(&mut self, p: &mut dyn Parameters) {
        self.parameters(p);
    }
}

impl Declare for Fixed {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.single(&Self::KIND.title("Survival"), &mut self.survival, Range::linear(0.01, 1.0));
    }
}

impl Survival for Fixed {
    #[inline(always)]
    fn plays_at(self, _: u32) -> bool {
        self.survival < 1.0
    }

    #[inline(always)]
    fn probability<L: Lanes>(self, l: L, _: V<L>, _: F<L>) -> F<L> {
        l.f(self.survival)
    }

    fn option(self) -> String {
        self.survival.to_string()
    }

    fn named(self, option: &str) -> Option<Self> {
        let survival = option.parse().ok().filter(|p| (Roulette::LEAST..=1.0).contains(p));
        survival.map(|survival| Fixed { survival })
    }

    fn options(self) -> String {
        "a survival probability from 0.01 to 1".to_owned()
    }

    fn words(self) -> String {
        format!("roulette of {}", self.survival)
    }

    fn survival(self) -> f32 {
        self.survival
    }

    fn survival_words(self) -> String {
        if self.survival < 1.0 { format!("survival of {} in roulette", self.survival) } else { super::off::Off.survival_words() }
    }
}
