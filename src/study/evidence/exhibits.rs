//! What the chapter is made of: findings, pictures, and the tables that follow from them.
use crate::{
    render::{Display, display::to_srgb},
    report::{
        plot::{Axis, BESIDE, Plot, Style, curve},
        sheet::{Cell, sheet},
        table::{Column, Table},
    },
    scene::RenderSettings,
    study::{
        Findings, Machine, Outcome, StudyError, Subject,
        figures::{by_setting, capitalised},
        fit::slope,
        measure::Bench,
        report::values,
        setting::{Setting, label},
        wording::{self, mean_error, significant},
    },
};

/// Caps that are shown and measured.
pub const CAPS: [Option<u32>; 5] = [Some(0), Some(1), Some(2), Some(5), None];
/// Two-sided 95 % of the normal distribution.
const NORMAL_95: f64 = 1.96;

pub struct Exhibits<'a> {
    pub subject: &'a Subject,
    /// By the setting that they are about.
    pub findings: &'a [(Setting, Findings)],
    pub pictures: [Picture; 2],
    pub spp: u32,
    pub repeats: u32,
    pub machine: &'a Machine,
}

/// A labelled sheet.
pub struct Picture {
    pub name: &'static str,
    pub caption: String,
    pub png: Vec<u8>,
}

/// Pictures as samples grow, and as bounces do.
pub fn pictures(bench: Bench, spp: u32, display: Display) -> Result<[Picture; 2], StudyError> {
    /// Of the pictures of caps.
    const SPP_OF_CAPS: u32 = 64;
    let settings = RenderSettings { max_bounces: None, ..bench.scene.settings };
    let shown = |film: &_| {
        let mut pixels = Vec::new();
        to_srgb(&bench.frame(film).radiance, display, &mut pixels);
        pixels
    };
    let mut film = bench.film();
    let mut growing = Vec::new();
    for samples in (0..u32::BITS / 2).map(|power| 1 << (2 * power)).take_while(|samples| *samples <= spp) {
        bench.pass(&settings, &mut film, samples)?;
        growing.push(Cell { lines: vec![format!("N = {samples}")], pixels: shown(&film) });
    }
    let mut capped = Vec::new();
    for max_bounces in CAPS {
        let mut film = bench.film();
        bench.pass(&RenderSettings { max_bounces, ..settings }, &mut film, spp.min(SPP_OF_CAPS))?;
        let cap = max_bounces.map_or_else(|| "no cap".to_owned(), |cap| format!("at most {cap} bounces"));
        capped.push(Cell { lines: vec![cap], pixels: shown(&film) });
    }
    let of = |name, caption, cells: &[Cell]| {
        let png = bench.threads.install(|| sheet(bench.camera.resolution, 3, &[], cells)).map_err(StudyError::Renderer)?;
        Ok::<_, StudyError>(Picture { name, caption, png })
    };
    let how = label(&settings);
    Ok([
        of("pictures_by_samples", format!("The picture as the samples a pixel grow: {how}, no cap."), &growing)?,
        of(
            "pictures_by_cap",
            format!("The picture by caps on bounces, {} samples a pixel: {how}.", spp.min(SPP_OF_CAPS)),
            &capped,
        )?,
    ])
}

