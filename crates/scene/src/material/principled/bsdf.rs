//! The BSDF of a principled material: its lobes one above the other.
use fearless_simd_macros::simd;

use super::{
    super::{Bsdf, BsdfSample, ChosenLobe, Lobes, fresnel::dielectric, ggx, microfacets},
    interface::grey,
    point::Point,
    rough_diffuse::{self, rough_diffuse},
    view::{View, view},
};
use noisefall_base::math::{F, Lanes, M, One, Pick, V};

/// The BSDF at a point. `CLEAR`: light may pass.
#[derive(Clone, Copy)]
pub struct PrincipledBsdf<'a, L: Lanes, const CLEAR: bool>(pub Point<'a, L, CLEAR>);

/// A facet between two directions.
struct Facet<L: Lanes> {
    /// Its cosine to the viewer.
    cos: F<L>,
    /// Density of the other direction over visible facets, per solid angle.
    density: F<L>,
    /// The part of what it scatters there that no other facet masks.
    unmasked: F<L>,
}

/// [`Bsdf::eval`] for a known view, as a call.
#[simd]
fn eval_with<L: Lanes, const CLEAR: bool>(
    l: L,
    bsdf: &PrincipledBsdf<L, CLEAR>,
    view: &View<L>,
    wo: V<L>,
    wi: V<L>,
) -> (V<L>, F<L>) {
    bsdf.lobes(l, view, wo, wi)
}

