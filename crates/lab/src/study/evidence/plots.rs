//! The plots of the chapter.
use super::exhibits::Exhibits;
use crate::{
    report::plot::{Axis, BESIDE, Plot, Style, curve},
    study::{Findings, Outcome, figures::by_setting},
};
use noisefall_scene::scene::RenderSettings;

impl Exhibits<'_> {
    /// All plots with their file names and captions.
    pub fn plots(&self) -> Vec<(String, String, Plot)> {
        let mut plots = Vec::new();
        for setting in [RenderSettings::SAMPLER, RenderSettings::DIRECTIONS, RenderSettings::ESTIMATOR, RenderSettings::ROULETTE]
        {
            let pair = self.of(setting).and_then(|findings| Some((findings, by_setting(findings, setting)?)));
            if let Some((findings, pair)) = pair {
                let rendering = self.rendering(findings);
                for (name, plot) in ["time", "samples"].into_iter().zip(pair.plots) {
                    let settings = pair.caption.trim_end_matches('.');
                    let caption = format!("Error against {name} by {}. {settings} ({rendering}).", setting.name());
                    plots.push((format!("error_by_{}_{name}", setting.name()), caption, plot));
                }
            }
        }
        plots.extend(self.of(RenderSettings::SAMPLER).map(|findings| self.variance(findings)));
        plots
    }

    /// A plot of the variance of a pixel against the number of samples, with its file name and caption.
    fn variance(&self, findings: &Findings) -> (String, String, Plot) {
        let mean_of_runs = |outcome: &Outcome| -> Vec<(f64, f64)> {
            let runs = &outcome.variances;
            let shortest = runs.iter().map(Vec::len).min().unwrap_or(0);
            (0..shortest).map(|i| (runs[0][i].0, runs.iter().map(|run| run[i].1).sum::<f64>() / runs.len() as f64)).collect()
        };
        let mut curves = Vec::new();
        for outcome in &findings.outcomes {
            let (name, points) = (RenderSettings::SAMPLER.value(&outcome.settings), mean_of_runs(outcome));
            curves.push(curve(name.clone(), Style::Line, points.clone()));
            curves.push(curve(name, Style::Points, points));
        }
        curves.retain(|curve| !curve.points.is_empty());
        let caption = format!(
            "Variance of a pixel against the number of samples, by sampler: the mean squared error over pixels and channels, minus the error of the reference, (W/(sr m²))² ({}).",
            self.circumstances(findings)
        );
        let y = Axis::log("mean squared error (variance of a pixel)");
        ("variance".to_owned(), caption, Plot { size: BESIDE, x: Axis::log("samples per pixel"), y, curves })
    }
}
