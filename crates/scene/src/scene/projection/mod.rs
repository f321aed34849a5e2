//! How the scene is projected to the image.
//!
//! A projection is one file and one line of the catalogue below.
pub mod orthographic;
pub mod perspective;

use glam::DVec3;
use serde::{Deserialize, Deserializer};

use noisefall_base::{
    declare::Kind,
    math::{F, Lanes, M, V},
};

noisefall_base::declare::choices! {
    /// How the scene is projected to the image.
    pub enum Projection, "projection", default perspective::Perspective {
        perspective::Perspective,
        orthographic::Orthographic(Orthographic),
    }
    in_projection
}

impl Projection {
    /// Whether the camera has an angle of view.
    pub fn has_angle(self) -> bool {
        in_projection!(self, projection => projection.has_angle())
    }

    /// Whether the rays of a pixel can start on a lens.
    pub fn takes_lens(self) -> bool {
        in_projection!(self, projection => projection.takes_lens())
    }

    /// Half of the width of the image: at distance 1 from the eye, or in metres if rays are parallel. `angle` is the full angle of
    /// view, degrees.
    pub fn half_width(self, angle: f64) -> f64 {
        in_projection!(self, projection => projection.half_width(angle))
    }

    /// The middle of the image, relative to the eye.
    pub fn middle(self, forward: DVec3) -> DVec3 {
        in_projection!(self, projection => projection.middle(forward))
    }

    /// The factor from metres across the axis at a depth in metres to half widths; `None` if the point is not in front of the camera.
    pub fn scale(self, depth: f64) -> Option<f64> {
        in_projection!(self, projection => projection.scale(depth))
    }

    /// Width in metres that the image covers at a distance in metres. `angle` is the full angle of view, degrees.
    pub fn width_at(self, distance: f64, angle: f64) -> f64 {
        in_projection!(self, projection => projection.width_at(distance, angle))
    }

    /// The projection that shows the given width, metres, if the projection determines the width.
    #[must_use]
    pub fn with_width(self, width: f64) -> Projection {
        in_projection!(self, projection => projection.with_width(width).into())
    }

    /// The projection with an image that is wider by a factor; `None` if that takes a move of the eye.
    pub fn widened(self, factor: f64) -> Option<Projection> {
        in_projection!(self, projection => projection.widened(factor).map(Into::into))
    }

    /// Origin and unit direction of the rays through points of the image, relative to the eye.
    #[inline(always)]
    pub fn rays<L: Lanes>(self, l: L, place: V<L>, eye: [f32; 3], forward: [f32; 3]) -> (V<L>, V<L>) {
        in_projection!(self, projection => projection.rays(l, place, eye, forward))
    }

    /// The point of the image that shows a point at `from_eye`, relative to the eye: see [`Seen`].
    #[inline(always)]
    pub fn seen<L: Lanes>(self, from_eye: V<L>, forward: [f32; 3]) -> Seen<L> {
        in_projection!(self, projection => projection.seen(from_eye, forward))
    }

    /// Reads a projection. Images of earlier versions store only the width of an orthographic projection, or nothing.
    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Projection, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Embedded {
            Now(Projection),
            Width(Option<f64>),
        }
        Ok(match Embedded::deserialize(deserializer)? {
            Embedded::Now(projection) => projection,
            Embedded::Width(width) => width.map_or_else(Projection::default, Projection::orthographic),
        })
    }
}

/// Where points are in the image.
pub struct Seen<L: Lanes> {
    /// The point of the image, as in `rays`.
    pub place: V<L>,
    /// Vector to the camera.
    pub way: V<L>,
    /// Area of the image for each unit of area at the point that faces the camera.
    pub scale: F<L>,
    /// Lanes in front of the camera.
    pub visible: M<L>,
}

/// A kind of projection; see the functions of [`Projection`] of the same names.
trait Projecting: Kind {
    fn has_angle(self) -> bool;
    fn takes_lens(self) -> bool;
    fn half_width(self, angle: f64) -> f64;
    fn middle(self, forward: DVec3) -> DVec3;
    fn scale(self, depth: f64) -> Option<f64>;
    fn width_at(self, distance: f64, angle: f64) -> f64;
    fn with_width(self, width: f64) -> Self;
    fn widened(self, factor: f64) -> Option<Self>;
    fn rays<L: Lanes>(self, l: L, place: V<L>, eye: [f32; 3], forward: [f32; 3]) -> (V<L>, V<L>);
    fn seen<L: Lanes>(self, from_eye: V<L>, forward: [f32; 3]) -> Seen<L>;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, built_in};

    #[test]
    fn cameras_of_earlier_versions_have_a_width_or_nothing() {
        let read = |camera: &serde_json::Value| serde_json::from_value::<Camera>(camera.clone()).expect("a camera");
        for projection in [Projection::Perspective, Projection::orthographic(3.0)] {
            let camera = Camera { projection, ..built_in().camera };
            let mut json = serde_json::json!(camera);
            assert_eq!(read(&json), camera);
            let fields = json.as_object_mut().expect("its fields");
            fields.remove("projection");
            fields.insert("orthographic".to_owned(), if projection.has_angle() { serde_json::Value::Null } else { 3.0.into() });
            assert_eq!(read(&json), camera);
        }
    }
}
