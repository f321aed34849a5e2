//! Textbook formulas of surfaces in f64 and integrals over them. They share no code with the renderer.
use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// Fresnel's reflectance of unpolarised light, and the cosine of refraction, which is 0 in total reflection. η is the index
/// beyond the interface relative to the index before it.
pub fn dielectric(cos: f64, eta: f64) -> (f64, f64) {
    let square = 1.0 - (1.0 - cos * cos) / (eta * eta);
    if square <= 0.0 {
        return (1.0, 0.0);
    }
    let beyond = square.sqrt();
    let s = (cos - eta * beyond) / (cos + eta * beyond);
    let p = (eta * cos - beyond) / (eta * cos + beyond);
    ((s * s + p * p) / 2.0, beyond)
}

/// Fresnel's reflectance for the complex index η + ik.
pub fn metal(cos: f64, eta: f64, k: f64) -> f64 {
    let multiply = |(a, b): (f64, f64), (c, d): (f64, f64)| (a * c - b * d, a * d + b * c);
    let square_of_ratio = |(a, b): (f64, f64), (c, d): (f64, f64)| (a * a + b * b) / (c * c + d * d);
    // n cos θ_t = √(n² − sin²θ).
    let (re, im) = (eta * eta - k * k - (1.0 - cos * cos), 2.0 * eta * k);
    let size = re.hypot(im);
    let root = (((size + re) / 2.0).sqrt(), ((size - re) / 2.0).sqrt());
    let s = square_of_ratio((cos - root.0, -root.1), (cos + root.0, root.1));
    let n2 = multiply((eta, k), (eta, k));
    let (x, y) = (n2.0 * cos, n2.1 * cos);
    let p = square_of_ratio((x - root.0, y - root.1), (x + root.0, y + root.1));
    (s + p) / 2.0
}

/// GGX distribution D of microfacet normals (Walter et al. 2007).
pub fn d(alpha: f64, h: DVec3) -> f64 {
    let cos2 = h.z * h.z;
    let tan2 = (1.0 - cos2).max(0.0) / cos2;
    (alpha / (cos2 * (alpha * alpha + tan2))).powi(2) / PI
}

/// Smith's masking for GGX (Walter et al. 2007).
pub fn g1(alpha: f64, w: DVec3) -> f64 {
    let tan2 = (1.0 - w.z * w.z).max(0.0) / (w.z * w.z);
    2.0 / (1.0 + (1.0 + alpha * alpha * tan2).sqrt())
}

/// BSDF of reflecting microfacets, F D G/(4 cos θ_o cos θ_i).
pub fn reflection(alpha: f64, wo: DVec3, wi: DVec3, fresnel: impl Fn(f64) -> f64) -> f64 {
    let h = (wo + wi).normalize();
    fresnel(wo.dot(h)) * d(alpha, h) * g1(alpha, wo) * g1(alpha, wi) / (4.0 * wo.z * wi.z)
}

/// BSDF of refracting microfacets, for radiance: n_o²/(n_i ω_i·h + n_o ω_o·h)² (1 − F) D G |ω_i·h ω_o·h|/|cos θ_i cos θ_o|.
pub fn refraction(alpha: f64, wo: DVec3, wi: DVec3, eta: f64) -> f64 {
    let sum = wo + wi * eta;
    let h = sum.normalize() * sum.z.signum();
    let (o, i) = (wo.dot(h), wi.dot(h));
    if o <= 0.0 || i >= 0.0 {
        return 0.0;
    }
    let passes = 1.0 - dielectric(o, eta).0;
    passes * d(alpha, h) * g1(alpha, wo) * g1(alpha, wi) * (o * i / (wo.z * wi.z)).abs() / (o + eta * i).powi(2)
}

/// The direction with this cosine to the normal and this azimuth.
pub fn direction(cos: f64, azimuth: f64) -> DVec3 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos)
}

/// The integral over microfacet normals, D cos θ_h dω_h, of G₁(ω_o) ω_o·h/(cos θ_o cos θ_h) `leaves`(facet), seen at cosine `mu`.
/// In u = tan²/(α² + tan²), D cos θ_h dω_h = du dφ/(2π).
fn over_facets(alpha: f64, mu: f64, leaves: impl Fn(DVec3, DVec3, f64) -> f64) -> f64 {
    const STEPS: [u32; 2] = [256, 128];
    let wo = direction(mu, 0.0);
    let mut sum = 0.0;
    for i in 0..STEPS[0] {
        // Steep facets are few and have large weights: 1 − u = s⁴ and du = 4s³ ds.
        let s = (f64::from(i) + 0.5) / f64::from(STEPS[0]);
        let rest = s.powi(4);
        let cos = (1.0 + alpha * alpha * (1.0 - rest) / rest).sqrt().recip();
        for j in 0..STEPS[1] {
            let h = direction(cos, TAU * (f64::from(j) + 0.5) / f64::from(STEPS[1]));
            let seen = wo.dot(h);
            if seen > 0.0 {
                sum += 4.0 * s.powi(3) * seen / (mu * h.z) * leaves(wo, h, seen);
            }
        }
    }
    sum * g1(alpha, wo) / f64::from(STEPS[0] * STEPS[1])
}

