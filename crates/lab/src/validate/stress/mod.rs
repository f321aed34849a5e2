//! Stress: more than two thousand random and adversarial scenes, each checked for invariants.
//!
//! A scene is text that goes through the same reader and compiler as a user's file. It is a pure function of its family and its
//! number. A statement that fails names the scene, and its text is kept.
mod covering;
mod dice;
mod failed_scene;
mod families;
mod figures;
mod saving;
mod statements;
mod surfaces;
#[cfg(test)]
mod tests;
mod trial;
mod trial_scene;

use rayon::prelude::*;

pub use self::failed_scene::FailedScene;
use self::{
    covering::Strength,
    dice::Dice,
    families::{Family, GROUPS},
    trial::TrialOutcome,
    trial_scene::{Expected, TrialScene},
};
use super::{Effort, Section, Validation};
use noisefall_scene::scene::RenderSettings;

/// A quick run tries one scene in this many.
const QUICK: u32 = 10;

/// A scene and its outcome.
struct Trial {
    family: &'static Family,
    name: String,
    text: String,
    trial_scene: TrialScene,
    outcome: TrialOutcome,
}

impl Trial {
    /// The file to keep if the scene breaks an invariant.
    fn kept(&self) -> Option<FailedScene> {
        let reason = statements::breaks(self)?;
        let text = format!("# {}\n{}", reason.replace('\n', " "), self.text);
        Some(FailedScene { name: self.name.clone(), text, reason })
    }

    /// The fraction of the light that is lost, and the limit of it.
    fn loss(&self) -> Option<(f64, f64)> {
        match self.trial_scene.expected {
            Expected::Within { loss, .. } => Some((self.outcome.lost?, loss)),
            _ => None,
        }
    }
}

impl Validation {
    /// Runs the stress sections in order. Calls `done` with the number of each section, from 1, when it is finished, and `message`
    /// during long ones. Returns the sections and the scenes that break an invariant.
    pub fn stress(
        &self,
        mut done: impl FnMut(usize, &Section),
        message: &(dyn Fn(&str) + Sync),
    ) -> (Vec<Section>, Vec<FailedScene>) {
        let (mut sections, mut kept) = (Vec::new(), Vec::new());
        for (i, group) in GROUPS.iter().enumerate() {
            let trials: Vec<Trial> = group.families.iter().flat_map(|family| self.trials(family)).collect();
            let section = statements::section(group, &trials);
            done(i + 1, &section);
            sections.push(section);
            kept.extend(trials.iter().filter_map(Trial::kept));
        }
        let section = saving::section(self.count(saving::PAIRS));
        done(GROUPS.len() + 1, &section);
        sections.push(section);
        let strengths: &[Strength] = match self.effort {
            Effort::Quick => &[Strength::Pairs],
            Effort::Full => &[Strength::Pairs, Strength::Triples],
        };
        for strength in strengths {
            let (section, failed) = covering::section(*strength, message);
            done(sections.len() + 1, &section);
            sections.push(section);
            kept.extend(failed);
        }
        (sections, kept)
    }

    /// The number of items that this run tries out of `all`.
    fn count(&self, all: u32) -> u32 {
        match self.effort {
            Effort::Full => all,
            Effort::Quick => all.div_ceil(QUICK),
        }
    }

    fn trials(&self, family: &'static Family) -> Vec<Trial> {
        let settings = |settings: RenderSettings| RenderSettings { fault: self.fault, ..settings };
        let trial = |number: u32| {
            let trial_scene = (family.trial_scene)(&mut Dice::new(family.name, number));
            let name = format!("{}-{number}", family.name);
            let text = format!("format = 1\ntitle = 'stress: {name}'\n{}", trial_scene.text);
            let outcome = trial::run(&text, &trial_scene, settings);
            Trial { family, name, text, trial_scene, outcome }
        };
        (0..self.count(family.scenes)).into_par_iter().map(trial).collect()
    }
}
