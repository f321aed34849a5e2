//! The environment as an equirectangular image of all directions: columns are azimuths, rows are polar angles.
//!
//! World space has y up. The top edge (v = 0) is straight up, the bottom edge straight down, and the middle column (u = ½) faces
//! −z with +x to its right, as seen by a camera that looks along −z. An alias table over equal cells of u and v samples a cell by
//! its radiance times solid angle; within a cell the pdf is constant per solid angle.
#[cfg(test)]
mod tests;
mod turn;
mod weights;

use std::{
    f64::consts::{PI, TAU},
    sync::Arc,
};

use fearless_simd_macros::simd;
use glam::DMat3;

use self::{turn::Turn, weights::cell_means};
use super::{Radiant, Surrounding};
use crate::{
    image::{Encoding, Texels, read_light_of},
    light::{ReferencePoint, parameters::IMAGE},
    sampling::AliasTable,
    shape::Transform,
    texture::{Edge, ImageTexture},
};
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Resources, Value},
    math::{
        F, Lanes, Pick, U, V,
        round::floor,
        trig::{sin_cos_turns, turns_of},
    },
};

const MOST_COLUMNS: u32 = 1024;
const MOST_ROWS: u32 = 512;

/// An image of all directions; its centre is at −z.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// The file, relative to the scene.
    pub path: String,
    /// Rotation about the vertical, degrees.
    pub rotate: f64,
    /// Factor of the radiance.
    pub scale: f64,
    /// Whether the first and last rows of texels lie at the poles. Otherwise they lie half a row from them.
    pub pole_rows: bool,
    /// Rotations and mirrorings of the image after `rotate`, from the first to the last. Translations do not matter.
    pub transform: Vec<Transform>,
}

impl Default for Image {
    fn default() -> Self {
        Image { path: String::new(), rotate: 0.0, scale: 1.0, pole_rows: false, transform: Vec::new() }
    }
}

impl Kind for Image {
    const KIND: Parameter = IMAGE;

    fn chosen(&mut self, p: &mut dyn Parameters) {
        self.parameters(p);
    }
}

impl Declare for Image {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const ROTATE: Parameter = Parameter::new("rotate", "Rotation of the image, counter-clockwise seen from above.").unit("°");
        const SCALE: Parameter = Parameter::new("scale", "Factor that multiplies the radiance.");
        const POLE_ROWS: Parameter = Parameter::new(
            "pole_rows",
            "Whether the first and last rows of texels lie at the poles. Otherwise they lie half a row from them.",
        );
        const TRANSFORM: Parameter =
            Parameter::new("transform", "Rotations and mirrorings of the image, applied after `rotate`.");
        p.value(&IMAGE, Value::File(&mut self.path));
        p.number(&ROTATE, &mut self.rotate, Range::FINITE);
        p.number(&SCALE, &mut self.scale, Range::log(1e-12, 1e12));
        p.flag(&POLE_ROWS, &mut self.pole_rows);
        p.list(&TRANSFORM, &mut self.transform);
    }
}

impl Surrounding for Image {
    type Radiant = EnvironmentImage;

    fn compile(&self, resources: &Resources) -> Result<Option<EnvironmentImage>, Problem> {
        let turn = Turn::of(&self.transform)?;
        let file = resources.file(&self.path);
        let tables =
            resources.once("skies", format!("sky {} {:x} {}", file.key(), self.scale.to_bits(), self.pole_rows), || {
                let picture = read_light_of(&file, Encoding::Srgb)
                    .map_err(|error| Problem::at("image", error.to_string(), "this image cannot be used"))?;
                let bytes = SkyTables::bytes([picture.width, picture.height]);
                resources.reserve("image", "the texels and cells of a sky", bytes)?;
                let tables = SkyTables::new(picture, self.scale as f32, self.pole_rows);
                if tables.mean_luminance() == 0.0 {
                    return Err(Problem::at("image", "an environment of zero power: the image is black", "it emits nothing"));
                }
                Ok(tables)
            })?;
        Ok(Some(EnvironmentImage { turn, ..EnvironmentImage::new(tables, self.rotate) }))
    }
}

impl Radiant for EnvironmentImage {
    const HAS_CELLS: bool = true;

    #[inline(always)]
    fn radiance<L: Lanes>(&self, l: L, d: V<L>) -> V<L> {
        self.radiance(l, d)
    }

    #[inline(always)]
    fn sample<L: Lanes>(&self, l: L, _: &ReferencePoint<L>, cell: (F<L>, F<L>), u: (F<L>, F<L>)) -> (V<L>, F<L>) {
        self.sample(l, cell, u)
    }

