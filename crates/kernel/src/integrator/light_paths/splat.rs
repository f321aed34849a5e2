//! Light that arrives in any pixel.
use noisefall_scene::sampling::Filter;

/// Light that a light path brings to the image. The mean over all paths of its filtered sums is the image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splat {
    /// Where it arrives, in pixels from the upper left corner; maybe outside of the image.
    pub place: [f32; 2],
    /// Two random numbers, which choose among the pixels whose filter reaches the place.
    pub u: [f32; 2],
    /// Linear Rec. 709.
    pub light: [f32; 3],
}

impl Splat {
    /// The pixel to which the splat goes, and its light there: one of those whose filter reaches it, in proportion to the filters there.
    /// `None` if it lies outside of the image.
    pub fn land(&self, filter: Filter, [width, height]: [u32; 2]) -> Option<([u32; 2], [f64; 3])> {
        let Splat { place: [x, y], u: [u, v], light } = self;
        let [(column, by_column), (row, by_row)] = [choose(filter, *x, *u)?, choose(filter, *y, *v)?];
        let (column, row) = (u32::try_from(column).ok()?, u32::try_from(row).ok()?);
        let weight = f64::from(by_column * by_row);
        let [r, g, b] = [f64::from(light[0]), f64::from(light[1]), f64::from(light[2])];
        (column < width && row < height).then_some(([column, row], [r * weight, g * weight, b * weight]))
    }
}

/// Chooses among the pixels in a row whose filter reaches `x`, in proportion to their filters there. Returns it with the sum of these
/// filters.
fn choose(filter: Filter, x: f32, u: f32) -> Option<(i32, f32)> {
    let (from_middle, reach) = (x - 0.5, filter.reach());
    // Casts saturate: no pixel lies there.
    let pixels = (from_middle - reach).ceil() as i32..=(from_middle + reach).floor() as i32;
    let density = |pixel: i32| filter.density(from_middle - pixel as f32);
    let sum: f32 = pixels.clone().map(density).sum();
    let mut rest = u * sum;
    let mut chosen = None;
    for pixel in pixels {
        let density = density(pixel);
        if density > 0.0 {
            chosen = Some((pixel, sum));
            if rest < density {
                break;
            }
            rest -= density;
        }
    }
    chosen
}
