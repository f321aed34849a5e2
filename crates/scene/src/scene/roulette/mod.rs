//! Russian roulette: ending paths at random and weighting the survivors, so that the mean stays right.
//!
//! A roulette is one file and one line of the catalogue below.
pub mod fixed;
pub mod off;
pub mod throughput;

use noisefall_base::{
    declare::{Accepted, Datum, Kind, OneOf, SettingValue},
    math::{F, Lanes, V},
};

noisefall_base::declare::choices! {
    /// How paths end.
    pub enum Roulette, "roulette", default throughput::Throughput {
        off::Off,
        fixed::Fixed(Fixed),
        throughput::Throughput(Throughput),
    }
    in_roulette
}

impl Roulette {
    /// Upper bound of the survival probability by throughput: a path between white walls must end too.
    pub const MOST: f32 = 0.95;
    /// Lower bound of all survival probabilities: random numbers are multiples of 2⁻²³, which would round smaller ones.
    pub const LEAST: f32 = 0.01;

    /// Whether roulette is played after the `reflection`-th reflection. Elsewhere every path goes on that carries anything.
    #[inline(always)]
    pub fn plays_at(self, reflection: u32) -> bool {
        in_roulette!(self, roulette => roulette.plays_at(reflection))
    }

    /// The probability of survival where roulette [is played](Roulette::plays_at). Roulette by throughput uses the throughput times
    /// `scale`.
    #[inline(always)]
    pub fn probability<L: Lanes>(self, l: L, throughput: V<L>, scale: F<L>) -> F<L> {
        in_roulette!(self, roulette => roulette.probability(l, throughput, scale))
    }

    /// Its name on the command line.
    pub fn name(self) -> String {
        in_roulette!(self, roulette => roulette.option())
    }

    /// Name and values in words.
    pub fn words(self) -> String {
        in_roulette!(self, roulette => roulette.words())
    }

    /// The first bounce at which a path can end, where the roulette has one of its own.
    pub fn first_bounce(self) -> Option<u32> {
        in_roulette!(self, roulette => roulette.first_bounce())
    }

    /// The largest survival probability of paths that still carry all light.
    pub fn survival(self) -> f32 {
        in_roulette!(self, roulette => roulette.survival())
    }

    /// Its name in a warning about variance.
    pub fn survival_words(self) -> String {
        in_roulette!(self, roulette => roulette.survival_words())
    }
}

impl SettingValue for Roulette {
    fn accepted() -> Accepted {
        let options = |roulette: Roulette| in_roulette!(roulette, kind => kind.options());
        Accepted::Other(Roulette::alternatives().into_iter().map(options).collect())
    }

    fn datum(&self) -> Datum {
        Datum::Word(Roulette::name(*self))
    }

    fn read(word: &str) -> Option<Roulette> {
        Roulette::alternatives().into_iter().find_map(|roulette| in_roulette!(roulette, kind => kind.named(word).map(Into::into)))
    }
}

/// A kind of roulette.
trait Survival: Kind {
    /// See [`Roulette::plays_at`].
    fn plays_at(self, reflection: u32) -> bool;

    /// See [`Roulette::probability`].
    fn probability<L: Lanes>(self, l: L, throughput: V<L>, scale: F<L>) -> F<L>;

    /// Its name on the command line.
    fn option(self) -> String {
        Self::KIND.key.to_owned()
    }

    /// This kind, if the command line calls it so.
    fn named(self, option: &str) -> Option<Self> {
        (option == Self::KIND.key).then_some(self)
    }

    /// The form of its name on the command line, for messages.
    fn options(self) -> String {
        Self::KIND.key.to_owned()
    }

    /// Name and values in words.
    fn words(self) -> String;

    /// See [`Roulette::first_bounce`].
    fn first_bounce(self) -> Option<u32> {
        None
    }

    /// See [`Roulette::survival`].
    fn survival(self) -> f32;

    /// See [`Roulette::survival_words`].
    fn survival_words(self) -> String;
}
