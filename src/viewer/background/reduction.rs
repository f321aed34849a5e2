//! Reduces images to the pixels of the screen by a box filter in linear light: no line is lost, and noise looks as strong as it is.
use noisefall_base::math::colour::linear_from_srgb;
use noisefall_render::render::{Display, tone::to_srgb};

/// The size of the texture for an image: that of the screen where it has fewer pixels, and never more than `most_side`.
pub fn texture_size(picture: [usize; 2], screen: Option<[u32; 2]>, most_side: usize) -> [usize; 2] {
    let on_screen = screen.map_or(picture, |screen| screen.map(|side| side as usize));
    let mut size = [0, 1].map(|axis| picture[axis].min(on_screen[axis]).max(1));
    let longer = size[0].max(size[1]);
    if longer > most_side.max(1) {
        size = size.map(|side| (side * most_side.max(1) / longer).max(1));
    }
    size
}

/// The means over the areas of `to[0]` × `to[1]` pixels, row by row. Both sizes are width and height; `to` must not be larger.
pub fn averaged(values: &[[f32; 3]], from: [usize; 2], to: [usize; 2]) -> Vec<[f32; 3]> {
    let columns = spans(from[0], to[0]);
    let mut sums = vec![[0.0; 3]; from[0]];
    let mut means = Vec::with_capacity(to[0] * to[1]);
    for row in spans(from[1], to[1]) {
        sums.fill([0.0; 3]);
        for (y, weight) in row.parts() {
            add(&mut sums, &values[y * from[0]..], weight);
        }
        means.extend(columns.iter().map(|column| {
            let mut mean = [[0.0; 3]];
            column.parts().for_each(|(x, weight)| add(&mut mean, &sums[x..], weight));
            mean[0]
        }));
    }
    means
}

/// Averages sRGB codes over areas in linear light.
pub fn averaged_codes(codes: &[[u8; 4]], from: [usize; 2], to: [usize; 2]) -> Vec<[u8; 4]> {
    let table: Vec<f32> = (0..=255).map(|code| linear_from_srgb(f64::from(code) / 255.0) as f32).collect();
    let light: Vec<[f32; 3]> = codes.iter().map(|[r, g, b, _]| [*r, *g, *b].map(|code| table[usize::from(code)])).collect();
    let mut averages = Vec::new();
    to_srgb(&averaged(&light, from, to), Display::default(), &mut averages);
    averages
}

fn add(sums: &mut [[f32; 3]], values: &[[f32; 3]], weight: f32) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum = [0, 1, 2].map(|c| sum[c] + weight * value[c]);
    }
}

/// An interval of pixels, with fractions of the first and of the last one. Its weights add up to 1.
struct Span {
    first: usize,
    last: usize,
    /// The weights of the first, of those between, and of the last.
    weights: [f32; 3],
}

impl Span {
    /// The pixels and their weights.
    fn parts(&self) -> impl Iterator<Item = (usize, f32)> {
        let Span { first, last, weights: [of_first, between, of_last] } = *self;
        (first..=last).map(move |at| match at {
            at if at == first => (at, of_first),
            at if at == last => (at, of_last),
            at => (at, between),
        })
    }
}

/// Divides `from` pixels into `to` intervals of the same length. The ends are fractions of integers, so none is lost by rounding.
fn spans(from: usize, to: usize) -> Vec<Span> {
    let scale = 1.0 / from as f32;
    let span = |i: usize| {
        // In units of 1/to of a pixel.
        let (start, end) = (i * from, (i + 1) * from);
        let (first, last) = (start / to, (end - 1) / to);
        let of_first = end.min((first + 1) * to) - start;
        let of_last = end - start.max(last * to);
        Span { first, last, weights: [of_first, to, of_last].map(|part| part as f32 * scale) }
    };
    (0..to).map(span).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn greys(greys: &[f32]) -> Vec<[f32; 3]> {
        greys.iter().map(|grey| [*grey; 3]).collect()
    }

    #[test]
    fn every_pixel_counts_by_its_area() {
        let row = averaged(&greys(&[0.0, 0.2, 0.4, 0.6, 0.8]), [5, 1], [2, 1]);
        assert!((row[0][0] - 0.16).abs() < 1e-6 && (row[1][1] - 0.64).abs() < 1e-6, "{row:?}");
        let both = averaged(&greys(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), [3, 2], [1, 1]);
        assert!((both[0][2] - 3.5).abs() < 1e-6);
        let same = greys(&[1.0, 2.0, 3.0, 4.0]);
        assert_eq!(averaged(&same, [2, 2], [2, 2]), same);
        // Columns within one pixel of the source, and across two.
        let across = averaged(&greys(&[0.0, 3.0, 0.0]), [3, 1], [2, 1]);
        assert!((across[0][0] - 1.0).abs() < 1e-6 && (across[1][0] - 1.0).abs() < 1e-6, "{across:?}");
    }

    #[test]
    fn no_light_is_lost_at_any_size() {
        for (width, to) in [(1000, 333), (1000, 999), (97, 2), (64, 64), (5, 1)] {
            let values: Vec<[f32; 3]> = (0..width).map(|x| [(x * 7 % 13) as f32; 3]).collect();
            let mean = |values: &[[f32; 3]]| values.iter().map(|v| f64::from(v[0])).sum::<f64>() / values.len() as f64;
            let error = mean(&averaged(&values, [width, 1], [to, 1])) / mean(&values) - 1.0;
            assert!(error.abs() < 1e-5, "{width} {to}: {error}");
        }
    }

    #[test]
    fn codes_are_averaged_as_light() {
        let [black, white] = [[0, 0, 0, 255], [255, 255, 255, 255]];
        assert_eq!(averaged_codes(&[black, white], [2, 1], [1, 1]), [[188, 188, 188, 255]], "half the light of white");
    }

    #[test]
    fn textures_are_as_small_as_the_screen_and_as_the_graphics_card_asks() {
        assert_eq!(texture_size([100, 50], None, 4096), [100, 50]);
        assert_eq!(texture_size([100, 50], Some([40, 20]), 4096), [40, 20]);
        assert_eq!(texture_size([100, 50], Some([400, 200]), 4096), [100, 50], "magnified by the graphics card");
        assert_eq!(texture_size([100, 50], Some([80, 40]), 20), [20, 10]);
        assert_eq!(texture_size([100, 1], None, 10), [10, 1]);
    }
}
