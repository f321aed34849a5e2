//! The table of cases.
use super::super::{Bsdf, BsdfSample, Conductor, Lambertian, Local, Material, Materials, Mirror, Plastic, Reflectance};
use crate::{
    material::BsdfKind,
    math::{F, Lanes, M, One, U, V},
    sampling::Directions,
};

pub const ALPHAS: [f32; 7] = [0.001, 0.01, 0.05, 0.1, 0.3, 0.6, 1.0];
pub const COSINES: [f32; 5] = [1.0, 0.7, 0.3, 0.1, 0.02];

/// Gold, roughly, in red, green and blue.
pub const GOLD: Reflectance = Reflectance::Index { eta: [0.143, 0.374, 1.442], k: [3.983, 2.386, 1.603] };
const FRESNELS: [Reflectance; 3] = [Reflectance::Constant([1.0; 3]), Reflectance::Schlick([0.9, 0.5, 0.04]), GOLD];
const IORS: [f32; 3] = [1.1, 1.5, 2.4];

pub struct Case {
    pub name: String,
    pub alpha: f32,
    pub material: Material,
    pub directions: Directions,
    /// Whether the albedo must be 1.
    pub lossless: bool,
    materials: Materials,
}

impl Case {
    fn new(material: Material, alpha: f32, directions: Directions, lossless: bool) -> Case {
        let name = format!("{material:?} {directions:?}");
        Case { name, alpha, material, directions, lossless, materials: Materials::new(&[material]) }
    }

    pub fn bsdf(&self) -> Any<'_> {
        let [x, y, z] = colour(&self.material).map(F);
        let at = Local { material: U(0), colour: V { x, y, z }, alpha: F(self.alpha), front: M(true) };
        match self.materials.kind(0) {
            BsdfKind::Lambertian => Any::Lambertian(Lambertian { albedo: at.colour, directions: self.directions }),
            BsdfKind::Mirror => Any::Mirror(Mirror::at(One, &self.materials, &at)),
            BsdfKind::Conductor => Any::Conductor(Conductor::at(One, &self.materials, &at)),
            BsdfKind::Plastic => Any::Plastic(Plastic::at(One, &self.materials, &at)),
            BsdfKind::Dielectric | BsdfKind::RoughDielectric => unreachable!("tested with the dielectrics"),
        }
    }
}

pub fn cases() -> Vec<Case> {
    let mut all = Vec::new();
    for directions in Directions::ALL {
        all.push(Case::new(Material::Lambertian { albedo: [1.0; 3] }, 1.0, directions, true));
    }
    let cosine = Directions::Cosine;
    all.push(Case::new(Material::Mirror { reflectance: [1.0; 3] }, 0.0, cosine, true));
    for fresnel in FRESNELS {
        let perfect = fresnel == FRESNELS[0];
        all.push(Case::new(Material::Conductor { fresnel, alpha: 0.0, compensated: true }, 0.0, cosine, perfect));
        for alpha in ALPHAS {
            for compensated in [false, true] {
                let material = Material::Conductor { fresnel, alpha, compensated };
                all.push(Case::new(material, alpha, cosine, perfect && compensated));
            }
        }
    }
    for alpha in [0.0].into_iter().chain(ALPHAS) {
        for (albedo, ior) in IORS.map(|ior| ([1.0; 3], ior)).into_iter().chain([([0.8, 0.3, 0.0], 1.5)]) {
            all.push(Case::new(Material::Plastic { albedo, ior, alpha }, alpha, cosine, albedo == [1.0; 3]));
        }
    }
    all
}

/// A BSDF of any type.
#[derive(Clone, Copy)]
pub enum Any<'a> {
    Lambertian(Lambertian<One>),
    Mirror(Mirror<One>),
    Conductor(Conductor<One>),
    Plastic(Plastic<'a, One>),
}

impl Bsdf<One> for Any<'_> {
    fn eval(&self, wo: V<One>, wi: V<One>) -> (V<One>, F<One>) {
        match self {
            Any::Lambertian(bsdf) => bsdf.eval(wo, wi),
            Any::Mirror(bsdf) => bsdf.eval(wo, wi),
            Any::Conductor(bsdf) => bsdf.eval(wo, wi),
            Any::Plastic(bsdf) => bsdf.eval(wo, wi),
        }
    }

    fn sample(&self, wo: V<One>, u: (F<One>, F<One>), lobe: F<One>) -> BsdfSample<One> {
        match self {
            Any::Lambertian(bsdf) => bsdf.sample(wo, u, lobe),
            Any::Mirror(bsdf) => bsdf.sample(wo, u, lobe),
            Any::Conductor(bsdf) => bsdf.sample(wo, u, lobe),
            Any::Plastic(bsdf) => bsdf.sample(wo, u, lobe),
        }
    }
}

/// [`Local`] parameters for the materials of [`mixed`], for any lanes.
pub fn local<L: Lanes>(material: U<L>, colour: V<L>, alpha: F<L>) -> Local<L> {
    let front = alpha.ge(alpha);
    Local { material, colour, alpha, front }
}

/// Conductors and plastics, four of each.
pub fn mixed() -> [Vec<Material>; 2] {
    let alpha = 0.2;
    let conductor = |fresnel, compensated| Material::Conductor { fresnel, alpha, compensated };
    let plastic = |ior, alpha| Material::Plastic { albedo: [0.8, 0.3, 0.0], ior, alpha };
    [
        vec![conductor(FRESNELS[0], true), conductor(FRESNELS[1], false), conductor(GOLD, true), conductor(FRESNELS[1], true)],
        vec![plastic(1.5, 0.0), plastic(1.5, 0.2), plastic(2.0, 0.2), plastic(1.3, 0.0)],
    ]
}

/// The colour that a texture may replace; white for types without.
fn colour(material: &Material) -> [f32; 3] {
    match *material {
        Material::Lambertian { albedo } | Material::Plastic { albedo, .. } => albedo,
        Material::Mirror { reflectance } => reflectance,
        Material::Conductor { fresnel: Reflectance::Constant(f0) | Reflectance::Schlick(f0), .. } => f0,
        Material::Conductor { .. } | Material::Dielectric { .. } => [1.0; 3],
    }
}
