//! Two half images: the means of the first samples of each pixel, and of the rest.
use super::{film::Film, tile::Tile};
use noisefall_base::memory::{self, Reservation, TooMuch};

/// Two images of one render with samples of their own, row by row from the top left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Halves {
    /// Mean radiance of the first samples and of the rest.
    pub means: [Vec<[f32; 3]>; 2],
    /// Fraction of each pixel's samples that are in the first image, from 1/3 to 2/3.
    pub shares: Vec<f32>,
}

impl Halves {
    /// The halves of a film; `None` before the second sample.
    pub(super) fn of_film(film: &Film) -> Option<Halves> {
        let pixels = film.resolution.map(|side| side as usize).iter().product();
        let mut halves = Halves { means: [vec![[0.0; 3]; pixels], vec![[0.0; 3]; pixels]], shares: vec![0.0; pixels] };
        film.tiles.iter().try_for_each(|tile| halves.take(tile, film.resolution[0] as usize))?;
        Some(halves)
    }

    /// Reserves memory for the halves of two frames of this size.
    pub fn reserve([width, height]: [u32; 2]) -> Result<Reservation, TooMuch> {
        const PIXEL: u64 = 2 * 28;
        memory::reserve(format_args!("half images of {width} × {height} pixels"), PIXEL * u64::from(width) * u64::from(height))
    }

    fn take(&mut self, tile: &Tile, width: usize) -> Option<()> {
        for row in 0..tile.size[1] {
            let start = (tile.origin[1] + row) as usize * width + tile.origin[0] as usize;
            for column in 0..tile.size[0] {
                let (means, share) = tile.halves([column, row])?;
                let pixel = start + column as usize;
                self.means.iter_mut().zip(means).for_each(|(image, mean)| image[pixel] = mean);
                self.shares[pixel] = share;
            }
        }
        Some(())
    }
}
