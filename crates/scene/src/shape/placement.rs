//! Places where shapes are added.
use glam::DVec3;

use super::{bounds::Bounds, transform::Transform};

/// Extent of what is around a new object relative to its size.
const PART_OF_EXTENT: f64 = 8.0;
/// Smallest y of the unit normal of a floor. On steeper surfaces new objects stand along the normal.
const STEEPEST_FLOOR: f64 = 0.7;

/// The point where an object is added.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    /// The point on a surface, metres.
    pub at: DVec3,
    /// The direction that the surface faces there.
    pub normal: DVec3,
    /// The extent of what is seen there, metres.
    pub extent: f64,
}

impl Placement {
    /// The size of the new object: 1, 2 or 5 times a power of ten, metres.
    pub fn size(&self) -> f64 {
        let wanted = self.extent / PART_OF_EXTENT;
        if !(wanted.is_finite() && wanted > 0.0) {
            return 1.0;
        }
        let exponent = wanted.log10().floor() as i32;
        let digit = [5, 2, 1].into_iter().find(|digit| f64::from(*digit) <= wanted * 10f64.powi(-exponent)).unwrap_or(1);
        // Read as it is written, so that it is as short as it can be.
        format!("{digit}e{exponent}").parse().unwrap_or(wanted)
    }

    /// The number of decimals that resolves a thousandth of the size.
    fn decimals(&self) -> usize {
        (3.0 - self.size().log10().floor()).max(0.0) as usize
    }

    /// The point, rounded to short coordinates.
    pub fn rounded(&self, p: DVec3) -> DVec3 {
        let decimals = self.decimals();
        // Adding 0 turns −0 into 0.
        p.to_array().map(|x| format!("{x:.decimals$}").parse::<f64>().unwrap_or(x) + 0.0).into()
    }

    /// Whether the surface is a floor: horizontal, or not much steeper.
    pub fn is_on_floor(&self) -> bool {
        self.normal.y > STEEPEST_FLOOR
    }

    /// The direction in which the object stands on the surface: up on floors.
    pub(super) fn up(&self) -> DVec3 {
        let normal = self.normal.try_normalize().unwrap_or(DVec3::Y);
        if normal.y > STEEPEST_FLOOR { DVec3::Y } else { normal }
    }

    /// Two directions along the surface; their cross product is the direction that it faces.
    fn along(&self) -> [DVec3; 2] {
        let up = self.up();
        let side = if up.y.abs() > STEEPEST_FLOOR { DVec3::Z.cross(up) } else { DVec3::Y.cross(up) };
        let u = side.normalize();
        [u, up.cross(u)]
    }

    /// Half of the size.
    pub fn half(&self) -> f64 {
        self.size() / 2.0
    }

    /// The point at a height over the surface, metres.
    pub fn reached(&self, height: f64) -> DVec3 {
        self.rounded(self.at + self.up() * height)
    }

    /// The middle of a cube along the axes whose nearest corner, edge or face touches the surface.
    fn middle(&self) -> DVec3 {
        let up = self.up();
        self.reached(self.half() * (up.x.abs() + up.y.abs() + up.z.abs()))
    }

    /// That cube.
    pub(super) fn cube(&self) -> Bounds {
        let (middle, half) = (self.middle(), DVec3::splat(self.half()));
        Bounds { min: self.rounded(middle - half), max: self.rounded(middle + half) }
    }

    /// The transforms that take the cube from −1 to 1 to that cube.
    pub fn transforms(&self) -> Vec<Transform> {
        vec![Transform::Scale(DVec3::splat(self.half())), Transform::Translate(self.middle())]
    }

    /// The point just above the surface, for flat shapes.
    pub(super) fn above(&self) -> DVec3 {
        self.reached(10f64.powi(-(self.decimals() as i32)))
    }

    /// A square around that point that faces away from the surface: its first corner and its edges.
    pub(super) fn square(&self) -> (DVec3, [DVec3; 2]) {
        let [u, v] = self.along().map(|direction| self.rounded(direction * self.size()));
        (self.rounded(self.above() - (u + v) / 2.0), [u, v])
    }
}
