//! Where rays meet shapes, by textbook formulas in f64.
use glam::{DMat3, DVec3};

use super::super::{Outline, Shape};

/// A meeting of a ray and a piece.
#[derive(Clone, Copy, Debug)]
pub struct Meeting {
    pub t: f64,
    /// How far it lies within the outline of the piece, of its size; negative outside.
    pub margin: f64,
    /// |cos θ| to the normal.
    pub cos: f64,
}

/// All meetings of o + td with the pieces of a shape, those that miss the outline by less than `slack` included.
pub fn meetings(shape: &Shape, o: DVec3, d: DVec3, slack: f64) -> Vec<Meeting> {
    let mut found: Vec<Meeting> = shape.pieces().iter().flat_map(|piece| meetings_of(piece, o, d)).collect();
    found.retain(|meeting| meeting.margin > -slack && meeting.t.is_finite());
    found.sort_by(|a, b| a.t.total_cmp(&b.t));
    found
}

fn meetings_of(piece: &Shape, o: DVec3, d: DVec3) -> Vec<Meeting> {
    match piece {
        Shape::Sphere { center, radius } => quadric(*center, DMat3::from_diagonal(DVec3::splat(*radius)), false, o, d),
        Shape::Ellipsoid { center, axes } => quadric(*center, *axes, false, o, d),
        Shape::Cylinder { base, axes, .. } => quadric(*base, *axes, true, o, d),
        Shape::Flat { outline, origin, edges: [e, f], .. } => {
            let n = e.cross(*f).normalize();
            let t = (*origin - o).dot(n) / d.dot(n);
            let place = DMat3::from_cols(*e, *f, n).inverse() * (o + d * t - *origin);
            let margin = match outline {
                Outline::Parallelogram => place.x.min(1.0 - place.x).min(place.y).min(1.0 - place.y),
                Outline::Triangle => place.x.min(place.y).min(1.0 - place.x - place.y),
                Outline::Ellipse => 1.0 - place.truncate().length(),
            };
            vec![Meeting { t, margin, cos: d.dot(n).abs() }]
        }
        Shape::Cuboid { .. } => unreachable!("a piece"),
    }
}

fn quadric(origin: DVec3, axes: DMat3, cylinder: bool, o: DVec3, d: DVec3) -> Vec<Meeting> {
    let g = axes.inverse();
    let (y, e) = (g * (o - origin), g * d);
    let weight = if cylinder { DVec3::new(1.0, 1.0, 0.0) } else { DVec3::ONE };
    let (a, b, c) = (e.dot(e * weight), y.dot(e * weight), y.dot(y * weight) - 1.0);
    // A discriminant from the nearest point: b² − ac cancels far away.
    let nearest = (y - e * (b / a)) * weight;
    let discriminant = a * (1.0 - nearest.length_squared());
    if discriminant < 0.0 || a == 0.0 {
        // A miss, told as a place outside; one that rounding may turn into a tangent.
        let outside = 1.0 - nearest.length();
        return vec![Meeting { t: -b / a, margin: outside, cos: if outside > -1e-3 { 0.0 } else { 1.0 } }];
    }
    let root = discriminant.sqrt();
    let w = -(b + root.copysign(b));
    let meeting = |t: f64| {
        let place = y + e * t;
        let n = (g.transpose() * (place * weight)).normalize();
        let margin = if cylinder { place.z.min(1.0 - place.z) } else { 1.0 };
        Meeting { t, margin, cos: n.dot(d).abs() }
    };
    vec![meeting(w / a), meeting(c / w)]
}
