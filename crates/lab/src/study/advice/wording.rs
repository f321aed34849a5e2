//! Advice in words.
use super::{Advice, Candidate};
use noisefall_scene::scene::RenderSettings;

/// The differences from the settings in use, in the words of the window.
pub fn difference(settings: &RenderSettings, in_use: &RenderSettings) -> String {
    let words: Vec<String> = settings.differing(in_use).map(|setting| setting.words(settings)).collect();
    if words.is_empty() { "your settings".to_owned() } else { words.join(", ") }
}

impl Candidate {
    /// Relative efficiency and its standard error, as in `1.83 ± 0.04`, with two digits of the error and at most three decimals.
    /// `∞` if the settings in use miss light that these found.
    pub fn ratio(&self) -> String {
        if !self.relative.is_finite() {
            return "∞".to_owned();
        }
        let error = self.relative * self.standard_error;
        let decimals = if error > 0.0 { (1.0 - error.log10().floor()).clamp(0.0, 3.0) as usize } else { 2 };
        format!("{:.decimals$} ± {error:.decimals$}", self.relative)
    }
}

impl Advice {
    /// The recommendation in words. Errors are standard errors.
    pub fn verdict(&self) -> String {
        let (best, current) = (self.best(), self.current());
        let mut text = if self.best == self.current {
            self.nothing_better()
        } else if !best.relative.is_finite() {
            format!("{}: finds light that your settings miss.", best.name)
        } else if best.is_exact() && !current.is_exact() {
            format!("{}: leaves no noise at all.", best.name)
        } else {
            format!("{}: {} times as efficient as your settings.", best.name, best.ratio())
        };
        if let Some(bias) = current.settings.bias() {
            text.push_str(&format!(" All candidates have your {bias} and miss the light beyond it."));
        }
        text
    }

    fn nothing_better(&self) -> String {
        if self.current().is_exact() {
            return "Your settings leave no noise: nothing can be better.".to_owned();
        }
        let mut others = self.candidates.iter().filter(|candidate| candidate.name != self.current().name).peekable();
        if others.peek().is_none() {
            return "No other settings were tried.".to_owned();
        }
        let Some(next) = others.find(|candidate| !candidate.misses_light) else {
            return "Nothing else finds all the light that your settings find.".to_owned();
        };
        let chance = if next.may_be_better() { ", which may be chance" } else { "" };
        format!(
            "No alternative is clearly better: the best, {}, is {} times as efficient as your settings{chance}.",
            next.name,
            next.ratio()
        )
    }
}
