//! Which combinations are the same picture: those that are so bit for bit after a few samples are measured once.
//!
//! Directions do not matter where nothing is diffuse, samplers not where samples do not vary, roulette not where paths are short.
use std::collections::HashMap;

use super::{StudyError, key::hash_of_picture, measure::Bench};
use crate::scene::RenderSettings;

/// Samples per pixel of a trial. The first sample of different samplers may be the same point.
const TRIAL_SPP: u32 = 2;
/// Bounces of a trial: what settings differ in shows early, and paths in a closed white room would take for ever.
const TRIAL_BOUNCES: u32 = 8;

/// A combination that is measured, and those that are the same picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    pub settings: RenderSettings,
    pub twins: Vec<RenderSettings>,
}

/// The combinations as groups, in their order. Of equals the one is measured that is nearest to what the scene opens with.
pub fn groups(bench: Bench, combinations: &[RenderSettings]) -> Result<Vec<Group>, StudyError> {
    let mut pictures = Vec::new();
    for settings in combinations {
        // Equal for a while does not mean that a cap is never reached, nor that samples are never spread by noise: pictures that differ in
        // these never count as the same.
        pictures.push((trial(bench, settings)?, settings.max_bounces, settings.adaptive));
    }
    Ok(group(&pictures, combinations, &bench.scene.settings))
}

/// A hash of a trial picture's bits.
pub fn trial(bench: Bench, settings: &RenderSettings) -> Result<u64, StudyError> {
    let cap = settings.max_bounces.map_or(TRIAL_BOUNCES, |cap| cap.min(TRIAL_BOUNCES));
    let mut film = bench.film();
    bench.pass(&RenderSettings { max_bounces: Some(cap), ..*settings }, &mut film, TRIAL_SPP)?;
    Ok(hash_of_picture(&bench.frame(&film).radiance))
}

/// Groups of combinations whose pictures have equal names.
pub fn group<N: Eq + std::hash::Hash>(pictures: &[N], combinations: &[RenderSettings], of_scene: &RenderSettings) -> Vec<Group> {
    let mut places: HashMap<&N, usize> = HashMap::new();
    let mut groups: Vec<Group> = Vec::new();
    for (picture, settings) in pictures.iter().zip(combinations) {
        match places.get(picture) {
            Some(&place) => groups[place].twins.push(*settings),
            None => {
                places.insert(picture, groups.len());
                groups.push(Group { settings: *settings, twins: Vec::new() });
            }
        }
    }
    for group in &mut groups {
        for twin in &mut group.twins {
            if distance(twin, of_scene) < distance(&group.settings, of_scene) {
                std::mem::swap(twin, &mut group.settings);
            }
        }
    }
    groups
}

/// How many settings differ.
fn distance(a: &RenderSettings, b: &RenderSettings) -> usize {
    super::setting::Setting::ALL.into_iter().filter(|setting| setting.value(a) != setting.value(b)).count()
}
