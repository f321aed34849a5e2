//! The table of cases.
use super::super::{
    Bsdf, BsdfSample, Conductor, Distribution, Lambertian, LambertianBsdf, Local, Material, Materials, Mirror, Plastic,
    Reflectance, RoughPlastic, Roughness, Shade, Stage,
    albedo::Albedo,
    anisotropic_loss::AnisotropicLoss,
    anisotropy::Widths,
    beckmann::Beckmann,
    conductor::{AnisotropicConductor, BeckmannConductor},
    conductor_bsdf::ConductorBsdf,
    disney::{Disney, DisneyBsdf},
    mirror::MirrorBsdf,
    plastic::PlasticBsdf,
    principled::{Principled, PrincipledBsdf},
    rough_plastic::RoughPlasticBsdf,
};
use crate::sampling::Directions;
use noisefall_base::{
    declare::Textured,
    math::{F, M, One, U, V},
};

pub const ALPHAS: [f32; 7] = [0.001, 0.01, 0.05, 0.1, 0.3, 0.6, 1.0];
pub const COSINES: [f32; 5] = [1.0, 0.7, 0.3, 0.1, 0.02];

/// Gold, roughly, in red, green and blue.
pub fn gold() -> Reflectance {
    Reflectance::index([0.143, 0.374, 1.442], [3.983, 2.386, 1.603])
}

pub fn fresnels() -> [Reflectance; 3] {
    [Reflectance::Constant(Textured::grey(1.0)), Reflectance::Schlick([0.9, 0.5, 0.04].into()), gold()]
}

const IORS: [f32; 3] = [1.1, 1.5, 2.4];

pub struct Case {
    pub name: String,
    pub alpha: f32,
    pub material: Material,
    pub directions: Directions,
    /// Whether the albedo must be 1.
    pub lossless: bool,
    /// Upper bound of the albedo: 1 and an error of quadrature, except for models that do not conserve energy.
    pub most: f64,
    /// Whether light and viewer can be exchanged.
    pub reciprocal: bool,
    materials: Materials,
}

impl Case {
    fn new(material: impl Into<Material>, alpha: f32, directions: Directions, lossless: bool) -> Case {
        let material = material.into();
        let name = format!("{material:?} {directions:?}");
        let materials = Materials::new(std::slice::from_ref(&material));
        Case { name, alpha, material, directions, lossless, most: 1.0005, reciprocal: true, materials }
    }

    pub fn bsdf(&self) -> Any<'_> {
        let [x, y, z] = colour(&self.material).map(F);
        let at = Local { material: U(0), colour: V { x, y, z }, alpha: F(self.alpha), front: M(true) };
        let (all, directions) = (&self.materials, self.directions);
        match all.stage(0) {
            Stage::Plain | Stage::Diffuse => Any::Lambertian(LambertianBsdf { albedo: at.colour, directions }),
            Stage::Mirror => Any::Mirror(Mirror::at(One, all, directions, &at)),
            Stage::Conductor => Any::Conductor(Conductor::at(One, all, directions, &at)),
            Stage::Plastic => Any::Plastic(Plastic::at(One, all, directions, &at)),
            Stage::Principled => Any::Principled(Principled::at(One, all, directions, &at)),
            Stage::BeckmannConductor => Any::BeckmannConductor(BeckmannConductor::at(One, all, directions, &at)),
            Stage::RoughPlastic => Any::RoughPlastic(RoughPlastic::at(One, all, directions, &at)),
            Stage::Disney => Any::Disney(Disney::at(One, all, directions, &at)),
            Stage::AnisotropicConductor => Any::AnisotropicConductor(AnisotropicConductor::at(One, all, directions, &at)),
            _ => unreachable!("tested with the dielectrics"),
        }
    }
}

pub fn cases() -> Vec<Case> {
    let mut all = Vec::new();
    for directions in Directions::ALL {
        all.push(Case::new(Lambertian { albedo: Textured::grey(1.0) }, 1.0, directions, true));
    }
    let cosine = Directions::Cosine;
    all.push(Case::new(Mirror { reflectance: Textured::grey(1.0) }, 0.0, cosine, true));
    for fresnel in fresnels() {
        let perfect = fresnel == fresnels()[0];
        all.push(Case::new(Conductor::new(fresnel.clone(), 0.0, true), 0.0, cosine, perfect));
        for alpha in ALPHAS {
            for compensated in [false, true] {
                let material = Conductor::new(fresnel.clone(), alpha, compensated);
                all.push(Case::new(material, alpha, cosine, perfect && compensated));
            }
        }
    }
    for alpha in [0.0].into_iter().chain(ALPHAS) {
        for (albedo, ior) in IORS.map(|ior| ([1.0; 3], ior)).into_iter().chain([([0.8, 0.3, 0.0], 1.5)]) {
            all.push(Case::new(Plastic::new(albedo, ior, alpha), alpha, cosine, albedo == [1.0; 3]));
        }
    }
    for anisotropy in [0.3, 0.8] {
        for alpha in [0.05, 0.3] {
            let material = Conductor { anisotropy, ..Conductor::new(fresnels()[1].clone(), alpha, true) };
            all.push(Case::new(material, alpha, cosine, false));
        }
    }
    all.extend(beckmann_metals());
    all.extend(rough_plastics());
    all.extend(principled());
    all.extend(disney());
    all
}

