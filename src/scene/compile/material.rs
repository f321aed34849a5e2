//! Materials of a scene file.
use toml::Spanned;

use crate::{
    image::Encoding,
    material::{Material, Reflectance},
    math::colour::luminance,
    quote,
    scene::{
        check::{Checker, ColourRange},
        colour::Colour,
        desc::{BumpDesc, ConductorDesc, DielectricDesc, MaterialDesc, PlasticDesc},
        diagnostic::SceneError,
        textures::{ColourSource, NamedTextures},
    },
};

/// The width α of the distribution of microfacet slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Roughness {
    Constant(f32),
    /// α, or where `squared` its root, is the texture's luminance.
    Texture {
        id: u32,
        squared: bool,
    },
}

/// A material and what varies about it over the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Coating {
    pub name: String,
    pub material: Material,
    /// Albedo or reflectance.
    pub colour: ColourSource,
    pub roughness: Roughness,
    /// Texture of heights and its scale, metres.
    pub bump: Option<(u32, f32)>,
    /// Texture of normals.
    pub normal_map: Option<u32>,
    /// Black from behind.
    pub one_sided: bool,
    /// What a metre of the interior lets pass; white where there is none.
    pub transmittance: [f32; 3],
}

const WHITE: ColourSource = ColourSource::Constant([1.0; 3]);
const LEAST_IOR: f64 = 0.05;
const MOST_IOR: f64 = 20.0;

pub fn coating(
    check: &Checker,
    name: &str,
    desc: &Spanned<MaterialDesc>,
    textures: &mut NamedTextures,
) -> Result<Coating, SceneError> {
    let m = desc.as_ref();
    let kinds = [m.lambertian.is_some(), m.mirror.is_some(), m.dielectric.is_some(), m.conductor.is_some(), m.plastic.is_some()];
    let expected = "expected one of `lambertian`, `mirror`, `dielectric`, `conductor` and `plastic`";
    match kinds.into_iter().filter(|given| *given).count() {
        0 => return Err(check.0.error(desc.span(), format!("material `{name}` says no kind"), expected)),
        1 => {}
        _ => return Err(check.0.error(desc.span(), format!("material `{name}` says more than one kind"), expected)),
    }
    let mut coating = Coating {
        name: quote::piece(name),
        material: Material::Mirror { reflectance: [0.0; 3] },
        colour: WHITE,
        roughness: Roughness::Constant(0.0),
        bump: m.bump.as_ref().map(|bump| self::bump(check, bump, textures)).transpose()?,
        normal_map: m.normal_map.as_ref().map(|path| textures.picture(check, path, Encoding::Linear)).transpose()?,
        one_sided: m.two_sided.as_ref().is_some_and(|two_sided| !*two_sided.as_ref()),
        transmittance: [1.0; 3],
    };
    if let Some(lambertian) = &m.lambertian {
        coating.colour = textures.colour_or_texture(check, &ColourRange::ALBEDO, &lambertian.albedo)?;
        coating.material = Material::Lambertian { albedo: textures.typical(coating.colour) };
    } else if let Some(mirror) = &m.mirror {
        coating.colour = textures.colour_or_texture(check, &ColourRange::REFLECTANCE, &mirror.reflectance)?;
        coating.material = Material::Mirror { reflectance: textures.typical(coating.colour) };
    } else if let Some(dielectric) = &m.dielectric {
        self::dielectric(check, dielectric, textures, &mut coating)?;
        if let Some(two_sided) = m.two_sided.as_ref().filter(|two_sided| !*two_sided.as_ref()) {
            return Err(check.0.error(two_sided.span(), "a dielectric has two sides", "remove this"));
        }
    } else if let Some(conductor) = &m.conductor {
        self::conductor(check, conductor, textures, &mut coating)?;
    } else if let Some(plastic) = &m.plastic {
        self::plastic(check, plastic, textures, &mut coating)?;
    }
    Ok(coating)
}

fn dielectric(check: &Checker, d: &DielectricDesc, textures: &NamedTextures, coating: &mut Coating) -> Result<(), SceneError> {
    coating.roughness = roughness(check, d.roughness.as_ref(), d.alpha.as_ref(), textures)?;
    if let Some(transmittance) = &d.transmittance {
        coating.transmittance = check.colour(&ColourRange::TRANSMITTANCE, transmittance)?;
    }
    coating.material = Material::Dielectric {
        ior: check.within("ior", &d.ior, LEAST_IOR, MOST_IOR)?,
        ior_outside: d.ior_outside.as_ref().map_or(Ok(1.0), |ior| check.within("ior_outside", ior, LEAST_IOR, MOST_IOR))?,
        alpha: coating.roughness.largest(textures),
        varies: matches!(coating.roughness, Roughness::Texture { .. }),
        compensated: d.energy_compensation.unwrap_or(true),
    };
    Ok(())
}

