//! Reference intersections by textbook formulas in f64. The kernel is tested against them and shares no code with them.
use std::f64::consts::PI;

use glam::{DMat3, DVec3, Vec3};

use super::{Outline, Shape};

/// An intersection of a ray with a piece.
#[derive(Clone, Copy, Debug)]
pub struct Intersection {
    /// Distance along the ray, in units of its direction.
    pub t: f64,
    /// Distance inside the outline of the piece, relative to its size; negative outside.
    pub margin: f64,
    /// |cos θ| to the normal.
    pub cos: f64,
    /// Distance in metres by which the ray could shift sideways and still hit the piece.
    pub clearance: f64,
}

/// All intersections of o + td with the pieces of a shape, including those that miss the outline by less than `slack`.
pub fn intersections(shape: &Shape, o: DVec3, d: DVec3, slack: f64) -> Vec<Intersection> {
    let mut found: Vec<Intersection> = pieces(shape).iter().flat_map(|piece| intersections_of(piece, o, d)).collect();
    found.retain(|intersection| intersection.margin > -slack && intersection.t.is_finite());
    found.sort_by(|a, b| a.t.total_cmp(&b.t));
    found
}

/// The flat and quadric pieces: the triangles of a mesh, none of an isosurface.
pub fn pieces(shape: &Shape) -> Vec<Shape> {
    match shape {
        Shape::Mesh { data, map, .. } => {
            let corner = |id: u32| map.transform_point3(Vec3::from(data.vertices[id as usize]).as_dvec3());
            let triangle = |ids: &[u32; 3]| {
                let [a, b, c] = ids.map(corner);
                Shape::Flat { outline: Outline::Triangle, origin: a, edges: [b - a, c - a], mirrored: false }
            };
            data.triangles.iter().map(triangle).collect()
        }
        Shape::Isosurface { .. } => Vec::new(),
        _ => shape.pieces(),
    }
}

/// The distance of a point from a piece, in metres; to first order for quadrics and disks.
pub fn distance(piece: &Shape, p: DVec3) -> f64 {
    match piece {
        Shape::Sphere { center, radius, .. } => (p.distance(*center) - radius).abs(),
        Shape::Ellipsoid { center, axes } => from_quadric(*center, axes, false, p),
        Shape::Cylinder { base, axes, .. } => from_quadric(*base, axes, true, p),
        Shape::Flat { outline: Outline::Ellipse, origin, edges: [e, f], .. } => {
            let place = in_plane(*origin, [*e, *f], p);
            place.z.abs() + (place.truncate().length() - 1.0).max(0.0) * e.length().max(f.length())
        }
        Shape::Flat { outline, origin, edges: [e, f], .. } => {
            let place = in_plane(*origin, [*e, *f], p);
            let corners = match outline {
                Outline::Triangle => vec![*origin, *origin + *e, *origin + *f],
                _ => vec![*origin, *origin + *e, *origin + *e + *f, *origin + *f],
            };
            let edges = corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| from_segment(*a, *b, p));
            if margin(*outline, place) >= 0.0 { place.z.abs() } else { edges.fold(f64::INFINITY, f64::min) }
        }
        _ => unreachable!("not an analytic piece"),
    }
}

/// A point of a piece at the parameters (a, b) in [0, 1]².
pub fn point_at(piece: &Shape, [a, b]: [f64; 2]) -> DVec3 {
    let on_sphere = || {
        let (z, phi) = (2.0 * a - 1.0, 2.0 * PI * b);
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * phi.cos(), r * phi.sin(), z)
    };
    match piece {
        Shape::Sphere { center, radius, .. } => *center + on_sphere() * *radius,
        Shape::Ellipsoid { center, axes } => *center + *axes * on_sphere(),
        Shape::Flat { outline, origin, edges: [e, f], .. } => {
            let (s, t) = match outline {
                Outline::Triangle if a + b > 1.0 => (1.0 - a, 1.0 - b),
                Outline::Parallelogram | Outline::Triangle => (a, b),
                Outline::Ellipse => (a.sqrt() * (2.0 * PI * b).cos(), a.sqrt() * (2.0 * PI * b).sin()),
            };
            *origin + *e * s + *f * t
        }
        Shape::Cylinder { base, axes, .. } => *base + *axes * DVec3::new((2.0 * PI * b).cos(), (2.0 * PI * b).sin(), a),
        _ => unreachable!("not an analytic piece"),
    }
}

