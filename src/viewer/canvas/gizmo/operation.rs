//! An active move, rotation or scaling, controlled by the pointer or a typed number.
use glam::DVec3;
use noisefall_scene::{
    scene::Camera,
    shape::{Rotation, Transform},
};

use super::maths::{angle_about, grid_step, nearest_on_axis, on_plane, snapped, unwrapped};
use crate::viewer::canvas::projection::{project, ray};

/// Operation of a gizmo.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    #[default]
    Move,
    Rotate,
    Scale,
}

/// Restriction of an operation. Axes are 0 for x, 1 for y, 2 for z.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lock {
    /// Moves in the plane of the image, rotates about the line of sight, scales all axes alike.
    Free,
    Axis(usize),
    /// The plane perpendicular to an axis.
    Plane(usize),
}

/// The unit vectors of the axes.
pub const AXES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];

/// Degrees that a rotation snaps to.
const ANGLE_STEP: f64 = 15.0;
/// Step of factors that snap.
const FACTOR_STEP: f64 = 0.1;
/// Smaller factors would flatten the object.
const LEAST_FACTOR: f64 = 1e-3;
/// Smallest distance from the pivot that counts at the start of a scaling, in pixels of the image: a smaller one would be too fast.
const NEAREST: f32 = 8.0;

/// An active operation.
#[derive(Clone, Debug)]
pub struct Operation {
    pub mode: Mode,
    pub lock: Lock,
    /// The fixed point of rotation and scaling, metres.
    pub pivot: DVec3,
    /// The typed number, which replaces the pointer.
    pub typed: String,
    /// First and current position of the pointer, in pixels of the image.
    start: [f32; 2],
    now: [f32; 2],
    /// Angle of the pointer around the pivot since the start, radians.
    turned: f64,
}

impl Operation {
    /// An operation that begins with the pointer at a place of the image.
    pub fn new(mode: Mode, lock: Lock, pivot: DVec3, start: [f32; 2]) -> Operation {
        Operation { mode, lock, pivot, typed: String::new(), start, now: start, turned: 0.0 }
    }

    /// Follows the pointer.
    pub fn point(&mut self, camera: &Camera, now: [f32; 2]) {
        self.now = now;
        if let Some(center) = project(camera, self.pivot) {
            let angle = angle_about(center, now) - angle_about(center, self.start);
            self.turned = unwrapped(self.turned, angle);
        }
    }

    /// Restricts the operation to an axis or a plane, or frees it if it already has that restriction.
    pub fn toggle(&mut self, lock: Lock) {
        self.lock = if self.lock == lock { Lock::Free } else { lock };
    }

    /// The typed number, if the text is a number.
    pub fn number(&self) -> Option<f64> {
        self.typed.parse().ok().filter(|number: &f64| number.is_finite())
    }

    /// The transform of the world about the pivot so far, in a scene of this size. `snaps` rounds the amount from the pointer,
    /// not a typed one.
    pub fn change(&self, camera: &Camera, size: f64, snaps: bool) -> Transform {
        match self.mode {
            Mode::Move => Transform::Translate(self.way(camera, if snaps { Some(grid_step(size)) } else { None })),
            Mode::Rotate => self.rotation(camera, snaps),
            Mode::Scale => Transform::Scale(self.factors(camera, snaps)),
        }
    }

    fn way(&self, camera: &Camera, step: Option<f64>) -> DVec3 {
        if let Some(number) = self.number() {
            return AXES[self.first_axis()] * number;
        }
        let snap = |x: f64| step.map_or(x, |step| snapped(x, step));
        let between = |place: &dyn Fn([DVec3; 2]) -> Option<DVec3>| {
            let [from, to] = [self.start, self.now].map(|at| place(ray(camera, at)));
            from.zip(to).map_or(DVec3::ZERO, |(from, to)| to - from)
        };
        match self.lock {
            Lock::Axis(axis) => {
                let way = between(&|ray| nearest_on_axis(self.pivot, AXES[axis], ray).map(|along| AXES[axis] * along));
                AXES[axis] * snap(way[axis])
            }
            Lock::Plane(normal) => between(&|ray| on_plane(self.pivot, AXES[normal], ray)).map(snap),
            Lock::Free => between(&|ray| on_plane(self.pivot, camera.axes()[2], ray)).map(snap),
        }
    }

