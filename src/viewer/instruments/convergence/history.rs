//! Errors so far: a curve over samples and time for each setting of the same image.
use std::sync::{Arc, Weak};

use noisefall_render::render::{Frame, reference::Reference};
use noisefall_scene::scene::{Camera, PathReuse, RenderSettings, Scene};

use super::{
    colours::COLOURS,
    curve::{Curve, HorizontalAxis, Moment},
    lost_light::LostLight,
};

/// The vertical axis of the curves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    #[default]
    Error,
    Bias,
}

/// The curves of one image: the same scene and camera. Those of other cameras, and of the scene before an edit, are kept for a return.
#[derive(Default)]
pub struct History {
    pub curves: Vec<Curve>,
    pub over: HorizontalAxis,
    pub what: Quantity,
    /// The settings that are rendered now.
    pub current: Option<RenderSettings>,
    /// The curve that is being renamed, and the name so far.
    pub renaming: Option<(RenderSettings, String)>,
    lost_light: Option<LostLight>,
    subject: Option<(Arc<Scene>, Camera)>,
    reference: Option<Arc<Reference>>,
    earlier: Vec<Earlier>,
}

/// The curves of another image.
struct Earlier {
    /// Alive as long as an undo can return to it.
    scene: Weak<Scene>,
    camera: Camera,
    reference: Option<Arc<Reference>>,
    lost_light: Option<LostLight>,
    curves: Vec<Curve>,
}

/// A drag of the camera or of an object leaves as many short sets of curves: the shortest is dropped for a new one.
const MOST_EARLIER: usize = 24;

/// One curve for each colour: the oldest is dropped for a new one.
const MOST_CURVES: usize = COLOURS.len();

impl History {
    /// Shows the curves of this image: none, or those that were recorded before, with their errors against this reference.
    pub fn look_at(&mut self, scene: &Arc<Scene>, camera: &Camera, reference: Option<&Arc<Reference>>) {
        match self.subject.take() {
            Some((old, at)) if old.has_same_image(scene) && at == *camera => {}
            Some((old, at)) => self.change_picture((&old, at), (scene, camera)),
            None => {}
        }
        self.subject = Some((scene.clone(), *camera));
        if self.reference.as_ref().map(Arc::as_ptr) != reference.map(Arc::as_ptr) {
            self.curves.iter_mut().for_each(|curve| curve.exchange_reference(self.reference.as_ref(), reference));
            self.reference = reference.cloned();
        }
    }

    /// Puts the curves of an image away, and gets those of another one back.
    fn change_picture(&mut self, (old, from): (&Arc<Scene>, Camera), (scene, to): (&Arc<Scene>, &Camera)) {
        let (curves, reference, lost_light) = (std::mem::take(&mut self.curves), self.reference.take(), self.lost_light.take());
        self.renaming = None;
        if !curves.is_empty() {
            self.earlier.push(Earlier { scene: Arc::downgrade(old), camera: from, reference, lost_light, curves });
        }
        let is_of = |earlier: &Earlier| earlier.scene.upgrade().is_some_and(|of| of.has_same_image(scene));
        if let Some(at) = self.earlier.iter().position(|earlier| earlier.camera == *to && is_of(earlier)) {
            let known = self.earlier.remove(at);
            (self.curves, self.reference, self.lost_light) = (known.curves, known.reference, known.lost_light);
        }
        if self.earlier.len() > MOST_EARLIER {
            let length = |earlier: &Earlier| earlier.curves.iter().map(|curve| curve.moments.len()).sum::<usize>();
            let shortest = (0..self.earlier.len()).min_by_key(|at| length(&self.earlier[*at]));
            shortest.into_iter().for_each(|at| drop(self.earlier.remove(at)));
        }
    }

