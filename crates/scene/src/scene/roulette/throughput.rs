//! Paths that carry little are likelier to end (Arvo and Kirk, "Particle Transport and Image Synthesis", SIGGRAPH 1990).
//!
//! With the throughput itself as the probability, all survivors would weigh the same. But most paths have lost half of it or more when
//! roulette begins: most would end at once, and the others would count two or three times as much. With the square root, as in
//! Cycles, paths end over several bounces. Between surfaces of albedo ρ, up to 0.95, both rules settle at a survival probability of ρ.
use serde::{Deserialize, Serialize};

use super::{Roulette, Survival};
use noisefall_base::{
    declare::{CountRange, Declare, Kind, Parameter, Parameters},
    math::{F, Lanes, V},
};

/// Survival probability is the square root of the throughput's largest component, at most [`Roulette::MOST`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Throughput {
    /// The first bounce at which a path can end.
    pub start: u32,
}

impl Roulette {
    /// By throughput, from the fourth bounce.
    pub const BY_THROUGHPUT: Roulette = Roulette::by_throughput_from(4);

    /// By throughput, from a bounce on.
    pub const fn by_throughput_from(start: u32) -> Roulette {
        Roulette::Throughput(Throughput { start })
    }
}

impl Default for Throughput {
    fn default() -> Self {
        Throughput { start: 4 }
    }
}

impl Kind for Throughput {
    const KIND: Parameter = Parameter::new(
        "throughput",
        "Survival probability is the square root of the throughput's largest component, at most 0.95: paths that carry little end early.",
    )
    .title("By throughput");

    fn chosen(&mut self, p: &mut dyn Parameters) {
        p.table(&Self::KIND, self);
    }
}

impl Declare for Throughput {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const START: Parameter = Parameter::new("start", "The first bounce at which a path can end.");
        p.count(&START, &mut self.start, CountRange::ANY);
    }
}

impl Survival for Throughput {
    #[inline(always)]
    fn plays_at(self, reflection: u32) -> bool {
        reflection >= self.start
    }

    #[inline(always)]
    fn probability<L: Lanes>(self, l: L, throughput: V<L>, scale: F<L>) -> F<L> {
        (throughput.max_component() * scale).sqrt().min(l.f(Roulette::MOST)).max(l.f(Roulette::LEAST))
    }

    fn option(self) -> String {
        let key = Self::KIND.key;
        if self == Self::default() { key.to_owned() } else { format!("{key}:{}", self.start) }
    }

    fn named(self, option: &str) -> Option<Self> {
        match option.strip_prefix(Self::KIND.key)? {
            "" => Some(self),
            start => start.strip_prefix(':')?.parse().ok().map(|start| Throughput { start }),
        }
    }

    fn options(self) -> String {
        format!("{}[:BOUNCE]", Self::KIND.key)
    }

    fn words(self) -> String {
        format!("roulette by throughput from bounce {} on", self.start)
    }

    fn first_bounce(self) -> Option<u32> {
        Some(self.start)
    }

    fn survival(self) -> f32 {
        Roulette::MOST
    }

    fn survival_words(self) -> String {
        format!("survival of at most {} in roulette by throughput", Roulette::MOST)
    }
}
