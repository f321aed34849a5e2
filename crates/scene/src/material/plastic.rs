//! A diffuse base under a clear coat, smooth or rough.
//!
//! Light that the coat does not reflect enters, T(μ) = 1 − E(μ), and scatters between base and coat until it leaves or is
//! absorbed: f = ρ T(ω_o) T(ω_i) / (π η² (1 − ρ R)), where R is the coat's average reflectance from inside. Reciprocity of the
//! interface relates R to the average T_avg of T over diffuse light from outside, η²(1 − R) = T_avg (Egan and Hilgeman, "Optical
//! Properties of Inhomogeneous Materials", 1979), so the denominator is π (η²(1 − ρ) + ρ T_avg). The term is reciprocal, and
//! lossless for ρ = 1 with any coat. E is Fresnel's reflectance of a smooth coat, or the directional albedo of a GGX coat, so
//! light that single scattering in the coat loses goes to the base.
use std::f32::consts::FRAC_1_PI;

use super::{
    Bsdf, BsdfSample, ChosenLobe, Compile, CompiledMaterial, Lobes, Local, MaterialCompiler, Materials, Roughness, Shade, Stage,
    albedo::Albedo,
    fresnel::{dielectric, dielectric_average},
    ggx, ior, microfacets,
};
use crate::sampling::Directions;
use noisefall_base::{
    declare::{Declare, Kind, Meaning, Parameter, Parameters, Problem, Range, Textured},
    math::{F, Lanes, M, One, Pick, U, V},
};

/// Plastic in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Plastic {
    /// Albedo of the base without its coat.
    pub albedo: Textured,
    /// Index of refraction of the coat, at least 1.
    pub ior: f64,
    /// Roughness of the coat, 0 for a smooth one.
    pub roughness: Roughness,
}

impl Default for Plastic {
    fn default() -> Self {
        Plastic { albedo: Textured::grey(0.5), ior: 1.5, roughness: Roughness::SMOOTH }
    }
}

impl Plastic {
    /// Plastic of constant albedo and α.
    pub fn new(albedo: [f32; 3], ior: f32, alpha: f32) -> Plastic {
        Plastic { albedo: albedo.into(), ior: f64::from(ior), roughness: Roughness::alpha(alpha) }
    }
}

const ALBEDO: Parameter = Parameter::new("albedo", "Fraction of the light that the base reflects, without its coat.")
    .symbol("ρ")
    .required()
    .aliases("color colour rho reflectance kd Kd rgb base_color")
    .means(Meaning::Colour);

impl Kind for Plastic {
    const KIND: Parameter =
        Parameter::new("plastic", "A diffuse base under a clear coat, smooth or rough.").aliases("glossy coated paint varnish");
}

impl Declare for Plastic {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const IOR: Parameter = ior("Index of refraction of the coat.");
        p.textured(&ALBEDO, &mut self.albedo, Range::REFLECTANCE);
        p.number(&IOR, &mut self.ior, Range::linear(1.0, 20.0));
        p.one_of(&mut self.roughness);
    }
}

impl Compile for Plastic {
    fn compile(&self, compiler: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        let (alpha, most) = compiler.alpha(&self.roughness)?;
        let albedo = compiler.colour(&ALBEDO, &self.albedo, &Range::REFLECTANCE)?;
        let ior = self.ior as f32;
        let table = (most >= ggx::SMOOTH).then(|| compiler.tables.coat(ior));
        let row = PlasticRow { ior, smooth: 1.0 - dielectric_average(ior), table };
        let plain = CompiledMaterial::new(Stage::Plastic, albedo, compiler);
        Ok(CompiledMaterial { alpha, rows: row.pack(), scatters_where_black: true, ..plain })
    }
}

/// The constants of a plastic.
struct PlasticRow {
    ior: f32,
    /// T_avg of a smooth coat.
    smooth: f32,
    /// First row of the table of a rough coat.
    table: Option<u32>,
}

impl PlasticRow {
    fn pack(&self) -> [[f32; 4]; 3] {
        let rough = f32::from(u8::from(self.table.is_some()));
        [[self.ior, self.smooth, f32::from_bits(self.table.unwrap_or(0)), rough], [0.0; 4], [0.0; 4]]
    }

    /// Index, T_avg of a smooth coat, table, and whether the coat is rough.
    #[inline(always)]
    fn read<L: Lanes>(l: L, materials: &Materials, material: U<L>) -> (F<L>, F<L>, U<L>, M<L>) {
        let [ior, smooth, table, rough] = materials.row(l, material, 0);
        (ior, smooth, table.bits(), rough.above(0.0))
    }
}

impl Shade for Plastic {
    type Bsdf<'a, L: Lanes> = PlasticBsdf<'a, L>;
    const STAGE: Stage = Stage::Plastic;

    #[inline(always)]
    fn at<'a, L: Lanes>(l: L, materials: &'a Materials, _: Directions, at: &Local<L>) -> PlasticBsdf<'a, L> {
        PlasticBsdf::at(l, materials, at)
    }
}

