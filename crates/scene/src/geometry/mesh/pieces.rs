//! Pieces of long thin triangles, each with a box of its own.
//!
//! The box of a thin triangle across the axes is almost empty, and many rays enter it for nothing. The boxes of its pieces are
//! smaller by the square of their number (M. Ernst and G. Greiner, "Early split clipping for bounding volume hierarchies", 2007).
//! A triangle may then be in several leaves.
use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::shear::SIZE;
use crate::geometry::{bounds::Bounds, bvh::NONE};
use noisefall_base::memory::{self, Reservation};

/// A triangle is long if the half area of its box is more than this multiple of its own area. A large equilateral one has 4.
const LONG: f32 = 24.0;
/// Long triangles are divided if they have more than this share of the area of all boxes,
const SHARE: f32 = 0.25;
/// and if their boxes are this many times as large as the mesh: a ray through it enters about as many of them.
const CROWD: f32 = 32.0;
/// Number of pieces per triangle, on average at most.
const PIECES: f32 = 6.0;
/// Bytes per triangle of pieces, of their boxes while the tree is built, and of leaves, besides those of whole triangles.
const BYTES: u64 = 900;
/// Number of times that a triangle is halved, at most.
const MOST_HALVINGS: u32 = 6;

/// A piece of a triangle.
#[derive(Clone, Copy)]
pub(super) struct Piece {
    pub triangle: u32,
    pub bounds: Bounds,
}

/// Pieces in the order of their triangles, with room for them and for their leaves.
pub(super) struct Pieces {
    pub pieces: Vec<Piece>,
    pub memory: Reservation,
}

impl Pieces {
    /// The triangles of the pieces in a leaf, each once.
    pub fn triangles(&self, leaf: &[u32]) -> [u32; SIZE] {
        let mut triangles = [NONE; SIZE];
        for place in 0..SIZE {
            let triangle = self.pieces.get(leaf[place] as usize).map_or(NONE, |piece| piece.triangle);
            triangles[place] = if triangles[..place].contains(&triangle) { NONE } else { triangle };
        }
        triangles
    }
}

/// The pieces of `count` triangles; `None` if too few of them are long, or if there is no room.
pub(super) fn pieces(count: usize, corners: impl Fn(u32) -> [[f32; 3]; 3] + Sync) -> Option<Pieces> {
    let bounds = |triangle: u32| Bounds::of_points(corners(triangle));
    let is_long = |triangle: u32| bounds(triangle).surface_area() > 2.0 * LONG * area(corners(triangle));
    let measure = |triangle: u32| Sums::of(&bounds(triangle), is_long(triangle));
    // Sums of chunks, so that they do not depend on the threads.
    let chunk = |first: usize| (first as u32..count.min(first + CHUNK) as u32).map(measure).fold(Sums::EMPTY, Sums::plus);
    let firsts: Vec<usize> = (0..count).step_by(CHUNK).collect();
    let chunks: Vec<Sums> = firsts.into_par_iter().map(chunk).collect();
    let sums = chunks.into_iter().fold(Sums::EMPTY, Sums::plus);
    if !sums.ask_for_pieces() {
        return None;
    }
    let memory = memory::reserve(format_args!("pieces of {count} triangles"), BYTES * count as u64).ok()?;
    // Halving adds up to twice as many pieces as the length asks for.
    let longest = 2.0 * sums.lengths / (PIECES * count as f32);
    let divide = |triangle: u32| {
        let mut pieces = Vec::new();
        let polygon = corners(triangle).map(|corner| Vec3::from(corner).as_dvec3());
        let halvings = if is_long(triangle) { MOST_HALVINGS } else { 0 };
        halve(&polygon, longest, halvings, &mut |polygon| {
            pieces.push(Piece { triangle, bounds: around(polygon) });
        });
        pieces
    };
    let parts: Vec<Vec<Piece>> = (0..count as u32).into_par_iter().map(divide).collect();
    Some(Pieces { pieces: parts.concat(), memory })
}

/// Triangles whose sums are added in a row.
const CHUNK: usize = 4096;

/// Sums over triangles.
#[derive(Clone, Copy)]
struct Sums {
    bounds: Bounds,
    /// Area of their boxes.
    area: f32,
    /// Area of the boxes of long triangles, and the longest edges of those boxes.
    long_area: f32,
    lengths: f32,
}

impl Sums {
    const EMPTY: Sums = Sums { bounds: Bounds::EMPTY, area: 0.0, long_area: 0.0, lengths: 0.0 };

