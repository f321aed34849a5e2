//! Interference in a thin film on the base.
//!
//! L. Belcour and P. Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", SIGGRAPH 2017,
//! equations 8 to 10: the reflections inside the film are a series of cosines of the optical path difference. Approximations:
//! the series ends after the second term, the base is a dielectric whose index gives its reflectance at normal incidence, and each
//! channel sees one Gaussian band of wave numbers in place of the fits to the colour-matching functions.
use std::f32::consts::LOG2_E;

use fearless_simd_macros::simd;

use crate::material::fresnel::dielectric;
use noisefall_base::math::{F, Lanes, Pick, V, exp::exp2_of_negative, round::floor, trig::sin_cos_turns};

/// Wave numbers of the bands of red, green and blue, per µm: 1/0.612, 1/0.549 and 1/0.465.
const BANDS: [f32; 3] = [1.634, 1.8215, 2.1505];
/// Standard deviation of a band, per µm: about 0.09 µm of full width at half maximum in green.
const BAND_WIDTH: f32 = 0.13;
/// Number of terms.
const ORDERS: usize = 2;

/// A film between air and a base. The indices of a base give it its reflectance at normal incidence in air.
#[derive(Clone, Copy)]
pub struct ThinFilm<L: Lanes> {
    /// Index of the film, at least 1.
    pub ior: F<L>,
    /// µm.
    pub thickness: F<L>,
}

impl<L: Lanes> ThinFilm<L> {
    /// Reflectance from 0 to 1 at the cosine in air.
    #[inline(always)]
    pub fn reflectance(&self, l: L, base: V<L>, cos: F<L>) -> V<L> {
        film_reflectance(l, self, base, cos)
    }

    /// No film of this index reflects more of unpolarised light, whatever its thickness: all waves have the same phase.
    #[inline(always)]
    pub fn most(&self, base: F<L>, cos: F<L>) -> F<L> {
        let (outer, inside) = dielectric(cos, self.ior);
        let inner = dielectric(inside, base / self.ior).0;
        let sum = outer.sqrt() + inner.sqrt();
        (sum * sum).min(cos.splat(1.0))
    }

    #[inline(always)]
    fn sums(&self, base: V<L>, cos: F<L>) -> V<L> {
        let outer = Amplitudes::new(cos, self.ior);
        let inside = dielectric(cos, self.ior).1;
        // Optical path difference, µm.
        let path = self.ior * self.thickness * inside * 2.0;
        let relative = base * (1.0 / self.ior);
        V {
            x: series(&outer, &Amplitudes::new(inside, relative.x), path, BANDS[0]),
            y: series(&outer, &Amplitudes::new(inside, relative.y), path, BANDS[1]),
            z: series(&outer, &Amplitudes::new(inside, relative.z), path, BANDS[2]),
        }
    }
}

/// Fresnel's amplitudes of an interface for the two polarisations; 1 beyond the critical angle, where their phase is left out.
struct Amplitudes<L: Lanes> {
    s: F<L>,
    p: F<L>,
}

impl<L: Lanes> Amplitudes<L> {
    #[inline(always)]
    fn new(cos: F<L>, eta: F<L>) -> Self {
        let (tiny, one) = (cos.splat(1e-15), cos.splat(1.0));
        let square = (eta - 1.0) * (eta + 1.0) + cos * cos;
        let g = square.max(cos.splat(0.0)).sqrt();
        let dense = eta * eta * cos;
        let refracts = square.above(0.0);
        Amplitudes {
            s: refracts.pick((cos - g) / (cos + g).max(tiny), one),
            p: refracts.pick((dense - g) / (dense + g).max(tiny), one),
        }
    }
}

/// [`ThinFilm::reflectance`] as a call: few materials have a film.
#[simd]
fn film_reflectance<L: Lanes>(l: L, film: &ThinFilm<L>, base: V<L>, cos: F<L>) -> V<L> {
    film.sums(base, cos.min(l.f(1.0)))
}

/// The reflectance of a channel: the mean of both polarisations. `path` is the path difference in µm.
#[inline(always)]
fn series<L: Lanes>(outer: &Amplitudes<L>, inner: &Amplitudes<L>, path: F<L>, band: f32) -> F<L> {
    let zero = path.splat(0.0);
    let mut cosines = [zero; ORDERS];
    for (order, cosine) in cosines.iter_mut().enumerate() {
        let m = (order + 1) as f32;
        let turns = path * (band * m);
        let spread = path * (BAND_WIDTH * m);
        // The mean of the cosine over the band: exp(−2π² s²).
        let damping = exp2_of_negative(spread * spread * (-19.739_21 * LOG2_E));
        *cosine = sin_cos_turns(turns - floor(turns).0).1 * damping * 2.0;
    }
    let sum = polarised(outer.s, inner.s, &cosines) + polarised(outer.p, inner.p, &cosines);
    (sum * 0.5).max(zero).min(zero.splat(1.0))
}

/// The sum over the reflections of a polarisation with these amplitudes.
#[inline(always)]
fn polarised<L: Lanes>(outer: F<L>, inner: F<L>, cosines: &[F<L>; ORDERS]) -> F<L> {
    let (first, second) = (outer * outer, inner * inner);
    let through = 1.0 - first;
    let once = through * through * second / (1.0 - first * second).max(outer.splat(1e-6));
    let step = -(outer * inner);
    let mut term = once - through;
    let mut sum = first + once;
    for cosine in cosines {
        term = term * step;
        sum = sum + term * *cosine;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::One;

    /// Reflectance of a film of soap water.
    fn film(thickness: f32, base: f32, cos: f32) -> [f32; 3] {
        soap(thickness).reflectance(One, V::splat(One, [base; 3]), F(cos)).lane(0)
    }

    fn soap(thickness: f32) -> ThinFilm<One> {
        ThinFilm { ior: F(1.33), thickness: F(thickness) }
    }

    #[test]
    fn a_film_without_thickness_is_no_film() {
        for base in [1.5, 1.8] {
            for cos in [1.0, 0.7, 0.4] {
                let exact = dielectric(F::<One>(cos), F(base)).0.0;
                let found = film(0.0, base, cos);
                assert!(found.iter().all(|x| (x - exact).abs() < 0.005), "{base} {cos}: {found:?} {exact}");
            }
        }
    }

    #[test]
    fn a_thick_film_has_no_colour_and_a_thin_one_has() {
        let [r, g, b] = film(5.0, 1.8, 0.9);
        assert!((r - g).abs() < 1e-4 && (g - b).abs() < 1e-4, "{r} {g} {b}");
        let [r, _, b] = film(0.3, 1.8, 0.9);
        assert!((r - b).abs() > 0.01, "{r} {b}");
    }

    #[test]
    fn reflectances_are_fractions() {
        for i in 0..1000 {
            let x = i as f32 / 1000.0;
            let (thickness, base, cos) = (x * 2.0, 1.0 + 4.0 * x, (x * 37.0).fract());
            let (found, most) = (film(thickness, base, cos), soap(thickness).most(F(base), F(cos)).0);
            assert!(found.iter().all(|x| (0.0..=most + 1e-3).contains(x)), "{base} {cos}: {found:?} {most}");
        }
    }
}
