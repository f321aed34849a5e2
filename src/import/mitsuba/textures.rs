//! Textures: images, checkers and attributes of meshes. The coordinates of Mitsuba's images run downwards, as ours do.
use glam::{DMat4, DVec2};

use super::{
    colours::Role,
    context::{Import, TextureValue},
    tree::Element,
};
use crate::{
    image::Encoding,
    import::pictures,
    scene::{
        SceneError,
        description::{TextureKind, Textured},
    },
    texture::{
        checker::Checker,
        image::{Image, TexelFilter, Wrap},
        mix::Mix,
        product::Product,
        vertex_color::VertexColor,
    },
};

impl Import {
    /// The colour with a name, constant or textured.
    pub fn colour(&mut self, element: Element, name: &str, default: f64, role: Role) -> Result<Textured, SceneError> {
        match element.property(name)? {
            Some(value) => self.colour_of(value, role),
            None => Ok(Textured::grey(default)),
        }
    }

    fn colour_of(&mut self, value: Element, role: Role) -> Result<Textured, SceneError> {
        match self.constant(value, role)? {
            Some(colour) => Ok(Textured::Constant(self.in_range(value, colour, role))),
            None => self.texture(value, TextureValue::Colour).map(Textured::Texture),
        }
    }

    /// The number with a name, constant or textured.
    pub fn textured_number(&mut self, element: Element, name: &str, default: f64) -> Result<Textured<f64>, SceneError> {
        let Some(value) = element.property(name)? else { return Ok(Textured::Constant(default)) };
        match self.constant(value, Role::Index)? {
            Some([r, g, b]) if r == g && g == b => Ok(Textured::Constant(r)),
            // Mitsuba takes the mean of a colour, and the luminance of an image.
            Some([r, g, b]) => Ok(Textured::Constant((r + g + b) / 3.0)),
            None => self.texture(value, TextureValue::Number).map(Textured::Texture),
        }
    }

    /// The same from 0 to 1.
    pub fn fraction(&mut self, element: Element, name: &str, default: f64) -> Result<Textured<f64>, SceneError> {
        let number = self.textured_number(element, name, default)?;
        Ok(match number {
            Textured::Constant(x) if !(0.0..=1.0).contains(&x) => {
                self.remark_value(element, name, "the nearest number from 0 to 1", "the material is less extreme")?;
                Textured::Constant(x.clamp(0.0, 1.0))
            }
            number => number,
        })
    }

    fn in_range(&mut self, value: Element, colour: [f64; 3], role: Role) -> [f64; 3] {
        let (least, most) = if role == Role::Reflectance { (0.0, 1.0) } else { (0.0, 1e15) };
        let clamped = colour.map(|x| x.clamp(least, most));
        if clamped != colour {
            self.remark(value, "the nearest colour in range", "it is less bright, or not negative");
        }
        clamped
    }

    /// The name of a texture.
    pub fn texture(&mut self, element: Element, value: TextureValue) -> Result<String, SceneError> {
        if let Some((name, uses)) = self.known_textures.get(&(element.index, value)) {
            let (name, uses) = (name.clone(), uses.clone());
            self.uses.add(&uses);
            return Ok(name);
        }
        let (kind, uses) = self.used(|import| import.nested(element, |import| import.texture_kind(element, value)))?;
        let name = self.add_texture(element.label(), kind);
        self.known_textures.insert((element.index, value), (name.clone(), uses));
        Ok(name)
    }

    /// Adds a texture, and returns its name.
    pub fn add_texture(&mut self, wanted: &str, kind: impl Into<TextureKind>) -> String {
        let name = self.textures.unique(wanted, "texture");
        self.description.textures.insert(name.clone(), kind.into());
        name
    }

    /// A texture times a number.
    pub fn scaled(&mut self, number: Textured<f64>, factor: f64) -> Textured<f64> {
        match number {
            Textured::Constant(x) => Textured::Constant(x * factor),
            Textured::Texture(name) => {
                let wanted = format!("{name} × {factor}");
                let product = Product { a: Textured::Texture(name), b: Textured::grey(factor) };
                Textured::Texture(self.add_texture(&wanted, product))
            }
        }
    }

    fn texture_kind(&mut self, element: Element, value: TextureValue) -> Result<TextureKind, SceneError> {
        match element.kind() {
            "bitmap" => self.bitmap(element).map(Into::into),
            "checkerboard" => self.checkerboard(element, value),
            "mesh_attribute" => self.mesh_attribute(element),
            "volume" => Err(element.error("a `volume` texture, which Noisefall does not read", "use an image texture")),
            kind => Err(element.error(
                format!("`{kind}` is not a texture that Noisefall knows"),
                "it knows bitmap, checkerboard, mesh_attribute and the spectra",
            )),
        }
    }

