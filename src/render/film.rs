//! The film: what a picture's samples add up to.
use super::tile::Tile;
use crate::integrator::TILE;

/// Sums of samples over all pixels, in tiles that each belong to one thread at a time.
pub struct Film {
    pub(super) resolution: [u32; 2],
    pub tiles: Vec<Tile>,
    /// It has been found out where noise is.
    pub(super) is_piloted: bool,
}

impl Film {
    /// An empty film. Its memory is taken by the first sample, tile by tile on the threads that render.
    pub fn new(resolution: [u32; 2]) -> Film {
        let [width, height] = resolution;
        let corners = |side: u32| (0..side).step_by(TILE as usize);
        let tile = |x: u32, y: u32| Tile::new([x, y], [TILE.min(width - x), TILE.min(height - y)]);
        let tiles = corners(height).flat_map(|y| corners(width).map(move |x| tile(x, y))).collect();
        Film { resolution, tiles, is_piloted: false }
    }

    /// An empty film in the memory of this one, if it has the right size.
    pub fn recycled(mut self, resolution: [u32; 2]) -> Film {
        if self.resolution != resolution {
            return Film::new(resolution);
        }
        self.tiles.iter_mut().for_each(Tile::forget);
        self.is_piloted = false;
        self
    }

    /// Samples a pixel: of every pixel, or on average at most where they are spread by noise.
    pub fn spp(&self) -> u32 {
        self.tiles.iter().map(|tile| tile.spp).min().unwrap_or(0)
    }

    /// Samples of all pixels together.
    pub fn samples(&self) -> u64 {
        self.tiles.iter().map(Tile::samples).sum()
    }

    /// Whether samples are spread by noise.
    pub fn is_adaptive(&self) -> bool {
        self.tiles.iter().any(Tile::is_adaptive)
    }

    pub fn invalid_samples(&self) -> u64 {
        self.tiles.iter().map(|tile| tile.invalid).sum()
    }

    /// Rows of tiles from top to bottom.
    pub fn tile_rows(&self) -> impl Iterator<Item = &[Tile]> {
        self.tiles.chunks(self.resolution[0].div_ceil(TILE) as usize)
    }
}
