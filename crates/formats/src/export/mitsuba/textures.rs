//! Colours and numbers, constant or textured.
use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::{
    super::textures::{BAKED, luminance},
    context::{Export, ReferencedObject},
    markup::{Element, FILE},
};
use noisefall_scene::{
    image::Encoding,
    scene::description::{TextureKind, Textured},
    texture::image::{Channel, Image, TexelFilter, Wrap},
};

impl Export<'_> {
    /// A colour with the name of a parameter.
    pub fn color(&mut self, name: &str, color: &Textured) -> Element {
        match color {
            Textured::Constant(color) => Element::color(name, *color),
            Textured::Texture(texture) => self.textured(name, texture),
        }
    }

    /// A number with the name of a parameter.
    pub fn number(&mut self, name: &str, number: &Textured<f64>) -> Element {
        match number {
            Textured::Constant(number) => Element::number(name, *number),
            Textured::Texture(texture) => match self.colors.kind(texture) {
                Some(TextureKind::Checker(checker)) if self.colors.is_flat(texture) => {
                    // Mitsuba exchanges the two squares where it looks up a number.
                    let even = self.number("color1", &checker.even.clone().map(luminance));
                    let odd = self.number("color0", &checker.odd.clone().map(luminance));
                    let id = self.id(texture, "texture");
                    self.checkerboard(checker.scale, even, odd).attribute("name", name).attribute("id", id)
                }
                _ => self.textured(name, texture),
            },
        }
    }

    /// A number that Mitsuba takes as a constant only; the mean of a texture stands for it.
    pub fn constant(&mut self, name: &str, number: &Textured<f64>) -> f64 {
        if let Textured::Texture(texture) = number {
            self.remark(format!("the texture `{texture}` of `{name}`"), "its mean", "the surface is the same everywhere");
        }
        self.colors.mean_number(number)
    }

    fn textured(&mut self, name: &str, texture: &str) -> Element {
        match self.texture(texture) {
            Some(id) => Element::reference(name, &id),
            None => {
                let mean = self.colors.mean(&Textured::Texture(texture.to_owned()));
                self.remark(
                    format!("the texture `{texture}`, which varies in space"),
                    "its mean colour",
                    "the surface has one colour",
                );
                Element::color(name, mean)
            }
        }
    }

    /// The id of a texture; `None` if it has no image.
    pub fn texture(&mut self, name: &str) -> Option<String> {
        if let Some(ReferencedObject { id, uses_coordinates }) = self.textures.get(name) {
            self.uses_coordinates |= *uses_coordinates;
            return Some(id.clone());
        }
        let kind = self.colors.kind(name)?;
        let (element, uses_coordinates) = self.at(format!("textures.{name}"), |export| match kind {
            TextureKind::Image(image) if image.channel == Channel::Rgb => Some(export.bitmap(image)),
            TextureKind::Checker(checker) if export.colors.is_flat(name) => {
                let (even, odd) = (export.color("color0", &checker.even), export.color("color1", &checker.odd));
                Some(export.checkerboard(checker.scale, even, odd))
            }
            TextureKind::VertexColor(vertices) if vertices.channel == Channel::Rgb => {
                Some(Element::plugin("texture", "mesh_attribute").text("name", "vertex_color"))
            }
            _ if export.colors.is_flat(name) => export.baked(name, &format!("a `{}`", kind.name()), |color| color),
            _ => None,
        });
        let id = self.id(name, "texture");
        self.scene.push(element?.attribute("id", id.clone()));
        self.textures.insert(name.to_owned(), ReferencedObject { id: id.clone(), uses_coordinates });
        Some(id)
    }

    /// An image of a texture over the unit square, after a function of its colors.
    pub fn baked(&mut self, name: &str, found: &str, f: impl Fn([f64; 3]) -> [f64; 3]) -> Option<Element> {
        let bytes = self.colors.exr(name, f)?;
        let path = self.new.add("textures", name, "exr", bytes);
        let [used, effect] = BAKED;
        self.remark(found, used, effect);
        self.uses_coordinates = true;
        Some(Element::plugin("texture", "bitmap").text(FILE, &path).flag("raw", true))
    }

    /// A texture that is the square of another one: a roughness becomes a width of facets.
    pub fn squared(&mut self, name: &str, texture: &str) -> Element {
        let square = |color: [f64; 3]| [luminance(color).powi(2); 3];
        let baked = if self.colors.is_flat(texture) {
            self.baked(texture, &format!("the square of the texture `{texture}`"), square)
        } else {
            None
        };
        match baked {
            Some(element) => element.attribute("name", name),
            None => {
                let mean = self.constant(name, &Textured::Texture(texture.to_owned()));
                Element::number(name, mean * mean)
            }
        }
    }

    pub fn bitmap(&mut self, image: &Image) -> Element {
        self.uses_coordinates = true;
        let path = self.new.name(&image.path);
        let wrap = match image.wrap_u {
            Wrap::Repeat => "repeat",
            Wrap::Mirror => "mirror",
            Wrap::Clamp => "clamp",
            Wrap::Black => {
                self.remark("`wrap_u = \"black\"`", "`clamp`", "the edge of the image continues");
                "clamp"
            }
        };
        if image.wrap_v != image.wrap_u {
            self.remark("`wrap_v`", "the mode of `wrap_u`", "the image continues in another way outside of the unit square");
        }
        let element = Element::plugin("texture", "bitmap").text(FILE, &path).flag("raw", image.encoding == Encoding::Linear);
        let element = if wrap == "repeat" { element } else { element.text("wrap_mode", wrap) };
        let element = if image.filter == TexelFilter::Nearest { element.text("filter_type", "nearest") } else { element };
        element.transform("to_uv", &placement(image))
    }

    /// Mitsuba's squares are halves of the unit square.
    fn checkerboard(&mut self, scale: f64, even: Element, odd: Element) -> Element {
        self.uses_coordinates = true;
        let scale = DAffine3::from_scale(DVec3::new(0.5 * scale, 0.5 * scale, 1.0));
        Element::plugin("texture", "checkerboard").with(even).with(odd).transform("to_uv", &scale)
    }
}

/// Scale, shear, rotation and offset of an image as a map of the plane.
fn placement(image: &Image) -> DAffine3 {
    let scale = DAffine3::from_scale(DVec2::from(image.scale).extend(1.0));
    // A rotation by 0 must not round.
    let turn = if image.rotate == 0.0 { DAffine3::IDENTITY } else { DAffine3::from_rotation_z(image.rotate.to_radians()) };
    let shear = DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::new(image.shear, 1.0, 0.0), DVec3::Z));
    DAffine3::from_translation(DVec2::from(image.offset).extend(0.0)) * turn * shear * scale
}
