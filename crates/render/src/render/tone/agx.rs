//! AgX by T. Sobotka (2022): bright saturated colours fade to white, as on film.
//!
//! The primaries and the range are those of Blender's configuration, as Filament and three.js use them: light in Rec. 2020 is mixed
//! towards grey, encoded by log₂, and mapped by a sigmoid; then the mixing is undone. The sigmoid is the polynomial of degree 6 that
//! B. Wrensch fitted to it ("Minimal AgX Implementation", 2023; mean squared error 3.7 · 10⁻⁶).
use super::{Rows, Tone};
use noisefall_base::declare::Word;

pub(super) struct Agx;

/// From linear Rec. 709 to linear Rec. 2020 (ITU-R BT.2087-0).
const REC_2020: Rows = [
    [0.627_403_9, 0.329_283_04, 0.043_313_066],
    [0.069_097_29, 0.919_540_4, 0.011_362_316],
    [0.016_391_44, 0.088_013_31, 0.895_595_25],
];
/// The inverse.
const REC_709: Rows = [
    [1.660_491, -0.587_641_1, -0.072_849_86],
    [-0.124_550_48, 1.132_899_9, -0.008_349_423],
    [-0.018_150_763, -0.100_578_9, 1.118_729_7],
];
/// Mixes the channels, so that each sees some light of the others.
const INSET: Rows = [
    [0.856_627_15, 0.095_121_24, 0.048_251_606],
    [0.137_318_97, 0.761_242, 0.101_439_04],
    [0.111_898_21, 0.076_799_42, 0.811_302_37],
];
/// Undoes another mixing, which is a little weaker.
const OUTSET: Rows = [
    [1.127_100_6, -0.110_606_64, -0.016_493_939],
    [-0.141_329_76, 1.157_823_7, -0.016_493_939],
    [-0.141_329_76, -0.110_606_64, 1.251_936_4],
];
/// The encoded range in stops relative to 1.
const STOPS: [f32; 2] = [-12.473_93, 4.026_069];
/// Coefficients of the sigmoid from degree 6 down.
const SIGMOID: [f32; 7] = [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.002_32];
/// Exponent of the display that the sigmoid encodes for.
const GAMMA: f32 = 2.2;

impl Tone for Agx {
    const WORD: Word = Word {
        name: "agx",
        title: "AgX",
        doc: "A filmic curve with a wide range. Bright colours fade to white and keep their hue.",
    };

    fn map(radiance: [f32; 3]) -> [f32; 3] {
        let codes = mixed(&INSET, mixed(&REC_2020, radiance)).map(curve);
        let display = mixed(&OUTSET, codes);
        mixed(&REC_709, display.map(|c| c.max(0.0).powf(GAMMA)))
    }
}

/// A matrix whose rows add up to 1, times a colour: grey stays the same, bit for bit.
fn mixed(rows: &Rows, [r, g, b]: [f32; 3]) -> [f32; 3] {
    rows.map(|row| g + row[0] * (r - g) + row[2] * (b - g))
}

/// The display code of a channel of light.
fn curve(light: f32) -> f32 {
    let stops = light.max(1e-10).log2();
    let x = ((stops - STOPS[0]) / (STOPS[1] - STOPS[0])).clamp(0.0, 1.0);
    SIGMOID.iter().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_colours_are_those_of_the_formulas() {
        // Computed with 64 bits from the published constants.
        for (radiance, exact) in [
            ([0.18; 3], [0.214_519; 3]),
            ([1.0; 3], [0.590_159; 3]),
            ([16.0; 3], [0.995_108; 3]),
            ([1.0, 0.0, 0.0], [0.723_267, 0.105_864, 0.066_756]),
            ([0.0, 1.0, 0.0], [0.234_942, 0.584_565, 0.130_403]),
            ([0.0, 0.0, 1.0], [0.033_967, 0.135_514, 0.730_005]),
        ] {
            let found = Agx::map(radiance);
            assert!(found.iter().zip(exact).all(|(a, b)| (a - b).abs() < 2e-5), "{radiance:?}: {found:?}");
        }
    }

    #[test]
    fn bright_colours_fade_to_white() {
        let [r, g, b] = Agx::map([0.0, 0.0, 100.0]);
        assert!(r > 0.9 && g > 0.9 && b > 0.9, "{r} {g} {b}");
    }
}
