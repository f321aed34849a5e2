//! The integrator: light sampling, roulette, media and light paths over batches of paths; and the measures of error.

pub mod integrator;
pub mod measure;
