//! `noisefall compare`: how far one picture is from another, and whether by more than noise.
use std::{
    io::Read,
    path::{Path, PathBuf},
};

use noisefall::{
    file::open_regular,
    image::{PNG, looks_like},
    math::colour::luminance,
    measure::{Comparison, Deviations, compare},
    render::{
        Display, Frame,
        image_file::{Picture, check_target, read, save},
    },
};

use super::{Failure, flip, print, tell};

#[derive(clap::Args)]
pub struct Arguments {
    /// Picture (.exr or .png)
    a: PathBuf,
    /// Reference (.exr or .png)
    b: PathBuf,
    /// Picture of the difference to write: .exr (A less B) or .png (relative luminance, blue for less, red for more)
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Print one line of JSON
    #[arg(long)]
    json: bool,
}

/// By its first bytes, as pictures are read.
fn is_png(path: &Path) -> bool {
    let mut start = [0; 8];
    let read = open_regular(path).and_then(|mut file| file.read_exact(&mut start));
    read.is_ok() && looks_like(&start) == Some(PNG)
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(output) = &arguments.output {
        check_target(output).map_err(|error| error.to_string())?;
    }
    if is_png(&arguments.a) != is_png(&arguments.b) {
        tell("note: a PNG is clipped at 1 and rounded to display codes, an EXR is not: they differ by more than noise");
    }
    let load = |path| read(path).map_err(|error| error.to_string());
    let (a, b) = (load(&arguments.a)?, load(&arguments.b)?);
    if [a.width, a.height] != [b.width, b.height] {
        return Err(format!(
            "the pictures differ in size: {} is {} × {}, {} is {} × {}",
            arguments.a.display(),
            a.width,
            a.height,
            arguments.b.display(),
            b.width,
            b.height
        ));
    }
    for (path, picture) in [(&arguments.a, &a), (&arguments.b, &b)] {
        if let Some(i) = picture.radiance.iter().position(|rgb| rgb.iter().any(|c| !c.is_finite())) {
            let (x, y) = (i as u32 % picture.width, i as u32 / picture.width);
            return Err(format!("{}: pixel {x},{y} is not a finite number", path.display()));
        }
    }
    let comparison = compare(&a.radiance, &b.radiance);
    let (of_a, of_b): (Vec<f64>, Vec<f64>) = (luminances(&a), luminances(&b));
    let differences: Vec<f64> = of_a.iter().zip(&of_b).map(|(a, b)| a - b).collect();
    let deviations = Deviations::of(&differences, a.width as usize);
    let flip = flip::mean_error(&frame(&a, a.radiance.clone()), &frame(&b, b.radiance.clone()));
    let scale = arguments.output.as_deref().map(|path| write_difference(path, &a, &b)).transpose()?.flatten();
    if arguments.json {
        let mut line = serde_json::json!(comparison);
        line["flip"] = serde_json::json!(flip);
        line["bias_in_standard_errors"] = serde_json::json!(deviations.as_ref().map(|deviations| deviations.of_mean));
        line["block_z"] = serde_json::json!(deviations.map(|deviations| deviations.of_blocks));
        return print(&line.to_string());
    }
    print(&text(&comparison, flip, deviations.as_ref()))?;
    match (&arguments.output, scale) {
        (Some(output), Some(scale)) => {
            print(&format!("{}: full colour is a difference of {:.1} %", output.display(), 100.0 * scale))
        }
        (Some(output), None) => print(&format!("{}: A less B", output.display())),
        (None, _) => Ok(()),
    }
}

fn text(comparison: &Comparison, flip: Option<f64>, deviations: Option<&Deviations>) -> String {
    let Comparison { rmse, rel_mse, bias } = comparison;
    let of_mean = deviations.map_or_else(String::new, |deviations| format!("   {:+.2} standard errors", deviations.of_mean));
    let mut lines =
        vec![format!("RMSE    {rmse:.6e}"), format!("relMSE  {rel_mse:.6e}"), format!("bias    {bias:+.6e}{of_mean}")];
    lines.extend(flip.map(|flip| format!("FLIP    {flip:.6}")));
    if let Some((deviations, (worst, rms))) = deviations.and_then(|d| Some((d, d.worst().zip(d.root_mean_square())?))) {
        let count = deviations.of_blocks.len();
        lines.push(format!("blocks  {count} of 32 × 32 pixels: worst z {worst:+.2}, root mean square {rms:.2} (noise alone: 1, where pixels share paths 1.2)"));
    }
    lines.join("\n")
}

fn luminances(picture: &Picture) -> Vec<f64> {
    picture.radiance.iter().map(|rgb| f64::from(luminance(*rgb))).collect()
}

fn frame(like: &Picture, radiance: Vec<[f32; 3]>) -> Frame {
    let (width, height) = (like.width, like.height);
    Frame { width, height, full_resolution: [width, height], radiance, ..Frame::default() }
}

/// Writes A less B; as PNG the relative difference of luminances in colours, whose scale is returned.
fn write_difference(path: &Path, a: &Picture, b: &Picture) -> Result<Option<f64>, Failure> {
    let is_png = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
    let (radiance, scale) = if is_png {
        let pairs = luminances(a).into_iter().zip(luminances(b));
        let relative: Vec<f64> = pairs.map(|(a, b)| (a - b) / (b.abs() + 0.1)).collect();
        let mut sizes: Vec<f64> = relative.iter().map(|x| x.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        let scale = sizes[sizes.len() * 99 / 100].max(1e-9);
        (relative.iter().map(|x| diverging(x / scale)).collect(), Some(scale))
    } else {
        let pairs = a.radiance.iter().zip(&b.radiance);
        (pairs.map(|(a, b)| std::array::from_fn(|c| a[c] - b[c])).collect(), None)
    };
    save(&frame(a, radiance), Display::default(), "{}", path).map_err(|error| error.to_string())?;
    Ok(scale)
}

/// From blue at −1 by white to red at 1, which colour-blind readers tell apart as well; linear display light.
fn diverging(x: f64) -> [f32; 3] {
    const LESS: [f32; 3] = [0.017, 0.125, 0.445];
    const MORE: [f32; 3] = [0.445, 0.017, 0.025];
    let end = if x < 0.0 { LESS } else { MORE };
    let part = x.abs().min(1.0) as f32;
    end.map(|c| 1.0 + (c - 1.0) * part)
}