    #[inline(always)]
    fn pdf<L: Lanes>(&self, l: L, _: &ReferencePoint<L>, wi: V<L>) -> F<L> {
        self.pdf(l, wi)
    }

    #[inline(always)]
    fn sample_inwards<L: Lanes>(&self, l: L, cell: (F<L>, F<L>), u: (F<L>, F<L>)) -> (V<L>, F<L>) {
        self.sample(l, cell, u)
    }

    #[inline(always)]
    fn pdf_inwards<L: Lanes>(&self, l: L, d: V<L>) -> F<L> {
        self.pdf(l, d)
    }

    fn luminance(&self) -> f32 {
        self.tables.mean_luminance
    }

    fn is_same(&self, other: &EnvironmentImage) -> bool {
        let same_turn = match (&self.turn, &other.turn) {
            (Some(a), Some(b)) => a.is_same(b),
            (None, None) => true,
            _ => false,
        };
        same_turn && Arc::ptr_eq(&self.tables, &other.tables) && self.shift.to_bits() == other.shift.to_bits()
    }
}

/// An image at infinity. Radiance in W·sr⁻¹·m⁻², linear Rec. 709.
pub struct EnvironmentImage {
    tables: Arc<SkyTables>,
    /// Offset from an azimuth, in turns from −z towards +x, to u; in [0, 1).
    shift: f32,
    /// Rotation or reflection of the image after the shift.
    turn: Option<Turn>,
}

/// The texels of an [`EnvironmentImage`] and the tables that sample them. They do not depend on its rotation.
pub struct SkyTables {
    picture: ImageTexture,
    /// Where the image begins in v, and how much of it there is, in heights of the image: see [`rows_of`].
    rows_of_picture: [f32; 2],
    /// Numbers of cells, powers of two.
    columns: u32,
    rows: u32,
    cells: AliasTable,
    /// Bounds of each row of cells: see [`row_bounds`].
    bounds: Vec<[f32; 4]>,
    mean_luminance: f32,
}

impl SkyTables {
    /// Builds the tables. `image` holds radiances ([`crate::image::read_light`]), which are multiplied by `scale`. For `pole_rows`, see
    /// [`Image::pole_rows`].
    pub fn new(mut picture: Texels, scale: f32, pole_rows: bool) -> SkyTables {
        for pixel in &mut picture.radiance {
            *pixel = pixel.map(|x| x * scale);
        }
        let columns = picture.width.next_power_of_two().min(MOST_COLUMNS);
        let rows = picture.height.next_power_of_two().clamp(2, MOST_ROWS);
        let bounds: Vec<_> = (0..rows).map(|row| row_bounds(row, rows, columns)).collect();
        let rows_of_picture = rows_of(&picture, pole_rows);
        let mut weights = cell_means(&picture, columns as usize, rows as usize, rows_of_picture);
        for (row, bounds) in weights.chunks_exact_mut(columns as usize).zip(&bounds) {
            row.iter_mut().for_each(|mean| *mean /= f64::from(bounds[3]));
        }
        let power: f64 = weights.iter().sum();
        if power == 0.0 {
            weights.fill(1.0);
        }
        SkyTables {
            picture: ImageTexture::new(picture),
            rows_of_picture: rows_of_picture.map(|x| x as f32),
            columns,
            rows,
            cells: AliasTable::new(&weights),
            bounds,
            mean_luminance: (power / (2.0 * TAU)) as f32,
        }
    }

    /// Memory in bytes of the tables for an image of this size, including that of building it.
    pub fn bytes([width, height]: [u32; 2]) -> u64 {
        /// Bytes of a texel; of a cell in all tables; and of the means of a row of texels over the width of every cell.
        const TEXEL: u64 = 16;
        const CELL: u64 = 64;
        const MEAN: u64 = 8;
        let (width, height) = (u64::from(width), u64::from(height));
        let (columns, rows) = (u64::from(MOST_COLUMNS), u64::from(MOST_ROWS));
        let columns = columns.min(2 * width);
        TEXEL * width * height + CELL * columns * rows.min(2 * height) + MEAN * columns * height
    }

    /// Mean luminance over all directions, computed from the cells; 0 if and only if the image is black.
    pub fn mean_luminance(&self) -> f32 {
        self.mean_luminance
    }
}

impl EnvironmentImage {
    /// Turns the image about +y by `rotate` degrees, counter-clockwise seen from above.
    pub fn new(tables: Arc<SkyTables>, rotate: f64) -> EnvironmentImage {
        EnvironmentImage { tables, shift: (0.5 + rotate % 360.0 / 360.0).rem_euclid(1.0) as f32, turn: None }
    }