fn from_segment(a: DVec3, b: DVec3, p: DVec3) -> f64 {
    let share = (p - a).dot(b - a) / (b - a).length_squared();
    p.distance(a + (b - a) * share.clamp(0.0, 1.0))
}

fn intersections_of(piece: &Shape, o: DVec3, d: DVec3) -> Vec<Intersection> {
    match piece {
        Shape::Sphere { center, radius, .. } => quadric(*center, DMat3::from_diagonal(DVec3::splat(*radius)), false, o, d),
        Shape::Ellipsoid { center, axes } => quadric(*center, *axes, false, o, d),
        Shape::Cylinder { base, axes, .. } => quadric(*base, *axes, true, o, d),
        Shape::Flat { outline, origin, edges: [e, f], .. } => {
            let n = e.cross(*f).normalize();
            let t = (*origin - o).dot(n) / d.dot(n);
            let margin = margin(*outline, in_plane(*origin, [*e, *f], o + d * t));
            // The lesser height over an edge.
            let height = e.cross(*f).length() / e.length().max(f.length());
            // Aside by a metre, a ray at the angle θ meets the plane 1/cos θ metres farther on.
            let cos = d.dot(n).abs();
            vec![Intersection { t, margin, cos, clearance: margin * height * cos }]
        }
        _ => unreachable!("not an analytic piece"),
    }
}

/// Coordinates along both edges, and height above their plane in metres.
fn in_plane(origin: DVec3, [e, f]: [DVec3; 2], p: DVec3) -> DVec3 {
    DMat3::from_cols(e, f, e.cross(f).normalize()).inverse() * (p - origin)
}

fn margin(outline: Outline, place: DVec3) -> f64 {
    match outline {
        Outline::Parallelogram => place.x.min(1.0 - place.x).min(place.y).min(1.0 - place.y),
        Outline::Triangle => place.x.min(place.y).min(1.0 - place.x - place.y),
        Outline::Ellipse => 1.0 - place.truncate().length(),
    }
}

fn weight(cylinder: bool) -> DVec3 {
    if cylinder { DVec3::new(1.0, 1.0, 0.0) } else { DVec3::ONE }
}

fn quadric(origin: DVec3, axes: DMat3, cylinder: bool, o: DVec3, d: DVec3) -> Vec<Intersection> {
    let g = axes.inverse();
    let (y, e) = (g * (o - origin), g * d);
    let weight = weight(cylinder);
    let (a, b, c) = (e.dot(e * weight), y.dot(e * weight), y.dot(y * weight) - 1.0);
    // A discriminant from the nearest point: b² − ac cancels far away.
    let nearest = (y - e * (b / a)) * weight;
    let discriminant = a * (1.0 - nearest.length_squared());
    let depth = (1.0 - nearest.length()) * thinnest(axes, cylinder);
    if discriminant < 0.0 || a == 0.0 {
        // A miss, told as a place outside; one that rounding may turn into a tangent.
        let outside = 1.0 - nearest.length();
        return vec![Intersection { t: -b / a, margin: outside, cos: if outside > -1e-3 { 0.0 } else { 1.0 }, clearance: depth }];
    }
    let root = discriminant.sqrt();
    let w = -(b + root.copysign(b));
    let intersection = |t: f64| {
        let place = y + e * t;
        let n = (g.transpose() * (place * weight)).normalize();
        let margin = if cylinder { place.z.min(1.0 - place.z) } else { 1.0 };
        let cos = n.dot(d).abs();
        let clearance = if cylinder { depth.min(margin * axes.z_axis.length() * cos) } else { depth };
        Intersection { t, margin, cos, clearance }
    };
    vec![intersection(w / a), intersection(c / w)]
}

/// A lower bound of the radii of the quadric.
fn thinnest(axes: DMat3, cylinder: bool) -> f64 {
    let g = axes.inverse();
    let norm = |i: usize| g.row(i).length_squared();
    (if cylinder { norm(0) + norm(1) } else { norm(0) + norm(1) + norm(2) }).sqrt().recip()
}

/// |f|/|∇f| of f = |y| − 1 in local coordinates y.
fn from_quadric(origin: DVec3, axes: &DMat3, cylinder: bool, p: DVec3) -> f64 {
    let g = axes.inverse();
    let y = g * (p - origin);
    let radial = y * weight(cylinder);
    let slope = (g.transpose() * radial).length() / radial.length();
    let beside = if cylinder { (-y.z).max(y.z - 1.0).max(0.0) * axes.z_axis.length() } else { 0.0 };
    (radial.length() - 1.0).abs() / slope + beside
}
