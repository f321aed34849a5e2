//! The words of an image's settings.
use noisefall_base::declare::words;

words! {
    /// Channels of an image or of vertex colors.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Channel {
        Rgb: "rgb", "RGB", "The colour.";
        Red: "red", "Red", "The first channel, as grey.";
        Green: "green", "Green", "The second channel, as grey.";
        Blue: "blue", "Blue", "The third channel, as grey.";
        Alpha: "alpha", "Alpha", "The opacity, as grey; 1 if the file has none.";
    }
}

words! {
    /// Continuation of an image beyond its unit square.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Wrap {
        Repeat: "repeat", "Repeat", "Repeats the image.";
        Mirror: "mirror", "Mirror", "Repeats the image, mirrored every second time.";
        Clamp: "clamp", "Clamp", "Repeats the outermost texels.";
        Black: "black", "Black", "Black.";
    }
}

words! {
    /// Interpolation between texels.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum TexelFilter {
        Bilinear: "bilinear", "Bilinear", "Interpolates between four texels.";
        Nearest: "nearest", "Nearest", "The texel at the point.";
    }
}
