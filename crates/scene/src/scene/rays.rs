//! The rays of a camera, in lanes.
use fearless_simd_macros::simd;

use super::{Camera, Moments, Projection, Scene, Shutter};
use crate::{
    geometry::Motion,
    sampling::{Filter, warp::disk},
};
use noisefall_base::math::{F, Lanes, M, V};

/// The rays of a camera as constants of the kernel. Plane coordinates of a raster point are `corner + x per_x + y per_y`.
#[derive(Clone, Debug)]
pub struct CameraRays {
    /// Width and height of the image in pixels.
    pub resolution: [u32; 2],
    eye: [f32; 3],
    /// The upper left corner of the image, and its change per pixel to the right and down. It is a direction with a forward
    /// component of 1, or for parallel rays an offset of the eye.
    corner: [f32; 3],
    per_x: [f32; 3],
    per_y: [f32; 3],
    projection: Projection,
    /// The direction of view.
    forward: [f32; 3],
    lens: Option<LensRays>,
    /// The pixel filter.
    pub filter: Filter,
    /// The media around the eye: see [`crate::scene::surface::Surfaces::media`].
    pub media: u32,
    /// The times of samples.
    moments: Moments,
    motion: Motion,
}

/// A lens with a positive radius.
#[derive(Clone, Copy, Debug)]
struct LensRays {
    /// Vectors from the centre of the lens to its rim, to the right and up.
    right: [f32; 3],
    up: [f32; 3],
    focus: f32,
}

/// Points that are connected to the camera.
pub struct CameraJoin<L: Lanes> {
    /// Vector from the point to the camera.
    pub way: V<L>,
    /// Where the image shows the point, in pixels from its upper left corner; it may lie outside.
    pub x: F<L>,
    pub y: F<L>,
    /// Pixels for each unit of area at the point that faces the camera. The pdf of camera rays per such area if one starts from each
    /// pixel.
    pub density: F<L>,
    /// Lanes in front of the camera.
    pub visible: M<L>,
}

impl LensRays {
    /// A point of the lens, relative to its centre.
    #[inline(always)]
    fn point<L: Lanes>(&self, l: L, u: (F<L>, F<L>)) -> V<L> {
        let (right, up, _) = disk(u);
        V::splat(l, self.right) * right + V::splat(l, self.up) * up
    }
}

impl Camera {
    fn rays(&self) -> CameraRays {
        let [right, up, forward] = self.axes();
        let [w, h] = self.resolution.map(f64::from);
        let half_width = self.projection.half_width(self.fov);
        let half_height = half_width * h / w;
        let [shift_right, shift_up] = self.shift.map(|shift| 2.0 * half_width * shift);
        let middle = self.projection.middle(forward) + right * shift_right + up * shift_up;
        let lens = self.lens.filter(|lens| lens.radius > 0.0);
        CameraRays {
            resolution: self.resolution,
            eye: self.eye.as_vec3().to_array(),
            corner: (middle - right * half_width + up * half_height).as_vec3().to_array(),
            per_x: (right * (2.0 * half_width / w)).as_vec3().to_array(),
            per_y: (up * (-2.0 * half_height / h)).as_vec3().to_array(),
            projection: self.projection,
            forward: forward.as_vec3().to_array(),
            lens: lens.map(|lens| LensRays {
                right: (right * lens.radius).as_vec3().to_array(),
                up: (up * lens.radius).as_vec3().to_array(),
                focus: lens.focus as f32,
            }),
            filter: self.filter,
            media: 0,
            moments: Moments::default(),
            motion: Motion::default(),
        }
    }
}

impl Scene {
    /// The rays of a camera in this scene.
    pub fn rays(&self, camera: &Camera) -> CameraRays {
        let shutter = camera.shutter.filter(|_| self.moves());
        let moments = shutter.map(Shutter::moments).unwrap_or_default();
        // A static camera is not transformed, which would round it.
        let motion = if moments == Moments::default() { Motion::default() } else { self.camera_motion.clone() };
        let opening = f64::from(moments.start).clamp(0.0, 1.0);
        let eye = motion.at(opening).transform_point3(camera.eye);
        CameraRays { media: self.media_at(eye, opening), moments, motion, ..camera.rays() }
    }
}

