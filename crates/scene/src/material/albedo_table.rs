//! Builds the tables of [`super::albedo`] by quadrature.
use fearless_simd_macros::simd;

use super::{
    beckmann::Beckmann,
    fresnel::dielectric,
    ggx::SMOOTH,
    microfacets::{Distribution, Microfacets, g1},
};
use noisefall_base::math::{F, Lanes, MAX_LANES, One, Pick, SimdLevel, V, in_lanes};

/// The function of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tabulated {
    /// 1 − E(μ, α) of perfectly reflecting microfacets. The average is that of the function.
    Loss,
    /// E(μ, α)/F(μ) of a coat of this index, which unlike E depends on μ/α alone at small α. The average is that of 1 − E.
    Coat(f32),
    /// T(μ, α) − (1 − F(μ)): what the facets of a coat of this index let pass by one refraction, compared with a smooth coat. The
    /// average is that of the function.
    Refraction(f32, Distribution),
}

/// Number of cells in x; their ends fill registers.
pub const ACROSS: usize = 2 * MAX_LANES - 1;
/// Number of cells in √α.
pub const DOWN: usize = 64;

/// The values at the ends of the cells in x.
type Line = [f32; ACROSS + 1];

/// Builds a table: rows with the corners of the cells, then a row for the average over each line of cells.
pub fn build(level: SimdLevel, of: Tabulated) -> Vec<[f32; 4]> {
    let points = lattice(1597, 987);
    let lines: Vec<Line> = (0..=DOWN)
        .map(|j| {
            let mut values = [0.0; ACROSS + 1];
            in_lanes!(level, l => line(l, &points, width(j as f64) as f32, of, &mut values));
            values
        })
        .collect();
    let pairs = || lines.windows(2);
    let cells = pairs().flat_map(|pair| (0..ACROSS).map(move |i| [pair[0][i], pair[0][i + 1], pair[1][i], pair[1][i + 1]]));
    cells.chain(pairs().enumerate().map(|(j, pair)| cubic(j, &pair[0], &pair[1], of))).collect()
}

/// α at the height `y` of the table.
fn width(y: f64) -> f64 {
    let root = f64::from(SMOOTH).sqrt();
    (root + (1.0 - root) * y / DOWN as f64).powi(2)
}

/// Points of the unit square with weights: a Fibonacci lattice, denser towards u.0 = 1, where the microfacets are steepest.
/// `count` and `step` are consecutive Fibonacci numbers.
pub fn lattice(count: u32, step: u32) -> Vec<[f32; 3]> {
    let points = f64::from(count);
    let point = |i: u32| {
        let rest = 1.0 - (f64::from(i) + 0.5) / points;
        let turn = (f64::from(i * step % count) + 0.5) / points;
        [1.0 - rest.powi(4), turn, 4.0 * rest.powi(3) / points].map(|x| x as f32)
    };
    (0..count).map(point).collect()
}

/// Expectation over visible normals, at the ends of the cells of one α.
#[simd]
fn line<L: Lanes>(l: L, lattice: &[[f32; 3]], alpha: f32, of: Tabulated, values: &mut Line) {
    match of {
        Tabulated::Refraction(_, Distribution::Beckmann) => expectations(l, lattice, Beckmann(l.f(alpha)), alpha, of, values),
        _ => expectations(l, lattice, l.f(alpha), alpha, of, values),
    }
}

#[inline(always)]
fn expectations<L: Lanes>(l: L, lattice: &[[f32; 3]], facets: impl Microfacets<L>, alpha: f32, of: Tabulated, values: &mut Line) {
    let (zero, one) = (l.f(0.0), l.f(1.0));
    for start in (0..=ACROSS).step_by(L::N) {
        let x = (l.iota() + start as u32).to_real() / ACROSS as f32;
        let mu = (alpha * x / (1.0 + alpha - x)).min(one);
        let wo = V { x: ((1.0 - mu) * (1.0 + mu)).sqrt(), y: zero, z: mu };
        let mut sum = zero;
        for &[u, v, weight] in lattice {
            let h = facets.sample_visible_normal(wo, (l.f(u), l.f(v)));
            let cos = wo.dot(h);
            let value = match of {
                Tabulated::Loss => 1.0 - reflected(facets, wo, h),
                Tabulated::Coat(ior) => reflected(facets, wo, h) * dielectric(cos.max(zero), l.f(ior)).0,
                Tabulated::Refraction(ior, _) => refracted(facets, wo, h, l.f(ior)),
            };
            sum = sum + value * weight;
        }
        match of {
            Tabulated::Loss => {}
            Tabulated::Coat(ior) => sum = sum / dielectric(mu, l.f(ior)).0.max(l.f(1e-9)),
            Tabulated::Refraction(ior, _) => sum = sum - (1.0 - dielectric(mu, l.f(ior)).0),
        }
        sum.store(&mut values[start..]);
    }
}

/// Fraction of the light from the facet `h` that leaves, if the facet reflects all light.
#[inline(always)]
fn reflected<L: Lanes>(facets: impl Microfacets<L>, wo: V<L>, h: V<L>) -> F<L> {
    let wi = h * (2.0 * wo.dot(h)) - wo;
    wi.z.above(0.0).pick(g1(facets, wi), wo.z.splat(0.0))
}

/// Fraction of the light on the facet `h` that passes it and no other facet.
#[inline(always)]
fn refracted<L: Lanes>(facets: impl Microfacets<L>, wo: V<L>, h: V<L>, ior: F<L>) -> F<L> {
    let zero = wo.z.splat(0.0);
    let cos = wo.dot(h).max(zero);
    let (mirrored, cos_t) = dielectric(cos, ior);
    let inverse = 1.0 / ior;
    let wi = (h * (cos * inverse - cos_t) + -wo * inverse).normalized();
    wi.z.below(0.0).pick(g1(facets, wi) * (1.0 - mirrored), zero)
}

/// The average between one line and the next, as a cubic in Newton's form through thirds of the interval.
fn cubic(j: usize, low: &Line, high: &Line, of: Tabulated) -> [f32; 4] {
    let at = |third: u32| {
        let t = f64::from(third) / 3.0;
        let mut between = *low;
        for (value, high) in between.iter_mut().zip(high) {
            *value += (high - *value) * t as f32;
        }
        average(&between, width(j as f64 + t), of)
    };
    let [a, b, c, d] = [at(0), at(1), at(2), at(3)];
    [a, b - a, (c - 2.0 * b + a) / 2.0, (d - 3.0 * c + 3.0 * b - a) / 6.0].map(|x| x as f32)
}

/// 2 ∫₀¹ of the interpolated loss, or of the light that the coat transmits, × μ dμ, by the midpoint rule in ⁴√μ, which resolves
/// the smallest α.
fn average(line: &Line, alpha: f64, of: Tabulated) -> f64 {
    const STEPS: u32 = 512;
    let mut sum = 0.0;
    for step in 0..STEPS {
        let s = (f64::from(step) + 0.5) / f64::from(STEPS);
        let mu = s.powi(4);
        let x = mu * (1.0 + alpha) / (mu + alpha) * ACROSS as f64;
        let cell = (x as usize).min(ACROSS - 1);
        let value = f64::from(line[cell]) + f64::from(line[cell + 1] - line[cell]) * (x - cell as f64);
        let value = match of {
            Tabulated::Loss | Tabulated::Refraction(..) => value,
            Tabulated::Coat(ior) => 1.0 - value * f64::from(dielectric(F::<One>(mu as f32), F(ior)).0.0),
        };
        sum += value * 8.0 * s.powi(7);
    }
    sum / f64::from(STEPS)
}
