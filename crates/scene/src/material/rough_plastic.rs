//! A diffuse base under a coat whose facets scatter light once, as in Mitsuba.
//!
//! W. Jakob et al., "Mitsuba 3", plugins `plastic` and `roughplastic`: light passes the coat with T(μ), is reflected by the base,
//! returned by the coat with R and passes again: f = ρ T(ω_o) T(ω_i)/(π η² (1 − R)), or with 1 − ρ R in the denominator if the colour
//! becomes more saturated with every reflection. T is the transmittance of single refraction by the facets, so that rough coats lose
//! light, unlike those of `plastic.rs`. R is a parameter: see [`RoughPlastic::internal_reflectance`].
use std::f32::consts::FRAC_1_PI;

use super::{
    Bsdf, BsdfSample, ChosenLobe, Compile, CompiledMaterial, Lobes, Local, MaterialCompiler, Materials, Roughness, Shade, Stage,
    albedo::Albedo,
    anisotropy::Widths,
    dielectric::SPECULAR_REFLECTANCE,
    either_facets::EitherFacets,
    fresnel::{dielectric, dielectric_average},
    ggx, ior,
    microfacets::{self, Distribution},
};
use crate::sampling::Directions;
use noisefall_base::{
    declare::{Declare, Kind, Meaning, Parameter, Parameters, Problem, Range, Textured},
    math::{F, Lanes, M, One, Pick, V},
};

/// Such a plastic in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct RoughPlastic {
    /// Albedo of the base without its coat.
    pub albedo: Textured,
    /// Index of refraction of the coat, at least 1.
    pub ior: f64,
    /// Roughness of the coat, 0 for a smooth one.
    pub roughness: Roughness,
    /// Distribution of the microfacets.
    pub distribution: Distribution,
    /// Factor of the light that the coat reflects.
    pub specular_reflectance: [f64; 3],
    /// Fraction R of the light from the base that the coat returns; at most 1 − T_avg/η², and that of a smooth coat.
    pub internal_reflectance: f64,
    /// Whether every reflection by the base makes the colour more saturated.
    pub nonlinear: bool,
}

impl Default for RoughPlastic {
    fn default() -> Self {
        RoughPlastic {
            albedo: Textured::grey(0.5),
            ior: 1.5,
            roughness: Roughness::SMOOTH,
            distribution: Distribution::Ggx,
            specular_reflectance: [1.0; 3],
            internal_reflectance: 1.0,
            nonlinear: false,
        }
    }
}

const ALBEDO: Parameter = Parameter::new("albedo", "Fraction of the light that the base reflects, without its coat.")
    .symbol("ρ")
    .required()
    .aliases("color colour rho reflectance kd Kd rgb base_color diffuse_reflectance")
    .means(Meaning::Colour);

impl Kind for RoughPlastic {
    const KIND: Parameter =
        Parameter::new("rough_plastic", "A diffuse base under a clear coat whose facets scatter light once, as in Mitsuba.")
            .aliases("roughplastic")
            .advice("such as rough_plastic = { albedo = 0.5, ior = 1.5, alpha = 0.1 }");
}

impl Declare for RoughPlastic {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const IOR: Parameter = ior("Index of refraction of the coat.");
        const DISTRIBUTION: Parameter =
            Parameter::new("distribution", "Distribution of the microfacets.").aliases("facets microfacets ndf");
        const INTERNAL_REFLECTANCE: Parameter = Parameter::new(
            "internal_reflectance",
            "Fraction of the light from the base that the coat reflects back to it, at most that of a smooth coat.",
        )
        .symbol("R");
        const NONLINEAR: Parameter =
            Parameter::new("nonlinear", "Whether reflections between base and coat make the colour more saturated.");
        p.textured(&ALBEDO, &mut self.albedo, Range::REFLECTANCE);
        p.number(&IOR, &mut self.ior, Range::linear(1.0, 20.0));
        p.one_of(&mut self.roughness);
        p.word(&DISTRIBUTION, &mut self.distribution);
        p.colour(&SPECULAR_REFLECTANCE, &mut self.specular_reflectance, Range::UNIT);
        p.number(&INTERNAL_REFLECTANCE, &mut self.internal_reflectance, Range::UNIT);
        p.flag(&NONLINEAR, &mut self.nonlinear);
    }
}

