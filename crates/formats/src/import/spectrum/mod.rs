//! Colours of spectra: linear Rec. 709 by the CIE 1931 standard observer.
//!
//! An emission of power 1 per nanometre has luminance 1, whatever its unit. A reflectance is seen under D65, so that a constant one
//! keeps its value in all channels.
mod cie;

use self::cie::{D65, FIRST, MATCHING, ROWS, STEP};
use noisefall_base::math::temperature::REC_709;

/// A spectrum by its values at wavelengths in nm, in ascending order; linear between them, and 0 beyond.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectrum(Vec<[f64; 2]>);

/// Why values are no spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SpectrumError {
    /// It has less than two values.
    #[error("a spectrum needs two wavelengths at least")]
    TooShort,
    /// A wavelength is not larger than the one before.
    #[error("the wavelengths of a spectrum must ascend")]
    NotAscending,
    /// A number is infinite or NaN.
    #[error("the numbers of a spectrum must be finite")]
    NotFinite,
    /// A line of a file is not a pair of numbers.
    #[error("line {0} is not a wavelength and a value")]
    BadLine(usize),
}

impl Spectrum {
    /// A spectrum of pairs of wavelength and value.
    pub fn new(pairs: Vec<[f64; 2]>) -> Result<Spectrum, SpectrumError> {
        if pairs.len() < 2 {
            return Err(SpectrumError::TooShort);
        }
        if !pairs.iter().flatten().all(|number| number.is_finite()) {
            return Err(SpectrumError::NotFinite);
        }
        if pairs.windows(2).any(|two| two[1][0] <= two[0][0]) {
            return Err(SpectrumError::NotAscending);
        }
        Ok(Spectrum(pairs))
    }

    /// The spectrum of a text file with a wavelength and a value per line, such as `.spd`. Text after `#` is a comment.
    pub fn parse(text: &str) -> Result<Spectrum, SpectrumError> {
        let mut pairs = Vec::new();
        for (number, line) in text.lines().enumerate() {
            let line = line.split('#').next().unwrap_or_default();
            let mut words = line.split([' ', '\t', ',', ':', '\r']).filter(|word| !word.is_empty()).map(str::parse);
            match (words.next(), words.next(), words.next()) {
                (None, ..) => {}
                (Some(Ok(wavelength)), Some(Ok(value)), None) => pairs.push([wavelength, value]),
                _ => return Err(SpectrumError::BadLine(number + 1)),
            }
        }
        Spectrum::new(pairs)
    }

    /// The spectrum of a black body: its radiance in W/(m² sr nm) at a temperature in kelvin (Planck 1901; constants of CODATA 2018).
    pub fn black_body(kelvin: f64) -> Spectrum {
        const FIRST_RADIATION: f64 = 1.191_042_972e-16;
        const SECOND_RADIATION: f64 = 1.438_776_877e-2;
        let radiance = |nm: f64| {
            let metres = 1e-9 * nm;
            1e-9 * FIRST_RADIATION / (metres.powi(5) * (SECOND_RADIATION / (metres * kelvin)).exp_m1())
        };
        Spectrum((0..ROWS).map(wavelength).map(|nm| [nm, radiance(nm)]).collect())
    }

    /// The value at a wavelength in nm.
    pub fn value(&self, nm: f64) -> f64 {
        let after = self.0.partition_point(|[wavelength, _]| *wavelength <= nm);
        match (after.checked_sub(1).and_then(|before| self.0.get(before)), self.0.get(after)) {
            (Some([x0, y0]), Some([x1, y1])) => y0 + (y1 - y0) * (nm - x0) / (x1 - x0),
            (Some([x, y]), None) if *x == nm => *y,
            _ => 0.0,
        }
    }

    /// The colour of light with this power; out of gamut it is clipped at 0.
    pub fn emission(&self) -> [f64; 3] {
        rgb(self.xyz(|_| 1.0)).map(|x| x.max(0.0))
    }

    /// The colour of a surface with this reflectance, from 0 to 1.
    pub fn reflectance(&self) -> [f64; 3] {
        self.under_d65().map(|x| x.clamp(0.0, 1.0))
    }

    /// The index of refraction per channel.
    pub fn index(&self) -> [f64; 3] {
        self.under_d65().map(|x| x.max(0.0))
    }

    fn under_d65(&self) -> [f64; 3] {
        let white = rgb(integral(|row| D65[row]));
        let seen = rgb(self.xyz(|row| D65[row]));
        [0, 1, 2].map(|channel| seen[channel] / white[channel])
    }

