//! Film, frames and their noise estimates, with known samples.
mod bidirectional;
mod denoise;
mod film;
mod frame;
mod layers;
mod merging;
mod noise;
mod passes;
mod reference;
mod tile;
mod views;

use super::tile::Tile;
use noisefall_kernel::integrator::{BLOCK, TILE};

/// The red of a pixel's sample: no two are equal.
fn red(x: u32, y: u32, sample: u32) -> f32 {
    (x * 1000 + y * 10 + (sample * sample) % 7) as f32
}

/// A sample of a tile's pixels by slot, its channels in the ratio of 1 to 2 to 4.
fn batch(tile: &Tile, sample: u32) -> Vec<[f32; 4]> {
    let slot = |slot: u32| {
        let red = red(tile.origin[0] + slot % TILE, tile.origin[1] + slot / TILE, sample);
        [red, 2.0 * red, 4.0 * red, -1.0]
    };
    (0..TILE * TILE).map(slot).collect()
}

/// Adds samples of every pixel.
fn add(tile: &mut Tile, samples: std::ops::Range<u32>) {
    samples.for_each(|sample| assert_eq!(tile.add(&batch(tile, sample)), None));
}

/// Mean and variance of the mean of the red of some samples.
fn exact(x: u32, y: u32, samples: u32) -> [f64; 2] {
    let n = f64::from(samples);
    let values = (0..samples).map(|sample| f64::from(red(x, y, sample)));
    let mean = values.clone().sum::<f64>() / n;
    [mean, values.map(|value| (value - mean).powi(2)).sum::<f64>() / (n * (n - 1.0))]
}

fn is_about(found: f64, exact: f64) -> bool {
    (found - exact).abs() <= 1e-6 * exact.abs() + 1e-9
}

const _: () = assert!(BLOCK == 8 && TILE == 32);