/// The BSDF of a plastic at a point.
#[derive(Clone, Copy)]
pub struct PlasticBsdf<'a, L: Lanes> {
    l: L,
    ior: F<L>,
    /// Lanes with a GGX coat; the others have a delta lobe.
    rough: M<L>,
    alpha: F<L>,
    /// E/F of the rough coats.
    coat: Albedo<'a, L>,
    /// ρ/(η²(1 − ρ) + ρ T_avg).
    base: V<L>,
    /// The largest channel of the base's directional albedo, over T(ω_o).
    brightest: F<L>,
}

impl<'a, L: Lanes> PlasticBsdf<'a, L> {
    #[inline(always)]
    fn at(l: L, materials: &'a Materials, at: &Local<L>) -> Self {
        let (ior, smooth_average, table, rough) = PlasticRow::read(l, materials, at.material);
        let alpha = at.alpha.max(l.f(ggx::SMOOTH));
        let coat = Albedo::at(&materials.tables.rows, table, alpha);
        let mut average = smooth_average;
        if rough.any() {
            average = rough.pick(coat.average(l), average);
        }
        let ior2 = ior * ior;
        let rho = at.colour;
        let base = V {
            x: rho.x / (ior2 * (1.0 - rho.x) + rho.x * average),
            y: rho.y / (ior2 * (1.0 - rho.y) + rho.y * average),
            z: rho.z / (ior2 * (1.0 - rho.z) + rho.z * average),
        };
        PlasticBsdf { l, ior, rough, alpha, coat, base, brightest: base.max_component() * average }
    }

    /// T(μ).
    #[inline(always)]
    fn transmission(&self, mu: F<L>) -> F<L> {
        let mut reflected = dielectric(mu, self.ior).0;
        if self.rough.any() {
            reflected = self.rough.pick(reflected * self.coat.value(self.l, mu), reflected);
        }
        1.0 - reflected
    }

    /// Probability of choosing the coat: its share of the reflected light.
    #[inline(always)]
    fn coat_chance(&self, transmission: F<L>) -> F<L> {
        let coat = 1.0 - transmission;
        // Nothing is reflected by a black base under a coat of index 1.
        coat / (coat + self.brightest * transmission).max(coat.splat(f32::MIN_POSITIVE))
    }

    /// [`Bsdf::eval`] for known T(ω_o) and probability of the coat.
    #[inline(always)]
    fn eval_with(&self, wo: V<L>, wi: V<L>, transmission: F<L>, chance: F<L>) -> (V<L>, F<L>) {
        let zero = wo.z.splat(0.0);
        let cosine = wi.z.max(zero) * FRAC_1_PI;
        let mut f = self.base * (transmission * self.transmission(wi.z.max(zero)) * cosine);
        let mut pdf = (1.0 - chance) * cosine;
        if self.rough.any() {
            let h = (wo + wi).normalized();
            let density = self.rough.pick(microfacets::reflection_pdf(self.alpha, wo, h), zero);
            let coat = dielectric(wo.dot(h).max(zero), self.ior).0 * density * microfacets::g1(self.alpha, wi);
            f = f + V { x: coat, y: coat, z: coat };
            pdf = pdf + chance * density;
        }
        let above = wi.z.above(0.0);
        (above.pick(f, V { x: zero, y: zero, z: zero }), above.pick(pdf, zero))
    }
}

impl<L: Lanes> Bsdf<L> for PlasticBsdf<'_, L> {
    #[inline(always)]
    fn eval(&self, wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        let transmission = self.transmission(wo.z);
        self.eval_with(wo, wi, transmission, self.coat_chance(transmission))
    }

    #[inline(always)]
    fn sample(&self, wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L> {
        let transmission = self.transmission(wo.z);
        let chance = self.coat_chance(transmission);
        let coat = lobe.lt(chance);
        let mut reflected = V { x: -wo.x, y: -wo.y, z: wo.z };
        if self.rough.any() {
            reflected = self.rough.pick(microfacets::sample_reflection(self.alpha, wo, u), reflected);
        }
        let wi = coat.pick(reflected, Directions::Cosine.sample(u));
        let (f, pdf) = self.eval_with(wo, wi, transmission, chance);
        let sample = BsdfSample::of(wi, f, pdf);
        let delta = coat & !self.rough;
        let mirror = (1.0 - transmission) / chance;
        BsdfSample { weight: delta.pick(V { x: mirror, y: mirror, z: mirror }, sample.weight), delta, ..sample }
    }
}

impl Lobes for PlasticBsdf<'_, One> {
    fn chosen(&self, wo: V<One>, _: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe {
        let coat = if self.rough.0 { "rough coat" } else { "smooth coat" };
        ChosenLobe::of_two([coat, "diffuse base"], self.coat_chance(self.transmission(wo.z)).0, lobe)
    }
}
