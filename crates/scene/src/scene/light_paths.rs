//! Decides whether paths start at the lights of a scene.
use std::fmt;

use super::{Estimator, Obstacle, RenderSettings, Scene};
use crate::light::LightRays;

/// Where more paths survive roulette, they are connected with each other only if they have at most this many bounces.
const MOST_BOUNCES: u32 = 64;
const MOST_SURVIVORS: f32 = 0.98;

/// The estimator that renders, and why it is not the one of the settings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EstimatorInForce {
    pub estimator: Estimator,
    pub reason: String,
}

impl fmt::Display for EstimatorInForce {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.estimator.title(), self.reason)
    }
}

impl Scene {
    /// The rays with which light paths start, if the estimator traces any and the scene allows it.
    pub fn light_rays(&self, settings: &RenderSettings) -> Option<&LightRays> {
        let traces = settings.estimator.traces_light_paths() && self.obstacle_of_settings(settings).is_none();
        if traces { self.rays_or_obstacle(settings.estimator).ok() } else { None }
    }

    /// Whether paths start at lights, too.
    pub fn traces_light_paths(&self, settings: &RenderSettings) -> bool {
        self.light_rays(settings).is_some()
    }

    /// The note that an estimator without its light paths works like `mis`; `None` if that is not so.
    pub fn lacks_light_paths(&self, settings: &RenderSettings) -> Option<String> {
        if !settings.estimator.traces_light_paths() {
            return None;
        }
        let name = settings.estimator.name();
        if let Some(obstacle) = self.obstacle_of_settings(settings) {
            return Some(format!("the estimator `{name}` works like `mis` with {}", obstacle.word().title));
        }
        let reason = self.rays_or_obstacle(settings.estimator).err()?;
        Some(format!("the estimator `{name}` works like `mis` in this scene, which has {}", reason.word().title))
    }

    /// Why vertices are never merged in this scene: both paths would have to meet a surface, so its opacity would count twice.
    pub fn obstacle_to_merging(&self) -> Option<&'static str> {
        (!self.surfaces.are_opaque()).then_some("vertices are not merged in scenes with opacity or blends")
    }

    /// Whether vertices are merged.
    pub fn merges(&self, settings: &RenderSettings) -> bool {
        settings.merges() && self.obstacle_to_merging().is_none() && self.traces_light_paths(settings)
    }

    /// The note that vertices are not merged although the settings say so; `None` if that is not so.
    fn lacks_merging(&self, settings: &RenderSettings) -> Option<String> {
        let lacks = settings.merges() && self.traces_light_paths(settings);
        self.obstacle_to_merging().filter(|_| lacks).map(str::to_owned)
    }

    /// Warnings about the scene with these settings, where something is legal but probably not meant.
    pub fn notes(&self, settings: &RenderSettings) -> Vec<String> {
        let of_settings = [self.infinite_variance(settings), self.lacks_light_paths(settings), self.lacks_merging(settings)];
        self.warnings().iter().cloned().chain(of_settings.into_iter().flatten()).collect()
    }

    /// Why an estimator with these settings has no light paths, whatever the lights.
    fn obstacle_of_settings(&self, settings: &RenderSettings) -> Option<Obstacle> {
        let may_be_long = settings.max_bounces.is_none_or(|cap| cap > MOST_BOUNCES);
        let RenderSettings { roulette, .. } = settings;
        let most_survive = roulette.survival() > MOST_SURVIVORS || !roulette.plays_at(MOST_BOUNCES);
        let is_long = (most_survive && may_be_long).then_some(Obstacle::LongPaths);
        let is_counted = self.counts_crossings(settings).then_some(Obstacle::CountedCrossings);
        [is_long, is_counted].into_iter().flatten().find(|obstacle| obstacle.stops(settings.estimator))
    }

    fn rays_or_obstacle(&self, estimator: Estimator) -> Result<&LightRays, Obstacle> {
        let made = self.light_paths.get_or_init(|| self.light_starts());
        made.as_ref().map_err(|reason| *reason)?.rays_for(estimator)
    }

    /// The estimator in force and the reason for it, where it is known and not the one of the settings.
    pub fn estimator_in_force(&self, settings: &RenderSettings) -> Option<EstimatorInForce> {
        let is_auto = settings.estimator == Estimator::Auto;
        // A trial has to try all strategies.
        let wanted = if is_auto { Estimator::Bidirectional } else { settings.estimator };
        if !wanted.traces_light_paths() {
            return None;
        }
        let mis = |reason| Some(EstimatorInForce { estimator: Estimator::Mis, reason });
        if let Some(obstacle) = self.obstacle_of_settings(&RenderSettings { estimator: wanted, ..*settings }) {
            return mis(format!("with {}", obstacle.word().title));
        }
        let starts = self.light_paths.get()?.as_ref().map_err(|reason| *reason);
        if let Err(obstacle) = starts.and_then(|starts| starts.rays_for(wanted)) {
            return mis(format!("the scene has {}", obstacle.word().title));
        }
        let best = self.estimator_by_trial.get().filter(|_| is_auto)?;
        Some(EstimatorInForce { estimator: *best, reason: "lowest error in a trial".to_owned() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Roulette, built_in};

    #[test]
    fn paths_that_end_late_are_connected_only_below_a_cap() {
        let scene = built_in();
        let late = Roulette::by_throughput_from;
        for (roulette, max_bounces, connects) in [
            (late(4), None, true),
            (late(MOST_BOUNCES), None, true),
            (late(MOST_BOUNCES + 1), None, false),
            (late(4000), Some(MOST_BOUNCES), true),
            (late(4000), Some(MOST_BOUNCES + 1), false),
        ] {
            let estimator = Estimator::Bidirectional;
            let settings = RenderSettings { estimator, roulette, max_bounces, ..RenderSettings::default() };
            assert_eq!(scene.traces_light_paths(&settings), connects, "{roulette:?}, {max_bounces:?}");
        }
    }
}
