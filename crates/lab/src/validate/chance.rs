//! Statistical tests beyond the z-test: Student's t, χ², and Catoni's test, which needs no normal distribution.
use statrs::distribution::{ChiSquared, ContinuousCDF, StudentsT};

use super::{
    Noticed, Statement,
    statement::{POWER, SIGMAS, chance_beyond},
};
use noisefall_kernel::measure::{Moments, as_normal};

/// Significance of χ² and Kolmogorov–Smirnov tests: a smaller p fails.
pub const SIGNIFICANCE: f64 = 1e-4;

impl Statement {
    /// Student's t-test of independent measurements of the same number. The samples within a measurement may be dependent.
    /// Rounding in f32 counts as an error too.
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
            notices: Noticed::of(noticed(degrees) * rounded, exact),
            z: (error > 1e-5 * exact.abs()).then_some(z),
            chance: chance_beyond(SIGMAS),
            ..Statement::plain(what, mean, format!("t = {t:+.2} of {degrees}, |t| < {:.1}", quantile(SIGMAS, degrees)))
        }
    }

    /// Like [`Statement::repeated`], for a number that must be below a limit. Fails if the number exceeds it significantly.
    pub fn repeated_below(what: impl Into<String>, found: &[f64], limit: f64) -> Statement {
        let ((mean, error), degrees) = (mean_and_error(found), found.len() as f64 - 1.0);
        let sure = quantile(SIGMAS, degrees) * error;
        Statement {
            error,
            holds: mean - sure < limit,
            notices: Noticed::Absolute(limit - mean + noticed(degrees) * error),
            chance: chance_beyond(SIGMAS) / 2.0,
            ..Statement::plain(what, mean, format!("must be < {limit} + {sure:.1e}"))
        }
    }

    /// χ² test of counts against expectations with the same sum. The smallest bias is the root mean square relative error of the
    /// probabilities, weighted by the probabilities.
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
            notices: Noticed::Each((high / expected.iter().sum::<f64>()).sqrt()),
            chance: SIGNIFICANCE,
            ..Statement::plain(what, chi2, format!("χ²: p = {p:.3}, must be > 1e-4"))
        }
    }

    /// Catoni's test of the mean of samples of known variance. It needs no further moment: with ψ(x) = ± log(1 + |x| + x²/2) and
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
}

/// Mean of independent numbers and its standard error.
fn mean_and_error(found: &[f64]) -> (f64, f64) {
    let moments = Moments::of(found.iter().copied());
    (moments.mean, (moments.variance / moments.count).sqrt())
}

/// Quantile of Student's t with the tail probability of `sigmas` in the normal distribution.
fn quantile(sigmas: f64, degrees: f64) -> f64 {
    StudentsT::new(0.0, 1.0, degrees).map_or(f64::NAN, |student| -student.inverse_cdf(chance_beyond(sigmas) / 2.0))
}

/// The bias, in standard errors, that Student's t-test detects with a probability of 95 %. The standard error is itself an
/// estimate, with mean and variance of about 1 − 1/(4ν) and 1/(2ν) relative to the true one.
fn noticed(degrees: f64) -> f64 {
    let threshold = quantile(SIGMAS, degrees);
    threshold * (1.0 - 0.25 / degrees) + POWER * (1.0 + threshold * threshold / (2.0 * degrees)).sqrt()
}

