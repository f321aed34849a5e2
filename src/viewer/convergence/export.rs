//! The curves as files: CSV of every figure, SVG of the plot.
use noisefall::report::plot::{Axis, Style, curve, svg};

use super::history::{Curve, History, Over};

const SIZE: (u32, u32) = (900, 540);

impl History {
    /// One line a moment, with a heading. What is not known is empty.
    pub fn csv(&self) -> Result<Vec<u8>, String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let heading =
            ["settings", "spp", "seconds", "estimated_relative_error", "true_relative_error", "bias_in_standard_errors"];
        let failed = |error: csv::Error| error.to_string();
        writer.write_record(heading).map_err(failed)?;
        for curve in &self.curves {
            let name = self.name(curve);
            for moment in &curve.moments {
                let text = |x: Option<f64>| x.map_or_else(String::new, |x| format!("{x:e}"));
                let [estimated, truth, bias] = [moment.estimated, moment.true_error, moment.bias].map(text);
                let row = [name.clone(), moment.spp.to_string(), moment.seconds.to_string(), estimated, truth, bias];
                writer.write_record(row).map_err(failed)?;
            }
        }
        writer.into_inner().map_err(|error| error.to_string())
    }

    /// The plot of errors.
    pub fn svg(&self) -> String {
        let x = match self.over {
            Over::Samples => "samples per pixel",
            Over::Seconds => "seconds",
        };
        let estimated = |c: &Curve| curve(self.name(c), Style::Line, c.errors(self.over, |moment| moment.estimated));
        let truth = |c: &Curve| curve(self.name(c), Style::Points, c.errors(self.over, |moment| moment.true_error));
        let mut curves: Vec<_> =
            self.curves.iter().flat_map(|c| [estimated(c), truth(c)]).filter(|c| !c.points.is_empty()).collect();
        curves.push(curve("ideal: slope -1/2", Style::Guide, self.guide()));
        let drawing = svg(SIZE, Axis::log(x), Axis::log("relative error (root of relMSE; points: true)"), &curves);
        // Its letters are black, and viewers may be dark.
        drawing.replacen('>', "><rect width=\"100%\" height=\"100%\" fill=\"white\"/>", 1)
    }

    /// Two ends of the line that errors of independent samples follow, through the end of the last curve.
    pub fn guide(&self) -> Vec<(f64, f64)> {
        let points = self.curves.iter().map(|curve| curve.errors(self.over, |moment| moment.estimated));
        let points: Vec<Vec<(f64, f64)>> = points.filter(|points| points.len() > 1).collect();
        let Some(&(x, y)) = points.last().and_then(|points| points.last()) else { return Vec::new() };
        let all = || points.iter().flatten().map(|point| point.0);
        let [low, high] = [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)];
        [low, high].map(|at| (at, y * (x / at).sqrt())).to_vec()
    }
}
