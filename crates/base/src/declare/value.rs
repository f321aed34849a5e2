//! The types of values.
use glam::DVec3;

use super::parameter::{CountRange, Range};

/// A value that a visitor may read or replace.
pub enum Value<'v> {
    /// A number in a range.
    Number(&'v mut f64, Range),
    /// A whole number in a range.
    Count(&'v mut u32, CountRange),
    /// True or false.
    Flag(&'v mut bool),
    /// Any text.
    Text(&'v mut String),
    /// A path relative to the folder of the scene.
    File(&'v mut String),
    /// The name of something that the scene defines.
    Name(&'v mut String, Family),
    /// Linear Rec. 709: three channels, or one number for grey.
    Colour(&'v mut [f64; 3], Range),
    /// A colour, or a texture in its place.
    Textured(&'v mut Textured, Range),
    /// A number, or a texture whose luminance it is.
    TexturedNumber(&'v mut Textured<f64>, Range),
    /// Metres: a position, or a direction of any length.
    Point(&'v mut DVec3),
    /// Three numbers of any size.
    Vector(&'v mut DVec3),
    /// Three factors, or one for all.
    Factors(&'v mut DVec3),
    /// Two numbers.
    Pair(&'v mut [f64; 2]),
    /// Two whole numbers.
    Counts(&'v mut [u32; 2]),
    /// Row by row.
    Matrix(&'v mut [[f64; 4]; 4]),
    /// A list of positions, metres.
    Points(&'v mut Vec<[f64; 3]>),
    /// A list of triangles, as indices of three points each.
    Triangles(&'v mut Vec<[u32; 3]>),
    /// The place of one of the words.
    Word(&'v mut usize, &'v [Word]),
}

/// The kinds of things that a name refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// A texture.
    Texture,
    /// A material.
    Material,
}

/// A colour, linear Rec. 709, or a number; or a texture in its place.
#[derive(Clone, Debug, PartialEq)]
pub enum Textured<T = [f64; 3]> {
    /// A constant value.
    Constant(T),
    /// The name of a texture.
    Texture(String),
}

impl<T> Textured<T> {
    /// Applies a function to the constant; a texture stays as it is.
    pub fn map<U>(self, f: impl FnOnce(T) -> U) -> Textured<U> {
        match self {
            Textured::Constant(constant) => Textured::Constant(f(constant)),
            Textured::Texture(name) => Textured::Texture(name),
        }
    }
}

impl Textured {
    /// A constant with the same number in all channels.
    pub const fn grey(value: f64) -> Textured {
        Textured::Constant([value; 3])
    }
}

impl From<[f64; 3]> for Textured {
    fn from(colour: [f64; 3]) -> Textured {
        Textured::Constant(colour)
    }
}

impl From<[f32; 3]> for Textured {
    fn from(colour: [f32; 3]) -> Textured {
        Textured::Constant(colour.map(f64::from))
    }
}

/// One of a few words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word {
    /// Its name in scene files and on the command line.
    pub name: &'static str,
    /// Its title in the window.
    pub title: &'static str,
    /// One sentence: what it does.
    pub doc: &'static str,
}

/// Types whose values have a word each.
pub trait Words: Copy + PartialEq + 'static {
    /// All values with their words, in the order in which they are offered.
    fn words() -> &'static [(Word, Self)];
}

/// Declares an enum without data with the words of its values: name in files, title in the window, one sentence.
#[macro_export]
macro_rules! words {
    (
        $(#[$meta:meta])*
        pub enum $Type:ident { $($(#[$attribute:meta])* $Variant:ident: $name:literal, $title:literal, $doc:literal;)+ }
    ) => {
        $(#[$meta])*
        pub enum $Type {
            $(#[doc = $doc] $(#[$attribute])* $Variant),+
        }

        impl $Type {
            /// All values, in the order in which they are offered.
            pub const ALL: [$Type; [$($name),+].len()] = [$($Type::$Variant),+];

            /// Its name in scene files and messages.
            pub const fn word(self) -> $crate::declare::Word {
                match self {
                    $($Type::$Variant => $crate::declare::Word { name: $name, title: $title, doc: $doc }),+
                }
            }

            /// Its name in scene files and on the command line.
            pub const fn name(self) -> &'static str {
                self.word().name
            }
        }

        impl $crate::declare::Words for $Type {
            fn words() -> &'static [($crate::declare::Word, Self)] {
                const { &[$(($Type::$Variant.word(), $Type::$Variant)),+] }
            }
        }
    };
}
pub use words;
