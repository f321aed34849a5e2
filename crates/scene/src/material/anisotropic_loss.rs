//! The light that single scattering between anisotropic facets loses.
//!
//! It depends on four numbers: the cosine, the azimuth and both widths. A coarse table holds it as a part of what round facets of the larger
//! width lose, which `albedo.rs` has finely: that part varies slowly, and is 1 if both widths are equal. So anisotropy begins without a
//! jump. The table takes some tens of milliseconds, once, in programs that need it.
use std::sync::LazyLock;

use fearless_simd_macros::simd;
use rayon::prelude::*;

use super::{
    albedo::{Albedo, LOSS, cell},
    anisotropy::Widths,
    ggx::SMOOTH,
    microfacets::{g1, sample_reflection},
};
use noisefall_base::math::{F, Lanes, M, MAX_LANES, One, Pick, SimdLevel, U, V, in_lanes};

/// Ends of the cells in x = μ(1 + α)/(μ + α), where α is the larger width.
const ACROSS: usize = MAX_LANES;
/// Ends of the cells in √α, in the cosine of the azimuth from the axis of α, and in the root of the quotient of the widths.
const DOWN: usize = 9;
const AZIMUTHS: usize = 9;
const QUOTIENTS: usize = 9;
/// Rows of one x and one α: the corners of cells in azimuth and quotient.
const PLANE: usize = (AZIMUTHS - 1) * (QUOTIENTS - 1);
/// First row of the averages: the corners of cells in √α and quotient.
const AVERAGES: usize = ACROSS * DOWN * PLANE;

/// The table.
pub static PARTS: LazyLock<Vec<[f32; 4]>> = LazyLock::new(|| build(SimdLevel::best()));

/// The lost light of facets with known widths.
#[derive(Clone, Copy)]
pub struct AnisotropicLoss<'a, L: Lanes> {
    l: L,
    /// Loss of round facets of the larger width.
    round: Albedo<'a, L>,
    parts: &'a [[f32; 4]],
    widths: Widths<L>,
    /// Lanes whose widths differ.
    anisotropic: M<L>,
    larger: F<L>,
}

