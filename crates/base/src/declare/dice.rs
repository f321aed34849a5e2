//! Draws random values within their ranges, their ends more often than by chance.
use glam::DVec3;
use rand::{Rng, RngCore};

use super::{Choice, Parameter, Parameters, Range, SliderScale, Textured, Value};

/// The visitor that draws. Names stay as they are; lists get up to three items.
pub struct Dice<'r> {
    random: &'r mut dyn RngCore,
}

impl<'r> Dice<'r> {
    /// Draws from this source of random numbers.
    pub fn new(random: &'r mut dyn RngCore) -> Dice<'r> {
        Dice { random }
    }

    /// Draws an end of a range one time in eight, otherwise a number between the ends.
    fn number(&mut self, range: &Range) -> f64 {
        // Ranges wider than any scene are narrowed to the size of scenes.
        let (least, most) = (range.least.max(-1e9), range.most.min(1e9));
        match self.random.random_range(0..16) {
            0 => least,
            1 => most,
            _ if range.scale == SliderScale::Log => {
                let lowest = if least > 0.0 { least } else { most * 1e-9 };
                (lowest.ln() + self.random.random::<f64>() * (most / lowest).ln()).exp().clamp(least, most)
            }
            _ => least + self.random.random::<f64>() * (most - least),
        }
    }

    fn coordinate(&mut self) -> f64 {
        match self.random.random_range(0..8) {
            0 => 0.0,
            1 => 1.0,
            _ => 20.0 * self.random.random::<f64>() - 10.0,
        }
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.coordinate(), self.coordinate(), self.coordinate())
    }
}

impl Parameters for Dice<'_> {
    fn value(&mut self, _: &Parameter, value: Value<'_>) {
        match value {
            Value::Number(number, range) => *number = self.number(&range),
            Value::Count(count, range) => {
                *count = self.random.random_range(range.least..=range.most.min(range.least.saturating_add(40)));
            }
            Value::Flag(flag) => *flag = self.random.random(),
            Value::Colour(rgb, range) => *rgb = [0; 3].map(|_| self.number(&range)),
            Value::Textured(textured, range) => *textured = Textured::Constant([0; 3].map(|_| self.number(&range))),
            Value::TexturedNumber(textured, range) => *textured = Textured::Constant(self.number(&range)),
            Value::Point(point) | Value::Vector(point) | Value::Factors(point) => *point = self.point(),
            Value::Pair(pair) => {
                let start = self.random.random::<f64>();
                *pair = [start, start + self.random.random::<f64>()];
            }
            Value::Counts(counts) => *counts = [0; 2].map(|_| self.random.random_range(1..64)),
            Value::Matrix(rows) => rows.iter_mut().take(3).flatten().for_each(|x| *x = self.coordinate()),
            Value::Points(points) => points.iter_mut().for_each(|point| *point = self.point().to_array()),
            Value::Word(place, words) => *place = self.random.random_range(0..words.len()),
            Value::Text(_) | Value::File(_) | Value::Name(..) | Value::Triangles(_) => {}
        }
    }

    fn present(&mut self, _: &Parameter, _: bool) -> bool {
        self.random.random()
    }

    fn given(&mut self, _: &Parameter) -> bool {
        self.random.random()
    }

    fn choose(&mut self, choice: &Choice, _: usize) -> usize {
        self.random.random_range(0..choice.alternatives.len())
    }

    fn items(&mut self, _: &Parameter, _: usize) -> usize {
        self.random.random_range(0..4)
    }

    fn names(&mut self, _: &Parameter, _: Vec<String>) -> Vec<String> {
        (0..self.random.random_range(0..4)).map(|number| format!("name {number}")).collect()
    }
}

#[cfg(test)]
mod tests {
    use rand::{SeedableRng, rngs::SmallRng};

    use super::{super::CountRange, *};

    const COUNT: Parameter = Parameter::new("count", "A count.");

    /// Counts in random scenes, which must stay small.
    #[test]
    fn counts_are_within_their_range_and_few() {
        for (least, most, largest) in [(0, u32::MAX, 40), (18, 50_000_000, 58), (2, 5, 5), (u32::MAX - 1, u32::MAX, u32::MAX)] {
            let mut random = SmallRng::seed_from_u64(u64::from(least));
            let mut dice = Dice::new(&mut random);
            let drawn: Vec<u32> = (0..1000)
                .map(|_| {
                    let mut count = 0;
                    dice.value(&COUNT, Value::Count(&mut count, CountRange::new(least, most)));
                    count
                })
                .collect();
            assert_eq!((drawn.iter().min(), drawn.iter().max()), (Some(&least), Some(&largest)));
        }
    }

    /// Scenes of 10¹⁵ m would be of no use, although a file may describe them.
    #[test]
    fn lengths_of_wide_ranges_are_those_of_scenes() {
        const LENGTH: Parameter = Parameter::new("length", "A length.");
        let mut random = SmallRng::seed_from_u64(3);
        let mut dice = Dice::new(&mut random);
        let drawn = (0..1000).map(|_| {
            let mut length = 0.0;
            dice.value(&LENGTH, Value::Number(&mut length, Range::linear(-1e15, 1e15)));
            length
        });
        let [least, most] = drawn.fold([f64::MAX, f64::MIN], |[a, b], x| [a.min(x), b.max(x)]);
        assert_eq!([least, most], [-1e9, 1e9]);
    }
}
