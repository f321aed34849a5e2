//! Single statements: a measured number, the exact one, and whether they agree.
use std::fmt;

use serde::Serialize;
use statrs::function::erf::erfc;

use crate::measure::{Mean, Moments};

/// Deviations beyond so many standard errors refute a statement: one in 16000 does by chance, but seeds do not change.
pub const SIGMAS: f64 = 4.0;
/// A bias so many standard errors beyond the threshold is noticed with a probability of 95 %.
pub(super) const POWER: f64 = 1.644_853_6;

/// One measured number against what it must be.
#[derive(Clone, Debug, Serialize)]
pub struct Statement {
    /// What was measured.
    pub what: String,
    /// The measured value.
    pub measured: f64,
    /// Standard error of `measured`; 0 where there is no chance in it.
    pub error: f64,
    /// None where the statement is about a limit.
    pub exact: Option<f64>,
    /// The test and its outcome.
    pub statistic: String,
    /// Whether the value is where it should be.
    pub holds: bool,
    /// The smallest bias of `measured` that fails the statement with a probability of 95 %.
    pub notices: Noticed,
    /// The deviation, where it is a standard normal number if the statement is true.
    pub z: Option<f64>,
    /// The probability that the statement fails although it is true.
    pub chance: f64,
    /// A statement before is about the same samples.
    pub shares_samples: bool,
}

/// The smallest bias that a statement notices.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Noticed {
    /// As a part of the exact number.
    Relative(f64),
    /// In units of the measured number.
    Absolute(f64),
    /// As a part of each of the numbers that were taken together.
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

/// The probability that a standard normal number is farther from 0.
pub fn chance_beyond(sigmas: f64) -> f64 {
    erfc(sigmas / std::f64::consts::SQRT_2)
}

impl Statement {
    /// A statement without chance, that holds.
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

    /// The z-test of a mean by the variance of its own samples.
    pub fn mean(what: impl Into<String>, found: Mean, exact: f64) -> Statement {
        let (error, z) = (found.variance_of_mean.sqrt(), found.z(exact));
        // Where rounding is as large as the noise, the deviation is narrower than the normal distribution.
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

    /// The z-test of a variance by the samples' fourth moment.
    pub fn variance(what: impl Into<String>, found: &Moments, exact: f64) -> Statement {
        let error = ((found.fourth - found.variance * found.variance) / found.count).sqrt();
        Statement::z(what, found.variance, error, exact)
    }

    /// Without chance: within a tolerance, which is what rounding may do.
    pub fn within(what: impl Into<String>, measured: f64, exact: f64, tolerance: f64) -> Statement {
        let difference = (measured - exact).abs();
        Statement {
            exact: Some(exact),
            holds: difference <= tolerance,
            notices: Noticed::of(tolerance, exact),
            ..Statement::plain(what, measured, format!("|Δ| = {difference:.1e} ≤ {tolerance:.0e}"))
        }
    }

    /// Within a known error of the method, as far as noise lets one see.
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

    /// Nothing may be found where something is counted.
    pub fn none(what: impl Into<String>, count: u32) -> Statement {
        let statement = Statement::plain(what, f64::from(count), "must be 0".to_owned());
        Statement { exact: Some(0.0), holds: count == 0, notices: Noticed::Absolute(1.0), ..statement }
    }

    /// The share of `of` tries in which something happens that must not; from 3/n on one of n is met with 95 %.
    pub fn never(what: impl Into<String>, count: u32, of: u32) -> Statement {
        let share = f64::from(count) / f64::from(of);
        let statistic = format!("{count} of {of}, must be 0");
        let holds = count == 0 && of > 0;
        let notices = Noticed::Absolute(3.0 / f64::from(of));
        Statement { exact: Some(0.0), holds, notices, ..Statement::plain(what, share, statistic) }
    }

    /// Must be less than a limit.
    pub fn below(what: impl Into<String>, measured: f64, limit: f64) -> Statement {
        let text = if limit.abs() < 1e-3 { format!("{limit:.0e}") } else { limit.to_string() };
        let statement = Statement::plain(what, measured, format!("must be < {text}"));
        Statement { holds: measured < limit, notices: Noticed::Absolute(limit - measured), ..statement }
    }

    /// The largest of standard normal numbers; a bias of a single one with the relative standard error `sigma` is noticed from the limit on.
    pub fn largest_z(what: impl Into<String>, scores: &[f64], limit: f64, sigma: f64) -> Statement {
        let worst = scores.iter().fold(0.0, |worst: f64, z| if z.abs() > worst || z.is_nan() { z.abs() } else { worst });
        let chance = 1.0 - (1.0 - chance_beyond(limit)).powf(scores.len() as f64);
        let statement = Statement::plain(what, worst, format!("largest of {}, must be < {limit}", scores.len()));
        let notices = Noticed::Each((limit + POWER) * sigma);
        Statement { holds: worst < limit && !scores.is_empty(), notices, chance, ..statement }
    }

    /// The same, where a statement before is about the same samples.
    pub fn of_the_same(self) -> Statement {
        Statement { shares_samples: true, ..self }
    }
}
