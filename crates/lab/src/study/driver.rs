//! Runs a study: measures, scene by scene, everything that its folder lacks.
use std::path::Path;

use super::{
    Findings, Machine, Plan, Run, Store, StudyError, StudyScene,
    key::{hash, text},
    measure::{Bench, measure},
    outcome::{Limits, Outcome},
    ranking::rank,
    reference::{self, Converged, Reference},
    row::{Header, rows},
    study_scene::titles,
    trial::{Group, groups, trial},
};
use noisefall_render::render::threads::Threads;
use noisefall_scene::scene::RenderSettings;

/// A study of some scenes in a folder.
pub struct Study<'a> {
    /// The measurements to make.
    pub plan: &'a Plan,
    /// The folder that keeps measurements.
    pub folder: &'a Path,
    /// The threads that render.
    pub threads: &'a Threads,
    /// The machine, as reports name it.
    pub machine: &'a Machine,
    /// Whether to stop. Called between two bounces of a batch, and while paths are connected.
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

/// Progress of a study.
pub enum Progress<'a> {
    /// The plan, before the first run.
    Planned {
        /// Number of runs.
        runs: usize,
        /// Number of runs that the folder already has.
        found: usize,
    },
    /// A converged render is under way.
    Reference {
        /// Title of the scene.
        title: &'a str,
        /// Fraction that is done.
        share: f64,
    },
    /// A run begins.
    Begun {
        /// Title of the scene.
        title: &'a str,
        /// The settings of the run.
        settings: &'a RenderSettings,
    },
    /// A run is finished and stored.
    Done,
    /// All runs of a combination are finished.
    Combination {
        /// Title of the scene.
        title: &'a str,
        /// The outcome of the runs.
        outcome: &'a Outcome,
    },
}

/// A scene and the combinations to measure.
struct Prepared<'a> {
    study_scene: &'a StudyScene,
    bench: Bench<'a>,
    title: String,
    /// Hash of everything that an image of the scene depends on besides the settings.
    fingerprint: u64,
    groups: Vec<Group>,
}

