//! The lobes of Disney's BSDF: evaluation and sampling.
use fearless_simd_macros::simd;

use super::{
    super::{
        Bsdf, BsdfSample, ChosenLobe, Lobes,
        fresnel::dielectric,
        microfacets::{self, Microfacets},
    },
    diffuse::{diffuse, rise},
    point::{Chances, Point, on_thin_side, reflection_chance},
};
use crate::sampling::Directions;
use noisefall_base::math::{F, Lanes, M, One, Pick, V};

/// The BSDF at a point. `CLEAR`: light may pass.
#[derive(Clone, Copy)]
pub struct DisneyBsdf<L: Lanes, const CLEAR: bool>(pub Point<L, CLEAR>);

/// The half vector of two directions.
struct Half<L: Lanes> {
    h: V<L>,
    /// Lanes whose light comes from the other side.
    through: M<L>,
    /// Cosine to the viewer, and the absolute one to the light; 0 where no facet scatters from one to the other.
    cos: F<L>,
    light: F<L>,
    /// Density of the light's direction over the facets that the viewer sees, per solid angle.
    density: F<L>,
}

/// [`Bsdf::eval`] with known probabilities, as a call.
#[simd]
fn eval_with<L: Lanes, const CLEAR: bool>(
    l: L,
    bsdf: &DisneyBsdf<L, CLEAR>,
    chances: &Chances<L>,
    wo: V<L>,
    wi: V<L>,
) -> (V<L>, F<L>) {
    let half = bsdf.half(l, wo, wi);
    let (f, pdf) = bsdf.facets(&half, wi);
    let (mut f, mut pdf) = (f, pdf * chances.interface);
    let (zero, above) = (l.f(0.0), wi.z.above(0.0));
    let (more, pdf_more) = bsdf.outside(chances, &half, wo, wi);
    let none = V { x: zero, y: zero, z: zero };
    f = f + above.pick(more, none);
    pdf = pdf + above.pick(pdf_more, zero);
    (f, pdf)
}

impl<L: Lanes, const CLEAR: bool> DisneyBsdf<L, CLEAR> {
    /// Walter et al. 2007, equations 13, 14, 16 and 17: reflection is refraction with an index of 1, apart from the sign.
    #[inline(always)]
    fn half(&self, l: L, wo: V<L>, wi: V<L>) -> Half<L> {
        let zero = l.f(0.0);
        let through = wi.z.below(0.0);
        let index = if CLEAR { through.pick(self.0.relative, l.f(1.0)) } else { l.f(1.0) };
        let sum = wo + wi * index;
        let square = sum.length_squared();
        let h = sum * (1.0 / square.sqrt()).copysign(sum.z);
        let (cos, beyond) = (wo.dot(h), wi.dot(h));
        let light = if CLEAR { through.pick(-beyond, beyond) } else { beyond };
        let density = microfacets::visible_normal_pdf(self.0.facets, wo, h) * (index * index * light / square);
        let mut exists = cos.above(0.0) & light.above(0.0) & square.above(0.0);
        if !CLEAR {
            exists = exists & wi.z.above(0.0);
        }
        Half { h, through, cos: exists.pick(cos, zero), light: exists.pick(light, zero), density: exists.pick(density, zero) }
    }

    /// f |cos θ_i| of the interface, and the pdf of its samples.
    #[inline(always)]
    fn facets(&self, half: &Half<L>, wi: V<L>) -> (V<L>, F<L>) {
        let relative = self.0.relative;
        // Either side has the same reflectance. Refraction takes it from the thinner one, where a small error of the cosine does not
        // become a large one of transmittance next to total reflection.
        let swap = half.through & relative.below(1.0);
        let (mut cos, mut index) = (half.cos, relative);
        if CLEAR {
            (cos, index) = (swap.pick(half.light, cos), swap.pick(1.0 / relative, index));
        }
        let (fresnel, cos_t) = dielectric(cos, index);
        let (reflected, through) = self.0.interface(fresnel, on_thin_side(index, cos, cos_t));
        let unmasked = half.density * microfacets::g1(self.0.facets, wi);
        if !CLEAR {
            return (reflected * unmasked, half.density);
        }
        let reflects = reflection_chance(reflected, through);
        let passed = through * (1.0 / (relative * relative));
        let chance = half.through.pick(1.0 - reflects, reflects);
        (half.through.pick(passed, reflected) * unmasked, half.density * chance)
    }

