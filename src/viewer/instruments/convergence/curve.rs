//! A curve of the error of one setting, run by run.
use noisefall::{
    render::Frame,
    scene::{RenderSettings, Sharing},
    study::{Slope, slope},
};

use crate::viewer::background::display_image::ReferenceComparison;

/// The horizontal axis of the curves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HorizontalAxis {
    #[default]
    Samples,
    Seconds,
}

/// The figures of one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    pub spp: u32,
    /// Time spent rendering.
    pub seconds: f64,
    /// Relative error: the root of relMSE, as estimated.
    pub estimated: Option<f64>,
    /// The same, against the truth.
    pub true_error: Option<f64>,
    /// Bias of the mean over the image, in standard errors.
    pub bias: Option<f64>,
    /// What pixels share.
    pub sharing: Sharing,
}

/// The figures of one setting.
pub struct Curve {
    pub settings: RenderSettings,
    pub generation: u64,
    pub moments: Vec<Moment>,
    /// The figures of a later run with the same settings, while it is the shorter one.
    later_run: Option<Vec<Moment>>,
}

/// Least ratio of the sample counts of successive moments.
const SPACING: f64 = 1.03;

impl Moment {
    pub fn of(frame: &Frame, comparison: Option<ReferenceComparison>) -> Moment {
        Moment {
            spp: frame.spp,
            seconds: frame.elapsed.as_secs_f64(),
            estimated: frame.rel_mse_estimate.map(f64::sqrt),
            true_error: comparison.map(|comparison| comparison.rel_mse.sqrt()),
            bias: comparison.and_then(|comparison| comparison.bias),
            sharing: frame.sharing,
        }
    }

    pub fn over(&self, over: HorizontalAxis) -> f64 {
        match over {
            HorizontalAxis::Samples => f64::from(self.spp),
            HorizontalAxis::Seconds => self.seconds,
        }
    }
}

impl Curve {
    pub fn new(settings: RenderSettings, generation: u64) -> Curve {
        Curve { settings, generation, moments: Vec::new(), later_run: None }
    }

    /// Records a full frame. A run that goes on with its samples continues the curve. One that starts over replaces the curve as soon
    /// as it has more samples: a click on Restart costs no curve.
    pub fn record(&mut self, generation: u64, moment: Moment) {
        if self.generation != generation {
            self.generation = generation;
            let continues = self.moments.last().is_none_or(|last| moment.spp >= last.spp && moment.seconds >= last.seconds);
            self.later_run = (!continues).then(Vec::new);
        }
        let Some(run) = &mut self.later_run else { return append(&mut self.moments, moment) };
        append(run, moment);
        if self.moments.last().is_none_or(|last| moment.spp > last.spp) {
            self.moments = self.later_run.take().unwrap_or_default();
        }
    }

    /// Drops what was found against a reference.
    pub fn forget_truth(&mut self) {
        let moments = self.moments.iter_mut().chain(self.later_run.iter_mut().flatten());
        moments.for_each(|moment| (moment.true_error, moment.bias) = (None, None));
    }

    /// What the pixels of its picture share.
    pub fn sharing(&self) -> Sharing {
        self.moments.last().map_or(Sharing::Nothing, |moment| moment.sharing)
    }

    /// Places with a positive error, which a logarithm needs.
    pub fn errors(&self, over: HorizontalAxis, error: impl Fn(&Moment) -> Option<f64>) -> Vec<(f64, f64)> {
        self.values(over, error).into_iter().filter(|(x, y)| *x > 0.0 && *y > 0.0 && y.is_finite()).collect()
    }

    /// Places with a value. What only a later run knows, such as errors against a reference that came after the curve, is of that run.
    pub fn values(&self, over: HorizontalAxis, value: impl Fn(&Moment) -> Option<f64>) -> Vec<(f64, f64)> {
        let of = |moments: &[Moment]| {
            moments.iter().filter_map(|moment| Some((moment.over(over), value(moment)?))).collect::<Vec<_>>()
        };
        let own = of(&self.moments);
        if own.is_empty() { self.later_run.as_deref().map(of).unwrap_or_default() } else { own }
    }

