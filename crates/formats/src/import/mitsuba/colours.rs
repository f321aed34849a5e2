//! Colours: RGB and spectra, as linear Rec. 709.
use std::io::Read;

use super::{context::Import, tree::Element, values::words};
use crate::import::spectrum::{Spectrum, SpectrumError, equal_energy};
use noisefall_base::{file::open_regular, math::colour::linear_from_srgb};
use noisefall_scene::scene::SceneError;

/// Larger files are no spectra.
const LARGEST_SPECTRUM: u64 = 16 << 20;

/// Quantity that a spectrum describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Light.
    Emission,
    /// A fraction of light.
    Reflectance,
    /// An index of refraction.
    Index,
}

impl Role {
    fn of(self, spectrum: &Spectrum) -> [f64; 3] {
        match self {
            Role::Emission => spectrum.emission(),
            Role::Reflectance => spectrum.reflectance(),
            Role::Index => spectrum.index(),
        }
    }

    /// The colour of a spectrum with the same value at all wavelengths.
    fn constant(self, value: f64) -> [f64; 3] {
        match self {
            Role::Emission => equal_energy().map(|x| (value * x).max(0.0)),
            Role::Reflectance | Role::Index => [value; 3],
        }
    }
}

impl Import {
    /// The colour of a value, or of an object that does not vary; `None` if it is a texture.
    pub fn constant(&mut self, element: Element, role: Role) -> Result<Option<[f64; 3]>, SceneError> {
        match (element.tag(), element.kind()) {
            ("float" | "integer", _) => element.parse_number(element.value()?).map(|number| Some([number; 3])),
            ("rgb" | "srgb" | "color" | "string", "") => rgb(element).map(Some),
            ("spectrum" | "texture", "") => self.spectrum(element, role).map(Some),
            (_, kind) => self.spectrum_plugin(element, kind, role),
        }
    }

    fn spectrum(&mut self, element: Element, role: Role) -> Result<[f64; 3], SceneError> {
        if element.attribute("filename").is_some() {
            return self.spectrum_file(element, role);
        }
        let text = element.value()?;
        if !text.contains(':') && words(text).count() == 1 {
            return Ok(role.constant(element.parse_number(text.trim())?));
        }
        let pairs = words(text).map(|word| match word.split_once(':') {
            Some((wavelength, value)) => Ok([element.parse_number(wavelength)?, element.parse_number(value)?]),
            None => Err(element.error(format!("\"{word}\" is not wavelength:value"), "such as 400:0.5, 700:0.8")),
        });
        let pairs = pairs.collect::<Result<Vec<_>, _>>()?;
        Ok(role.of(&checked(element, Spectrum::new(pairs))?))
    }

    fn spectrum_file(&mut self, element: Element, role: Role) -> Result<[f64; 3], SceneError> {
        const HELP: &str = "a spectrum file has a wavelength in nm and a value per line";
        let named = element.attribute("filename").unwrap_or_default();
        let path = self.files.folder.missing.require(self.files.resolve(named), |message| element.error(message, HELP))?;
        let key = format!("{role:?} {}", path.display());
        if let Some(known) = self.known_spectra.get(&key) {
            return Ok(*known);
        }
        let mut bytes = Vec::new();
        let read = open_regular(&path).and_then(|file| file.take(LARGEST_SPECTRUM).read_to_end(&mut bytes));
        read.map_err(|error| element.error(format!("`{named}` cannot be read: {error}"), HELP))?;
        let colour = role.of(&checked(element, Spectrum::parse(&String::from_utf8_lossy(&bytes)))?);
        self.known_spectra.insert(key, colour);
        Ok(colour)
    }

    fn spectrum_plugin(&mut self, element: Element, kind: &str, role: Role) -> Result<Option<[f64; 3]>, SceneError> {
        let scale = |name: &str| element.number(name, 1.0);
        let nested = |name: &str| element.property(name);
        Ok(Some(match kind {
            "blackbody" => {
                element.ignore(&["wavelength_min", "wavelength_max", "lambda_min", "lambda_max"]);
                let kelvin = element.number("temperature", 6500.0)?;
                if kelvin <= 0.0 {
                    return Err(element.error("the temperature is not positive", "it is in kelvin"));
                }
                // The spectrum is in power per nm, and its luminance is that of a light of the same power per nm.
                let scale = scale("scale")?;
                role.of(&Spectrum::black_body(kelvin)).map(|x| x * scale)
            }
            "uniform" | "rawconstant" => match nested("value")? {
                Some(value) if value.tag() != "float" && value.tag() != "integer" => {
                    return self.nested(element, |import| import.constant(value, role));
                }
                _ => [scale("value")?; 3],
            },
            "d65" | "srgb_d65" | "srgb" | "rgb" => {
                let factor = scale("scale")?;
                match nested("color")?.or(nested("value")?).or(element.children().find(|child| child.tag() == "rgb")) {
                    Some(color) => rgb(color.see())?.map(|x| x * factor),
                    None => [factor; 3],
                }
            }
            "regular" | "irregular" => role.of(&checked(element, sampled(element, kind))?),
            _ => return Ok(None),
        }))
    }
}

/// The spectrum of a `regular` or `irregular`.
fn sampled(element: Element, kind: &str) -> Result<Spectrum, SpectrumError> {
    let list = |name: &str| -> Result<Vec<f64>, SpectrumError> {
        let text = element.text(name).ok().flatten().unwrap_or_default();
        words(text).map(|word| word.parse().map_err(|_| SpectrumError::NotFinite)).collect()
    };
    let number = |name: &str| element.optional_number(name).ok().flatten();
    let values = list("values")?;
    let wavelengths = if kind == "irregular" {
        list("wavelengths")?
    } else {
        let range = list("range")?;
        let first = number("wavelength_min").or(number("lambda_min")).or(range.first().copied()).unwrap_or(360.0);
        let last = number("wavelength_max").or(number("lambda_max")).or(range.get(1).copied()).unwrap_or(830.0);
        let step = (last - first) / values.len().saturating_sub(1).max(1) as f64;
        (0..values.len()).map(|i| first + step * i as f64).collect()
    };
    if wavelengths.len() != values.len() {
        return Err(SpectrumError::TooShort);
    }
    Spectrum::new(wavelengths.into_iter().zip(values).map(|(wavelength, value)| [wavelength, value]).collect())
}

fn checked(element: Element, spectrum: Result<Spectrum, SpectrumError>) -> Result<Spectrum, SceneError> {
    spectrum.map_err(|error| element.error(error.to_string(), "write wavelength:value pairs, such as 400:0.5, 700:0.8"))
}

/// Three numbers, one for all three, or the display values of `#rrggbb`.
fn rgb(element: Element) -> Result<[f64; 3], SceneError> {
    let text = element.value()?.trim();
    if let Some(digits) = text.strip_prefix('#') {
        let number = u32::from_str_radix(digits, 16).ok().filter(|_| digits.len() == 6);
        let number =
            number.ok_or_else(|| element.error(format!("\"{text}\" is not a colour"), "write six digits, such as #ff8000"))?;
        return Ok([16, 8, 0].map(|shift| linear_from_srgb(f64::from(number >> shift & 0xff) / 255.0)));
    }
    let numbers = element.parse_three(text)?;
    Ok(if element.tag() == "srgb" { numbers.map(|x| linear_from_srgb(x.clamp(0.0, 1.0))) } else { numbers })
}
