//! Renders a scene file to a PNG.
//!
//!     cargo run --release --example scene_to_png -- scenes/cornell_box.toml cornell_box.png
use std::{env::args_os, error::Error, path::PathBuf};

use noisefall::{Display, Film, Frame, PassJob, SimdLevel, Threads, image_file::save, load};

/// Samples per pixel.
const SPP: u32 = 16;

fn main() -> Result<(), Box<dyn Error>> {
    let mut paths = args_os().skip(1).map(PathBuf::from);
    let (scene, picture) = (paths.next().ok_or("name a scene file")?, paths.next().ok_or("name a PNG to write")?);
    let scene = load(&scene)?;

    let resolution = scene.camera.resolution;
    let mut film = Film::new(resolution);
    // As many threads as there are cores, at the best SIMD level of the processor.
    let threads = Threads::new(0, SimdLevel::best())?;
    let job = PassJob { scene: &scene, rays: &scene.rays(&scene.camera), settings: &scene.settings };
    threads.pass(job, &mut film, SPP, &|| false);

    let frame = Frame::of_film(&film, 0, resolution, resolution);
    save(&frame, Display::default(), "", &picture)?;
    Ok(())
}
