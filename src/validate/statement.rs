//! Single statements: a measured number, the exact one, and whether they agree.
use std::fmt;

use serde::Serialize;
use statrs::{
    distribution::{ChiSquared, ContinuousCDF, StudentsT},
    function::erf::erfc,
};

use crate::measure::{Mean, Moments, as_normal};

/// Deviations beyond so many standard errors refute a statement: one in 16000 does by chance, but seeds do not change.
pub const SIGMAS: f64 = 4.0;
/// A χ² or Kolmogorov–Smirnov test refutes below this.
pub const SIGNIFICANCE: f64 = 1e-4;
/// A bias so many standard errors beyond the threshold is noticed with a probability of 95 %.
const POWER: f64 = 1.644_853_6;

/// One measured number against what it must be.
#[derive(Clone, Debug, Serialize)]
pub struct Statement {
    pub what: String,
    pub measured: f64,
    /// Standard error of `measured`; 0 where there is no chance in it.
    pub error: f64,
    /// None where the statement is about a limit.
    pub exact: Option<f64>,
    /// The test and its outcome.
    pub statistic: String,
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
}

impl Noticed {
    fn of(bias: f64, exact: f64) -> Noticed {
        if exact == 0.0 { Noticed::Absolute(bias) } else { Noticed::Relative(bias / exact.abs()) }
    }
}

impl fmt::Display for Noticed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Noticed::Relative(part) if *part >= 1e-5 => write!(f, "{:.3} %", 100.0 * part),
            Noticed::Relative(part) => write!(f, "{:.0e} %", 100.0 * part),
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
    fn plain(what: impl Into<String>, measured: f64, statistic: String) -> Statement {
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

    /// Student's t-test of independent measurements of the same number, whatever samples each was made of. Rounding in f32 counts as
    /// an error too.
    pub fn repeated(what: impl Into<String>, found: &[f64], exact: f64) -> Statement {
        let (mean, error) = mean_and_error(found);
        let rounded = error.hypot(1e-6 * exact);
        let degrees = found.len() as f64 - 1.0;
        let t = (mean - exact) / rounded;
        let z = as_normal(t, degrees);
        Statement {
            error,
            exact: Some(exact),
            holds: z.abs() < SIGMAS,
            notices: Noticed::of((quantile(SIGMAS, degrees) + POWER) * rounded, exact),
            z: (error > 1e-5 * exact.abs()).then_some(z),
            chance: chance_beyond(SIGMAS),
            ..Statement::plain(what, mean, format!("t = {t:+.2} of {degrees}"))
        }
    }

    /// As [`Statement::repeated`], where the number must be below a limit: it fails if it is beyond doubt that it is not.
    pub fn repeated_below(what: impl Into<String>, found: &[f64], limit: f64) -> Statement {
        let ((mean, error), degrees) = (mean_and_error(found), found.len() as f64 - 1.0);
        let sure = quantile(SIGMAS, degrees) * error;
        Statement {
            error,
            holds: mean - sure < limit,
            notices: Noticed::Absolute(limit - mean + sure + POWER * error),
            chance: chance_beyond(SIGMAS) / 2.0,
            ..Statement::plain(what, mean, format!("must be < {limit} + {sure:.1e}"))
        }
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
        let notices = Noticed::Relative(3.0 / f64::from(of));
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
        let notices = Noticed::Relative((limit + POWER) * sigma);
        Statement { holds: worst < limit && !scores.is_empty(), notices, chance, ..statement }
    }

    /// Counts against expectations of the same sum. The smallest bias is the root mean square of the relative error of the
    /// probabilities, each weighed by itself.
    pub fn chi_squared(what: impl Into<String>, observed: &[f64], expected: &[f64]) -> Statement {
        let (chi2, degrees) = chi_squared(observed, expected);
        let distribution = ChiSquared::new(degrees).ok();
        let p = distribution.map_or(0.0, |distribution| distribution.sf(chi2));
        let threshold = distribution.map_or(f64::NAN, |distribution| distribution.inverse_cdf(1.0 - SIGNIFICANCE));
        // A noncentral χ² of λ has the mean k + λ and the variance 2(k + 2λ).
        let beyond = |lambda: f64| degrees + lambda - POWER * (2.0 * (degrees + 2.0 * lambda)).sqrt() - threshold;
        let (mut low, mut high) = (0.0, 100.0 * threshold);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if beyond(middle) < 0.0 { &mut low } else { &mut high }) = middle;
        }
        Statement {
            error: (2.0 * degrees).sqrt(),
            exact: Some(degrees),
            holds: p > SIGNIFICANCE,
            notices: Noticed::Relative((high / expected.iter().sum::<f64>()).sqrt()),
            chance: SIGNIFICANCE,
            ..Statement::plain(what, chi2, format!("χ²: p = {p:.3}, must be > 1e-4"))
        }
    }

    /// Catoni's test of the mean of samples of known variance, which needs no further moment: with ψ(x) = ± log(1 + |x| + x²/2) and
    /// E exp ψ(a(X − μ)) ≤ 1 + a²σ²/2, the sum of ψ exceeds N a²σ²/2 + ln(2/δ) with a probability of at most δ/2 on either side.
    pub fn catoni(what: impl Into<String>, samples: impl Iterator<Item = f64>, exact: f64, variance: f64) -> Statement {
        let samples: Vec<f64> = samples.collect();
        let (count, chance) = (samples.len() as f64, chance_beyond(SIGMAS));
        let level = (2.0 / chance).ln();
        let scale = (2.0 * level / (count * variance)).sqrt();
        let psi = |x: f64| (1.0 + x.abs() + x * x / 2.0).ln().copysign(x);
        let sum: f64 = samples.iter().map(|x| psi(scale * (x - exact))).sum();
        let error = (variance / count).sqrt();
        Statement {
            error,
            exact: Some(exact),
            holds: sum.abs() < 2.0 * level,
            notices: Noticed::of(((2.0 * level).sqrt() + POWER) * error, exact),
            chance,
            ..Statement::plain(what, samples.iter().sum::<f64>() / count, format!("Catoni: |{sum:.1}| < {:.1}", 2.0 * level))
        }
    }

    /// The same, where a statement before is about the same samples.
    pub fn of_the_same(self) -> Statement {
        Statement { shares_samples: true, ..self }
    }
}

/// The mean of independent numbers, and its standard error.
fn mean_and_error(found: &[f64]) -> (f64, f64) {
    let moments = Moments::of(found.iter().copied());
    (moments.mean, (moments.variance / moments.count).sqrt())
}

/// What Student's t exceeds as rarely as a standard normal number exceeds `sigmas`.
fn quantile(sigmas: f64, degrees: f64) -> f64 {
    StudentsT::new(0.0, 1.0, degrees).map_or(f64::NAN, |student| -student.inverse_cdf(chance_beyond(sigmas) / 2.0))
}

/// χ² and its degrees of freedom; cells of few expectations are taken together.
fn chi_squared(observed: &[f64], expected: &[f64]) -> (f64, f64) {
    const FEW: f64 = 10.0;
    let (mut chi2, mut cells, mut rest) = (0.0, 0.0, [0.0; 2]);
    for (o, e) in observed.iter().zip(expected) {
        if *e < FEW {
            rest = [rest[0] + o, rest[1] + e];
        } else {
            chi2 += (o - e) * (o - e) / e;
            cells += 1.0;
        }
    }
    if rest != [0.0; 2] {
        chi2 += (rest[0] - rest[1]).powi(2) / rest[1].max(1.0);
        cells += 1.0;
    }
    (chi2, (cells - 1.0f64).max(1.0))
}
