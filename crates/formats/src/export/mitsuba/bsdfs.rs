//! Materials: sides, opacity, normals, and the kinds without highlights.
use super::{
    context::{Export, ReferencedObject},
    markup::Element,
};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    image::Encoding,
    material::{Material, blend::Blend, diffuse_transmission::DiffuseTransmission},
    scene::description::{MaterialDescription, TextureKind},
    texture::image::{Channel, Image},
};

/// Blends within blends.
const DEEPEST: usize = 16;

/// A BSDF of one kind, before sides, normals and opacity.
pub struct Base {
    pub element: Element,
    /// Whether it has two sides by nature.
    pub transmits: bool,
}

impl Base {
    pub fn opaque(element: Element) -> Base {
        Base { element, transmits: false }
    }

    pub fn transparent(element: Element) -> Base {
        Base { element, transmits: true }
    }
}

impl Export<'_> {
    /// The material of an object; black without one.
    pub fn surface(&mut self, name: Option<&str>) -> Element {
        let known = name.and_then(|name| self.material(name, false, DEEPEST));
        match known {
            Some(id) => Element::reference("", &id),
            None => Element::plugin("bsdf", "diffuse").with(Element::color("reflectance", [0.0; 3])),
        }
    }

    /// The id of a material, which is black from behind if the blend around it is.
    fn material(&mut self, name: &str, one_sided: bool, depth: usize) -> Option<String> {
        let key = if one_sided { format!("{name}\n") } else { name.to_owned() };
        if let Some(ReferencedObject { id, uses_coordinates }) = self.materials.get(&key) {
            self.uses_coordinates |= *uses_coordinates;
            return Some(id.clone());
        }
        let description = self.description.materials.get(name).filter(|_| depth > 0)?;
        let id = self.id(name, "material");
        let (element, uses_coordinates) =
            self.at(format!("materials.{name}"), |export| export.bsdf(description, one_sided, depth));
        self.scene.push(element.attribute("id", id.clone()));
        self.materials.insert(key, ReferencedObject { id: id.clone(), uses_coordinates });
        Some(id)
    }

    fn bsdf(&mut self, material: &MaterialDescription, one_sided: bool, depth: usize) -> Element {
        let one_sided = one_sided || material.two_sided == Some(false);
        let Base { element, transmits } = self.base(&material.kind, one_sided, depth);
        let is_blend = matches!(material.kind, Material::Blend(_));
        if one_sided && transmits && !is_blend {
            self.remark("`two_sided = false` of a transparent material", "both sides", "the back transmits light too");
        }
        let sided = |element| if one_sided || transmits { element } else { Element::plugin("bsdf", "twosided").with(element) };
        // Within a `twosided`, relief rises from both sides.
        let bumped = match material.two_sided_relief {
            Some(true) => sided(self.bumped(material, element)),
            _ => self.bumped(material, sided(element)),
        };
        match &material.opacity {
            None | Some(Textured::Constant(1.0)) => bumped,
            Some(opacity) => {
                let opacity = self.number("opacity", opacity);
                Element::plugin("bsdf", "mask").with(opacity).with(bumped)
            }
        }
    }

    fn base(&mut self, kind: &Material, one_sided: bool, depth: usize) -> Base {
        match kind {
            Material::Lambertian(diffuse) => {
                let albedo = self.color("reflectance", &diffuse.albedo);
                Base::opaque(Element::plugin("bsdf", "diffuse").with(albedo))
            }
            Material::Mirror(mirror) => Base::opaque(self.mirror(&mirror.reflectance)),
            Material::Conductor(metal) => Base::opaque(self.metal(metal)),
            Material::Dielectric(glass) => Base::transparent(self.glass(glass)),
            Material::ThinDielectric(pane) => Base::transparent(self.pane(pane)),
            Material::Plastic(plastic) => Base::opaque(self.plastic(plastic)),
            Material::RoughPlastic(plastic) => Base::opaque(self.rough_plastic(plastic)),
            Material::DiffuseTransmission(sheet) => Base::transparent(self.sheet(sheet)),
            Material::Principled(principled) => self.principled(principled),
            Material::Disney(disney) => self.disney(disney),
            Material::Blend(blend) => Base::transparent(self.blend(blend, one_sided, depth)),
            Material::Null(_) => Base::transparent(Element::plugin("bsdf", "null")),
            #[allow(unreachable_patterns, reason = "a kind that is added later")]
            other => {
                let color = self.colors.diffuse_substitute(other, &mut self.notes);
                Base::opaque(Element::plugin("bsdf", "diffuse").with(Element::color("reflectance", color)))
            }
        }
    }

    fn blend(&mut self, blend: &Blend, one_sided: bool, depth: usize) -> Element {
        // The parts of a blend by side are within one `twosided`.
        let one_sided = one_sided || blend.by_side;
        let parts = [&blend.first, &blend.second].map(|name| match self.material(name, one_sided, depth - 1) {
            Some(id) => Element::reference("", &id),
            None => self.surface(None),
        });
        if blend.by_side {
            return Element::plugin("bsdf", "twosided").with_all(parts);
        }
        let weight = self.number("weight", &blend.weight);
        Element::plugin("bsdf", "blendbsdf").with(weight).with_all(parts)
    }

    /// Mitsuba's thin sheet has one colour for both sides.
    fn sheet(&mut self, sheet: &DiffuseTransmission) -> Element {
        let [reflected, passed] = [&sheet.reflectance, &sheet.transmittance].map(|color| self.colors.mean(color));
        let color = [0, 1, 2].map(|i| (reflected[i] + passed[i]).min(1.0));
        let [all, through] = [color, passed].map(|color| color.iter().sum::<f64>());
        let share = if all > 0.0 { (through / all).min(1.0) } else { 0.0 };
        self.remark(
            "`diffuse_transmission`",
            "a thin principled sheet of its mean colour",
            "both sides have the same hue, and grazing light is brighter",
        );
        Element::plugin("bsdf", "principledthin")
            .with(Element::color("base_color", color))
            .float("diff_trans", 2.0 * share)
            .float("eta", 1.001)
            .float("roughness", 1.0)
    }

    /// A BSDF with its bump and normal map. The normal map is the inner one, as in ours.
    fn bumped(&mut self, material: &MaterialDescription, mut element: Element) -> Element {
        // Mitsuba shadows by default.
        let shadowing = material.normal_shadowing == Some(true);
        let shadowed = |element: Element| if shadowing { element } else { element.flag("use_shadowing_function", false) };
        if let Some(path) = &material.normal_map {
            let image = Image { path: path.clone(), encoding: Encoding::Linear, ..Image::default() };
            let bitmap = self.bitmap(&image).attribute("name", "normalmap");
            element = shadowed(Element::plugin("bsdf", "normalmap").with(bitmap)).with(element);
        }
        let Some(bump) = &material.bump else { return element };
        match self.heights(&bump.texture) {
            Some(heights) => shadowed(Element::plugin("bsdf", "bumpmap").with(heights).float("scale", bump.height)).with(element),
            None => {
                let found = format!("the heights `{}`, which vary in space", bump.texture);
                self.remark(found, "no bump map", "the surface is smooth");
                element
            }
        }
    }

    /// The texture of a bump map. Mitsuba knows the slopes of images alone.
    fn heights(&mut self, name: &str) -> Option<Element> {
        match self.colors.kind(name)? {
            TextureKind::Image(image) if image.channel == Channel::Rgb => {
                self.texture(name).map(|id| Element::reference("arbitrary", &id))
            }
            kind if self.colors.is_flat(name) => {
                let found = format!("a `{}` of heights", kind.name());
                self.baked(name, &found, |color| color).map(|image| image.attribute("name", "arbitrary"))
            }
            _ => None,
        }
    }
}
