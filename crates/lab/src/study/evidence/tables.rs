//! The tables of the chapter. Each cell has one number, so programs can read them; – marks unknown values.
use super::exhibits::Exhibits;
use crate::{
    report::table::{Column, Table},
    study::{
        Findings, Outcome, Slope,
        fit::slope,
        outcome::ROUNDING,
        report::values,
        wording::{exponent, mean_and_error, significant},
    },
};
use noisefall_scene::scene::{RenderSettings, Setting};

/// Two-sided 95 % quantile of the normal distribution.
const NORMAL_95: f64 = 1.96;
/// A cell without a known value.
const UNKNOWN: &str = "–";
/// Note on rows without intervals.
const UNTRUSTED: &str =
    "No interval is given if the variance may be infinite, or if few samples make up most of it (heavy tails)";

impl Exhibits<'_> {
    /// All tables, in the order of the chapter.
    pub fn tables(&self) -> Vec<Table> {
        let convergence = self.of(RenderSettings::SAMPLER).map(|findings| self.convergence(findings));
        let bias = [(RenderSettings::MAX_BOUNCES, "bias_of_caps"), (RenderSettings::ROULETTE, "bias_of_roulette")];
        let bias = bias.into_iter().filter_map(|(setting, name)| Some(self.bias(setting, name, self.of(setting)?)));
        let equal_time = [
            RenderSettings::DIRECTIONS,
            RenderSettings::ESTIMATOR,
            RenderSettings::SAMPLER,
            RenderSettings::ROULETTE,
            RenderSettings::REUSE,
        ];
        let equal_time = equal_time.into_iter().filter_map(|setting| Some(self.equal_time(setting, self.of(setting)?)));
        convergence.into_iter().chain(bias).chain(equal_time).collect()
    }

    /// Table of the convergence of error and variance.
    fn convergence(&self, findings: &Findings) -> Table {
        let row = |outcome: &Outcome| {
            let last = outcome.last();
            let is_bounded = self.trusts_variance(outcome);
            let [of_error, error_width] = exponents(outcome.slope, is_bounded);
            let [of_variance, variance_width] = exponents(slope(&outcome.variances), is_bounded);
            let (name, remark) = (values(RenderSettings::SAMPLER, outcome), self.remark(outcome));
            let error = if outcome.is_exact() { UNKNOWN.to_owned() } else { error_in_percent(last.rel_mse) };
            vec![name, last.spp.to_string(), error, of_error, error_width, of_variance, variance_width, remark]
        };
        let numbers = ["samples", "error, %", "exponent of the error", "± (error)", "exponent of the variance", "± (variance)"];
        Table {
            name: "convergence".to_owned(),
            caption: format!(
                "Error (the root of relMSE) after N samples per pixel, and the exponents of N with which the error and the variance of a \
                 pixel fall, ± half the width of their 95 % intervals. The variance is measured as the mean squared error over pixels \
                 and channels, minus the error of the reference. Independent samples give −1/2 and −1; stratified and Sobol samples \
                 can fall faster. {UNTRUSTED} ({}).",
                self.circumstances(findings)
            ),
            columns: columns(RenderSettings::SAMPLER, &numbers),
            rows: findings.outcomes.iter().map(row).collect(),
        }
    }

    /// Table of the bias, and of the largest bias that is not excluded.
    fn bias(&self, setting: Setting, name: &str, findings: &Findings) -> Table {
        let mut sorted: Vec<&Outcome> = findings.outcomes.iter().collect();
        sorted.sort_by_key(|outcome| outcome.settings.max_bounces.unwrap_or(u32::MAX));
        Table {
            name: name.to_owned(),
            caption: format!(
                "Bias: the mean of the image minus the mean of the reference, W/(sr m²), with the standard error that the variance of \
                 the samples gives (an upper bound for stratified and Sobol samples); z, the bias in standard errors; the bias \
                 relative to the mean; and the bound that 95 % of such intervals keep: a larger bias is excluded. {UNTRUSTED} ({}).",
                self.circumstances(findings)
            ),
            columns: columns(setting, &["bias", "standard error", "z", "of the mean, %", "excluded beyond, %"]),
            rows: sorted.into_iter().map(|outcome| self.row_of_bias(setting, outcome, findings.limits.mean.abs())).collect(),
        }
    }

    fn row_of_bias(&self, setting: Setting, outcome: &Outcome, mean: f64) -> Vec<String> {
        let found = outcome.mean_error;
        let (bias, standard_error) = mean_and_error(found);
        let is_trusted = self.trusts_variance(outcome);
        // A difference below the rounding of single precision is not random.
        let has_noise = found.standard_error > ROUNDING.sqrt() * mean;
        let z = (is_trusted && has_noise).then(|| number(found.mean / found.standard_error));
        let most = found.mean.abs() + NORMAL_95 * found.standard_error;
        vec![
            values(setting, outcome),
            bias,
            known(standard_error.filter(|_| is_trusted)),
            known(z),
            number(100.0 * found.mean / mean),
            known(is_trusted.then(|| number(100.0 * most / mean))),
            self.remark(outcome),
        ]
    }

    /// Table of samples and errors at equal time.
    fn equal_time(&self, setting: Setting, findings: &Findings) -> Table {
        let time = findings.equal_time();
        let row = |outcome: &Outcome| {
            let reached = time.and_then(|seconds| outcome.after(seconds)).filter(|_| !outcome.is_exact());
            let interval = findings.interval(outcome).filter(|_| self.trusts_variance(outcome));
            vec![
                values(setting, outcome),
                known(reached.map(|(samples, _)| number(samples))),
                known(reached.map(|(_, rel_mse)| error_in_percent(rel_mse))),
                known(findings.ratio(outcome).map(number)),
                known(interval.map(|[low, _]| number(low))),
                known(interval.map(|[_, high]| number(high))),
                self.remark(outcome),
            ]
        };
        Table {
            name: format!("equal_time_{}", setting.name().replace(' ', "_")),
            caption: self.caption_of_equal_time(setting, findings, time),
            columns: columns(setting, &["samples after T", "error after T, %", "efficiency", "from", "to"]),
            rows: findings.outcomes.iter().map(row).collect(),
        }
    }

    fn caption_of_equal_time(&self, setting: Setting, findings: &Findings, time: Option<f64>) -> String {
        let name = setting.label();
        let time = time.map_or_else(
            || format!("{name}: no setting has noise without bias, so there is no time T at which to compare."),
            |seconds| {
                format!(
                    "{name} after the same rendering time T = {} s, at which the fastest of the unbiased settings ends: samples per pixel \
                     and error (the root of relMSE), interpolated between measured points on logarithmic axes ({UNKNOWN} if T is \
                     outside the measured range).",
                    significant(seconds)
                )
            },
        );
        format!(
            "{time} Efficiency is 1/(relMSE · s) at the end of the runs, relative to the best, with its 95 % interval by the spread of \
             the runs ({UNKNOWN} for the best itself and for biased settings). Twice the efficiency means the same error in half the \
             time, as long as both errors fall at the same rate. {UNTRUSTED} ({}).",
            self.circumstances(findings)
        )
    }
}

/// Columns for the value of a setting, numbers and a remark.
fn columns(setting: Setting, numbers: &[&str]) -> Vec<Column> {
    let numbers = numbers.iter().copied().map(Column::number);
    std::iter::once(Column::text(&setting.name())).chain(numbers).chain([Column::text("remark")]).collect()
}

/// Formats a number with three significant digits.
fn number(x: f64) -> String {
    significant(x).replace('-', "−")
}

fn known(cell: Option<String>) -> String {
    cell.unwrap_or_else(|| UNKNOWN.to_owned())
}

/// The root of a relMSE, in per cent.
fn error_in_percent(rel_mse: f64) -> String {
    number(100.0 * rel_mse.sqrt())
}

/// An exponent and half the width of its interval, if there is one.
fn exponents(slope: Option<Slope>, is_bounded: bool) -> [String; 2] {
    let Some([exponent, width]) = slope.map(exponent) else { return [UNKNOWN; 2].map(str::to_owned) };
    [exponent, known(is_bounded.then_some(width))]
}
