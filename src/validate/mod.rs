//! Exact solutions against what the renderer says, as a report that a reader can follow.
//!
//! Each section makes one claim, derives the exact answer, and holds measurements against it in [`Statement`]s. All samples are
//! seeded and the same on every machine, so that a verdict is, too.
mod check;
mod report;
mod sections;
mod statement;
mod stress;
#[cfg(test)]
mod tests;

use std::path::PathBuf;

use self::statement::SIGMAS;
pub use self::{
    report::html,
    sections::{Agreement, agreement, reference_names},
    statement::Statement,
    stress::KeptScene,
};
use crate::report::Figure;
#[cfg(test)]
use crate::scene::Fault;

/// What is held against what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Suite {
    /// Exact solutions of the light transport equation.
    Exact,
    /// Hundreds of adversarial scenes against invariants.
    Stress,
}

/// How much is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Under half a minute on two cores.
    Quick,
    /// Some minutes.
    Full,
}

/// What to validate, and how thoroughly.
pub struct Validation {
    effort: Effort,
    /// Where reference images are looked for.
    references: PathBuf,
    #[cfg(test)]
    fault: Option<Fault>,
}

/// A claim and what became of it.
pub struct Section {
    pub title: &'static str,
    pub claim: &'static str,
    /// Paragraphs that lead to the exact answer.
    pub derivation: &'static [&'static str],
    pub source: &'static str,
    pub statements: Vec<Statement>,
    pub figures: Vec<Figure>,
    /// What a reader should know besides.
    pub remark: Option<String>,
}

impl Section {
    /// Whether there was anything to hold it against.
    pub fn was_run(&self) -> bool {
        !self.statements.is_empty()
    }

    pub fn holds(&self) -> bool {
        self.statements.iter().all(|statement| statement.holds)
    }
}

impl Validation {
    /// All sections in their order; `done` is shown each when it is finished.
    pub fn run(&self, mut done: impl FnMut(usize, &Section)) -> Vec<Section> {
        let section = |(i, run): (usize, &fn(&Validation) -> Section)| {
            let section = run(self);
            done(i + 1, &section);
            section
        };
        sections::ALL.iter().enumerate().map(section).collect()
    }

    pub fn new(effort: Effort, references: PathBuf) -> Validation {
        Validation {
            effort,
            references,
            #[cfg(test)]
            fault: None,
        }
    }

    /// What a full run takes `full` samples for.
    fn spp(&self, full: u32) -> u32 {
        match self.effort {
            Effort::Full => full,
            Effort::Quick => (full / 12).max(8),
        }
    }
}