    /// The image after a rotation.
    pub fn turned(self, rotation: Option<DMat3>) -> EnvironmentImage {
        EnvironmentImage { turn: rotation.as_ref().and_then(Turn::of_matrix), ..self }
    }

    /// Mean luminance over all directions; 0 if and only if the image is black.
    pub fn mean_luminance(&self) -> f32 {
        self.tables.mean_luminance
    }

    /// Radiance that arrives from the unit direction `d`. A call, as are the two below: scenes under other skies keep their registers.
    #[simd]
    pub fn radiance<L: Lanes>(&self, l: L, d: V<L>) -> V<L> {
        let (u, v) = self.picture_from_world(l, d);
        let [start, extent] = self.tables.rows_of_picture;
        self.tables.picture.colour(l, u, v * extent + start, Edge::Clamp)
    }

    /// Samples a unit direction, and returns it with its pdf per solid angle. `cell` selects the cell, by index and coin; `u`
    /// selects the point in it.
    #[simd]
    pub fn sample<L: Lanes>(&self, l: L, cell: (F<L>, F<L>), u: (F<L>, F<L>)) -> (V<L>, F<L>) {
        let SkyTables { columns, cells, bounds, .. } = &*self.tables;
        let (cell, probability) = cells.sample(l, cell);
        let column = cell & (columns - 1);
        let [start, extent, up, density] = l.rows(bounds, cell >> columns.trailing_zeros());
        // sin²(θ/2) is uniform in solid angle, and exact near the pole that it is measured from.
        let s = start + extent * u.1;
        let y = up * (1.0 - s * 2.0);
        let r = (s * (1.0 - s)).sqrt() * 2.0;
        let azimuth = (column.to_real() + u.0) * (1.0 / *columns as f32) + (1.0 - self.shift);
        let (sin, cos) = sin_cos_turns(azimuth.above(1.0).pick(azimuth - 1.0, azimuth));
        let d = V { x: r * sin, y, z: -(r * cos) };
        let d = if let Some(turn) = &self.turn { turn.to_world(l, d) } else { d };
        (d, probability * density)
    }

    /// Pdf of [`sample`](Self::sample) at the unit direction `d`, per solid angle.
    #[simd]
    pub fn pdf<L: Lanes>(&self, l: L, d: V<L>) -> F<L> {
        let (u, v) = self.picture_from_world(l, d);
        let SkyTables { columns, rows, cells, bounds, .. } = &*self.tables;
        let row = place(v, *rows);
        let [_, _, _, density] = l.rows(bounds, row);
        cells.probability(l, row * *columns + place(u, *columns)) * density
    }

    /// (u, v) in [0, 1]².
    #[inline(always)]
    fn picture_from_world<L: Lanes>(&self, l: L, d: V<L>) -> (F<L>, F<L>) {
        let d = if let Some(turn) = &self.turn { turn.to_image(l, d) } else { d };
        let u = turns_of(-d.z, d.x) + self.shift;
        let u = u.below(1.0).pick(u, u - 1.0);
        let r = (d.x * d.x + d.z * d.z).sqrt();
        (u, turns_of(d.y, r) * 2.0)
    }
}

/// Where an image of all directions begins in the height of its image, and how much of that it takes.
fn rows_of(picture: &Texels, pole_rows: bool) -> [f64; 2] {
    let row = 1.0 / f64::from(picture.height);
    if pole_rows { [0.5 * row, 1.0 - row] } else { [0.0, 1.0] }
}

/// The index of the one of `count` equal parts of [0, 1] that contains `t`.
#[inline(always)]
fn place<L: Lanes>(t: F<L>, count: u32) -> U<L> {
    floor((t * count as f32).min(t.splat((count - 1) as f32))).1
}

/// Bounds of a row of cells: start and extent of sin²(θ/2), with θ measured from the nearer pole; 1 for the upper pole and −1 for
/// the lower one; and the reciprocal of the solid angle of a cell. The number of rows is even.
fn row_bounds(row: u32, rows: u32, columns: u32) -> [f32; 4] {
    let upper = row < rows / 2;
    let from_pole = if upper { row } else { rows - 1 - row };
    let sin_squared = |k: u32| (PI * f64::from(k) / f64::from(2 * rows)).sin().powi(2);
    let (start, end) = (sin_squared(from_pole), sin_squared(from_pole + 1));
    // The height 1 − 2 sin²(θ/2) is cos θ, and dω = dφ d(cos θ).
    let solid_angle = TAU / f64::from(columns) * 2.0 * (end - start);
    [start as f32, (end - start) as f32, if upper { 1.0 } else { -1.0 }, (1.0 / solid_angle) as f32]
}
