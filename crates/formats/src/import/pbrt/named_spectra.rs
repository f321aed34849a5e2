//! Spectra that files refer to by name.

/// Indices of refraction at the line d of helium, 587.6 nm (catalogue of Schott).
const GLASSES: [(&str, f64); 10] = [
    ("BK7", 1.5168),
    ("BAF10", 1.67),
    ("FK51A", 1.4866),
    ("LASF9", 1.8503),
    ("SF5", 1.6727),
    ("F5", 1.6727),
    ("SF10", 1.7283),
    ("F10", 1.7283),
    ("SF11", 1.7847),
    ("F11", 1.7847),
];

/// Name, η and k per channel: measured spectra as pbrt tabulates them, integrated against the CIE 1931 observer and converted to linear
/// Rec. 709.
const METALS: [(&str, [f64; 3], [f64; 3]); 7] = [
    ("Ag", [0.155_276, 0.116_728, 0.138_388], [4.828_354, 3.122_222, 2.146_901]),
    ("Al", [1.657_460, 0.880_369, 0.521_229], [9.223_869, 6.269_523, 4.837_001]),
    ("Au", [0.143_119, 0.374_957, 1.442_479], [3.983_160, 2.385_721, 1.603_215]),
    ("Cu", [0.200_438, 0.924_033, 1.102_212], [3.912_949, 2.452_848, 2.142_188]),
    ("CuZn", [0.519_769, 0.488_506, 1.042_010], [4.330_583, 2.548_106, 1.591_891]),
    ("MgO", [2.089_589, 1.650_722, 1.594_876], [0.0, 0.0, 0.0]),
    ("TiO2", [3.456_620, 2.801_708, 2.905_149], [0.000_103, 0.0, 0.000_636]),
];

/// Chromaticities x and y of illuminants (CIE 15:2004; ACES white: SMPTE ST 2065-1).
const ILLUMINANTS: [(&str, [f64; 2]); 16] = [
    ("stdillum-A", [0.447_57, 0.407_45]),
    ("stdillum-D50", [0.345_67, 0.358_5]),
    ("stdillum-D65", [0.312_7, 0.329]),
    ("stdillum-F1", [0.313_1, 0.337_27]),
    ("stdillum-F2", [0.372_08, 0.375_29]),
    ("stdillum-F3", [0.409_1, 0.394_3]),
    ("stdillum-F4", [0.440_18, 0.403_29]),
    ("stdillum-F5", [0.313_79, 0.345_31]),
    ("stdillum-F6", [0.377_9, 0.388_35]),
    ("stdillum-F7", [0.312_92, 0.329_33]),
    ("stdillum-F8", [0.345_88, 0.358_75]),
    ("stdillum-F9", [0.374_17, 0.372_81]),
    ("stdillum-F10", [0.346_09, 0.359_86]),
    ("stdillum-F11", [0.380_52, 0.377_13]),
    ("stdillum-F12", [0.436_95, 0.404_41]),
    ("illum-acesD60", [0.321_68, 0.337_67]),
];

/// The index of refraction of a glass such as `glass-BK7`.
pub fn glass(name: &str) -> Option<f64> {
    let name = name.strip_prefix("glass-")?;
    GLASSES.iter().find(|(known, _)| *known == name).map(|(_, index)| *index)
}

/// η or k of a metal such as `metal-Au-eta`, per channel.
pub fn metal(name: &str) -> Option<[f64; 3]> {
    let (name, part) = name.strip_prefix("metal-")?.rsplit_once('-')?;
    let (_, eta, k) = METALS.iter().find(|(known, ..)| *known == name)?;
    match part {
        "eta" => Some(*eta),
        "k" => Some(*k),
        _ => None,
    }
}

/// x and y of an illuminant such as `stdillum-D65`.
pub fn illuminant(name: &str) -> Option<[f64; 2]> {
    ILLUMINANTS.iter().find(|(known, _)| *known == name).map(|(_, xy)| *xy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_their_values() {
        assert_eq!((glass("glass-BK7"), glass("glass-F11"), glass("BK7")), (Some(1.5168), Some(1.7847), None));
        assert!(
            metal("metal-Au-eta").is_some_and(|[r, _, b]| r < b) && metal("metal-Au-f").is_none() && metal("metal-").is_none()
        );
        assert!(illuminant("stdillum-F12").is_some_and(|[x, y]| x > y) && illuminant("stdillum-F13").is_none());
    }
}
