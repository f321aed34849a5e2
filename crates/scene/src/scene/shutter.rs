//! The shutter: the times that an image shows.
use serde::{Deserialize, Serialize};

/// The interval in which the shutter is open. Motion runs from time 0 to 1; objects are at rest before and after.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shutter {
    /// The time at which it opens, from 0 to 1.
    pub open: f64,
    /// The time at which it closes, from 0 to 1.
    pub close: f64,
}

impl Shutter {
    /// Limits of the times. Beyond them nearly all samples would show the ends of the motion.
    pub const FARTHEST: f64 = 1e6;

    /// A shutter that is open only at the moment in which this one opens.
    pub fn at_opening(self) -> Shutter {
        Shutter { close: self.open, ..self }
    }

    /// The times of its samples.
    pub(super) fn moments(self) -> Moments {
        let [first, last] = [self.open, self.close].map(|time| time.clamp(0.0, 1.0));
        if first == last {
            return Moments { start: first as f32, length: 0.0 };
        }
        Moments { start: self.open as f32, length: (self.close - self.open) as f32 }
    }
}

/// Uniform times from `start` over `length`. The pose before 0 is that at 0, and the pose after 1 is that at 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// The time at which the shutter opens.
    pub start: f32,
    /// Length of the interval; 0 if all samples show the same pose.
    pub length: f32,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moments(open: f64, close: f64) -> (f32, f32) {
        let Moments { start, length } = Shutter { open, close }.moments();
        (start, length)
    }

    #[test]
    fn samples_are_spread_over_the_time_that_the_shutter_is_open() {
        assert_eq!(moments(0.0, 1.0), (0.0, 1.0));
        assert_eq!(moments(0.25, 0.75), (0.25, 0.5));
        assert_eq!(moments(-1.0, 0.5), (-1.0, 1.5), "two thirds of the samples show the beginning");
        assert_eq!(moments(0.5, 3.0), (0.5, 2.5));
    }

    #[test]
    fn one_pose_needs_no_times() {
        assert_eq!(moments(0.5, 0.5), (0.5, 0.0));
        assert_eq!(moments(-2.0, 0.0), (0.0, 0.0));
        assert_eq!(moments(1.0, 2.0), (1.0, 0.0));
        assert_eq!(Shutter { open: 0.25, close: 0.75 }.at_opening().moments(), Moments { start: 0.25, length: 0.0 });
    }
}
