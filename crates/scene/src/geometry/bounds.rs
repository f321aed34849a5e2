//! Axis-aligned bounding boxes.

/// An axis-aligned box: all points p with `min` ≤ p ≤ `max` in each component. It may be flat, or a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub min: [f32; 3],
    pub max: [f32; 3],
}

impl Bounds {
    /// The empty box, the neutral element of unions.
    pub const EMPTY: Bounds = Bounds { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] };

    /// The smallest box around the points.
    #[inline]
    pub fn of_points(points: impl IntoIterator<Item = [f32; 3]>) -> Bounds {
        points.into_iter().fold(Bounds::EMPTY, |bounds, p| bounds.union(&Bounds { min: p, max: p }))
    }

    /// The smallest box around two boxes.
    #[inline]
    pub fn union(&self, other: &Bounds) -> Bounds {
        Bounds {
            min: [self.min[0].min(other.min[0]), self.min[1].min(other.min[1]), self.min[2].min(other.min[2])],
            max: [self.max[0].max(other.max[0]), self.max[1].max(other.max[1]), self.max[2].max(other.max[2])],
        }
    }

    /// Whether the box contains no point.
    pub fn is_empty(&self) -> bool {
        !(0..3).all(|axis| self.min[axis] <= self.max[axis])
    }

    /// Edge lengths; 0 for an empty box.
    pub fn size(&self) -> [f32; 3] {
        std::array::from_fn(|axis| (self.max[axis] - self.min[axis]).max(0.0))
    }

    /// Area of the six faces.
    pub fn surface_area(&self) -> f32 {
        let [x, y, z] = self.size();
        2.0 * (x * y + y * z + z * x)
    }

    /// Whether both have a point in common.
    pub fn overlaps(&self, other: &Bounds) -> bool {
        (0..3).all(|axis| self.min[axis] <= other.max[axis] && other.min[axis] <= self.max[axis])
    }

    /// Whether `other` lies inside.
    pub fn contains(&self, other: &Bounds) -> bool {
        (0..3).all(|axis| self.min[axis] <= other.min[axis] && other.max[axis] <= self.max[axis])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unions_sizes_and_areas() {
        let a = Bounds::of_points([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]]);
        let flat = Bounds::of_points([[4.0, 1.0, 1.0], [4.0, 2.0, 3.0]]);
        assert_eq!((a.surface_area(), flat.surface_area()), (22.0, 4.0));
        assert_eq!(a.union(&flat), Bounds { min: [0.0; 3], max: [4.0, 2.0, 3.0] });
        assert!(a.union(&flat).contains(&a) && !a.contains(&flat));
        assert!(!a.overlaps(&flat) && a.overlaps(&a.union(&flat)) && a.overlaps(&Bounds::of_points([[1.0, 2.0, 3.0]])));
    }

    #[test]
    fn the_empty_box_is_neutral() {
        let point = Bounds::of_points([[1.0, -2.0, 3.0]]);
        assert_eq!(Bounds::EMPTY.union(&point), point);
        assert!(Bounds::EMPTY.is_empty() && !point.is_empty());
        assert_eq!((Bounds::EMPTY.surface_area(), point.surface_area()), (0.0, 0.0));
        assert!(point.contains(&Bounds::EMPTY));
    }
}
