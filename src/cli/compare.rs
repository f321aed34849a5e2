//! `noisefall compare`: measures the difference of two images, and whether it exceeds noise.
use std::{path::PathBuf, process::ExitCode};

use noisefall_base::{
    math::colour::luminance,
    memory::{Reservation, TooMuch, reserve},
};
use noisefall_kernel::measure::{Bias, Comparison, Evidence, Floor, compare};
use noisefall_render::render::{
    Display, Frame,
    image_file::{Format, Picture},
};

use serde_json::json;

use super::{
    figures, flip,
    loaded_image::{LoadedImage, is_png, must_be_repeats},
    messages::{Failure, print, tell, wrong_usage},
    options::{floor, format},
    output::Output,
};

const NOTES: &str = "\
The bias is the mean of A − B over pixels and channels. Its standard error comes from the sample variances that `noisefall render` \
writes into EXR files, or from the spread of --repeats. From two images alone it is unknown.

relMSE is the mean over pixels and channels of (a − b)²/(b² + 0.01 · mean b²), or of (a − b)²/(b² + F) with --floor F.";

#[derive(clap::Args)]
#[command(after_help = NOTES)]
pub struct Arguments {
    /// Image (.exr or .png)
    a: PathBuf,
    /// Reference image (.exr or .png)
    b: PathBuf,
    /// Further renders of A with other seeds; their spread gives the standard error of the bias
    #[arg(long, value_name = "FILE", num_args = 1..)]
    repeats: Vec<PathBuf>,
    /// Constant that relMSE adds to the squared reference [default: 0.01 of the mean squared reference]
    #[arg(long, value_name = "F", value_parser = floor, allow_negative_numbers = true)]
    floor: Option<Floor>,
    /// Difference image to write: .exr (A minus B) or .png (relative luminance, blue for less, red for more); - for standard
    /// output
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Format of an image on standard output: png or exr. Files get the format of their extension
    #[arg(long, value_name = "FORMAT", value_parser = format, requires = "output")]
    format: Option<Format>,
    /// Print one line of JSON; on standard error if the image goes to standard output
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let output = match arguments.output.as_deref().map(|path| Output::of(path, arguments.format)).transpose() {
        Ok(output) => output,
        Err(mistake) => return Ok(wrong_usage(&mistake)),
    };
    if let Some(no_image) = output.as_ref().filter(|output| output.format().is_none()) {
        return Ok(wrong_usage(&format!("{no_image}: a difference is an image: the name must end in .png or .exr")));
    }
    output.as_ref().map_or(Ok(()), Output::check)?;
    if is_png(&arguments.a) != is_png(&arguments.b) {
        tell("warning: a PNG is clipped at 1 and rounded to display codes, an EXR is not: they differ by more than noise");
    }
    let (a, b) = (LoadedImage::read(&arguments.a)?, LoadedImage::read(&arguments.b)?);
    a.must_be_as_large_as(&b)?;
    let _memory = room(&a.picture, 2 + arguments.repeats.len()).map_err(|error| error.to_string())?;
    let repeats = arguments.repeats.iter().map(|path| LoadedImage::read(path)).collect::<Result<Vec<_>, _>>()?;
    repeats.iter().try_for_each(|repeat| repeat.must_be_as_large_as(&b))?;
    let all: Vec<&LoadedImage> = std::iter::once(&a).chain(&repeats).collect();
    if !repeats.is_empty() {
        must_be_repeats(&all)?;
    }
    let bias = bias(&all, &b);
    let remarks = remarks(&bias, &all, &b);
    let floor = arguments.floor.unwrap_or(Floor::DEFAULT);
    let (a, b) = (&a.picture, &b.picture);
    let comparison = compare(&a.radiance, &b.radiance, floor);
    let flip = flip::mean_error(&frame(a, a.radiance.clone()), &frame(b, b.radiance.clone()));
    let mut lines = vec![if arguments.json {
        json((&comparison, floor), flip, &bias, &remarks).to_string()
    } else {
        text(&comparison, flip, &bias, &remarks)
    }];
    let Some(output) = output else { return print(&lines[0]).map(|()| ExitCode::SUCCESS) };
    let (difference, scale) = difference(output.format(), a, b, floor);
    let delivered = output.write(&difference, &[], Display::default(), "{}")?;
    if !arguments.json {
        let said = scale.map_or("A minus B".to_owned(), |scale| format!("full colour is a difference of {:.1} %", 100.0 * scale));
        lines.push(format!("{output}: {said}"));
    }
    output.report(&lines.join("\n"))?;
    Ok(delivered)
}

/// Reserves the memory for a number of images of this size and for their difference.
fn room(like: &Picture, pictures: usize) -> Result<Reservation, TooMuch> {
    /// Bytes per pixel: radiance, variances and mean.
    const PICTURE: u64 = 12 + 12 + 8;
    /// Bytes per pixel: two frames with their codes, the difference and its colours.
    const DIFFERENCE: u64 = 2 * (12 + 7) + 12 + 36;
    let [width, height] = [like.width, like.height].map(u64::from);
    let bytes = (PICTURE * pictures as u64 + DIFFERENCE + flip::BYTES_OF_PIXEL) * width * height;
    reserve(format_args!("{pictures} images of {width} × {height} pixels and their difference"), bytes)
}

