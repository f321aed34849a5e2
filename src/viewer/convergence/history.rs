//! What has been seen of errors: curves over samples and time, one for each setting of the same picture.
use std::sync::Arc;

use noisefall::{
    render::{Frame, settings_text::options, truth::Reference},
    scene::{Camera, RenderSettings, Scene},
    study::{Slope, slope},
};

use crate::viewer::darkroom::Against;

/// One frame's figures.
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
}

/// What one setting did.
pub struct Curve {
    pub settings: RenderSettings,
    pub generation: u64,
    pub moments: Vec<Moment>,
}

/// What curves are drawn over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Over {
    #[default]
    Samples,
    Seconds,
}

/// What is drawn of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum What {
    #[default]
    Error,
    Bias,
}

/// The curves of one picture: the same scene and camera.
#[derive(Default)]
pub struct History {
    pub curves: Vec<Curve>,
    pub over: Over,
    pub what: What,
    subject: Option<(Arc<Scene>, Camera)>,
    truth: Option<Arc<Reference>>,
}

/// The one of the oldest picture is forgotten where there would be more than there are colours.
const MOST_CURVES: usize = super::plot::COLOURS.len();
/// Moments nearer to each other than this factor are not told apart.
const SPACING: f64 = 1.03;

impl Moment {
    pub fn of(frame: &Frame, against: Option<Against>) -> Moment {
        Moment {
            spp: frame.spp,
            seconds: frame.elapsed.as_secs_f64(),
            estimated: frame.rel_mse_estimate.map(f64::sqrt),
            true_error: against.map(|against| against.rel_mse.sqrt()),
            bias: against.and_then(|against| against.bias),
        }
    }

    pub fn over(&self, over: Over) -> f64 {
        match over {
            Over::Samples => f64::from(self.spp),
            Over::Seconds => self.seconds,
        }
    }
}

impl Curve {
    /// Places with a positive error, which a logarithm needs.
    pub fn errors(&self, over: Over, error: impl Fn(&Moment) -> Option<f64>) -> Vec<(f64, f64)> {
        let points = self.moments.iter().filter_map(|moment| Some((moment.over(over), error(moment)?)));
        points.filter(|(x, y)| *x > 0.0 && *y > 0.0 && y.is_finite()).collect()
    }

    /// How the estimated error falls: the slope over moments that are about doublings, from 4 samples on.
    pub fn slope(&self, over: Over) -> Option<Slope> {
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
    /// Curves of another picture are no curves of this one, and errors against another truth no errors.
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

    /// Notes a full frame. One that starts over replaces what the same settings did before.
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

    /// What a curve is called: by what its settings differ in from those that the scene opens with.
    pub fn name(&self, curve: &Curve) -> String {
        let of_scene = self.subject.as_ref().map_or_else(RenderSettings::default, |(scene, _)| scene.settings);
        let bias = if curve.settings.bias().is_some() { " (biased)" } else { "" };
        name(&curve.settings, &of_scene) + bias
    }
}

/// Settings by what they differ in from those of the scene.
pub fn name(settings: &RenderSettings, of_scene: &RenderSettings) -> String {
    let differences = options(settings, of_scene);
    let parts: Vec<&str> = differences.split(" --").filter(|part| !part.is_empty()).collect();
    if parts.is_empty() { "as the scene opens".to_owned() } else { parts.join(", ") }
}
