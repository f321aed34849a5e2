//! Images of textures. The coordinates of Mitsuba's images run downwards, as ours do.
use glam::{DAffine2, DMat4, DVec2};

use super::{context::Import, tree::Element};
use crate::import::uv_maps;
use noisefall_scene::{
    image::Encoding,
    scene::SceneError,
    texture::image::{Image, TexelFilter, Wrap},
};

impl Import {
    /// An image file.
    pub fn bitmap(&mut self, element: Element) -> Result<Image, SceneError> {
        element.ignore(&["format", "accel", "filter_min", "mipmap", "max_anisotropy", "cache", "gamma"]);
        self.uses.coordinates = true;
        let path = self.file(element, "filename")?;
        let raw = element.flag("raw", false)? || element.optional_number("gamma")? == Some(1.0);
        let both = self.wrap(element, "wrap_mode", Wrap::Repeat)?;
        // Version 0.6 knows one for each axis.
        let (wrap_u, wrap_v) = (self.wrap(element, "wrap_mode_u", both)?, self.wrap(element, "wrap_mode_v", both)?);
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
            wrap_u,
            wrap_v,
            filter,
            ..placed
        })
    }

    /// The placement by `to_uv`.
    pub fn placement(&mut self, element: Element) -> Result<Image, SceneError> {
        let map = element.transform("to_uv")?;
        let number = |name: &str, default: f64| element.number(name, default);
        let old = DMat4::from_scale(DVec2::new(number("uscale", 1.0)?, number("vscale", 1.0)?).extend(1.0))
            * DMat4::from_translation(DVec2::new(number("uoffset", 0.0)?, number("voffset", 0.0)?).extend(0.0));
        let map = map * old;
        let column = |i: usize| map.col(i).truncate().truncate();
        let plane = DAffine2::from_cols(column(0), column(1), column(3));
        uv_maps::placed(&plane).ok_or_else(|| element.error("`to_uv` flattens the texture", "check its numbers"))
    }

    fn wrap(&mut self, element: Element, name: &str, default: Wrap) -> Result<Wrap, SceneError> {
        Ok(match element.text(name)? {
            None => default,
            Some("repeat") => Wrap::Repeat,
            Some("mirror") => Wrap::Mirror,
            Some("clamp") => Wrap::Clamp,
            Some("zero" | "black") => Wrap::Black,
            Some("one" | "white") => {
                self.remark_value(element, name, "`clamp`", "the edge of the image continues")?;
                Wrap::Clamp
            }
            Some(other) => return Err(element.error(format!("`{other}` is not a wrap mode"), "repeat, mirror or clamp")),
        })
    }
}

/// Whether an image lies elsewhere than over the unit square.
pub fn is_placed(image: &Image) -> bool {
    image.scale != [1.0; 2] || image.shear != 0.0 || image.rotate != 0.0 || image.offset != [0.0; 2]
}
