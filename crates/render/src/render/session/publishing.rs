//! Publishes the frames and the status of a session when they are due.
use std::time::{Duration, Instant};

use super::Session;
use crate::render::{
    coarse::Coarse,
    error_estimator::rel_mse_estimate_in,
    frame::Frame,
    halves::Halves,
    protocol::{Budget, Publish, Status},
};

/// Interval between two frames: from 30 per second to 2, because an old image changes less.
const SHORTEST_INTERVAL: Duration = Duration::from_millis(33);
const LONGEST_INTERVAL: Duration = Duration::from_millis(500);

impl Session {
    pub(super) fn interval(&self, publish: Publish) -> Duration {
        match publish {
            // Many images in one are not copied so often.
            Publish::Live if self.film.has_series() => LONGEST_INTERVAL,
            Publish::Live => (self.elapsed / 20).clamp(SHORTEST_INTERVAL, LONGEST_INTERVAL),
            Publish::Sparse => LONGEST_INTERVAL,
        }
    }

    /// Whether the samples that no frame shows yet should be shown now.
    pub fn frame_due(&self, publish: Publish, at_rest: bool) -> bool {
        let waited = self.last_frame.is_none_or(|last| last.elapsed() >= self.interval(publish));
        // The full image is shown once it has no holes; until then the last coarse one stays.
        let complete = self.coarse.is_some() || self.film.spp() > 0;
        self.stale && complete && (at_rest || waited || self.coarse.is_some())
    }

    /// The image so far. A coarse film is replaced by the next finer one.
    pub fn frame(&mut self) -> Frame {
        self.stale = false;
        self.last_frame = Some(Instant::now());
        let full = self.request.camera.resolution;
        if let Some(coarse) = self.coarse.take() {
            self.coarse = Coarse::new(&self.request.camera, coarse.scale / 2);
            return Frame::of_film(&coarse.film, self.generation, coarse.camera.resolution, full);
        }
        let halves = self.halves.as_ref().and_then(|_| Halves::of_film(&self.film));
        let frame = Frame { elapsed: self.elapsed, halves, ..Frame::of_film(&self.film, self.generation, full, full) };
        self.rel_mse_estimate = frame.rel_mse_estimate;
        self.error_is_lower_bound = frame.error_is_lower_bound;
        // A region that has been left keeps the estimate for which it was.
        if let Some(region) = self.film.focus {
            self.region_estimate = rel_mse_estimate_in(&self.film, &region).map(|rel_mse| (region, rel_mse));
        }
        frame
    }

    pub fn status(&self, budget: &Budget) -> Status {
        Status {
            generation: self.generation,
            state: self.state(budget),
            spp: self.film.spp(),
            region_spp: self.focus(budget).and_then(|region| self.film.spp_in(&region)),
            samples: self.film.samples(),
            rays: self.count.rays,
            elapsed: self.elapsed,
            rel_mse_estimate: self.rel_mse_estimate,
            error_is_lower_bound: self.error_is_lower_bound,
            path_reuse: self.path_reuse,
            adapts: self.film.is_adaptive(),
            invalid_samples: self.film.invalid_samples(),
            first_invalid: self.count.invalid,
            cut_paths: self.count.cut_paths,
            is_mixed: self.is_mixed,
        }
    }
}
