//! A principled material at a point: what does not depend on directions.
use super::{
    super::{Local, Materials, lookup::Lookup, missing_energy::LossTable, refraction::FAINT},
    facets::Facets,
    interface::{Film, Interface, dip, grey, mix},
    layout::{ANISOTROPIC, COAT, Constants, FILM, FUZZ, METAL, SHEET, TINTED, TURNED, VARIES},
    thin_film::ThinFilm,
    values::{Values, values},
};
use noisefall_base::math::{F, Lanes, M, Pick, V};

/// A material at a point. `CLEAR`: its base may transmit light.
#[derive(Clone, Copy)]
pub struct Point<'a, L: Lanes, const CLEAR: bool> {
    pub l: L,
    /// Tables of the light that microfacets lose, for round and for anisotropic ones.
    pub loss: [&'static [[f32; 4]]; 2],
    pub losses: LossTable<'a, L>,
    /// Lanes where the latter have rows for every azimuth.
    pub turned: M<L>,
    pub values: Values<L>,
    pub interface: Interface<L>,
    /// Microfacets of the base and of the coat.
    pub base: Facets<'a, L>,
    pub coat: Facets<'a, L>,
    pub coat_ior: F<L>,
    /// Albedo of the diffuse base.
    pub albedo: V<L>,
    /// Part of the base that is an opaque dielectric, and the part that is a clear one; the rest is metal.
    pub opaque: F<L>,
    pub clear: F<L>,
    /// Factors of the transmitted light.
    pub tint: V<L>,
    /// One over the diffuse light that the base lets in, times a bound of what rough diffuse bases may gain: see [`Point::entry`].
    pub entry: F<L>,
    /// Factor of the base for light that the coat reflects back to it.
    pub darkening: V<L>,
    pub has_coat: M<L>,
    pub has_fuzz: M<L>,
    pub has_metal: M<L>,
    /// Lanes whose viewer is outside, and lanes whose base refracts too little for a half vector.
    pub front: M<L>,
    pub faint: M<L>,
}

impl<'a, L: Lanes, const CLEAR: bool> Point<'a, L, CLEAR> {
    #[inline(always)]
    pub fn new(l: L, materials: &'a Materials, at: &Local<L>, lookup: Lookup<L>) -> Self {
        let constants = Constants::read(l, materials, at.material);
        let mut values = values(l, &materials.further, constants.further, lookup);
        let (zero, one) = (l.f(0.0), l.f(1.0));
        let sheet = constants.has(SHEET);
        let rows = &materials.tables.rows;
        let anisotropic = constants.has(ANISOTROPIC);
        let coat_alpha = values.coat_roughness * values.coat_roughness;
        let alpha = roughened(at.alpha, coat_alpha, values.coat_weight);
        let base = Facets::new(l, rows, constants.base_table, alpha, anisotropic.pick(values.anisotropy, zero));
        let coat = Facets::new(l, rows, constants.coat_table, coat_alpha, anisotropic.pick(values.coat_anisotropy, zero));
        let interface = interface::<L, CLEAR>(l, &constants, &values, at, sheet);
        if CLEAR {
            // Coat and fuzz lie on the outside of what light enters; inside, the base is the same.
            let layered = at.front | sheet | !values.transmission_weight.above(0.0);
            values.coat_weight = layered.pick(values.coat_weight, zero);
            values.fuzz_weight = layered.pick(values.fuzz_weight, zero);
        }
        let metalness = values.metalness;
        let transmission = if CLEAR { values.transmission_weight } else { zero };
        let opaque = (1.0 - metalness) * (1.0 - transmission);
        let mut point = Point {
            l,
            loss: materials.tables.losses(),
            turned: constants.has(TURNED),
            losses: LossTable { rows, offset: constants.interface_table, textured: constants.has(VARIES) },
            interface,
            base,
            coat,
            coat_ior: constants.coat_ior,
            albedo: at.colour * values.base_weight,
            opaque,
            clear: (1.0 - metalness) * transmission,
            tint: constants.has(TINTED).pick(values.transmission_color, grey(one)),
            entry: one,
            darkening: grey(one),
            has_coat: constants.has(COAT) & values.coat_weight.above(0.0),
            has_fuzz: constants.has(FUZZ) & values.fuzz_weight.above(0.0),
            has_metal: constants.has(METAL) & metalness.above(0.0),
            front: at.front,
            faint: (interface.relative - 1.0).abs().below(FAINT) & !sheet,
            values,
        };
        if opaque.above(0.0).any() {
            point.entry = point.entry(constants.table_ior);
        }
        if point.has_coat.any() {
            point.darkening = point.has_coat.pick(point.darkening(at.alpha, transmission), point.darkening);
        }
        point
    }

