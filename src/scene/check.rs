//! Checks of single values of a scene file: each returns the value in the renderer's units or an error at its place.
use std::{
    cell::RefCell,
    fmt,
    ops::Range,
    path::{Path, PathBuf},
};

use glam::DVec3;
use toml::Spanned;

use super::{
    desc::{Colour, Exactly},
    diagnostic::{SceneError, SourceText},
    wording::nearest,
};
use crate::{geometry::Shape, memory::Reservation, quote};

/// Coordinates and radii beyond these are refused: squares of them would leave the range of f32.
const LARGEST: f64 = 1e12;
const SMALLEST_RADIUS: f64 = 1e-12;
const BRIGHTEST: f64 = 1e15;

/// A number as one would write it: powers of ten only where there are many zeros.
pub fn short(x: f64) -> String {
    if x == 0.0 || !x.is_finite() || (1e-4..1e6).contains(&x.abs()) { x.to_string() } else { format!("{x:e}") }
}

/// What the channels of a colour may be: from 0 to `most`.
pub struct ColourRange {
    pub what: &'static str,
    pub most: f64,
    pub expected: &'static str,
}

impl ColourRange {
    pub const ALBEDO: ColourRange = ColourRange {
        what: "albedo",
        most: 1.0,
        expected: "every channel must lie in [0, 1]: a surface cannot reflect more light than it receives",
    };
    pub const RADIANCE: ColourRange =
        ColourRange { what: "radiance", most: BRIGHTEST, expected: "every channel must be a number from 0 to 1e15" };
    pub const REFLECTANCE: ColourRange = ColourRange { what: "reflectance", ..ColourRange::ALBEDO };
    pub const F0: ColourRange = ColourRange { what: "f0", ..ColourRange::ALBEDO };
    pub const TRANSMITTANCE: ColourRange = ColourRange {
        what: "transmittance",
        most: 1.0,
        expected: "every channel must lie in [0, 1]: what a metre of the interior lets pass",
    };
    pub const ROUGHNESS: ColourRange = ColourRange { what: "roughness", most: 1.0, expected: "expected a number from 0 to 1" };
    pub const ALPHA: ColourRange = ColourRange { what: "alpha", ..ColourRange::ROUGHNESS };
    pub const INDEX: ColourRange =
        ColourRange { what: "index", most: 1e3, expected: "every channel of `eta` and `k` must be a number from 0 to 1000" };
    /// A colour within a texture, whatever it is used for.
    pub const TEXTURE: ColourRange = ColourRange { what: "colour", ..ColourRange::RADIANCE };
}

/// Checks against one source text, and counts the memory that the scene is going to take.
pub struct Checker<'a>(pub &'a SourceText, RefCell<Reservation>);

