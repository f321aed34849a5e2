//! Patterns that small images give exactly.
use super::Content;
use crate::import::{
    pbrt::{import::Import, parameters::Entity},
    pictures,
};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    image::Encoding,
    scene::SceneError,
    texture::image::{Image, TexelFilter, Wrap},
};

impl Import {
    /// Squares of two textures: a mask of 2 × 2 texels chooses between them.
    pub(super) fn checkerboard(&mut self, entity: &Entity, name: &str, content: Content) -> Result<Textured, SceneError> {
        let [a, b] = [self.values(entity, "tex1", 1.0, content)?, self.values(entity, "tex2", 0.0, content)?];
        if entity.integer("dimension", 2)? == 3 {
            self.remark(entity, "both textures in equal parts", "a checkerboard in space has no squares here");
            return Ok(self.mixed(name, a, b, Textured::Constant(0.5)));
        }
        let [scale, [du, dv]] = self.mapping(entity)?;
        // The mask has two squares along each side.
        let up = 1.0 - scale[1] - dv;
        let mask = Image {
            path: self.pattern("checkerboard", "png", || pictures::png(2, 2, &[[255], [0], [0], [255]])),
            encoding: Encoding::Linear,
            filter: TexelFilter::Nearest,
            scale: scale.map(|scale| 0.5 * scale),
            offset: [0.5 * du, 1.0 - 0.5 * (scale[1] + up)],
            ..Image::default()
        };
        let mask = self.add_texture(&format!("{name} mask"), mask);
        Ok(self.mixed(name, a, b, Textured::Texture(mask)))
    }

    /// A bilinear interpolation of four colours: between the middles of 2 × 2 texels.
    pub(super) fn bilerp(&mut self, entity: &Entity, name: &str, content: Content) -> Result<Textured, SceneError> {
        let mut corners = [[0f32; 3]; 4];
        for (corner, (key, default)) in corners.iter_mut().zip([("v01", 1.0), ("v11", 1.0), ("v00", 0.0), ("v10", 0.0)]) {
            *corner = match self.values(entity, key, default, content)? {
                Textured::Constant(colour) => colour.map(|x| x.max(0.0) as f32),
                Textured::Texture(_) => [default as f32; 3],
            };
        }
        let [scale, [du, offset_v]] = self.mapping(entity)?;
        let bytes = pictures::exr(2, 2, &corners).unwrap_or_default();
        let image = Image {
            path: self.new_files.add_image(name, "exr", bytes),
            encoding: Encoding::Linear,
            wrap_u: Wrap::Clamp,
            wrap_v: Wrap::Clamp,
            scale: scale.map(|scale| 0.5 * scale),
            offset: [0.25 + 0.5 * du, 0.25 + 0.5 * offset_v],
            ..Image::default()
        };
        Ok(self.new_texture(name, image))
    }

    /// The path of an image that all textures of a kind share.
    fn pattern(&mut self, name: &str, extension: &str, encoded: impl FnOnce() -> Option<Vec<u8>>) -> String {
        let path = format!("textures/{name} pattern.{extension}");
        if self.new_files.assets.get::<Vec<u8>>(&path).is_none() {
            self.new_files.assets.insert(path.clone(), encoded().unwrap_or_default());
        }
        path
    }
}