    /// One over the part of diffuse light that the base lets in, T_avg.
    ///
    /// The table has it for a fixed index. 1 − T_avg of other indices is nearly (η − 1)/(4.08567 + 1.00071 η) (Kulla and Conty 2017);
    /// only the quotient of two such values counts. A rough diffuse base prefers directions in which light enters easily: the
    /// product gains up to 0.7 %, which is taken off.
    #[inline(always)]
    fn entry(&self, table_ior: F<L>) -> F<L> {
        const MOST: f32 = 0.007;
        const GAIN: f32 = 0.15;
        let reflected = (1.0 - self.base.passed()) * average(self.interface.index) / average(table_ior);
        let gain = (reflected * GAIN).min(reflected.splat(MOST)) * self.values.diffuse_roughness;
        1.0 / ((1.0 - reflected) * (gain + 1.0))
    }

    /// OpenPBR 1.1, "Coat darkening": the base reflects E_b of the light, the coat reflects K of that back, and (1 − K)/(1 − E_b K) of
    /// it leaves.
    #[inline(always)]
    fn darkening(&self, alpha: F<L>, transmission: F<L>) -> V<L> {
        let Values { metalness, coat_weight, coat_darkening, .. } = self.values;
        let head_on = (self.coat_ior - 1.0) / (self.coat_ior + 1.0);
        let smooth = head_on * head_on;
        let diffuse = 1.0 - self.coat.passed() / (self.coat_ior * self.coat_ior);
        let root = alpha.sqrt();
        let roughness = (1.0 - transmission) + root * transmission;
        let roughness = roughness + (root - roughness) * metalness;
        let k = smooth + (diffuse - smooth) * roughness;
        let reflected = mix(self.albedo * (1.0 - transmission), self.interface.metal * self.interface.metal_weight, metalness);
        let echo = grey(k.splat(1.0)) - reflected * k;
        let factor = V { x: (1.0 - k) / echo.x, y: (1.0 - k) / echo.y, z: (1.0 - k) / echo.z };
        mix(grey(k.splat(1.0)), factor, coat_weight * coat_darkening)
    }
}

/// α of the base under a coat: it widens what it transmits in and out (OpenPBR 1.1, "Coat roughening", in α).
#[inline(always)]
pub fn roughened<L: Lanes>(alpha: F<L>, coat_alpha: F<L>, weight: F<L>) -> F<L> {
    let both = (alpha * alpha + coat_alpha * coat_alpha * 2.0).min(alpha.splat(1.0)).sqrt();
    alpha + (both - alpha) * weight
}

/// Nearly the reflectance for diffuse light of a smooth dielectric, up to a factor near 1.
#[inline(always)]
fn average<L: Lanes>(index: F<L>) -> F<L> {
    (index - 1.0) / (index * 1.00071 + 4.08567)
}

#[inline(always)]
fn interface<L: Lanes, const CLEAR: bool>(
    l: L,
    constants: &Constants<F<L>, noisefall_base::math::U<L>>,
    values: &Values<L>,
    at: &Local<L>,
    sheet: M<L>,
) -> Interface<L> {
    let one = l.f(1.0);
    let metal = at.colour * values.base_weight;
    let index = index(constants.ior, constants.coat_ior, values.coat_weight, values.specular_weight);
    let relative = if CLEAR { sheet.pick(one, at.front.pick(constants.ior, 1.0 / constants.ior)) } else { one };
    let tint = values.specular_color;
    let has_film = constants.has(FILM) & values.film_weight.above(0.0);
    let mut film = None;
    if has_film.any() {
        film = Some(Film {
            layer: ThinFilm { ior: constants.film_ior, thickness: values.film_thickness },
            metal: V { x: index_of(metal.x), y: index_of(metal.y), z: index_of(metal.z) },
            weight: has_film.pick(values.film_weight, l.f(0.0)),
        });
    }
    Interface {
        l,
        index,
        relative,
        sheet,
        metal,
        metal_dip: V { x: dip(metal.x, tint.x), y: dip(metal.y, tint.y), z: dip(metal.z, tint.z) },
        metal_weight: values.specular_weight,
        film,
    }
}

/// The index that gives the reflectance of the base: `ior` against what lies on it, which is the coat with a weight, and with its
/// reflectance at normal incidence scaled (OpenPBR 1.1, "Specular weight"). The denser side counts as inside.
#[inline(always)]
pub fn index<L: Lanes>(ior: F<L>, coat_ior: F<L>, coat: F<L>, weight: F<L>) -> F<L> {
    let against = ior + (ior / coat_ior - ior) * coat;
    let dense = against.max(1.0 / against);
    let bare = (dense - 1.0) / (dense + 1.0);
    let exact = weight.ge(weight.splat(1.0));
    exact.pick(dense, index_of(bare * bare * weight))
}

/// The index of a dielectric with a reflectance below 1 at normal incidence.
#[inline(always)]
fn index_of<L: Lanes>(reflectance: F<L>) -> F<L> {
    let root = reflectance.max(reflectance.splat(0.0)).sqrt().min(reflectance.splat(0.999));
    (1.0 + root) / (1.0 - root)
}
