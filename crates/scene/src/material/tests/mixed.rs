//! Materials of one stage, four of each, whose lanes are told apart.
use super::{
    super::{
        Conductor, Dielectric, Distribution, Local, Material, Plastic, RoughPlastic, Roughness, disney::Disney,
        principled::Principled,
    },
    cases::{fresnels, gold},
};
use noisefall_base::{
    declare::Textured,
    math::{F, Lanes, U, V},
};

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

/// Metals with Beckmann facets, plastics of single scattering and tinted glass, four of each.
pub fn mixed_facets() -> [Vec<Material>; 3] {
    let beckmann = Distribution::Beckmann;
    let metal = |fresnel, anisotropy| Conductor { distribution: beckmann, anisotropy, ..Conductor::new(fresnel, 0.2, true) };
    let plastic =
        |distribution, alpha| RoughPlastic { distribution, roughness: Roughness::alpha(alpha), ..RoughPlastic::default() };
    let glass = |distribution, alpha| Dielectric {
        distribution,
        specular_reflectance: [0.9, 0.5, 0.2].into(),
        ..Dielectric::new(1.5, alpha, false)
    };
    let [first, second, _] = fresnels();
    [
        [metal(first.clone(), 0.0), metal(second, 0.5), metal(gold(), 0.0), metal(first, 0.8)].map(Material::from).into(),
        [
            plastic(beckmann, 0.2),
            plastic(Distribution::Ggx, 0.2),
            plastic(beckmann, 0.0),
            RoughPlastic { nonlinear: true, ..plastic(beckmann, 0.5) },
        ]
        .map(Material::from)
        .into(),
        [
            glass(beckmann, 0.2),
            glass(Distribution::Ggx, 0.2),
            glass(Distribution::Ggx, 0.0),
            Dielectric { anisotropy: 0.5, ..glass(beckmann, 0.3) },
        ]
        .map(Material::from)
        .into(),
    ]
}

/// Opaque and clear principled materials, four of each.
pub fn mixed_principled() -> [Vec<Material>; 2] {
    let number = Textured::Constant;
    let plain = Principled::default;
    let coat = || Principled { coat_weight: number(0.7), coat_color: [0.9, 0.5, 0.2].into(), ..plain() };
    let film = || Principled { thin_film_weight: number(0.8), specular_roughness_anisotropy: number(0.5), ..plain() };
    let fuzz = || Principled { fuzz_weight: number(0.6), base_diffuse_roughness: number(0.5), ..plain() };
    let opaque = [plain(), coat(), film(), fuzz()];
    let clear = |weight: f64, thin_walled: bool, material: Principled| Principled {
        transmission_weight: number(weight),
        transmission_color: [0.5, 0.9, 0.7].into(),
        thin_walled,
        ..material
    };
    let clear = [clear(1.0, false, plain()), clear(0.5, false, coat()), clear(0.8, true, film()), clear(0.6, true, fuzz())];
    [opaque.map(Material::from).into(), clear.map(Material::from).into()]
}

/// Opaque and clear materials of Disney's BSDF, four of each.
pub fn mixed_disney() -> [Vec<Material>; 2] {
    let number = Textured::Constant;
    let plain = Disney::default;
    let opaque = [
        plain(),
        Disney { metallic: number(0.7), anisotropic: number(0.6), spec_tint: number(0.5), ..plain() },
        Disney { clearcoat: number(1.0), clearcoat_gloss: number(0.5), ior: 0.8, ..plain() },
        Disney { sheen: number(0.6), sheen_tint: number(0.5), flatness: number(0.5), ..plain() },
    ];
    let clear = opaque.clone().map(|material| Disney { spec_trans: number(0.6), ..material });
    [opaque.map(Material::from).into(), clear.map(Material::from).into()]
}
