//! Exact means of a bilinear image's luminance over the cells of a grid, so that no cell with light has the weight 0.
use crate::image::Texels;
use noisefall_base::math::colour::LUMINANCE;

/// The mean over every cell, row by row. The image repeats horizontally; its top and bottom rows continue beyond the edge. The cells
/// divide the `extent` from `start` on of its height.
pub(super) fn cell_means(picture: &Texels, columns: usize, rows: usize, [start, extent]: [f64; 2]) -> Vec<f64> {
    let (width, height) = (picture.width as usize, picture.height as usize);
    let across = cell_texels(width as f64, columns, 0.0);
    let down = cell_texels(height as f64 * extent, rows, height as f64 * start);
    let luminance = |pixel: &[f32; 4]| (0..3).map(|i| f64::from(pixel[i]) * f64::from(LUMINANCE[i])).sum::<f64>();
    // Row by row of texels first, so that no texel is visited twice: the means over the width of every cell.
    let mut narrowed = Vec::with_capacity(columns * height);
    for row in picture.radiance.chunks_exact(width) {
        let row: Vec<f64> = row.iter().map(luminance).collect();
        let mean = |texels: &Vec<(isize, f64)>| {
            texels.iter().map(|(at, weight)| row[at.rem_euclid(width as isize) as usize] * weight).sum::<f64>()
        };
        narrowed.extend(across.iter().map(mean));
    }
    let mut means = Vec::with_capacity(columns * rows);
    for texels in &down {
        let row = |at: isize| at.clamp(0, height as isize - 1) as usize * columns;
        means.extend((0..columns).map(|x| texels.iter().map(|(at, weight)| narrowed[row(*at) + x] * weight).sum::<f64>()));
    }
    means
}

/// For each of `cells` equal cells of `size` texels from `first` on, the texels that contribute to its mean, with their weights.
fn cell_texels(size: f64, cells: usize, first: f64) -> Vec<Vec<(isize, f64)>> {
    let width = size / cells as f64;
    let texels = |cell: usize| {
        let (start, end) = (first + cell as f64 * width, first + (cell + 1) as f64 * width);
        let share = |at: isize| {
            let centre = at as f64 + 0.5;
            (at, (hat_integral(end - centre) - hat_integral(start - centre)) / width)
        };
        let reach = (start - 0.5).floor() as isize..=(end + 0.5).floor() as isize;
        reach.map(share).filter(|(_, share)| *share > 0.0).collect()
    };
    (0..cells).map(texels).collect()
}

/// ∫ max(0, 1 − |s|) ds from −∞ to t, the integral of a texel's weight in linear interpolation.
fn hat_integral(t: f64) -> f64 {
    match t.clamp(-1.0, 1.0) {
        t if t < 0.0 => 0.5 * (1.0 + t) * (1.0 + t),
        t => 1.0 - 0.5 * (1.0 - t) * (1.0 - t),
    }
}
