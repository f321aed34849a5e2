//! Errors so far: a curve over samples and time for each setting of the same picture.
use std::sync::Arc;

use noisefall::{
    render::{Frame, settings_text::options, sharing::sharing_name, truth::Reference},
    scene::{Camera, RenderSettings, Scene},
    study::{Slope, slope},
};

use super::colours::COLOURS;
use crate::viewer::background::display_image::ReferenceComparison;

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
    /// Of the mean over the picture, in standard errors.
    pub bias: Option<f64>,
    /// Whether pixels share paths.
    pub shares: bool,
}

/// The figures of one setting.
pub struct Curve {
    pub settings: RenderSettings,
    pub generation: u64,
    pub moments: Vec<Moment>,
}

/// The horizontal axis of the curves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HorizontalAxis {
    #[default]
    Samples,
    Seconds,
}

/// The vertical axis of the curves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    #[default]
    Error,
    Bias,
}

/// The curves of one picture: the same scene and camera.
#[derive(Default)]
pub struct History {
    pub curves: Vec<Curve>,
    pub over: HorizontalAxis,
    pub what: Quantity,
    subject: Option<(Arc<Scene>, Camera)>,
    truth: Option<Arc<Reference>>,
}

/// One curve for each colour: the oldest is dropped for a new one.
const MOST_CURVES: usize = COLOURS.len();
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
            shares: frame.shares,
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
    /// Whether the pixels of its picture share paths.
    pub fn shares(&self) -> bool {
        self.moments.last().is_some_and(|moment| moment.shares)
    }

    /// Places with a positive error, which a logarithm needs.
    pub fn errors(&self, over: HorizontalAxis, error: impl Fn(&Moment) -> Option<f64>) -> Vec<(f64, f64)> {
        let points = self.moments.iter().filter_map(|moment| Some((moment.over(over), error(moment)?)));
        points.filter(|(x, y)| *x > 0.0 && *y > 0.0 && y.is_finite()).collect()
    }

    /// How the estimated error falls: the slope over moments that are about doublings, from 4 samples on.
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

impl History {
    /// Drops curves of another picture, and errors against another reference.
    pub fn look_at(&mut self, scene: &Arc<Scene>, camera: &Camera, truth: Option<&Arc<Reference>>) {
        if self.truth.as_ref().map(Arc::as_ptr) != truth.map(Arc::as_ptr) {
            let moments = self.curves.iter_mut().flat_map(|curve| &mut curve.moments);
            moments.for_each(|moment| (moment.true_error, moment.bias) = (None, None));
            self.truth = truth.cloned();
        }
        let same = |(old, at): &(Arc<Scene>, Camera)| Arc::ptr_eq(old, scene) && at == camera;
        if !self.subject.as_ref().is_some_and(same) {
            self.curves.clear();
            self.subject = Some((scene.clone(), *camera));
        }
    }

    /// Records a full frame. A new generation replaces the curve of the same settings.
    pub fn record(&mut self, settings: &RenderSettings, generation: u64, moment: Moment) {
        let known = self.curves.iter().position(|curve| curve.settings == *settings);
        let curve = match known {
            Some(at) => &mut self.curves[at],
            None => {
                if self.curves.len() == MOST_CURVES {
                    let oldest = (0..MOST_CURVES).min_by_key(|&at| self.curves[at].generation).unwrap_or(0);
                    self.curves.remove(oldest);
                }
                self.curves.push(Curve { settings: *settings, generation, moments: Vec::new() });
                self.curves.last_mut().expect("it was just added")
            }
        };
        if curve.generation != generation {
            (curve.generation, curve.moments) = (generation, Vec::new());
        }
        let last = curve.moments.last().map_or(0.0, |last| f64::from(last.spp));
        if f64::from(moment.spp) >= last * SPACING && f64::from(moment.spp) > last {
            curve.moments.push(moment);
        } else if moment.spp > 0 && moment.true_error.is_some() {
            // A truth that came later is held against what is there.
            if let Some(last) = curve.moments.last_mut().filter(|last| last.spp == moment.spp) {
                *last = moment;
            }
        }
    }

    /// Names a curve by the settings that differ from those of the scene, and by sharing.
    pub fn name(&self, curve: &Curve) -> String {
        let of_scene = self.subject.as_ref().map_or_else(RenderSettings::default, |(scene, _)| scene.settings);
        let bias = if curve.settings.bias().is_some() { " (biased)" } else { "" };
        name(&curve.settings, &of_scene, curve.shares()) + bias
    }
}