    /// CIE XYZ under an illuminant, with Y = 1 for a constant 1 under a constant illuminant of 1.
    fn xyz(&self, illuminant: impl Fn(usize) -> f64) -> [f64; 3] {
        // Ends between two rows count by the part of the interval that they cover.
        const PARTS: usize = 20;
        let mean = |row: usize| {
            let part = |i: usize| self.value(wavelength(row) + STEP * ((i as f64 + 0.5) / PARTS as f64 - 0.5));
            (0..PARTS).map(part).sum::<f64>() / PARTS as f64
        };
        integral(|row| illuminant(row) * mean(row))
    }
}

/// The colour of light whose power is 1 at all wavelengths; its luminance is 1.
pub fn equal_energy() -> [f64; 3] {
    rgb(integral(|_| 1.0))
}

fn wavelength(row: usize) -> f64 {
    FIRST + STEP * row as f64
}

/// ∫ x̄ f dλ and so on, divided by ∫ ȳ dλ.
fn integral(f: impl Fn(usize) -> f64) -> [f64; 3] {
    let sum = |channel: usize| MATCHING.iter().enumerate().map(|(row, matching)| matching[channel] * f(row)).sum::<f64>();
    let norm: f64 = MATCHING.iter().map(|matching| matching[1]).sum();
    [0, 1, 2].map(|channel| sum(channel) / norm)
}

fn rgb(xyz: [f64; 3]) -> [f64; 3] {
    REC_709.map(|row| row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: [f64; 3], expected: [f64; 3], tolerance: f64) -> bool {
        found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() <= tolerance)
    }

    fn flat(value: f64) -> Spectrum {
        Spectrum::new(vec![[300.0, value], [900.0, value]]).expect("it ascends")
    }

    #[test]
    fn a_constant_reflectance_is_grey_and_a_constant_emission_is_equal_energy() {
        assert!(near(flat(0.78).reflectance(), [0.78; 3], 1e-9), "{:?}", flat(0.78).reflectance());
        // Illuminant E has the XYZ (1, 1, 1).
        assert!(near(flat(2.0).emission(), [2.4096, 1.8966, 1.8178], 0.01), "{:?}", flat(2.0).emission());
        assert!(near(equal_energy(), [1.2048, 0.9483, 0.9089], 0.005), "{:?}", equal_energy());
    }

    #[test]
    fn light_of_d65_is_white() {
        let light = Spectrum((0..ROWS).map(|row| [wavelength(row), D65[row]]).collect()).emission();
        assert!(near(light.map(|x| x / light[1]), [1.0; 3], 0.003), "{light:?}");
    }

    #[test]
    fn a_black_body_has_the_colour_of_its_temperature() {
        use noisefall_base::math::temperature::temperature;
        for kelvin in [2800.0, 5000.0, 9000.0] {
            let found = temperature(Spectrum::black_body(kelvin).emission()).expect("it is near the locus");
            assert!((found / kelvin - 1.0).abs() < 0.03, "{kelvin} K: {found}");
        }
        // Planck's law at 5000 K and 555 nm is 1.274·10⁴ W/(m² sr nm).
        let radiance = Spectrum::black_body(5000.0).value(555.0);
        assert!((radiance / 1.274e4 - 1.0).abs() < 0.01, "{radiance}");
    }

    #[test]
    fn values_are_linear_between_and_zero_beyond() {
        let spectrum = Spectrum::parse("# a light\n400 0\n500 8 # green\n\n600\t4\r\n").expect("it is valid");
        assert_eq!([399.0, 400.0, 450.0, 550.0, 600.0, 601.0].map(|nm| spectrum.value(nm)), [0.0, 0.0, 4.0, 6.0, 4.0, 0.0]);
    }

    #[test]
    fn an_invalid_spectrum_is_an_error() {
        let error = |text: &str| Spectrum::parse(text).expect_err("it is wrong");
        assert_eq!(error("400 1"), SpectrumError::TooShort);
        assert_eq!(error("400 1\n400 2"), SpectrumError::NotAscending);
        assert_eq!(error("400 1\n500 NaN"), SpectrumError::NotFinite);
        assert_eq!(error("400 1\n500"), SpectrumError::BadLine(2));
        assert_eq!(error("400 1 2"), SpectrumError::BadLine(1));
    }
}