    /// f |cos θ_i| and pdf of what lies on the outside, for light from above: diffuse base, sheen and clear coat.
    #[inline(always)]
    fn outside(&self, chances: &Chances<L>, half: &Half<L>, wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        let Point { color, roughness, flatness, sheen, coat, relative, .. } = self.0;
        let zero = wo.z.splat(0.0);
        let light = wi.z.max(zero);
        let base = color * (self.0.diffuse * diffuse(roughness, flatness, wo.z, light, half.light));
        let mut f = (base + sheen * rise(half.light)) * light;
        let mut pdf = chances.diffuse * (light * std::f32::consts::FRAC_1_PI);
        if coat.weight.above(0.0).any() {
            let seen = on_thin_side(relative, half.cos, dielectric(half.cos, relative).1);
            let (coated, density) = coat.eval(wo, wi, half.h, half.cos, seen);
            let exists = coat.weight.above(0.0) & half.cos.above(0.0);
            let coated = exists.pick(coated, zero);
            f = f + V { x: coated, y: coated, z: coated };
            pdf = pdf + exists.pick(chances.coat * density, zero);
        }
        (f, pdf)
    }

    /// The direction of light that a facet with cosine `cos` refracts.
    #[inline(always)]
    fn refracted(&self, wo: V<L>, m: V<L>, cos: F<L>) -> V<L> {
        let inverse = 1.0 / self.0.relative;
        let cos_t = dielectric(cos, self.0.relative).1;
        (m * (cos * inverse - cos_t) + -wo * inverse).normalized()
    }
}

impl<L: Lanes, const CLEAR: bool> Bsdf<L> for DisneyBsdf<L, CLEAR> {
    #[inline(always)]
    fn eval(&self, wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        eval_with(self.0.l, self, &self.0.chances(wo.z), wo, wi)
    }

    #[inline(always)]
    fn sample(&self, wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L> {
        let chances = self.0.chances(wo.z);
        let zero = wo.z.splat(0.0);
        let of_diffuse = lobe.lt(chances.diffuse);
        let of_coat = lobe.lt(chances.diffuse + chances.coat) & !of_diffuse;
        let mut m = self.0.facets.sample_visible_normal(wo, u);
        if of_coat.any() {
            m = of_coat.pick(self.0.coat.sample(u), m);
        }
        let cos = wo.dot(m).max(zero);
        let mut wi = m * (cos * 2.0) - wo;
        let mut exists = wi.z.above(0.0);
        if CLEAR {
            let (reflected, through) = self.0.scattered(cos);
            let rest = (lobe - chances.diffuse - chances.coat) / chances.interface;
            let refracts = rest.ge(reflection_chance(reflected, through)) & !(of_diffuse | of_coat);
            let bent = self.refracted(wo, m, cos);
            exists = (refracts & bent.z.below(0.0)) | (!refracts & exists);
            wi = refracts.pick(bent, wi);
        }
        if of_diffuse.any() {
            wi = of_diffuse.pick(Directions::Cosine.sample(u), wi);
            exists = exists | of_diffuse;
        }
        let (f, pdf) = eval_with(self.0.l, self, &chances, wo, wi);
        let sample = BsdfSample::of(wi, f, pdf);
        let none = V { x: zero, y: zero, z: zero };
        BsdfSample { weight: exists.pick(sample.weight, none), ..sample }
    }
}

impl<const CLEAR: bool> Lobes for DisneyBsdf<One, CLEAR> {
    fn chosen(&self, wo: V<One>, u: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe {
        let Chances { diffuse, coat, interface } = self.0.chances(wo.z);
        let named = |name, probability: f32| ChosenLobe { name, probability };
        if lobe.lt(diffuse).0 {
            return named("diffuse base and sheen", diffuse.0);
        }
        if lobe.lt(diffuse + coat).0 {
            return named("clear coat", coat.0);
        }
        if !CLEAR {
            return named("microfacet reflection", interface.0);
        }
        let m = self.0.facets.sample_visible_normal(wo, u);
        let (reflected, through) = self.0.scattered(wo.dot(m).max(F(0.0)));
        let reflects = reflection_chance(reflected, through).0;
        let rest = F((lobe.0 - diffuse.0 - coat.0) / interface.0);
        let chosen = ChosenLobe::of_two(["microfacet reflection", "microfacet refraction"], reflects, rest);
        ChosenLobe { probability: chosen.probability * interface.0, ..chosen }
    }
}
