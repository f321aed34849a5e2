//! Fresnel's equations for unpolarised light, exact and approximate, and their averages over the hemisphere.
use super::Reflectance;
use crate::math::{F, Lanes, M, One, Pick, U, V};

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
fn conductor<L: Lanes>(cos: F<L>, eta: F<L>, k: F<L>) -> F<L> {
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

/// Fresnel reflectance of metals, per lane: constant, Schlick's approximation, or Fresnel's equations with a complex index.
pub struct ConductorFresnel<L: Lanes> {
    /// Reflectance at normal incidence in lanes without an index.
    f0: V<L>,
    /// 1 for Schlick's approximation, 0 for a constant.
    rise: F<L>,
    indexed: M<L>,
    eta: V<L>,
    k: V<L>,
    /// Average of the lanes with an index.
    average: V<L>,
}

impl<L: Lanes> Clone for ConductorFresnel<L> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<L: Lanes> Copy for ConductorFresnel<L> {}

const SCHLICK: f32 = 1.0;
const INDEX: f32 = 2.0;

/// The rows that [`ConductorFresnel::read`] reads: (average, mode), (η, –), (k, –).
pub(super) fn rows(reflectance: &Reflectance) -> [[f32; 4]; 3] {
    match *reflectance {
        Reflectance::Constant(_) => [[0.0; 4]; 3],
        Reflectance::Schlick(_) => [[0.0, 0.0, 0.0, SCHLICK], [0.0; 4], [0.0; 4]],
        Reflectance::Index { eta, k } => {
            let channel = |c: usize| average(|cos| conductor(F::<One>(cos), F(eta[c]), F(k[c])).0);
            [[channel(0), channel(1), channel(2), INDEX], [eta[0], eta[1], eta[2], 0.0], [k[0], k[1], k[2], 0.0]]
        }
    }
}

impl<L: Lanes> ConductorFresnel<L> {
    /// Reads the rows `first`, `first + 1`, `first + 2` of `table`; `colour` is the reflectance at normal incidence in lanes
    /// without an index.
    #[inline(always)]
    pub(super) fn read(l: L, table: &[[f32; 4]], first: U<L>, colour: V<L>) -> Self {
        let [red, green, blue, mode] = l.rows(table, first);
        let indexed = mode.above(SCHLICK);
        let black = V::splat(l, [0.0; 3]);
        let (mut eta, mut k) = (black, black);
        if indexed.any() {
            let [x, y, z, _] = l.rows(table, first + 1);
            eta = V { x, y, z };
            let [x, y, z, _] = l.rows(table, first + 2);
            k = V { x, y, z };
        }
        ConductorFresnel { f0: colour, rise: mode, indexed, eta, k, average: V { x: red, y: green, z: blue } }
    }

    /// Reflectance for the cosine cos θ ≥ 0 between direction and (micro)normal.
    #[inline(always)]
    pub fn reflectance(&self, cos: F<L>) -> V<L> {
        let schlick = self.schlick(schlick_rise(cos));
        if !self.indexed.any() {
            return schlick;
        }
        let exact = V {
            x: conductor(cos, self.eta.x, self.k.x),
            y: conductor(cos, self.eta.y, self.k.y),
            z: conductor(cos, self.eta.z, self.k.z),
        };
        self.indexed.pick(exact, schlick)
    }

    /// Reflectance averaged over diffuse light: 2 ∫₀¹ F(μ) μ dμ. Schlick's rise averages to 1/21.
    #[inline(always)]
    pub fn average(&self) -> V<L> {
        self.indexed.pick(self.average, self.schlick(self.rise.splat(1.0 / 21.0)))
    }

    /// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994, equation 15, with (1 − cos θ)⁵ given.
    #[inline(always)]
    fn schlick(&self, rise: F<L>) -> V<L> {
        let rise = self.rise * rise;
        let f0 = self.f0;
        V { x: f0.x + (1.0 - f0.x) * rise, y: f0.y + (1.0 - f0.y) * rise, z: f0.z + (1.0 - f0.z) * rise }
    }
}

/// (1 − cos θ)⁵.
#[inline(always)]
fn schlick_rise<L: Lanes>(cos: F<L>) -> F<L> {
    let x = 1.0 - cos;
    let x2 = x * x;
    x2 * x2 * x
}

/// 2 ∫₀¹ F(μ) μ dμ, by the midpoint rule in s = √μ, because of the kink at total internal reflection and the slope at grazing
/// incidence.
fn average(reflectance: impl Fn(f32) -> f32) -> f32 {
    const STEPS: u32 = 1024;
    let mut sum = 0.0;
    for step in 0..STEPS {
        let s = (f64::from(step) + 0.5) / f64::from(STEPS);
        sum += f64::from(reflectance((s * s) as f32)) * 4.0 * s * s * s;
    }
    (sum / f64::from(STEPS)) as f32
}