impl<'a, L: Lanes> AnisotropicLoss<'a, L> {
    /// `tables` are those of round facets and [`PARTS`]; the latter may be empty if no lane is `anisotropic`.
    #[inline(always)]
    pub fn new(l: L, [round, parts]: [&'a [[f32; 4]]; 2], widths: Widths<L>, anisotropic: M<L>) -> Self {
        let mut larger = widths.mean();
        if anisotropic.any() {
            larger = anisotropic.pick(widths.larger(), larger);
        }
        let round = Albedo::at(round, l.u(0), larger);
        AnisotropicLoss { l, round, parts, widths, anisotropic, larger }
    }

    /// The cells in √α and in the quotient, and the positions in them.
    #[inline(always)]
    fn cells(&self) -> [(U<L>, F<L>); 2] {
        let root = SMOOTH.sqrt();
        let down = (self.larger.sqrt() - root) * ((DOWN - 1) as f32 / (1.0 - root));
        let quotient = self.widths.quotient().sqrt() * (QUOTIENTS - 1) as f32;
        [cell(down, DOWN - 1), cell(quotient, QUOTIENTS - 1)]
    }

    /// 1 − E of perfectly reflecting facets seen from `w` above the surface.
    #[inline(always)]
    pub fn at(&self, w: V<L>) -> F<L> {
        let mu = w.z.max(w.z.splat(0.0));
        let round = self.round.value(self.l, mu);
        if !self.anisotropic.any() {
            return round;
        }
        let x = mu * (1.0 + self.larger) / (mu + self.larger);
        let (across, s) = cell(x * (ACROSS - 1) as f32, ACROSS - 1);
        let [(down, t), (quotient, q)] = self.cells();
        let (azimuth, p) = cell(self.widths.towards_larger(w) * (AZIMUTHS - 1) as f32, AZIMUTHS - 1);
        let first = (across * DOWN as u32 + down) * PLANE as u32 + azimuth * (QUOTIENTS - 1) as u32 + quotient;
        let low = self.between(first, p, q, t);
        let high = self.between(first + (DOWN * PLANE) as u32, p, q, t);
        self.anisotropic.pick(round * (low + (high - low) * s), round)
    }

    /// Between the planes at two α.
    #[inline(always)]
    fn between(&self, first: U<L>, p: F<L>, q: F<L>, t: F<L>) -> F<L> {
        let near = mixed(self.l.rows(self.parts, first), p, q);
        let far = mixed(self.l.rows(self.parts, first + PLANE as u32), p, q);
        near + (far - near) * t
    }

    /// Its average over diffuse light.
    #[inline(always)]
    pub fn average(&self) -> F<L> {
        let round = self.round.average(self.l);
        if !self.anisotropic.any() {
            return round;
        }
        let [(down, t), (quotient, q)] = self.cells();
        let row = down * (QUOTIENTS - 1) as u32 + quotient + AVERAGES as u32;
        self.anisotropic.pick(round * mixed(self.l.rows(self.parts, row), t, q), round)
    }

    /// The larger width.
    #[inline(always)]
    pub fn width(&self) -> F<L> {
        self.larger
    }
}

/// Interpolates between the corners of a cell.
#[inline(always)]
fn mixed<L: Lanes>([a, b, c, d]: [F<L>; 4], s: F<L>, t: F<L>) -> F<L> {
    let (low, high) = (a + (b - a) * t, c + (d - c) * t);
    low + (high - low) * s
}

/// The corners of the cells of a list of `columns` values a line.
fn corners(values: &[f32], columns: usize) -> impl Iterator<Item = [f32; 4]> {
    let lines: Vec<&[f32]> = values.chunks_exact(columns).collect();
    let pairs: Vec<[&[f32]; 2]> = lines.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    pairs.into_iter().flat_map(|[a, b]| a.windows(2).zip(b.windows(2)).map(|(a, b)| [a[0], a[1], b[0], b[1]]).collect::<Vec<_>>())
}

/// α at the end `j` of a cell, and a quotient.
fn width(j: usize) -> f32 {
    let root = SMOOTH.sqrt();
    (root + (1.0 - root) * j as f32 / (DOWN - 1) as f32).powi(2)
}

fn quotient(k: usize) -> f32 {
    (k as f32 / (QUOTIENTS - 1) as f32).powi(2)
}

fn build(level: SimdLevel) -> Vec<[f32; 4]> {
    let points = super::albedo_table::lattice(610, 377);
    let places: Vec<[usize; 3]> =
        (0..DOWN * AZIMUTHS * QUOTIENTS).map(|i| [i / (AZIMUTHS * QUOTIENTS), i / QUOTIENTS % AZIMUTHS, i % QUOTIENTS]).collect();
    let of_place = |&[j, azimuth, k]: &[usize; 3]| in_lanes!(level, l => losses(l, &points, [j, azimuth, k]));
    let losses: Vec<[f32; ACROSS]> = places.par_iter().map(of_place).collect();
    let part = |i: usize, j: usize, azimuth: usize, k: usize| {
        let of = |azimuth: usize, k: usize| losses[(j * AZIMUTHS + azimuth) * QUOTIENTS + k][i];
        if k == QUOTIENTS - 1 { 1.0 } else { of(azimuth, k) / of(azimuth, QUOTIENTS - 1) }
    };
    let mut rows = Vec::with_capacity(AVERAGES + (DOWN - 1) * (QUOTIENTS - 1));
    for (i, j) in (0..ACROSS).flat_map(|i| (0..DOWN).map(move |j| (i, j))) {
        let plane: Vec<f32> = (0..AZIMUTHS * QUOTIENTS).map(|at| part(i, j, at / QUOTIENTS, at % QUOTIENTS)).collect();
        rows.extend(corners(&plane, QUOTIENTS));
    }
    let average = |at: usize| average(&rows, width(at / QUOTIENTS), at % QUOTIENTS);
    let averages: Vec<f32> = (0..DOWN * QUOTIENTS).into_par_iter().map(average).collect();
    rows.extend(corners(&averages, QUOTIENTS));
    rows
}

/// The loss at the ends of the cells in x.
#[simd]
fn losses<L: Lanes>(l: L, points: &[[f32; 3]], [j, azimuth, k]: [usize; 3]) -> [f32; ACROSS] {
    let alpha = width(j);
    let widths = Widths::along(l.f(alpha), l.f(alpha * quotient(k)));
    let cos = azimuth as f32 / (AZIMUTHS - 1) as f32;
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    let mut values = [0.0; ACROSS];
    for start in (0..ACROSS).step_by(L::N) {
        let x = (l.iota() + start as u32).to_real() / (ACROSS - 1) as f32;
        // The view along the surface is the limit of grazing ones.
        let mu = (alpha * x / (1.0 + alpha - x)).min(l.f(1.0)).max(l.f(1e-5 * alpha));
        let r = ((1.0 - mu) * (1.0 + mu)).sqrt();
        let wo = V { x: r * cos, y: r * sin, z: mu };
        let mut sum = l.f(0.0);
        for &[u, v, weight] in points {
            let wi = sample_reflection(widths, wo, (l.f(u), l.f(v)));
            sum = sum + (1.0 - wi.z.above(0.0).pick(g1(widths, wi), l.f(0.0))) * weight;
        }
        sum.store(&mut values[start..]);
    }
    values
}

/// The average of the interpolated loss as a part of that of round facets.
fn average(rows: &[[f32; 4]], alpha: f32, k: usize) -> f32 {
    const STEPS: usize = 64;
    const TURNS: usize = 24;
    if k == QUOTIENTS - 1 {
        return 1.0;
    }
    let widths = Widths::along(F::<One>(alpha), F(alpha * quotient(k)));
    let loss = AnisotropicLoss::new(One, [&LOSS, rows], widths, M(true));
    let mut sum = 0.0;
    for (step, turn) in (0..STEPS).flat_map(|step| (0..TURNS).map(move |turn| (step, turn))) {
        let s = (step as f64 + 0.5) / STEPS as f64;
        let mu = s.powi(4);
        let (sin, cos) = ((turn as f64 + 0.5) / TURNS as f64 * std::f64::consts::FRAC_PI_2).sin_cos();
        let r = ((1.0 - mu) * (1.0 + mu)).sqrt();
        let w = V::splat(One, [r * cos, r * sin, mu].map(|x| x as f32));
        sum += f64::from(loss.at(w).0) * 8.0 * s.powi(7);
    }
    (sum / (STEPS * TURNS) as f64) as f32 / Albedo::at(&LOSS, U(0), F::<One>(alpha)).average(One).0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn true_loss(widths: Widths<One>, w: V<One>) -> f64 {
        const POINTS: u32 = 10_946;
        let lost = super::super::tests::lattice(POINTS, 6765).map(|u| {
            let wi = sample_reflection(widths, w, u);
            1.0 - if wi.z.0 > 0.0 { f64::from(g1(widths, wi).0) } else { 0.0 }
        });
        lost.sum::<f64>() / f64::from(POINTS)
    }

    #[test]
    fn the_loss_is_interpolated_within_a_hundredth() {
        let mut squares = 0.0;
        let mut count = 0.0;
        for (i, (a, b)) in super::super::tests::lattice(233, 144).enumerate() {
            let part = |step: f32| (i as f32 * step).fract();
            let (mu, turn) = (a.0 * a.0, part(0.754_877_7) * std::f32::consts::FRAC_PI_2);
            let (alpha, anisotropy) = (0.001 + 0.999 * b.0, part(0.569_840_3));
            let r = (1.0 - mu * mu).sqrt();
            let w = V::splat(One, [r * turn.cos(), r * turn.sin(), mu]);
            let widths = Widths::new(F(alpha), F(anisotropy));
            let found = f64::from(AnisotropicLoss::new(One, [&LOSS, &PARTS], widths, M(true)).at(w).0);
            let error = found - true_loss(widths, w);
            assert!(error.abs() < 0.012, "{alpha} {anisotropy} at {mu} {turn}: off by {error}");
            (squares, count) = (squares + error * error, count + 1.0);
        }
        let typical = f64::sqrt(squares / count);
        assert!(typical < 0.002, "{typical}");
    }

    #[test]
    fn anisotropy_begins_without_a_jump() {
        for (alpha, mu) in [(0.01, 0.02), (0.3, 0.4), (0.7, 0.05), (0.7, 0.9)] {
            let w = V::splat(One, [0.6 * f32::sqrt(1.0 - mu * mu), 0.8 * f32::sqrt(1.0 - mu * mu), mu]);
            let loss = |anisotropy: f32| {
                let widths = Widths::new(F(alpha), F(anisotropy));
                let loss = AnisotropicLoss::new(One, [&LOSS, &PARTS], widths, M(anisotropy > 0.0));
                [loss.at(w).0, loss.average().0]
            };
            for (round, nearly) in loss(0.0).into_iter().zip(loss(1e-4)) {
                assert!((round - nearly).abs() < 2e-4 * round, "{alpha} {mu}: {round} {nearly}");
            }
        }
    }

    #[test]
    fn other_instructions_give_the_same_table() {
        assert!(build(SimdLevel::Scalar) == *PARTS);
    }
}