impl Compile for RoughPlastic {
    fn compile(&self, compiler: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        let (alpha, most) = compiler.alpha(&self.roughness)?;
        let albedo = compiler.colour(&ALBEDO, &self.albedo, &Range::REFLECTANCE)?;
        let ior = self.ior as f32;
        let smooth = 1.0 - dielectric_average(ior);
        let table = (most >= ggx::SMOOTH).then(|| compiler.tables.refraction(ior, self.distribution));
        let returned = (self.internal_reflectance as f32).min(1.0 - smooth / (ior * ior));
        let row = RoughPlasticRow {
            ior,
            smooth,
            table,
            tint: self.specular_reflectance.map(|x| x as f32),
            returned,
            nonlinear: self.nonlinear,
            beckmann: self.distribution == Distribution::Beckmann,
        };
        let plain = CompiledMaterial::new(Stage::RoughPlastic, albedo, compiler);
        Ok(CompiledMaterial { alpha, rows: row.pack(), scatters_where_black: true, ..plain })
    }
}

/// The constants of a plastic.
struct RoughPlasticRow {
    ior: f32,
    /// T_avg of a smooth coat.
    smooth: f32,
    /// First row of the table of a rough coat.
    table: Option<u32>,
    tint: [f32; 3],
    /// R.
    returned: f32,
    nonlinear: bool,
    beckmann: bool,
}

impl RoughPlasticRow {
    fn pack(&self) -> [[f32; 4]; 3] {
        let [rough, nonlinear, beckmann] =
            [self.table.is_some(), self.nonlinear, self.beckmann].map(|flag| f32::from(u8::from(flag)));
        let [r, g, b] = self.tint;
        [
            [self.ior, self.smooth, f32::from_bits(self.table.unwrap_or(0)), rough],
            [r, g, b, self.returned],
            [nonlinear, beckmann, 0.0, 0.0],
        ]
    }
}

impl Shade for RoughPlastic {
    type Bsdf<'a, L: Lanes> = RoughPlasticBsdf<'a, L>;
    const STAGE: Stage = Stage::RoughPlastic;

    #[inline(always)]
    fn at<'a, L: Lanes>(l: L, materials: &'a Materials, _: Directions, at: &Local<L>) -> RoughPlasticBsdf<'a, L> {
        let [ior, smooth, table, rough] = materials.row(l, at.material, 0);
        let [r, g, b, returned] = materials.row(l, at.material, 1);
        let [nonlinear, beckmann, _, _] = materials.row(l, at.material, 2);
        let rough = rough.above(0.0);
        let alpha = at.alpha.max(l.f(ggx::SMOOTH));
        let coat = Albedo::at(&materials.tables.rows, table.bits(), alpha);
        let average = if rough.any() { rough.pick(smooth + coat.average(l), smooth) } else { smooth };
        let (nonlinear, ior2) = (nonlinear.above(0.0), ior * ior);
        // No more light comes out than enters.
        let returned = returned.min(1.0 - average / ior2);
        let rho = at.colour;
        let base = V {
            x: rho.x / (ior2 * (1.0 - nonlinear.pick(rho.x * returned, returned))),
            y: rho.y / (ior2 * (1.0 - nonlinear.pick(rho.y * returned, returned))),
            z: rho.z / (ior2 * (1.0 - nonlinear.pick(rho.z * returned, returned))),
        };
        let facets = EitherFacets { widths: Widths::round(alpha), beckmann: beckmann.above(0.0) };
        let tint = V { x: r, y: g, z: b };
        let brightest = base.max_component() * average;
        RoughPlasticBsdf { l, ior, rough, facets, coat, base, tint, brightest }
    }
}