    /// An image file.
    pub fn bitmap(&mut self, element: Element) -> Result<Image, SceneError> {
        element.ignore(&["format", "accel", "filter_min", "mipmap", "max_anisotropy", "cache", "gamma"]);
        self.uses.coordinates = true;
        let path = self.file(element, "filename")?;
        let raw = element.flag("raw", false)? || element.optional_number("gamma")? == Some(1.0);
        let wrap = match element.text("wrap_mode")?.unwrap_or("repeat") {
            "repeat" => Wrap::Repeat,
            "mirror" => Wrap::Mirror,
            "clamp" => Wrap::Clamp,
            other => return Err(element.error(format!("`{other}` is not a wrap mode"), "repeat, mirror or clamp")),
        };
        let filter = match element.text("filter_type")?.unwrap_or("bilinear") {
            "nearest" => TexelFilter::Nearest,
            _ => TexelFilter::Bilinear,
        };
        let placed = self.placement(element)?;
        let described = self.files.folder.described(&path);
        self.images.insert(described.clone(), path);
        Ok(Image {
            path: described,
            encoding: if raw { Encoding::Linear } else { Encoding::Srgb },
            wrap_u: wrap,
            wrap_v: wrap,
            filter,
            ..placed
        })
    }

    /// The placement by `to_uv`.
    fn placement(&mut self, element: Element) -> Result<Image, SceneError> {
        let map = element.transform("to_uv")?;
        let number = |name: &str, default: f64| element.number(name, default);
        let old = DMat4::from_scale(DVec2::new(number("uscale", 1.0)?, number("vscale", 1.0)?).extend(1.0))
            * DMat4::from_translation(DVec2::new(number("uoffset", 0.0)?, number("voffset", 0.0)?).extend(0.0));
        decomposed(map * old).ok_or_else(|| element.error("`to_uv` flattens the texture", "check its numbers"))
    }

    /// Squares of two colours. Where Mitsuba looks up a number, it exchanges the two (`Checkerboard::eval_1` in version 3.9).
    fn checkerboard(&mut self, element: Element, value: TextureValue) -> Result<TextureKind, SceneError> {
        self.uses.coordinates = true;
        let (even, odd) = match value {
            TextureValue::Colour => {
                (self.colour(element, "color0", 0.4, Role::Reflectance)?, self.colour(element, "color1", 0.2, Role::Reflectance)?)
            }
            TextureValue::Number => {
                let mut grey = |name, default| self.textured_number(element, name, default).map(|number| number.map(|x| [x; 3]));
                (grey("color1", 0.2)?, grey("color0", 0.4)?)
            }
        };
        let placed = self.placement(element)?;
        let [u, v] = placed.scale;
        let is_plain =
            placed.rotate == 0.0 && placed.shear == 0.0 && placed.offset == [0.0; 2] && u == v && (1e-6..=5e4).contains(&u);
        if is_plain {
            return Ok(Checker { even, odd, scale: 2.0 * u }.into());
        }
        // Elsewhere the squares are the texels of an image.
        let pixels = [[0; 3], [255; 3], [255; 3], [0; 3]];
        let bytes = pictures::png(2, 2, &pixels).ok_or_else(|| element.error("the checkerboard cannot be made", ""))?;
        let path = self.new_files.add_image("checkerboard", "png", bytes);
        let squares = Image { path, encoding: Encoding::Linear, filter: TexelFilter::Nearest, ..placed };
        let weight = self.add_texture(&format!("{} squares", element.label()), squares);
        Ok(Mix { a: even, b: odd, weight: Textured::Texture(weight) }.into())
    }

    fn mesh_attribute(&mut self, element: Element) -> Result<TextureKind, SceneError> {
        let name = element.required_text("name")?;
        self.uses.attributes.insert(name.to_owned());
        let colour = TextureKind::from(VertexColor::default());
        let scale = element.number("scale", 1.0)?;
        if scale == 1.0 {
            return Ok(colour);
        }
        let unscaled = self.add_texture(&format!("{name} unscaled"), colour);
        Ok(Product { a: Textured::Texture(unscaled), b: Textured::grey(scale) }.into())
    }
}

/// Whether an image lies elsewhere than over the unit square.
pub fn is_placed(image: &Image) -> bool {
    image.scale != [1.0; 2] || image.shear != 0.0 || image.rotate != 0.0 || image.offset != [0.0; 2]
}

/// Scale, shear, rotation and offset of a map of the plane; `None` if it flattens the plane.
fn decomposed(map: DMat4) -> Option<Image> {
    let column = |i: usize| map.col(i).truncate().truncate();
    let (u, v, offset) = (column(0), column(1), column(3));
    let rotate = u.y.atan2(u.x);
    let (along, across) = (DVec2::from_angle(rotate), DVec2::from_angle(rotate).perp());
    let scale = [u.length(), v.dot(across)];
    if scale[0] == 0.0 || scale[1].abs() <= 1e-12 * v.length() {
        return None;
    }
    let degrees = if u.y == 0.0 && u.x > 0.0 { 0.0 } else { rotate.to_degrees() };
    // Rotations and scales of the file round.
    let shear = v.dot(along) / scale[1];
    let shear = if shear.abs() <= 1e-9 { 0.0 } else { shear };
    Some(Image { scale, shear, rotate: degrees, offset: offset.to_array(), ..Image::default() })
}
