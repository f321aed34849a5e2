//! Plots of the errors of a section, one point per scene.
use super::{Trial, surfaces::LIMIT, trial::ENERGY};
use crate::report::{
    Figure,
    plot::{Axis, Curve, Style, curve, plot},
};

/// Where errors of 0 are drawn.
const NONE: f64 = 1e-9;

pub fn figures(trials: &[Trial]) -> Vec<Figure> {
    let mut figures = Vec::new();
    let known = || trials.iter().filter(|trial| trial.outcome.energy.is_some());
    if trials.iter().any(|trial| trial.loss().is_some()) {
        let at = |trial: &Trial| Some((trial.trial_scene.size, trial.loss()?.0.max(NONE)));
        let caption = "Fraction of the light that is lost, against the last digit of the coordinates over the size of the detail. 0 is drawn at 10⁻⁹.";
        return vec![scatter(caption, Axis::log("εS/d"), Axis::log("lost"), trials, at, |digit| 10.0 * digit)];
    }
    if known().any(|trial| trial.trial_scene.cap.is_some_and(|cap| cap > 1000)) {
        let at = |trial: &Trial| Some((f64::from(trial.trial_scene.cap?), trial.outcome.energy?.max(NONE)));
        let caption = "Relative errors of energy by the number of bounces; none at all is drawn at 10⁻⁹. What is lost once stays lost: a leak \
                       or a drift would grow to the right.";
        figures.push(scatter(caption, Axis::log("bounces"), Axis::log("error of energy"), trials, at, |_| ENERGY));
    } else if known().any(|trial| trial.trial_scene.size != 1.0) {
        let at = |trial: &Trial| Some((trial.trial_scene.size, trial.outcome.energy?.max(NONE)));
        let caption = "Largest relative error of a sample of each scene, against the size of its subject. 0 is drawn at 10⁻⁹.";
        figures.push(scatter(caption, Axis::log("size, m"), Axis::log("error of energy"), trials, at, |_| ENERGY));
    }
    if trials.iter().any(|trial| trial.trial_scene.size != 1.0 && trial.outcome.surfaces.worst > 0.0) {
        let found = |trial: &Trial| (trial.trial_scene.size, trial.outcome.surfaces.worst);
        let at = |trial: &Trial| Some(found(trial)).filter(|(_, worst)| *worst > 0.0);
        let caption = "Largest distance of x_M from its surface in each scene, in units of εS, against the size of its subject.";
        figures.push(scatter(caption, Axis::log("size, m"), Axis::log("error of x, εS"), trials, at, |_| LIMIT));
    }
    figures
}

/// A plot with a point per scene in the colour of its family, and a line at the limit.
fn scatter(
    caption: &str,
    x: Axis,
    y: Axis,
    trials: &[Trial],
    at: impl Fn(&Trial) -> Option<(f64, f64)>,
    limit: impl Fn(f64) -> f64,
) -> Figure {
    let mut curves: Vec<Curve> = Vec::new();
    for trial in trials {
        let Some(point) = at(trial) else { continue };
        match curves.iter_mut().find(|curve| curve.name == trial.family.name) {
            Some(curve) => curve.points.push(point),
            None => curves.push(curve(trial.family.name, Style::Points, vec![point])),
        }
    }
    let all = || curves.iter().flat_map(|curve| &curve.points).map(|point| point.0);
    let ends = [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)];
    curves.push(curve("limit", Style::Dashed, ends.map(|x| (x, limit(x))).to_vec()));
    plot(caption, x, y, &curves)
}
