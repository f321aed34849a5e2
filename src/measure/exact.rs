//! Exact solutions of the light transport equation, and the variances of its estimators where they have a closed form.
//!
//! The furnace is a closed sphere whose inside emits L_e and reflects ρ diffusely. By symmetry the radiance L is the same
//! everywhere, so that L = L_e + ρ L (the "furnace test": see J. Arvo, "The Irradiance Jacobian", 1994, for uniform
//! enclosures). Every bounce k therefore carries L_e ρᵏ, whatever the shape of the room.

/// L_e / (1 − ρ).
pub fn furnace(le: f64, albedo: f64) -> f64 {
    le / (1.0 - albedo)
}

/// The part of [`furnace`] that at most `cap` reflections carry: L_e (1 − ρⁿ⁺¹) / (1 − ρ).
pub fn furnace_capped(le: f64, albedo: f64, cap: u32) -> f64 {
    furnace(le, albedo) * (1.0 - albedo.powi(cap as i32 + 1))
}

/// Variance of one sample X of the furnace when every reflection multiplies the throughput by a random weight w, independent of
/// the others, of mean 1 and mean square `weight_square`.
///
/// X = L_e + ρ w X′ with X′ distributed as X and independent of w, hence with L = L_e/(1 − ρ)
/// E X² = L_e² + 2 L_e ρ L + ρ² E w² E X², that is E X² = (L_e² + 2 L_e ρ L) / (1 − ρ² E w²), finite only while ρ² E w² < 1.
///
/// * uniform directions: w = 2 cos θ with cos θ uniform in [0, 1], so E w² = 4/3;
/// * fixed roulette of survival probability q: w = 1/q with probability q, else 0, so E w² = 1/q;
/// * both: the product, 4/(3q).
pub fn furnace_variance(le: f64, albedo: f64, weight_square: f64) -> f64 {
    let mean = furnace(le, albedo);
    let mean_square = (le * le + 2.0 * le * albedo * mean) / (1.0 - albedo * albedo * weight_square);
    mean_square - mean * mean
}

/// Irradiance of a surface by a sphere of constant radiance that is wholly above its horizon: E = π L (r/d)² cos θ, where d is
/// the distance of the centre and θ its angle to the normal (Moon, "The Scientific Basis of Illuminating Engineering", 1936).
pub fn sphere_irradiance(radiance: f64, radius: f64, distance: f64, cos: f64) -> f64 {
    std::f64::consts::PI * radiance * (radius / distance).powi(2) * cos
}
