//! Memory of `noisefall render`, reserved before the render begins.
use noisefall_base::memory::{Reservation, TooMuch};
use noisefall_kernel::integrator::Features;
use noisefall_render::render::{
    checkpoint, denoise,
    film::Film,
    halves::Halves,
    layers::{self, Layer},
};

/// Reserves the memory that an image takes beside that of the worker: for its layers, for the surfaces in them, and for denoising.
/// Fails also if the worker will lack memory: there that would be a failure of the renderer, after some of the work is done.
pub fn reserve(layers: &[Layer], denoises: bool, keeps: bool, resolution: [u32; 2]) -> Result<[Reservation; 3], TooMuch> {
    // The worker reserves these again.
    let _film = Film::reserve(resolution)?;
    let _halves = optional(denoises, || Halves::reserve(resolution))?;
    let _checkpoints = optional(keeps, || checkpoint::reserve(resolution))?;
    let has_bounces = layers.contains(&Layer::Bounces);
    let _second_film = optional(has_bounces, || Film::reserve(resolution))?;
    let _series = optional(has_bounces, || Film::reserve_series(resolution))?;
    let has_surfaces = layers.iter().any(|layer| layer.needs_features());
    Ok([
        layers::reserve(layers, resolution)?,
        optional(has_surfaces, || Features::reserve(resolution))?,
        optional(denoises, || denoise::reserve(resolution))?,
    ])
}

fn optional(is_needed: bool, reserve: impl FnOnce() -> Result<Reservation, TooMuch>) -> Result<Reservation, TooMuch> {
    if is_needed { reserve() } else { Ok(Reservation::none()) }
}