    /// Records a full frame.
    pub fn record(&mut self, settings: &RenderSettings, generation: u64, moment: Moment) {
        let known = self.curves.iter().position(|curve| curve.settings == *settings);
        let at = known.unwrap_or_else(|| {
            if self.curves.len() == MOST_CURVES {
                let oldest = (0..MOST_CURVES).min_by_key(|&at| self.curves[at].generation).unwrap_or(0);
                self.curves.remove(oldest);
            }
            let is_free = |colour: &usize| self.curves.iter().all(|curve| curve.colour != *colour);
            let colour = (0..MOST_CURVES).find(is_free).unwrap_or_default();
            self.curves.push(Curve::new(*settings, generation, colour));
            self.curves.len() - 1
        });
        self.curves[at].record(generation, moment);
    }

    /// The curves that are plotted.
    pub fn shown(&self) -> impl DoubleEndedIterator<Item = &Curve> {
        self.curves.iter().filter(|curve| !curve.is_hidden)
    }

    /// Whether a plotted curve has an error against a reference. All else is noise.
    pub fn is_measured(&self) -> bool {
        self.shown().flat_map(|curve| &curve.moments).any(|moment| moment.true_error.is_some())
    }

    /// The name of the vertical axis of errors.
    pub fn error_title(&self) -> &'static str {
        if self.is_measured() { "error, estimated and measured" } else { "estimated error" }
    }

    /// Takes note of the series of the current image without a cap.
    pub fn note_series(&mut self, frame: &Frame) {
        if self.lost_light.as_ref().is_none_or(|known| known.spp() < frame.spp) {
            self.lost_light = LostLight::of(frame).or(self.lost_light.take());
        }
    }

    /// Whether a plotted curve has a cap whose bias is not known well.
    pub fn needs_series(&self) -> bool {
        let has_cap = self.shown().any(|curve| curve.settings.max_bounces.is_some());
        has_cap && self.lost_light.as_ref().is_none_or(LostLight::is_rough)
    }

    /// The bias of the cap of a curve, relative to the light of the image: its error does not fall far below.
    pub fn bias_of_cap(&self, curve: &Curve) -> Option<f64> {
        self.lost_light.as_ref()?.by_cap(curve.settings.max_bounces?)
    }

    /// The name of a curve: the given one, or what its settings and its path reuse are.
    pub fn name(&self, curve: &Curve) -> String {
        curve.given_name.clone().unwrap_or_else(|| self.own_name(curve))
    }

    /// Names a curve by its settings, and by path reuse.
    pub fn own_name(&self, curve: &Curve) -> String {
        let of_scene = self.subject.as_ref().map_or_else(RenderSettings::default, |(scene, _)| scene.settings);
        let bias = if curve.settings.bias_with(curve.path_reuse()).is_some() { " (biased)" } else { "" };
        name(&curve.settings, &of_scene, curve.path_reuse()) + bias
    }
}

