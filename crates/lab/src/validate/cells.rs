//! Cells of directions, for histograms of samples and integrals of functions.
use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::microfacets::direction;

/// Cells around an axis, half of which lie within the angle 2 atan `width`.
pub struct Cells {
    frame: DMat3,
    width: f64,
    /// Quadrature points along each side of a cell.
    steps: usize,
}

impl Cells {
    /// Numbers of cells in the angle to the axis and around the axis.
    const SIDES: [usize; 2] = [12, 8];
    pub const COUNT: usize = Self::SIDES[0] * Self::SIDES[1];

    /// Grids around the mirror direction of `wo` (for z > 0) and, if the surface transmits, around the refracted direction (for z
    /// < 0).
    /// For wide lobes the axis is the normal.
    pub fn of_lobes(wo: DVec3, width: f64, eta: Option<f64>, steps: usize) -> Vec<Cells> {
        let is_wide = eta.is_none() && width >= 1.0;
        let mirrored = if is_wide { DVec3::Z } else { DVec3::new(-wo.x, -wo.y, wo.z) };
        let refracted = |eta: f64| {
            let across = DVec3::new(-wo.x, -wo.y, 0.0) / eta;
            // Beyond the critical angle the axis lies along the surface.
            (across - DVec3::Z * (1.0 - across.length_squared()).max(0.01).sqrt()).normalize()
        };
        let axes = std::iter::once(mirrored).chain(eta.map(refracted));
        axes.map(|axis| Cells::around(axis, width, steps)).collect()
    }

    pub fn around(axis: DVec3, width: f64, steps: usize) -> Cells {
        let (a, b) = axis.any_orthonormal_pair();
        Cells { frame: DMat3::from_cols(a, b, axis), width, steps }
    }

    /// The cell of a direction. Cells are uniform in a = t/(t + width) with t = tan(γ/2) for the angle γ to the axis.
    pub fn cell(&self, w: DVec3) -> usize {
        let w = self.frame.transpose() * w;
        let t = ((1.0 - w.z).max(0.0) / (1.0 + w.z).max(1e-12)).sqrt();
        let a = t / (t + self.width);
        let turn = (w.y.atan2(w.x) / TAU).rem_euclid(1.0);
        let [a, b] = [0, 1].map(|k| (([a, turn][k] * Self::SIDES[k] as f64) as usize).min(Self::SIDES[k] - 1));
        a * Self::SIDES[1] + b
    }

    /// The integrals of a function of directions over every cell.
    pub fn integrals(&self, of: &impl Fn(DVec3) -> f64) -> Vec<f64> {
        let steps = self.steps;
        let [down, around] = Self::SIDES.map(|n| (n * steps) as f64);
        let point = |cell: usize, step: usize| {
            let a = ((cell / Self::SIDES[1] * steps + step / steps) as f64 + 0.5) / down;
            let turn = ((cell % Self::SIDES[1] * steps + step % steps) as f64 + 0.5) / around;
            let t = self.width * a / (1.0 - a);
            // dω = 4t dt/(1 + t²)² dφ.
            let area = TAU * 4.0 * t * self.width / ((1.0 - a) * (1.0 + t * t)).powi(2);
            of(self.frame * direction((1.0 - t * t) / (1.0 + t * t), TAU * turn)) * area / (down * around)
        };
        (0..Self::COUNT).map(|cell| (0..steps * steps).map(|step| point(cell, step)).sum()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_cover_the_sphere_and_hold_the_integrals_over_them() {
        for width in [0.05, 0.5, 2.0] {
            let cells = Cells::around(DVec3::new(0.6, 0.0, 0.8), width, 16);
            let all: f64 = cells.integrals(&|_| 1.0).iter().sum();
            assert!((all / (2.0 * TAU) - 1.0).abs() < 1e-2, "{width}: {all}");
            // Every direction of a cell must be counted in that cell.
            for (i, part) in cells.integrals(&|w| if cells.cell(w) == 37 { 1.0 } else { 0.0 }).into_iter().enumerate() {
                assert_eq!(part > 0.0, i == 37, "{width}: {i}");
            }
        }
    }

    #[test]
    fn lobes_lie_around_the_mirrored_and_the_refracted_direction() {
        let wo = DVec3::new(0.48, -0.36, 0.8);
        for eta in [1.5, 1.0 / 1.5] {
            let axes: Vec<DVec3> = Cells::of_lobes(wo, 0.1, Some(eta), 1).iter().map(|cells| cells.frame.z_axis).collect();
            assert_eq!(axes[0], DVec3::new(-0.48, 0.36, 0.8));
            // Snell: across the normal, the direction times the index stays.
            let refracted = axes[1] * eta;
            assert!((refracted + wo).truncate().length() < 1e-12 && refracted.z < 0.0, "{eta}: {refracted}");
        }
    }
}
