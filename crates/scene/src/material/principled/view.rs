//! A principled material seen from a direction: what its layers let through, and the probabilities of its lobes.
use fearless_simd_macros::simd;

use super::{
    super::{anisotropic_loss::AnisotropicLoss, fresnel::dielectric, ggx, missing_energy::MissingEnergy},
    facets::Facets,
    fuzz::Fuzz,
    interface::{Reflectances, grey, mix},
    point::Point,
};
use noisefall_base::math::{
    F, Lanes, M, Pick, V,
    exp::{exp2_of_negative, log2},
};

/// Quantities that depend on ω_o alone.
pub struct View<L: Lanes> {
    pub fuzz: Option<Fuzz<L>>,
    /// The part of the light that white fuzz reflects, and the one that passes it times the weight of the coat.
    pub fuzzed: F<L>,
    pub coated: F<L>,
    /// The part that the coat of that weight reflects.
    pub coat: F<L>,
    /// The part that passes fuzz and coat, darkened, but not absorbed.
    pub passed: V<L>,
    /// log₂ of the coat's colour, and the way in it towards the viewer over its thickness.
    absorption: Option<(V<L>, F<L>)>,
    /// The part that the interface of an opaque base lets in.
    pub entered: F<L>,
    /// Factors that restore the light that single scattering between microfacets loses.
    pub metal_gain: V<L>,
    pub clear_gain: F<L>,
    /// Probabilities of fuzz, coat, diffuse base and interface.
    pub fuzz_chance: F<L>,
    pub coat_chance: F<L>,
    pub diffuse_chance: F<L>,
    pub interface_chance: F<L>,
}

/// A material seen from ω_o above the surface.
///
/// This is a call, so that a stage has it once and not for each of its uses.
#[simd]
pub fn view<L: Lanes, const CLEAR: bool>(l: L, point: &Point<L, CLEAR>, wo: V<L>) -> View<L> {
    point.seen_from(l, wo)
}

