//! The interface of the base: what a microfacet reflects and transmits.
use super::{super::fresnel::dielectric, thin_film::ThinFilm};
use noisefall_base::math::{F, Lanes, M, Pick, V};

/// F82's angle: cos θ = 1/7. There Schlick's rise is (6/7)⁵.
const RISE_AT_82: f32 = 0.462_663_8;
/// 1/(μ(1 − μ)⁶) at that cosine.
const SCALE_AT_82: f32 = 17.651_27;

/// The reflecting and transmitting parts of the base at a point.
#[derive(Clone, Copy)]
pub struct Interface<L: Lanes> {
    pub l: L,
    /// Index of refraction that gives the reflectance, at least 1: of the base against what lies on it, scaled by the specular weight.
    pub index: F<L>,
    /// Index beyond the surface over that on the side of the viewer; 1 in lanes of `sheet`.
    pub relative: F<L>,
    /// Lanes with a thin sheet, whose two faces reflect.
    pub sheet: M<L>,
    /// Reflectance of the metal at normal incidence, and how much the tint takes from Schlick's curve.
    pub metal: V<L>,
    pub metal_dip: V<L>,
    /// Specular weight, which scales the reflectance of the metal at all angles.
    pub metal_weight: F<L>,
    pub film: Option<Film<L>>,
}

/// The film on an interface.
#[derive(Clone, Copy)]
pub struct Film<L: Lanes> {
    pub layer: ThinFilm<L>,
    /// Indices of a dielectric that reflects what the metal does at normal incidence.
    pub metal: V<L>,
    pub weight: F<L>,
}

/// Reflectances of a microfacet.
pub struct Reflectances<L: Lanes> {
    pub metal: V<L>,
    /// Of an opaque dielectric base.
    pub opaque: V<L>,
    /// Of a clear base. Unlike the opaque one it is seen from inside, too.
    pub clear: V<L>,
}

/// The part of Schlick's curve with reflectance `f0` at normal incidence that the tint takes: a factor of μ(1 − μ)⁶.
///
/// Kutz, Hasan and Edmondson, "Novel aspects of the Adobe Standard Material", 2021: the reflectance at cos θ = 1/7 is `tint` times
/// Schlick's.
#[inline(always)]
pub fn dip<L: Lanes>(f0: F<L>, tint: F<L>) -> F<L> {
    (f0 + (1.0 - f0) * RISE_AT_82) * (1.0 - tint) * SCALE_AT_82
}

impl<L: Lanes> Interface<L> {
    /// Reflectances at cosine `cos` ≥ 0 between direction and (micro)normal.
    #[inline(always)]
    pub fn reflectances<const CLEAR: bool>(&self, cos: F<L>) -> Reflectances<L> {
        let plain = dielectric(cos, self.index).0;
        let mut metal = self.metal_reflectance(cos);
        let mut opaque = grey(plain);
        if let Some(film) = &self.film {
            let on_metal = film.layer.reflectance(self.l, film.metal, cos) * self.metal_weight;
            metal = mix(metal, on_metal, film.weight);
            opaque = mix(opaque, film.layer.reflectance(self.l, grey(self.index), cos), film.weight);
        }
        let mut clear = opaque;
        if CLEAR {
            clear = self.clear(cos);
        }
        Reflectances { metal, opaque, clear }
    }

    /// Reflectance of a smooth opaque base; with a film, an upper bound.
    #[inline(always)]
    pub fn most_reflected(&self, cos: F<L>) -> F<L> {
        let plain = dielectric(cos, self.index).0;
        let Some(film) = &self.film else { return plain };
        plain + (film.layer.most(self.index, cos) - plain) * film.weight
    }

    /// Reflectance of the clear base.
    ///
    /// Either side of a facet has the same reflectance. It is taken at the cosine on the thinner side, and is 1 beyond the critical
    /// angle. Reflections between the faces of a sheet sum to 2F/(1 + F).
    #[inline(always)]
    fn clear(&self, cos: F<L>) -> V<L> {
        let (zero, one) = (cos.splat(0.0), cos.splat(1.0));
        let from_dense = self.relative.below(1.0);
        let refracted = 1.0 - (1.0 - cos * cos) / (self.relative * self.relative);
        let thin = from_dense.pick(refracted.max(zero).sqrt(), cos);
        let mut found = grey(dielectric(thin, self.index).0);
        if let Some(film) = &self.film {
            found = mix(found, film.layer.reflectance(self.l, grey(self.index), thin), film.weight);
        }
        found = (from_dense & !refracted.above(0.0)).pick(grey(one), found);
        if !self.sheet.any() {
            return found;
        }
        let faces =
            V { x: 2.0 * found.x / (found.x + 1.0), y: 2.0 * found.y / (found.y + 1.0), z: 2.0 * found.z / (found.z + 1.0) };
        self.sheet.pick(faces, found)
    }

    /// F82: Schlick's curve less the dip.
    #[inline(always)]
    fn metal_reflectance(&self, cos: F<L>) -> V<L> {
        let x = 1.0 - cos;
        let x2 = x * x;
        let rise = x2 * x2 * x;
        let at = cos * rise * x;
        let curve = V {
            x: self.metal.x + (1.0 - self.metal.x) * rise - self.metal_dip.x * at,
            y: self.metal.y + (1.0 - self.metal.y) * rise - self.metal_dip.y * at,
            z: self.metal.z + (1.0 - self.metal.z) * rise - self.metal_dip.z * at,
        };
        positive(curve) * self.metal_weight
    }

    /// The reflectance of the metal averaged over diffuse light: 2 ∫₀¹ F(μ) μ dμ. The dip averages to 1/126.
    #[inline(always)]
    pub fn metal_average(&self) -> V<L> {
        let average = self.metal * (20.0 / 21.0) + [1.0 / 21.0; 3];
        positive(average - self.metal_dip * (1.0 / 126.0)) * self.metal_weight
    }
}

/// Returns a number in all channels.
#[inline(always)]
pub fn grey<L: Lanes>(x: F<L>) -> V<L> {
    V { x, y: x, z: x }
}

/// From `a` at weight 0 to `b` at weight 1.
#[inline(always)]
pub fn mix<L: Lanes>(a: V<L>, b: V<L>, weight: F<L>) -> V<L> {
    a + (b - a) * weight
}

#[inline(always)]
fn positive<L: Lanes>(v: V<L>) -> V<L> {
    let zero = v.x.splat(0.0);
    V { x: v.x.max(zero), y: v.y.max(zero), z: v.z.max(zero) }
}