fn conductor(
    check: &Checker,
    desc: &Spanned<ConductorDesc>,
    textures: &NamedTextures,
    coating: &mut Coating,
) -> Result<(), SceneError> {
    let c = desc.as_ref();
    coating.roughness = roughness(check, c.roughness.as_ref(), c.alpha.as_ref(), textures)?;
    let fresnel = match (&c.eta, &c.k, &c.f0, &c.reflectance) {
        (Some(eta), Some(k), None, None) => {
            let (eta_value, k_value) = (check.colour(&ColourRange::INDEX, eta)?, check.colour(&ColourRange::INDEX, k)?);
            if eta_value.iter().zip(k_value).any(|(eta, k)| *eta == 0.0 && k == 0.0) {
                return Err(check.0.error(eta.span(), "`eta` and `k` are both 0", "no metal has such an index"));
            }
            Reflectance::Index { eta: eta_value, k: k_value }
        }
        (None, None, Some(f0), None) => {
            coating.colour = textures.colour_or_texture(check, &ColourRange::F0, f0)?;
            Reflectance::Schlick(textures.typical(coating.colour))
        }
        (None, None, None, Some(reflectance)) => {
            coating.colour = textures.colour_or_texture(check, &ColourRange::REFLECTANCE, reflectance)?;
            Reflectance::Constant(textures.typical(coating.colour))
        }
        _ => {
            let message = "a conductor must say `eta` and `k`, or `f0`, or `reflectance`";
            return Err(check.0.error(desc.span(), message, "exactly one of these"));
        }
    };
    let compensated = c.energy_compensation.unwrap_or(true);
    coating.material = Material::Conductor { fresnel, alpha: coating.roughness.largest(textures), compensated };
    Ok(())
}

fn plastic(check: &Checker, p: &PlasticDesc, textures: &NamedTextures, coating: &mut Coating) -> Result<(), SceneError> {
    coating.roughness = roughness(check, p.roughness.as_ref(), p.alpha.as_ref(), textures)?;
    coating.colour = textures.colour_or_texture(check, &ColourRange::ALBEDO, &p.albedo)?;
    coating.material = Material::Plastic {
        albedo: textures.typical(coating.colour),
        ior: check.within("ior", &p.ior, 1.0, MOST_IOR)?,
        alpha: coating.roughness.largest(textures),
    };
    Ok(())
}

/// α, given directly or as its root, the roughness. Smooth when neither is given.
fn roughness(
    check: &Checker,
    roughness: Option<&Spanned<Colour>>,
    alpha: Option<&Spanned<Colour>>,
    textures: &NamedTextures,
) -> Result<Roughness, SceneError> {
    let (value, range, squared) = match (roughness, alpha) {
        (None, None) => return Ok(Roughness::Constant(0.0)),
        (Some(roughness), None) => (roughness, &ColourRange::ROUGHNESS, true),
        (None, Some(alpha)) => (alpha, &ColourRange::ALPHA, false),
        (Some(_), Some(alpha)) => {
            let message = "both `roughness` and `alpha` are given";
            return Err(check.0.error(alpha.span(), message, "α is the square of the roughness: one is enough"));
        }
    };
    match textures.colour_or_texture(check, range, value)? {
        ColourSource::Constant([r, g, b]) if r != g || g != b => {
            Err(check.0.error(value.span(), format!("`{}` is a colour", range.what), "expected one number"))
        }
        ColourSource::Constant([r, ..]) => Ok(Roughness::Constant(if squared { r * r } else { r })),
        ColourSource::Texture(id) => Ok(Roughness::Texture { id, squared }),
    }
}

impl Roughness {
    /// The largest α, which decides whether the surface is rough at all.
    fn largest(self, textures: &NamedTextures) -> f32 {
        match self {
            Roughness::Constant(alpha) => alpha,
            Roughness::Texture { id, squared } => {
                let most = luminance(textures.textures.maximum(id));
                if squared { most * most } else { most }
            }
        }
    }
}

fn bump(check: &Checker, desc: &BumpDesc, textures: &NamedTextures) -> Result<(u32, f32), SceneError> {
    Ok((textures.id(check, &desc.texture)?, check.within("height", &desc.height, -1e6, 1e6)?))
}
