//! The variances of an image's means in its EXR file, in a layer that programs which read only R, G and B ignore.
//!
//! | channel | contents |
//! |---|---|
//! | `variance.R`, `variance.G`, `variance.B` | variance of the mean of the pixel's samples |
//! | `variance.block` | variance of the mean over pixels and channels of the pixel's block of 32 × 32 pixels |
use std::{
    io::{BufReader, Seek},
    path::Path,
};

use exr::prelude::{
    AnyChannel, FlatSamples, ImageAttributes, MetaData, ReadChannels, ReadLayers, ReadSpecificChannel, Text,
    attribute::AttributeValue, read,
};
use serde::Deserialize;
use serde_json::Value;

use super::{denoise, frame::Frame};
use noisefall_base::file::open_regular;
use noisefall_kernel::measure::SampleNoise;
use noisefall_scene::{image::embedded_text, sampling::Sampler};

const CHANNELS: [&str; 4] = ["variance.R", "variance.G", "variance.B", "variance.block"];
/// Key of the one attribute with all figures, in its own group of attributes. The order within a group is arbitrary, and the same
/// image should give the same file.
const FIGURES_KEY: &str = "noisefall_noise";
const EFFECTIVE_SAMPLES: &str = "effective_samples";
const BLOCK_DEGREES: &str = "block_degrees";
const REL_MSE: &str = "rel_mse_estimate";

/// Metadata of a file about the render of its image.
#[derive(Clone, Debug, Default)]
pub struct Provenance {
    /// Noise of the image; `None` if the file has no variances.
    pub noise: Option<SampleNoise>,
    /// Estimated relMSE: see [`Frame::rel_mse_estimate`].
    pub rel_mse_estimate: Option<f64>,
    /// Seed of the samples; `None` if the file does not tell.
    pub seed: Option<u64>,
    /// Whether samples are independent, so that variances are exact and not only upper bounds.
    pub is_independent: bool,
    /// Whether the image is denoised, and so biased. PNG files tell this too.
    pub is_denoised: bool,
}

/// The channels of a frame, with its variances if it has any.
pub(super) fn channels(frame: &Frame) -> Vec<AnyChannel<FlatSamples>> {
    let plane = |name: &str, values: Vec<f32>| AnyChannel::new(name, FlatSamples::F32(values));
    let of = |pixels: &[[f32; 3]], c: usize| pixels.iter().map(|rgb| rgb[c]).collect::<Vec<f32>>();
    let mut planes: Vec<_> = ["R", "G", "B"].iter().enumerate().map(|(c, name)| plane(name, of(&frame.radiance, c))).collect();
    if let Some(noise) = &frame.noise {
        let variance: Vec<[f32; 3]> = noise.variance.iter().map(|rgb| rgb.map(|v| kept(f64::from(v)))).collect();
        planes.extend((0..3).map(|c| plane(CHANNELS[c], of(&variance, c))));
        let [width, columns] = [frame.width as usize, (frame.width as usize).div_ceil(SampleNoise::BLOCK)];
        let block = |i: usize| i / width / SampleNoise::BLOCK * columns + i % width / SampleNoise::BLOCK;
        planes.push(plane(CHANNELS[3], (0..frame.radiance.len()).map(|i| kept(noise.blocks[block(i)])).collect()));
    }
    planes
}

/// Converts a variance for the file; a positive one must not become 0.
fn kept(variance: f64) -> f32 {
    if variance > 0.0 { (variance as f32).clamp(f32::MIN_POSITIVE, f32::MAX) } else { 0.0 }
}

/// Adds the figures that the noise layer lacks, as `name=value` separated by spaces.
pub(super) fn add_figures(frame: &Frame, attributes: &mut ImageAttributes) {
    let noise = frame.noise.as_ref();
    let figures = [
        (EFFECTIVE_SAMPLES, noise.map(|noise| noise.effective_samples)),
        (BLOCK_DEGREES, noise.map(|noise| noise.block_degrees)),
        (REL_MSE, frame.rel_mse_estimate),
    ];
    let text = figures.iter().filter_map(|(name, value)| Some(format!("{name}={:?}", (*value)?))).collect::<Vec<_>>().join(" ");
    if !text.is_empty() {
        attributes.other.insert(Text::from(FIGURES_KEY), AttributeValue::Text(Text::from(text.as_str())));
    }
}

/// The metadata of an image file. All is unknown unless it is an EXR by this program, except whether it is denoised.
pub fn provenance(path: &Path) -> Provenance {
    let text = open_regular(path).ok().and_then(embedded_text).unwrap_or_default();
    let settings = serde_json::from_str::<Value>(&text).unwrap_or_default();
    Provenance { is_denoised: denoise::is_denoised(&settings), ..of_exr(path, &settings["settings"]).unwrap_or_default() }
}

/// The metadata of an EXR with these settings.
fn of_exr(path: &Path, settings: &Value) -> Option<Provenance> {
    let mut file = open_regular(path).map(BufReader::new).ok()?;
    let header = MetaData::read_from_buffered(&mut file, false).ok()?.headers.into_iter().next()?;
    let text = |value: Option<&AttributeValue>| {
        if let Some(AttributeValue::Text(text)) = value { text.to_string() } else { String::new() }
    };
    let figures = text(header.own_attributes.other.get(&Text::from(FIGURES_KEY)));
    let number = |name: &str| {
        let value = figures.split(' ').find_map(|figure| figure.strip_prefix(name)?.strip_prefix('='));
        value.and_then(|value| value.parse::<f64>().ok())
    };
    let said = number(EFFECTIVE_SAMPLES).zip(number(BLOCK_DEGREES)).filter(|_| file.rewind().is_ok());
    let noise = said.and_then(|(effective_samples, block_degrees)| {
        let of_pixels = read_noise(file)?;
        let is_sound = effective_samples > 0.0 && block_degrees >= 1.0;
        is_sound.then_some(SampleNoise { effective_samples, block_degrees, ..of_pixels })
    });
    Some(Provenance {
        noise,
        rel_mse_estimate: number(REL_MSE),
        seed: settings["seed"].as_u64(),
        is_independent: Sampler::deserialize(&settings["sampler"]).is_ok_and(Sampler::is_independent),
        is_denoised: false,
    })
}

fn read_noise(file: BufReader<std::fs::File>) -> Option<SampleNoise> {
    let [r, g, b, block] = CHANNELS;
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required(r)
        .required(g)
        .required(b)
        .required(block)
        .collect_pixels(
            |size, _| (size.width(), vec![[0f32; 4]; size.area()]),
            |(width, pixels), at, (r, g, b, block): (f32, f32, f32, f32)| pixels[at.y() * *width + at.x()] = [r, g, b, block],
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(file)
        .ok()?;
    let (width, pixels) = image.layer_data.channel_data.pixels;
    let first_of_blocks = pixels.chunks(width).step_by(SampleNoise::BLOCK).flat_map(|row| row.iter().step_by(SampleNoise::BLOCK));
    let blocks: Vec<f64> = first_of_blocks.map(|[.., block]| f64::from(*block)).collect();
    let variance: Vec<[f32; 3]> = pixels.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
    let is_variance = |v: f64| (0.0..=f64::from(f32::MAX)).contains(&v);
    let all = blocks.iter().copied().chain(variance.as_flattened().iter().map(|v| f64::from(*v)));
    let are_variances = { all }.all(is_variance);
    are_variances.then(|| SampleNoise { width: width as u32, variance, blocks, ..SampleNoise::default() })
}
