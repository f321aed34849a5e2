//! The table of cases.
use super::super::{
    Bsdf, BsdfSample, Conductor, Lambertian, LambertianBsdf, Local, Material, Materials, Mirror, Plastic, Reflectance, Shade,
    Stage, conductor::ConductorBsdf, mirror::MirrorBsdf, plastic::PlasticBsdf,
};
use crate::{
    declare::Textured,
    math::{F, Lanes, M, One, U, V},
    sampling::Directions,
};

pub const ALPHAS: [f32; 7] = [0.001, 0.01, 0.05, 0.1, 0.3, 0.6, 1.0];
pub const COSINES: [f32; 5] = [1.0, 0.7, 0.3, 0.1, 0.02];

/// Gold, roughly, in red, green and blue.
pub fn gold() -> Reflectance {
    Reflectance::index([0.143, 0.374, 1.442], [3.983, 2.386, 1.603])
}

fn fresnels() -> [Reflectance; 3] {
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
    materials: Materials,
}

impl Case {
    fn new(material: impl Into<Material>, alpha: f32, directions: Directions, lossless: bool) -> Case {
        let material = material.into();
        let name = format!("{material:?} {directions:?}");
        let materials = Materials::new(std::slice::from_ref(&material));
        Case { name, alpha, material, directions, lossless, materials }
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
    all
}

/// A BSDF of any type.
#[derive(Clone, Copy)]
pub enum Any<'a> {
    Lambertian(LambertianBsdf<One>),
    Mirror(MirrorBsdf<One>),
    Conductor(ConductorBsdf<One>),
    Plastic(PlasticBsdf<'a, One>),
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
    let [first, second, _] = fresnels();
    let conductor = |fresnel, compensated| Material::from(Conductor::new(fresnel, alpha, compensated));
    let plastic = |ior, alpha| Material::from(Plastic::new([0.8, 0.3, 0.0], ior, alpha));
    [
        vec![conductor(first.clone(), true), conductor(second.clone(), false), conductor(gold(), true), conductor(second, true)],
        vec![plastic(1.5, 0.0), plastic(1.5, 0.2), plastic(2.0, 0.2), plastic(1.3, 0.0)],
    ]
}

/// The colour that a texture may replace; white for types without.
fn colour(material: &Material) -> [f32; 3] {
    let source = match material {
        Material::Lambertian(Lambertian { albedo }) | Material::Plastic(Plastic { albedo, .. }) => albedo,
        Material::Mirror(Mirror { reflectance }) => reflectance,
        Material::Conductor(Conductor { fresnel: Reflectance::Constant(f0) | Reflectance::Schlick(f0), .. }) => f0,
        _ => return [1.0; 3],
    };
    let Textured::Constant(colour) = source else { unreachable!("no textures here") };
    colour.map(|x| x as f32)
}
