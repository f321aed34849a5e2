//! Energy compensation of rough dielectrics: lobes that restore the light that single scattering loses.
//!
//! Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 course, extended to dielectrics. With the
//! loss ℓ(μ) = 1 − E(μ), its cosine-weighted mean ℓ̄ on either side, and the mean loss X that crosses,
//!
//! f_reflected = (ℓ̄ − X)/ℓ̄² · ℓ(μ_o) ℓ(μ_i)/π,  f_transmitted = X/(ℓ̄ ℓ̄') · ℓ(μ_o) ℓ'(μ_i)/π  (primes: the far side).
//!
//! Together they scatter ℓ(μ_o), because ∫ ℓ(μ) μ dω = π ℓ̄. Their ratio is our own choice: see [`super::dielectric_albedo`].
use std::f32::consts::{FRAC_1_PI, PI};

use super::{
    albedo::cell,
    anisotropic_interface::AZIMUTHS,
    dielectric_albedo::{ALPHAS, CELLS, HALF, LEVEL_ROWS, LEVELS},
};
use noisefall_base::math::{F, Lanes, M, Pick, U, V, trig::sin_cos_turns};

/// Tables of the losses of materials, per lane.
#[derive(Clone, Copy)]
pub struct LossTable<'a, L: Lanes> {
    /// Rows of all materials, from [`super::dielectric_albedo`].
    pub rows: &'a [[f32; 4]],
    /// First row of the lane's material.
    pub offset: U<L>,
    /// Lanes whose material has rows for all roughnesses.
    pub textured: M<L>,
}

/// Rows of a material of one roughness without compensation.
pub fn nothing_missing() -> Vec<[f32; 4]> {
    vec![[0.0, 0.0, 1.0, 0.0]; LEVEL_ROWS]
}

/// The lost light of surface points with known roughness.
#[derive(Clone, Copy)]
pub struct MissingEnergy<'a, L: Lanes> {
    l: L,
    rows: &'a [[f32; 4]],
    /// First row of the roughness; the next roughness is `step` rows later, with weight `blend`.
    first: U<L>,
    step: U<L>,
    blend: F<L>,
    blends: bool,
    alpha: F<L>,
    /// Lanes whose viewer is outside the interface.
    outside: M<L>,
    /// Lanes with rows for each azimuth.
    turned: M<L>,
    turns: bool,
}

/// The loss at one cosine.
pub struct Loss<L: Lanes> {
    /// 1 − E(μ).
    pub here: F<L>,
    /// Mean over the cosines of this side, divided by α².
    mean: F<L>,
    /// Part of the mean that goes to the other side, divided by α².
    exchanged: F<L>,
}

impl<'a, L: Lanes> MissingEnergy<'a, L> {
    #[inline(always)]
    pub fn new(l: L, alpha: F<L>, outside: M<L>, table: LossTable<'a, L>) -> Self {
        MissingEnergy { turns: false, ..MissingEnergy::anisotropic(l, alpha, alpha, l.first(0), outside, table) }
    }

    /// Prepares lookups for facets whose larger width is `width`. In the lanes of `turned`, the table has rows for each azimuth.
    #[inline(always)]
    pub fn anisotropic(l: L, alpha: F<L>, width: F<L>, turned: M<L>, outside: M<L>, table: LossTable<'a, L>) -> Self {
        let (low, high) = (ALPHAS.start.sqrt().sqrt(), ALPHAS.end.sqrt().sqrt());
        let place = (alpha.sqrt().sqrt() - low) * ((LEVELS - 1) as f32 / (high - low));
        let (level, blend) = cell(place, LEVELS - 1);
        let LossTable { rows, offset, textured } = table;
        let rows_of_level = turned.pick(l.u((AZIMUTHS * LEVEL_ROWS) as u32), l.u(LEVEL_ROWS as u32));
        let first = offset + textured.pick(level * rows_of_level, l.u(0));
        let step = textured.pick(rows_of_level, l.u(0));
        let (blends, turns) = (textured.any(), turned.any());
        MissingEnergy { l, rows, first, step, blend, blends, alpha: width, outside, turned, turns }
    }

    /// Loss in a direction, on the far side of the interface in the lanes of `through`.
    #[inline(always)]
    pub fn loss(&self, w: V<L>, through: M<L>) -> Loss<L> {
        let cos = w.z.abs();
        let half = self.alpha * HALF;
        let (index, t) = cell(cos * (1.0 + half) / (cos + half) * CELLS as f32, CELLS);
        let outside = (self.outside & !through) | (!self.outside & through);
        let row = self.first + index + outside.pick(self.l.u(0), self.l.u(CELLS as u32));
        let [near, far, mean, exchanged] = self.row_towards(row, w);
        Loss { here: near + (far - near) * t, mean, exchanged }
    }

