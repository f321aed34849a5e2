//! Single statements: a measured number, the exact one, and whether they agree.
use crate::measure::{Mean, Moments};

/// Deviations beyond so many standard errors refute a statement: one in 16000 does by chance, but seeds do not change.
pub const SIGMAS: f64 = 4.0;

/// One measured number against what it must be.
#[derive(Clone, Debug)]
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
}

impl Statement {
    /// A z-test.
    pub fn z(what: impl Into<String>, measured: f64, error: f64, exact: f64) -> Statement {
        let z = if measured == exact { 0.0 } else { (measured - exact) / error };
        Statement {
            what: what.into(),
            measured,
            error,
            exact: Some(exact),
            statistic: format!("z = {z:+.2}"),
            holds: z.abs() < SIGMAS,
        }
    }

    /// The z-test of a mean by the variance of its own samples.
    pub fn mean(what: impl Into<String>, found: Mean, exact: f64) -> Statement {
        let z = found.z(exact);
        let error = found.variance_of_mean.sqrt();
        let statistic = format!("z = {z:+.2}");
        Statement { what: what.into(), measured: found.mean, error, exact: Some(exact), statistic, holds: z.abs() < SIGMAS }
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
        let statistic = format!("|Δ| = {difference:.1e} ≤ {tolerance:.0e}");
        Statement { what: what.into(), measured, error: 0.0, exact: Some(exact), statistic, holds: difference <= tolerance }
    }

    /// Nothing may be found where something is counted.
    pub fn none(what: impl Into<String>, count: u32) -> Statement {
        let statistic = "must be 0".to_owned();
        Statement { what: what.into(), measured: f64::from(count), error: 0.0, exact: Some(0.0), statistic, holds: count == 0 }
    }

    /// Must be less than a limit.
    pub fn below(what: impl Into<String>, measured: f64, limit: f64) -> Statement {
        let text = if limit.abs() < 1e-3 { format!("{limit:.0e}") } else { limit.to_string() };
        let statistic = format!("must be < {text}");
        Statement { what: what.into(), measured, error: 0.0, exact: None, statistic, holds: measured < limit }
    }
}
