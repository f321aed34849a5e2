//! Textures with other colours.
use std::collections::HashMap;

use super::super::{context::Import, pictures};
use crate::{
    image::{Encoding, read_light},
    scene::description::{TextureKind, Textured},
    texture::{checker::Checker, image::Image, mix::Mix},
};

/// Larger images keep their colours.
const MOST_PIXELS: u64 = 1 << 24;

impl Import {
    /// A color or texture after a function of each channel; `None` if the texture cannot be changed.
    pub fn recoloured(&mut self, colour: &Textured, f: &dyn Fn(f64) -> f64) -> Option<Textured> {
        self.recoloured_once(colour, f, &mut HashMap::new())
    }

    /// The same. `known` has the textures that were changed before by their names: textures can hold each other twice again and again.
    fn recoloured_once(
        &mut self,
        colour: &Textured,
        f: &dyn Fn(f64) -> f64,
        known: &mut HashMap<String, Textured>,
    ) -> Option<Textured> {
        let name = match colour {
            Textured::Constant(colour) => return Some(Textured::Constant(colour.map(f))),
            Textured::Texture(name) => name,
        };
        if let Some(known) = known.get(name) {
            return Some(known.clone());
        }
        let kind: TextureKind = match self.description.textures.get(name)?.clone() {
            TextureKind::Checker(checker) => {
                let (even, odd) = (self.recoloured_once(&checker.even, f, known)?, self.recoloured_once(&checker.odd, f, known)?);
                Checker { even, odd, ..checker }.into()
            }
            TextureKind::Mix(mix) => {
                let (a, b) = (self.recoloured_once(&mix.a, f, known)?, self.recoloured_once(&mix.b, f, known)?);
                Mix { a, b, ..mix }.into()
            }
            TextureKind::Image(image) => self.recoloured_image(&image, f)?.into(),
            _ => return None,
        };
        let recoloured = Textured::Texture(self.add_texture(&format!("{name} recoloured"), kind));
        known.insert(name.clone(), recoloured.clone());
        Some(recoloured)
    }

    fn recoloured_image(&mut self, image: &Image, f: &dyn Fn(f64) -> f64) -> Option<Image> {
        let file = self.images.get(&image.path)?;
        let picture = read_light(file, image.encoding).ok()?;
        if u64::from(picture.width) * u64::from(picture.height) > MOST_PIXELS {
            return None;
        }
        let channel = |x: f32| f(f64::from(x).clamp(0.0, 1.0)) as f32;
        let pixels: Vec<[f32; 3]> = picture.radiance.iter().map(|[r, g, b, _]| [*r, *g, *b].map(channel)).collect();
        let bytes = pictures::exr(picture.width, picture.height, &pixels)?;
        let name = file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let path = self.new_files.add_image(&name, "exr", bytes);
        Some(Image { path, encoding: Encoding::Linear, ..image.clone() })
    }
}
