//! Reflectance of metals: how a scene describes it, its constants, and its values for directions.
use super::{
    MaterialCompiler, Materials,
    fresnel::{average, conductor},
};
use crate::texture::ColourSource;
use noisefall_base::{
    declare::{Meaning, OneOf, Parameter, Parameters, Problem, Range, Textured},
    math::{F, Lanes, M, One, Pick, U, V},
};

/// Fresnel reflectance of metals, per lane: constant, Schlick's approximation, or Fresnel's equations with a complex index.
#[derive(Clone, Copy)]
pub struct ConductorFresnel<L: Lanes> {
    /// Reflectance at normal incidence, or the tint in lanes with an index.
    f0: V<L>,
    /// 1 for Schlick's approximation, 0 for a constant.
    rise: F<L>,
    indexed: M<L>,
    eta: V<L>,
    k: V<L>,
    /// Average of the lanes with an index.
    average: V<L>,
}

const SCHLICK: f32 = 1.0;

const INDEX: f32 = 2.0;

/// Reflectance of a metal, channel by channel.
#[derive(Clone, Debug, PartialEq)]
pub enum Reflectance {
    /// A reflectance that does not depend on the angle.
    Constant(Textured),
    /// Schlick's approximation from the reflectance at normal incidence.
    Schlick(Textured),
    /// Fresnel's equations with the complex index η + ik relative to the outside.
    Index {
        /// Real part η per channel.
        eta: [f64; 3],
        /// Imaginary part k per channel.
        k: [f64; 3],
        /// Multiplies the reflectance at every angle.
        tint: Textured,
    },
}

const ETA: Parameter = Parameter::new("eta", "Real part of the complex index of refraction.").symbol("η").required();

const K: Parameter =
    Parameter::new("k", "Imaginary part of the index: how strongly the metal absorbs light.").symbol("k").required();

const TINT: Parameter = Parameter::new("tint", "Multiplies the reflectance at every angle.").aliases("specular_reflectance");

const F0: Parameter =
    Parameter::new("f0", "Reflectance at normal incidence; it rises to 1 at grazing angles by Schlick's approximation.")
        .symbol("F₀")
        .required()
        .aliases("color colour albedo rgb specular_color");

const REFLECTANCE: Parameter = Parameter::new("reflectance", "Reflectance of the microfacets, the same at every angle.")
    .symbol("F")
    .required()
    .means(Meaning::Colour);

const INDICES: Range = Range::linear(0.0, 1e3).expected("every channel of `eta` and `k` must be a number from 0 to 1000");

impl Default for Reflectance {
    fn default() -> Self {
        Reflectance::Schlick(Textured::grey(0.9))
    }
}

impl OneOf for Reflectance {
    const WHAT: &'static str = "reflectance";

    fn alternatives() -> Vec<Self> {
        vec![
            Reflectance::index([0.143, 0.374, 1.442], [3.983, 2.386, 1.603]),
            Reflectance::default(),
            Reflectance::Constant(Textured::grey(0.9)),
        ]
    }

    fn place(&self) -> usize {
        match self {
            Reflectance::Index { .. } => 0,
            Reflectance::Schlick(_) => 1,
            Reflectance::Constant(_) => 2,
        }
    }

    fn name(&self) -> &'static str {
        match self {
            Reflectance::Index { .. } => ETA.key,
            Reflectance::Schlick(_) => F0.key,
            Reflectance::Constant(_) => REFLECTANCE.key,
        }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        match self {
            Reflectance::Index { eta, k, tint } => {
                p.colour(&ETA, eta, INDICES);
                p.colour(&K, k, INDICES);
                p.textured(&TINT, tint, Range::REFLECTANCE);
            }
            Reflectance::Schlick(f0) => p.textured(&F0, f0, Range::REFLECTANCE),
            Reflectance::Constant(reflectance) => p.textured(&REFLECTANCE, reflectance, Range::REFLECTANCE),
        }
    }
}

impl Reflectance {
    /// The reflectance of a complex index η + ik.
    pub fn index(eta: [f32; 3], k: [f32; 3]) -> Reflectance {
        Reflectance::Index { eta: eta.map(f64::from), k: k.map(f64::from), tint: Textured::grey(1.0) }
    }

    /// The reflectance at normal incidence, or the tint with an index: what a texture may vary.
    pub(super) fn colour(&self, compiler: &MaterialCompiler) -> Result<ColourSource, Problem> {
        match self {
            Reflectance::Index { tint, .. } => compiler.colour(&TINT, tint, &Range::REFLECTANCE),
            Reflectance::Schlick(f0) => compiler.colour(&F0, f0, &Range::REFLECTANCE),
            Reflectance::Constant(reflectance) => compiler.colour(&REFLECTANCE, reflectance, &Range::REFLECTANCE),
        }
    }

