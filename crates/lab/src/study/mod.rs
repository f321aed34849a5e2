//! Run time against error: times every combination of settings, compares it with a reference, and ranks the combinations.
//!
//! ```text
//!   StudyScene (scene, size) ─▶ trial: which combinations give the same image
//!                         ─▶ Reference: the truth, a file, or a converged render
//!                         ─▶ measure: Run (seconds and errors at powers of two of samples) ─▶ Store: study.csv
//!   runs ─▶ Outcome (slope, efficiency) ─▶ Findings (ranking) ─▶ report.html
//! ```
//! The store keeps measurements line by line, and they are never repeated: see [`Study::run`].
mod advice;
mod driver;
mod evidence;
mod figures;
mod fit;
mod key;
mod labels;
mod machine;
mod measure;
mod outcome;
mod plan;
mod ranking;
mod reference;
mod report;
mod row;
mod store;
mod study_scene;
#[cfg(test)]
mod tests;
mod trial;
mod wording;

use std::path::PathBuf;

pub use self::{
    advice::{Advice, Candidate, advise},
    driver::{Progress, Study},
    evidence::{Chapter, EvidencePlan, collect, reserve_chapter},
    fit::{Slope, slope},
    labels::{differing_labels, label},
    machine::Machine,
    measure::{Bench, Checkpoint, Run},
    outcome::{Eligibility, Outcome},
    plan::{Lists, Plan, checkpoints, study_size},
    ranking::Findings,
    report::html,
    store::{CSV, Store},
    study_scene::{StudyScene, reserve},
    wording::{table, verdict},
};
use noisefall_base::file::WriteError;

/// Error of a study.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// A scene that cannot be measured.
    #[error("{}: {reason}", path.display())]
    Unmeasurable {
        /// The scene file.
        path: PathBuf,
        /// Why it cannot be measured.
        reason: String,
    },
    /// A file that cannot be read or written.
    #[error("{}: {reason}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Message of the system.
        reason: String,
    },
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The renderer failed.
    #[error("the renderer failed: {0}")]
    Renderer(String),
    /// The study was stopped; complete runs are in the store.
    #[error("interrupted")]
    Interrupted,
}
