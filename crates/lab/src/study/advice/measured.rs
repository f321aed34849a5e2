//! Noise and time of settings, from several images of each.
use rayon::prelude::*;

use super::{
    missing::missing,
    rounds::{RoundPicture, Series},
};
use crate::study::outcome::ROUNDING;
use noisefall_kernel::measure::Floor;
use noisefall_scene::scene::RenderSettings;

/// Measurements of some settings, by round.
#[derive(Clone, Debug)]
pub struct Measured {
    pub settings: RenderSettings,
    /// Numbers of the rounds.
    pub rounds: Vec<u32>,
    /// Logarithm of the rendering time of each image.
    pub log_seconds: Vec<f64>,
    /// Distance of each image from each earlier one: the mean over pixels and channels of (x − y)²/(m² + 0.01 · mean m²), as in
    /// relMSE, where m is the mean of all images of all settings.
    pub differences: Vec<Vec<f64>>,
    /// The light in the mean of these images, relative to m; about 1.
    pub found: f64,
    /// A lower bound of the relMSE of an image, from light that other settings have found in addition.
    pub missing: f64,
}

/// Compares the images of several settings, which must all converge to the same image.
pub fn measured(series: &[Series]) -> Vec<Measured> {
    let common = mean(series.iter().flat_map(|series| &series.pictures));
    let floor = Floor::DEFAULT.of(common.iter().map(|m| m * m).sum::<f64>() / common.len().max(1) as f64);
    // If no image has light, all distances are 0.
    let weights: Vec<f64> = common.iter().map(|m| 1.0 / (m * m + floor).max(f64::MIN_POSITIVE)).collect();
    let missing = |own: &Series| {
        let by = |other: &Series| missing(own, other, &common, &weights);
        series.par_iter().map(by).reduce(|| 0.0, f64::max)
    };
    series.iter().map(|series| Measured { missing: missing(series), ..Measured::of(series, &common, &weights) }).collect()
}

/// The mean of images, per channel of each pixel.
fn mean<'a>(pictures: impl Iterator<Item = &'a RoundPicture>) -> Vec<f64> {
    let (mut sum, mut count) = (Vec::new(), 0.0);
    for picture in pictures {
        let values = picture.radiance.as_flattened();
        sum.resize(values.len(), 0.0);
        sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += f64::from(*value));
        count += 1.0;
    }
    sum.iter().map(|sum| sum / count).collect()
}

impl Measured {
    fn of(series: &Series, common: &[f64], weights: &[f64]) -> Measured {
        let Series { settings, pictures } = series;
        let difference = |a: &RoundPicture, b: &RoundPicture| {
            let values = a.radiance.as_flattened().iter().zip(b.radiance.as_flattened()).zip(weights);
            let sum: f64 = values.map(|((a, b), weight)| (f64::from(*a) - f64::from(*b)).powi(2) * weight).sum();
            sum / weights.len() as f64
        };
        let before = |i: usize| pictures[..i].iter().map(|other| difference(&pictures[i], other)).collect();
        let own = mean(pictures.iter());
        let along = |picture: &[f64]| picture.iter().zip(common).zip(weights).map(|((x, m), weight)| x * m * weight).sum::<f64>();
        let light = along(common);
        Measured {
            settings: *settings,
            rounds: pictures.iter().map(|picture| picture.round).collect(),
            log_seconds: pictures.iter().map(|picture| picture.seconds.ln()).collect(),
            differences: (0..pictures.len()).into_par_iter().map(before).collect(),
            found: if light > 0.0 { along(&own) / light } else { 1.0 },
            missing: 0.0,
        }
    }

    /// Whether these settings find enough light to be compared.
    pub fn is_sound(&self) -> bool {
        self.found > 0.5 && !self.misses_light()
    }

    /// Whether light that they miss makes up more of their error than their images show.
    pub fn misses_light(&self) -> bool {
        self.missing > self.noise(&self.rounds)
    }

    /// The relMSE of an image, from at least two rounds: half the mean squared difference of two images, because a difference has
    /// twice the variance of one image.
    pub fn rel_mse(&self, rounds: &[u32]) -> f64 {
        let places: Vec<usize> = self.places(rounds).collect();
        let pairs = places.iter().flat_map(|a| places.iter().filter(move |b| *b < a).map(move |b| self.differences[*a][*b]));
        pairs.sum::<f64>() / (places.len() * (places.len() - 1)) as f64
    }

    /// Geometric mean of the rendering time of an image.
    pub fn seconds(&self, rounds: &[u32]) -> f64 {
        let (sum, count) =
            self.places(rounds).fold((0.0, 0.0), |(sum, count), place| (sum + self.log_seconds[place], count + 1.0));
        f64::exp(sum / count)
    }

    /// The relMSE, but at least that of rounding.
    pub fn noise(&self, rounds: &[u32]) -> f64 {
        self.rel_mse(rounds).max(ROUNDING)
    }

    /// Indices of the images of these rounds.
    fn places(&self, rounds: &[u32]) -> impl Iterator<Item = usize> {
        rounds.iter().filter_map(|round| self.rounds.iter().position(|known| known == round))
    }
}
