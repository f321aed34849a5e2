//! Colour maps for numbers, suitable for colour-blind readers: lightness increases with the number, or away from the middle.
use serde::Serialize;

/// A scale of colours for numbers from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum ColourMap {
    /// From violet to yellow (S. van der Walt and N. Smith, 2015).
    #[default]
    Viridis,
    /// From blue to yellow, made for readers with red-green deficiency (J. Nuñez, C. Anderton and R. Renslow, 2018).
    Cividis,
    /// From blue through near black to orange: for numbers with a sign.
    Diverging,
}

/// Equidistant points of a map, linear between them; 8-bit sRGB.
type Points = [[f32; 3]; 9];

const VIRIDIS: Points = [
    [68.0, 1.0, 84.0],
    [72.0, 40.0, 120.0],
    [62.0, 74.0, 137.0],
    [49.0, 104.0, 142.0],
    [38.0, 130.0, 142.0],
    [31.0, 158.0, 137.0],
    [53.0, 183.0, 121.0],
    [143.0, 215.0, 68.0],
    [253.0, 231.0, 37.0],
];

const CIVIDIS: Points = [
    [0.0, 34.0, 78.0],
    [18.0, 53.0, 112.0],
    [59.0, 73.0, 108.0],
    [87.0, 93.0, 109.0],
    [112.0, 113.0, 115.0],
    [138.0, 134.0, 120.0],
    [165.0, 156.0, 116.0],
    [195.0, 179.0, 105.0],
    [254.0, 232.0, 56.0],
];

/// The blue and the orange of M. Okabe and K. Ito, "Color Universal Design" (2008), lightened towards the ends.
const DIVERGING: Points = [
    [170.0, 216.0, 250.0],
    [86.0, 180.0, 233.0],
    [0.0, 114.0, 178.0],
    [6.0, 62.0, 96.0],
    [24.0, 24.0, 26.0],
    [98.0, 44.0, 8.0],
    [190.0, 84.0, 0.0],
    [236.0, 146.0, 20.0],
    [255.0, 214.0, 140.0],
];

impl ColourMap {
    /// The maps for unsigned numbers, each with one sentence for the window.
    pub const CHOICE: [(ColourMap, &'static str, &'static str); 2] = [
        (ColourMap::Viridis, "Viridis", "Violet to yellow, evenly lighter: readable in grey and with any colour vision."),
        (ColourMap::Cividis, "Cividis", "Blue to yellow: looks the same with red-green deficiency."),
    ];

    /// The colour of a number from 0 to 1, in 8-bit sRGB. NaN is grey.
    pub fn of(self, at: f32) -> [u8; 3] {
        if at.is_nan() {
            return [96; 3];
        }
        let points = match self {
            ColourMap::Viridis => &VIRIDIS,
            ColourMap::Cividis => &CIVIDIS,
            ColourMap::Diverging => &DIVERGING,
        };
        let place = at.clamp(0.0, 1.0) * (points.len() - 1) as f32;
        let i = (place as usize).min(points.len() - 2);
        let t = place - i as f32;
        std::array::from_fn(|c| (points[i][c] + (points[i + 1][c] - points[i][c]) * t).round() as u8)
    }

    /// The map at 256 equidistant points, opaque.
    pub fn table(self) -> [[u8; 4]; 256] {
        std::array::from_fn(|i| {
            let [r, g, b] = self.of(i as f32 / 255.0);
            [r, g, b, 255]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::colour::{linear_from_srgb, luminance};

    fn lightness(colour: [u8; 3]) -> f32 {
        luminance(colour.map(|c| linear_from_srgb(f64::from(c) / 255.0) as f32))
    }

    #[test]
    fn lightness_rises_all_the_way() {
        for (map, name, _) in ColourMap::CHOICE {
            let values: Vec<f32> = (0..=64).map(|i| lightness(map.of(i as f32 / 64.0))).collect();
            assert!(values.windows(2).all(|pair| pair[0] < pair[1]), "{name}: {values:?}");
        }
        let away = |i: i32| lightness(ColourMap::Diverging.of(0.5 + i as f32 / 64.0));
        assert!((0..32).all(|i| away(i) < away(i + 1) && away(-i) < away(-i - 1)));
    }

    #[test]
    fn nan_is_grey_and_the_ends_are_kept() {
        assert_eq!(ColourMap::Viridis.of(f32::NAN), [96; 3]);
        assert_eq!([f32::NEG_INFINITY, 7.0].map(|x| ColourMap::Viridis.of(x)), [[68, 1, 84], [253, 231, 37]]);
    }
}
