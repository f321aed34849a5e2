//! Images that `noisefall compare` reads.
use std::{io::Read, path::Path};

use noisefall_base::file::open_regular;
use noisefall_render::render::image_file::{Picture, Provenance, provenance, read};
use noisefall_scene::image::{PNG, looks_like};

use super::messages::Failure;

/// An image file and its metadata.
pub struct LoadedImage<'a> {
    pub path: &'a Path,
    pub picture: Picture,
    pub provenance: Provenance,
}

impl LoadedImage<'_> {
    pub fn read(path: &Path) -> Result<LoadedImage<'_>, Failure> {
        let picture = read(path).map_err(|error| error.to_string())?;
        if let Some(i) = picture.radiance.iter().position(|rgb| rgb.iter().any(|c| !c.is_finite())) {
            let (x, y) = (i as u32 % picture.width, i as u32 / picture.width);
            return Err(format!("{}: pixel {x},{y} is not a finite number", path.display()));
        }
        Ok(LoadedImage { path, picture, provenance: provenance(path) })
    }

    pub fn must_be_as_large_as(&self, other: &LoadedImage) -> Result<(), Failure> {
        let [a, b] = [self, other].map(|of| [of.picture.width, of.picture.height]);
        if a == b {
            return Ok(());
        }
        let said = |of: &LoadedImage| format!("{} is {} × {}", of.path.display(), of.picture.width, of.picture.height);
        Err(format!("the images differ in size: {}, {}", said(self), said(other)))
    }
}

/// Whether a file starts with the signature of PNG.
pub fn is_png(path: &Path) -> bool {
    let mut start = [0; 8];
    let read = open_regular(path).and_then(|mut file| file.read_exact(&mut start));
    read.is_ok() && looks_like(&start) == Some(PNG)
}

/// The spread of repeats is their noise: they are renders, and independent. Repeats of one seed have the same noise. Images without
/// noise may be equal if their seeds differ.
pub fn must_be_repeats(repeats: &[&LoadedImage]) -> Result<(), Failure> {
    if let Some(denoised) = repeats.iter().find(|of| of.provenance.is_denoised) {
        return Err(format!("{} is denoised: A and its repeats must be renders without --denoise", denoised.path.display()));
    }
    for (i, a) in repeats.iter().enumerate() {
        for b in &repeats[..i] {
            let seeds = a.provenance.seed.zip(b.provenance.seed);
            if seeds.map_or(a.picture == b.picture, |(a, b)| a == b) {
                let (a, b) = (a.path.display(), b.path.display());
                return Err(format!("{b} and {a} have the same noise: repeats need other seeds (`noisefall render --seed N`)"));
            }
        }
    }
    Ok(())
}
