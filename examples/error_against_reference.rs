//! Measures the error of a render against an exact solution while the sample count doubles.
//!
//!     cargo run --release --example error_against_truth
//!
//! The scene is a furnace: inside a closed sphere that emits 1 and reflects half, the radiance is exactly 2. Every line at
//! least halves relMSE on average, and the bias stays within a few standard errors.
#![allow(clippy::print_stdout, reason = "the figures are printed for the reader")]
use std::error::Error;

use noisefall::{Camera, Film, Frame, PassJob, Reference, SimdLevel, Threads, parse};

const RESOLUTION: [u32; 2] = [128, 128];

fn main() -> Result<(), Box<dyn Error>> {
    let scene = parse("furnace.toml", include_str!("../scenes/furnace.toml").to_owned())?;
    let camera = Camera { resolution: RESOLUTION, ..scene.camera };
    let truth = Reference::of(&scene).ok_or("the scene has no truth")?;

    let threads = Threads::new(0, SimdLevel::best())?;
    let job = PassJob { scene: &scene, rays: &scene.rays(&camera), settings: &scene.settings };
    // The film keeps its samples; a pass adds those that are missing.
    let mut film = Film::new(RESOLUTION);
    println!("samples  relMSE    bias ± standard error");
    for spp in (1..=6).map(|power| 1 << power) {
        threads.pass(job, &mut film, spp, &|| false);
        let frame = Frame::of_film(&film, 0, RESOLUTION, RESOLUTION);
        let (error, bias) = truth.compare(&frame).zip(truth.bias(&frame)).ok_or("the truth has another resolution")?;
        let standard_error = bias.standard_error.unwrap_or(f64::NAN);
        println!("{spp:7}  {:.2e}  {:+.1e} ± {standard_error:.1e}", error.rel_mse, bias.mean);
    }
    Ok(())
}