fn bias(all: &[&LoadedImage], b: &LoadedImage) -> Bias {
    let width = b.picture.width as usize;
    let of_b = b.provenance.noise.as_ref();
    if let [a] = all {
        return Bias::by_samples(&a.picture.radiance, &b.picture.radiance, [a.provenance.noise.as_ref(), of_b], width);
    }
    let pictures: Vec<&[[f32; 3]]> = all.iter().map(|of| of.picture.radiance.as_slice()).collect();
    Bias::by_repeats(&pictures, &b.picture.radiance, of_b, width)
}

/// Notes on the images and on the standard error.
fn remarks(bias: &Bias, all: &[&LoadedImage], b: &LoadedImage) -> Vec<String> {
    let denoised = all.iter().copied().chain([b]).filter(|of| of.provenance.is_denoised);
    let mut remarks: Vec<String> = denoised.map(|of| format!("{} is denoised, and so biased", of.path.display())).collect();
    if bias.evidence == Evidence::None {
        let advice = if all[0].provenance.is_denoised {
            "render it without --denoise"
        } else {
            "render it as EXR, or give --repeats with other seeds"
        };
        remarks.push(format!("the standard error is unknown: {} has no variances; {advice}", all[0].path.display()));
        return remarks;
    }
    if bias.has_heavy_tails {
        remarks.push("few samples make up most of the variance: do not trust the standard error".to_owned());
    }
    if bias.evidence == Evidence::Samples && !bias.is_exact && !all[0].provenance.is_independent {
        remarks.push("the standard error is an upper bound: the error of stratified and Sobol samples is smaller".to_owned());
    }
    if b.provenance.noise.is_none() {
        remarks.push(format!("the error of {} itself is unknown and assumed to be 0", b.path.display()));
    } else if all.iter().any(|a| a.provenance.seed.is_some() && a.provenance.seed == b.provenance.seed) && !bias.is_exact {
        remarks.push("A and B have the same seed: they may share noise, which makes the standard error too large".to_owned());
    }
    remarks
}

fn json((comparison, floor): (&Comparison, Floor), flip: Option<f64>, bias: &Bias, remarks: &[String]) -> serde_json::Value {
    let mut figures = figures::error(Some(comparison), Some(bias));
    let known = (!bias.block_z.is_empty()).then_some(&bias.block_z);
    figures.extend(figures::named([("flip", json!(flip)), ("block_z", json!(known)), ("remarks", json!(remarks))]));
    figures.insert("floor".to_owned(), json!(floor.to_string()));
    figures.into()
}

fn text(comparison: &Comparison, flip: Option<f64>, bias: &Bias, remarks: &[String]) -> String {
    let Comparison { rmse, rel_mse, .. } = comparison;
    let mut lines = vec![format!("RMSE    {rmse:.6e}"), format!("relMSE  {rel_mse:.6e}"), format!("bias    {}", said(bias))];
    lines.extend(flip.map(|flip| format!("FLIP    {flip:.6}")));
    if let Some((worst, rms)) = bias.worst_block().zip(bias.rms_of_blocks()) {
        let count = bias.block_z.len();
        lines.push(format!("blocks  {count} of 32 × 32 pixels: worst z {worst:+.2}, root mean square {rms:.2} (noise alone: 1)"));
    }
    lines.extend(remarks.iter().map(|remark| format!("warning: {remark}")));
    lines.join("\n")
}

/// The bias and its standard error in one line.
fn said(bias: &Bias) -> String {
    let mean = bias.mean;
    match (bias.standard_error, bias.z) {
        (Some(error), Some(z)) => format!("{mean:+.6e} ± {error:.2e}: {z:+.2} standard errors"),
        _ if bias.is_exact && mean.abs() > bias.rounding => format!("{mean:+.6e}   exact samples: not noise"),
        _ if bias.is_exact => format!("{mean:+.6e}   exact samples: no more than rounding"),
        _ => format!("{mean:+.6e}   standard error unknown"),
    }
}

fn frame(like: &Picture, radiance: Vec<[f32; 3]>) -> Frame {
    Frame { width: like.width, height: like.height, radiance, ..Frame::default() }
}

/// A minus B. For a PNG, the relative difference of luminances in colours, and the difference that has full colour.
fn difference(format: Option<Format>, a: &Picture, b: &Picture, floor: Floor) -> (Frame, Option<f64>) {
    if format != Some(Format::Png) {
        let pairs = a.radiance.iter().zip(&b.radiance);
        return (frame(a, pairs.map(|(a, b)| std::array::from_fn(|c| a[c] - b[c])).collect()), None);
    }
    let luminance = |rgb: &[f32; 3]| f64::from(luminance(*rgb));
    let pairs = a.radiance.iter().map(luminance).zip(b.radiance.iter().map(luminance));
    let floor = floor.of_picture(&b.radiance);
    let relative = |(a, b): (f64, f64)| if a == b { 0.0 } else { (a - b) / (b * b + floor).sqrt() };
    let relative: Vec<f64> = pairs.map(relative).collect();
    let mut sizes: Vec<f64> = relative.iter().map(|x| x.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let scale = sizes[sizes.len() * 99 / 100].max(1e-9);
    (frame(a, relative.iter().map(|x| diverging(x / scale)).collect()), Some(scale))
}

/// Linear display colours from blue at −1 through white to red at 1. Colour-blind readers can tell them apart.
fn diverging(x: f64) -> [f32; 3] {
    const LESS: [f32; 3] = [0.017, 0.125, 0.445];
    const MORE: [f32; 3] = [0.445, 0.017, 0.025];
    let end = if x < 0.0 { LESS } else { MORE };
    let part = x.abs().min(1.0) as f32;
    end.map(|c| 1.0 + (c - 1.0) * part)
}
