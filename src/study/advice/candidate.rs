//! The settings that were tried, and which of them are advised.
use crate::{
    scene::RenderSettings,
    study::{fit::student_95, outcome::ROUNDING},
};

/// Settings that were tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    pub settings: RenderSettings,
    /// What differs from the settings in use.
    pub name: String,
    /// 1/(relMSE · seconds); 0 where hardly any of the light was found that others found.
    pub efficiency: f64,
    /// Efficiency over that of the settings in use, which is infinite where those found hardly any light.
    pub relative: f64,
    /// Standard error of ln `relative`, that is, as a part of it, by the spread over rounds.
    pub standard_error: f64,
    /// Of a picture of `spp` samples per pixel.
    pub rel_mse: f64,
    /// That the picture took.
    pub seconds: f64,
    pub spp: u32,
    /// How many pictures were made.
    pub rounds: usize,
}

/// What was found out. There is always a candidate, for the settings in use are one.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// The most efficient first.
    pub candidates: Vec<Candidate>,
    /// Place of what should be used: of those that are clearly better and about as good as any, the one that changes least; the
    /// settings in use, if nothing is clearly better.
    pub best: usize,
    /// Place of the settings in use.
    pub current: usize,
}

impl Candidate {
    /// Whether it is better than the settings in use beyond what the spread over rounds explains, at 95 %, and by enough to
    /// matter.
    pub fn is_clearly_better(&self) -> bool {
        let by_chance = student_95(self.rounds as f64 - 1.0) * self.standard_error;
        self.relative >= LEAST_GAIN && self.relative.ln() > by_chance
    }

    /// Whether it was measured to be better by enough to matter, but not beyond chance.
    pub fn may_be_better(&self) -> bool {
        self.relative >= LEAST_GAIN && !self.is_clearly_better()
    }

    /// Whether what is left is rounding.
    pub fn is_exact(&self) -> bool {
        self.rel_mse <= ROUNDING && self.efficiency > 0.0
    }
}

impl Advice {
    pub fn best(&self) -> &Candidate {
        &self.candidates[self.best]
    }

    pub fn current(&self) -> &Candidate {
        &self.candidates[self.current]
    }
}

/// Less is not worth a change.
pub(super) const LEAST_GAIN: f64 = 1.05;