impl<'a> Checker<'a> {
    pub fn new(source: &'a SourceText) -> Checker<'a> {
        Checker(source, RefCell::new(Reservation::none()))
    }

    /// Room in the scene for `what`, a plural, that the place in the file asks for.
    pub fn reserve(&self, place: Range<usize>, what: impl fmt::Display, bytes: u64) -> Result<(), SceneError> {
        self.1.borrow_mut().grow(what, bytes).map_err(|error| self.0.error(place, error.to_string(), "too much memory"))
    }

    /// All that was asked for.
    pub fn into_memory(self) -> Reservation {
        self.1.into_inner()
    }

    pub fn missing<T>(&self, table: &Spanned<T>, key: &str) -> SceneError {
        self.0.error(table.span(), format!("missing key `{key}`"), format!("`{key}` must be given here"))
    }

    pub fn point(&self, what: &str, value: &Spanned<Exactly<f64, 3>>) -> Result<DVec3, SceneError> {
        if value.as_ref().0.iter().all(|x| x.abs() <= LARGEST) {
            return Ok(DVec3::from_array(value.as_ref().0));
        }
        Err(self.0.error(
            value.span(),
            format!("`{what}` is not a position"),
            format!("coordinates must be finite and at most {LARGEST:e} in size"),
        ))
    }

    pub fn radius(&self, value: &Spanned<f64>) -> Result<f64, SceneError> {
        let radius = *value.as_ref();
        if (SMALLEST_RADIUS..=LARGEST).contains(&radius) {
            return Ok(radius);
        }
        let message = match radius {
            r if r.is_nan() => "the radius is not a number".to_owned(),
            r if r < 0.0 => format!("the radius is negative: {}", short(r)),
            r => format!("the radius is out of range: {}", short(r)),
        };
        let label = format!("expected a number from {} to {}", short(SMALLEST_RADIUS), short(LARGEST));
        let error = self.0.error(value.span(), message, label);
        Err(if radius < 0.0 {
            error.with_help("to look at a sphere from inside, keep the radius positive; `flip = true` turns its normal")
        } else {
            error
        })
    }

    /// Shapes after their transforms: neither too small nor too large or far away to be told from nothing.
    pub fn extent<T>(&self, shape: &Shape, desc: &Spanned<T>) -> Result<(), SceneError> {
        let (center, radius) = shape.bounding_sphere();
        if center.abs().max_element() <= LARGEST && (SMALLEST_RADIUS..=LARGEST).contains(&radius) {
            return Ok(());
        }
        let [x, y, z] = center.to_array().map(short);
        let message = format!("after its transforms the {} reaches {} m around {x}, {y}, {z}", shape.name(), short(radius));
        Err(self.0.error(desc.span(), message, format!("expected {SMALLEST_RADIUS:e} to {LARGEST:e} m")))
    }

    /// How far from the origin a shape comes in motion.
    pub fn reach<T>(&self, reach: f64, desc: &Spanned<T>) -> Result<(), SceneError> {
        if reach <= 4.0 * LARGEST {
            return Ok(());
        }
        let message = format!("in motion it comes as far as {reach:e} m from the origin");
        Err(self.0.error(desc.span(), message, format!("expected at most {LARGEST:e} m")))
    }

    pub fn count(&self, value: &Spanned<u32>, least: u32, most: u32) -> Result<u32, SceneError> {
        let count = *value.as_ref();
        if (least..=most).contains(&count) {
            return Ok(count);
        }
        Err(self.0.error(value.span(), format!("{count} is out of range"), format!("expected {least} to {most}")))
    }

    /// A number from `least` to `most`.
    pub fn within(&self, what: &str, value: &Spanned<f64>, least: f64, most: f64) -> Result<f32, SceneError> {
        let number = *value.as_ref();
        if (least..=most).contains(&number) {
            return Ok(number as f32);
        }
        let message = format!("`{what}` is out of range: {}", short(number));
        Err(self.0.error(value.span(), message, format!("expected a number from {} to {}", short(least), short(most))))
    }

    /// An angle, of any number of turns.
    pub fn degrees(&self, what: &str, value: &Spanned<f64>) -> Result<f64, SceneError> {
        let degrees = *value.as_ref();
        if degrees.is_finite() {
            return Ok(degrees);
        }
        Err(self.0.error(value.span(), format!("`{what}` is not a finite number: {degrees}"), "expected degrees"))
    }

    /// A path relative to the scene file.
    pub fn path(&self, value: &Spanned<String>) -> PathBuf {
        let folder = Path::new(&self.0.name).parent();
        folder.map_or_else(|| value.as_ref().into(), |folder| folder.join(value.as_ref()))
    }

    /// The error of a name that stands for nothing; `known` are those that do.
    pub fn not_defined<'k>(&self, kind: &str, name: &Spanned<String>, known: impl Iterator<Item = &'k String>) -> SceneError {
        /// More are not listed.
        const MOST: usize = 6;
        let known: Vec<_> = known.map(String::as_str).collect();
        let nearest = nearest(name.as_ref(), known.iter().copied());
        let listed = known.iter().take(MOST).map(|name| format!("`{}`", quote::piece(name))).collect::<Vec<_>>().join(", ");
        let help = match known.len() {
            0 => format!("the scene defines no {kind}s"),
            1..=MOST => format!("the scene defines {listed}"),
            count => format!("the scene defines {listed} and {} more", count - MOST),
        };
        let label = nearest.map_or_else(|| "not defined".to_owned(), |meant| format!("did you mean `{meant}`?"));
        self.0.error(name.span(), format!("there is no {kind} `{}`", name.as_ref()), label).with_help(help)
    }

    /// Radiances, each finite and not negative.
    pub fn radiance(&self, value: &Spanned<Colour>) -> Result<[f32; 3], SceneError> {
        self.colour(&ColourRange::RADIANCE, value)
    }

    /// A colour that is no texture.
    pub fn colour(&self, range: &ColourRange, value: &Spanned<Colour>) -> Result<[f32; 3], SceneError> {
        match value.as_ref() {
            Colour::Texture(_) => {
                let message = format!("`{}` cannot be a texture here", range.what);
                Err(self.0.error(value.span(), message, "expected a colour: [red, green, blue], or one number for grey"))
            }
            Colour::Rgb(rgb) if rgb.iter().all(|x| (0.0..=range.most).contains(x)) => Ok(rgb.map(|x| x as f32)),
            Colour::Rgb(rgb) => {
                let wrong = rgb.iter().find(|x| !(0.0..=range.most).contains(*x)).copied().unwrap_or_default();
                Err(self.0.error(value.span(), format!("`{}` is out of range: {}", range.what, short(wrong)), range.expected))
            }
        }
    }
}
