//! Denoised images. They are biased: they are never a substitute for samples, and never an input of a measurement.
//!
//! Non-local means over two half images, whose weights come from the half that they do not filter (F. Rousselle, C. Knaus and M.
//! Zwicker, "Adaptive rendering with non-local means filtering", ACM Trans. Graph. 31(6), 2012, sections 4 and 5.1).
use super::{
    frame::Frame,
    non_local_means::{self, Buffer, filter},
};
use noisefall_base::{
    math::colour::luminance,
    memory::{self, Reservation, TooMuch},
};

/// Label of every denoised image.
pub const LABEL: &str = "denoised: biased, not the solution of the equation";

/// Key of [`LABEL`] in the settings of an image file.
pub const LABEL_KEY: &str = "image";

/// Title of the view that shows denoised images. The window saves it in the settings of an image.
pub const VIEW_TITLE: &str = "Denoised (biased)";

/// Whether the settings of an image file, as in [`super::settings_text`], say that the image is denoised.
pub fn is_denoised(settings: &serde_json::Value) -> bool {
    settings[LABEL_KEY] == LABEL || settings["view"] == VIEW_TITLE
}

/// Smallest variance relative to that of independent samples.
const LEAST_GAIN: f64 = 0.01;

/// The denoised radiance of a frame. `None` if it has no halves, or if it was cancelled. Runs on the threads of the calling pool.
pub fn denoised(frame: &Frame, cancelled: &(dyn Fn() -> bool + Sync)) -> Option<Vec<[f32; 3]>> {
    let (halves, noise) = (frame.halves.as_ref()?, frame.noise.as_ref()?);
    let gain = gain(frame)?;
    let variance = |of: fn(f32) -> f32| {
        let scaled = |(variance, share): (&[f32; 3], &f32)| variance.map(|v| v * gain / of(*share));
        noise.variance.iter().zip(&halves.shares).map(scaled).collect::<Vec<_>>()
    };
    let variances = [variance(|share| share), variance(|share| 1.0 - share)];
    let [first, second] = [0, 1].map(|half| Buffer { mean: &halves.means[half], variance: &variances[half] });
    let size = [frame.width, frame.height].map(|side| side as usize);
    let floor = floor(frame);
    let [first, second] = [filter(first, second, size, floor, cancelled)?, filter(second, first, size, floor, cancelled)?];
    let whole = |((a, b), share): ((&[f32; 3], &[f32; 3]), &f32)| [0, 1, 2].map(|c| a[c] * share + b[c] * (1.0 - share));
    Some(first.iter().zip(&second).zip(&halves.shares).map(whole).collect())
}

/// How often [`denoised`] asks whether it was cancelled: the whole of its progress.
pub fn steps(size: [u32; 2]) -> usize {
    2 * non_local_means::steps(size.map(|side| side as usize))
}

/// Reserves memory for [`denoised`] at this size.
pub fn reserve([width, height]: [u32; 2]) -> Result<Reservation, TooMuch> {
    /// Bytes per pixel: two variances, the results of both halves, and the image; and if there are as many threads as bands, the
    /// sums of the bands, and their distances, which also cover the rows of patches around a band.
    const PIXEL: u64 = 5 * 12 + 16 + 6;
    memory::reserve(format_args!("denoised images of {width} × {height} pixels"), PIXEL * u64::from(width) * u64::from(height))
}

/// The variance of the means relative to that of independent samples. Stratified samples have less, which shows only in the
/// difference of the halves: its variance is σ²/(s(1 − s)) for a share s of the samples in one half and a variance σ² of the mean.
fn gain(frame: &Frame) -> Option<f32> {
    let (halves, noise) = (frame.halves.as_ref()?, frame.noise.as_ref()?);
    let (mut found, mut independent) = (0.0, 0.0);
    let floor = f64::from(floor(frame));
    for (i, share) in halves.shares.iter().enumerate() {
        let scale = f64::from(share * (1.0 - share));
        for c in 0..3 {
            let [a, b] = [0, 1].map(|half| f64::from(halves.means[half][i][c]));
            let variance = f64::from(noise.variance[i][c]);
            // Relative to the radiance, so that lights do not decide, nor pixels that are dark by chance.
            let level = f64::from(frame.radiance[i][c]).powi(2) + variance + floor;
            found += (a - b).powi(2) * scale / level;
            independent += variance / level;
        }
    }
    Some(if independent > 0.0 { (found / independent).clamp(LEAST_GAIN, 1.0) as f32 } else { 1.0 })
}

/// A squared radiance that is invisible: 10⁻⁶ of the squared mean.
fn floor(frame: &Frame) -> f32 {
    let sum: f64 = frame.radiance.iter().map(|radiance| f64::from(luminance(*radiance))).sum();
    let mean = sum / frame.radiance.len().max(1) as f64;
    ((1e-6 * mean * mean) as f32).max(f32::MIN_POSITIVE)
}
