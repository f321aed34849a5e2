//! Statements: a measured number, the exact one, and whether they agree.
use std::fmt;

use serde::Serialize;
use statrs::function::erf::erfc;

use noisefall_kernel::measure::{Mean, Moments};

/// A statement fails beyond this many standard errors. By chance one in 16000 does, but the seeds are fixed.
pub const SIGMAS: f64 = 4.0;
/// A bias this many standard errors beyond the threshold is detected with a probability of 95 %.
pub(super) const POWER: f64 = 1.644_853_6;

/// A measured number and the number that it must be.
#[derive(Clone, Debug, Serialize)]
pub struct Statement {
    /// The quantity that was measured.
    pub what: String,
    /// The measured value.
    pub measured: f64,
    /// Standard error of `measured`; 0 if it is not random.
    pub error: f64,
    /// The exact number; `None` if the statement is about a limit.
    pub exact: Option<f64>,
    /// The test and its outcome.
    pub statistic: String,
    /// Whether the statement holds.
    pub holds: bool,
    /// The smallest bias of `measured` that fails the statement with a probability of 95 %.
    pub notices: Noticed,
    /// The deviation, if it has a standard normal distribution for a correct program.
    pub z: Option<f64>,
    /// The probability that the statement fails for a correct program.
    pub chance: f64,
    /// Whether an earlier statement uses the same samples.
    pub shares_samples: bool,
}

/// The smallest bias that a statement detects.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Noticed {
    /// A fraction of the exact number.
    Relative(f64),
    /// In units of the measured number.
    Absolute(f64),
    /// A fraction of each of the numbers that the statement combines.
    Each(f64),
}

impl Noticed {
    pub(super) fn of(bias: f64, exact: f64) -> Noticed {
        if exact == 0.0 { Noticed::Absolute(bias) } else { Noticed::Relative(bias / exact.abs()) }
    }
}

impl fmt::Display for Noticed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Noticed::Relative(part) | Noticed::Each(part) if *part >= 1e-5 => write!(f, "{:.3} %", 100.0 * part),
            Noticed::Relative(part) | Noticed::Each(part) => write!(f, "{:.0e} %", 100.0 * part),
            Noticed::Absolute(bias) => write!(f, "{bias:.1e}"),
        }
    }
}

/// The probability that |z| of a standard normal z exceeds `sigmas`.
pub fn chance_beyond(sigmas: f64) -> f64 {
    erfc(sigmas / std::f64::consts::SQRT_2)
}

impl Statement {
    /// A statement that holds and is not random.
    pub(super) fn plain(what: impl Into<String>, measured: f64, statistic: String) -> Statement {
        Statement {
            what: what.into(),
            measured,
            error: 0.0,
            exact: None,
            statistic,
            holds: true,
            notices: Noticed::Absolute(f64::NAN),
            z: None,
            chance: 0.0,
            shares_samples: false,
        }
    }

    /// A z-test.
    pub fn z(what: impl Into<String>, measured: f64, error: f64, exact: f64) -> Statement {
        let z = if measured == exact { 0.0 } else { (measured - exact) / error };
        Statement {
            error,
            exact: Some(exact),
            holds: z.abs() < SIGMAS,
            notices: Noticed::of((SIGMAS + POWER) * error, exact),
            z: Some(z),
            chance: chance_beyond(SIGMAS),
            ..Statement::plain(what, measured, format!("z = {z:+.2}"))
        }
    }

    /// The z-test of a mean with the variance of its own samples.
    pub fn mean(what: impl Into<String>, found: Mean, exact: f64) -> Statement {
        let (error, z) = (found.variance_of_mean.sqrt(), found.z(exact));
        // If rounding is as large as the noise, the scores are narrower than the normal distribution.
        let is_noise = error > 1e-5 * exact.abs();
        Statement {
            statistic: format!("z = {z:+.2}"),
            holds: z.abs() < SIGMAS,
            z: is_noise.then_some(z),
            ..Statement::z(what, found.mean, error, exact)
        }
    }

