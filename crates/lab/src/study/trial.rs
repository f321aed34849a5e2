//! Trials that find combinations with the same image. Those whose images agree bit for bit after a few samples are measured once.
//!
//! For example, directions have no effect without diffuse surfaces, samplers have none if samples do not vary, and roulette has
//! none on short paths.
use std::collections::HashMap;

use super::{StudyError, key::hash_of_picture, measure::Bench};
use noisefall_base::declare::Datum;
use noisefall_scene::scene::{Changes, RenderSettings, Setting};

/// Samples per pixel of a trial. One is too few, because the first points of different samplers may coincide.
const TRIAL_SPP: u32 = 2;
/// Cap on bounces of a trial. Differences show early, and paths in a closed white room would be very long.
const TRIAL_BOUNCES: u32 = 8;

/// A combination that is measured, and the others with the same image.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    pub settings: RenderSettings,
    pub twins: Vec<RenderSettings>,
}

/// Groups the combinations, in their order. Each group measures the combination closest to the settings of the scene.
pub fn groups(bench: Bench, combinations: &[RenderSettings]) -> Result<Vec<Group>, StudyError> {
    let mut pictures = Vec::new();
    for settings in combinations {
        // A trial is too short to show the effects of a cap or of adaptive sampling, so combinations that differ in these are
        // never grouped.
        let is_slow = |setting: &Setting| setting.changes == Changes::Limit || *setting == RenderSettings::ADAPTIVE;
        let slow: Vec<Datum> = RenderSettings::axes().filter(is_slow).map(|setting| setting.datum(settings)).collect();
        pictures.push((trial(bench, settings)?, slow));
    }
    Ok(group(&pictures, combinations, &bench.scene.settings))
}

/// Hash of the bits of a trial image.
pub fn trial(bench: Bench, settings: &RenderSettings) -> Result<u64, StudyError> {
    let cap = settings.max_bounces.map_or(TRIAL_BOUNCES, |cap| cap.min(TRIAL_BOUNCES));
    let mut film = bench.film();
    bench.pass(&RenderSettings { max_bounces: Some(cap), ..*settings }, &mut film, TRIAL_SPP)?;
    Ok(hash_of_picture(&bench.frame(&film).radiance))
}

/// Groups combinations whose images have equal identifiers.
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
            if twin.differing(of_scene).count() < group.settings.differing(of_scene).count() {
                std::mem::swap(twin, &mut group.settings);
            }
        }
    }
    groups
}