/// Disney's BSDF. Metals alone conserve energy; the most is reflected at grazing angles.
fn disney() -> impl Iterator<Item = Case> {
    let number = Textured::Constant;
    let base =
        |color: [f32; 3], roughness: f64| Disney { base_color: color.into(), roughness: number(roughness), ..Disney::default() };
    let paint = || base([0.8, 0.3, 0.1], 0.4);
    let metal = |roughness: f64| Disney { metallic: number(1.0), ..base([1.0, 0.5, 0.1], roughness) };
    let conserving = 1.0005;
    [
        (metal(0.0), conserving),
        (metal(0.5), conserving),
        (Disney { anisotropic: number(0.8), ..metal(0.5) }, conserving),
        (base([1.0; 3], 0.1), 1.6),
        (base([1.0; 3], 1.0), 1.6),
        (Disney { metallic: number(0.5), spec_tint: number(0.7), ..paint() }, 1.1),
        (Disney { sheen: number(1.0), sheen_tint: number(0.5), ..paint() }, 1.2),
        // Mitsuba 3.9 reflects 1.212 of the red light at a cosine of 0.1, too.
        (Disney { flatness: number(1.0), ..paint() }, 1.22),
        (Disney { clearcoat: number(1.0), clearcoat_gloss: number(0.5), ..paint() }, 1.1),
        (Disney { ior: 1.0, metallic: number(0.3), clearcoat: number(0.7), ..paint() }, conserving),
    ]
    .into_iter()
    .map(|(material, most)| {
        let Textured::Constant(roughness) = material.roughness else { unreachable!("no textures here") };
        Case { most, ..Case::new(material, (roughness * roughness).max(1e-3) as f32, Directions::Cosine, false) }
    })
}

fn beckmann_metals() -> impl Iterator<Item = Case> {
    [0.001, 0.05, 0.3, 1.0].into_iter().flat_map(|alpha| [0.0, 0.6].map(|anisotropy| (alpha, anisotropy))).map(
        |(alpha, anisotropy)| {
            let metal = Conductor::new(fresnels()[1].clone(), alpha, true);
            let metal = Conductor { distribution: Distribution::Beckmann, anisotropy, ..metal };
            Case::new(metal, alpha, Directions::Cosine, false)
        },
    )
}

fn rough_plastics() -> Vec<Case> {
    let mut all = Vec::new();
    for alpha in [0.0, 0.01, 0.1, 0.3, 1.0] {
        for distribution in [Distribution::Ggx, Distribution::Beckmann] {
            let white = RoughPlastic {
                albedo: Textured::grey(1.0),
                roughness: Roughness::alpha(alpha),
                distribution,
                ..RoughPlastic::default()
            };
            let paint = RoughPlastic {
                albedo: [0.8, 0.3, 0.0].into(),
                ior: 1.3,
                specular_reflectance: [1.0, 0.5, 0.0],
                internal_reflectance: 0.3,
                nonlinear: true,
                ..white.clone()
            };
            all.push(Case::new(white, alpha, Directions::Cosine, alpha == 0.0));
            all.push(Case::new(paint, alpha, Directions::Cosine, false));
        }
    }
    all
}

