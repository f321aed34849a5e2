//! Colours of parameters: RGB, spectra, black bodies, named spectra and files.
use super::{
    colour_spaces::of_chromaticity,
    import::Import,
    named_spectra,
    parameters::{Entity, Parameter, Type, Values},
    source::unpacked,
};
use crate::import::spectrum::Spectrum;
use noisefall_base::math::{colour::LUMINANCE, temperature::HOTTEST};
use noisefall_scene::scene::SceneError;

/// Types of colours.
pub const COLOURS: [Type; 3] = [Type::Rgb, Type::Spectrum, Type::Blackbody];

/// Quantity that a spectrum describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// Light. Spectra that are not RGB have luminance 1, as in pbrt, whatever their values.
    Light,
    /// A fraction of light.
    Reflectance,
    /// An index of refraction, or a coefficient.
    Unbounded,
}

impl Role {
    fn of_rgb(self, parameter: &Parameter, rgb: [f64; 3]) -> [f64; 3] {
        match self {
            Role::Light => parameter.space.light(rgb).map(|x| x.max(0.0)),
            Role::Reflectance => parameter.space.reflectance(rgb).map(|x| x.clamp(0.0, 1.0)),
            Role::Unbounded => rgb.map(|x| x.max(0.0)),
        }
    }

    fn of_spectrum(self, spectrum: &Spectrum) -> [f64; 3] {
        match self {
            Role::Light => of_luminance_1(spectrum.emission()),
            Role::Reflectance => spectrum.reflectance(),
            Role::Unbounded => spectrum.index(),
        }
    }
}

/// The luminance of a linear Rec. 709 colour.
pub fn luminance(rgb: [f64; 3]) -> f64 {
    [0, 1, 2].map(|channel| rgb[channel] * f64::from(LUMINANCE[channel])).iter().sum()
}

fn of_luminance_1(rgb: [f64; 3]) -> [f64; 3] {
    let luminance = luminance(rgb);
    if luminance > 0.0 { rgb.map(|x| x / luminance) } else { rgb }
}

impl Import {
    /// A colour parameter that is no texture, if it is given.
    pub fn constant_colour(&mut self, entity: &Entity, name: &str, role: Role) -> Result<Option<[f64; 3]>, SceneError> {
        let Some(parameter) = entity.find(&COLOURS, name) else { return Ok(None) };
        self.colour_of(parameter, role).map(Some)
    }

    /// The colour of a parameter.
    pub fn colour_of(&mut self, parameter: &Parameter, role: Role) -> Result<[f64; 3], SceneError> {
        match (&parameter.values, parameter.of_type) {
            (Values::Texts(_), _) => self.named_colour(parameter, role),
            (_, Type::Rgb) => {
                let numbers = parameter.numbers(3)?;
                Ok(role.of_rgb(parameter, [numbers[0], numbers[1], numbers[2]]))
            }
            (_, Type::Blackbody) => {
                let kelvin = parameter.numbers(1)?[0];
                if !(100.0..=1e9).contains(&kelvin) {
                    return Err(parameter.error("expected a temperature from 100 to 1e9 K"));
                }
                Ok(role.of_spectrum(&Spectrum::black_body(kelvin.min(2.0 * HOTTEST))))
            }
            _ => {
                let numbers = parameter.numbers(1)?;
                if numbers.len() == 1 {
                    return Ok(role.of_rgb(parameter, [numbers[0]; 3]));
                }
                if numbers.len() % 2 == 1 {
                    return Err(parameter.error("expected pairs of wavelength and value"));
                }
                let pairs = numbers.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
                spectrum(parameter, Spectrum::new(pairs)).map(|spectrum| role.of_spectrum(&spectrum))
            }
        }
    }

    fn named_colour(&mut self, parameter: &Parameter, role: Role) -> Result<[f64; 3], SceneError> {
        let name = parameter.text().ok_or_else(|| parameter.error("expected the name of a spectrum"))?;
        if let Some(xy) = named_spectra::illuminant(name) {
            return Ok(of_chromaticity(xy));
        }
        if let Some(colour) = named_spectra::metal(name).or_else(|| named_spectra::glass(name).map(|index| [index; 3])) {
            return Ok(match role {
                Role::Light => of_luminance_1(colour),
                Role::Reflectance => colour.map(|x| x.clamp(0.0, 1.0)),
                Role::Unbounded => colour,
            });
        }
        let wrong = |message: String| {
            parameter.place.error(message, "expected the name of a spectrum of pbrt, or a file in the folder of the scene")
        };
        let folder = &self.files.folder;
        let path = folder.missing.require(folder.resolve(name), wrong)?;
        let key = format!("{role:?} {}", path.display());
        if let Some(known) = self.known_spectra.get(&key) {
            return Ok(*known);
        }
        let (bytes, _room) = unpacked(&path, &self.files.folder).map_err(wrong)?;
        let text = String::from_utf8_lossy(&bytes);
        let colour = role.of_spectrum(&spectrum(parameter, Spectrum::parse(&text))?);
        self.known_spectra.insert(key, colour);
        Ok(colour)
    }
}

fn spectrum<E: std::fmt::Display>(parameter: &Parameter, spectrum: Result<Spectrum, E>) -> Result<Spectrum, SceneError> {
    spectrum.map_err(|error| parameter.place.error(error.to_string(), "expected wavelengths in nm, each with a value"))
}
