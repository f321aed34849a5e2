//! The outcome of one combination: errors, slope and efficiency from its runs.
use super::{
    fit::{Slope, slope},
    labels::label,
    measure::{Checkpoint, Run},
    trial::Group,
};
use noisefall_kernel::measure::{LEAST_EFFECTIVE_SAMPLES, Moments};
use noisefall_scene::scene::{PathReuse, RenderSettings, Reuse};

/// A relMSE below this is rounding in single precision, not noise.
pub const ROUNDING: f64 = 1e-12;
/// Smallest sample count in the fit of the slope.
const LEAST_SPP_OF_FIT: u32 = 4;

/// Whether a combination can be ranked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Eligibility {
    /// It is unbiased, and its image is clearly better than a black one.
    Sound,
    /// It is unbiased, but its last image has more than half the relMSE of a black one: it found too little light to be compared.
    TooNoisy,
    /// It is biased.
    Biased,
}

/// A point of the error curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub spp: u32,
    pub seconds: f64,
    pub rel_mse: f64,
}

/// The mean of the image minus that of the reference, over pixels and channels, at the last checkpoints of the runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanError {
    pub mean: f64,
    /// Standard error from the sample variances, and from those of the reference if they are known; NaN before the second sample.
    /// An upper bound for stratified and Sobol samples.
    pub standard_error: f64,
    /// Few samples make up most of the variance, so the standard error is probably too small.
    pub has_heavy_tails: bool,
}

/// A combination with its measurements.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The settings.
    pub settings: RenderSettings,
    /// Other combinations with the same image.
    pub twins: Vec<RenderSettings>,
    /// Whether it can be ranked.
    pub eligibility: Eligibility,
    /// Why it is biased; empty if it is not.
    pub bias: String,
    /// Bias of the mean.
    pub mean_error: MeanError,
    /// For each run, samples per pixel and the mean squared error over pixels and channels, W²·sr⁻²·m⁻⁴, minus the reference's
    /// own error.
    /// E (x − μ)² = V x + (E x − μ)², so for an unbiased estimate this is the variance of a pixel.
    pub variances: Vec<Vec<(f64, f64)>>,
    /// Path reuse between pixels.
    pub path_reuse: PathReuse,
    /// Whether sampling was adaptive.
    pub adapts: bool,
    /// Means over the runs minus the reference's own error, up to where they come close to it; never empty.
    pub curve: Vec<Point>,
    /// 1/(relMSE · seconds) of each run at the end of the curve.
    pub efficiencies: Vec<f64>,
    /// Slope of the root of relMSE over samples; `None` without noise or with too few points.
    pub slope: Option<Slope>,
    /// Number of samples that were dropped because they were negative or not finite.
    pub invalid_samples: u64,
}

/// The relMSE of the reference itself and of a black image.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    pub floor: f64,
    pub black: f64,
    /// The variance of the reference's mean; 0 if it is exact or unknown.
    pub variance_of_mean: f64,
    /// The reference's mean radiance over pixels and channels.
    pub mean: f64,
}

impl Outcome {
    /// The outcome of runs. There must be at least one, and each must have checkpoints.
    pub fn of(group: Group, runs: &[Run], limits: Limits) -> Outcome {
        let Group { settings, twins } = group;
        let length = comparable(runs, limits.floor);
        let point = |c: &Checkpoint| Point { spp: c.spp, seconds: c.seconds, rel_mse: clear_of(c.rel_mse, limits.floor) };
        let runs_of_points: Vec<Vec<Point>> =
            runs.iter().map(|run| run.checkpoints[..length].iter().map(point).collect()).collect();
        let curve: Vec<Point> = (0..length).map(|i| mean(runs_of_points.iter().map(|run| run[i]))).collect();
        let bias = runs.iter().map(|run| run.bias.clone()).find(|bias| !bias.is_empty()).unwrap_or_default();
        let eligibility = match curve.last() {
            _ if !bias.is_empty() => Eligibility::Biased,
            Some(last) if last.rel_mse < 0.5 * limits.black => Eligibility::Sound,
            _ => Eligibility::TooNoisy,
        };
        let efficiency = |run: &Vec<Point>| run.last().map(|last| 1.0 / (last.rel_mse.max(ROUNDING) * last.seconds));
        Outcome {
            settings,
            twins,
            eligibility,
            bias,
            mean_error: mean_error(runs, limits.variance_of_mean),
            variances: runs.iter().map(|run| variances(&run.checkpoints[..length], limits.floor)).collect(),
            path_reuse: runs[0].path_reuse,
            adapts: runs[0].adapts,
            efficiencies: runs_of_points.iter().filter_map(efficiency).collect(),
            slope: slope(&runs_of_points.iter().map(|run| fitted(run)).collect::<Vec<_>>()),
            curve,
            invalid_samples: runs.iter().map(|run| run.invalid_samples).sum(),
        }
    }

