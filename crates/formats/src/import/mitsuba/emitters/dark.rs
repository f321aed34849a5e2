//! Emitters that emit nothing, which are left out.
use super::super::{context::Import, picture, tree::Element, unread};
use noisefall_scene::scene::description::{TextureKind, Textured};

/// Leaves an emitter out.
pub fn leave_out(import: &mut Import, element: Element) {
    import.remark(element, "nothing", "it emits no light");
    unread::skip(element);
}

/// Whether a colour is black everywhere.
pub fn is_black(import: &Import, colour: &Textured) -> bool {
    match colour {
        Textured::Constant(colour) => *colour == [0.0; 3],
        Textured::Texture(name) => match import.description.textures.get(name) {
            Some(TextureKind::Image(image)) => picture::is_black(import, image),
            Some(TextureKind::Checker(squares)) => is_black(import, &squares.even) && is_black(import, &squares.odd),
            Some(TextureKind::Mix(mix)) => is_black(import, &mix.a) && is_black(import, &mix.b),
            Some(TextureKind::Product(product)) => is_black(import, &product.a) || is_black(import, &product.b),
            _ => false,
        },
    }
}