impl<L: Lanes, const CLEAR: bool> PrincipledBsdf<'_, L, CLEAR> {
    /// f |cos θ_i| and pdf of the lobes that are not delta.
    #[inline(always)]
    fn lobes(&self, l: L, view: &View<L>, wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        let Point { values, .. } = &self.0;
        let zero = l.f(0.0);
        let above = wi.z.above(0.0);
        let cos = wi.z.max(zero);
        let way = if self.0.has_coat.any() { above.pick(self.0.way(cos), zero) } else { zero };
        let passed = view.passed * view.absorbed(values.coat_weight, way);
        let (mut f, mut pdf) = (grey(zero), zero);
        if self.0.opaque.above(0.0).any() {
            let entered = self.0.opaque * self.0.entry * (1.0 - self.0.base.albedo(wi, self.0.interface.index));
            let diffuse = rough_diffuse(self.0.albedo, values.diffuse_roughness, wo, V { z: cos, ..wi });
            f = diffuse * (view.entered * entered) * passed;
            pdf = view.diffuse_chance * rough_diffuse::pdf(values.diffuse_roughness, cos);
        }
        let h = (wo + wi).normalized();
        if self.0.has_coat.any() {
            let facets = &self.0.coat;
            let density = facets.rough.pick(microfacets::reflection_pdf(facets.widths, wo, h), zero);
            let reflected = dielectric(wo.dot(h).max(zero), self.0.coat_ior).0;
            let coat = view.coated * reflected * density * microfacets::g1(facets.widths, wi);
            f = f + grey(self.0.has_coat.pick(coat, zero));
            pdf = pdf + self.0.has_coat.pick(view.coat_chance * density, zero);
        }
        if let Some(fuzz) = &view.fuzz {
            let density = fuzz.density(V { z: cos, ..wi });
            f = f + values.fuzz_color * (view.fuzzed * density);
            pdf = pdf + view.fuzz_chance * density;
        }
        let (mut f, mut pdf) = (above.pick(f, grey(zero)), above.pick(pdf, zero));
        if self.0.base.rough.any() {
            let facet = if CLEAR { self.facet(wo, wi) } else { self.reflecting(wo, wi, h) };
            let (reflected, through) = self.0.scattered(view, facet.cos);
            let mut scattered = reflected;
            let mut chance = view.interface_chance;
            if CLEAR {
                let reflects = self.0.reflection_chance(reflected, through);
                scattered = above.pick(reflected, through * self.radiance_scale());
                chance = chance * above.pick(reflects, 1.0 - reflects);
            }
            let exists = facet.density.above(0.0);
            f = f + exists.pick(scattered * passed * (facet.density * facet.unmasked), grey(zero));
            pdf = pdf + exists.pick(chance * facet.density, zero);
        }
        (f, pdf)
    }

    /// The facet that reflects between directions with the half vector `h`.
    #[inline(always)]
    fn reflecting(&self, wo: V<L>, wi: V<L>, h: V<L>) -> Facet<L> {
        let (facets, zero) = (&self.0.base, wo.z.splat(0.0));
        let density = (facets.rough & wi.z.above(0.0)).pick(microfacets::reflection_pdf(facets.widths, wo, h), zero);
        Facet { cos: wo.dot(h).max(zero), density, unmasked: microfacets::g1(facets.widths, wi) }
    }

    /// The facet that reflects or refracts between two directions: see `rough_dielectric.rs`. Light passes a sheet in the direction
    /// that mirrors a reflected one.
    #[inline(always)]
    fn facet(&self, wo: V<L>, wi: V<L>) -> Facet<L> {
        let (facets, zero) = (&self.0.base, wo.z.splat(0.0));
        let through = wi.z.below(0.0);
        let bends = through & !self.0.interface.sheet;
        let wi = V { z: (through & self.0.interface.sheet).pick(-wi.z, wi.z), ..wi };
        let index = bends.pick(self.0.interface.relative, zero.splat(1.0));
        let sum = wo + wi * index;
        let square = sum.length_squared();
        let m = sum * (1.0 / square.sqrt()).copysign(sum.z);
        let (cos, beyond) = (wo.dot(m), wi.dot(m));
        let opposite = bends.pick(-beyond, beyond);
        let density = microfacets::visible_normal_pdf(facets.widths, wo, m) * (index * index * opposite / square);
        let exists = facets.rough & cos.above(0.0) & opposite.above(0.0) & square.above(0.0) & !(bends & self.0.faint);
        Facet { cos: cos.max(zero), density: exists.pick(density, zero), unmasked: microfacets::g1(facets.widths, wi) }
    }

    /// 1/η², by which radiance shrinks as it enters a denser medium.
    #[inline(always)]
    fn radiance_scale(&self) -> F<L> {
        1.0 / (self.0.interface.relative * self.0.interface.relative)
    }

    /// The direction of light that a facet with cosine `cos` refracts, and whether it is on the other side.
    #[inline(always)]
    fn refracted(&self, wo: V<L>, m: V<L>, cos: F<L>, mirrored: V<L>) -> (V<L>, M<L>) {
        let relative = self.0.interface.relative;
        let inverse = 1.0 / relative;
        let cos_t = dielectric(cos, relative).1;
        let bent = (m * (cos * inverse - cos_t) + -wo * inverse).normalized();
        let bent = self.0.faint.pick(-wo, bent);
        let wi = self.0.interface.sheet.pick(V { z: -mirrored.z, ..mirrored }, bent);
        (wi, wi.z.below(0.0))
    }
}

