//! Validation: the renderer compared with exact solutions, as a report with derivations.
//!
//! Each section makes one claim, derives the exact answer, and compares measurements with it in [`Statement`]s. All samples are
//! seeded, so the verdict is the same on every machine.
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
    ops::ControlFlow,
    path::PathBuf,
    sync::atomic::{AtomicU32, Ordering},
};

use self::statement::SIGMAS;
pub use self::{
    files::{csv, drawings, json},
    report::html,
    sections::{BlockZScores, block_z_scores, reference_names},
    statement::{Noticed, Statement},
    stress::FailedScene,
};
use crate::report::Figure;
use noisefall_scene::sampling::hash::{GOLDEN, hash_one};
use noisefall_scene::scene::InjectedFault;

/// A set of sections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Suite {
    /// Comparison with exact solutions of the light transport equation.
    Exact,
    /// More than two thousand adversarial scenes, checked for invariants.
    Stress,
}

/// The amount of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Under half a minute on two cores.
    Quick,
    /// Under three minutes on two cores.
    Full,
}

/// A validation run.
#[derive(Debug)]
pub struct Validation {
    effort: Effort,
    /// Folder of references by other renderers. Default: those in the program.
    references: Option<PathBuf>,
    seed: u32,
    /// The number of the next measurement, with the section in the upper 16 bits.
    measurement: AtomicU32,
    fault: Option<InjectedFault>,
}

/// A claim with its derivation and its measurements.
pub struct Section {
    /// The heading.
    pub title: &'static str,
    /// The claim, in one sentence.
    pub claim: &'static str,
    /// Paragraphs that derive the exact answer.
    pub derivation: &'static [&'static str],
    /// The literature.
    pub source: &'static str,
    /// The measurements.
    pub statements: Vec<Statement>,
    /// Plots and images.
    pub figures: Vec<Figure>,
    /// A further note for the reader.
    pub remark: Option<String>,
}

impl Section {
    /// Whether there was anything to compare with.
    pub fn was_run(&self) -> bool {
        !self.statements.is_empty()
    }

    /// Whether all statements hold.
    pub fn holds(&self) -> bool {
        self.statements.iter().all(|statement| statement.holds)
    }
}

impl Validation {
    /// Runs all sections in order. Calls `done` with the number of each section, from 1, when it is finished.
    pub fn run(&self, done: impl FnMut(usize, &Section)) -> Vec<Section> {
        self.run_these(&sections::ALL, done)
    }

    /// Runs all sections until `done` stops it. Returns the sections that are finished.
    pub fn run_while(&self, done: impl FnMut(usize, &Section) -> ControlFlow<()>) -> Vec<Section> {
        self.run_these_while(&sections::ALL, done)
    }

    /// Runs these sections, and pools their statements in a last one.
    fn run_these(&self, these: &[fn(&Validation) -> Section], mut done: impl FnMut(usize, &Section)) -> Vec<Section> {
        self.run_these_while(these, |number, section| {
            done(number, section);
            ControlFlow::Continue(())
        })
    }

    fn run_these_while(
        &self,
        these: &[fn(&Validation) -> Section],
        mut done: impl FnMut(usize, &Section) -> ControlFlow<()>,
    ) -> Vec<Section> {
        let mut sections = Vec::new();
        for (i, run) in (0..).zip(these) {
            self.measurement.store(i << 16, Ordering::Relaxed);
            sections.push(run(self));
            if done(sections.len(), &sections[sections.len() - 1]).is_break() {
                return sections;
            }
        }
        sections.push(pooled::section(&sections));
        let _ = done(sections.len(), &sections[sections.len() - 1]);
        sections
    }

    /// A validation run. Without `references`, the references in the program are used.
    pub fn new(effort: Effort, references: Option<PathBuf>, seed: u32) -> Validation {
        Validation { effort, references, seed, measurement: AtomicU32::new(0), fault: None }
    }

    /// The seed of the next measurement. All seeds of a report differ.
    fn next_seed(&self) -> u32 {
        let number = self.measurement.fetch_add(1, Ordering::Relaxed);
        // Both maps are bijective.
        hash_one(number.wrapping_mul(GOLDEN).wrapping_add(hash_one(self.seed)))
    }

    /// The number of samples in place of `full`, those of a full run.
    fn spp(&self, full: u32) -> u32 {
        match self.effort {
            Effort::Full => full,
            Effort::Quick => (full / 12).max(8),
        }
    }
}