impl<L: Lanes, const CLEAR: bool> Point<'_, L, CLEAR> {
    #[inline(always)]
    fn seen_from(&self, l: L, wo: V<L>) -> View<L> {
        let values = &self.values;
        let (zero, one) = (l.f(0.0), l.f(1.0));
        let mut view = View {
            fuzz: None,
            fuzzed: zero,
            coated: one,
            coat: zero,
            passed: self.darkening,
            absorption: None,
            entered: one,
            metal_gain: grey(one),
            clear_gain: one,
            fuzz_chance: zero,
            coat_chance: zero,
            diffuse_chance: zero,
            interface_chance: zero,
        };
        if self.has_fuzz.any() {
            let fuzz = Fuzz::new(values.fuzz_roughness, wo);
            view.fuzzed = self.has_fuzz.pick(values.fuzz_weight * fuzz.albedo, zero);
            view.fuzz = Some(fuzz);
        }
        let rest = 1.0 - view.fuzzed;
        if self.has_coat.any() {
            let weight = self.has_coat.pick(values.coat_weight, zero);
            view.coated = rest * weight;
            view.coat = weight * self.coat.albedo(wo, self.coat_ior);
            let color = values.coat_color;
            view.absorption = Some((V { x: log2(color.x), y: log2(color.y), z: log2(color.z) }, self.way(wo.z)));
        }
        view.passed = view.passed * (rest * (1.0 - view.coat));
        let seen = self.interface.reflectances::<CLEAR>(wo.z);
        if self.opaque.above(0.0).any() {
            view.entered = 1.0 - (self.interface.most_reflected(wo.z) * self.base.quotient(wo)).min(one);
        }
        self.gains(wo, &mut view);
        self.choose(wo, &seen, rest, &mut view);
        view
    }

    /// Factors of what single scattering reflects: see [`super`].
    #[inline(always)]
    fn gains(&self, wo: V<L>, view: &mut View<L>) {
        let (l, one) = (self.l, self.l.f(1.0));
        let sheets = self.interface.sheet;
        if (self.base.rough & (self.has_metal | sheets)).any() {
            let loss = AnisotropicLoss::new(l, self.loss, self.base.widths, self.base.anisotropic);
            let lost = self.base.rough.pick(loss.at(wo), l.f(0.0));
            let further = lost / (1.0 - lost);
            let average = self.interface.metal_average();
            let mean = loss.average();
            let kept = 1.0 - mean;
            view.metal_gain = V {
                x: 1.0 + further * average.x * kept / (1.0 - average.x * mean),
                y: 1.0 + further * average.y * kept / (1.0 - average.y * mean),
                z: 1.0 + further * average.z * kept / (1.0 - average.z * mean),
            };
            view.clear_gain = sheets.pick(1.0 + further, one);
        }
        if CLEAR {
            let solid = self.base.rough & !sheets & !self.faint;
            if solid.any() {
                let lost = self.missing(wo).loss(wo, wo.z.below(0.0)).here;
                view.clear_gain = solid.pick(1.0 / (1.0 - lost), view.clear_gain);
            }
        }
    }

    /// The light that the interface of a clear base loses. Of textured anisotropy, it is that of round facets with the width towards the viewer.
    #[inline(always)]
    fn missing(&self, wo: V<L>) -> MissingEnergy<'_, L> {
        let Point { l, base: Facets { alpha, widths, anisotropic, .. }, turned, .. } = *self;
        if !anisotropic.any() {
            return MissingEnergy::new(l, widths.mean(), self.front, self.losses);
        }
        let round = anisotropic.pick(widths.towards(wo), widths.mean());
        let alpha = turned.pick(alpha.max(l.f(ggx::SMOOTH)), round);
        MissingEnergy::anisotropic(l, alpha, turned.pick(widths.larger(), round), turned, self.front, self.losses)
    }

    /// The probabilities of the lobes: their shares of the reflected and transmitted light, by the largest channel.
    #[inline(always)]
    fn choose(&self, wo: V<L>, seen: &Reflectances<L>, rest: F<L>, view: &mut View<L>) {
        let Point { values, .. } = self;
        let passed = view.passed * view.absorbed(values.coat_weight, self.way(wo.z));
        let entered = passed * self.albedo * view.entered;
        let quotient = self.base.quotient(wo);
        let metal = seen.metal * values.metalness;
        let opaque = values.specular_color * seen.opaque * (self.opaque * quotient);
        let mut interface = metal + opaque;
        if CLEAR {
            let clear = seen.clear * values.specular_color + (grey(rest.splat(1.0)) - seen.clear) * self.tint;
            interface = interface + clear * self.clear;
        }
        let fuzz = view.fuzzed * values.fuzz_color.max_component();
        let coat = rest * view.coat;
        let diffuse = entered.max_component() * self.opaque;
        let interface = (passed * interface).max_component();
        // Nothing is reflected by a black base whose index is that of its surroundings.
        let scale = 1.0 / (fuzz + coat + (diffuse + interface)).max(rest.splat(f32::MIN_POSITIVE));
        view.fuzz_chance = fuzz * scale;
        view.coat_chance = coat * scale;
        view.diffuse_chance = diffuse * scale;
        view.interface_chance = interface * scale;
    }

    /// The way through the coat in a direction of cosine `cos` outside, over the coat's thickness.
    #[inline(always)]
    pub fn way(&self, cos: F<L>) -> F<L> {
        let cos_t = dielectric(cos.abs(), self.coat_ior.max(cos.splat(1.0))).1;
        1.0 / cos_t.max(cos.splat(1e-3))
    }

    /// Reflected and transmitted light of a facet at cosine `cos`, each over the other layers' part and the density of facets.
    #[inline(always)]
    pub fn scattered(&self, view: &View<L>, cos: F<L>) -> (V<L>, V<L>) {
        let found = self.interface.reflectances::<CLEAR>(cos);
        let metal = found.metal * view.metal_gain * self.values.metalness;
        let mut dielectric = found.opaque * self.opaque;
        let one = grey(cos.splat(1.0));
        let mut through = one * 0.0;
        if CLEAR {
            let part = self.clear * view.clear_gain;
            dielectric = dielectric + found.clear * part;
            through = (one - found.clear) * self.tint * part;
        }
        (metal + dielectric * self.values.specular_color, through)
    }

    /// Probability of reflection at a facet, against refraction.
    #[inline(always)]
    pub fn reflection_chance(&self, reflected: V<L>, through: V<L>) -> F<L> {
        let (reflected, through) = (reflected.max_component(), through.max_component());
        reflected / (reflected + through).max(through.splat(f32::MIN_POSITIVE))
    }
}

impl<L: Lanes> View<L> {
    /// Transmittance of a coat of that weight, in and out: `way` is that of the other direction, 0 for light that stays inside.
    ///
    /// The colour is the transmittance at normal incidence, half of it on either way (OpenPBR 1.1, "Coat absorption").
    #[inline(always)]
    pub fn absorbed(&self, weight: F<L>, way: F<L>) -> V<L> {
        let white = grey(way.splat(1.0));
        let Some((octaves, here)) = &self.absorption else { return white };
        let half = (*here + way) * 0.5;
        let found = V {
            x: exp2_of_negative(octaves.x * half),
            y: exp2_of_negative(octaves.y * half),
            z: exp2_of_negative(octaves.z * half),
        };
        mix(white, found, weight)
    }

    /// Lanes that choose fuzz, coat and diffuse base by a number in [0, 1), and where in the rest of it the others are.
    #[inline(always)]
    pub fn chosen(&self, lobe: F<L>) -> ([M<L>; 3], F<L>) {
        let first = self.fuzz_chance;
        let second = first + self.coat_chance;
        let third = second + self.diffuse_chance;
        let fuzz = lobe.lt(first);
        let coat = lobe.lt(second) & !fuzz;
        let diffuse = lobe.lt(third) & !fuzz & !coat;
        ([fuzz, coat, diffuse], (lobe - third) / self.interface_chance)
    }
}
