//! Plots of error against time and samples, with few curves each.
use super::{
    outcome::{Outcome, Point, ROUNDING},
    ranking::Findings,
};
use crate::report::plot::{Axis, BESIDE, Curve, Plot, Style, curve};
use noisefall_scene::scene::Setting;

/// Number of best combinations in the overview.
const FIRST_PLACES: usize = 3;

/// Two plots with the same curves: error against time, error against samples.
pub struct Pair {
    pub title: String,
    pub caption: String,
    pub plots: [Plot; 2],
}

/// The best combinations, the settings of the scene, and the last combination that is ranked.
pub fn overview(findings: &Findings) -> Option<Pair> {
    let best = findings.best()?;
    let sound: Vec<&Outcome> = findings.outcomes.iter().filter(|outcome| outcome.eligibility == best.eligibility).collect();
    let own = findings.find(&findings.of_scene);
    let mut shown: Vec<(String, &Outcome)> = Vec::new();
    for outcome in sound.iter().take(FIRST_PLACES).copied().chain(own).chain(sound.last().copied()) {
        let name = outcome.label();
        if shown.iter().all(|(known, _)| *known != name) {
            shown.push((name, outcome));
        }
    }
    let mut caption = "The best combinations, the settings of the scene, and the last combination that is ranked.".to_owned();
    if findings.limits.floor > 0.0 {
        caption.push_str(" The error of the reference is subtracted, and a curve ends where it comes close to that error.");
    }
    pair("Error against time and samples".to_owned(), caption, &shown)
}

/// One curve for each value of a setting, with all others as in the best combination. `None` if there is only one curve.
pub fn by_setting(findings: &Findings, setting: Setting) -> Option<Pair> {
    let best = findings.best()?;
    let mut shown: Vec<(String, &Outcome)> = Vec::new();
    for gain in findings.gains(setting) {
        let with_value = |outcome: &&Outcome| {
            let same_otherwise = |s: &&_| setting.with(s, &best.settings) == best.settings && setting.value(s) == gain.value;
            outcome.alike().find(same_otherwise).is_some()
        };
        let Some(outcome) = findings.outcomes.iter().find(with_value) else { continue };
        match shown.iter_mut().find(|(_, known)| known.settings == outcome.settings) {
            Some((name, _)) => *name = format!("{name} = {}", gain.value),
            None => shown.push((gain.value, outcome)),
        }
    }
    let caption = format!("All other settings as in the best combination: {}.", best.label());
    if shown.len() > 1 { pair(setting.label(), caption, &shown) } else { None }
}

fn pair(title: String, mut caption: String, shown: &[(String, &Outcome)]) -> Option<Pair> {
    let exact: Vec<&str> = shown.iter().filter(|(_, outcome)| outcome.is_exact()).map(|(name, _)| name.as_str()).collect();
    if !exact.is_empty() {
        caption.push_str(&format!(" Not shown because they have no noise: {}.", exact.join("; ")));
    }
    let draw = |x: Axis, place: fn(&Point) -> f64| {
        let mut curves = Vec::new();
        for (name, outcome) in shown {
            let noisy = outcome.curve.iter().filter(|point| point.rel_mse > ROUNDING);
            let points: Vec<(f64, f64)> = noisy.map(|point| (place(point), point.rel_mse.sqrt())).collect();
            curves.push(curve(name, Style::Line, points.clone()));
            curves.push(curve(name, Style::Points, points));
        }
        curves.retain(|curve| !curve.points.is_empty());
        curves.extend(guide(&curves));
        (!curves.is_empty()).then(|| Plot { size: BESIDE, x, y: Axis::log("error (root of relMSE)"), curves })
    };
    let by_time = draw(Axis::log("rendering time, s"), |point| point.seconds)?;
    let by_samples = draw(Axis::log("samples per pixel"), |point| f64::from(point.spp))?;
    Some(Pair { title, caption, plots: [by_time, by_samples] })
}

/// A guide line with the slope of independent samples, from the start of the first curve and of its length.
fn guide(curves: &[Curve]) -> Option<Curve> {
    let points = &curves.first()?.points;
    let (&(x, y), &(end, _)) = (points.first()?, points.last()?);
    Some(curve("slope −1/2", Style::Guide, vec![(x, y), (end, y * (x / end).sqrt())]))
}
