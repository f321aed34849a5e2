//! Reflectances head-on that an image gives, as `principled` takes them: the greatest one, a weight, and a tint.
use super::textures::{Textures, Use, number};
use crate::import::{Imported, pictures};
use noisefall_base::{
    declare::{Resources, Textured},
    math::colour::srgb_from_linear,
};
use noisefall_scene::{
    image::{Encoding, Texels, read_light_of},
    texture::image::Image,
};

/// Channels that differ by less are grey: half a step of an image of 8 bits.
const GREY: f32 = 0.002;

/// Reflectances F₀ = `greatest` · `weight` · `tint`. The tint reaches 1 in one channel.
pub struct Reflectances {
    pub greatest: f64,
    pub weight: Textured<f64>,
    pub tint: Textured,
}

impl Reflectances {
    fn even(factor: [f64; 3]) -> Reflectances {
        let (weight, tint) = (Textured::Constant(1.0), Textured::Constant(tint(factor)));
        Reflectances { greatest: strongest(factor), weight, tint }
    }
}

/// The hue of a colour; of black, white.
fn tint(rgb: [f64; 3]) -> [f64; 3] {
    let strongest = strongest(rgb);
    if strongest > 0.0 { rgb.map(|x| x / strongest) } else { [1.0; 3] }
}

fn strongest(rgb: [f64; 3]) -> f64 {
    rgb.into_iter().fold(0.0, f64::max)
}

impl Textures<'_> {
    /// A factor times the colour of a texture. An image of several hues becomes two: of weights and of tints.
    pub fn reflectances(&mut self, to: &mut Imported, factor: [f64; 3], of: &Use) -> Reflectances {
        let even = Reflectances::even(factor);
        let Some(image) = self.path(to, of).filter(|_| even.greatest > 0.0) else { return even };
        let Some(texels) = self.texels(to, &image.path) else { return even };
        let products = || texels.radiance.iter().map(|[r, g, b, _]| [r, g, b].map(|x| f64::from(*x)));
        let scaled = |rgb: [f64; 3]| std::array::from_fn::<f64, 3, _>(|i| rgb[i] * factor[i]);
        let [brightest, greatest] =
            products().fold([0.0f64; 2], |[a, b], rgb| [a.max(strongest(rgb)), b.max(strongest(scaled(rgb)))]);
        if greatest <= 0.0 {
            return Reflectances { greatest: 0.0, ..even };
        }
        let is_grey = |[r, g, b, _]: &[f32; 4]| (r - g).abs().max((g - b).abs()).max((b - r).abs()) < GREY;
        if texels.radiance.iter().all(is_grey) {
            let grey = number(Textured::Texture(self.add_image(to, of, image)));
            let weight = self.ramp(to, grey, [0.0, brightest], [0.0, 1.0]);
            return Reflectances { greatest, weight, ..even };
        }
        let code = |x: f64| (255.0 * srgb_from_linear(x)).round().clamp(0.0, 255.0) as u8;
        let weights: Vec<[u8; 1]> = products().map(|rgb| [code(strongest(scaled(rgb)) / greatest)]).collect();
        let tints: Vec<[u8; 3]> = products().map(|rgb| tint(scaled(rgb)).map(code)).collect();
        let files = [pictures::png(texels.width, texels.height, &weights), pictures::png(texels.width, texels.height, &tints)];
        let [Some(weights), Some(tints)] = files else { return even };
        let mut add = |bytes, what: &str| {
            let path = self.derived(to, &image.path, what, bytes);
            let of = Use { map: None, ..*of };
            Textured::Texture(self.add_image(to, &of, Image { path, ..image.clone() }))
        };
        let weight = number(add(weights, "weight"));
        Reflectances { greatest, weight, tint: add(tints, "tint") }
    }

    /// The texels of a file, linear; `None` if it cannot be read.
    fn texels(&self, to: &Imported, path: &str) -> Option<Texels> {
        let resources = Resources::new(self.folder()).with_assets(to.assets.clone());
        read_light_of(&resources.file(path), Encoding::Srgb).ok()
    }
}
