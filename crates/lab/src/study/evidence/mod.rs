//! A chapter of figures and tables about one scene: convergence, bias, and comparisons at equal time.
//!
//! Each question is a small [`Study`] of one setting. All other settings are those of the scene, without a cap, path reuse and
//! adaptive sampling. The folder keeps the measurements like those of any other study.
mod chapter;
pub(super) mod exhibits;
mod page;
mod plots;
mod tables;

use std::{
    path::Path,
    time::{Duration, Instant},
};

pub use self::chapter::Chapter;
use self::exhibits::{CAPS, Exhibits, pictures};
use super::{
    Findings, Lists, Machine, Plan, Progress, Store, Study, StudyError, StudyScene, measure::Bench, study_scene::reserve,
};
use noisefall_base::memory::{self, Reservation, TooMuch};
use noisefall_kernel::measure::Floor;
use noisefall_render::render::{Display, film::Film, threads::Threads};
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Estimator, RenderSettings, Reuse, Roulette, Setting},
};

const REPEATS: u32 = 3;
/// Fractions of the time for the runs of all studies and for images. The rest is for the reference and for trials.
const FOR_RUNS: f64 = 0.6;
const FOR_PICTURES: f64 = 0.1;
/// Samples per pixel of the longest runs.
const SPP: std::ops::RangeInclusive<u32> = 16..=4096;

/// Duration, and display settings of images.
pub struct EvidencePlan {
    /// Approximate duration.
    pub time: Duration,
    /// How images are shown.
    pub display: Display,
}

/// A question about one setting.
struct Topic {
    setting: Setting,
    lists: Lists,
}

/// The questions. Path reuse and adaptive sampling are off except where they are the question. Otherwise a setting for which
/// `Reuse::Auto` decides differently would be compared with reuse against others without it.
fn topics() -> [Topic; 6] {
    let any = RenderSettings::default();
    let off = RenderSettings { reuse: Reuse::Off, adaptive: false, max_bounces: None, ..any };
    let fixed = [RenderSettings::REUSE, RenderSettings::ADAPTIVE, RenderSettings::MAX_BOUNCES];
    let alone = fixed.into_iter().fold(Lists::default(), |lists, setting| lists.with(setting, [off]));
    let topic = |setting, values: Vec<RenderSettings>| Topic { setting, lists: alone.clone().with(setting, values) };
    let roulettes = [Roulette::Off, Roulette::fixed(0.5), Roulette::fixed(0.8), Roulette::BY_THROUGHPUT];
    let samplers = [Sampler::Independent, Sampler::Stratified, Sampler::Sobol];
    let directions = [Directions::Uniform, Directions::Cosine, Directions::Bsdf];
    [
        topic(RenderSettings::MAX_BOUNCES, CAPS.map(|max_bounces| RenderSettings { max_bounces, ..any }).into()),
        topic(RenderSettings::ROULETTE, roulettes.map(|roulette| RenderSettings { roulette, ..any }).into()),
        topic(RenderSettings::DIRECTIONS, directions.map(|directions| RenderSettings { directions, ..any }).into()),
        topic(RenderSettings::ESTIMATOR, Estimator::ALL.map(|estimator| RenderSettings { estimator, ..any }).into()),
        topic(RenderSettings::SAMPLER, samplers.map(|sampler| RenderSettings { sampler, ..any }).into()),
        topic(RenderSettings::REUSE, [Reuse::Off, Reuse::Suffixes].map(|reuse| RenderSettings { reuse, ..any }).into()),
    ]
}

/// Reserves the memory for the chapter: the measurements, and in the end two films with the images of two sheets.
pub fn reserve_chapter(study_scene: &StudyScene) -> Result<[Reservation; 4], TooMuch> {
    /// Bytes per pixel of an image: its codes, and its part of a sheet with margins.
    const PIXEL: u64 = 10;
    let [width, height] = study_scene.camera.resolution;
    let count = SPP.end().ilog2() as usize / 2 + 1 + CAPS.len();
    let bytes = PIXEL * count as u64 * u64::from(width) * u64::from(height);
    let cells = memory::reserve(format_args!("{count} images of {width} × {height} pixels"), bytes)?;
    let [film, reference] = reserve(std::slice::from_ref(study_scene))?;
    Ok([film, reference, Film::reserve([width, height])?, cells])
}

