//! Legends of views.
use super::{
    DisplaySettings, Field, Sources, View,
    field::{category, map_of},
};
use crate::render::colour_map::ColourMap;

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

/// Maximum number of names.
const MOST_ENTRIES: usize = 10;

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

impl Legend {
    pub(super) fn of(settings: DisplaySettings, sources: &Sources, field: &Field) -> Legend {
        let view = settings.view;
        let title = match field {
            Field::Missing => missing(view),
            _ => view.name(),
        };
        let mut legend = Legend { title: title.to_owned(), scale: None, entries: Vec::new() };
        match (view, field) {
            (View::Materials, Field::Colours(_)) => legend.entries = materials(sources),
            (_, Field::Numbers(numbers)) => {
                legend.scale = sources.scale.or_else(|| Some(scale(view, numbers, map_of(view, settings.map))));
            }
            _ => {}
        }
        legend
    }
}

/// Advice for a view without data.
fn missing(view: View) -> &'static str {
    match view {
        View::ZScore => {
            "No truth for this: open a scene with [truth] at its own camera (Home), or drop a reference EXR of this size"
        }
        View::Difference => {
            "Nothing of this size to hold it against yet: the first sample of B, or a picture pinned below Display"
        }
        _ => "Coming …",
    }
}

fn scale(view: View, numbers: &[f32], map: ColourMap) -> Scale {
    let (ends, log, unit) = match view {
        View::ZScore => ([-4.0, 4.0], false, "σ"),
        View::Difference => (around(numbers), false, "parts of the pinned one, or of B"),
        View::SampleCount => ([0.0, numbers.iter().copied().fold(1.0, f32::max)], false, "samples"),
        View::StandardError => (decades(numbers), true, "W/(sr·m²)"),
        View::HitCost => ([0.0, round_up(part_below(numbers, 0.99))], false, "ns a ray"),
        _ => ([0.0, round_up(part_below(numbers, 1.0))], false, "m"),
    };
    Scale { map, ends, log, unit }
}

/// The quantile of the finite numbers.
fn part_below(numbers: &[f32], part: f64) -> f32 {
    let mut finite: Vec<f32> = numbers.iter().copied().filter(|x| x.is_finite()).collect();
    if finite.is_empty() {
        return 1.0;
    }
    let place = ((finite.len() - 1) as f64 * part) as usize;
    *finite.select_nth_unstable_by(place, f32::total_cmp).1
}

/// The next larger of 1, 2 and 5 times a power of ten, so that the scale stays as it is while numbers change a little.
fn round_up(x: f32) -> f32 {
    let x = x.max(1e-30);
    let decade = 10f32.powf(x.log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|m| m * decade).find(|candidate| *candidate >= x * 0.999).unwrap_or(10.0 * decade)
}

/// Powers of ten, from a thousandth to one, around nearly all numbers.
fn around(numbers: &[f32]) -> [f32; 2] {
    let sizes: Vec<f32> = numbers.iter().map(|x| x.abs()).collect();
    let end = 10f32.powf(part_below(&sizes, 0.98).max(1e-3).log10().ceil().min(0.0));
    [-end, end]
}

/// Powers of ten around all but the outermost of the positive numbers, at least two decades.
fn decades(numbers: &[f32]) -> [f32; 2] {
    let positive: Vec<f32> = numbers.iter().copied().filter(|x| *x > 0.0).collect();
    if positive.is_empty() {
        return [0.01, 1.0];
    }
    let high = part_below(&positive, 0.99).log10().ceil();
    let low = part_below(&positive, 0.02).log10().floor().min(high - 2.0).max(high - 6.0);
    [10f32.powf(low), 10f32.powf(high)]
}

/// The visible materials, largest area first.
fn materials(sources: &Sources) -> Vec<([u8; 3], String)> {
    let Some(features) = sources.features else { return Vec::new() };
    let mut seen = vec![0usize; sources.materials.len()];
    features.material.iter().for_each(|id| seen.get_mut(*id as usize).into_iter().for_each(|count| *count += 1));
    let mut ids: Vec<usize> = (0..seen.len()).filter(|id| seen[*id] > 0).collect();
    ids.sort_by_key(|id| std::cmp::Reverse(seen[*id]));
    ids.into_iter().take(MOST_ENTRIES).map(|id| (category(id as u32), sources.materials[id].clone())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_numbers_are_inverse_and_ends_are_round() {
        let log = Scale { map: ColourMap::Viridis, ends: [0.01, 100.0], log: true, unit: "" };
        assert!((log.place(1.0) - 0.5).abs() < 1e-6 && (log.number(0.25) - 0.1).abs() < 1e-6);
        let linear = Scale { ends: [-4.0, 4.0], log: false, ..log };
        assert_eq!((linear.place(-9.0), linear.place(0.0), linear.number(0.75)), (0.0, 0.5, 2.0));
        assert_eq!([0.9, 1.0, 1.2, 3.0, 700.0].map(round_up), [1.0, 1.0, 2.0, 5.0, 1000.0]);
        assert_eq!(decades(&[0.0, f32::NAN]), [0.01, 1.0]);
        assert_eq!([around(&[-0.05, 0.02]), around(&[5.0, -7.0]), around(&[0.0])], [[-0.1, 0.1], [-1.0, 1.0], [-0.001, 0.001]]);
        assert_eq!(decades(&[0.02, 0.5, 30.0, 0.3]), [0.01, 1.0]);
    }
}
