//! The curves as files: CSV of every figure, SVG of the plot.
use noisefall_lab::report::plot::{Axis, Style, curve, svg};
use noisefall_scene::scene::RenderSettings;

use super::{
    colours::COLOURS,
    curve::{Curve, HorizontalAxis, Moment},
    history::History,
    legend::slope_text,
};

const SIZE: (u32, u32) = (900, 540);

impl History {
    /// One line a moment, with a heading. What is not known is empty.
    pub fn csv(&self) -> Result<Vec<u8>, String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let heading = [
            "name",
            "settings",
            "path_reuse",
            "hidden",
            "spp",
            "seconds",
            "estimated_error",
            "relative_error",
            "bias_in_standard_errors",
            "relative_bias_of_cap",
            "heavy_tail",
        ];
        let failed = |error: csv::Error| error.to_string();
        writer.write_record(heading).map_err(failed)?;
        for curve in &self.curves {
            let [name, settings] = [self.name(curve), self.own_name(curve)];
            let path_reuse = |moment: &Moment| moment.path_reuse.reuse().word().name.to_owned();
            let [hidden, heavy_tail] = [curve.is_hidden, curve.has_heavy_tail()].map(|is| is.to_string());
            for moment in &curve.moments {
                let text = |x: Option<f64>| x.map_or_else(String::new, |x| format!("{x:e}"));
                let figures = [moment.noise, moment.true_error, moment.bias, self.bias_of_cap(curve)].map(text);
                let of_curve = [name.clone(), settings.clone(), path_reuse(moment), hidden.clone()];
                let row = of_curve.into_iter().chain([moment.spp.to_string(), moment.seconds.to_string()]).chain(figures);
                writer.write_record(row.chain([heavy_tail.clone()])).map_err(failed)?;
            }
        }
        writer.into_inner().map_err(|error| error.to_string())
    }

    /// The plot of errors, with the curves, colours and names of the window.
    pub fn svg(&self) -> String {
        let x = match self.over {
            HorizontalAxis::Samples => "samples per pixel",
            HorizontalAxis::Seconds => "seconds",
        };
        let drawn = |c: &Curve, style, points| {
            let slope = slope_text(c, self.over).map_or_else(String::new, |slope| format!(", {slope}"));
            let [red, green, blue, _] = COLOURS[c.colour].to_array();
            curve(format!("{}{slope}", self.name(c)), style, points).coloured([red, green, blue])
        };
        let of_curve = |c: &Curve| {
            let noise = c.errors(self.over, |moment| moment.noise);
            let ends = noise.first().zip(noise.last()).filter(|_| noise.len() > 1);
            let bias = self.bias_of_cap(c).zip(ends).map(|(bias, (first, last))| vec![(first.0, bias), (last.0, bias)]);
            let error = c.errors(self.over, |moment| moment.true_error);
            [drawn(c, Style::Line, noise), drawn(c, Style::Points, error), drawn(c, Style::Dashed, bias.unwrap_or_default())]
        };
        let mut curves: Vec<_> = self.shown().flat_map(of_curve).filter(|c| !c.points.is_empty()).collect();
        curves.push(curve("independent samples: slope -1/2", Style::Guide, self.guide()));
        let drawing = svg(SIZE, Axis::log(x), Axis::log(self.label_of_errors()), &curves);
        // Its letters are black, and viewers may be dark.
        drawing.replacen('>', "><rect width=\"100%\" height=\"100%\" fill=\"white\"/>", 1)
    }

    /// Names the plotted quantity.
    fn label_of_errors(&self) -> &'static str {
        let has_floor = self.shown().any(|curve| self.bias_of_cap(curve).is_some());
        match (self.is_measured(), has_floor) {
            (false, false) => "estimated error",
            (false, true) => "estimated error (dashed: bias of the cap)",
            (true, false) => "estimated error (points: error)",
            (true, true) => "estimated error (points: error; dashed: bias of the cap)",
        }
    }

    /// Two ends of the line that errors of independent samples follow, through the end of the current curve; through that of the last
    /// one while the current one is too short.
    pub fn guide(&self) -> Vec<(f64, f64)> {
        let long = self.shown().filter_map(|curve| {
            let points = curve.errors(self.over, |moment| moment.noise);
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

    use noisefall_render::render::{Frame, Series};
    use noisefall_scene::{
        sampling::Sampler,
        scene::{PathReuse, built_in},
    };

    use super::*;

    /// Two curves: of the scene's settings and of another sampler's.
    fn history() -> History {
        let scene = Arc::new(built_in());
        let other = RenderSettings { sampler: Sampler::Independent, ..scene.settings };
        let mut history = History::default();
        history.look_at(&scene, &scene.camera, None);
        let moment = |spp, seconds, noise, true_error, bias| {
            let path_reuse = if spp == 64 || spp == 4 { PathReuse::Suffixes } else { PathReuse::Off };
            Moment { spp, seconds, noise, true_error, bias, path_reuse, is_lower_bound: false }
        };
        history.record(&scene.settings, 1, moment(1, 0.5, None, Some(0.25), None));
        history.record(&scene.settings, 1, moment(16, 2.0, Some(0.125), Some(0.0625), Some(-1.5)));
        history.record(&other, 2, moment(4, 0.75, Some(0.5), None, None));
        history.record(&other, 2, moment(64, 12.0, Some(0.0078125), None, Some(2.25)));
        history
    }

    #[test]
    fn the_table_has_every_figure_in_its_own_column() {
        let mut history = history();
        (history.curves[1].is_hidden, history.curves[1].given_name) = (true, Some("mine".to_owned()));
        let table = String::from_utf8(history.csv().expect("it is written")).expect("it is text");
        let lines: Vec<&str> = table.lines().collect();
        assert_eq!(
            lines,
            [
                "name,settings,path_reuse,hidden,spp,seconds,estimated_error,relative_error,bias_in_standard_errors,relative_bias_of_cap,\
                 heavy_tail",
                "\"MIS, Sobol (Owen), no path reuse\",\"MIS, Sobol (Owen), no path reuse\",off,false,1,0.5,,2.5e-1,,,false",
                "\"MIS, Sobol (Owen), no path reuse\",\"MIS, Sobol (Owen), no path reuse\",off,false,16,2,1.25e-1,6.25e-2,-1.5e0,,false",
                "mine,\"Independent, reused suffixes\",suffixes,true,4,0.75,5e-1,,,,false",
                "mine,\"Independent, reused suffixes\",suffixes,true,64,12,7.8125e-3,,2.25e0,,false",
            ]
        );
    }

    #[test]
    fn the_drawing_has_the_curves_of_the_legend() {
        let mut history = history();
        let [first, second] = [0, 1].map(|at| {
            let [red, green, blue, _] = COLOURS[history.curves[at].colour].to_array();
            format!("#{red:02X}{green:02X}{blue:02X}")
        });
        let all = history.svg();
        assert!(all.contains(&first) && all.contains(&second) && all.contains("estimated error (points: error)"));
        (history.curves[0].is_hidden, history.curves[1].given_name) = (true, Some("mine".to_owned()));
        let one = history.svg();
        assert!(!one.contains(&first) && one.contains(&second), "a hidden curve is not drawn, and colours stay");
        assert!(one.contains("mine") && !one.contains("Independent, shared") && one.contains(">\nestimated error\n"), "{one}");
    }

    #[test]
    fn the_bias_of_a_cap_is_a_floor_and_the_curve_is_called_estimated_error() {
        let scene = Arc::new(built_in());
        let capped = RenderSettings { max_bounces: Some(1), ..scene.settings };
        let mut history = History::default();
        history.look_at(&scene, &scene.camera, None);
        for (spp, noise) in [(4, 0.5), (64, 0.1)] {
            let moment = Moment {
                spp,
                seconds: 1.0,
                noise: Some(noise),
                true_error: None,
                bias: None,
                path_reuse: PathReuse::Off,
                is_lower_bound: false,
            };
            history.record(&capped, 1, moment);
        }
        assert!(history.needs_series());
        let series = Series { terms: Vec::new(), shares: vec![0.5, 0.25, 0.125, 0.125] };
        history.note_series(&Frame { spp: 64, series: Some(series), ..Frame::default() });
        assert!(!history.needs_series() && history.bias_of_cap(&history.curves[0]) == Some(0.25));
        let drawing = history.svg();
        assert!(drawing.contains("dashed: bias of the cap") && !drawing.contains("points: error"), "{drawing}");
        assert!(drawing.contains("cap of 1 bounce"));
        let table = String::from_utf8(history.csv().expect("it is written")).expect("it is text");
        assert!(table.lines().skip(1).all(|line| line.ends_with(",2.5e-1,false")), "{table}");
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
    fn the_drawing_has_the_axis_of_the_plot() {
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
