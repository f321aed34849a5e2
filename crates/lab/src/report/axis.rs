//! Axes of plots: their range and their labels.
use std::ops::Range;

use plotters::coord::{
    ranged1d::{DefaultFormatting, KeyPointHint, Ranged},
    types::RangedCoordf64,
};

/// Maximum number of labels on an axis.
const MOST_TICKS: usize = 8;

/// An axis; values on a logarithmic axis must be positive.
#[derive(Clone, Copy)]
pub struct Axis {
    /// The quantity with its unit.
    pub label: &'static str,
    /// Whether the scale is logarithmic.
    pub log: bool,
}

impl Axis {
    /// An axis with a linear scale.
    pub fn linear(label: &'static str) -> Axis {
        Axis { label, log: false }
    }

    /// An axis with a logarithmic scale.
    pub fn log(label: &'static str) -> Axis {
        Axis { label, log: true }
    }

    pub(super) fn place(self, x: f64) -> f64 {
        if self.log { x.max(1e-300).log10() } else { x }
    }

    pub(super) fn text(self, place: f64) -> String {
        let value = if self.log { 10f64.powf(place) } else { place };
        let size = value.abs();
        if !(0.001..10_000.0).contains(&size) && size > 0.0 {
            return format!("{value:.0e}");
        }
        // Digits that count: neighbouring labels of a linear axis may differ in the fifth.
        let count = if self.log { 2.0 } else { 4.0 };
        let digits = if size > 0.0 { (count - size.log10().floor()).max(0.0) as usize } else { 0 };
        let text = format!("{value:.digits$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    }

    /// Positions of the labels in a range: on a logarithmic axis at powers of ten, and at 2 and 5 times these if there is space.
    fn ticks(self, range: &Range<f64>) -> Vec<f64> {
        let even = RangedCoordf64::from(range.clone()).key_points(MOST_TICKS);
        if !self.log {
            return even;
        }
        let decades = (range.start.floor() as i32)..=(range.end.ceil() as i32);
        let within = |mantissas: &[f64]| -> Vec<f64> {
            let places = decades.clone().flat_map(|decade| mantissas.iter().map(move |m| f64::from(decade) + m.log10()));
            places.filter(|place| range.contains(place)).collect()
        };
        let candidates = [within(&[1.0, 2.0, 5.0]), within(&[1.0])];
        candidates.into_iter().find(|places| (2..=MOST_TICKS).contains(&places.len())).unwrap_or(even)
    }

    /// The range of positions with a margin; an arbitrary range if there are no values.
    pub(super) fn range(self, values: impl Iterator<Item = f64>) -> Range<f64> {
        let (min, max) =
            values.filter(|x| x.is_finite()).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        if min > max {
            return 0.0..1.0;
        }
        let margin = if max > min { (max - min) * 0.06 } else { min.abs().max(1.0) * 0.1 };
        min - margin..max + margin
    }
}

/// The positions of an axis, with our own choice of labels.
pub(super) struct AxisScale {
    places: RangedCoordf64,
    pub(super) ticks: Vec<f64>,
}

impl AxisScale {
    pub(super) fn new(axis: Axis, range: Range<f64>) -> AxisScale {
        AxisScale { ticks: axis.ticks(&range), places: range.into() }
    }
}

impl Ranged for AxisScale {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, place: &f64, pixels: (i32, i32)) -> i32 {
        self.places.map(place, pixels)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.ticks.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.places.range()
    }
}
