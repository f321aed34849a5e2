//! Exact solutions against what the renderer says, as a report that a reader can follow.
//!
//! Each section makes one claim, derives the exact answer, and holds measurements against it in [`Statement`]s. All samples are
//! seeded and the same on every machine, so that a verdict is, too.
mod cells;
mod chance;
mod check;
mod files;
mod microfacets;
mod pooled;
mod report;
mod sections;
mod statement;
mod stress;
#[cfg(test)]
mod tests;
mod theory;

use std::{
    path::PathBuf,
    sync::atomic::{AtomicU32, Ordering},
};

use self::statement::SIGMAS;
pub use self::{
    files::{csv, drawings, json},
    report::html,
    sections::{BlockZScores, block_z_scores, reference_names},
    statement::{Noticed, Statement},
    stress::KeptScene,
};
#[cfg(test)]
use crate::scene::InjectedFault;
use crate::{
    report::Figure,
    sampling::hash::{GOLDEN, hash_one},
};

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
    /// Under three minutes on two cores.
    Full,
}

/// What to validate, and how thoroughly.
pub struct Validation {
    effort: Effort,
    /// A folder of pictures by other renderers; those that the program carries if there is none.
    references: Option<PathBuf>,
    seed: u32,
    /// The number of the next measurement: the section in the upper half.
    measurement: AtomicU32,
    #[cfg(test)]
    fault: Option<InjectedFault>,
}

/// A claim and what became of it.
pub struct Section {
    /// The heading.
    pub title: &'static str,
    /// What is claimed, in a sentence.
    pub claim: &'static str,
    /// Paragraphs that lead to the exact answer.
    pub derivation: &'static [&'static str],
    /// The literature.
    pub source: &'static str,
    /// What was measured.
    pub statements: Vec<Statement>,
    /// Plots and images.
    pub figures: Vec<Figure>,
    /// What a reader should know besides.
    pub remark: Option<String>,
}

impl Section {
    /// Whether there was anything to hold it against.
    pub fn was_run(&self) -> bool {
        !self.statements.is_empty()
    }

    /// Whether all statements hold.
    pub fn holds(&self) -> bool {
        self.statements.iter().all(|statement| statement.holds)
    }
}

impl Validation {
    /// All sections in their order; `done` is shown each when it is finished.
    pub fn run(&self, done: impl FnMut(usize, &Section)) -> Vec<Section> {
        self.run_these(&sections::ALL, done)
    }

    /// These sections, and what all their statements say together.
    fn run_these(&self, these: &[fn(&Validation) -> Section], mut done: impl FnMut(usize, &Section)) -> Vec<Section> {
        let mut sections = Vec::new();
        for (i, run) in (0..).zip(these) {
            self.measurement.store(i << 16, Ordering::Relaxed);
            let section = run(self);
            done(sections.len() + 1, &section);
            sections.push(section);
        }
        let all = pooled::section(&sections);
        done(sections.len() + 1, &all);
        sections.push(all);
        sections
    }

    /// A validation with this seed.
    pub fn new(effort: Effort, references: Option<PathBuf>, seed: u32) -> Validation {
        Validation {
            effort,
            references,
            seed,
            measurement: AtomicU32::new(0),
            #[cfg(test)]
            fault: None,
        }
    }

    /// The seed of the next measurement: no two of a report have the same.
    fn next_seed(&self) -> u32 {
        let number = self.measurement.fetch_add(1, Ordering::Relaxed);
        // Both maps are one-to-one.
        hash_one(number.wrapping_mul(GOLDEN).wrapping_add(hash_one(self.seed)))
    }

    /// What a full run takes `full` samples for.
    fn spp(&self, full: u32) -> u32 {
        match self.effort {
            Effort::Full => full,
            Effort::Quick => (full / 12).max(8),
        }
    }
}