    fn rotation(&self, camera: &Camera, snaps: bool) -> Transform {
        let towards_viewer = if camera.projection.has_angle() { camera.eye - self.pivot } else { -camera.axes()[2] };
        let axis = match self.lock {
            Lock::Axis(axis) | Lock::Plane(axis) => AXES[axis],
            Lock::Free => -camera.axes()[2],
        };
        let turned = self.turned.to_degrees() * if axis.dot(towards_viewer) < 0.0 { -1.0 } else { 1.0 };
        let turned = if snaps { snapped(turned, ANGLE_STEP) } else { turned };
        Transform::Rotate(Rotation { axis, degrees: self.number().unwrap_or(turned) })
    }

    fn factors(&self, camera: &Camera, snaps: bool) -> DVec3 {
        let distance = |at: [f32; 2]| {
            let center = project(camera, self.pivot).unwrap_or(at);
            f64::from((at[0] - center[0]).hypot(at[1] - center[1]))
        };
        let pointed = distance(self.now) / distance(self.start).max(f64::from(NEAREST));
        let pointed = if snaps { snapped(pointed, FACTOR_STEP) } else { pointed };
        let factor = self.number().unwrap_or(pointed);
        let factor = if factor.abs() < LEAST_FACTOR { LEAST_FACTOR } else { factor };
        let scaled = |axis: usize| match self.lock {
            Lock::Free => true,
            Lock::Axis(only) => axis == only,
            Lock::Plane(normal) => axis != normal,
        };
        DVec3::from_array([0, 1, 2].map(|axis| if scaled(axis) { factor } else { 1.0 }))
    }