    /// A row, interpolated between two azimuths where facets are anisotropic; the tangent is x.
    #[inline(always)]
    fn row_towards(&self, at: U<L>, w: V<L>) -> [F<L>; 4] {
        if !self.turns {
            return self.row(at);
        }
        let square = w.x * w.x + w.y * w.y;
        let along = square.above(1e-12).pick(w.x.abs() / square.sqrt(), square.splat(1.0));
        let (azimuth, t) = cell(along * (AZIMUTHS - 1) as f32, AZIMUTHS - 1);
        let none = self.l.u(0);
        let at = at + self.turned.pick(azimuth * LEVEL_ROWS as u32, none);
        let [a, b, c, d] = self.row(at);
        let [p, q, r, s] = self.row(at + self.turned.pick(self.l.u(LEVEL_ROWS as u32), none));
        [a + (p - a) * t, b + (q - b) * t, c + (r - c) * t, d + (s - d) * t]
    }

    /// A row, interpolated between two roughnesses if they are textured.
    #[inline(always)]
    fn row(&self, at: U<L>) -> [F<L>; 4] {
        let [a, b, c, d] = self.l.rows(self.rows, at);
        if !self.blends {
            return [a, b, c, d];
        }
        let [p, q, r, s] = self.l.rows(self.rows, at + self.step);
        let w = self.blend;
        [a + (p - a) * w, b + (q - b) * w, c + (r - c) * w, d + (s - d) * w]
    }

    /// f |cos θ_i| without the scale of radiance, and the pdf of [`MissingEnergy::sample`], for the loss towards the viewer.
    #[inline(always)]
    pub fn eval(&self, viewer: &Loss<L>, wi: V<L>) -> (F<L>, F<L>) {
        let (through, cos) = (wi.z.below(0.0), wi.z.abs());
        let there = self.loss(wi, through);
        let crossing = viewer.exchanged / viewer.mean;
        let share = through.pick(crossing, 1.0 - crossing);
        let mean = there.mean * (self.alpha * self.alpha);
        (share * viewer.here * there.here / mean * cos * FRAC_1_PI, share * self.pdf(cos))
    }

    /// Samples a direction with the point `u` of the unit square; `lobe` in (0, 1) chooses the side.
    #[inline(always)]
    pub fn sample(&self, viewer: &Loss<L>, u: (F<L>, F<L>), lobe: F<L>) -> V<L> {
        let (start, end) = self.radii();
        let k = (u.0 * 2.0 - 1.0) * (end - start);
        let product = start * end;
        // The positive root of s² − ks − product, by the formula that does not cancel.
        let large = ((k * k + product * 4.0).sqrt() + k.abs()) * 0.5;
        let s = k.below(0.0).pick(product / large, large);
        let cos = ((s - start) * (s + start)).max(s.splat(0.0)).sqrt().min(s.splat(1.0));
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
        let (sin_phi, cos_phi) = sin_cos_turns(u.1);
        let through = lobe.lt(viewer.exchanged / viewer.mean);
        V { x: sin * cos_phi, y: sin * sin_phi, z: through.pick(-cos, cos) }
    }

    /// Pdf of a direction within its side, at cosine `cos`.
    ///
    /// The loss falls roughly as 1/(μ² + α²): most of it is at grazing angles. In s = √(μ² + α²), the pdf is the mean of one
    /// uniform in s and one uniform in 1/s, whose inverse needs only a square root. It is at least a fifth of the ideal pdf, or a
    /// ninth if the indices are almost equal.
    #[inline(always)]
    fn pdf(&self, cos: F<L>) -> F<L> {
        let (start, end) = self.radii();
        let square = cos * cos + start * start;
        cos * (1.0 + start * end / square) / (square.sqrt() * (end - start) * (4.0 * PI))
    }

    /// The first and the last s.
    #[inline(always)]
    fn radii(&self) -> (F<L>, F<L>) {
        (self.alpha, (1.0 + self.alpha * self.alpha).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::One;

    /// In a table whose loss is the number of its level, every level's roughness finds that number.
    #[test]
    fn a_roughness_finds_its_level() {
        let rows: Vec<[f32; 4]> = (0..LEVELS * LEVEL_ROWS).map(|row| [(row / LEVEL_ROWS) as f32; 4]).collect();
        let [first, last] = [ALPHAS.start, ALPHAS.end].map(|alpha| f64::from(alpha).sqrt().sqrt());
        for level in 0..LEVELS {
            let alpha = (first + (last - first) * level as f64 / (LEVELS - 1) as f64).powi(4) as f32;
            for outside in [true, false] {
                let table = LossTable { rows: &rows, offset: U(0), textured: M(true) };
                let loss = MissingEnergy::new(One, F(alpha), M(outside), table).loss(V::splat(One, [0.5, 0.7, 0.5]), M(false));
                assert!((loss.here.0 - level as f32).abs() < 1e-3, "{level}: {}", loss.here.0);
            }
        }
    }
}
