//! The distribution of z-scores, against the unit normal distribution.
//!
//! They follow it if there is only noise, samples are independent, and colour channels are fully correlated. The distribution is
//! narrower for stratified and Sobol samples, whose error is smaller than their variance suggests, and for uncorrelated channels,
//! whose errors are added as if they were correlated.
use super::z_score::scores;
use crate::render::{frame::Frame, reference::Reference};

/// A histogram of z-scores.
#[derive(Clone, Debug, PartialEq)]
pub struct ZScoreHistogram {
    /// Density of the scores in bins of width [`ZScoreHistogram::WIDTH`] from −[`ZScoreHistogram::END`] to
    /// [`ZScoreHistogram::END`].
    pub density: Vec<f64>,
    /// Fraction of the scores beyond the ends.
    pub beyond: f64,
    /// Mean of the z-scores.
    pub mean: f64,
    /// Standard deviation of the z-scores.
    pub deviation: f64,
}

impl ZScoreHistogram {
    /// Largest absolute z-score of the histogram.
    pub const END: f64 = 5.0;
    /// Width of a bin of the histogram.
    pub const WIDTH: f64 = 0.2;

    /// The histogram of all pixels with a standard error; `None` if there are none, or if the reference has another size.
    pub fn of(frame: &Frame, reference: &Reference) -> Option<ZScoreHistogram> {
        let all: Vec<f64> = scores(frame, reference)?.into_iter().map(f64::from).filter(|z| !z.is_nan()).collect();
        if all.is_empty() {
            return None;
        }
        // Pixels that are wrong without any noise count as beyond, and have no part in the mean.
        let (scores, endless): (Vec<f64>, Vec<f64>) = all.iter().partition(|z| z.is_finite());
        let count = all.len() as f64;
        let mut density = vec![0.0; (2.0 * Self::END / Self::WIDTH).round() as usize];
        let mut beyond = endless.len() as f64 / count;
        for z in &scores {
            match density.get_mut(((z + Self::END) / Self::WIDTH).floor() as usize) {
                Some(bin) if *z >= -Self::END => *bin += 1.0 / (count * Self::WIDTH),
                _ => beyond += 1.0 / count,
            }
        }
        let finite = scores.len().max(1) as f64;
        let mean = scores.iter().sum::<f64>() / finite;
        let deviation = (scores.iter().map(|z| (z - mean).powi(2)).sum::<f64>() / finite).sqrt();
        Some(ZScoreHistogram { density, beyond, mean, deviation })
    }

    /// The middle of a bin.
    pub fn middle(bin: usize) -> f64 {
        (bin as f64 + 0.5) * Self::WIDTH - Self::END
    }

    /// The density of the unit normal distribution.
    pub fn normal(z: f64) -> f64 {
        (-0.5 * z * z).exp() / (2.0 * std::f64::consts::PI).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::{
        film::Film,
        threads::{PassJob, Threads},
    };
    use noisefall_base::math::SimdLevel;
    use noisefall_scene::{
        sampling::Sampler,
        scene::{Camera, Estimator, RenderSettings, Reuse, load},
    };

    #[test]
    fn scores_of_a_true_picture_are_normal_and_those_of_a_capped_one_are_not() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/furnace.toml");
        let scene = load(path.as_ref()).expect("it is shipped");
        let reference = Reference::of(&scene).expect("it says what is true");
        let rays = scene.rays(&Camera { resolution: [128, 128], ..scene.camera });
        let threads = Threads::new(1, SimdLevel::best()).expect("a thread can be had");
        let scores = |max_bounces| {
            let settings = RenderSettings {
                estimator: Estimator::Path,
                sampler: Sampler::Independent,
                reuse: Reuse::Off,
                directions: noisefall_scene::sampling::Directions::Uniform,
                max_bounces,
                ..scene.settings
            };
            let mut film = Film::new([128, 128]);
            threads.pass(PassJob { scene: &scene, rays: &rays, settings: &settings }, &mut film, 1024, &|| false);
            ZScoreHistogram::of(&Frame::of_film(&film, 1, [128, 128], [128, 128]), &reference).expect("it has scores")
        };
        let right = scores(None);
        let total: f64 = right.density.iter().map(|density| density * ZScoreHistogram::WIDTH).sum::<f64>() + right.beyond;
        assert!((total - 1.0).abs() < 1e-9);
        // A mean is correlated with its own standard error where samples are skewed: scores lean by −γ/(2√N), here −0.05.
        assert!(right.mean.abs() < 0.1 && (right.deviation - 1.0).abs() < 0.05, "{right:?}");
        let wrong = scores(Some(4));
        assert!(wrong.mean < -0.3, "{wrong:?}");
    }
}