/// The BSDF of such a plastic at a point.
#[derive(Clone, Copy)]
pub struct RoughPlasticBsdf<'a, L: Lanes> {
    l: L,
    ior: F<L>,
    /// Lanes with a rough coat; the others have a delta lobe.
    rough: M<L>,
    facets: EitherFacets<L>,
    /// T minus that of a smooth coat.
    coat: Albedo<'a, L>,
    /// ρ/(η² (1 − R)).
    base: V<L>,
    tint: V<L>,
    /// The largest channel of the base's directional albedo, over T(ω_o).
    brightest: F<L>,
}

impl<L: Lanes> RoughPlasticBsdf<'_, L> {
    /// T(μ), and Fresnel's reflectance.
    #[inline(always)]
    fn transmission(&self, mu: F<L>) -> (F<L>, F<L>) {
        let reflected = dielectric(mu, self.ior).0;
        let mut passed = 1.0 - reflected;
        if self.rough.any() {
            let rough = (passed + self.coat.value(self.l, mu)).max(mu.splat(0.0)).min(mu.splat(1.0));
            passed = self.rough.pick(rough, passed);
        }
        (passed, reflected)
    }

    /// Probability of choosing the coat: about its share of the reflected light.
    #[inline(always)]
    fn coat_chance(&self, transmission: F<L>) -> F<L> {
        let coat = (1.0 - transmission) * self.tint.max_component();
        coat / (coat + self.brightest * transmission).max(coat.splat(f32::MIN_POSITIVE))
    }

    /// [`Bsdf::eval`] for known T(ω_o) and probability of the coat.
    #[inline(always)]
    fn eval_with(&self, wo: V<L>, wi: V<L>, transmission: F<L>, chance: F<L>) -> (V<L>, F<L>) {
        let zero = wo.z.splat(0.0);
        let cosine = wi.z.max(zero) * FRAC_1_PI;
        let mut f = self.base * (transmission * self.transmission(wi.z.max(zero)).0 * cosine);
        let mut pdf = (1.0 - chance) * cosine;
        if self.rough.any() {
            let h = (wo + wi).normalized();
            let density = self.rough.pick(microfacets::reflection_pdf(self.facets, wo, h), zero);
            let coat = dielectric(wo.dot(h).max(zero), self.ior).0 * density * microfacets::g1(self.facets, wi);
            f = f + self.tint * coat;
            pdf = pdf + chance * density;
        }
        let above = wi.z.above(0.0);
        (above.pick(f, V { x: zero, y: zero, z: zero }), above.pick(pdf, zero))
    }
}

impl<L: Lanes> Bsdf<L> for RoughPlasticBsdf<'_, L> {
    #[inline(always)]
    fn eval(&self, wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        let (transmission, _) = self.transmission(wo.z);
        self.eval_with(wo, wi, transmission, self.coat_chance(transmission))
    }

    #[inline(always)]
    fn sample(&self, wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L> {
        let (transmission, reflected) = self.transmission(wo.z);
        let chance = self.coat_chance(transmission);
        let coat = lobe.lt(chance);
        let mut mirrored = V { x: -wo.x, y: -wo.y, z: wo.z };
        if self.rough.any() {
            mirrored = self.rough.pick(microfacets::sample_reflection(self.facets, wo, u), mirrored);
        }
        let wi = coat.pick(mirrored, Directions::Cosine.sample(u));
        let (f, pdf) = self.eval_with(wo, wi, transmission, chance);
        let sample = BsdfSample::of(wi, f, pdf);
        let delta = coat & !self.rough;
        BsdfSample { weight: delta.pick(self.tint * (reflected / chance), sample.weight), delta, ..sample }
    }
}

impl Lobes for RoughPlasticBsdf<'_, One> {
    fn chosen(&self, wo: V<One>, _: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe {
        let coat = if self.rough.0 { "rough coat" } else { "smooth coat" };
        ChosenLobe::of_two([coat, "diffuse base"], self.coat_chance(self.transmission(wo.z).0).0, lobe)
    }
}
