//! Checkpoints of a session, and sessions that continue from one.
use super::Session;
use crate::render::{
    checkpoint::{CheckpointState, CheckpointWriter, counters},
    error_estimator::rel_mse_estimate,
    pass::PassCount,
    protocol::{Budget, Publish, RenderRequest},
    threads::Threads,
};

impl Session {
    /// Continues a render from its checkpoint.
    pub fn of_kept(generation: u64, request: RenderRequest, budget: &Budget, kept: CheckpointState) -> Session {
        let mut session = Session::new(generation, request, Publish::Sparse, None, budget, None);
        let failure = session.count.failure.take();
        let CheckpointState { film, count, elapsed, is_mixed } = kept;
        // The budget may be reached already.
        session.rel_mse_estimate = rel_mse_estimate(&film);
        session.path_reuse = film.path_reuse;
        (session.film, session.count, session.elapsed) = (film, PassCount { failure, ..count }, elapsed);
        (session.stale, session.is_mixed) = (true, is_mixed);
        session
    }

    /// Whether there is anything to keep.
    pub fn can_be_kept(&self) -> bool {
        !self.is_coarse() && self.film.samples() > 0 && !self.film.has_series()
    }

    /// Writes a checkpoint. The render stands still meanwhile.
    pub fn checkpoint(&self, keeper: &mut CheckpointWriter, threads: &Threads) {
        keeper.keep(&self.film, counters(&self.count, self.elapsed), threads);
    }
}

#[cfg(test)]
mod tests;
