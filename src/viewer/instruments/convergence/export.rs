//! The curves as files: CSV of every figure, SVG of the plot.
use noisefall::{
    report::plot::{Axis, Style, curve, svg},
    scene::RenderSettings,
};

use super::{
    curve::{Curve, HorizontalAxis},
    history::History,
};

const SIZE: (u32, u32) = (900, 540);

impl History {
    /// One line a moment, with a heading. What is not known is empty.
    pub fn csv(&self) -> Result<Vec<u8>, String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let heading = [
            "settings",
            "sharing",
            "spp",
            "seconds",
            "estimated_relative_error",
            "true_relative_error",
            "bias_in_standard_errors",
        ];
        let failed = |error: csv::Error| error.to_string();
        writer.write_record(heading).map_err(failed)?;
        for curve in &self.curves {
            let name = self.name(curve);
            for moment in &curve.moments {
                let text = |x: Option<f64>| x.map_or_else(String::new, |x| format!("{x:e}"));
                let [estimated, truth, bias] = [moment.estimated, moment.true_error, moment.bias].map(text);
                let [spp, seconds] = [moment.spp.to_string(), moment.seconds.to_string()];
                let row = [name.clone(), moment.sharing.reuse().word().name.to_owned(), spp, seconds, estimated, truth, bias];
                writer.write_record(row).map_err(failed)?;
            }
        }
        writer.into_inner().map_err(|error| error.to_string())
    }

    /// The plot of errors.
    pub fn svg(&self) -> String {
        let x = match self.over {
            HorizontalAxis::Samples => "samples per pixel",
            HorizontalAxis::Seconds => "seconds",
        };
        let estimated = |c: &Curve| curve(self.name(c), Style::Line, c.errors(self.over, |moment| moment.estimated));
        let truth = |c: &Curve| curve(self.name(c), Style::Points, c.errors(self.over, |moment| moment.true_error));
        let mut curves: Vec<_> =
            self.curves.iter().flat_map(|c| [estimated(c), truth(c)]).filter(|c| !c.points.is_empty()).collect();
        curves.push(curve("independent samples: slope -1/2", Style::Guide, self.guide()));
        let drawing = svg(SIZE, Axis::log(x), Axis::log("relative error (root of relMSE; points: true)"), &curves);
        // Its letters are black, and viewers may be dark.
        drawing.replacen('>', "><rect width=\"100%\" height=\"100%\" fill=\"white\"/>", 1)
    }

    /// Two ends of the line that errors of independent samples follow, through the end of the current curve; through that of the last
    /// one while the current one is too short.
    pub fn guide(&self) -> Vec<(f64, f64)> {
        let long = self.curves.iter().filter_map(|curve| {
            let points = curve.errors(self.over, |moment| moment.estimated);
            (points.len() > 1).then_some((curve.settings, points))
        });
        let long: Vec<(RenderSettings, Vec<(f64, f64)>)> = long.collect();
        let current = long.iter().find(|(settings, _)| Some(*settings) == self.current).or(long.last());
        let Some(&(x, y)) = current.and_then(|(_, points)| points.last()) else { return Vec::new() };
        let all = || long.iter().flat_map(|(_, points)| points).map(|point| point.0);
        let [low, high] = [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)];
        [low, high].map(|at| (at, y * (x / at).sqrt())).to_vec()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use noisefall::{
        sampling::Sampler,
        scene::{Sharing, built_in},
    };

    use super::*;
    use crate::viewer::instruments::convergence::curve::Moment;

    /// Two curves: of the scene's settings and of another sampler's.
    fn history() -> History {
        let scene = Arc::new(built_in());
        let other = RenderSettings { sampler: Sampler::Independent, ..scene.settings };
        let mut history = History::default();
        history.look_at(&scene, &scene.camera, None);
        let moment = |spp, seconds, estimated, true_error, bias| {
            let sharing = if spp == 64 || spp == 4 { Sharing::Suffixes } else { Sharing::Nothing };
            Moment { spp, seconds, estimated, true_error, bias, sharing }
        };
        history.record(&scene.settings, 1, moment(1, 0.5, None, Some(0.25), None));
        history.record(&scene.settings, 1, moment(16, 2.0, Some(0.125), Some(0.0625), Some(-1.5)));
        history.record(&other, 2, moment(4, 0.75, Some(0.5), None, None));
        history.record(&other, 2, moment(64, 12.0, Some(0.0078125), None, Some(2.25)));
        history
    }

    #[test]
    fn the_table_has_every_figure_in_its_own_column() {
        let table = String::from_utf8(history().csv().expect("it is written")).expect("it is text");
        let lines: Vec<&str> = table.lines().collect();
        assert_eq!(
            lines,
            [
                "settings,sharing,spp,seconds,estimated_relative_error,true_relative_error,bias_in_standard_errors",
                "\"MIS, Sobol (Owen), no sharing\",off,1,0.5,,2.5e-1,",
                "\"MIS, Sobol (Owen), no sharing\",off,16,2,1.25e-1,6.25e-2,-1.5e0",
                "\"Independent, shared paths\",on,4,0.75,5e-1,,",
                "\"Independent, shared paths\",on,64,12,7.8125e-3,,2.25e0",
            ]
        );
    }

    #[test]
    fn the_guide_has_slope_one_half_and_runs_through_the_end_of_the_last_curve() {
        let mut history = history();
        // From the first moment with an error to the last of all curves.
        assert_eq!(history.guide(), [(4.0, 0.0078125 * 4.0), (64.0, 0.0078125)]);
        history.over = HorizontalAxis::Seconds;
        let [(from, high), (to, low)] = history.guide()[..] else { panic!("it has two ends") };
        assert_eq!((from, to, low), (0.75, 12.0, 0.0078125));
        assert!((high / low - 4.0).abs() < 1e-12, "16 times the time, a quarter of the error");
        assert_eq!(History::default().guide(), []);
        // It follows the curve that grows, wherever it stands in the list.
        history.over = HorizontalAxis::Samples;
        history.curves.swap(0, 1);
        history.current = Some(history.curves[0].settings);
        assert_eq!(history.guide(), [(4.0, 0.0078125 * 4.0), (64.0, 0.0078125)]);
    }

    #[test]
    fn the_drawing_is_over_what_the_plot_is_over() {
        let mut history = history();
        let over_samples = history.svg();
        assert!(over_samples.contains("samples per pixel") && over_samples.contains("Independent"));
        assert_eq!(over_samples.matches("<circle").count(), 2, "points are true: two of them");
        history.over = HorizontalAxis::Seconds;
        let over_seconds = history.svg();
        assert!(over_seconds.contains("seconds") && !over_seconds.contains("samples per pixel"));
        assert_ne!(over_samples, over_seconds);
    }
}