/// Directional albedo of reflecting microfacets.
pub fn albedo(alpha: f64, mu: f64, fresnel: impl Fn(f64) -> f64) -> f64 {
    over_facets(alpha, mu, |wo, h, seen| {
        let wi = h * (2.0 * seen) - wo;
        if wi.z > 0.0 { fresnel(seen) * g1(alpha, wi) } else { 0.0 }
    })
}

/// Directional albedo of single scattering at a rough interface, reflection and transmission together.
pub fn interface_albedo(alpha: f64, mu: f64, eta: f64) -> f64 {
    over_facets(alpha, mu, |wo, h, seen| {
        let (reflectance, beyond) = dielectric(seen, eta);
        let up = h * (2.0 * seen) - wo;
        let down = h * (seen / eta - beyond) - wo / eta;
        let leaves = |wi: DVec3, side: f64| if wi.z * side > 0.0 { g1(alpha, wi) } else { 0.0 };
        reflectance * leaves(up, 1.0) + (1.0 - reflectance) * leaves(down, -1.0)
    })
}

/// 2 ∫₀¹ g(μ) μ dμ, by the midpoint rule in √μ.
pub fn average(steps: u32, g: impl Fn(f64) -> f64) -> f64 {
    let at = |i: u32| {
        let s = (f64::from(i) + 0.5) / f64::from(steps);
        g(s * s) * 4.0 * s.powi(3)
    };
    (0..steps).map(at).sum::<f64>() / f64::from(steps)
}

/// ∫ g dω over the directions above the surface.
pub fn over_hemisphere(g: impl Fn(DVec3) -> f64) -> f64 {
    const STEPS: [u32; 2] = [400, 64];
    let at = |i: u32| {
        let cos = (f64::from(i / STEPS[1]) + 0.5) / f64::from(STEPS[0]);
        g(direction(cos, TAU * (f64::from(i % STEPS[1]) + 0.5) / f64::from(STEPS[1])))
    };
    (0..STEPS[0] * STEPS[1]).map(at).sum::<f64>() * TAU / f64::from(STEPS[0] * STEPS[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_have_their_known_values() {
        // At normal incidence ((η − 1)/(η + 1))², and for a metal |(n − 1)/(n + 1)|²; at Brewster's angle R_p = 0.
        assert!((dielectric(1.0, 1.5).0 - 0.04).abs() < 1e-12 && dielectric(0.5, 1.0 / 1.5).0 == 1.0);
        assert!((metal(1.0, 0.2, 3.0) - (0.64 + 9.0) / (1.44 + 9.0)).abs() < 1e-12);
        assert!((metal(0.3, 1.5, 0.0) - dielectric(0.3, 1.5).0).abs() < 1e-12);
        // The projected area of the facets is the area of the surface.
        for alpha in [0.1, 0.5, 1.0] {
            assert!((over_facets(alpha, 0.999_999, |_, _, _| 1.0) - 1.0).abs() < 2e-3, "{alpha}");
        }
        assert!((over_hemisphere(|w| w.z) - PI).abs() < 1e-4 && (average(100, |mu| mu) - 2.0 / 3.0).abs() < 1e-4);
    }

    /// The albedo over facets equals the integral of f cos over directions, on a surface rough enough for plain quadrature.
    #[test]
    fn albedos_are_integrals_of_f() {
        let (alpha, mu) = (0.8, 0.6);
        let wo = direction(mu, 0.0);
        let plain = over_hemisphere(|wi| reflection(alpha, wo, wi, |cos| dielectric(cos, 1.5).0) * wi.z);
        assert!((albedo(alpha, mu, |cos| dielectric(cos, 1.5).0) / plain - 1.0).abs() < 2e-3);
        let through = over_hemisphere(|wi| refraction(alpha, wo, -wi, 1.5) * 1.5f64.powi(2) * wi.z);
        assert!((interface_albedo(alpha, mu, 1.5) / (plain + through) - 1.0).abs() < 2e-3);
    }

    #[test]
    fn little_is_masked_where_facets_are_level_with_the_view() {
        for alpha in [0.05, 0.3] {
            assert!((1.0 - albedo(alpha, 1.0, |_| 1.0)) / (alpha * alpha) < 2.0, "{alpha}");
        }
        assert!(g1(0.3, direction(1.0, 0.0)) == 1.0 && g1(1.0, direction(0.5, 0.0)) == 2.0 / 3.0);
    }
}