impl Study<'_> {
    /// Measures what the store lacks. Each run is stored at once, so an interrupted study can continue.
    pub fn run(
        &self,
        study_scenes: &[StudyScene],
        store: &mut Store,
        observe: &mut dyn FnMut(Progress),
    ) -> Result<Vec<Findings>, StudyError> {
        let titled = study_scenes.iter().zip(titles(study_scenes));
        let prepared = titled.map(|(study_scene, title)| self.prepare(study_scene, title)).collect::<Result<Vec<_>, _>>()?;
        let runs = prepared.iter().map(|scene| self.runs(scene).count()).sum();
        observe(Progress::Planned { runs, found: prepared.iter().map(|scene| self.found(scene, store)).sum() });
        prepared.into_iter().map(|scene| self.scene(scene, store, observe)).collect()
    }

    /// The sample count among `candidates` with which the store has the most runs of this study; `None` if it has none. `spp` is
    /// part of every key, so another count would repeat the measurements.
    pub fn spp_in(
        &self,
        store: &Store,
        study_scene: &StudyScene,
        candidates: impl Iterator<Item = u32>,
    ) -> Result<Option<u32>, StudyError> {
        if store.is_empty() {
            return Ok(None);
        }
        let scene = self.prepare(study_scene, study_scene.title())?;
        let found = |spp: u32| Study { plan: &Plan { spp, ..self.plan.clone() }, ..*self }.found(&scene, store);
        let most = candidates.map(|spp| (found(spp), spp)).max();
        Ok(most.filter(|(found, _)| *found > 0).map(|(_, spp)| spp))
    }

    fn prepare<'a>(&'a self, study_scene: &'a StudyScene, title: String) -> Result<Prepared<'a>, StudyError> {
        let bench = Bench { scene: &study_scene.scene, camera: &study_scene.camera, threads: self.threads, stop: self.stop };
        // Errors of the reference are reported before anything is rendered.
        reference::known(study_scene, self.plan.floor)?;
        // The bits of an image identify everything it depends on: meshes, textures, and the program itself.
        let picture = trial(bench, &reference::settings(study_scene))?;
        let [width, height] = study_scene.camera.resolution.map(u32::to_le_bytes);
        let fingerprint = hash(&[study_scene.scene.source.as_bytes(), &width, &height, &picture.to_le_bytes()]);
        let groups = groups(bench, &self.plan.lists.combinations(study_scene.scene.settings))?;
        Ok(Prepared { study_scene, bench, title, fingerprint, groups })
    }

    /// All runs, repeat by repeat. A temporary slowdown of the machine then affects all combinations and shows as spread.
    fn runs<'s>(&self, scene: &'s Prepared) -> impl Iterator<Item = (&'s Group, u32)> {
        (0..self.plan.repeats).flat_map(|repeat| scene.groups.iter().map(move |group| (group, repeat)))
    }

    /// The number of runs of a scene in the store.
    fn found(&self, scene: &Prepared, store: &Store) -> usize {
        self.runs(scene).filter(|(group, repeat)| store.run(&self.key(scene, group, *repeat).1).is_some()).count()
    }

    /// The settings of a run with its seed, and its key in the store.
    fn key(&self, scene: &Prepared, group: &Group, repeat: u32) -> (RenderSettings, String) {
        let settings = RenderSettings { seed: group.settings.seed.wrapping_add(repeat), ..group.settings };
        let Machine { cpu, threads, simd, version, .. } = self.machine;
        let Plan { spp, time, floor, .. } = self.plan;
        let reference = reference::identity(scene.study_scene, *spp);
        let how = format!("{settings:?} {spp} {time:?} {floor:?} {cpu} {threads} {simd} {version}");
        (settings, text(hash(&[&scene.fingerprint.to_le_bytes(), &reference.to_le_bytes(), how.as_bytes()])))
    }

    fn scene(&self, scene: Prepared, store: &mut Store, observe: &mut dyn FnMut(Progress)) -> Result<Findings, StudyError> {
        let reference = self.reference(&scene, observe)?;
        let Reference { rel_mse: floor, variance_of_mean, .. } = reference;
        let limits = Limits { floor, black: reference.rel_mse_of_black(), variance_of_mean, mean: reference.mean() };
        let mut runs: Vec<Vec<Run>> = vec![Vec::new(); scene.groups.len()];
        for (number, (group, repeat)) in self.runs(&scene).enumerate() {
            let of_group = &mut runs[number % scene.groups.len()];
            let (settings, key) = self.key(&scene, group, repeat);
            store.refresh()?;
            if let Some(found) = store.run(&key) {
                of_group.push(found);
                continue;
            }
            observe(Progress::Begun { title: &scene.title, settings: &settings });
            let run = measure(scene.bench, &settings, self.plan, &reference.radiance)?;
            let header = Header {
                study_scene: scene.study_scene,
                settings: &settings,
                repeat: repeat + 1,
                reference: &reference,
                machine: self.machine,
                floor: self.plan.floor,
                key: &key,
            };
            store.add(rows(&header, &run))?;
            of_group.push(run);
            observe(Progress::Done);
            if repeat + 1 == self.plan.repeats {
                observe(Progress::Combination { title: &scene.title, outcome: &Outcome::of(group.clone(), of_group, limits) });
            }
        }
        Ok(self.findings(scene, &runs, reference, limits))
    }

    fn reference(&self, scene: &Prepared, observe: &mut dyn FnMut(Progress)) -> Result<Reference, StudyError> {
        let Prepared { study_scene, bench, ref title, fingerprint, .. } = *scene;
        let converged =
            Converged { study_scene, bench, folder: self.folder, fingerprint, spp: self.plan.spp, floor: self.plan.floor };
        converged.reference(&mut |share| observe(Progress::Reference { title, share }))
    }

    fn findings(&self, scene: Prepared, runs: &[Vec<Run>], reference: Reference, limits: Limits) -> Findings {
        let study_scene = scene.study_scene;
        let outcome = |(group, runs): (Group, &Vec<Run>)| Outcome::of(group, runs, limits);
        let mut outcomes: Vec<Outcome> = scene.groups.into_iter().zip(runs).map(outcome).collect();
        rank(&mut outcomes);
        Findings {
            title: scene.title,
            path: study_scene.path.clone(),
            resolution: study_scene.camera.resolution,
            of_scene: study_scene.scene.settings,
            reference: reference.name,
            reference_is_taken_for_exact: reference.is_taken_for_exact,
            limits,
            repeats: self.plan.repeats,
            outcomes,
        }
    }
}
