//! Checkpoints of the first image.
use crossbeam_channel::Sender;

use super::Worker;
use crate::render::checkpoint::{CheckpointEvent, CheckpointPlan, CheckpointWriter};

impl Worker {
    /// Keeps the first image by this plan from now on, or no longer. A checkpoint that is being written is finished first.
    pub(super) fn set_plan(&mut self, plan: Option<CheckpointPlan>) {
        self.keeper = None;
        let Some(plan) = plan else { return };
        let events = plan.events.clone();
        match CheckpointWriter::new(plan) {
            Ok(keeper) => self.keeper = Some(keeper),
            Err(error) => _ = events.send(CheckpointEvent::Failed(error.to_string())),
        }
    }

    /// Writes a checkpoint if it is time for one.
    pub(super) fn keep_if_due(&mut self) {
        if self.keeper.as_mut().is_some_and(CheckpointWriter::is_due) {
            self.keep();
        }
    }

    /// Writes a checkpoint, and waits until it is on the disk. `kept` hears of that; the events have the result.
    pub(super) fn keep_now(&mut self, kept: &Sender<()>) {
        self.keep();
        self.keeper.iter_mut().for_each(CheckpointWriter::report);
        let _ = kept.send(());
    }

    /// Writes the image of this number by a plan of its own. The events have the result.
    pub(super) fn keep_once(&mut self, generation: u64, plan: CheckpointPlan) {
        let events = plan.events.clone();
        let first = self.sessions[0].as_ref().filter(|first| first.generation() == generation && first.can_be_kept());
        let kept = match first {
            None => Err("the image has changed, or has no samples yet".to_owned()),
            Some(first) => CheckpointWriter::new(plan)
                .map(|mut keeper| first.checkpoint(&mut keeper, &self.threads))
                .map_err(|error| error.to_string()),
        };
        // A keeper reports when it is dropped.
        kept.err().into_iter().for_each(|error| _ = events.send(CheckpointEvent::Failed(error)));
    }

    fn keep(&mut self) {
        let first = self.sessions[0].as_ref().filter(|first| first.can_be_kept());
        if let (Some(keeper), Some(session)) = (&mut self.keeper, first) {
            session.checkpoint(keeper, &self.threads);
        }
    }
}
