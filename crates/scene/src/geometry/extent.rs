//! Bounding spheres and boxes of shapes, static and in motion.
use std::f64::consts::TAU;

use glam::{DAffine3, DMat3, DVec3, Vec3};

use super::{Motion, Outline, Shape, TransformStep, bounds::Bounds};

/// Number of intervals at whose ends motion is evaluated to bound it.
const POSES: u32 = 128;

/// A box in f64.
#[derive(Clone, Copy)]
struct Extent {
    min: DVec3,
    max: DVec3,
}

impl Extent {
    const EMPTY: Extent = Extent { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    fn around(center: DVec3, reach: DVec3) -> Extent {
        Extent { min: center - reach, max: center + reach }
    }

    fn of_points(points: impl IntoIterator<Item = DVec3>) -> Extent {
        points.into_iter().fold(Extent::EMPTY, |all, p| all.union(&Extent { min: p, max: p }))
    }

    fn union(&self, other: &Extent) -> Extent {
        Extent { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Rounds to f32, and widens by more than the rounding of the contents.
    fn widened(&self, by: f64) -> Bounds {
        const OF_SIZE: f64 = 4e-6;
        const OF_PLACE: f64 = 4.0 * f32::EPSILON as f64;
        let size = self.max - self.min;
        // Of the farthest coordinate: turning mixes them.
        let place = self.min.abs().max(self.max.abs()).max_element();
        let margin = DVec3::splat(size.max_element() * OF_SIZE + place * OF_PLACE + by);
        Bounds { min: (self.min - margin).as_vec3().to_array(), max: (self.max + margin).as_vec3().to_array() }
    }
}

impl Shape {
    /// The bounding box of the shape over its whole motion, including rounding.
    pub fn bounds(&self, motion: &Motion) -> Bounds {
        let all = self.poses(motion).map(|pose| pose.extent()).fold(Extent::EMPTY, |all, extent| all.union(&extent));
        all.widened(self.way_between_poses(motion) + self.rounding())
    }

    /// Centre and radius of the bounding sphere over the whole motion, including rounding if it moves.
    pub fn swept_sphere(&self, motion: &Motion) -> (DVec3, f64) {
        if motion.0.is_empty() {
            return self.bounding_sphere();
        }
        let spheres: Vec<_> = self.poses(motion).map(|pose| pose.bounding_sphere()).collect();
        let center = spheres.iter().map(|(center, _)| *center).sum::<DVec3>() / spheres.len() as f64;
        let radius = spheres.iter().map(|(c, r)| c.distance(center) + r).fold(0.0, f64::max);
        let rounding = (center.length() + radius) * 8.0 * f64::from(f32::EPSILON);
        (center, radius + self.way_between_poses(motion) + rounding + self.rounding())
    }

    /// Upper bound of the rounding error of the transform from local to world space.
    fn rounding(&self) -> f64 {
        const ROUNDINGS: f64 = 8.0 * f32::EPSILON as f64;
        match self {
            Shape::Mesh { map, .. } | Shape::Isosurface { map, .. } => map.translation.length() * ROUNDINGS,
            _ => 0.0,
        }
    }

    /// Upper bound of the distance of any point of the moving shape from the origin.
    pub fn reach(&self, motion: &Motion) -> f64 {
        let (center, radius) = self.bounding_sphere();
        let reach = center.length() + radius;
        reach + longest_way(reach, motion, 1.0)
    }

    /// The shape at [`POSES`] + 1 times, or once if it is static.
    fn poses(&self, motion: &Motion) -> impl Iterator<Item = Shape> {
        let last = if motion.0.is_empty() { 0 } else { POSES };
        (0..=last).map(|i| self.transformed(&motion.at(f64::from(i) / f64::from(POSES))))
    }

    /// Upper bound of the distance of a point from its position at the nearer one of two poses.
    fn way_between_poses(&self, motion: &Motion) -> f64 {
        let (center, radius) = self.bounding_sphere();
        longest_way(center.length() + radius, motion, 1.0 / f64::from(2 * POSES))
    }

    fn extent(&self) -> Extent {
        match self {
            Shape::Sphere { center, radius, .. } => Extent::around(*center, DVec3::splat(*radius)),
            Shape::Ellipsoid { center, axes } => Extent::around(*center, ellipse_reach(axes)),
            Shape::Flat { outline: Outline::Ellipse, origin, edges: [a, b], .. } => {
                Extent::around(*origin, ellipse_reach(&DMat3::from_cols(*a, *b, DVec3::ZERO)))
            }
            Shape::Flat { outline, origin: o, edges: [a, b], .. } => {
                let corners = [*o, *o + *a, *o + *b, *o + *a + *b];
                Extent::of_points(corners.into_iter().take(if *outline == Outline::Triangle { 3 } else { 4 }))
            }
            Shape::Cuboid { origin, edges } => of_box(DVec3::ZERO, DVec3::ONE, &DAffine3::from_mat3_translation(*edges, *origin)),
            Shape::Cylinder { base, axes, .. } => {
                let reach = ellipse_reach(&DMat3::from_cols(axes.x_axis, axes.y_axis, DVec3::ZERO));
                Extent::around(*base, reach).union(&Extent::around(*base + axes.z_axis, reach))
            }
            Shape::Mesh { boxes, map, .. } => {
                let image = |bounds: &Bounds| of_box(Vec3::from(bounds.min).as_dvec3(), Vec3::from(bounds.max).as_dvec3(), map);
                boxes.iter().map(image).fold(Extent::EMPTY, |all, extent| all.union(&extent))
            }
            Shape::Isosurface { surface, map } => {
                let (min, max) = surface.bounds();
                of_box(Vec3::from(min).as_dvec3(), Vec3::from(max).as_dvec3(), map)
            }
        }
    }

    /// Centre and radius of a bounding sphere.
    pub fn bounding_sphere(&self) -> (DVec3, f64) {
        match self {
            Shape::Sphere { center, radius, .. } => (*center, *radius),
            Shape::Ellipsoid { center, axes } => (*center, longest(axes)),
            Shape::Flat { outline: Outline::Ellipse, origin, edges, .. } => {
                (*origin, longest(&DMat3::from_cols(edges[0], edges[1], DVec3::ZERO)))
            }
            Shape::Flat { outline, origin, edges: [a, b], .. } => {
                let center = match outline {
                    Outline::Triangle => *origin + (*a + *b) / 3.0,
                    Outline::Parallelogram | Outline::Ellipse => *origin + (*a + *b) / 2.0,
                };
                let corners = [*origin, *origin + *a, *origin + *b, *origin + *a + *b];
                let count = if *outline == Outline::Triangle { 3 } else { 4 };
                (center, corners[..count].iter().map(|corner| corner.distance(center)).fold(0.0, f64::max))
            }
            Shape::Cuboid { origin, edges } => {
                let half = |signs: [f64; 2]| (edges.x_axis + edges.y_axis * signs[0] + edges.z_axis * signs[1]).length() / 2.0;
                let diagonals = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(half);
                (*origin + *edges * DVec3::splat(0.5), diagonals.into_iter().fold(0.0, f64::max))
            }
            Shape::Cylinder { base, axes, .. } => {
                let round = longest(&DMat3::from_cols(axes.x_axis, axes.y_axis, DVec3::ZERO));
                (*base + axes.z_axis / 2.0, round + axes.z_axis.length() / 2.0)
            }
            Shape::Mesh { boxes, map, .. } => around(boxes, map),
            Shape::Isosurface { surface, map } => {
                let (min, max) = surface.bounds();
                around(&[Bounds { min, max }], map)
            }
        }
    }

    /// The least and the greatest corner of the bounding box.
    pub fn corners(&self) -> [DVec3; 2] {
        let Extent { min, max } = self.extent();
        [min, max]
    }

    /// Extent along the world axes.
    pub(super) fn size(&self) -> DVec3 {
        let Extent { min, max } = self.extent();
        max - min
    }
}

/// A bounding sphere of the images of boxes under a map.
fn around(boxes: &[Bounds], map: &DAffine3) -> (DVec3, f64) {
    let corners = boxes.iter().flat_map(|Bounds { min, max }| {
        (0..8).map(|corner| {
            let at = |axis: usize| f64::from(if corner >> axis & 1 == 0 { min[axis] } else { max[axis] });
            map.transform_point3(DVec3::new(at(0), at(1), at(2)))
        })
    });
    let Extent { min, max } = Extent::of_points(corners.clone());
    let center = (min + max) / 2.0;
    (center, corners.map(|corner| corner.distance(center)).fold(0.0, f64::max))
}

/// The largest singular value, the length of the longest image of a unit vector; never too small, and too large by at most 10⁻⁶.
pub(super) fn longest(axes: &DMat3) -> f64 {
    // The greatest eigenvalue λ of G = AᵀA is below the n-th root of the trace of Gⁿ, which is below 3 λⁿ; n is 2²⁰.
    const SQUARINGS: i32 = 20;
    let mut power = axes.transpose() * *axes;
    let mut log = 0.0;
    for squaring in 0..=SQUARINGS {
        if squaring > 0 {
            power *= power;
            log *= 2.0;
        }
        let trace = power.x_axis.x + power.y_axis.y + power.z_axis.z;
        power *= 1.0 / trace;
        log += trace.ln();
    }
    (log / 2f64.powi(SQUARINGS + 1)).exp()
}

/// Half the extent of the image of the unit sphere along the world axes.
fn ellipse_reach(axes: &DMat3) -> DVec3 {
    let rows = axes.transpose();
    DVec3::new(rows.x_axis.length(), rows.y_axis.length(), rows.z_axis.length())
}

/// The bounding box of the image of a box under a map.
fn of_box(min: DVec3, max: DVec3, map: &DAffine3) -> Extent {
    let half = map.matrix3 * DMat3::from_diagonal((max - min) / 2.0);
    let reach = half.x_axis.abs() + half.y_axis.abs() + half.z_axis.abs();
    Extent::around(map.transform_point3((min + max) / 2.0), reach)
}

/// Upper bound of the path length of a point within `reach` of the origin in a fraction of the time, at its greatest speed.
fn longest_way(mut reach: f64, motion: &Motion, time: f64) -> f64 {
    let size = |matrix: &DMat3| matrix.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut way = 0.0;
    for step in &motion.0 {
        // The step multiplies ways by at most `factor`, and adds two: one that all points go, one in proportion to their reach.
        let (factor, of_all, of_reach) = match step {
            TransformStep::Translate(by) => (1.0, by.length(), 0.0),
            // However often it goes round, it is never farther than on the other side.
            TransformStep::Rotate { turns, .. } => (1.0, 0.0, (turns.count() * TAU).min(2.0 / time)),
            TransformStep::Scale(factors) => {
                (factors.abs().max_element().max(1.0), 0.0, (*factors - DVec3::ONE).abs().max_element())
            }
            TransformStep::Matrix(map) => {
                (size(&map.matrix3).max(1.0), map.translation.length(), size(&(map.matrix3 - DMat3::IDENTITY)))
            }
        };
        way = way * factor + of_all * time + reach * of_reach * time;
        reach = reach * factor + of_all;
    }
    way
}
