//! Images that the export makes: textures in channels of PNG files with 8 bits.
use super::{
    super::{
        ExportError,
        textures::{BAKED, SIDE, luminance},
    },
    context::Export,
    known::Mapped,
    textures::{Part, placement},
};
use crate::import::pictures;
use noisefall_base::{
    declare::Textured,
    math::colour::{linear_from_srgb, srgb_from_linear},
};
use noisefall_scene::{
    image::Encoding,
    scene::description::TextureKind,
    texture::{
        ImageTexture, PICTURES,
        image::{Channel, Image, TexelFilter},
    },
};

/// Error of a colour or number that counts as none.
const EXACT: f64 = 1e-6;

/// Squares of a checker along a side, as far as the lookup of images resolves them.
const LARGEST: f64 = 1e4;

/// Texels of a texture, and how they lie on the surface.
struct Texels {
    size: [u32; 2],
    pixels: Vec<[f32; 3]>,
    place: Image,
}

impl Export<'_> {
    /// A new image with the textures of all parts. Constant parts find 1 there.
    pub fn packed(&mut self, parts: &[Part]) -> Result<Option<Mapped>, ExportError> {
        let textured: Vec<(usize, &str)> =
            parts.iter().enumerate().filter_map(|(at, part)| Some((at, part.texture.as_deref()?))).collect();
        let mut sheets = Vec::new();
        for (_, name) in &textured {
            sheets.extend(self.texels(name)?);
        }
        let is_same = |sheet: &Texels| sheet.size == sheets[0].size && sheet.place == sheets[0].place;
        if sheets.len() < textured.len() || !sheets.iter().all(is_same) {
            let baked: Option<Vec<Texels>> = textured.iter().map(|(_, name)| self.baked(name)).collect();
            sheets = baked.unwrap_or_default();
        }
        let Some(Texels { size, place, pixels }) = sheets.first() else { return Ok(None) };
        let mut bytes = vec![[255; 4]; pixels.len()];
        let (mut scales, mut worst) = (vec![1.0; parts.len()], 0.0);
        for ((at, _), sheet) in textured.iter().zip(&sheets) {
            let error = fill(&mut bytes, parts[*at].channel, &sheet.pixels, &mut scales[*at]);
            worst = f64::max(worst, error);
        }
        let (at, name) = textured[0];
        self.rounding(worst, &format!("the texture `{name}`"));
        let has_opacity = parts.iter().any(|part| part.channel == Channel::Alpha);
        let Some(path) = self.png(name, *size, &bytes, has_opacity) else { return Ok(None) };
        let info = self.texture(path, parts[at].name(), place);
        Ok(Some(Mapped { info, scales }))
    }

    /// The texels of an image or a checker of two colors.
    fn texels(&self, name: &str) -> Result<Option<Texels>, ExportError> {
        Ok(match self.colors.kind(name) {
            Some(TextureKind::Image(image)) => {
                let read = ImageTexture::read_image(self.resources, PICTURES, image).map_err(|problem| self.invalid(problem))?;
                let pick = |[r, g, b, _]: [f32; 4]| match image.channel {
                    Channel::Rgb => [r, g, b],
                    Channel::Red | Channel::Alpha => [r; 3],
                    Channel::Green => [g; 3],
                    Channel::Blue => [b; 3],
                };
                let pixels = read.texels().iter().map(|texel| pick(*texel)).collect();
                Some(Texels { size: read.size(), pixels, place: placement(image) })
            }
            Some(TextureKind::Checker(checker)) => match (&checker.even, &checker.odd) {
                (Textured::Constant(even), Textured::Constant(odd)) if checker.scale <= LARGEST => {
                    let pixels = [even, odd, odd, even].map(|color| color.map(|x| x as f32)).to_vec();
                    let scale = [checker.scale / 2.0; 2];
                    Some(Texels {
                        size: [2; 2],
                        pixels,
                        place: Image { filter: TexelFilter::Nearest, scale, ..Image::default() },
                    })
                }
                _ => None,
            },
            _ => None,
        })
    }

    /// A PNG of a linear image file, and its path.
    pub fn linear_copy(&mut self, path: &str, name: &str) -> Result<String, ExportError> {
        let read = ImageTexture::read(self.resources, "path", path, Encoding::Linear).map_err(|problem| self.invalid(problem))?;
        let mut bytes = vec![[255; 4]; read.texels().len()];
        let mut worst = 0.0;
        for (at, channel) in [Channel::Red, Channel::Green, Channel::Blue].into_iter().enumerate() {
            let pixels: Vec<[f32; 3]> = read.texels().iter().map(|texel| [texel[at]; 3]).collect();
            worst = f64::max(worst, fill(&mut bytes, channel, &pixels, &mut 1.0));
        }
        self.rounding(worst, "the normal map");
        Ok(self.png(name, read.size(), &bytes, false).unwrap_or_default())
    }

    /// Adds a PNG, and returns its path.
    fn png(&mut self, name: &str, [width, height]: [u32; 2], bytes: &[[u8; 4]], has_opacity: bool) -> Option<String> {
        let file = match has_opacity {
            true => pictures::png(width, height, bytes),
            false => pictures::png(width, height, &bytes.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect::<Vec<_>>()),
        };
        Some(self.new.add("textures", name, "png", file?))
    }

    fn rounding(&mut self, worst: f64, what: &str) {
        if worst > EXACT {
            self.remark(format!("the numbers of {what}"), "8 bits", "they are rounded");
        }
    }

    /// An image of a texture over the unit square.
    fn baked(&mut self, name: &str) -> Option<Texels> {
        let kind = self.colors.kind(name)?;
        let [used, effect] = BAKED;
        self.remark(format!("a `{}`", kind.name()), used, effect);
        Some(Texels { size: [SIDE; 2], pixels: self.colors.pixels(name)?, place: Image::default() })
    }
}

/// Writes pixels to their channels, and finds the factor that makes them at most 1. Returns the greatest error.
fn fill(bytes: &mut [[u8; 4]], channel: Channel, pixels: &[[f32; 3]], scale: &mut f64) -> f64 {
    let is_color = channel == Channel::Rgb;
    let values = |color: &[f32; 3]| {
        let color = color.map(f64::from);
        if is_color { color } else { [luminance(color); 3] }
    };
    *scale = pixels.iter().flat_map(values).fold(1.0, f64::max);
    let mut worst: f64 = 0.0;
    for (bytes, pixel) in bytes.iter_mut().zip(pixels) {
        let color = values(pixel).map(|x| x / *scale);
        let shown = color.map(|x| if is_color { srgb_from_linear(x) } else { x });
        let rounded = shown.map(|x| (255.0 * x).round().clamp(0.0, 255.0) as u8);
        let back = rounded.map(|x| f64::from(x) / 255.0).map(|x| if is_color { linear_from_srgb(x) } else { x });
        worst = (0..3).map(|i| (back[i] - color[i]).abs()).fold(worst, f64::max);
        match channel {
            Channel::Rgb => bytes[..3].copy_from_slice(&rounded),
            Channel::Red => bytes[0] = rounded[0],
            Channel::Green => bytes[1] = rounded[0],
            Channel::Blue => bytes[2] = rounded[0],
            Channel::Alpha => bytes[3] = rounded[0],
        }
    }
    worst
}