impl<L: Lanes, const CLEAR: bool> Bsdf<L> for PrincipledBsdf<'_, L, CLEAR> {
    #[inline(always)]
    fn eval(&self, wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        let l = self.0.l;
        eval_with(l, self, &view(l, &self.0, wo), wo, wi)
    }

    #[inline(always)]
    fn sample(&self, wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L> {
        let Point { base, coat, values, .. } = &self.0;
        let l = self.0.l;
        let view = view(l, &self.0, wo);
        let (zero, one) = (wo.z.splat(0.0), wo.z.splat(1.0));
        let ([of_fuzz, of_coat, of_diffuse], rest) = view.chosen(lobe);
        let rough = (of_coat & coat.rough) | (!of_coat & base.rough);
        let mut m = V { x: zero, y: zero, z: one };
        if rough.any() {
            m = rough.pick(ggx::sample_visible_normal(coat.widths.or(of_coat, base.widths), wo, u), m);
        }
        let cos = wo.dot(m).max(zero);
        let mirrored = m * (cos * 2.0) - wo;
        let (reflected, through) = self.0.scattered(&view, cos);
        let mut wi = mirrored;
        let mut exists = wi.z.above(0.0);
        let mut delta = !rough;
        let mut chance = one;
        let mut refracts = zero.above(0.0);
        if CLEAR {
            let reflects = self.0.reflection_chance(reflected, through);
            refracts = rest.ge(reflects) & !(of_fuzz | of_coat | of_diffuse);
            let (bent, passes) = self.refracted(wo, m, cos, mirrored);
            wi = refracts.pick(bent, wi);
            exists = (refracts & passes) | (!refracts & exists);
            delta = delta | (refracts & self.0.faint);
            chance = refracts.pick(1.0 - reflects, reflects);
        }
        if of_diffuse.any() {
            wi = of_diffuse.pick(rough_diffuse::sample(values.diffuse_roughness, u), wi);
        }
        if let Some(fuzz) = &view.fuzz {
            wi = of_fuzz.pick(fuzz.sample(u), wi);
        }
        let spread = of_fuzz | of_diffuse;
        (exists, delta) = (exists | spread, delta & !spread);
        let (f, pdf) = eval_with(l, self, &view, wo, wi);
        let sample = BsdfSample::of(wi, f, pdf);
        // Weights of the delta lobes.
        let way = refracts.pick(zero, self.0.way(wo.z));
        let scale = if CLEAR { refracts.pick(self.radiance_scale(), one) } else { one };
        let passed = view.passed * view.absorbed(values.coat_weight, way) * scale;
        let interface = refracts.pick(through, reflected) * passed * inverse(view.interface_chance * chance);
        let coated = grey((1.0 - view.fuzzed) * view.coat * inverse(view.coat_chance));
        let weight = delta.pick(of_coat.pick(coated, interface), sample.weight);
        BsdfSample { wi, weight: exists.pick(weight, grey(zero)), pdf, delta: delta | sample.delta }
    }
}

/// 1/x; 0 where x is 0.
#[inline(always)]
fn inverse<L: Lanes>(x: F<L>) -> F<L> {
    x.above(0.0).pick(1.0 / x, x.splat(0.0))
}

impl<const CLEAR: bool> Lobes for PrincipledBsdf<'_, One, CLEAR> {
    fn chosen(&self, wo: V<One>, u: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe {
        let Point { base, coat, interface, .. } = &self.0;
        let view = view(One, &self.0, wo);
        let ([fuzz, coated, diffuse], rest) = view.chosen(lobe);
        let named = |name, probability: F<One>| ChosenLobe { name, probability: probability.0 };
        if fuzz.0 {
            return named("fuzz", view.fuzz_chance);
        }
        if coated.0 {
            return named(if coat.rough.0 { "rough coat" } else { "smooth coat" }, view.coat_chance);
        }
        if diffuse.0 {
            return named("diffuse base", view.diffuse_chance);
        }
        let rough = base.rough.0;
        let m = if rough { ggx::sample_visible_normal(base.widths, wo, u) } else { V::splat(One, [0.0, 0.0, 1.0]) };
        let (reflected, through) = self.0.scattered(&view, wo.dot(m).max(F(0.0)));
        let reflects = if CLEAR { self.0.reflection_chance(reflected, through) } else { F(1.0) };
        if rest.lt(reflects).0 {
            return named(if rough { "microfacet reflection" } else { "mirror reflection" }, view.interface_chance * reflects);
        }
        let name = match (interface.sheet.0, rough) {
            (true, _) => "passage",
            (false, true) => "microfacet refraction",
            (false, false) => "refraction",
        };
        named(name, view.interface_chance * (1.0 - reflects))
    }
}
