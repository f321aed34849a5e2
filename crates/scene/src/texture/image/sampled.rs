//! Lookups of an image with any settings.
use std::sync::Arc;

use fearless_simd_macros::simd;

use super::{
    Image, SLOPE,
    mean::{Axis, weighted_sum},
    texels::ImageTexture,
    uv_map::UvMap,
    words::{Channel, TexelFilter, Wrap},
};
use crate::texture::Summary;
use noisefall_base::{
    declare::Problem,
    math::{F, Lanes, One, U, V},
};

/// An image with its settings.
pub struct SampledImage {
    texels: Arc<ImageTexture>,
    channel: Channel,
    wrap_u: Wrap,
    wrap_v: Wrap,
    filter: TexelFilter,
    map: UvMap,
    mean: [f32; 3],
}

impl SampledImage {
    /// Texels with the settings of an image. The texels of opacity hold it as grey. Fails for coordinates far beyond the image.
    pub fn new(texels: Arc<ImageTexture>, image: &Image) -> Result<SampledImage, Problem> {
        let Image { channel, wrap_u, wrap_v, filter, .. } = *image;
        let map = UvMap::new(image)?;
        let mut sampled = SampledImage { texels, channel, wrap_u, wrap_v, filter, map, mean: [0.0; 3] };
        sampled.mean = sampled.mean();
        Ok(sampled)
    }

    /// Its properties besides its colours.
    pub fn summary(&self) -> Summary {
        Summary { mean: self.mean, maximum: self.selected(self.texels.maximum()), steps: self.steps(), lookups: 0 }
    }

    /// The colour at (u, v) of the surface. Any numbers are allowed: NaN and infinity give some colour of the image, or black.
    #[simd]
    pub fn colour<L: Lanes>(&self, l: L, u: F<L>, v: F<L>) -> V<L> {
        let [s, t] = self.map.apply(u, v);
        let colour = match self.filter {
            TexelFilter::Bilinear => self.bilinear(l, s, t),
            TexelFilter::Nearest => self.nearest(l, s, t),
        };
        match self.channel {
            Channel::Rgb => colour,
            Channel::Red | Channel::Alpha => grey(colour.x),
            Channel::Green => grey(colour.y),
            Channel::Blue => grey(colour.z),
        }
    }

    #[inline(always)]
    fn bilinear<L: Lanes>(&self, l: L, s: F<L>, t: F<L>) -> V<L> {
        let [width, height] = self.texels.size();
        let columns = self.wrap_u.neighbours(s, width);
        let rows = self.wrap_v.neighbours(t, height);
        let (upper, lower) = (rows.texels[0] * width, rows.texels[1] * width);
        let ([left, right], [x, y]) = (columns.texels, columns.weights);
        let top = self.texel(l, upper + left) * x + self.texel(l, upper + right) * y;
        let bottom = self.texel(l, lower + left) * x + self.texel(l, lower + right) * y;
        top * rows.weights[0] + bottom * rows.weights[1]
    }

    #[inline(always)]
    fn nearest<L: Lanes>(&self, l: L, s: F<L>, t: F<L>) -> V<L> {
        let [width, height] = self.texels.size();
        let (column, x) = self.wrap_u.nearest(s, width);
        let (row, y) = self.wrap_v.nearest(t, height);
        self.texel(l, row * width + column) * (x * y)
    }

    #[inline(always)]
    fn texel<L: Lanes>(&self, l: L, index: U<L>) -> V<L> {
        let [x, y, z, _] = l.rows(self.texels.texels(), index);
        V { x, y, z }
    }

    /// The mean over the unit square. A channel that is black there, but not everywhere, has that of all texels.
    fn mean(&self) -> [f32; 3] {
        let inside = self.mean_of_square();
        let all = self.selected(self.texels.mean());
        [0, 1, 2].map(|channel| if inside[channel] > 0.0 { inside[channel] } else { all[channel] })
    }

    /// Exact if the coordinates are turned by multiples of 90°; otherwise the mean of a grid of points.
    fn mean_of_square(&self) -> [f32; 3] {
        const SIDE: u16 = 64;
        if let Some([columns, rows]) = self.map.intervals() {
            let [width, height] = self.texels.size();
            let weights = |wrap: Wrap, size: u32, interval: [f64; 2]| Axis { wrap, filter: self.filter, size }.weights(interval);
            let (columns, rows) = (weights(self.wrap_u, width, columns), weights(self.wrap_v, height, rows));
            return self.selected(weighted_sum(self.texels.texels(), &columns, &rows).map(|x| x as f32));
        }
        let centre = |i: u16| F::<One>((f32::from(i) + 0.5) / f32::from(SIDE));
        let mut sum = [0.0; 3];
        for (row, column) in (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| (row, column))) {
            let colour = self.colour(One, centre(column), centre(row)).lane(0);
            (0..3).for_each(|channel| sum[channel] += f64::from(colour[channel]));
        }
        sum.map(|x| (x / f64::from(SIDE).powi(2)) as f32)
    }

    /// The channel of a colour, as grey.
    fn selected(&self, colour: [f32; 3]) -> [f32; 3] {
        match self.channel {
            Channel::Rgb => colour,
            Channel::Red | Channel::Alpha => [colour[0]; 3],
            Channel::Green => [colour[1]; 3],
            Channel::Blue => [colour[2]; 3],
        }
    }

    /// Steps of finite differences of u and of v.
    fn steps(&self) -> [f32; 3] {
        let [width, height] = self.texels.size().map(f64::from);
        let [[a, b, _], [d, e, _]] = self.map.0;
        let step =
            |along_s: f64, along_t: f64| (0.5 / f64::max(along_s.abs() * width, along_t.abs() * height)).min(0.5) as f32 * SLOPE;
        [step(a, d), step(b, e), f32::INFINITY]
    }
}

#[inline(always)]
fn grey<L: Lanes>(x: F<L>) -> V<L> {
    V { x, y: x, z: x }
}
