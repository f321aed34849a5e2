//! Disney's BSDF at a point: what does not depend on directions, and what its facets reflect and transmit.
use super::{
    super::{Local, Materials, anisotropy::Widths, fresnel::dielectric, lookup::Lookup},
    coat::ClearCoat,
    diffuse::{rise, sheen_share},
    row,
};
use noisefall_base::math::{F, Lanes, Pick, V, colour::LUMINANCE};

/// A material at a point, seen from one side. `CLEAR`: light may pass.
#[derive(Clone, Copy)]
pub struct Point<L: Lanes, const CLEAR: bool> {
    pub l: L,
    pub color: V<L>,
    pub roughness: F<L>,
    pub flatness: F<L>,
    pub facets: Widths<L>,
    /// Index beyond the surface over that on the side of the viewer.
    pub relative: F<L>,
    /// Parts of the diffuse base, of Fresnel's interface, of metal, of the tinted interface, and of the interface that transmits.
    pub diffuse: F<L>,
    dielectric: F<L>,
    pub metal: F<L>,
    tinted: F<L>,
    clear: F<L>,
    /// Reflectance of the tinted interface at normal incidence.
    head_on: V<L>,
    /// Amount of the sheen.
    pub sheen: V<L>,
    pub coat: ClearCoat<L>,
}

/// Probabilities of the lobes.
pub struct Chances<L: Lanes> {
    /// The diffuse base with the sheen.
    pub diffuse: F<L>,
    pub coat: F<L>,
    pub interface: F<L>,
}

impl<L: Lanes, const CLEAR: bool> Point<L, CLEAR> {
    #[inline(always)]
    pub fn new(l: L, materials: &Materials, at: &Local<L>, lookup: Lookup<L>) -> Self {
        let row = row::read(l, materials, at.material, lookup);
        let (zero, one) = (l.f(0.0), l.f(1.0));
        let white = V { x: one, y: one, z: one };
        // Metal, base, sheen and coat are on the outside of what transmits light.
        let outside = if CLEAR { at.front.pick(one, zero) } else { one };
        let relative = if CLEAR { at.front.pick(row.ior, 1.0 / row.ior) } else { row.ior };
        let rest = 1.0 - row.metallic;
        let clear = if CLEAR { rest * row.spec_trans } else { zero };
        let plain = rest * (1.0 - row.spec_tint);
        let color = at.colour;
        let luminance = color.dot_with(LUMINANCE);
        let hue = luminance.above(0.0).pick(color * (1.0 / luminance.max(l.f(f32::MIN_POSITIVE))), white);
        let root = (relative - 1.0) / (relative + 1.0);
        let aspect = (1.0 - row.anisotropic * 0.9).sqrt();
        Point {
            l,
            color,
            roughness: at.alpha.sqrt(),
            flatness: row.flatness,
            facets: Widths::along(at.alpha / aspect, at.alpha * aspect),
            relative,
            diffuse: outside * (rest * (1.0 - row.spec_trans)),
            dielectric: if CLEAR { at.front.pick(plain, clear) } else { plain },
            metal: outside * row.metallic,
            tinted: outside * (rest * row.spec_tint),
            clear,
            head_on: hue * (root * root),
            sheen: (white + (hue - white) * row.sheen_tint) * (outside * (rest * row.sheen)),
            coat: ClearCoat::new(outside * row.clearcoat, row.clearcoat_gloss),
        }
    }

    /// The parts of the light that a facet reflects and transmits, from Fresnel's reflectance and the cosine [`on_thin_side`].
    #[inline(always)]
    pub fn interface(&self, fresnel: F<L>, seen: F<L>) -> (V<L>, V<L>) {
        let zero = fresnel.splat(0.0);
        let none = V { x: zero, y: zero, z: zero };
        let (one, rise) = (fresnel.splat(1.0), rise(seen));
        let white = V { x: one, y: one, z: one };
        let plain = self.dielectric * fresnel;
        let metal = self.color + (white - self.color) * rise;
        let tinted = self.head_on + (white - self.head_on) * rise;
        let reflected = V { x: plain, y: plain, z: plain } + metal * self.metal + tinted * self.tinted;
        let mut through = none;
        if CLEAR {
            let root = V { x: self.color.x.sqrt(), y: self.color.y.sqrt(), z: self.color.z.sqrt() };
            through = root * (self.clear * (1.0 - fresnel));
        }
        (fresnel.above(0.0).pick(reflected, none), through)
    }

    /// The parts of the light that a facet at a cosine ≥ 0 to the viewer reflects and transmits.
    #[inline(always)]
    pub fn scattered(&self, cos: F<L>) -> (V<L>, V<L>) {
        let (fresnel, cos_t) = dielectric(cos, self.relative);
        self.interface(fresnel, on_thin_side(self.relative, cos, cos_t))
    }

    /// The probabilities of the lobes for a viewer at a cosine: about their shares of the light, by the largest channel.
    #[inline(always)]
    pub fn chances(&self, cos: F<L>) -> Chances<L> {
        let (reflected, through) = self.scattered(cos);
        let mut interface = reflected.max_component();
        if CLEAR {
            interface = interface + through.max_component();
        }
        let grazing = rise(cos) * (self.roughness * 1.2 - 0.5) + 1.0;
        let diffuse = self.diffuse * self.color.max_component() * grazing + self.sheen.max_component() * sheen_share(cos);
        let coat = self.coat.share();
        // Nothing is reflected by a black base whose index is that of its surroundings.
        let scale = 1.0 / (diffuse + coat + interface).max(cos.splat(f32::MIN_POSITIVE));
        Chances { diffuse: diffuse * scale, coat: coat * scale, interface: interface * scale }
    }
}

/// The cosine of Schlick's reflectance, from that on the side of a ray and the refracted one: the index is that beyond the interface
/// over that on the side of the ray.
#[inline(always)]
pub fn on_thin_side<L: Lanes>(index: F<L>, cos: F<L>, cos_t: F<L>) -> F<L> {
    index.above(1.0).pick(cos, cos_t)
}

/// The probability that a facet reflects light which it may also transmit.
#[inline(always)]
pub fn reflection_chance<L: Lanes>(reflected: V<L>, through: V<L>) -> F<L> {
    let reflected = reflected.max_component();
    reflected / (reflected + through.max_component()).max(reflected.splat(f32::MIN_POSITIVE))
}
