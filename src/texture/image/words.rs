//! The words of an image's settings.
use crate::declare::words;

/// Channels of an image or of vertex colors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// The color.
    Rgb,
    /// The first channel.
    Red,
    /// The second channel.
    Green,
    /// The third channel.
    Blue,
    /// The opacity; 1 if there is none.
    Alpha,
}

words! {
    Channel {
        Rgb: "rgb", "RGB", "The colour.";
        Red: "red", "Red", "The first channel, as grey.";
        Green: "green", "Green", "The second channel, as grey.";
        Blue: "blue", "Blue", "The third channel, as grey.";
        Alpha: "alpha", "Alpha", "The opacity, as grey; 1 if the file has none.";
    }
}

/// What continues an image beyond its unit square.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// The image again.
    Repeat,
    /// The mirrored image.
    Mirror,
    /// Its outermost texels.
    Clamp,
    /// Nothing: black.
    Black,
}

words! {
    Wrap {
        Repeat: "repeat", "Repeat", "Repeats the image.";
        Mirror: "mirror", "Mirror", "Repeats the image, mirrored every second time.";
        Clamp: "clamp", "Clamp", "Repeats the outermost texels.";
        Black: "black", "Black", "Black.";
    }
}

/// Interpolation between texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TexelFilter {
    /// Linear in u and v.
    Bilinear,
    /// None.
    Nearest,
}

words! {
    TexelFilter {
        Bilinear: "bilinear", "Bilinear", "Interpolates between four texels.";
        Nearest: "nearest", "Nearest", "The texel at the point.";
    }
}