    /// The largest channel of the reflectance at normal incidence, with an index.
    pub(super) fn head_on(&self) -> Option<f32> {
        let Reflectance::Index { eta, k, .. } = self else { return None };
        let channel = |c: usize| {
            let (eta, square) = (eta[c] as f32, (k[c] as f32).powi(2));
            ((eta - 1.0).powi(2) + square) / ((eta + 1.0).powi(2) + square)
        };
        Some([0, 1, 2].map(channel).into_iter().fold(0.0, f32::max).min(1.0))
    }
}

/// The constants of a metal.
pub(super) struct ConductorRow {
    /// Average reflectance of an index over diffuse light.
    average: [f32; 3],
    /// 0, [`SCHLICK`] or [`INDEX`].
    mode: f32,
    eta: [f32; 3],
    k: [f32; 3],
    compensated: bool,
}

impl ConductorRow {
    pub fn new(reflectance: &Reflectance, compensated: bool) -> ConductorRow {
        let none = ConductorRow { average: [0.0; 3], mode: 0.0, eta: [0.0; 3], k: [0.0; 3], compensated };
        match reflectance {
            Reflectance::Constant(_) => none,
            Reflectance::Schlick(_) => ConductorRow { mode: SCHLICK, ..none },
            Reflectance::Index { eta, k, .. } => {
                /// Both parts: smaller ones underflow where they are squared.
                const LEAST: f64 = 1e-6;
                // Where η is 0, every k reflects all light, and the formula has no value where both are.
                let is_none = |c: usize| eta[c].max(k[c]) < LEAST;
                let part = |of: &[f64; 3], none: f32| [0, 1, 2].map(|c| if is_none(c) { none } else { of[c] as f32 });
                let (eta, k) = (part(eta, 0.0), part(k, 1.0));
                let channel = |c: usize| average(|cos| conductor(F::<One>(cos), F(eta[c]), F(k[c])).0);
                ConductorRow { average: [0, 1, 2].map(channel), mode: INDEX, eta, k, compensated }
            }
        }
    }

    pub fn pack(&self) -> [[f32; 4]; 3] {
        let ConductorRow { average: [ax, ay, az], mode, eta: [ex, ey, ez], k: [kx, ky, kz], compensated } = *self;
        [[ax, ay, az, mode], [ex, ey, ez, f32::from(u8::from(compensated))], [kx, ky, kz, 0.0]]
    }

    /// Average and mode.
    #[inline(always)]
    fn read_mode<L: Lanes>(l: L, materials: &Materials, material: U<L>) -> (V<L>, F<L>) {
        let [x, y, z, mode] = materials.row(l, material, 0);
        (V { x, y, z }, mode)
    }

    /// η and k.
    #[inline(always)]
    fn read_index<L: Lanes>(l: L, materials: &Materials, material: U<L>) -> [V<L>; 2] {
        let [x, y, z, _] = materials.row(l, material, 1);
        let eta = V { x, y, z };
        let [x, y, z, _] = materials.row(l, material, 2);
        [eta, V { x, y, z }]
    }

    #[inline(always)]
    pub fn read_compensated<L: Lanes>(l: L, materials: &Materials, material: U<L>) -> M<L> {
        let [_, _, _, compensated] = materials.row(l, material, 1);
        compensated.above(0.0)
    }
}

impl<L: Lanes> ConductorFresnel<L> {
    /// Reads the reflectance of materials; `colour` is the reflectance at normal incidence, or the tint in lanes with an index.
    #[inline(always)]
    pub(super) fn read(l: L, materials: &Materials, material: U<L>, colour: V<L>) -> Self {
        let (average, mode) = ConductorRow::read_mode(l, materials, material);
        let indexed = mode.above(SCHLICK);
        let black = V::splat(l, [0.0; 3]);
        let [eta, k] = if indexed.any() { ConductorRow::read_index(l, materials, material) } else { [black; 2] };
        ConductorFresnel { f0: colour, rise: mode, indexed, eta, k, average }
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
        self.indexed.pick(exact * self.f0, schlick)
    }

    /// Reflectance averaged over diffuse light: 2 ∫₀¹ F(μ) μ dμ. Schlick's rise averages to 1/21.
    #[inline(always)]
    pub fn average(&self) -> V<L> {
        self.indexed.pick(self.average * self.f0, self.schlick(self.rise.splat(1.0 / 21.0)))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_channel_without_an_index_reflects_all_light() {
        let metal = Reflectance::index([1.0, 1e-30, 0.0], [2.0, 0.0, 3.0]);
        let ConductorRow { average, eta, k, .. } = ConductorRow::new(&metal, false);
        let is_one = |x: f32| (x - 1.0).abs() < 1e-5;
        assert!(average[0] < 0.7 && is_one(average[1]) && is_one(average[2]), "{average:?}");
        for cos in [0.0, 0.3, 1.0] {
            assert!(is_one(conductor(F::<One>(cos), F(eta[1]), F(k[1])).0));
        }
        assert_eq!(metal.head_on(), Some(1.0));
    }
}
