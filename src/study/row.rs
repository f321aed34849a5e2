//! A line of `study.csv`: one checkpoint of one run, with all that it depends on.
use serde::{Deserialize, Serialize};

use super::{Checkpoint, Machine, Run, StudyScene, key::is_key, reference::Reference, setting::Setting};
use crate::{measure::Floor, scene::RenderSettings};

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    pub scene: String,
    pub width: u32,
    pub height: u32,
    pub estimator: String,
    pub directions: String,
    pub sampler: String,
    pub roulette: String,
    pub max_bounces: String,
    pub reuse: String,
    /// Pixels shared paths.
    pub shares: bool,
    pub adaptive: String,
    /// Samples went where noise was.
    pub adapts: bool,
    /// From 1.
    pub repeat: u32,
    pub seed: u32,
    /// From 1 to `checkpoints`, which is how many lines the run has.
    pub checkpoint: usize,
    pub checkpoints: usize,
    pub spp: u32,
    /// Rendering time so far.
    pub seconds: f64,
    pub paths_per_second: f64,
    pub rmse: f64,
    pub rel_mse: f64,
    pub bias: f64,
    /// Of the bias, but for the reference's own error; empty before the second sample.
    pub bias_standard_error: Option<f64>,
    /// How many samples of equal weight would make up the variance: few mean heavy tails. Empty where nothing varies.
    pub effective_samples: Option<f64>,
    /// Why the picture does not converge to the solution; empty when it does.
    pub biased: String,
    pub invalid_samples: u64,
    pub reference: String,
    /// The reference's own.
    pub reference_rel_mse: f64,
    /// What relMSE adds to the squared reference: a number, or a part of the reference's mean squared radiance.
    pub floor: String,
    pub threads: usize,
    pub simd: String,
    pub cpu: String,
    pub version: String,
    pub commit: String,
    /// Last, and of fixed length, so that a line that is cut off is noticed.
    pub key: String,
}

/// What a run is besides what it measured.
pub struct Header<'a> {
    pub study_scene: &'a StudyScene,
    pub settings: &'a RenderSettings,
    pub repeat: u32,
    pub reference: &'a Reference,
    pub machine: &'a Machine,
    pub floor: Floor,
    pub key: &'a str,
}

impl Row {
    pub fn is_whole(&self) -> bool {
        is_key(&self.key) && (1..=self.checkpoints).contains(&self.checkpoint)
    }

    fn point(&self) -> Checkpoint {
        let Row { spp, seconds, rmse, rel_mse, bias, bias_standard_error, effective_samples, .. } = *self;
        Checkpoint { spp, seconds, rmse, rel_mse, bias, bias_standard_error, effective_samples }
    }
}

/// The lines of a run.
pub fn rows(header: &Header, run: &Run) -> Vec<Row> {
    let Header { study_scene, settings, repeat, reference, machine, floor, key } = *header;
    let [width, height] = study_scene.camera.resolution;
    let pixels = f64::from(width) * f64::from(height);
    let row = |(i, point): (usize, &Checkpoint)| Row {
        scene: study_scene.path.display().to_string(),
        width,
        height,
        estimator: Setting::Estimator.value(settings),
        directions: Setting::Directions.value(settings),
        sampler: Setting::Sampler.value(settings),
        roulette: Setting::Roulette.value(settings),
        max_bounces: Setting::Cap.value(settings),
        reuse: Setting::Reuse.value(settings),
        shares: run.shares,
        adaptive: Setting::Adaptive.value(settings),
        adapts: run.adapts,
        repeat,
        seed: settings.seed,
        checkpoint: i + 1,
        checkpoints: run.checkpoints.len(),
        spp: point.spp,
        seconds: point.seconds,
        paths_per_second: pixels * f64::from(point.spp) / point.seconds,
        rmse: point.rmse,
        rel_mse: point.rel_mse,
        bias: point.bias,
        bias_standard_error: point.bias_standard_error,
        effective_samples: point.effective_samples,
        biased: run.bias.clone(),
        invalid_samples: run.invalid_samples,
        reference: reference.name.clone(),
        reference_rel_mse: reference.rel_mse,
        floor: floor.to_string(),
        threads: machine.threads,
        simd: machine.simd.clone(),
        cpu: machine.cpu.clone(),
        version: machine.version.clone(),
        commit: machine.commit.clone(),
        key: key.to_owned(),
    };
    run.checkpoints.iter().enumerate().map(row).collect()
}

/// The run of its lines, if none is missing.
pub fn run(rows: &[Row]) -> Option<Run> {
    let first = rows.first()?;
    let complete = rows.len() == first.checkpoints && (1..).zip(rows).all(|(place, row)| row.checkpoint == place);
    let checkpoints = rows.iter().map(Row::point).collect();
    let Row { invalid_samples, shares, adapts, .. } = *first;
    complete.then(|| Run { checkpoints, invalid_samples, bias: first.biased.clone(), shares, adapts })
}