/// Measures everything. `observe` gets the current step and the fraction of it that is done.
pub fn collect(
    plan: &EvidencePlan,
    study_scene: StudyScene,
    (folder, store): (&Path, &mut Store),
    (threads, machine): (&Threads, &Machine),
    stop: &(dyn Fn() -> bool + Sync),
    observe: &mut dyn FnMut(&str, f64),
) -> Result<Chapter, StudyError> {
    let study_scenes = [study_scene];
    let [study_scene] = &study_scenes;
    let bench = Bench { scene: &study_scene.scene, camera: &study_scene.camera, threads, stop };
    let topics = topics();
    let runs =
        topics.iter().map(|topic| topic.lists.combinations(study_scene.scene.settings).len()).sum::<usize>() as u32 * REPEATS;
    let study_plan = |lists: Lists, spp: u32| Plan {
        lists,
        spp,
        time: plan.time.mul_f64(2.0 * FOR_RUNS / f64::from(runs)),
        repeats: REPEATS,
        floor: Floor::DEFAULT,
    };
    observe("measuring the time of a sample", 0.0);
    let first = study_plan(topics[0].lists.clone(), *SPP.end());
    let first = Study { plan: &first, folder, threads, machine, stop };
    let spp = samples(&first, study_scene, store, plan.time.mul_f64(FOR_RUNS / f64::from(runs)))?;
    let mut findings: Vec<(Setting, Findings)> = Vec::new();
    let mut finished = FinishedRuns { done: 0, runs };
    for topic in topics {
        let about = format!("{} of {}", topic.setting.name(), study_scene.title());
        let plan = study_plan(topic.lists, spp);
        let study = Study { plan: &plan, folder, threads, machine, stop };
        let found = study.run(&study_scenes, store, &mut |progress| {
            if let Some(share) = finished.note(&progress) {
                observe(if share < 1.0 - FOR_RUNS - FOR_PICTURES { "reference" } else { &about }, share);
            }
        })?;
        findings.extend(found.into_iter().map(|findings| (topic.setting, findings)));
    }
    observe("images", 1.0 - FOR_PICTURES);
    let pictures = pictures(bench, spp, plan.display)?;
    observe("images", 1.0);
    Ok(Chapter::new(&Exhibits { study_scene, findings: &findings, pictures, spp, repeats: REPEATS, machine }))
}

/// The finished runs of all studies of a chapter.
struct FinishedRuns {
    done: u32,
    /// Number of all runs.
    runs: u32,
}

impl FinishedRuns {
    /// Notes the progress of a study. Returns the fraction of the work of the chapter that is done, if it changes.
    fn note(&mut self, progress: &Progress) -> Option<f64> {
        match progress {
            Progress::Reference { share, .. } => Some((1.0 - FOR_RUNS - FOR_PICTURES) * share),
            Progress::Planned { found, .. } => {
                self.done += *found as u32;
                None
            }
            Progress::Done => {
                self.done += 1;
                Some(share_after(self.done, self.runs))
            }
            Progress::Begun { .. } | Progress::Combination { .. } => None,
        }
    }
}

/// The fraction of the work that is done after this many runs; there may be more than were planned.
fn share_after(done: u32, runs: u32) -> f64 {
    1.0 - FOR_RUNS - FOR_PICTURES + FOR_RUNS * f64::from(done.min(runs)) / f64::from(runs)
}

/// Samples per pixel of the longest runs: that of the runs in the store, because timing may round to another power of two than
/// it did before; without any, the number that fits this time.
fn samples(study: &Study, study_scene: &StudyScene, store: &Store, time: Duration) -> Result<u32, StudyError> {
    let candidates = (SPP.start().ilog2()..=SPP.end().ilog2()).map(|power| 1 << power);
    let Study { threads, stop, .. } = *study;
    let bench = Bench { scene: &study_scene.scene, camera: &study_scene.camera, threads, stop };
    study.spp_in(store, study_scene, candidates)?.map_or_else(|| longest(bench, time), Ok)
}

/// The power of two nearest to the samples of a run of this time, measured with the settings of most runs.
fn longest(bench: Bench, time: Duration) -> Result<u32, StudyError> {
    /// Sample counts before and after the timing. The first sample allocates memory and fills caches.
    const SAMPLES: [u32; 2] = [1, 9];
    let mut film = bench.film();
    let settings = RenderSettings { reuse: Reuse::Off, adaptive: false, max_bounces: None, ..bench.scene.settings };
    bench.pass(&settings, &mut film, SAMPLES[0])?;
    let begun = Instant::now();
    bench.pass(&settings, &mut film, SAMPLES[1])?;
    let per_sample = begun.elapsed().as_secs_f64() / f64::from(SAMPLES[1] - SAMPLES[0]);
    let samples = (time.as_secs_f64() / per_sample.max(1e-9)).clamp(f64::from(*SPP.start()), f64::from(*SPP.end()));
    Ok(1 << samples.log2().round() as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_take_the_share_between_the_reference_and_the_pictures() {
        let [reference, half, all, more] = [0, 4, 8, 9].map(|done| share_after(done, 8));
        assert!((reference - (1.0 - FOR_RUNS - FOR_PICTURES)).abs() < 1e-12 && (all - (1.0 - FOR_PICTURES)).abs() < 1e-12);
        assert!((half - 0.5 * (reference + all)).abs() < 1e-12 && more == all);
    }

    #[test]
    fn runs_of_all_studies_and_runs_that_the_folder_has_count() {
        let mut finished = FinishedRuns { done: 0, runs: 8 };
        let half_of_reference = finished.note(&Progress::Reference { title: "a room", share: 0.5 });
        assert!(half_of_reference.is_some_and(|share| (share - 0.5 * (1.0 - FOR_RUNS - FOR_PICTURES)).abs() < 1e-12));
        // Two studies of four runs. The folder has one run of the first and three of the second.
        let of_study = [(1, 3), (3, 1)].map(|(found, measured)| {
            let planned = finished.note(&Progress::Planned { runs: 4, found });
            assert_eq!(planned, None);
            (0..measured).map(|_| finished.note(&Progress::Done)).collect::<Vec<_>>()
        });
        assert_eq!(
            of_study,
            [&[2, 3, 4][..], &[8]].map(|done| done.iter().map(|done| Some(share_after(*done, 8))).collect::<Vec<_>>())
        );
    }
}
