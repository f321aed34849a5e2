//! Checks whether a scene and the program still give the same samples.
use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;

use crate::{
    render::{film::Film, path_reuse::resolved, protocol::RenderRequest, threads::Threads, tile::Tile},
    render_file::{Encode, Header, sha256},
};
use noisefall_kernel::integrator::{TILE, Work};

/// Most tiles of a probe.
const MOST: usize = 8;
/// Stands for the hash of a tile whose samples cannot be traced.
const FAILED: &str = "failed";

/// Traces the first sample of some tiles, spread over the image. Returns their places in the film, and hashes of the radiance.
pub fn probe(request: &RenderRequest, threads: &Threads) -> Vec<(u32, String)> {
    let film = Film::new(request.camera.resolution);
    let count = film.tiles.len().min(MOST);
    let place = |i: usize| if count < 2 { 0 } else { i * (film.tiles.len() - 1) / (count - 1) };
    let places: Vec<usize> = (0..count).map(place).collect();
    let rays = request.scene.rays(&request.camera);
    threads.install(|| {
        let settings = resolved(&request.scene, &rays, &request.settings);
        let hash = |place: usize| {
            let Tile { origin, size, .. } = film.tiles[place];
            let work = Work::tile(&request.scene, &rays, &settings, origin, size, 0);
            // A render that fails here will fail in its passes, which say where.
            let traced = catch_unwind(AssertUnwindSafe(|| threads.trace(&work, |radiance| hash(radiance, size))));
            (place as u32, traced.unwrap_or_else(|_| FAILED.to_owned()))
        };
        places.into_par_iter().map(hash).collect()
    })
}

/// The hash of a sample of a tile; slot = row · [`TILE`] + column.
fn hash(radiance: &[[f32; 4]], [width, height]: [u32; 2]) -> String {
    let mut bytes = Vec::new();
    for row in (0..height).map(|row| (row * TILE) as usize) {
        radiance[row..row + width as usize].iter().for_each(|[r, g, b, _]| [*r, *g, *b].encode(&mut bytes));
    }
    sha256(&bytes)
}

/// Says that the samples are not those of a file; `None` if they are.
pub fn probe_difference(header: &Header, request: &RenderRequest, threads: &Threads) -> Option<String> {
    let now = probe(request, threads);
    if now == header.probe {
        return None;
    }
    let why = match header.program == Header::PROGRAM {
        true => "the scene has changed".to_owned(),
        false => format!("it was rendered by {}, and this is {}", header.program, Header::PROGRAM),
    };
    Some(format!("the first samples differ from those in the file: {why}"))
}