    fn of(bounds: &Bounds, is_long: bool) -> Sums {
        let area = bounds.surface_area();
        let long = if is_long { 1.0 } else { 0.0 };
        let length = bounds.size().into_iter().fold(0.0, f32::max);
        Sums { bounds: *bounds, area, long_area: long * area, lengths: long * length }
    }

    fn plus(self, other: Sums) -> Sums {
        Sums {
            bounds: self.bounds.union(&other.bounds),
            area: self.area + other.area,
            long_area: self.long_area + other.long_area,
            lengths: self.lengths + other.lengths,
        }
    }

    fn ask_for_pieces(&self) -> bool {
        self.long_area > SHARE * self.area && self.long_area > CROWD * self.bounds.surface_area() && self.area.is_finite()
    }
}

fn area(corners: [[f32; 3]; 3]) -> f32 {
    let [a, b, c] = corners.map(Vec3::from);
    0.5 * (b - a).cross(c - a).length()
}

/// Halves a polygon across its longest extent until that is at most `longest`.
fn halve(polygon: &[DVec3], longest: f32, halvings: u32, keep: &mut impl FnMut(&[DVec3])) {
    let (min, max) = extent(polygon);
    let axis = (max - min).max_position();
    if halvings == 0 || (max - min)[axis] <= f64::from(longest) {
        keep(polygon);
        return;
    }
    let middle = 0.5 * (min[axis] + max[axis]);
    for side in [1.0, -1.0] {
        halve(&clipped(polygon, axis, middle, side), longest, halvings - 1, keep);
    }
}

/// The part of a convex polygon on one side of a plane across an axis.
fn clipped(polygon: &[DVec3], axis: usize, middle: f64, side: f64) -> Vec<DVec3> {
    let height = |p: DVec3| side * (middle - p[axis]);
    let mut part = Vec::with_capacity(polygon.len() + 1);
    for (place, &p) in polygon.iter().enumerate() {
        let next = polygon[(place + 1) % polygon.len()];
        let (here, there) = (height(p), height(next));
        if here >= 0.0 {
            part.push(p);
        }
        if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
            let mut crossing = p.lerp(next, here / (here - there));
            crossing[axis] = middle;
            part.push(crossing);
        }
    }
    part
}

fn extent(polygon: &[DVec3]) -> (DVec3, DVec3) {
    let fold = |first: f64, fold: fn(DVec3, DVec3) -> DVec3| polygon.iter().copied().fold(DVec3::splat(first), fold);
    (fold(f64::INFINITY, DVec3::min), fold(f64::NEG_INFINITY, DVec3::max))
}

/// The box around a polygon, rounded outwards. It holds the exact piece: what f64 rounds is far less than a step of f32.
fn around(polygon: &[DVec3]) -> Bounds {
    let (min, max) = extent(polygon);
    let bounds = |corner: DVec3, step: fn(f32) -> f32| corner.as_vec3().to_array().map(step);
    Bounds { min: bounds(min, f32::next_down), max: bounds(max, f32::next_up) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEEDLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [1.0, 1.0, 0.999]];

    #[test]
    fn pieces_cover_a_needle_with_small_boxes() {
        let Pieces { pieces, .. } = pieces(64, |_| NEEDLE).expect("they are long");
        assert_eq!(pieces.len(), 64 * 4, "halved until a third of their length");
        let area: f32 = pieces[..4].iter().map(|piece| piece.bounds.surface_area()).sum();
        assert!(area < 0.26 * Bounds::of_points(NEEDLE).surface_area(), "{area}");
        for step in 0..=1000 {
            let p = Vec3::from(NEEDLE[1]) * (step as f32 / 1000.0);
            let point = Bounds::of_points([p.to_array()]);
            assert!(pieces[..4].iter().any(|piece| piece.bounds.contains(&point)), "{p}");
        }
    }

    #[test]
    fn a_leaf_has_a_triangle_once_however_many_of_its_pieces_it_has() {
        let Pieces { pieces, memory } = pieces(64, |_| NEEDLE).expect("they are long");
        let triangles = Pieces { pieces, memory }.triangles(&[0, 9, 1, 8, 3, NONE, 4, NONE]);
        assert_eq!(triangles, [0, 2, NONE, NONE, NONE, NONE, 1, NONE]);
    }

    #[test]
    fn few_long_triangles_are_left_whole() {
        let square = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
        assert!(pieces(640, |triangle| if triangle % 10 == 0 { NEEDLE } else { square }).is_none(), "few of all");
        assert!(pieces(30, |_| NEEDLE).is_none() && pieces(0, |_| NEEDLE).is_none(), "few");
    }
}
