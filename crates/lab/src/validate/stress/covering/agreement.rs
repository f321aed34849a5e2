//! Whether two estimators agree on the light of a scene.
use super::render::Renderers;
use noisefall_kernel::measure::{Mean, Moments};
use noisefall_scene::scene::{Estimator, RenderSettings, Scene};

/// Images of a first look, and samples per pixel of each. All images have seeds of their own, so any sampler may be used.
const IMAGES: u32 = 24;
const SPP: u32 = 4;
/// The limits of |z| at a first look, and at two more with four times as many images each. Only the last one fails a scene: by chance once
/// in 10⁷ scenes.
pub const LIMITS: [f64; 3] = [2.5, 3.5, 5.5];
/// The part of the variance that one image may have in a last look. The most extreme of 384 normal numbers has 0.03 of it, that of
/// exponential ones 0.08. Beyond, the mean has no known error.
pub const MOST_OF_ONE: f64 = 0.1;
/// Longest paths that are compared; longer ones take time, and have the variance of the roulette.
const CAP: u32 = 6;

/// Whether two estimates of a scene agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Agreement {
    Holds,
    /// They deviate, but one of them rests on so few bright images that this says nothing.
    Unknown,
}

/// An error says by how much two estimates of a scene deviate, if that is beyond the limits.
pub fn agree(renderers: &Renderers, scene: &Scene) -> Result<Agreement, String> {
    let settings = comparable(scene, scene.settings);
    // By chance alone no path meets the sun of a sky.
    let hits_lights = settings.estimator != Estimator::Path || !scene.lights.have_cells();
    let settings = if hits_lights { settings } else { RenderSettings { estimator: Estimator::Light, ..settings } };
    let partner = match settings.estimator {
        Estimator::Mis | Estimator::Auto => Estimator::Light,
        _ => Estimator::Mis,
    };
    let other = RenderSettings { estimator: partner, ..settings };
    let (mut seed, mut deviation) = (0, String::new());
    for (look, limit) in LIMITS.into_iter().enumerate() {
        let images = IMAGES << (2 * look);
        let [a, b] = [(settings, seed), (other, seed + images)]
            .map(|(settings, first)| renderers.means(scene, settings, SPP, first..first + images));
        let (a, b) = (a?, b?);
        let [found, expected] = [mean(&a), mean(&b)];
        let z = found.z_from(expected);
        if z.abs() <= limit {
            return Ok(Agreement::Holds);
        }
        if look + 1 == LIMITS.len() && (has_heavy_tail(&a) || has_heavy_tail(&b)) {
            return Ok(Agreement::Unknown);
        }
        let names = [settings.estimator, partner].map(Estimator::name);
        deviation = format!("{} finds {:.5}, {} {:.5}: {z:+.1} standard errors", names[0], found.mean, names[1], expected.mean);
        seed += 2 * images;
    }
    Err(deviation)
}

fn mean(images: &[f64]) -> Mean {
    let Moments { mean, variance, count, .. } = Moments::of(images.iter().copied());
    Mean { mean, variance_of_mean: variance / count }
}

/// Whether a single image has so much of the variance that the error of the mean is not known.
fn has_heavy_tail(images: &[f64]) -> bool {
    let mean = mean(images).mean;
    let squares = images.iter().map(|image| (image - mean).powi(2));
    squares.clone().fold(0.0, f64::max) > MOST_OF_ONE * squares.sum::<f64>()
}

/// The settings with which the estimators have the same expectation. Light paths alone find light of punctual lights, and in
/// practice that of the sun of a sky, behind mirrors and clear glass. So with these only light that is reflected once is compared, unless
/// all surfaces are diffuse.
fn comparable(scene: &Scene, settings: RenderSettings) -> RenderSettings {
    let cap = settings.max_bounces.map_or(CAP, |cap| cap.min(CAP));
    let compared = RenderSettings { merging: false, max_bounces: Some(cap), ..settings };
    let are_small = !scene.lights.punctual_lights.is_empty() || scene.lights.have_cells();
    let finds_more = are_small && scene.traces_light_paths(&compared);
    if finds_more && !scene.surfaces.stages.iter().all(|stage| stage.is_diffuse()) {
        return RenderSettings { max_bounces: Some(cap.min(1)), ..compared };
    }
    compared
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validate::stress::dice::Dice;

    #[test]
    fn one_bright_image_is_a_heavy_tail_and_usual_noise_is_none() {
        let mut dice = Dice::new("tail", 0);
        let images = IMAGES << (2 * (LIMITS.len() - 1));
        let mut usual: Vec<f64> = (0..images).map(|_| -dice.unit().ln()).collect();
        assert!(!has_heavy_tail(&usual) && !has_heavy_tail(&vec![2.0; usual.len()]));
        usual[7] = 30.0;
        assert!(has_heavy_tail(&usual));
    }
}
