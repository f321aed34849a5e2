//! A curve of the error of one setting, run by run.
use std::sync::{Arc, Weak};

use noisefall_lab::study::{Slope, slope};
use noisefall_render::render::{Frame, reference::Reference};
use noisefall_scene::scene::{PathReuse, RenderSettings};

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
    /// Relative noise: the root of relMSE as it is estimated from the samples, which do not see a bias.
    pub noise: Option<f64>,
    /// Relative error: the root of relMSE against the reference.
    pub true_error: Option<f64>,
    /// Bias of the mean over the image, in standard errors.
    pub bias: Option<f64>,
    /// Path reuse between the pixels.
    pub path_reuse: PathReuse,
    /// Few pixels carry the noise, so that it may be much larger.
    pub is_lower_bound: bool,
}

/// The figures of one setting.
pub struct Curve {
    pub settings: RenderSettings,
    pub generation: u64,
    pub moments: Vec<Moment>,
    /// Place of its colour.
    pub colour: usize,
    pub is_hidden: bool,
    /// The name that the user gave it.
    pub given_name: Option<String>,
    /// The figures against references that are not in force.
    put_away: Vec<PutAway>,
    /// The figures of a later run with the same settings, while it is the shorter one.
    later_run: Option<Vec<Moment>>,
}

/// Figures against a reference that is not in force, by sample count.
struct PutAway {
    reference: Weak<Reference>,
    figures: Vec<(u32, Option<f64>, Option<f64>)>,
}

/// Rise of the noise · √N of a curve beyond which its tail is heavy: the variance is still found. In the shipped scenes without heavy
/// tails it rises by up to 1.2 after a power of two that suits Sobol points, and in `caustic_in_mirror` threefold.
const HEAVIEST_RISE: f64 = 1.4;

/// Least ratio of the sample counts of successive moments.
const SPACING: f64 = 1.03;

