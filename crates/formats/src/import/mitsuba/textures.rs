//! Textures: images, checkers and attributes of meshes.
use super::{
    colours::Role,
    context::{Import, TextureValue},
    tree::Element,
};
use crate::import::pictures;
use noisefall_scene::{
    image::Encoding,
    scene::{
        SceneError,
        description::{TextureKind, Textured},
    },
    texture::{
        checker::Checker,
        image::{Image, TexelFilter},
        mix::Mix,
        product::Product,
        vertex_color::VertexColor,
    },
};

impl Import {
    /// The colour with a name, constant or textured.
    pub fn colour(&mut self, element: Element, name: &str, default: f64, role: Role) -> Result<Textured, SceneError> {
        match element.property(name)? {
            Some(value) => Ok(self.part(|import| import.colour_of(value, role))?.unwrap_or(Textured::grey(default))),
            None => Ok(Textured::grey(default)),
        }
    }

    fn colour_of(&mut self, value: Element, role: Role) -> Result<Textured, SceneError> {
        match self.constant(value, role)? {
            Some(colour) => Ok(Textured::Constant(self.in_range(value, colour, role))),
            None => {
                if role == Role::Emission {
                    return self.texture(value, TextureValue::Light).map(Textured::Texture);
                }
                let name = self.texture(value, TextureValue::Colour)?;
                Ok(Textured::Texture(if role == Role::Reflectance { self.within_unit(value, name) } else { name }))
            }
        }
    }

    /// The number with a name, constant or textured.
    pub fn textured_number(&mut self, element: Element, name: &str, default: f64) -> Result<Textured<f64>, SceneError> {
        let Some(value) = element.property(name)? else { return Ok(Textured::Constant(default)) };
        Ok(self.part(|import| import.number_of(value))?.unwrap_or(Textured::Constant(default)))
    }

    fn number_of(&mut self, value: Element) -> Result<Textured<f64>, SceneError> {
        match self.constant(value, Role::Index)? {
            Some([r, g, b]) if r == g && g == b => Ok(Textured::Constant(r)),
            // Mitsuba takes the mean of a colour, and the luminance of an image.
            Some([r, g, b]) => Ok(Textured::Constant((r + g + b) / 3.0)),
            None => self.texture(value, TextureValue::Number).map(Textured::Texture),
        }
    }

    /// The number with a name, limited to the range from 0 to 1.
    pub fn fraction(&mut self, element: Element, of: &str, default: f64) -> Result<Textured<f64>, SceneError> {
        let number = self.textured_number(element, of, default)?;
        Ok(match number {
            Textured::Constant(x) if !(0.0..=1.0).contains(&x) => {
                self.remark_value(element, of, "the nearest number from 0 to 1", "the material is less extreme")?;
                Textured::Constant(x.clamp(0.0, 1.0))
            }
            Textured::Texture(name) => Textured::Texture(match element.property(of)? {
                Some(value) => self.number_within_unit(value, name),
                None => name,
            }),
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
            "mesh_attribute" => self.mesh_attribute(element, element.required_text("name")?),
            // Types of version 0.6.
            "vertexcolors" => self.mesh_attribute(element, "vertex_color"),
            "scale" => self.scaled_texture(element, value),
            "gridtexture" => self.grid(element),
            "volume" => Err(element.error("a `volume` texture, which Noisefall does not read", "use an image texture")),
            kind => Err(element.error(
                format!("`{kind}` is not a texture that Noisefall knows"),
                "it knows bitmap, checkerboard, mesh_attribute and the spectra",
            )),
        }
    }

    /// Squares of two colours. Where Mitsuba looks up a number, it exchanges the two (`Checkerboard::eval_1` in version 3.9).
    fn checkerboard(&mut self, element: Element, value: TextureValue) -> Result<TextureKind, SceneError> {
        self.uses.coordinates = true;
        let mut colours = |role| Ok((self.colour(element, "color0", 0.4, role)?, self.colour(element, "color1", 0.2, role)?));
        let (even, odd) = match value {
            TextureValue::Light => colours(Role::Emission)?,
            TextureValue::Colour => colours(Role::Reflectance)?,
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

    /// A texture or a colour times another colour.
    fn scaled_texture(&mut self, element: Element, value: TextureValue) -> Result<TextureKind, SceneError> {
        let a = match element.objects(&["texture"])?.into_iter().find(|(name, _)| *name != "scale") {
            Some((_, texture)) => Textured::Texture(self.texture(texture, value)?),
            None => self.colour(element, "value", 1.0, Role::Index)?,
        };
        Ok(Product { a, b: self.colour(element, "scale", 1.0, Role::Index)? }.into())
    }

    /// Lines of a width on squares, as the mixture of both colours.
    fn grid(&mut self, element: Element) -> Result<TextureKind, SceneError> {
        self.remark(element, "the mean colour", "the lines are missing");
        element.ignore(&["uscale", "vscale", "uoffset", "voffset"]);
        let width = element.number("line_width", 0.01)?.clamp(0.0, 0.5);
        let [a, b] = [("color0", 0.2), ("color1", 0.4)].map(|(name, default)| self.colour(element, name, default, Role::Index));
        Ok(Mix { a: a?, b: b?, weight: Textured::Constant(1.0 - (1.0 - 2.0 * width).powi(2)) }.into())
    }

    fn mesh_attribute(&mut self, element: Element, name: &str) -> Result<TextureKind, SceneError> {
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
