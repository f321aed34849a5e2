//! Triangles of polygons that are not convex.
//!
//! Readers cut each polygon into a fan around its first corner, which is right if all corners can be seen from it. Other polygons are
//! cut ear by ear, in the plane of their mean normal: G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82(6), 1975;
//! the normal is M. E. Newell's (Sutherland, Sproull and Schumacker, "A characterization of ten hidden-surface algorithms", 1974).
//! A simple polygon of n corners has n − 2 triangles in either case, so they replace the fan in its place.
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Polygons with more corners stay fans: the time for ears grows with the square of their number.
const MOST_CORNERS: usize = 10_000;
/// Most comparisons of a corner with a triangle in one file, about a second. Polygons after that stay fans.
const MOST_TESTS: u64 = 1 << 28;
/// Part of a polygon's area by which a triangle of the fan may be reversed: rounding of corners on a line.
const ROUNDING: f64 = 1e-6;

/// The triangles of a polygon with more than three corners: a part of the list of all triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polygon {
    /// The first triangle.
    pub first: u32,
    /// Number of triangles.
    pub count: u32,
}

/// Cuts again the polygons whose fans overlap. `triangles` holds fans, and `place` is the position of an index in it.
pub fn cut(triangles: &mut [[u32; 3]], polygons: &[Polygon], place: impl Fn(u32) -> [f32; 3] + Sync) {
    let place = |corner| DVec3::from(place(corner).map(f64::from));
    let of = |polygon: &Polygon| polygon.first as usize..polygon.first as usize + polygon.count as usize;
    let fans = &*triangles;
    let overlapping: Vec<Polygon> = polygons.par_iter().filter(|polygon| overlaps(&fans[of(polygon)], &place)).copied().collect();
    let mut tests = MOST_TESTS;
    for polygon in &overlapping {
        let fan = &mut triangles[of(polygon)];
        let corners = corners(fan);
        let points = flat(fan, &corners, &place);
        if let Some(ears) = ears(&points, &mut tests) {
            fan.iter_mut().zip(ears).for_each(|(triangle, ear)| *triangle = ear.map(|corner| corners[corner as usize]));
        }
    }
}

/// Twice the area of a polygon times its mean normal.
fn area(fan: &[[u32; 3]], place: &impl Fn(u32) -> DVec3) -> DVec3 {
    fan.iter().map(|triangle| doubled(*triangle, place)).sum()
}

fn doubled(triangle: [u32; 3], place: &impl Fn(u32) -> DVec3) -> DVec3 {
    let [a, b, c] = triangle.map(place);
    (b - a).cross(c - a)
}

/// Whether a triangle of the fan is reversed, and something can be done about it.
fn overlaps(fan: &[[u32; 3]], place: &impl Fn(u32) -> DVec3) -> bool {
    let normal = area(fan, place);
    let least = -ROUNDING * normal.length_squared();
    fan.len() + 2 <= MOST_CORNERS && fan.iter().any(|triangle| doubled(*triangle, place).dot(normal) < least)
}

/// The corners of a fan in their order.
fn corners(fan: &[[u32; 3]]) -> Vec<u32> {
    let [first, second, _] = fan[0];
    [first, second].into_iter().chain(fan.iter().map(|triangle| triangle[2])).collect()
}

/// The corners without the axis that is closest to the normal, counter-clockwise.
fn flat(fan: &[[u32; 3]], corners: &[u32], place: &impl Fn(u32) -> DVec3) -> Vec<DVec2> {
    let normal = area(fan, place);
    let size = normal.abs();
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let [u, v] = if normal[axis] < 0.0 { [v, u] } else { [u, v] };
    corners.iter().map(|corner| place(*corner)).map(|point| DVec2::new(point[u], point[v])).collect()
}

/// Cuts a polygon, counter-clockwise, into ears; `None` if that takes more tests than are left. Where a polygon crosses itself and has
/// no ear, any corner counts as one.
fn ears(points: &[DVec2], tests: &mut u64) -> Option<Vec<[u32; 3]>> {
    let mut ring: Vec<u32> = (0..points.len() as u32).collect();
    let mut ears = Vec::with_capacity(points.len() - 2);
    let (mut at, mut misses) = (1, 0);
    while ring.len() > 3 {
        let length = ring.len();
        let ear = [at + length - 1, at, at + 1].map(|corner| ring[corner % length]);
        *tests = tests.checked_sub(length as u64)?;
        if misses == length || is_ear(ear, &ring, points) {
            ears.push(ear);
            ring.remove(at);
            (at, misses) = (at % (length - 1), 0);
        } else {
            (at, misses) = ((at + 1) % length, misses + 1);
        }
    }
    ears.push([ring[0], ring[1], ring[2]]);
    Some(ears)
}

/// Whether a corner is convex and its triangle holds no other corner of the polygon. Corners at the place of its own do not count:
/// polygons reach their holes along such seams.
fn is_ear(ear: [u32; 3], ring: &[u32], points: &[DVec2]) -> bool {
    let [a, b, c] = ear.map(|corner| points[corner as usize]);
    let side = |from: DVec2, to: DVec2, point: DVec2| (to - from).perp_dot(point - from);
    let is_within = |p: DVec2| p != a && p != b && p != c && side(a, b, p) >= 0.0 && side(b, c, p) >= 0.0 && side(c, a, p) >= 0.0;
    side(a, b, c) > 0.0 && !ring.iter().any(|corner| is_within(points[*corner as usize]))
}
