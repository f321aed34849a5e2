//! The handles of a gizmo: their positions on the screen, and the one under the pointer.
use std::f64::consts::TAU;

use egui::Pos2;
use glam::DVec3;
use noisefall_scene::scene::Camera;

use super::operation::{AXES, Lock, Mode};
use crate::viewer::canvas::{
    picture_area::PictureArea,
    projection::{pixel_width, project},
};

/// Length of an axis in points.
pub const LENGTH: f64 = 84.0;
/// Extent of the squares of planes, as fractions of the axes.
const PLANE: [f64; 2] = [0.28, 0.48];
/// Shortest axis that is shown, in points. Along a shorter one the pointer is too imprecise.
const SHORTEST: f32 = 14.0;
/// Largest distance between the pointer and a handle, in points.
const REACH: f32 = 7.0;
/// Corners of a ring.
const CORNERS: u32 = 48;

/// A handle on the screen.
#[derive(Clone, Debug, PartialEq)]
pub struct Handle {
    pub lock: Lock,
    pub shape: HandleShape,
}

/// Shape of a handle, in points of the screen.
#[derive(Clone, Debug, PartialEq)]
pub enum HandleShape {
    /// An axis from the pivot to its end.
    Axis([Pos2; 2]),
    /// A square in a plane.
    Square([Pos2; 4]),
    /// A ring around an axis: the parts that lie in front of the pivot.
    Ring(Vec<[Pos2; 2]>),
    /// A circle around the pivot, in the plane of the screen.
    Circle(Pos2, f32),
}

/// The handles of a mode around a pivot, topmost first. None if the pivot is behind the camera.
pub fn handles(mode: Mode, pivot: DVec3, camera: &Camera, area: &PictureArea) -> Vec<Handle> {
    let screen = |p: DVec3| project(camera, p).map(|[x, y]| area.screen(x, y));
    let Some(center) = screen(pivot) else { return Vec::new() };
    // Metres that are as long as an axis, seen from the front.
    let length = LENGTH * f64::from(area.resolution.x / area.rect.width()) * pixel_width(camera, pivot);
    let at = |u: usize, a: f64, v: usize, b: f64| screen(pivot + (AXES[u] * a + AXES[v] * b) * length);
    let mut handles = Vec::new();
    let mut add = |lock: Lock, shape: Option<HandleShape>| handles.extend(shape.map(|shape| Handle { lock, shape }));
    let circle = |radius: f32| Some(HandleShape::Circle(center, radius));
    if mode == Mode::Rotate {
        for axis in 0..3 {
            add(Lock::Axis(axis), ring(pivot, axis, length, camera, &screen).map(HandleShape::Ring));
        }
        add(Lock::Free, circle(LENGTH as f32 * 1.2));
        return handles;
    }
    add(Lock::Free, circle(REACH));
    for (axis, direction) in AXES.into_iter().enumerate() {
        let end = screen(pivot + direction * length).filter(|end| end.distance(center) >= SHORTEST);
        add(Lock::Axis(axis), end.map(|end| HandleShape::Axis([center, end])));
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let [near, far] = PLANE;
        let corners = [(near, near), (far, near), (far, far), (near, far)].map(|(a, b)| at(u, a, v, b));
        if let [Some(a), Some(b), Some(c), Some(d)] = corners {
            let square = [a, b, c, d];
            add(Lock::Plane(axis), (area_of(&square) > REACH).then_some(HandleShape::Square(square)));
        }
    }
    handles
}

/// The half of the circle around an axis that is nearer to the camera.
fn ring(
    pivot: DVec3,
    axis: usize,
    length: f64,
    camera: &Camera,
    screen: &dyn Fn(DVec3) -> Option<Pos2>,
) -> Option<Vec<[Pos2; 2]>> {
    let [_, _, forward] = camera.axes();
    let (u, v) = (AXES[(axis + 1) % 3], AXES[(axis + 2) % 3]);
    let corner = |number: u32| {
        let (sin, cos) = (TAU * f64::from(number) / f64::from(CORNERS)).sin_cos();
        u * cos + v * sin
    };
    // A little behind the pivot, so that a ring seen from the front is whole.
    let is_near = |corner: DVec3| corner.dot(forward) < 0.15;
    let side = |number: u32| {
        let ends = [corner(number), corner(number + 1)];
        let [from, to] = ends.map(|corner| screen(pivot + corner * length));
        Some([from?, to?]).filter(|_| ends.into_iter().all(is_near))
    };
    let sides: Vec<_> = (0..CORNERS).filter_map(side).collect();
    (!sides.is_empty()).then_some(sides)
}