/// Names settings by what differs from those of the scene, or by estimator and sampler if nothing does, by the cap, and by what pixels
/// share.
/// The words are those of the panel.
pub fn name(settings: &RenderSettings, of_scene: &RenderSettings, path_reuse: PathReuse) -> String {
    // The legend names the path reuse in force, whatever was asked for.
    let told = settings.differing(of_scene).filter(|setting| *setting != RenderSettings::REUSE);
    let mut parts: Vec<String> = told.map(|setting| setting.words(settings)).collect();
    if settings == of_scene {
        parts.extend([RenderSettings::ESTIMATOR, RenderSettings::SAMPLER].map(|setting| setting.words(settings)));
    }
    // An image with a cap has another limit, whichever is that of the scene.
    let cap = RenderSettings::MAX_BOUNCES;
    if settings.max_bounces.is_some() && !cap.differs(settings, of_scene) {
        parts.push(cap.words(settings));
    }
    let shared = path_reuse.words().to_owned();
    if !parts.contains(&shared) {
        parts.push(shared);
    }
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use noisefall_scene::{
        sampling::Sampler,
        scene::{Estimator, Reuse, built_in},
    };

    use super::*;

    fn moment(spp: u32, error: f64) -> Moment {
        Moment {
            spp,
            seconds: f64::from(spp) * 0.5,
            noise: Some(error),
            true_error: None,
            bias: None,
            path_reuse: PathReuse::Off,
            is_lower_bound: false,
        }
    }

    fn looking_at(scene: &Arc<Scene>) -> History {
        let mut history = History::default();
        history.look_at(scene, &scene.camera, None);
        history
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
        assert_eq!((history.curves.len(), history.curves[0].moments.len(), history.curves[0].generation), (1, 4, 2));
        history.record(&scene.settings, 2, moment(105, 0.9));
        assert_eq!((history.curves.len(), history.curves[0].moments.len()), (1, 2), "it is the longer one now");
        let seeded = |seed| RenderSettings { seed, ..scene.settings };
        for seed in 1..=MOST_CURVES as u32 {
            history.record(&seeded(seed), u64::from(10 + seed), moment(1, 0.9));
        }
        assert_eq!(history.curves.len(), MOST_CURVES);
        assert!(history.curves.iter().all(|curve| curve.settings != scene.settings), "the oldest is gone");
        assert!(history.curves.iter().any(|curve| curve.settings == seeded(1)), "and no other");
    }

    #[test]
    fn figures_are_forgotten_with_camera_scene_and_reference() {
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
        assert_eq!((last.true_error, last.bias, last.noise), (None, None, Some(0.2)));
        same.record(&scene.settings, 1, with_truth);
        assert_eq!(same.curves[0].moments[0].true_error, Some(0.1));
        let mut moved = start();
        moved.look_at(&scene, &Camera { fov: 50.0, ..scene.camera }, Some(&truth));
        assert!(moved.curves.is_empty());
        moved.look_at(&scene, &scene.camera, Some(&truth));
        assert_eq!(moved.curves[0].moments[0].true_error, Some(0.1), "its curves come back with their camera");
        moved.look_at(&scene, &Camera { fov: 50.0, ..scene.camera }, None);
        moved.look_at(&scene, &scene.camera, None);
        assert_eq!(
            (moved.curves.len(), moved.curves[0].moments[0].true_error),
            (1, None),
            "but no errors against another reference"
        );
        moved.look_at(&scene, &scene.camera, Some(&truth));
        assert_eq!(moved.curves[0].moments[0].true_error, Some(0.1), "until it is in force again");
        let mut other = start();
        let edited = Arc::new(built_in());
        other.look_at(&edited, &scene.camera, Some(&truth));
        assert!(other.curves.is_empty());
        other.look_at(&scene, &scene.camera, Some(&truth));
        assert_eq!(other.curves[0].moments[0].true_error, Some(0.1), "and with their scene, when an edit is undone");
    }

    #[test]
    fn a_curve_is_named_by_its_differences_and_says_that_it_is_biased() {
        let scene = Arc::new(built_in());
        let mut history = looking_at(&scene);
        let changed = RenderSettings { sampler: Sampler::Independent, max_bounces: Some(3), ..scene.settings };
        for (generation, settings) in [(1, scene.settings), (2, changed)] {
            history.record(&settings, generation, moment(1, 0.5));
        }
        let names: Vec<String> = history.curves.iter().map(|curve| history.name(curve)).collect();
        assert_eq!(names[0], "MIS, Sobol (Owen), no path reuse");
        assert!(names[1] == "Independent, cap of 3 bounces, no path reuse (biased)", "{}", names[1]);
        let never = RenderSettings { reuse: Reuse::Off, ..scene.settings };
        assert_eq!(name(&never, &scene.settings, PathReuse::Off), "no path reuse");
        assert_eq!(name(&scene.settings, &scene.settings, PathReuse::Suffixes), "MIS, Sobol (Owen), reused suffixes");
        let merged = RenderSettings { estimator: Estimator::Bidirectional, merging: true, ..scene.settings };
        assert_eq!(name(&merged, &scene.settings, PathReuse::Merged), "Bidirectional, merged vertices");
        let capped = RenderSettings { max_bounces: Some(2), ..scene.settings };
        assert_eq!(name(&capped, &capped, PathReuse::Off), "MIS, Sobol (Owen), cap of 2 bounces, no path reuse");
    }
}
