//! Fresnel's equations for unpolarised light, and their averages over the hemisphere.
use noisefall_base::math::{F, Lanes, One, Pick};

/// Reflectance of an interface and the cosine of refraction, for cos θ_i ≥ 0 and η = n_t/n_i; (1, 0) at total internal
/// reflection.
///
/// Fresnel's r_s = (c − g)/(c + g) and r_p = (η²c − g)/(η²c + g) with c = cos θ_i, g = η cos θ_t and g² = η² − 1 + c². The
/// differences are expanded by the sums, because c² − g² = 1 − η² and η⁴c² − g² = (η² − 1)((η² + 1)c² − 1): nothing cancels at
/// grazing incidence or for η near 1.
#[inline(always)]
pub fn dielectric<L: Lanes>(cos_i: F<L>, eta: F<L>) -> (F<L>, F<L>) {
    let eta2 = eta * eta;
    let contrast = (eta - 1.0) * (eta + 1.0);
    let cos2 = cos_i * cos_i;
    let g2 = contrast + cos2;
    let g = g2.max(eta.splat(0.0)).sqrt();
    // The sums vanish only for η = 1 at cos θ_i = 0, where the numerators do.
    let tiny = eta.splat(1e-15);
    let s = (cos_i + g).max(tiny);
    let p = (eta2 * cos_i + g).max(tiny);
    let r_s = contrast / (s * s);
    let r_p = contrast * ((eta2 + 1.0) * cos2 - 1.0) / (p * p);
    let reflectance = 0.5 * (r_s * r_s + r_p * r_p);
    // Rounding next to total reflection or at cos θ_i = 0 must not create light.
    let one = eta.splat(1.0);
    let refracts = g2.above(0.0);
    (refracts.pick(reflectance.min(one), one), g / eta)
}

/// Reflectance of a dielectric averaged over diffuse light: 2 ∫₀¹ F(μ) μ dμ, for η = n_t/n_i > 0.
pub fn dielectric_average(eta: f32) -> f32 {
    average(|cos| dielectric(F::<One>(cos), F(eta)).0.0)
}

/// Reflectance of a metal with index η + ik relative to the outside, for one colour channel.
///
/// Born and Wolf, Principles of Optics, 7th ed., section 14.2, in the real form of Lagarde, "Memo on Fresnel equations", 2013:
/// a² + b² = |(η + ik)² − sin²θ|, where a is the real part of its root.
#[inline(always)]
pub(super) fn conductor<L: Lanes>(cos: F<L>, eta: F<L>, k: F<L>) -> F<L> {
    let cos2 = cos * cos;
    let sin2 = (1.0 - cos) * (1.0 + cos);
    let real = (eta - k) * (eta + k) - sin2;
    let imaginary = 2.0 * eta * k;
    let a2b2 = (real * real + imaginary * imaginary).sqrt();
    let a = (0.5 * (a2b2 + real)).max(cos.splat(0.0)).sqrt();
    let s = a2b2 + cos2;
    let cross = 2.0 * a * cos;
    let r_s = (s - cross) / (s + cross);
    let p = cos2 * a2b2 + sin2 * sin2;
    let r_p = r_s * (p - cross * sin2) / (p + cross * sin2);
    0.5 * (r_s + r_p)
}

/// 2 ∫₀¹ F(μ) μ dμ, by the midpoint rule in s = √μ, because of the kink at total internal reflection and the slope at grazing
/// incidence.
pub(super) fn average(reflectance: impl Fn(f32) -> f32) -> f32 {
    const STEPS: u32 = 1024;
    let mut sum = 0.0;
    for step in 0..STEPS {
        let s = (f64::from(step) + 0.5) / f64::from(STEPS);
        sum += f64::from(reflectance((s * s) as f32)) * 4.0 * s * s * s;
    }
    (sum / f64::from(STEPS)) as f32
}
