//! Error metrics between images, exact solutions of scenes, and statistics of samples.
mod bias;
mod error;
pub mod exact;
mod means;
mod moments;
mod ratio;
mod sample_noise;

pub use self::means::sample_image;
pub use self::{
    bias::{Bias, Evidence, LEAST_EFFECTIVE_SAMPLES, as_normal},
    error::{Comparison, Floor, compare, mean_square, relative},
    means::{Mean, Measure, Picture, picture},
    moments::{Moments, samples},
    ratio::{BlockErrors, LogRatio, student_95},
    sample_noise::SampleNoise,
};
