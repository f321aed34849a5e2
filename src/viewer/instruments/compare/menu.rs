//! The menu of settings to compare with.
use egui::Ui;
use noisefall_base::declare::{OneOf, capitalised};
use noisefall_scene::{
    sampling::Sampler,
    scene::{Estimator, PathReuse, RenderSettings, Reuse, Roulette},
};

/// Shows the menu that starts a comparison with one click. Returns the settings of B.
pub fn show(ui: &mut Ui, settings: &RenderSettings) -> Option<RenderSettings> {
    let mut chosen = None;
    let response = ui.menu_button("Compare with…", |ui| {
        for (name, other) in alternatives(settings) {
            if ui.button(name).clicked() {
                chosen = Some(other);
                ui.close();
            }
        }
    });
    response.response.on_hover_text("Renders this scene with other settings beside the current ones, at equal time.");
    chosen
}

/// The settings with one change each, and the names of the changes.
fn alternatives(settings: &RenderSettings) -> Vec<(String, RenderSettings)> {
    let of = |name: &str, changed: RenderSettings| (name.to_owned(), changed);
    let mut all = Vec::new();
    for estimator in Estimator::ALL {
        let name = if estimator == Estimator::Auto { "Estimator chosen by a trial" } else { estimator.title() };
        all.push(of(name, RenderSettings { estimator, ..*settings }));
    }
    for sampler in Sampler::ALL {
        all.push((format!("{} samples", sampler.word().title), RenderSettings { sampler, ..*settings }));
    }
    for roulette in Roulette::alternatives() {
        all.push((capitalised(&roulette.words()), RenderSettings { roulette, ..*settings }));
    }
    for reuse in Reuse::ALL.into_iter().filter(|reuse| *reuse != Reuse::Auto) {
        all.push((capitalised(PathReuse::asked(reuse).words()), RenderSettings { reuse, ..*settings }));
    }
    all.push(of("A cap of 3 bounces", RenderSettings { max_bounces: Some(3), ..*settings }));
    all.push(of("Another seed", RenderSettings { seed: settings.seed.wrapping_add(1), ..*settings }));
    all.retain(|(_, changed)| changed != settings);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alternatives_differ_from_the_settings_and_from_each_other() {
        let settings = RenderSettings::default();
        let all = alternatives(&settings);
        assert!(all.len() > 8);
        for (i, (_, one)) in all.iter().enumerate() {
            assert!(*one != settings && all[..i].iter().all(|(_, other)| other != one));
        }
        let place = |name: &str| all.iter().position(|(other, _)| other.starts_with(name)).unwrap_or(usize::MAX);
        let order =
            ["BSDF sampling", "Independent", "No roulette", "Roulette of 0.8", "Reused", "A cap", "Another seed"].map(place);
        assert!(order.is_sorted() && order[6] == all.len() - 1, "{order:?}");
    }
}