    /// The z-test of the mean of samples whose variance is known.
    pub fn mean_with(what: impl Into<String>, found: &Moments, exact: f64, variance: f64) -> Statement {
        Statement::z(what, found.mean, (variance / found.count).sqrt(), exact)
    }

    /// The z-test of a variance, with its standard error from the fourth moment of the samples.
    pub fn variance(what: impl Into<String>, found: &Moments, exact: f64) -> Statement {
        let error = ((found.fourth - found.variance * found.variance) / found.count).sqrt();
        Statement::z(what, found.variance, error, exact)
    }

    /// A number that is not random must be exact to within a tolerance for rounding.
    pub fn within(what: impl Into<String>, measured: f64, exact: f64, tolerance: f64) -> Statement {
        let difference = (measured - exact).abs();
        Statement {
            exact: Some(exact),
            holds: difference <= tolerance,
            notices: Noticed::of(tolerance, exact),
            ..Statement::plain(what, measured, format!("|Δ| = {difference:.1e} ≤ {tolerance:.0e}"))
        }
    }

    /// The z-test of a mean whose method has a known error of up to `tolerance`.
    pub fn near(what: impl Into<String>, found: Mean, exact: f64, tolerance: f64) -> Statement {
        let (difference, error) = ((found.mean - exact).abs(), found.variance_of_mean.sqrt());
        Statement {
            error,
            exact: Some(exact),
            holds: difference <= tolerance + SIGMAS * error,
            notices: Noticed::of(tolerance + (SIGMAS + POWER) * error, exact),
            chance: chance_beyond(SIGMAS),
            ..Statement::plain(what, found.mean, format!("|Δ| = {difference:.1e} ≤ {tolerance:.0e} + 4σ"))
        }
    }

    /// A count that must be 0.
    pub fn none(what: impl Into<String>, count: u32) -> Statement {
        let statement = Statement::plain(what, f64::from(count), "must be 0".to_owned());
        Statement { exact: Some(0.0), holds: count == 0, notices: Noticed::Absolute(1.0), ..statement }
    }

    /// An event that must not happen in `of` tries. At a rate of 3/n it happens in n tries with a probability of 95 %.
    pub fn never(what: impl Into<String>, count: u32, of: u32) -> Statement {
        let share = f64::from(count) / f64::from(of);
        let statistic = format!("{count} of {of}, must be 0");
        let holds = count == 0 && of > 0;
        let notices = Noticed::Absolute(3.0 / f64::from(of));
        Statement { exact: Some(0.0), holds, notices, ..Statement::plain(what, share, statistic) }
    }

    /// A number that must be below a limit.
    pub fn below(what: impl Into<String>, measured: f64, limit: f64) -> Statement {
        let text = if limit.abs() < 1e-3 { format!("{limit:.0e}") } else { limit.to_string() };
        let statement = Statement::plain(what, measured, format!("must be < {text}"));
        Statement { holds: measured < limit, notices: Noticed::Absolute(limit - measured), ..statement }
    }

    /// The largest |z| of standard normal scores. `sigma` is the relative standard error of a single one, which gives the
    /// smallest bias.
    pub fn largest_z(what: impl Into<String>, scores: &[f64], limit: f64, sigma: f64) -> Statement {
        let worst = scores.iter().fold(0.0, |worst: f64, z| if z.abs() > worst || z.is_nan() { z.abs() } else { worst });
        let chance = 1.0 - (1.0 - chance_beyond(limit)).powf(scores.len() as f64);
        let statement = Statement::plain(what, worst, format!("largest of {}, must be < {limit}", scores.len()));
        let notices = Noticed::Each((limit + POWER) * sigma);
        Statement { holds: worst < limit && !scores.is_empty(), notices, chance, ..statement }
    }

    /// Marks a statement that uses the samples of an earlier one.
    pub fn of_the_same(self) -> Statement {
        Statement { shares_samples: true, ..self }
    }
}
