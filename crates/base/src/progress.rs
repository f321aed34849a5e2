//! Progress of long tasks, which another thread shows, and their cancellation.
use std::sync::{
    Arc,
    atomic::{AtomicBool, AtomicU8, AtomicU64, Ordering},
};

/// A part of opening a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Stage {
    /// Reading files; progress counts bytes.
    #[default]
    Files,
    /// Translating meshes, and computing their normals; progress counts triangles.
    Meshes,
    /// Building the trees of meshes; progress counts triangles.
    Trees,
}

impl Stage {
    const ALL: [Stage; 3] = [Stage::Files, Stage::Meshes, Stage::Trees];

    /// Returns the name of the stage, as the beginning of a line.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Files => "Reading files",
            Stage::Meshes => "Preparing meshes",
            Stage::Trees => "Building trees",
        }
    }
}

/// The task was cancelled. Its result is incomplete.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

/// The progress of a task. Clones share it: the task reports to one, other threads look at others.
#[derive(Clone, Debug, Default)]
pub struct Progress(Arc<Shared>);

#[derive(Debug, Default)]
struct Shared {
    stage: AtomicU8,
    done: AtomicU64,
    total: AtomicU64,
    is_cancelled: AtomicBool,
}

/// Progress is no part of what a task does: any two are equal.
impl PartialEq for Progress {
    fn eq(&self, _: &Progress) -> bool {
        true
    }
}

impl Progress {
    /// Adds `amount` to the work of a stage. Another stage starts at 0.
    pub fn expect(&self, stage: Stage, amount: u64) {
        let Progress(shared) = self;
        if shared.stage.swap(stage as u8, Ordering::Relaxed) != stage as u8 {
            shared.done.store(0, Ordering::Relaxed);
            shared.total.store(0, Ordering::Relaxed);
        }
        shared.total.fetch_add(amount, Ordering::Relaxed);
    }

    /// Reports work that is done. Fails if the task is cancelled, and should then end.
    pub fn advance(&self, amount: u64) -> Result<(), Cancelled> {
        self.0.done.fetch_add(amount, Ordering::Relaxed);
        self.check()
    }

    /// Fails if the task is cancelled.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }

    /// The current stage.
    pub fn stage(&self) -> Stage {
        Stage::ALL[usize::from(self.0.stage.load(Ordering::Relaxed))]
    }

    /// The part of the work of the current stage that is done, from 0 to 1.
    pub fn fraction(&self) -> f64 {
        let [done, total] = [&self.0.done, &self.0.total].map(|count| count.load(Ordering::Relaxed));
        if total == 0 { 0.0 } else { (done as f64 / total as f64).min(1.0) }
    }

    /// Asks the task to end. It does so at its next report.
    pub fn cancel(&self) {
        self.0.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the task should end.
    pub fn is_cancelled(&self) -> bool {
        self.0.is_cancelled.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stage_counts_its_own_work_until_the_task_is_cancelled() {
        let task = Progress::default();
        let shown = task.clone();
        assert_eq!((shown.stage(), shown.fraction()), (Stage::Files, 0.0));
        task.expect(Stage::Files, 100);
        task.expect(Stage::Files, 300);
        assert_eq!((task.advance(100), shown.fraction()), (Ok(()), 0.25));
        task.expect(Stage::Trees, 8);
        assert_eq!((shown.stage().name(), shown.fraction()), ("Building trees", 0.0));
        shown.cancel();
        assert_eq!((task.advance(9), task.check(), task.fraction()), (Err(Cancelled), Err(Cancelled), 1.0));
        assert!(Stage::ALL.iter().enumerate().all(|(place, stage)| *stage as usize == place));
    }
}