    /// The axis that a typed number is for.
    fn first_axis(&self) -> usize {
        match self.lock {
            Lock::Free => 0,
            Lock::Axis(axis) => axis,
            Lock::Plane(normal) => usize::from(normal == 0),
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::{super::tests::oblique_camera as camera, *};

    const PIVOT: DVec3 = DVec3::new(0.2, 0.1, -0.3);

    fn seen(p: DVec3) -> [f32; 2] {
        project(&camera(), p).expect("it is in front")
    }

    /// An operation from a point of the scene to another, as the pointer sees them.
    fn drag(mode: Mode, lock: Lock, from: DVec3, to: DVec3, snaps: bool) -> Transform {
        let mut operation = Operation::new(mode, lock, PIVOT, seen(from));
        for step in 1..=8 {
            operation.point(&camera(), seen(from + (to - from) * (f64::from(step) / 8.0)));
        }
        operation.change(&camera(), 5.0, snaps)
    }

    fn rotation(axis: DVec3, degrees: f64) -> Transform {
        Transform::Rotate(Rotation { axis, degrees })
    }

    fn way(change: &Transform) -> DVec3 {
        let Transform::Translate(way) = change else { panic!("it is no move: {change:?}") };
        *way
    }

    #[test]
    fn an_object_moved_along_an_axis_stays_under_the_pointer() {
        for (axis, direction) in AXES.into_iter().enumerate() {
            let by = direction * 0.75;
            let found = way(&drag(Mode::Move, Lock::Axis(axis), PIVOT, PIVOT + by, false));
            assert!(found.distance(by) < 1e-3, "{axis}: {found}");
        }
    }

    #[test]
    fn an_object_moved_in_a_plane_stays_under_the_pointer() {
        for (normal, direction) in AXES.into_iter().enumerate() {
            let by = DVec3::new(0.3, -0.2, 0.5) * (DVec3::ONE - direction);
            let found = way(&drag(Mode::Move, Lock::Plane(normal), PIVOT, PIVOT + by, false));
            assert!(found.distance(by) < 1e-3, "{normal}: {found}");
        }
        let [right, up, forward] = camera().axes();
        let by = right * 0.2 - up * 0.1;
        let found = way(&drag(Mode::Move, Lock::Free, PIVOT, PIVOT + by, false));
        assert!(found.distance(by) < 1e-3 && found.dot(forward).abs() < 1e-6, "{found}");
    }

    #[test]
    fn moves_snap_to_the_grid() {
        let found = way(&drag(Mode::Move, Lock::Axis(1), PIVOT, PIVOT + DVec3::Y * 0.37, true));
        assert!(found.distance(DVec3::Y * 0.4) < 1e-9, "{found}");
    }

    #[test]
    fn a_pointer_that_goes_around_turns_the_object_with_it() {
        for sign in [1.0, -1.0] {
            // The view from the other side turns the other way.
            let camera = Camera { eye: PIVOT + DVec3::Y * 4.0 * sign, look_at: PIVOT, up: DVec3::Z, ..camera() };
            let seen = |degrees: f64| {
                let turned = DQuat::from_axis_angle(DVec3::Y, f64::to_radians(degrees)) * DVec3::X;
                project(&camera, PIVOT + turned * 0.5).expect("it is in front")
            };
            let mut operation = Operation::new(Mode::Rotate, Lock::Axis(1), PIVOT, seen(0.0));
            (1..=10).for_each(|step| operation.point(&camera, seen(50.0 * f64::from(step))));
            let Transform::Rotate(turn) = operation.change(&camera, 5.0, false) else { panic!("it is no rotation") };
            assert!(turn.axis == DVec3::Y && (turn.degrees - 500.0).abs() < 1e-2, "{sign}: {turn:?}");
            assert_eq!(operation.change(&camera, 5.0, true), rotation(DVec3::Y, 495.0));
        }
    }

    #[test]
    fn a_pointer_twice_as_far_scales_by_two_along_the_locked_axes() {
        let [right, ..] = camera().axes();
        let scale = |lock| drag(Mode::Scale, lock, PIVOT + right * 0.4, PIVOT + right * 0.8, true);
        assert_eq!(scale(Lock::Free), Transform::Scale(DVec3::splat(2.0)));
        assert_eq!(scale(Lock::Axis(1)), Transform::Scale(DVec3::new(1.0, 2.0, 1.0)));
        assert_eq!(scale(Lock::Plane(1)), Transform::Scale(DVec3::new(2.0, 1.0, 2.0)));
        assert_eq!(drag(Mode::Scale, Lock::Free, PIVOT + right, PIVOT, false), Transform::Scale(DVec3::splat(LEAST_FACTOR)));
    }

    #[test]
    fn a_typed_number_counts_in_place_of_the_pointer_and_does_not_snap() {
        let typed = |mode, lock, typed: &str| {
            let mut operation = Operation::new(mode, lock, PIVOT, [10.0, 10.0]);
            operation.point(&camera(), [90.0, 40.0]);
            operation.typed = typed.to_owned();
            operation.change(&camera(), 5.0, true)
        };
        assert_eq!(typed(Mode::Move, Lock::Axis(2), "-1.23"), Transform::Translate(DVec3::Z * -1.23));
        assert_eq!(typed(Mode::Move, Lock::Plane(0), "2"), Transform::Translate(DVec3::Y * 2.0));
        assert_eq!(typed(Mode::Rotate, Lock::Axis(0), "7.5"), rotation(DVec3::X, 7.5));
        assert_eq!(typed(Mode::Scale, Lock::Free, "0"), Transform::Scale(DVec3::splat(LEAST_FACTOR)));
        assert_ne!(typed(Mode::Move, Lock::Axis(2), "-"), Transform::Translate(DVec3::ZERO), "half a number is none");
    }

    #[test]
    fn the_same_lock_again_frees() {
        let mut operation = Operation::new(Mode::Move, Lock::Free, PIVOT, [0.0; 2]);
        operation.toggle(Lock::Axis(1));
        operation.toggle(Lock::Plane(1));
        assert_eq!(operation.lock, Lock::Plane(1));
        operation.toggle(Lock::Plane(1));
        assert_eq!(operation.lock, Lock::Free);
    }
}
