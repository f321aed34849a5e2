//! Interference in a thin film on the base.
//!
//! L. Belcour and P. Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", SIGGRAPH 2017,
//! equations 8 to 10: the reflections inside the film are a series of cosines of the optical path difference. Approximations:
//! reflectances are those of unpolarised light, the series ends after the second term, the base is a dielectric whose index gives
//! its reflectance at normal incidence, and each channel sees one Gaussian band of wave numbers in place of the fits to the
//! colour-matching functions.
use std::f32::consts::LOG2_E;

use crate::{
    material::fresnel::dielectric,
    math::{F, Lanes, Pick, V, exp::exp2_of_negative, round::floor, trig::sin_cos_turns},
};

/// Wave numbers of the bands of red, green and blue, per µm: 1/0.612, 1/0.549 and 1/0.465.
const BANDS: [f32; 3] = [1.634, 1.8215, 2.1505];
/// Standard deviation of a band, per µm: about 0.09 µm of full width at half maximum in green.
const BAND_WIDTH: f32 = 0.13;
/// Number of terms.
const ORDERS: u32 = 2;

/// A film between air and a base.
#[derive(Clone, Copy)]
pub struct ThinFilm<L: Lanes> {
    /// Index of the film, at least 1.
    pub ior: F<L>,
    /// µm.
    pub thickness: F<L>,
    /// Indices that give the base its reflectance at normal incidence in air.
    pub base: V<L>,
}

impl<L: Lanes> ThinFilm<L> {
    /// Reflectance from 0 to 1 at the cosine in air.
    #[inline(always)]
    pub fn reflectance(&self, cos: F<L>) -> V<L> {
        let (outer, inside) = dielectric(cos, self.ior);
        // Optical path difference, µm.
        let path = self.ior * self.thickness * inside * 2.0;
        let spread = path * BAND_WIDTH;
        let relative = self.base * (1.0 / self.ior);
        V {
            x: series(outer, dielectric(inside, relative.x).0, path * BANDS[0], spread, relative.x),
            y: series(outer, dielectric(inside, relative.y).0, path * BANDS[1], spread, relative.y),
            z: series(outer, dielectric(inside, relative.z).0, path * BANDS[2], spread, relative.z),
        }
    }
}

/// The sum over reflections. `waves` is the path difference in wavelengths, `spread` that in standard deviations of the band.
#[inline(always)]
fn series<L: Lanes>(outer: F<L>, inner: F<L>, waves: F<L>, spread: F<L>, relative: F<L>) -> F<L> {
    let through = 1.0 - outer;
    let product = outer * inner;
    let once = through * through * inner / (1.0 - product).max(outer.splat(1e-6));
    let mut term = once - through;
    let mut sum = outer + once;
    let amplitude = product.sqrt();
    // A film between indices on either side of its own reflects both waves with the same sign.
    let half = relative.below(1.0).pick(outer.splat(0.0), outer.splat(0.5));
    for order in 1..=ORDERS {
        let m = order as f32;
        term = term * amplitude;
        let turns = (waves + half) * m;
        let cosine = sin_cos_turns(turns - floor(turns).0).1;
        let s = spread * m;
        // The mean of the cosine over the band: exp(−2π² s²).
        let damping = exp2_of_negative(s * s * (-19.739_21 * LOG2_E));
        sum = sum + term * cosine * damping * 2.0;
    }
    sum.max(outer.splat(0.0)).min(outer.splat(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::One;

    fn film(thickness: f32, base: f32) -> ThinFilm<One> {
        ThinFilm { ior: F(1.33), thickness: F(thickness), base: V::splat(One, [base; 3]) }
    }

    #[test]
    fn a_film_without_thickness_is_no_film() {
        for base in [1.5, 1.8] {
            for cos in [1.0, 0.7, 0.4] {
                let exact = dielectric(F::<One>(cos), F(base)).0.0;
                let found = film(0.0, base).reflectance(F(cos)).lane(0);
                assert!(found.iter().all(|x| (x - exact).abs() < 0.012), "{base} {cos}: {found:?} {exact}");
            }
        }
    }

    #[test]
    fn a_thick_film_has_no_colour_and_a_thin_one_has() {
        let [r, g, b] = film(5.0, 1.8).reflectance(F(0.9)).lane(0);
        assert!((r - g).abs() < 1e-4 && (g - b).abs() < 1e-4, "{r} {g} {b}");
        let [r, _, b] = film(0.3, 1.8).reflectance(F(0.9)).lane(0);
        assert!((r - b).abs() > 0.01, "{r} {b}");
    }

    #[test]
    fn reflectances_are_fractions() {
        for i in 0..1000 {
            let x = i as f32 / 1000.0;
            let found = film(x * 2.0, 1.0 + 4.0 * x).reflectance(F((x * 37.0).fract())).lane(0);
            assert!(found.iter().all(|x| (0.0..=1.0).contains(x)), "{found:?}");
        }
    }
}
