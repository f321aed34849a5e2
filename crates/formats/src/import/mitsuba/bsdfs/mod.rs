//! BSDFs: one file per family.
mod adapters;
pub mod coat;
mod coating;
mod glass;
mod highlights;
mod indices;
mod layer;
mod metal;
mod metals;
mod opaque;
mod principled;
mod roughness;
mod thin;
mod widths;

use super::{
    context::{Import, Surface},
    tree::Element,
};
use noisefall_scene::{
    material::{Lambertian, Material, null::Null},
    scene::{
        SceneError,
        description::{MaterialDescription, Textured},
    },
};

/// Translates a BSDF. The flag is whether a `twosided` is around it.
type Translate = fn(&mut Import, Element, bool) -> Result<MaterialDescription, SceneError>;

fn family(kind: &str) -> Option<Translate> {
    Some(match kind {
        "diffuse" => opaque::diffuse,
        "roughdiffuse" => opaque::rough_diffuse,
        "plastic" => opaque::plastic,
        "roughplastic" => opaque::rough_plastic,
        "pplastic" => opaque::polarized_plastic,
        "dielectric" => glass::dielectric,
        "thindielectric" => glass::thin_dielectric,
        "roughdielectric" => glass::rough_dielectric,
        "conductor" => metal::conductor,
        "roughconductor" => metal::rough_conductor,
        "principled" => principled::principled,
        "principledthin" => thin::principled_thin,
        "bumpmap" | "bump" => adapters::bump_map,
        "normalmap" => adapters::normal_map,
        "mask" => adapters::mask,
        "twosided" => adapters::two_sided,
        "blendbsdf" => adapters::blend,
        // Types of version 0.6.
        "mixturebsdf" => adapters::mixture,
        "phong" => highlights::phong,
        "ward" => highlights::ward,
        "coating" | "roughcoating" => coating::coating,
        "difftrans" => layer::diffuse_transmitter,
        "hk" => layer::scattering_layer,
        "null" => adapters::null,
        "measured" | "measured_polarized" | "neuralbsdf" | "acousticbsdf" => refused,
        _ => return None,
    })
}

impl Import {
    /// The material of a BSDF; both sides reflect if `two_sided`.
    pub fn surface(&mut self, element: Element, two_sided: bool) -> Result<Surface, SceneError> {
        let key = (element.index, two_sided);
        if let Some(known) = self.known_surfaces.get(&key) {
            let known = known.clone();
            self.uses.add(&known.uses);
            return Ok(known);
        }
        let (material, uses) = self.used(|import| import.material(element, two_sided))?;
        let name = self.materials.unique(element.label(), "material");
        self.description.materials.insert(name.clone(), material);
        let surface = Surface { material: name, uses };
        self.known_surfaces.insert(key, surface.clone());
        Ok(surface)
    }

    /// The material of shapes without a BSDF: grey, or the boundary of a medium alone.
    pub fn default_surface(&mut self, is_boundary: bool) -> String {
        let key = (usize::MAX, is_boundary);
        if let Some(known) = self.known_surfaces.get(&key) {
            return known.material.clone();
        }
        let name = self.materials.unique("default", "material");
        let grey = || one_or_two_sided(Lambertian { albedo: Textured::grey(0.5) }, false);
        self.description.materials.insert(name.clone(), if is_boundary { transparent(Null) } else { grey() });
        self.known_surfaces.insert(key, Surface { material: name.clone(), uses: super::context::Uses::default() });
        name
    }

    /// Adds a part of a BSDF as a material, and returns its name.
    fn part_of(&mut self, element: Element, part: &str, material: MaterialDescription) -> String {
        let name = self.materials.unique(&format!("{} {part}", element.label()), "material");
        self.description.materials.insert(name.clone(), material);
        name
    }

    /// The description of a BSDF.
    pub fn material(&mut self, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
        let translate = family(element.kind()).unwrap_or(unknown);
        self.nested(element, |import| translate(import, element, two_sided))
    }
}

fn unknown(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    import.remark(element, "grey diffuse", "the surface has another colour and no highlights");
    element.children().for_each(|child| {
        child.see();
    });
    Ok(one_or_two_sided(Lambertian { albedo: Textured::grey(0.5) }, two_sided))
}

fn refused(_: &mut Import, element: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    let message = format!("a `{}` BSDF, which Noisefall does not read", element.kind());
    Err(element.error(message, "replace it by a principled or a rough conductor"))
}

/// A material whose back is black unless a `twosided` is around it.
fn one_or_two_sided(kind: impl Into<Material>, two_sided: bool) -> MaterialDescription {
    MaterialDescription { kind: kind.into(), two_sided: (!two_sided).then_some(false), ..MaterialDescription::default() }
}

/// A material that has two sides by nature.
fn transparent(kind: impl Into<Material>) -> MaterialDescription {
    MaterialDescription { kind: kind.into(), ..MaterialDescription::default() }
}
