//! Camera collision: a moving camera stops short of a surface if nothing is visible behind it.
//!
//! A position is *blind* if no light arrives there from any direction. [`is_blind`] traces some thousand paths from it in all
//! directions, like the renderer; one that finds light is enough. A move stops at the first surface with a blind position right
//! behind it. So a camera stays out of solid walls and balls, passes through panes of glass and sheets between two lit rooms, and
//! enters a closed box that is lit inside. A camera at a blind position moves freely, because it must get out again.
//!
//! The cost is one ray per surface on the way, and paths only if the way crosses a surface: about a millisecond if the position
//! behind it is blind, and less otherwise.
use glam::DVec3;

use super::{batch::Batch, trace::trace_alone, work::Work};
use noisefall_base::math::{Lanes, One, Pick, SimdLevel, V};
use noisefall_scene::{
    geometry::{MISS, PrimitiveRef},
    sampling::Filter,
    scene::{Camera, Projection, RenderSettings, Scene},
};

/// Minimum distance from a surface, as a fraction of the size of the scene.
const MARGIN: f64 = 1e-3;
/// Maximum number of surfaces on the way of one move.
const MOST_CROSSINGS: usize = 64;
/// Six images of 90° cover all directions; this is their width and height, and the number of samples per pixel.
const SIDE: u32 = 16;
const SAMPLES: u32 = 2;
/// Bounce cap: longer paths would take longer than a frame of the window.
const MOST_BOUNCES: u32 = 16;

/// The fraction from 0 to 1 of the straight way between two positions that a camera can move before a surface stops it.
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

/// Whether no light arrives at a position, according to some thousand paths.
pub fn is_blind(scene: &Scene, place: DVec3) -> bool {
    let settings = RenderSettings { max_bounces: Some(MOST_BOUNCES), ..RenderSettings::default() };
    let mut batch = Batch::default();
    let mut sees_light = |axis: DVec3, sample: u32| {
        let rays = scene.rays(&view(place, axis));
        let work = Work::tile(scene, &rays, &settings, [0, 0], [SIDE, SIDE], sample);
        let done = trace_alone(SimdLevel::best(), &work, &mut batch, &|| false);
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
        projection: Projection::default(),
        shift: [0.0; 2],
        lens: None,
        filter: Filter::Box,
        shutter: None,
        resolution: [SIDE, SIDE],
    }
}

/// A crossing of a ray with a surface.
struct WallCrossing {
    distance: f64,
    /// The next position on the ray strictly behind the surface.
    beyond: DVec3,
}

impl WallCrossing {
    /// A position behind the surface: at the margin, but before the next surface.
    fn behind(&self, scene: &Scene, direction: DVec3, margin: f64) -> DVec3 {
        let room = first_crossing(scene, self.beyond, direction).map_or(f64::INFINITY, |next| next.distance);
        self.beyond + direction * margin.min(0.5 * room)
    }
}

/// The first surface along a ray, at the time when the shutter opens.
fn first_crossing(scene: &Scene, origin: DVec3, direction: DVec3) -> Option<WallCrossing> {
    let l = One;
    let [o, d] = [origin, direction].map(|v| V::splat(l, v.as_vec3().to_array()));
    let time = l.f(0.0);
    let nearest = scene.shapes.closest(l, l.first(1), o, d, time);
    if nearest.primitive.0 == MISS {
        return None;
    }
    let place = PrimitiveRef { primitive: nearest.primitive, element: nearest.element, time };
    let point = scene.shapes.surface_point(l, &place, o + d * nearest.t);
    let outwards = point.n_geometric.dot(d).lt(l.f(0.0));
    let n = outwards.pick(-point.n_geometric, point.n_geometric);
    let V { x, y, z } = point.p + n * point.error;
    Some(WallCrossing { distance: f64::from(nearest.t.0), beyond: glam::Vec3::new(x.0, y.0, z.0).as_dvec3() })
}

#[cfg(test)]
mod tests;
