//! Textures of fractions, which lie within 0 and 1.
use super::{context::Import, picture, tree::Element};
use noisefall_scene::{
    image::Encoding,
    scene::description::{TextureKind, Textured},
    texture::{
        checker::Checker,
        image::{Image, Wrap},
        mix::Mix,
        product::Product,
        ramp::{Ramp, Stop},
    },
};

impl Import {
    /// A texture whose image is within 0 and 1, in place of one that may not be.
    pub fn within_unit(&mut self, value: Element, name: String) -> String {
        if let Some(known) = self.known_limited.get(&name) {
            return known.clone();
        }
        let limited = match self.limited(&name) {
            Some(kind) => {
                self.remark(value, "its values within 0 and 1", "it is less bright, or not negative");
                self.add_texture(&name, kind)
            }
            None => name.clone(),
        };
        self.known_limited.insert(name, limited.clone());
        limited
    }

    /// Cuts a textured number, between texels too, as Mitsuba does.
    pub fn number_within_unit(&mut self, value: Element, name: String) -> String {
        let key = format!("number {name}");
        if let Some(known) = self.known_limited.get(&key) {
            return known.clone();
        }
        let Some(TextureKind::Image(image)) = self.description.textures.get(&name).cloned() else {
            return self.within_unit(value, name);
        };
        // Beyond its edges, a black image has 0, which would be the least value.
        let has_edge = [image.wrap_u, image.wrap_v].contains(&Wrap::Black);
        let Some((bytes, ends)) = picture::spread(self, &image).filter(|_| !has_edge) else {
            return self.within_unit(value, name);
        };
        self.remark(value, "its values within 0 and 1", "it is less bright, or not negative");
        let [least, most] = ends.map(f64::from);
        let path = self.new_files.add_image(&name, "exr", bytes);
        let input = self.add_texture(&name, Image { path, encoding: Encoding::Linear, ..image });
        let stop = |x: f64| Stop { at: (x - least) / (most - least), color: [x.clamp(0.0, 1.0); 3] };
        let mut stops = [least, 0.0, 1.0, most].map(stop).to_vec();
        stops.dedup_by(|a, b| a.at == b.at);
        let cut = self.add_texture(&name, Ramp { input: Textured::Texture(input), stops });
        self.known_limited.insert(key, cut.clone());
        cut
    }

    /// A texture within 0 and 1; `None` if it is there already.
    fn limited(&mut self, name: &str) -> Option<TextureKind> {
        let limit = |colour: &Textured| match colour {
            Textured::Constant(colour) => Textured::Constant(colour.map(|x| x.clamp(0.0, 1.0))),
            textured @ Textured::Texture(_) => textured.clone(),
        };
        let kind = self.description.textures.get(name)?.clone();
        let limited: TextureKind = match &kind {
            TextureKind::Image(image) => {
                let bytes = picture::within_unit(self, image)?;
                let path = self.new_files.add_image(name, "exr", bytes);
                Image { path, encoding: Encoding::Linear, ..image.clone() }.into()
            }
            TextureKind::Checker(squares) => {
                Checker { even: limit(&squares.even), odd: limit(&squares.odd), scale: squares.scale }.into()
            }
            TextureKind::Mix(mix) => Mix { a: limit(&mix.a), b: limit(&mix.b), weight: mix.weight.clone() }.into(),
            TextureKind::Product(product) => Product { a: limit(&product.a), b: limit(&product.b) }.into(),
            _ => return None,
        };
        (limited != kind).then_some(limited)
    }
}