    /// All settings in one line. Names what became of path reuse where the program decided about it.
    pub fn label(&self) -> String {
        let label = label(&self.settings);
        if self.settings.reuse == Reuse::Auto { format!("{label}, {}", self.path_reuse.words()) } else { label }
    }

    /// The last point of the curve.
    pub fn last(&self) -> Point {
        self.curve[self.curve.len() - 1]
    }

    /// Samples per pixel and relMSE after a rendering time in seconds, interpolated linearly between logarithms. `None` before
    /// the first point and after the last one.
    pub fn after(&self, seconds: f64) -> Option<(f64, f64)> {
        let before = self.curve.iter().rposition(|point| point.seconds <= seconds)?;
        let a = self.curve[before];
        if a.seconds == seconds {
            return Some((a.spp.into(), a.rel_mse));
        }
        let b = self.curve.get(before + 1)?;
        let part = (seconds / a.seconds).ln() / (b.seconds / a.seconds).ln();
        let between = |from: f64, to: f64| from * (to / from).powf(part);
        Some((between(a.spp.into(), b.spp.into()), between(a.rel_mse.max(ROUNDING), b.rel_mse.max(ROUNDING))))
    }

    /// Whether the remaining error is rounding.
    pub fn is_exact(&self) -> bool {
        self.last().rel_mse <= ROUNDING
    }

    /// Geometric mean of the efficiency over the runs.
    pub fn efficiency(&self) -> f64 {
        self.log_efficiency().mean.exp()
    }

    /// Moments of the logarithms of efficiency; the variance of a single run is NaN.
    pub fn log_efficiency(&self) -> Moments {
        Moments::of(self.efficiencies.iter().map(|efficiency| efficiency.ln()))
    }

    /// All settings that give this image.
    pub fn alike(&self) -> impl Iterator<Item = &RenderSettings> {
        std::iter::once(&self.settings).chain(&self.twins)
    }
}

/// The number of checkpoints that all runs have and that exceed the reference's own error; at least one, and one if the first is
/// exact.
fn comparable(runs: &[Run], floor: f64) -> usize {
    let is_exact = |run: &Run| run.checkpoints[0].rel_mse <= ROUNDING;
    let shared = if runs.iter().all(is_exact) { 1 } else { runs.iter().map(|run| run.checkpoints.len()).min().unwrap_or(1) };
    let is_clear = |i: usize| runs.iter().all(|run| run.checkpoints[i].rel_mse >= 2.0 * floor);
    (0..shared).rev().find(|i| is_clear(*i)).map_or(1, |last| last + 1)
}

/// rmse² at the checkpoints, reduced by the same factor as relMSE when the reference's own error is subtracted.
fn variances(checkpoints: &[Checkpoint], floor: f64) -> Vec<(f64, f64)> {
    let noisy = checkpoints.iter().filter(|point| tells_a_slope(point.spp, point.rel_mse));
    noisy.map(|point| (f64::from(point.spp), point.rmse.powi(2) * clear_of(point.rel_mse, floor) / point.rel_mse)).collect()
}

/// The bias of the mean over runs, which are independent.
fn mean_error(runs: &[Run], variance_of_reference: f64) -> MeanError {
    let last: Vec<&Checkpoint> = runs.iter().filter_map(|run| run.checkpoints.last()).collect();
    let count = last.len() as f64;
    let of_samples = |point: &Checkpoint| point.bias_standard_error.map_or(f64::NAN, |error| error * error);
    let all: f64 = last.iter().map(|point| of_samples(point)).sum();
    // Σ v²/n adds up over independent images, where n is the effective number of samples.
    let squares: f64 = last.iter().filter_map(|point| Some(of_samples(point).powi(2) / point.effective_samples?)).sum();
    MeanError {
        mean: last.iter().map(|point| point.bias).sum::<f64>() / count,
        standard_error: (all / (count * count) + variance_of_reference).sqrt(),
        has_heavy_tails: squares * LEAST_EFFECTIVE_SAMPLES > all * all,
    }
}

/// Subtracts the independent error of the reference. The result is at least that error, because nothing is known below it.
fn clear_of(rel_mse: f64, floor: f64) -> f64 {
    (rel_mse - floor).max(floor)
}

fn mean(points: impl Iterator<Item = Point>) -> Point {
    let points: Vec<Point> = points.collect();
    let mean = |value: fn(&Point) -> f64| points.iter().map(value).sum::<f64>() / points.len() as f64;
    Point { spp: points[0].spp, seconds: mean(|point| point.seconds), rel_mse: mean(|point| point.rel_mse) }
}

fn tells_a_slope(spp: u32, rel_mse: f64) -> bool {
    spp >= LEAST_SPP_OF_FIT && rel_mse > ROUNDING
}

/// Sample counts and errors for the fit of a slope.
fn fitted(run: &[Point]) -> Vec<(f64, f64)> {
    let noisy = run.iter().filter(|point| tells_a_slope(point.spp, point.rel_mse));
    noisy.map(|point| (f64::from(point.spp), point.rel_mse.sqrt())).collect()
}