impl Moment {
    pub fn of(frame: &Frame, comparison: Option<ReferenceComparison>) -> Moment {
        Moment {
            spp: frame.spp,
            seconds: frame.elapsed.as_secs_f64(),
            noise: frame.rel_mse_estimate.map(f64::sqrt),
            true_error: comparison.map(|comparison| comparison.rel_mse.sqrt()),
            bias: comparison.and_then(|comparison| comparison.bias),
            path_reuse: frame.path_reuse,
            is_lower_bound: frame.error_is_lower_bound,
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
    pub fn new(settings: RenderSettings, generation: u64, colour: usize) -> Curve {
        Curve {
            settings,
            generation,
            moments: Vec::new(),
            colour,
            is_hidden: false,
            given_name: None,
            put_away: Vec::new(),
            later_run: None,
        }
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

    /// Puts the figures against a reference away, and gets those against another one back: an undo returns to a reference.
    pub fn exchange_reference(&mut self, from: Option<&Arc<Reference>>, to: Option<&Arc<Reference>>) {
        self.put_away.retain(|known| known.reference.strong_count() > 0);
        let figures = self.moments.iter().filter(|moment| moment.true_error.is_some() || moment.bias.is_some());
        let figures: Vec<_> = figures.map(|moment| (moment.spp, moment.true_error, moment.bias)).collect();
        if let Some(from) = from.filter(|_| !figures.is_empty()) {
            self.put_away.push(PutAway { reference: Arc::downgrade(from), figures });
        }
        let moments = self.moments.iter_mut().chain(self.later_run.iter_mut().flatten());
        moments.for_each(|moment| (moment.true_error, moment.bias) = (None, None));
        let is_to = |known: &PutAway| to.is_some_and(|to| known.reference.as_ptr() == Arc::as_ptr(to));
        let Some(at) = self.put_away.iter().position(is_to) else { return };
        for (spp, true_error, bias) in self.put_away.remove(at).figures {
            if let Some(moment) = self.moments.iter_mut().find(|moment| moment.spp == spp) {
                (moment.true_error, moment.bias) = (true_error, bias);
            }
        }
    }

    /// Returns the path reuse of its image.
    pub fn path_reuse(&self) -> PathReuse {
        self.moments.last().map_or(PathReuse::Off, |moment| moment.path_reuse)
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

    /// Slope of the noise over moments that are about doublings, if it is known to a half.
    pub fn slope(&self, over: HorizontalAxis) -> Option<Slope> {
        slope(&[self.doublings(over)]).filter(|slope| slope.half_width < 0.5)
    }

    /// Whether the latest noise is a lower bound.
    pub fn noise_is_lower_bound(&self) -> bool {
        self.moments.last().is_some_and(|moment| moment.is_lower_bound)
    }

    /// Whether few samples carry the noise, or it falls more slowly than that of independent samples, at least for a while: rare bright
    /// samples are still being found, so the slope is not what it will be.
    pub fn has_heavy_tail(&self) -> bool {
        if self.moments.iter().filter(|moment| moment.spp >= 4).any(|moment| moment.is_lower_bound) {
            return true;
        }
        let doublings = self.doublings(HorizontalAxis::Samples);
        // Two points are no curve.
        if doublings.len() < 3 {
            return false;
        }
        let scaled = doublings.into_iter().map(|(n, noise)| noise * n.sqrt());
        let mut least = f64::INFINITY;
        scaled.into_iter().any(|scaled| {
            least = least.min(scaled);
            scaled > HEAVIEST_RISE * least
        })
    }

    /// The noise at moments that are about doublings, from 4 samples on.
    fn doublings(&self, over: HorizontalAxis) -> Vec<(f64, f64)> {
        let mut doublings: Vec<(f64, f64)> = Vec::new();
        for point in self.errors(over, |moment| moment.noise.filter(|_| moment.spp >= 4)) {
            if doublings.last().is_none_or(|last| point.0 >= 1.9 * last.0) {
                doublings.push(point);
            }
        }
        doublings
    }
}

/// Appends a moment with clearly more samples than the last one.
fn append(moments: &mut Vec<Moment>, moment: Moment) {
    let last = moments.last().map_or(0.0, |last| f64::from(last.spp));
    if f64::from(moment.spp) >= last * SPACING && f64::from(moment.spp) > last {
        moments.push(moment);
    } else if moment.spp > 0 && moment.true_error.is_some() {
        // A reference that came later is compared with the same samples.
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
        assert!((all.noise.expect("it is known") - 0.2).abs() < 1e-12);
        let alone = Moment::of(&frame, None);
        assert_eq!((alone.true_error, alone.bias, alone.noise), (None, None, all.noise));
        assert_eq!((all.over(HorizontalAxis::Samples), all.over(HorizontalAxis::Seconds)), (7.0, 1.5));
    }

    #[test]
    fn the_tail_of_a_curve_is_heavy_if_its_noise_once_falls_too_slowly() {
        let curve = |noise: &dyn Fn(f64) -> f64| {
            let mut curve = Curve::new(RenderSettings::default(), 1, 0);
            for doubling in 0..10 {
                let n = f64::from(1 << doubling);
                let noise = Some(noise(n));
                let moment = Moment {
                    spp: 1 << doubling,
                    seconds: n,
                    noise,
                    true_error: None,
                    bias: None,
                    path_reuse: PathReuse::Off,
                    is_lower_bound: false,
                };
                curve.record(1, moment);
            }
            curve.has_heavy_tail()
        };
        // Independent, stratified, and wild only before the fourth sample.
        assert!(!curve(&|n| n.powf(-0.5)) && !curve(&|n| n.powf(-0.75)));
        assert!(!curve(&|n| if n < 4.0 { 0.01 } else { n.powf(-0.5) }));
        // A slope of infinite variance, and one outlier that is found late.
        assert!(curve(&|n| n.powf(-0.4)));
        assert!(curve(&|n| n.powf(-0.5) * if n < 100.0 { 1.0 } else { 1.5 }));
    }

    #[test]
    fn errors_against_a_reference_that_came_later_are_those_of_the_later_run() {
        let moment = |spp: u32, true_error| Moment {
            spp,
            seconds: f64::from(spp),
            noise: Some(0.5),
            true_error,
            bias: true_error,
            path_reuse: PathReuse::Off,
            is_lower_bound: false,
        };
        let mut curve = Curve::new(RenderSettings::default(), 1, 0);
        curve.record(1, moment(100, None));
        curve.record(2, moment(8, Some(0.25)));
        let over = HorizontalAxis::Samples;
        assert_eq!(curve.errors(over, |moment| moment.noise), [(100.0, 0.5)]);
        assert_eq!(curve.errors(over, |moment| moment.true_error), [(8.0, 0.25)]);
        assert_eq!(curve.values(over, |moment| moment.bias), [(8.0, 0.25)]);
    }

    #[test]
    fn a_run_that_starts_over_replaces_its_curve_when_it_is_longer_and_one_that_goes_on_continues_it() {
        let moment = |spp: u32, error| Moment {
            spp,
            seconds: f64::from(spp) * 0.5,
            noise: Some(error),
            true_error: None,
            bias: None,
            path_reuse: PathReuse::Off,
            is_lower_bound: false,
        };
        let mut curve = Curve::new(RenderSettings::default(), 1, 0);
        [8, 16, 100].into_iter().for_each(|spp| curve.record(1, moment(spp, 0.1)));
        let spps = |curve: &Curve| curve.moments.iter().map(|moment| moment.spp).collect::<Vec<_>>();
        // Its samples are given back.
        curve.record(2, moment(110, 0.1));
        assert_eq!((spps(&curve), curve.generation), (vec![8, 16, 100, 110], 2));
        [1, 50, 110].into_iter().for_each(|spp| curve.record(3, moment(spp, 0.2)));
        assert_eq!((spps(&curve), curve.generation), (vec![8, 16, 100, 110], 3), "the longer one stays");
        curve.record(3, moment(120, 0.2));
        assert_eq!(spps(&curve), [1, 50, 110, 120]);
        assert!(curve.moments.iter().all(|moment| moment.noise == Some(0.2)));
        curve.record(3, moment(140, 0.2));
        assert_eq!(spps(&curve), [1, 50, 110, 120, 140]);
    }
}