impl Exhibits<'_> {
    fn of(&self, setting: Setting) -> Option<&Findings> {
        self.findings.iter().find(|(of, _)| *of == setting).map(|(_, findings)| findings)
    }

    /// What every caption ends with.
    pub fn circumstances(&self) -> String {
        let [width, height] = self.subject.camera.resolution;
        format!("{width} × {height} pixels, up to {} samples a pixel, {} runs each", self.spp, self.repeats)
    }

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
            vec![
                values(Setting::Sampler, outcome),
                wording::error(outcome),
                wording::slope(outcome.slope),
                wording::slope(slope(&outcome.variances)),
            ]
        };
        Table {
            name: "convergence".to_owned(),
            caption: format!(
                "Error, the root of relMSE, after the last sample, and the exponents of N with their 95 % intervals by which the error \
                 falls, and the variance of the picture's mean as its samples give it ({}). Independent samples: −1/2 and −1.",
                self.circumstances()
            ),
            columns: [Column::text("sampler"), Column::number("error"), Column::number("exponent of the error")]
                .into_iter()
                .chain([Column::number("exponent of the variance")])
                .collect(),
            rows: findings.outcomes.iter().map(row).collect(),
        }
    }

    /// How far the mean is from that of the reference, and how far it could be.
    fn bias(&self, setting: Setting, name: &str, findings: &Findings) -> Table {
        let mean = findings.limits.mean.abs();
        let row = |outcome: &Outcome| {
            let found = outcome.mean_error;
            let most = found.mean.abs() + NORMAL_95 * found.standard_error;
            vec![
                values(setting, outcome),
                mean_error(found),
                format!("{} %", significant(100.0 * found.mean / mean)).replace('-', "−"),
                format!("{} %", significant(100.0 * most / mean)),
            ]
        };
        let mut rows: Vec<(u32, Vec<String>)> =
            findings.outcomes.iter().map(|outcome| (outcome.settings.max_bounces.unwrap_or(u32::MAX), row(outcome))).collect();
        rows.sort_by_key(|(cap, _)| *cap);
        Table {
            name: name.to_owned(),
            caption: format!(
                "Mean of the picture less that of {}, ± its standard error (of stratified and Sobol samples at most so \
                 large); the same as a part of the mean; and the largest bias that 95 % confidence leaves ({}).",
                findings.reference,
                self.circumstances()
            ),
            columns: vec![
                Column::text(setting.name()),
                Column::number("bias"),
                Column::number("of the mean"),
                Column::number("excluded beyond"),
            ],
            rows: rows.into_iter().map(|(_, row)| row).collect(),
        }
    }

    /// What is reached in the same time.
    fn equal_time(&self, setting: Setting, findings: &Findings) -> Table {
        let factor = findings.uncertainty();
        let row = |outcome: &Outcome| {
            let ratio = findings.ratio(outcome);
            let interval = ratio.zip(factor).map(|(ratio, factor)| [ratio / factor, ratio * factor].map(significant));
            let last = outcome.last();
            vec![
                values(setting, outcome),
                last.spp.to_string(),
                significant(last.seconds),
                wording::error(outcome),
                ratio.map_or_else(|| "–".to_owned(), significant),
                interval.map_or_else(|| "–".to_owned(), |[low, high]| format!("{low} to {high}")),
                if outcome.bias.is_empty() { String::new() } else { format!("biased: {}", outcome.bias) },
            ]
        };
        Table {
            name: format!("equal_time_{}", setting.name()),
            caption: format!(
                "{} at equal time ({}). Efficiency is 1/(relMSE · s), as a part of the best, with the 95 % interval that the runs give: of \
                 two the one of twice the efficiency needs half the time for the same error.",
                capitalised(setting.name()),
                self.circumstances()
            ),
            columns: [Column::text(setting.name())]
                .into_iter()
                .chain(["samples", "s", "error", "efficiency", "95 %"].map(Column::number))
                .chain([Column::text("remark")])
                .collect(),
            rows: findings.outcomes.iter().map(row).collect(),
        }
    }

    /// All plots with their names and captions.
    pub fn plots(&self) -> Vec<(String, String, Plot)> {
        let mut plots = Vec::new();
        for setting in [Setting::Sampler, Setting::Directions, Setting::Estimator, Setting::Roulette] {
            let pair = self.of(setting).and_then(|findings| by_setting(findings, setting));
            if let Some(pair) = pair {
                for (name, plot) in ["time", "samples"].into_iter().zip(pair.plots) {
                    let caption =
                        format!("Error against {name} by {}. {} {}.", setting.name(), pair.caption, self.circumstances());
                    plots.push((format!("error_by_{}_{name}", setting.name()), caption, plot));
                }
            }
        }
        plots.extend(self.of(Setting::Sampler).map(|findings| self.variance(findings)));
        plots
    }

    /// The variance of the picture's mean against the number of samples.
    fn variance(&self, findings: &Findings) -> (String, String, Plot) {
        let mean_of_runs = |outcome: &Outcome| -> Vec<(f64, f64)> {
            let runs = &outcome.variances;
            let shortest = runs.iter().map(Vec::len).min().unwrap_or(0);
            (0..shortest).map(|i| (runs[0][i].0, runs.iter().map(|run| run[i].1).sum::<f64>() / runs.len() as f64)).collect()
        };
        let mut curves = Vec::new();
        for outcome in &findings.outcomes {
            let (name, points) = (Setting::Sampler.value(&outcome.settings), mean_of_runs(outcome));
            curves.push(curve(name.clone(), Style::Line, points.clone()));
            curves.push(curve(name, Style::Points, points));
        }
        curves.retain(|curve| !curve.points.is_empty());
        let caption =
            format!("Variance of the picture's mean, as the variance of its samples gives it. {}.", self.circumstances());
        let y = Axis::log("variance of the mean");
        ("variance".to_owned(), caption, Plot { size: BESIDE, x: Axis::log("samples a pixel"), y, curves })
    }
}
