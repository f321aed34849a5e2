//! Colour spaces of RGB values, as matrices to linear Rec. 709.
use glam::{DMat3, DVec3};

use noisefall_base::math::temperature::REC_709;

/// A colour space by its name in files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColourSpace {
    #[default]
    Srgb,
    DciP3,
    Rec2020,
    Aces,
}

/// CIE x and y of red, green, blue and white.
type Chromaticities = [[f64; 2]; 4];

const D65: [f64; 2] = [0.3127, 0.329];
/// SMPTE RP 431-2, with the white of sRGB.
const DCI_P3: Chromaticities = [[0.68, 0.32], [0.265, 0.69], [0.15, 0.06], D65];
/// ITU-R BT.2020.
const REC_2020: Chromaticities = [[0.708, 0.292], [0.17, 0.797], [0.131, 0.046], D65];
/// SMPTE ST 2065-1.
const ACES: Chromaticities = [[0.7347, 0.2653], [0.0, 1.0], [0.0001, -0.077], [0.32168, 0.33767]];

impl ColourSpace {
    /// The colour space with a name.
    pub fn named(name: &str) -> Option<ColourSpace> {
        Some(match name {
            "srgb" => ColourSpace::Srgb,
            "dci-p3" => ColourSpace::DciP3,
            "rec2020" => ColourSpace::Rec2020,
            "aces2065-1" => ColourSpace::Aces,
            _ => return None,
        })
    }

    /// The linear Rec. 709 of light with this RGB; not clipped.
    pub fn light(self, rgb: [f64; 3]) -> [f64; 3] {
        match self.chromaticities() {
            None => rgb,
            Some(space) => (rec_709() * xyz_from_rgb(space) * DVec3::from(rgb)).into(),
        }
    }

    /// The linear Rec. 709 of a surface with this RGB: white stays white.
    pub fn reflectance(self, rgb: [f64; 3]) -> [f64; 3] {
        let white = self.light([1.0; 3]);
        let found = self.light(rgb);
        [0, 1, 2].map(|channel| found[channel] / white[channel])
    }

    fn chromaticities(self) -> Option<Chromaticities> {
        match self {
            ColourSpace::Srgb => None,
            ColourSpace::DciP3 => Some(DCI_P3),
            ColourSpace::Rec2020 => Some(REC_2020),
            ColourSpace::Aces => Some(ACES),
        }
    }
}

/// The linear Rec. 709 of light with a chromaticity and luminance 1, clipped at 0.
pub fn of_chromaticity(xy: [f64; 2]) -> [f64; 3] {
    (rec_709() * xyz(xy)).max(DVec3::ZERO).into()
}

fn rec_709() -> DMat3 {
    DMat3::from_cols_array_2d(&REC_709).transpose()
}

/// XYZ with luminance 1.
fn xyz([x, y]: [f64; 2]) -> DVec3 {
    DVec3::new(x / y, 1.0, (1.0 - x - y) / y)
}

fn xyz_from_rgb([red, green, blue, white]: Chromaticities) -> DMat3 {
    let column = |[x, y]: [f64; 2]| DVec3::new(x, y, 1.0 - x - y);
    let primaries = DMat3::from_cols(column(red), column(green), column(blue));
    primaries * DMat3::from_diagonal(primaries.inverse() * xyz(white))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_of_d65_is_white_in_all_spaces() {
        for space in [ColourSpace::Srgb, ColourSpace::DciP3, ColourSpace::Rec2020] {
            let white = space.light([1.0; 3]);
            assert!(white.iter().all(|x| (x - 1.0).abs() < 2e-3), "{space:?}: {white:?}");
        }
        assert!(ColourSpace::Aces.reflectance([0.5; 3]).iter().all(|x| (x - 0.5).abs() < 1e-12));
        assert!(of_chromaticity(D65).iter().all(|x| (x - 1.0).abs() < 2e-3));
    }

    #[test]
    fn wide_red_lies_outside_of_rec_709() {
        // ITU-R BT.2087: the first column of the matrix from BT.2020 to BT.709.
        let [r, g, b] = ColourSpace::Rec2020.light([1.0, 0.0, 0.0]);
        assert!((r - 1.6605).abs() < 2e-3 && (g + 0.1246).abs() < 2e-3 && (b + 0.0182).abs() < 2e-3, "{r} {g} {b}");
    }
}
