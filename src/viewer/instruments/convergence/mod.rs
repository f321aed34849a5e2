//! The convergence instrument: error and bias over samples or time, a curve for each setting that was tried.
pub mod colours;
pub mod curve;
mod export;
pub mod history;
mod legend;
pub mod lost_light;
pub mod plot;
