//! Colours of black bodies by temperature, and the temperature of a colour.
use std::sync::LazyLock;

use super::colour::luminance;

/// Kelvin. Light of less than 2000 K leaves the gamut of Rec. 709.
pub const COLDEST: f64 = 2000.0;
/// Kelvin. Hotter bodies look the same.
pub const HOTTEST: f64 = 40_000.0;

/// Colours farther than this from every black body have no temperature (CIE 1960 u, v; CIE 15:2018, section 9.4).
const FARTHEST: f64 = 0.05;

/// Second radiation constant, nm K (CODATA 2018).
const C_2: f64 = 1.438_776_877e7;

/// Wavelengths from 380 to 780 nm, with the CIE 1931 colour matching functions there.
static MATCHING: LazyLock<Vec<(f64, [f64; 3])>> = LazyLock::new(|| {
    let wavelengths = (0..=80).map(|step| 380.0 + 5.0 * f64::from(step));
    wavelengths.map(|wavelength| (wavelength, matching(wavelength))).collect()
});

/// From CIE XYZ to linear Rec. 709, row by row (IEC 61966-2-1).
pub const REC_709: [[f64; 3]; 3] =
    [[3.240_454_2, -1.537_138_5, -0.498_531_4], [-0.969_266, 1.876_010_8, 0.041_556], [0.055_643_4, -0.204_025_9, 1.057_225_2]];

/// From linear Rec. 709 to CIE XYZ, row by row.
pub const XYZ: [[f64; 3]; 3] =
    [[0.412_456_4, 0.357_576_1, 0.180_437_5], [0.212_672_9, 0.715_152_2, 0.072_175], [0.019_333_9, 0.119_192, 0.950_304_1]];

/// The linear Rec. 709 colour of a black body, with luminance 1.
pub fn black_body(kelvin: f64) -> [f64; 3] {
    let rgb = times(&REC_709, planck(kelvin)).map(|x| x.max(0.0));
    let y = f64::from(luminance(rgb.map(|x| x as f32)));
    rgb.map(|x| x / y)
}

/// The correlated colour temperature of a linear Rec. 709 colour: that of the nearest black body in CIE 1960 u, v. `None` if none is
/// near.
pub fn temperature(rgb: [f64; 3]) -> Option<f64> {
    let colour = uv(times(&XYZ, rgb))?;
    let distance = |mired: f64| {
        let [u, v] = uv(times(&XYZ, black_body(1e6 / mired))).unwrap_or([f64::INFINITY; 2]);
        (u - colour[0]).hypot(v - colour[1])
    };
    let mired = least(distance, [1e6 / HOTTEST, 1e6 / COLDEST]);
    (distance(mired) <= FARTHEST).then_some(1e6 / mired)
}

/// The CIE XYZ of a black body, up to a factor (Planck 1901).
pub fn planck(kelvin: f64) -> [f64; 3] {
    let radiance = |nm: f64| (560.0 / nm).powi(5) / (C_2 / (nm * kelvin)).exp_m1();
    MATCHING.iter().fold([0.0; 3], |sum, (nm, weights)| {
        let radiance = radiance(*nm);
        [0, 1, 2].map(|i| sum[i] + weights[i] * radiance)
    })
}

/// The CIE 1931 colour matching functions by Wyman, Sloan and Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching
/// Functions", JCGT 2(2), 2013.
pub fn matching(nm: f64) -> [f64; 3] {
    let lobe = |weight: f64, middle: f64, [left, right]: [f64; 2]| {
        let t = (nm - middle) / if nm < middle { left } else { right };
        weight * (-0.5 * t * t).exp()
    };
    [
        lobe(1.056, 599.8, [37.9, 31.0]) + lobe(0.362, 442.0, [16.0, 26.7]) - lobe(0.065, 501.1, [20.4, 26.2]),
        lobe(0.821, 568.8, [46.9, 40.5]) + lobe(0.286, 530.9, [16.3, 31.1]),
        lobe(1.217, 437.0, [11.8, 36.0]) + lobe(0.681, 459.0, [26.0, 13.8]),
    ]
}

/// A matrix times a vector.
pub fn times(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// The CIE 1960 chromaticity u, v of a colour in CIE XYZ; `None` of black.
pub fn uv([x, y, z]: [f64; 3]) -> Option<[f64; 2]> {
    let sum = x + 15.0 * y + 3.0 * z;
    (sum > 0.0 && sum.is_finite()).then(|| [4.0 * x / sum, 6.0 * y / sum])
}

/// The place of the minimum of a function with one minimum, by golden sections.
fn least(f: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    const STEPS: u32 = 40;
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    let [mut a, mut b] = [high - ratio * (high - low), low + ratio * (high - low)];
    let [mut f_a, mut f_b] = [f(a), f(b)];
    for _ in 0..STEPS {
        if f_a < f_b {
            (high, b, f_b) = (b, a, f_a);
            a = high - ratio * (high - low);
            f_a = f(a);
        } else {
            (low, a, f_a) = (a, b, f_b);
            b = low + ratio * (high - low);
            f_b = f(b);
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CIE 1931 x and y of a linear Rec. 709 colour.
    fn xy(rgb: [f64; 3]) -> [f64; 2] {
        let [x, y, z] = times(&XYZ, rgb);
        [x / (x + y + z), y / (x + y + z)]
    }

    #[test]
    fn black_bodies_lie_on_the_planckian_locus() {
        // CIE 15:2018: illuminant A; the locus at 6500 K and 10000 K by Wyszecki and Stiles 1982, table 1(3.11).
        for (kelvin, [x, y]) in [(2855.5, [0.4476, 0.4074]), (6500.0, [0.3135, 0.3237]), (10_000.0, [0.2807, 0.2884])] {
            let found = xy(black_body(kelvin));
            assert!((found[0] - x).abs() < 2e-3 && (found[1] - y).abs() < 2e-3, "{kelvin} K: {found:?}");
        }
    }

    #[test]
    fn all_black_bodies_have_luminance_one_within_the_gamut() {
        for kelvin in [COLDEST, 2700.0, 5000.0, HOTTEST] {
            let rgb = black_body(kelvin);
            assert!(rgb.iter().all(|x| *x > 0.0), "{kelvin} K: {rgb:?}");
            assert!((luminance(rgb.map(|x| x as f32)) - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn the_temperature_of_a_black_body_is_its_own_at_any_brightness() {
        for kelvin in [2100.0, 2700.0, 4000.0, 6504.0, 12_000.0, 30_000.0] {
            let found = temperature(black_body(kelvin).map(|x| 37.0 * x)).expect("it is on the locus");
            assert!((found / kelvin - 1.0).abs() < 1e-4, "{kelvin} K: {found}");
        }
    }

    #[test]
    fn white_is_daylight_and_green_and_black_have_no_temperature() {
        let white = temperature([1.0; 3]).expect("it is near");
        assert!((white - 6504.0).abs() < 60.0, "{white}");
        assert_eq!([[0.0, 1.0, 0.0], [0.0; 3], [1.0, 0.0, 1.0]].map(temperature), [None; 3]);
    }
}
