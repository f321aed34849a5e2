//! Camera collision: a camera that is moved stops short of a surface behind which nothing can be seen.
//!
//! A place is *blind* if no light arrives there from any direction. To find out, [`is_blind`] traces some thousand paths from it as
//! the renderer does, spread over all directions; one that finds light is enough. A move is stopped by the first surface that has a
//! blind place right behind it. So a camera stays out of solid walls and balls, passes panes of glass and sheets between two lit
//! rooms, and enters a closed box that is lit inside. A camera that is in a blind place already moves freely: it must get out again.
//!
//! This costs one ray a surface on the way, and paths only where the way passes through a surface: about a millisecond if the place
//! behind it is blind, less if it is not.
use glam::DVec3;

use super::{batch::Batch, trace::trace, work::Work};
use crate::{
    geometry::{MISS, Place},
    math::{Lanes, One, Pick, SimdLevel, V},
    sampling::Filter,
    scene::{Camera, RenderSettings, Scene},
};

/// The distance that is kept from a surface, in parts of the size of the scene.
const MARGIN: f64 = 1e-3;
/// Surfaces that are looked at on the way of one move.
const MOST_CROSSINGS: usize = 64;
/// All directions are six pictures, 90° wide, of so many pixels a side and so many samples a pixel.
const SIDE: u32 = 16;
const SAMPLES: u32 = 2;
/// Longer paths would take longer than a frame of the window.
const MOST_BOUNCES: u32 = 16;

/// The part of the straight way between two places that a camera can go before a surface stops it, from 0 to 1.
pub fn clear_fraction(scene: &Scene, from: DVec3, to: DVec3) -> f64 {
    let (length, margin) = (from.distance(to), MARGIN * scene.size);
    let Some(direction) = (to - from).try_normalize() else { return 1.0 };
    let mut origin = from;
    for _ in 0..MOST_CROSSINGS {
        let Some(crossing) = first_crossing(scene, origin, direction) else { return 1.0 };
        let distance = (origin - from).dot(direction) + crossing.distance;
        if distance > length + margin {
            return 1.0;
        }
        if is_blind(scene, crossing.behind(scene, direction, margin)) {
            let clear = ((distance - margin) / length).clamp(0.0, 1.0);
            return if is_blind(scene, from) { 1.0 } else { clear };
        }
        origin = crossing.beyond;
    }
    1.0
}

/// Whether no light arrives at a place from anywhere, as far as some thousand paths can tell.
pub fn is_blind(scene: &Scene, place: DVec3) -> bool {
    let settings = RenderSettings { max_bounces: Some(MOST_BOUNCES), ..RenderSettings::default() };
    let mut batch = Batch::default();
    let mut sees_light = |axis: DVec3, sample: u32| {
        let rays = scene.rays(&view(place, axis));
        let work = Work::tile(scene, &rays, &settings, [0, 0], [SIDE, SIDE], sample);
        let done = trace(SimdLevel::best(), &work, &mut batch, &|| false);
        done.is_ok() && batch.radiance().iter().any(|[r, g, b, _]| r.max(*g).max(*b) > 0.0)
    };
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
    !(0..SAMPLES).any(|sample| axes.clone().any(|axis| sees_light(axis, sample)))
}

/// A sixth of all directions.
fn view(eye: DVec3, axis: DVec3) -> Camera {
    Camera {
        eye,
        look_at: eye + axis,
        up: axis.any_orthonormal_vector(),
        fov: 90.0,
        orthographic: None,
        lens: None,
        filter: Filter::Box,
        shutter: None,
        resolution: [SIDE, SIDE],
    }
}

/// Where a ray meets a surface.
struct Crossing {
    distance: f64,
    /// The next place on the ray that is strictly behind the surface.
    beyond: DVec3,
}

impl Crossing {
    /// A place behind the surface: as far as the margin, but before the next surface.
    fn behind(&self, scene: &Scene, direction: DVec3, margin: f64) -> DVec3 {
        let room = first_crossing(scene, self.beyond, direction).map_or(f64::INFINITY, |next| next.distance);
        self.beyond + direction * margin.min(0.5 * room)
    }
}

/// The first surface along a ray, of things as they are when the shutter opens.
fn first_crossing(scene: &Scene, origin: DVec3, direction: DVec3) -> Option<Crossing> {
    let l = One;
    let [o, d] = [origin, direction].map(|v| V::splat(l, v.as_vec3().to_array()));
    let time = l.f(0.0);
    let nearest = scene.shapes.closest(l, l.first(1), o, d, time);
    if nearest.primitive.0 == MISS {
        return None;
    }
    let place = Place { primitive: nearest.primitive, element: nearest.element, time };
    let point = scene.shapes.surface_point(l, &place, o + d * nearest.t);
    let outwards = point.n_geometric.dot(d).lt(l.f(0.0));
    let n = outwards.pick(-point.n_geometric, point.n_geometric);
    let V { x, y, z } = point.p + n * point.error;
    Some(Crossing { distance: f64::from(nearest.t.0), beyond: glam::Vec3::new(x.0, y.0, z.0).as_dvec3() })
}

#[cfg(test)]
mod tests;
