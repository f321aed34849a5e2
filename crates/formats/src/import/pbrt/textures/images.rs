//! Image textures.
use std::path::Path;

use super::{Content, colour, number};
use crate::import::pbrt::{import::Import, parameters::Entity};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    image::{EXTENSIONS, Encoding},
    scene::SceneError,
    texture::{
        image::{Image, TexelFilter, Wrap},
        mix::Mix,
    },
};

impl Import {
    pub(super) fn image_map(&mut self, entity: &Entity, name: &str, content: Content) -> Result<Textured, SceneError> {
        let path = self.required_file(entity, "filename")?;
        let [scale, offset] = self.mapping(entity)?;
        let image = Image {
            path: self.files.folder.described(&path),
            encoding: self.encoding(entity),
            wrap_u: Wrap::Repeat,
            filter: self.filter(entity),
            scale,
            offset,
            ..Image::default()
        };
        let wrap = match entity.text("wrap").unwrap_or("repeat") {
            "clamp" => Wrap::Clamp,
            "black" => Wrap::Black,
            "octahedralsphere" => {
                self.remark(entity, "a clamped image", "texels beyond the edges differ");
                Wrap::Clamp
            }
            _ => Wrap::Repeat,
        };
        let factor = entity.float("scale", 1.0)?;
        let invert = entity.flag("invert", false)?;
        entity.ignore(&["maxanisotropy", "trilinear"]);
        if !is_known(&path) {
            self.remark(entity, "grey", "Noisefall does not decode this format of images");
            return Ok(Textured::grey(0.5));
        }
        let image = self.new_texture(name, Image { wrap_u: wrap, wrap_v: wrap, ..image });
        let scaled = self.scaled(&image, factor, name)?;
        if !invert {
            return Ok(scaled);
        }
        if content != Content::Numbers {
            self.remark(entity, "the inverted luminance of the image", "its colours are grey");
        }
        let inverted = Mix { a: Textured::grey(1.0), b: Textured::grey(0.0), weight: number(scaled) };
        Ok(colour(Textured::Texture(self.add_texture(name, inverted))))
    }

    /// Scale and offset of coordinates; ours run downwards from the top.
    pub(super) fn mapping(&mut self, entity: &Entity) -> Result<[[f64; 2]; 2], SceneError> {
        let kind = entity.text("mapping").unwrap_or("uv").to_owned();
        let [su, sv] = [entity.float("uscale", 1.0)?, entity.float("vscale", 1.0)?];
        let [du, dv] = [entity.float("udelta", 0.0)?, entity.float("vdelta", 0.0)?];
        if kind != "uv" {
            entity.ignore(&["v1", "v2"]);
            self.remark(
                entity,
                &format!("the coordinates of the surface for its {kind} mapping"),
                "the texture is placed differently",
            );
            return Ok([[1.0; 2], [0.0; 2]]);
        }
        Ok([[su, sv], [du, 1.0 - sv - dv]])
    }

    fn encoding(&mut self, entity: &Entity) -> Encoding {
        // The name in pbrt-v3.
        if entity.flag("gamma", true).is_ok_and(|gamma| !gamma) {
            return Encoding::Linear;
        }
        match entity.text("encoding").unwrap_or("sRGB") {
            "linear" => Encoding::Linear,
            "sRGB" => Encoding::Srgb,
            _ => {
                self.remark(entity, "the sRGB curve for its encoding", "middle tones differ slightly");
                Encoding::Srgb
            }
        }
    }

    fn filter(&mut self, entity: &Entity) -> TexelFilter {
        match entity.text("filter").unwrap_or("bilinear") {
            "point" => TexelFilter::Nearest,
            "bilinear" => TexelFilter::Bilinear,
            other => {
                let found = format!("filter `{other}` of {}", entity.shown());
                let effect = "distant textures are sampled, not blurred";
                self.remarks.add(entity.place.to_string(), found, "bilinear interpolation", effect);
                TexelFilter::Bilinear
            }
        }
    }
}

/// Whether the name of a file ends as those of known images do. Files without such a name are tried.
fn is_known(path: &Path) -> bool {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    extension.is_none_or(|extension| EXTENSIONS.contains(&extension.as_str()))
}
