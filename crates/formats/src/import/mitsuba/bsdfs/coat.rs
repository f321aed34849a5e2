//! Mean reflectances of the rough coats of plastics.
use noisefall_base::math::{F, One, V};
use noisefall_scene::material::{
    Distribution,
    beckmann::Beckmann,
    fresnel::dielectric,
    ggx,
    microfacets::{self, Microfacets},
};

/// Mitsuba sums over this number of cosines, both ends included.
const COSINES: u32 = 64;
/// Points of a lattice of facets, successive Fibonacci numbers.
const FACETS: [u32; 2] = [987, 610];

/// Fraction of diffuse light from the base that the facets of a coat return by one reflection, as Mitsuba sums it; 1 for a smooth coat,
/// which stands for the reflectance of Fresnel's equations.
pub fn internal_reflectance(eta: f64, alpha: f64, distribution: Distribution) -> f64 {
    if alpha < f64::from(ggx::SMOOTH) {
        return 1.0;
    }
    mean_reflectance(1.0 / eta, alpha, distribution)
}

/// 2 ∫ E(μ) μ dμ of the light E that facets of a relative index reflect once.
pub fn mean_reflectance(eta: f64, alpha: f64, distribution: Distribution) -> f64 {
    let (eta, alpha) = (F::<One>(eta as f32), F::<One>((alpha as f32).min(1.0)));
    let part = |i: u32| {
        let mu = (i as f32 / (COSINES - 1) as f32).max(1e-6);
        let reflected = match distribution {
            Distribution::Ggx => reflected(alpha, mu, eta),
            Distribution::Beckmann => reflected(Beckmann(alpha), mu, eta),
        };
        reflected * f64::from(mu)
    };
    (2.0 * (0..COSINES).map(part).sum::<f64>() / f64::from(COSINES)).clamp(0.0, 1.0)
}

/// E(μ) of one reflection.
fn reflected(facets: impl Microfacets<One>, mu: f32, eta: F<One>) -> f64 {
    let wo = V { x: F(((1.0 - mu) * (1.0 + mu)).sqrt()), y: F(0.0), z: F(mu) };
    let [count, step] = FACETS;
    let facet = |i: u32| {
        let [x, y] = [i, i * step % count].map(|k| (k as f32 + 0.5) / count as f32);
        let h = facets.sample_visible_normal(wo, (F(x), F(y)));
        let cos = wo.dot(h);
        let wi = h * (cos * 2.0) - wo;
        if wi.z.0 <= 0.0 { 0.0 } else { f64::from((dielectric(cos.max(F(0.0)), eta).0 * microfacets::g1(facets, wi)).0) }
    };
    (0..count).map(facet).sum::<f64>() / f64::from(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// α and R of Mitsuba 3.9 for an index of 1.5, from the ratio of its linear to its nonlinear plastic.
    const MITSUBA: [(f64, Distribution, f64); 7] = [
        (0.01, Distribution::Ggx, 0.5872),
        (0.1, Distribution::Ggx, 0.5519),
        (0.3, Distribution::Ggx, 0.4149),
        (0.6, Distribution::Ggx, 0.2408),
        (0.1, Distribution::Beckmann, 0.5810),
        (0.3, Distribution::Beckmann, 0.5300),
        (0.6, Distribution::Beckmann, 0.3936),
    ];

    #[test]
    fn the_sums_are_those_of_mitsuba() {
        for (alpha, distribution, expected) in MITSUBA {
            let found = internal_reflectance(1.5, alpha, distribution);
            assert!((found - expected).abs() < 3e-3, "{alpha} {distribution:?}: {found} {expected}");
        }
        assert_eq!(internal_reflectance(1.5, 0.0, Distribution::Ggx), 1.0);
    }
}
