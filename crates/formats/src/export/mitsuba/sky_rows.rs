//! Images of all directions for Mitsuba, whose first and last row of texels lie at the poles.
use crate::import::pictures;
use noisefall_scene::{
    image::{Encoding, Texels, read_light_of},
    light::environment::image::Image,
};

use super::context::Export;

impl Export<'_> {
    /// The path of an image with its rows as Mitsuba has them. If it cannot be read, that of the image as it is.
    pub fn sky_image(&mut self, image: &Image) -> String {
        if image.pole_rows {
            return self.new.name(&image.path);
        }
        let resources = self.colors.compiler().resources;
        let picture = read_light_of(&resources.file(&image.path), Encoding::Srgb).ok();
        let bytes = picture.and_then(|picture| pictures::exr(picture.width, 2 * picture.height + 1, &with_pole_rows(&picture)));
        match bytes {
            Some(bytes) => self.new.add("textures", "sky", "exr", bytes),
            None => self.new.name(&image.path),
        }
    }
}

/// 2 n + 1 rows from pole to pole for n rows that each begin half a row from it. Linear interpolation between them gives the same image.
fn with_pole_rows(picture: &Texels) -> Vec<[f32; 3]> {
    let width = picture.width as usize;
    let rows: Vec<&[[f32; 4]]> = picture.radiance.chunks_exact(width).collect();
    let between =
        |a: &[[f32; 4]], b: &[[f32; 4]], column: usize| [0, 1, 2].map(|channel| 0.5 * (a[column][channel] + b[column][channel]));
    let mut pixels = Vec::with_capacity(width * (2 * rows.len() + 1));
    for (place, row) in rows.iter().enumerate() {
        let above = rows[place.saturating_sub(1)];
        pixels.extend((0..width).map(|column| between(above, row, column)));
        pixels.extend((0..width).map(|column| between(row, row, column)));
    }
    pixels.extend(rows.last().into_iter().flat_map(|row| (0..width).map(|column| between(row, row, column))));
    pixels
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::{F, One, V};
    use noisefall_scene::light::environment::image::{EnvironmentImage, SkyTables};

    #[test]
    fn rows_at_the_poles_give_the_same_image() {
        let texel = |i: u32| [(i * i % 7) as f32, (i * 3 % 5) as f32, i as f32, 1.0];
        let picture = Texels { width: 4, height: 3, radiance: (0..12).map(texel).collect() };
        let doubled: Vec<[f32; 4]> = with_pole_rows(&picture).into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect();
        let doubled = Texels { width: 4, height: 7, radiance: doubled };
        let sky = |picture: Texels, pole_rows: bool| EnvironmentImage::new(SkyTables::new(picture, 1.0, pole_rows).into(), 0.0);
        let (ours, theirs) = (sky(picture, false), sky(doubled, true));
        for i in 0..200 {
            let (y, azimuth) = (1.0 - 2.0 * (i as f32 + 0.5) / 200.0, i as f32 * 2.4);
            let r = (1.0 - y * y).sqrt();
            let d = V { x: F(r * azimuth.sin()), y: F(y), z: F(r * azimuth.cos()) };
            let (a, b) = (ours.radiance(One, d), theirs.radiance(One, d));
            assert!((a.x.0 - b.x.0).abs() < 1e-4 && (a.y.0 - b.y.0).abs() < 1e-4 && (a.z.0 - b.z.0).abs() < 1e-4, "{i}");
            assert!(theirs.pdf(One, d).0 > 0.0);
        }
    }
}