/// Names settings by what differs from those of the scene, and by whether pixels share paths.
pub fn name(settings: &RenderSettings, of_scene: &RenderSettings, shares: bool) -> String {
    let differences = options(settings, of_scene);
    let mut parts: Vec<&str> = differences.split(" --").filter(|part| !part.is_empty()).collect();
    if parts.is_empty() {
        parts.push("as the scene opens");
    }
    // The word for it says less than what became of it.
    parts.retain(|part| !part.starts_with("reuse "));
    parts.push(sharing_name(shares));
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use noisefall::{
        sampling::Sampler,
        scene::{Reuse, built_in},
    };

    use super::*;

    fn moment(spp: u32, error: f64) -> Moment {
        Moment { spp, seconds: f64::from(spp) * 0.5, estimated: Some(error), true_error: None, bias: None, shares: false }
    }

    fn looking_at(scene: &Arc<Scene>) -> History {
        let mut history = History::default();
        history.look_at(scene, &scene.camera, None);
        history
    }

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
    fn the_slope_is_that_of_the_estimate_from_four_samples_on() {
        let scene = Arc::new(built_in());
        let mut history = looking_at(&scene);
        // Wild before the fourth sample, and −1/2 from there.
        for (spp, error) in [(1, 9.0), (2, 0.1)].into_iter().chain((2..12).map(|k| (1 << k, 2f64.powf(-0.5 * f64::from(k))))) {
            history.record(&scene.settings, 1, moment(spp, error));
        }
        for over in [HorizontalAxis::Samples, HorizontalAxis::Seconds] {
            let slope = history.curves[0].slope(over).expect("there are enough moments");
            assert!((slope.slope + 0.5).abs() < 1e-9 && slope.half_width < 1e-6, "{over:?} {}", slope.slope);
        }
    }

    #[test]
    fn a_new_start_replaces_its_own_curve_and_the_oldest_makes_place() {
        let scene = Arc::new(built_in());
        let mut history = looking_at(&scene);
        history.record(&scene.settings, 1, moment(8, 0.5));
        history.record(&scene.settings, 1, moment(8, 0.4));
        for spp in [16, 100, 102, 104] {
            history.record(&scene.settings, 1, moment(spp, 0.3));
        }
        let kept: Vec<u32> = history.curves[0].moments.iter().map(|moment| moment.spp).collect();
        assert_eq!(kept, [8, 16, 100, 104], "and none that is too near to the one before");
        history.record(&scene.settings, 2, moment(1, 0.9));
        assert_eq!((history.curves.len(), history.curves[0].moments.len(), history.curves[0].generation), (1, 1, 2));
        let seeded = |seed| RenderSettings { seed, ..scene.settings };
        for seed in 1..=MOST_CURVES as u32 {
            history.record(&seeded(seed), u64::from(10 + seed), moment(1, 0.9));
        }
        assert_eq!(history.curves.len(), MOST_CURVES);
        assert!(history.curves.iter().all(|curve| curve.settings != scene.settings), "the oldest is gone");
        assert!(history.curves.iter().any(|curve| curve.settings == seeded(1)), "and no other");
    }

    #[test]
    fn what_was_found_is_forgotten_with_camera_scene_and_truth() {
        let scene = Arc::new(built_in());
        let truth = Arc::new(Reference::Constant([1.0; 3]));
        let with_truth = Moment { true_error: Some(0.1), bias: Some(1.0), ..moment(4, 0.2) };
        let start = || {
            let mut history = History::default();
            history.look_at(&scene, &scene.camera, Some(&truth));
            history.record(&scene.settings, 1, with_truth);
            history
        };
        let mut same = start();
        same.look_at(&scene, &scene.camera, Some(&truth));
        assert_eq!(same.curves[0].moments[0].true_error, Some(0.1));
        // Another truth: the curve stays, the errors against the old one go, and those against the new one come in their place.
        same.look_at(&scene, &scene.camera, None);
        let last = same.curves[0].moments[0];
        assert_eq!((last.true_error, last.bias, last.estimated), (None, None, Some(0.2)));
        same.record(&scene.settings, 1, with_truth);
        assert_eq!(same.curves[0].moments[0].true_error, Some(0.1));
        let mut moved = start();
        moved.look_at(&scene, &Camera { fov: 50.0, ..scene.camera }, Some(&truth));
        assert!(moved.curves.is_empty());
        let mut other = start();
        other.look_at(&Arc::new(built_in()), &scene.camera, Some(&truth));
        assert!(other.curves.is_empty());
    }

    #[test]
    fn a_curve_is_named_by_what_differs_and_says_that_it_is_biased() {
        let scene = Arc::new(built_in());
        let mut history = looking_at(&scene);
        let changed = RenderSettings { sampler: Sampler::Independent, max_bounces: Some(3), ..scene.settings };
        for (generation, settings) in [(1, scene.settings), (2, changed)] {
            history.record(&settings, generation, moment(1, 0.5));
        }
        let names: Vec<String> = history.curves.iter().map(|curve| history.name(curve)).collect();
        assert_eq!(names[0], "as the scene opens, no sharing");
        assert!(names[1].contains("independent") && names[1].contains('3') && names[1].ends_with(" (biased)"), "{}", names[1]);
        let never = RenderSettings { reuse: Reuse::Off, ..scene.settings };
        assert_eq!(name(&never, &scene.settings, false), "no sharing");
        assert_eq!(name(&scene.settings, &scene.settings, true), "as the scene opens, shared paths");
    }
}