/// Principled materials; the first ones are a base under an interface alone.
fn principled() -> Vec<Case> {
    let number = Textured::Constant;
    let base = |color: [f32; 3], alpha: f32| Principled {
        base_color: color.into(),
        specular_roughness: number(f64::from(alpha).sqrt()),
        ..Principled::default()
    };
    let cosine = Directions::Cosine;
    let mut all = Vec::new();
    for alpha in [0.0, 0.01, 0.1, 0.3, 1.0] {
        all.push(Case::new(base([1.0; 3], alpha), alpha, cosine, true));
        all.push(Case::new(base([0.8, 0.3, 0.0], alpha), alpha, cosine, false));
    }
    let (paint, metal) = (base([0.8, 0.3, 0.1], 0.3), Principled { base_metalness: number(1.0), ..base([0.9, 0.5, 0.1], 0.2) });
    let coat = Principled { coat_weight: number(0.8), coat_color: [0.9, 0.6, 0.4].into(), ..paint.clone() };
    let layered = [
        Principled { base_diffuse_roughness: number(0.7), ..paint.clone() },
        Principled { specular_weight: number(0.5), specular_color: [1.0, 0.7, 0.2].into(), ..paint.clone() },
        Principled { base_metalness: number(0.5), ..paint.clone() },
        Principled { specular_color: [0.8, 0.7, 0.5].into(), ..metal.clone() },
        Principled { specular_roughness_anisotropy: number(0.6), ..metal.clone() },
        coat.clone(),
        Principled { coat_roughness: number(0.5), ..coat.clone() },
        Principled { fuzz_weight: number(0.9), fuzz_color: [0.3, 0.5, 0.9].into(), ..paint.clone() },
        Principled { thin_film_weight: number(1.0), ..metal },
        Principled { thin_film_weight: number(0.7), fuzz_weight: number(0.3), base_metalness: number(0.3), ..coat },
    ];
    all.extend(layered.into_iter().map(|material| {
        let Textured::Constant(roughness) = material.specular_roughness else { unreachable!("no textures here") };
        Case { reciprocal: false, ..Case::new(material, (roughness * roughness) as f32, cosine, false) }
    }));
    all
}

/// A BSDF of any type.
#[derive(Clone, Copy)]
#[allow(clippy::large_enum_variant, reason = "tests hold few of them")]
pub enum Any<'a> {
    Lambertian(LambertianBsdf<One>),
    Mirror(MirrorBsdf<One>),
    Conductor(ConductorBsdf<One, F<One>, Albedo<'a, One>>),
    Plastic(PlasticBsdf<'a, One>),
    Principled(PrincipledBsdf<'a, One, false>),
    AnisotropicConductor(ConductorBsdf<One, Widths<One>, AnisotropicLoss<'a, One>>),
    BeckmannConductor(ConductorBsdf<One, Beckmann<Widths<One>>, AnisotropicLoss<'a, One>>),
    RoughPlastic(RoughPlasticBsdf<'a, One>),
    Disney(DisneyBsdf<One, false>),
}

impl Bsdf<One> for Any<'_> {
    fn eval(&self, wo: V<One>, wi: V<One>) -> (V<One>, F<One>) {
        match self {
            Any::Lambertian(bsdf) => bsdf.eval(wo, wi),
            Any::Mirror(bsdf) => bsdf.eval(wo, wi),
            Any::Conductor(bsdf) => bsdf.eval(wo, wi),
            Any::Plastic(bsdf) => bsdf.eval(wo, wi),
            Any::Principled(bsdf) => bsdf.eval(wo, wi),
            Any::AnisotropicConductor(bsdf) => bsdf.eval(wo, wi),
            Any::BeckmannConductor(bsdf) => bsdf.eval(wo, wi),
            Any::RoughPlastic(bsdf) => bsdf.eval(wo, wi),
            Any::Disney(bsdf) => bsdf.eval(wo, wi),
        }
    }

    fn sample(&self, wo: V<One>, u: (F<One>, F<One>), lobe: F<One>) -> BsdfSample<One> {
        match self {
            Any::Lambertian(bsdf) => bsdf.sample(wo, u, lobe),
            Any::Mirror(bsdf) => bsdf.sample(wo, u, lobe),
            Any::Conductor(bsdf) => bsdf.sample(wo, u, lobe),
            Any::Plastic(bsdf) => bsdf.sample(wo, u, lobe),
            Any::Principled(bsdf) => bsdf.sample(wo, u, lobe),
            Any::AnisotropicConductor(bsdf) => bsdf.sample(wo, u, lobe),
            Any::BeckmannConductor(bsdf) => bsdf.sample(wo, u, lobe),
            Any::RoughPlastic(bsdf) => bsdf.sample(wo, u, lobe),
            Any::Disney(bsdf) => bsdf.sample(wo, u, lobe),
        }
    }
}

/// The colour that a texture may replace; white for types without.
fn colour(material: &Material) -> [f32; 3] {
    let source = match material {
        Material::Lambertian(Lambertian { albedo })
        | Material::Plastic(Plastic { albedo, .. })
        | Material::RoughPlastic(RoughPlastic { albedo, .. }) => albedo,
        Material::Mirror(Mirror { reflectance }) => reflectance,
        Material::Conductor(Conductor { fresnel: Reflectance::Constant(f0) | Reflectance::Schlick(f0), .. }) => f0,
        Material::Principled(Principled { base_color, .. }) | Material::Disney(Disney { base_color, .. }) => base_color,
        _ => return [1.0; 3],
    };
    let Textured::Constant(colour) = source else { unreachable!("no textures here") };
    colour.map(|x| x as f32)
}