    /// Slope of the estimated error over moments that are about doublings, from 4 samples on.
    pub fn slope(&self, over: HorizontalAxis) -> Option<Slope> {
        let mut doublings: Vec<(f64, f64)> = Vec::new();
        for point in self.errors(over, |moment| moment.estimated.filter(|_| moment.spp >= 4)) {
            if doublings.last().is_none_or(|last| point.0 >= 1.9 * last.0) {
                doublings.push(point);
            }
        }
        slope(&[doublings])
    }
}

/// Appends a moment with clearly more samples than the last one.
fn append(moments: &mut Vec<Moment>, moment: Moment) {
    let last = moments.last().map_or(0.0, |last| f64::from(last.spp));
    if f64::from(moment.spp) >= last * SPACING && f64::from(moment.spp) > last {
        moments.push(moment);
    } else if moment.spp > 0 && moment.true_error.is_some() {
        // A truth that came later is held against what is there.
        if let Some(last) = moments.last_mut().filter(|last| last.spp == moment.spp) {
            *last = moment;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moment_takes_its_figures_from_the_frame_and_from_the_truth() {
        let frame =
            Frame { spp: 7, elapsed: std::time::Duration::from_millis(1500), rel_mse_estimate: Some(0.04), ..Frame::default() };
        let comparison = ReferenceComparison { rel_mse: 0.25, bias: Some(-3.0) };
        let all = Moment::of(&frame, Some(comparison));
        assert_eq!((all.spp, all.seconds, all.true_error, all.bias), (7, 1.5, Some(0.5), Some(-3.0)));
        assert!((all.estimated.expect("it is known") - 0.2).abs() < 1e-12);
        let alone = Moment::of(&frame, None);
        assert_eq!((alone.true_error, alone.bias, alone.estimated), (None, None, all.estimated));
        assert_eq!((all.over(HorizontalAxis::Samples), all.over(HorizontalAxis::Seconds)), (7.0, 1.5));
    }

    #[test]
    fn errors_against_a_reference_that_came_later_are_those_of_the_later_run() {
        let moment = |spp: u32, true_error| Moment {
            spp,
            seconds: f64::from(spp),
            estimated: Some(0.5),
            true_error,
            bias: true_error,
            sharing: Sharing::Nothing,
        };
        let mut curve = Curve::new(RenderSettings::default(), 1);
        curve.record(1, moment(100, None));
        curve.record(2, moment(8, Some(0.25)));
        let over = HorizontalAxis::Samples;
        assert_eq!(curve.errors(over, |moment| moment.estimated), [(100.0, 0.5)]);
        assert_eq!(curve.errors(over, |moment| moment.true_error), [(8.0, 0.25)]);
        assert_eq!(curve.values(over, |moment| moment.bias), [(8.0, 0.25)]);
    }

    #[test]
    fn a_run_that_starts_over_replaces_its_curve_when_it_is_longer_and_one_that_goes_on_continues_it() {
        let moment = |spp: u32, error| Moment {
            spp,
            seconds: f64::from(spp) * 0.5,
            estimated: Some(error),
            true_error: None,
            bias: None,
            sharing: Sharing::Nothing,
        };
        let mut curve = Curve::new(RenderSettings::default(), 1);
        [8, 16, 100].into_iter().for_each(|spp| curve.record(1, moment(spp, 0.1)));
        let spps = |curve: &Curve| curve.moments.iter().map(|moment| moment.spp).collect::<Vec<_>>();
        // Its samples are given back.
        curve.record(2, moment(110, 0.1));
        assert_eq!((spps(&curve), curve.generation), (vec![8, 16, 100, 110], 2));
        [1, 50, 110].into_iter().for_each(|spp| curve.record(3, moment(spp, 0.2)));
        assert_eq!((spps(&curve), curve.generation), (vec![8, 16, 100, 110], 3), "the longer one stays");
        curve.record(3, moment(120, 0.2));
        assert_eq!(spps(&curve), [1, 50, 110, 120]);
        assert!(curve.moments.iter().all(|moment| moment.estimated == Some(0.2)));
        curve.record(3, moment(140, 0.2));
        assert_eq!(spps(&curve), [1, 50, 110, 120, 140]);
    }
}