impl CameraRays {
    /// Whether rays start on a lens.
    pub fn have_lens(&self) -> bool {
        self.lens.is_some()
    }

    /// Whether the camera itself moves.
    pub fn move_in_time(&self) -> bool {
        !self.motion.0.is_empty()
    }

    /// Whether samples are taken at different times.
    #[inline(always)]
    pub fn take_time(&self) -> bool {
        self.moments.length > 0.0
    }

    /// The time of all samples, if it is the same.
    #[inline(always)]
    pub fn moment<L: Lanes>(&self, l: L) -> F<L> {
        l.f(self.moments.start)
    }

    /// The time of samples at the fraction `u` of the interval in which the shutter is open.
    #[inline(always)]
    pub fn time<L: Lanes>(&self, l: L, u: F<L>) -> F<L> {
        (u * self.moments.length + self.moments.start).max(l.f(0.0)).min(l.f(1.0))
    }

    /// Moves a ray of the camera from time 0 to `time`.
    #[inline(always)]
    pub fn moved_by_camera<L: Lanes>(&self, l: L, (o, d): (V<L>, V<L>), time: F<L>) -> (V<L>, V<L>) {
        self.motion.carry(l, o, d, time)
    }

    /// Origin and unit direction of the rays through raster points, in pixels from the upper left corner of the image.
    #[inline(always)]
    pub fn through<L: Lanes>(&self, l: L, x: F<L>, y: F<L>) -> (V<L>, V<L>) {
        let place = V::splat(l, self.per_x) * x + V::splat(l, self.per_y) * y + self.corner;
        self.projection.rays(l, place, self.eye, self.forward)
    }

    /// The rays through raster points and points of the lens, which `u` samples uniformly. There must be a lens.
    #[inline(always)]
    pub fn through_lens<L: Lanes>(&self, l: L, x: F<L>, y: F<L>, u: (F<L>, F<L>)) -> (V<L>, V<L>) {
        let Some(lens) = self.lens else { return self.through(l, x, y) };
        let place = V::splat(l, self.per_x) * x + V::splat(l, self.per_y) * y + self.corner;
        let on_lens = lens.point(l, u);
        (on_lens + self.eye, (place * lens.focus - on_lens).normalized())
    }

    /// Joins points with the camera, through points of the lens that `u` samples uniformly if there is one.
    #[simd]
    pub fn join<L: Lanes>(&self, l: L, p: V<L>, time: F<L>, u: (F<L>, F<L>)) -> CameraJoin<L> {
        let mut from_eye = p - self.eye;
        if self.move_in_time() {
            from_eye = self.motion.carry_back(l, p, time) - self.eye;
        }
        let mut off_axis = V::splat(l, [0.0; 3]);
        if let Some(lens) = self.lens {
            let on_lens = lens.point(l, u);
            from_eye = from_eye - on_lens;
            off_axis = on_lens * (1.0 / lens.focus);
        }
        let seen = self.projection.seen(from_eye, self.forward);
        // Across the axis, from the upper left corner of the image.
        let place = seen.place + off_axis - self.corner;
        let along = |edge: [f32; 3]| {
            let square = edge[0] * edge[0] + (edge[1] * edge[1] + edge[2] * edge[2]);
            (place.dot_with(edge) * (1.0 / square), square.sqrt())
        };
        let ((x, width), (y, height)) = (along(self.per_x), along(self.per_y));
        let mut join = CameraJoin { way: seen.way, x, y, density: seen.scale * (1.0 / (width * height)), visible: seen.visible };
        if self.move_in_time() {
            let (way, squeeze) = self.motion.carry_vector(l, seen.way, time);
            (join.way, join.density) = (way, join.density * squeeze);
        }
        join
    }
}