/// The handle under the pointer: the nearest one; the first of several at the same distance.
pub fn under(handles: &[Handle], pointer: Pos2) -> Option<&Handle> {
    let gaps = handles.iter().map(|handle| (gap(&handle.shape, pointer), handle));
    let (_, handle) = gaps.filter(|(gap, _)| *gap <= REACH).min_by(|(a, _), (b, _)| a.total_cmp(b))?;
    Some(handle)
}

/// Distance of the pointer from a handle, in points.
fn gap(shape: &HandleShape, pointer: Pos2) -> f32 {
    match shape {
        HandleShape::Circle(center, radius) if *radius <= REACH => (center.distance(pointer) - radius).max(0.0),
        HandleShape::Circle(center, radius) => (center.distance(pointer) - radius).abs(),
        HandleShape::Axis(ends) => distance(*ends, pointer),
        HandleShape::Ring(sides) => sides.iter().map(|side| distance(*side, pointer)).fold(f32::INFINITY, f32::min),
        HandleShape::Square(corners) => {
            if contains(corners, pointer) {
                0.0
            } else {
                f32::INFINITY
            }
        }
    }
}

/// The distance of a point from a line between two others.
fn distance([from, to]: [Pos2; 2], at: Pos2) -> f32 {
    let way = to - from;
    let part = ((at - from).dot(way) / way.length_sq().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    (from + way * part).distance(at)
}

/// Twice the signed area to the left of a line, seen from a point.
fn side(from: Pos2, to: Pos2, at: Pos2) -> f32 {
    (to.x - from.x) * (at.y - from.y) - (to.y - from.y) * (at.x - from.x)
}

fn contains(corners: &[Pos2; 4], at: Pos2) -> bool {
    let sides = [0, 1, 2, 3].map(|i| side(corners[i], corners[(i + 1) % 4], at));
    sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0)
}

/// The area of a square that is seen at an angle, square points.
fn area_of([a, b, c, d]: &[Pos2; 4]) -> f32 {
    0.5 * (side(*a, *b, *c) + side(*a, *c, *d)).abs()
}

#[cfg(test)]
mod tests {
    use egui::{Rect, Vec2};

    use super::{super::tests::oblique_camera as camera, *};

    /// An image at twice its size.
    fn area() -> PictureArea {
        let rect = Rect::from_min_size(Pos2::new(50.0, 20.0), Vec2::new(600.0, 400.0));
        PictureArea { clip: rect, rect, resolution: Vec2::new(300.0, 200.0) }
    }

    fn of(mode: Mode) -> Vec<Handle> {
        handles(mode, DVec3::ZERO, &camera(), &area())
    }

    /// A point in the middle of a handle.
    fn middle(handle: &Handle) -> Pos2 {
        match &handle.shape {
            HandleShape::Axis([from, to]) => from.lerp(*to, 0.8),
            HandleShape::Square([a, _, c, _]) => a.lerp(*c, 0.5),
            HandleShape::Ring(sides) => sides[sides.len() / 2][0],
            HandleShape::Circle(center, radius) if *radius > REACH => *center + Vec2::new(*radius, 0.0),
            HandleShape::Circle(center, _) => *center,
        }
    }

    #[test]
    fn every_handle_is_found_where_it_lies() {
        for (mode, count) in [(Mode::Move, 7), (Mode::Scale, 7), (Mode::Rotate, 4)] {
            let handles = of(mode);
            assert_eq!(handles.len(), count, "{mode:?}");
            for handle in &handles {
                assert_eq!(under(&handles, middle(handle)).map(|found| found.lock), Some(handle.lock), "{mode:?}");
            }
            assert_eq!(under(&handles, Pos2::new(60.0, 30.0)), None);
        }
    }

    #[test]
    fn handles_are_as_long_at_any_distance() {
        for distance in [1.0, 100.0] {
            let camera = Camera { eye: DVec3::new(0.0, 0.0, distance), ..camera() };
            let handles = handles(Mode::Move, DVec3::ZERO, &camera, &area());
            let x = handles.iter().find(|handle| handle.lock == Lock::Axis(0)).expect("it is seen from the side");
            let HandleShape::Axis([from, to]) = x.shape else { panic!("it is an axis") };
            assert!((from.distance(to) - LENGTH as f32).abs() < 0.1, "{distance}");
            let towards_viewer = handles.iter().find(|handle| handle.lock == Lock::Axis(2));
            assert_eq!(towards_viewer, None, "nobody could say how far");
        }
    }

    #[test]
    fn a_pivot_behind_the_camera_has_no_handles() {
        assert!(handles(Mode::Move, DVec3::new(9.0, 6.0, 15.0), &camera(), &area()).is_empty());
    }
}
