//! Directional albedo of rough surfaces, as a function of the cosine μ of the viewer's angle and the width α.
//!
//! A table holds a function of (μ, α) over cells that are uniform in x = μ(1 + α)/(μ + α) and in √α. For small α, the function at
//! μ ~ α depends on μ/α alone, and so on x: the same cells suit every α. A cell's row has the values at its four corners, so a
//! lookup is one gather.
//!
//! Averages are those of the interpolated function, not of the true one, so normalised functions integrate to 1 for every α.
use std::sync::LazyLock;

use super::{
    albedo_table::{ACROSS, DOWN, Tabulated, build},
    ggx::SMOOTH,
};
use noisefall_base::math::{F, Lanes, SimdLevel, U, round::floor};

/// Table of 1 − E(μ, α) of perfectly reflecting microfacets, the light that single scattering loses to shadowing, with its
/// average.
pub static LOSS: LazyLock<Vec<[f32; 4]>> = LazyLock::new(|| build(SimdLevel::best(), Tabulated::Loss));

/// A line of a table: α is fixed, per lane.
#[derive(Clone, Copy)]
pub struct Albedo<'a, L: Lanes> {
    table: &'a [[f32; 4]],
    /// Row of the line's first cell.
    cells: U<L>,
    /// Row of the line's average.
    average: U<L>,
    alpha: F<L>,
    /// Position of α between the lower and upper ends of the line.
    t: F<L>,
}

impl<'a, L: Lanes> Albedo<'a, L> {
    /// Looks up a line in the table that begins at row `first` of `table`; α is from [`SMOOTH`] to 1.
    #[inline(always)]
    pub fn at(table: &'a [[f32; 4]], first: U<L>, alpha: F<L>) -> Self {
        let root = SMOOTH.sqrt();
        let (line, t) = cell((alpha.sqrt() - root) * (DOWN as f32 / (1.0 - root)), DOWN);
        let cells = first + line * ACROSS as u32;
        Albedo { table, cells, average: first + line + (DOWN * ACROSS) as u32, alpha, t }
    }

    /// Its α.
    #[inline(always)]
    pub fn width(&self) -> F<L> {
        self.alpha
    }

    /// The function at cosine μ in [0, 1].
    #[inline(always)]
    pub fn value(&self, l: L, mu: F<L>) -> F<L> {
        let (index, s) = cell(mu * (1.0 + self.alpha) / (mu + self.alpha) * ACROSS as f32, ACROSS);
        let [a, b, c, d] = l.rows(self.table, self.cells + index);
        let low = a + (b - a) * s;
        let high = c + (d - c) * s;
        low + (high - low) * self.t
    }

    /// 2 ∫₀¹ of the function, or of the remaining light, × μ dμ: a cubic in Newton's form on thirds of the line.
    #[inline(always)]
    pub fn average(&self, l: L) -> F<L> {
        let [a, b, c, d] = l.rows(self.table, self.average);
        let n = self.t * 3.0;
        a + n * (b + (n - 1.0) * (c + (n - 2.0) * d))
    }
}

/// The cell of `x` in [0, cells], and the position of `x` in it from 0 to 1.
#[inline(always)]
pub(super) fn cell<L: Lanes>(x: F<L>, cells: usize) -> (U<L>, F<L>) {
    let (whole, index) = floor(x.max(x.splat(0.0)).min(x.splat((cells - 1) as f32)));
    (index, x - whole)
}
