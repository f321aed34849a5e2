//! The tables of the chapter. Their cells are single numbers, so that programs read them too; – is for what is not known.
use super::exhibits::Exhibits;
use crate::{
    report::table::{Column, Table},
    study::{
        Findings, Outcome, Slope,
        figures::capitalised,
        fit::slope,
        outcome::ROUNDING,
        report::values,
        setting::Setting,
        wording::{exponent, mean_and_error, significant},
    },
};

/// Two-sided 95 % of the normal distribution.
const NORMAL_95: f64 = 1.96;
/// A cell of what is not known.
const UNKNOWN: &str = "–";

impl Exhibits<'_> {
    /// All tables, in the order of the chapter.
    pub fn tables(&self) -> Vec<Table> {
        let convergence = self.of(Setting::Sampler).map(|findings| self.convergence(findings));
        let bias = [(Setting::Cap, "bias_of_caps"), (Setting::Roulette, "bias_of_roulette")];
        let bias = bias.into_iter().filter_map(|(setting, name)| Some(self.bias(setting, name, self.of(setting)?)));
        let equal_time = [Setting::Directions, Setting::Estimator, Setting::Sampler, Setting::Roulette];
        let equal_time = equal_time.into_iter().filter_map(|setting| Some(self.equal_time(setting, self.of(setting)?)));
        convergence.into_iter().chain(bias).chain(equal_time).collect()
    }

    /// How error and variance fall.
    fn convergence(&self, findings: &Findings) -> Table {
        let row = |outcome: &Outcome| {
            let last = outcome.last();
            let [of_error, error_width] = exponents(outcome.slope);
            let [of_variance, variance_width] = exponents(slope(&outcome.variances));
            let (name, remark) = (values(Setting::Sampler, outcome), self.remark(outcome));
            let error = if outcome.is_exact() { UNKNOWN.to_owned() } else { error_in_percent(last.rel_mse) };
            vec![name, last.spp.to_string(), error, of_error, error_width, of_variance, variance_width, remark]
        };
        let numbers = ["samples", "error, %", "exponent of the error", "± (error)", "exponent of the variance", "± (variance)"];
        Table {
            name: "convergence".to_owned(),
            caption: format!(
                "Error, the root of relMSE, after so many samples a pixel N, and the exponents of N by which it and the variance of a \
                 pixel fall, ± half the width of their 95 % intervals. The variance is measured: it is the mean squared error over \
                 pixels and channels, without the reference's own. Independent samples have −1/2 and −1, samples that are spread \
                 evenly less ({}).",
                self.circumstances(findings)
            ),
            columns: columns(Setting::Sampler, &numbers),
            rows: findings.outcomes.iter().map(row).collect(),
        }
    }

    /// How far the mean is from that of the reference, and how far it could be.
    fn bias(&self, setting: Setting, name: &str, findings: &Findings) -> Table {
        let mut sorted: Vec<&Outcome> = findings.outcomes.iter().collect();
        sorted.sort_by_key(|outcome| outcome.settings.max_bounces.unwrap_or(u32::MAX));
        Table {
            name: name.to_owned(),
            caption: format!(
                "Bias: the mean of the picture less that of the reference, W/(sr m²), and its standard error by the variance of the \
                 samples (of stratified and Sobol samples at most so large); z, the bias in standard errors, {UNKNOWN} where samples \
                 do not vary; the bias as a part of the mean, and the largest one that 95 % confidence leaves, {UNKNOWN} where the \
                 variance may be infinite ({}).",
                self.circumstances(findings)
            ),
            columns: columns(setting, &["bias", "standard error", "z", "of the mean, %", "excluded beyond, %"]),
            rows: sorted.into_iter().map(|outcome| self.row_of_bias(setting, outcome, findings.limits.mean.abs())).collect(),
        }
    }

    fn row_of_bias(&self, setting: Setting, outcome: &Outcome, mean: f64) -> Vec<String> {
        let found = outcome.mean_error;
        let (bias, standard_error) = mean_and_error(found);
        // Below the rounding of single precision a difference is no matter of chance.
        let z = (found.standard_error > ROUNDING.sqrt() * mean).then(|| number(found.mean / found.standard_error));
        let most = found.mean.abs() + NORMAL_95 * found.standard_error;
        // What the samples say of an infinite variance bounds nothing.
        let is_finite = self.subject.scene.infinite_variance(&outcome.settings).is_none();
        vec![
            values(setting, outcome),
            bias,
            known(standard_error),
            known(z),
            number(100.0 * found.mean / mean),
            known(is_finite.then(|| number(100.0 * most / mean))),
            self.remark(outcome),
        ]
    }

    /// What is reached in the same time.
    fn equal_time(&self, setting: Setting, findings: &Findings) -> Table {
        let time = findings.equal_time();
        let row = |outcome: &Outcome| {
            let reached = time.and_then(|seconds| outcome.after(seconds)).filter(|_| !outcome.is_exact());
            let interval = findings.interval(outcome);
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
            name: format!("equal_time_{}", setting.name()),
            caption: self.caption_of_equal_time(setting, findings, time),
            columns: columns(setting, &["samples after T", "error after T, %", "efficiency", "from", "to"]),
            rows: findings.outcomes.iter().map(row).collect(),
        }
    }

    fn caption_of_equal_time(&self, setting: Setting, findings: &Findings, time: Option<f64>) -> String {
        let name = capitalised(setting.name());
        let time = time.map_or_else(
            || format!("{name}: none has noise without being biased or too noisy, and there is no time T to compare at."),
            |seconds| {
                format!(
                    "{name} after the same rendering time T = {} s, the shortest of those that are neither biased nor too noisy: samples \
                     a pixel and error, the root of relMSE, on straight lines between the logarithms of what was measured ({UNKNOWN} \
                     where T is before or after all of it).",
                    significant(seconds)
                )
            },
        );
        format!(
            "{time} Efficiency is 1/(relMSE · s) at the end of the runs, as a part of the best, and the ends of its 95 % interval by the \
             spread of the runs ({UNKNOWN} for the best itself, and for what is biased, too noisy or has less than a tenth of its \
             efficiency); of two the one of twice the efficiency needs half the time for the same error where both errors fall alike \
             ({}).",
            self.circumstances(findings)
        )
    }
}

/// The values of a setting, numbers, and a remark.
fn columns(setting: Setting, numbers: &[&str]) -> Vec<Column> {
    let numbers = numbers.iter().copied().map(Column::number);
    std::iter::once(Column::text(setting.name())).chain(numbers).chain([Column::text("remark")]).collect()
}

/// Three digits.
fn number(x: f64) -> String {
    significant(x).replace('-', "−")
}

fn known(cell: Option<String>) -> String {
    cell.unwrap_or_else(|| UNKNOWN.to_owned())
}

/// Of a relMSE.
fn error_in_percent(rel_mse: f64) -> String {
    number(100.0 * rel_mse.sqrt())
}

fn exponents(slope: Option<Slope>) -> [String; 2] {
    slope.map_or_else(|| [UNKNOWN; 2].map(str::to_owned), exponent)
}
