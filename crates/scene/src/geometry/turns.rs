//! Angles of rotation, with whole turns stored apart from the fraction, so that no number of turns loses digits.
use std::f64::consts::TAU;

use noisefall_base::math::{F, Lanes, U, round::floor};

/// Degrees of a turn.
const TURN: f64 = 360.0;

/// An angle of any number of turns, all of which count in motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turns {
    /// Whole turns modulo 2³²: times are multiples of 2⁻³², so 2³² turns have no effect.
    whole: i32,
    /// Fraction of a turn, between −1 and 1.
    part: f64,
}

impl Turns {
    /// Converts degrees. Exact except for the division by 360; not finite if `degrees` is not.
    pub fn from_degrees(degrees: f64) -> Turns {
        const TURNS: f64 = (1u64 << 32) as f64;
        // Remainders are exact, and so is the quotient of a multiple.
        let few = degrees % (TURNS * TURN);
        Turns { whole: ((few - few % TURN) / TURN) as i64 as i32, part: degrees % TURN / TURN }
    }

    /// The angle at a fraction of the time, in radians and less than two turns.
    pub fn radians_at(self, time: f64) -> f64 {
        self.part * TAU * time + (f64::from(self.whole) * time).fract() * TAU
    }

    /// Whether both are the same, bit for bit.
    pub(super) fn is_same(self, other: Turns) -> bool {
        (self.whole, self.part.to_bits()) == (other.whole, other.part.to_bits())
    }

    /// The total number of turns.
    pub fn count(self) -> f64 {
        (f64::from(self.whole) + self.part).abs()
    }

    /// The angle at times in [0, 1], in turns, from 0 to 1.
    #[inline(always)]
    pub fn at<L: Lanes>(self, time: F<L>) -> F<L> {
        let mut angle = time * self.part as f32;
        if self.whole != 0 {
            // Integer products wrap modulo 2³². The unit is 2⁻³² turns, so whole turns drop out.
            let product = fixed_point(time) * self.whole as u32;
            angle = angle + (product >> 8).to_real() * (1.0 / 16_777_216.0);
        }
        angle - floor(angle).0
    }
}

/// Numbers in [0, 1] times 2³², rounded down.
#[inline(always)]
fn fixed_point<L: Lanes>(x: F<L>) -> U<L> {
    let scaled = x * 65_536.0;
    let (upper, upper_bits) = floor(scaled);
    let (_, lower_bits) = floor((scaled - upper) * 65_536.0);
    (upper_bits << 16) + lower_bits
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::One;

    /// The difference of two angles in turns, modulo whole turns.
    fn distance(a: f64, b: f64) -> f64 {
        (a - b - (a - b).round()).abs()
    }

    fn at(degrees: f64, time: f32) -> f64 {
        f64::from(Turns::from_degrees(degrees).at::<One>(F(time)).0)
    }

    #[test]
    fn any_number_of_turns_leaves_the_angle_exact() {
        for turns in [0.0, 1.0, 4_194_305.0, 1e9, 4_294_967_295.0, 4_294_967_297.0, 1e12] {
            for degrees in [0.0, 30.0, 90.0, 135.0, 359.0] {
                for sign in [1.0, -1.0] {
                    let angle = Turns::from_degrees(sign * (turns * 360.0 + degrees));
                    assert_eq!(angle.radians_at(1.0), sign * degrees / 360.0 * TAU, "{turns} turns");
                    assert!(distance(f64::from(angle.at::<One>(F(1.0)).0), sign * degrees / 360.0) < 1e-7, "{turns} turns");
                }
            }
        }
        // No f64 of this size is a fraction of degrees: the remainder is that of a whole number.
        let (huge, remainder) = (1e300, 1e300 % 360.0);
        assert_eq!(Turns::from_degrees(huge).radians_at(1.0), remainder / 360.0 * TAU);
        assert!(!Turns::from_degrees(f64::INFINITY).radians_at(1.0).is_finite());
    }

    #[test]
    fn all_turns_are_turned_in_the_course_of_time() {
        for (degrees, time, turns) in [
            (360.0, 0.25, 0.25),
            (-360.0, 0.25, -0.25),
            (720.0 + 90.0, 0.5, 0.125),
            (360.0 * 4_194_305.0, 0.5, 0.5),
            (360.0 * 4_194_305.0, 0.125, 0.125),
            (-360.0 * 1_000_001.0, 0.75, -0.75),
            (360.0 * 2_147_483_647.0 + 36.0, 0.5, 0.55),
        ] {
            assert!(distance(at(degrees, time), turns) < 1e-6, "{degrees} at {time}: {}", at(degrees, time));
            let radians = Turns::from_degrees(degrees).radians_at(time.into());
            assert!(distance(radians / TAU, turns) < 1e-6, "{degrees} at {time}: {radians}");
        }
        assert_eq!(at(123.0, 0.0), 0.0);
        assert_eq!(Turns::from_degrees(-900.0).count(), 2.5);
    }

    #[test]
    fn the_same_angle_in_lanes_and_not() {
        for k in 0..1000u32 {
            let time = crate::sampling::hash::hash_one(k) as f32 / 4_294_967_808.0;
            for degrees in [20.0, -340.0, 361.0, 7.5 * 360.0, -1000.3 * 360.0] {
                let exact = Turns::from_degrees(degrees).radians_at(time.into()) / TAU;
                let found = at(degrees, time);
                assert!((0.0..=1.0).contains(&found) && distance(found, exact) < 1e-6, "{degrees} at {time}: {found}, {exact}");
            }
        }
    }
}
