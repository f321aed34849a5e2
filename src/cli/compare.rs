//! `noisefall compare`: how far one picture is from another.
use std::{
    io::Read,
    path::{Path, PathBuf},
};

use noisefall::{
    file::open_regular,
    image::{PNG, looks_like},
    measure::{Comparison, compare},
    render::image_file::read,
};

use super::{Failure, print};

#[derive(clap::Args)]
pub struct Arguments {
    /// Picture (.exr or .png)
    a: PathBuf,
    /// Reference (.exr or .png)
    b: PathBuf,
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
    if is_png(&arguments.a) != is_png(&arguments.b) {
        eprintln!("note: a PNG is clipped at 1 and rounded to display codes, an EXR is not: they differ by more than noise");
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
    if arguments.json {
        return print(&serde_json::json!(comparison).to_string());
    }
    let Comparison { rmse, rel_mse, bias } = comparison;
    print(&format!("RMSE    {rmse:.6e}\nrelMSE  {rel_mse:.6e}\nbias    {bias:+.6e}"))
}