/// χ² and its degrees of freedom; cells with small expectations are merged.
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

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_kernel::measure::Mean;

    /// Numbers of mean 2 and variance 9, as many above as below.
    fn spread(shift: f64, count: usize) -> impl Iterator<Item = f64> {
        (0..count).map(move |i| 2.0 + shift + if i % 2 == 0 { 3.0 } else { -3.0 })
    }

    fn relative(statement: &Statement) -> f64 {
        let (Noticed::Relative(part) | Noticed::Each(part)) = statement.notices else { panic!("{statement:?}") };
        part
    }

    #[test]
    fn students_t_of_few_numbers_is_wide() {
        let found = [1.0, 2.0, 3.0, 4.0];
        let statement = Statement::repeated("t", &found, 2.0);
        assert!((statement.measured - 2.5).abs() < 1e-12 && (statement.error - (5.0f64 / 12.0).sqrt()).abs() < 1e-9);
        assert!(statement.statistic.starts_with("t = +0.77 of 3"), "{}", statement.statistic);
        // 4 standard errors are as rare as 32.6 of Student's t with 3 degrees of freedom.
        assert!((quantile(SIGMAS, 3.0) - 32.6).abs() < 0.2, "{}", quantile(SIGMAS, 3.0));
        let exact = |t: f64| Statement::repeated("t", &found, 2.5 - t * (5.0f64 / 12.0).sqrt()).holds;
        assert!(exact(32.0) && !exact(33.5) && exact(-32.0) && !exact(-33.5));
        // The noncentral t of 7 degrees of freedom and δ = 12.3 is below 8.5 with a probability of 5 %, that of 15 and 7.7 below 5.5.
        assert!((noticed(7.0) - 12.3).abs() < 0.1 && (noticed(15.0) - 7.7).abs() < 0.1, "{} {}", noticed(7.0), noticed(15.0));
        let below = |t: f64| Statement::repeated_below("t", &found, 2.5 - t * (5.0f64 / 12.0).sqrt()).holds;
        assert!(below(32.0) && !below(33.5) && below(-33.5));
        let far_below = Statement::repeated_below("t", &found, 4.5);
        let Noticed::Absolute(bias) = far_below.notices else { panic!("{far_below:?}") };
        assert!((bias - 2.0 - noticed(3.0) * (5.0f64 / 12.0).sqrt()).abs() < 1e-9, "the limit is 2 above the mean: {bias}");
        assert!(Statement::repeated("exact", &[2.0; 5], 2.0).holds && !Statement::repeated("exact", &[2.0; 5], 2.001).holds);
    }

    #[test]
    fn catonis_bound_is_about_as_sharp_as_four_standard_errors() {
        let count = 100_000;
        let of = |shift: f64| Statement::catoni("mean", spread(shift, count), 2.0, 9.0);
        let noticed = relative(&of(0.0)) * 2.0;
        let error = 3.0 / (count as f64).sqrt();
        assert!((noticed / error - 6.2).abs() < 0.1, "{}", noticed / error);
        assert!(of(0.0).holds && of(4.0 * error).holds);
        assert!(!of(noticed).holds && !of(-noticed).holds && !of(5.0 * error).holds);
        // A single outlier, which would spoil a mean, has little influence.
        let wild = spread(0.0, count).chain(std::iter::once(1e6));
        assert!(Statement::catoni("mean", wild, 2.0, 9.0).holds);
    }

    #[test]
    fn catonis_sum_is_that_of_its_formula() {
        // Of 100 samples with variance 1, all 10 too large: a = √(2 ln(2/δ)/100), ψ = ln(1 + 10a + 50a²).
        let level = (2.0 / chance_beyond(SIGMAS)).ln();
        let scale = (2.0 * level / 100.0).sqrt();
        let sum = 100.0 * (1.0 + 10.0 * scale + 50.0 * scale * scale).ln();
        let above = Statement::catoni("mean", std::iter::repeat_n(12.0, 100), 2.0, 1.0);
        assert_eq!(above.statistic, format!("Catoni: |{sum:.1}| < {:.1}", 2.0 * level));
        assert_eq!((above.measured, above.error, above.exact, above.chance), (12.0, 0.1, Some(2.0), chance_beyond(SIGMAS)));
        let below = Statement::catoni("mean", std::iter::repeat_n(-8.0, 100), 2.0, 1.0);
        assert_eq!(below.statistic, format!("Catoni: |-{sum:.1}| < {:.1}", 2.0 * level));
        assert!(!above.holds && !below.holds);
    }

    #[test]
    fn counts_that_are_off_fail_and_few_are_taken_together() {
        let expected: Vec<f64> = (0..101).map(|_| 1000.0).collect();
        let off = |part: f64| -> Vec<f64> { (0..101).map(|i| 1000.0 * (1.0 + if i % 2 == 0 { part } else { -part })).collect() };
        let statement = Statement::chi_squared("counts", &expected, &expected);
        assert!(statement.holds && statement.exact == Some(100.0));
        // The variance of χ² is twice its degrees of freedom.
        assert!((statement.error - 200.0f64.sqrt()).abs() < 1e-12, "{}", statement.error);
        // χ² of 100 degrees of freedom exceeds 161.3 with the probability 10⁻⁴.
        assert!(Statement::chi_squared("counts", &off(0.039), &expected).holds);
        assert!(!Statement::chi_squared("counts", &off(0.041), &expected).holds);
        // A misfit adds to the χ² of the noise, so it is detected reliably from somewhat above χ² = 161.3 − 100.
        let noticed = relative(&statement);
        assert!((noticed * noticed * 101_000.0 - 102.0).abs() < 3.0, "{}", noticed * noticed * 101_000.0);
        let few = Statement::chi_squared("few", &[100.0, 3.0, 0.0, 5.0], &[100.0, 4.0, 3.0, 1.0]);
        assert_eq!((few.exact, few.measured), (Some(1.0), 0.0));
        assert!(!Statement::chi_squared("none expected", &[1000.0, 30.0], &[1030.0, 0.0]).holds);
    }

    #[test]
    fn a_row_fails_for_the_bias_that_it_states() {
        let mean = |mean: f64| Mean { mean, variance_of_mean: 1e-4 };
        for (what, row) in [
            ("z", (|x| Statement::z("", x, 0.01, 2.0)) as fn(f64) -> Statement),
            ("mean", |x| Statement::mean("", Mean { mean: x, variance_of_mean: 1e-4 }, 2.0)),
            ("near", |x| Statement::near("", Mean { mean: x, variance_of_mean: 1e-4 }, 2.0, 0.1)),
            ("within", |x| Statement::within("", x, 2.0, 0.1)),
        ] {
            let noticed = 2.0 * relative(&row(2.0));
            assert!(row(2.0).holds && !row(2.0 + 1.001 * noticed).holds && !row(2.0 - 1.001 * noticed).holds, "{what}");
        }
        assert!(Statement::near("", mean(2.13), 2.0, 0.1).holds && !Statement::near("", mean(2.15), 2.0, 0.1).holds);
        assert!(Statement::never("", 0, 10).holds && !Statement::never("", 1, 10).holds && !Statement::never("", 0, 0).holds);
        assert!(
            Statement::largest_z("", &[1.0, -3.9], 4.0, 0.1).holds && !Statement::largest_z("", &[1.0, -4.1], 4.0, 0.1).holds
        );
        assert_eq!(Statement::largest_z("", &[0.25, -0.5], 4.0, 0.1).measured, 0.5);
        let shown = [Noticed::Relative(1e-3), Noticed::Each(2e-7), Noticed::Absolute(0.5)].map(|noticed| noticed.to_string());
        assert_eq!(shown, ["0.100 %", "2e-5 %", "5.0e-1"]);
        for empty in [&[][..], &[f64::NAN], &[0.0, f64::NAN, 1.0]] {
            assert!(!Statement::largest_z("", empty, 4.0, 0.1).holds, "{empty:?}");
        }
    }
}
