//! The time that is left for this run.
use std::time::{Duration, Instant};

pub struct Pace {
    end: Option<Instant>,
}

impl Pace {
    pub fn minutes(minutes: Option<f64>) -> Pace {
        Pace { end: minutes.map(|minutes| Instant::now() + Duration::from_secs_f64(60.0 * minutes)) }
    }

    pub fn is_over(&self) -> bool {
        self.end.is_some_and(|end| Instant::now() >= end)
    }
}
