//! Legends of views.
use crate::render::{
    colour_map::ColourMap,
    tone::{Display, false_colour_range},
};

/// The legend of a view.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// The quantity, or why it is missing.
    pub title: String,
    /// The scale of numbers, if any.
    pub scale: Option<Scale>,
    /// Colours by name, 8-bit sRGB.
    pub entries: Vec<([u8; 3], String)>,
}

/// A scale of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// The colours along the scale.
    pub map: ColourMap,
    /// The numbers at its ends.
    pub ends: [f32; 2],
    /// Whether the scale is logarithmic.
    pub log: bool,
    /// The unit of the numbers.
    pub unit: &'static str,
}

impl Scale {
    /// The position of a number, from 0 to 1.
    pub fn place(&self, x: f32) -> f32 {
        let [low, high] = self.ends;
        let place = if self.log { (x.max(f32::MIN_POSITIVE) / low).ln() / (high / low).ln() } else { (x - low) / (high - low) };
        place.clamp(0.0, 1.0)
    }

    /// The number at a position from 0 to 1.
    pub fn number(&self, place: f32) -> f32 {
        let [low, high] = self.ends;
        if self.log { low * (high / low).powf(place) } else { low + (high - low) * place }
    }
}

/// The legend of radiance in false colours; `None` with another tone map.
pub(super) fn false_colours(title: &str, display: Display) -> Option<Legend> {
    let ends = false_colour_range(display)?;
    let scale = Scale { map: ColourMap::Viridis, ends, log: true, unit: "W·sr⁻¹·m⁻²" };
    Some(Legend { title: title.to_owned(), scale: Some(scale), entries: Vec::new() })
}

/// The quantile of the finite numbers.
pub(super) fn part_below(numbers: &[f32], part: f64) -> f32 {
    let mut finite: Vec<f32> = numbers.iter().copied().filter(|x| x.is_finite()).collect();
    if finite.is_empty() {
        return 1.0;
    }
    let place = ((finite.len() - 1) as f64 * part) as usize;
    *finite.select_nth_unstable_by(place, f32::total_cmp).1
}

/// The next larger of 1, 2 and 5 times a power of ten, so that the scale stays as it is while numbers change a little.
pub(super) fn round_up(x: f32) -> f32 {
    let x = x.max(1e-30);
    let decade = 10f32.powf(x.log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|m| m * decade).find(|candidate| *candidate >= x * 0.999).unwrap_or(10.0 * decade)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::tone::ToneMap;

    #[test]
    fn false_colours_have_a_legend_in_the_light_of_the_scene() {
        let display = |exposure, tone_map| Display { exposure, tone_map, ..Display::default() };
        let legend = false_colours("Luminance", display(1.0, ToneMap::FalseColour)).expect("it has one");
        assert!(legend.scale.is_some_and(|scale| scale.ends == [0.5e-3, 500.0] && scale.log));
        assert_eq!(false_colours("Luminance", display(1.0, ToneMap::None)), None);
    }

    #[test]
    fn places_and_numbers_are_inverse_and_ends_are_round() {
        let log = Scale { map: ColourMap::Viridis, ends: [0.01, 100.0], log: true, unit: "" };
        assert!((log.place(1.0) - 0.5).abs() < 1e-6 && (log.number(0.25) - 0.1).abs() < 1e-6);
        let linear = Scale { ends: [-4.0, 4.0], log: false, ..log };
        assert_eq!((linear.place(-9.0), linear.place(0.0), linear.number(0.75)), (0.0, 0.5, 2.0));
        assert_eq!([0.9, 1.0, 1.2, 3.0, 700.0].map(round_up), [1.0, 1.0, 2.0, 5.0, 1000.0]);
        assert!(round_up(0.0) > 0.0, "the ends of a scale differ");
    }
}
