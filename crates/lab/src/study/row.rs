//! A line of `study.csv`: one checkpoint of one run, with everything that it depends on.
use serde::{Deserialize, Serialize};

use super::{Checkpoint, Machine, Run, StudyScene, key::is_key, reference::Reference};
use noisefall_kernel::measure::Floor;
use noisefall_scene::scene::{PathReuse, RenderSettings};

/// Number of settings, which have a column each.
const SETTINGS: usize = RenderSettings::TABLE.len();

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    pub subject: Subject,
    /// The settings in the words of the command line.
    pub settings: [String; SETTINGS],
    pub measured: Measured,
}

/// The image.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Subject {
    pub scene: String,
    pub width: u32,
    pub height: u32,
}

/// A checkpoint of its run, and the circumstances.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Path reuse between neighbouring pixels.
    pub path_reuse: PathReuse,
    /// Whether sampling was adaptive.
    pub adapts: bool,
    /// Number of the repeat, from 1.
    pub repeat: u32,
    /// Number of the checkpoint, from 1 to `checkpoints`, the number of lines of the run.
    pub checkpoint: usize,
    pub checkpoints: usize,
    pub spp: u32,
    /// Rendering time so far.
    pub seconds: f64,
    pub paths_per_second: f64,
    pub rmse: f64,
    pub rel_mse: f64,
    pub bias: f64,
    /// Standard error of the bias, without the reference's own error; empty before the second sample.
    pub bias_standard_error: Option<f64>,
    /// Effective number of samples behind the variance; a small number means heavy tails. Empty if nothing varies.
    pub effective_samples: Option<f64>,
    /// Why the estimate is biased; empty if it is not.
    pub biased: String,
    pub invalid_samples: u64,
    pub reference: String,
    /// The reference's own relMSE.
    pub reference_rel_mse: f64,
    /// Constant that relMSE adds to the squared reference: a number, or a fraction of the reference's mean squared radiance.
    pub floor: String,
    pub threads: usize,
    pub simd: String,
    pub cpu: String,
    pub version: String,
    pub commit: String,
    /// The key of the run. It is last and of fixed length, so truncated lines are detected.
    pub key: String,
}

/// Everything about a run except its measurements.
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
        let Measured { key, checkpoint, checkpoints, .. } = &self.measured;
        is_key(key) && (1..=*checkpoints).contains(checkpoint)
    }

    fn point(&self) -> Checkpoint {
        let Measured { spp, seconds, rmse, rel_mse, bias, bias_standard_error, effective_samples, .. } = self.measured;
        Checkpoint { spp, seconds, rmse, rel_mse, bias, bias_standard_error, effective_samples }
    }

    /// The names of the columns.
    pub fn columns() -> csv::Result<csv::ByteRecord> {
        let mut columns = names::<Subject>()?;
        RenderSettings::TABLE.iter().for_each(|setting| columns.push_field(setting.key().as_bytes()));
        columns.extend(&names::<Measured>()?);
        Ok(columns)
    }
}

/// The names of the fields of a struct.
fn names<T: Serialize + Default>() -> csv::Result<csv::ByteRecord> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.serialize(T::default())?;
    let bytes = writer.into_inner().map_err(csv::IntoInnerError::into_error)?;
    csv::Reader::from_reader(&bytes[..]).byte_headers().cloned()
}

/// The lines of a run.
pub fn rows(header: &Header, run: &Run) -> Vec<Row> {
    let Header { study_scene, settings, repeat, reference, machine, floor, key } = *header;
    let [width, height] = study_scene.camera.resolution;
    let pixels = f64::from(width) * f64::from(height);
    let subject = Subject { scene: study_scene.path.display().to_string(), width, height };
    let words = RenderSettings::TABLE.map(|setting| setting.value(settings));
    let measured = |(i, point): (usize, &Checkpoint)| Measured {
        path_reuse: run.path_reuse,
        adapts: run.adapts,
        repeat,
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
    let row = |measured| Row { subject: subject.clone(), settings: words.clone(), measured };
    run.checkpoints.iter().enumerate().map(measured).map(row).collect()
}

/// The run of these lines; `None` if one is missing.
pub fn run(rows: &[Row]) -> Option<Run> {
    let first = &rows.first()?.measured;
    let complete = rows.len() == first.checkpoints && (1..).zip(rows).all(|(place, row)| row.measured.checkpoint == place);
    let checkpoints = rows.iter().map(Row::point).collect();
    let Measured { invalid_samples, path_reuse, adapts, .. } = *first;
    complete.then(|| Run { checkpoints, invalid_samples, bias: first.biased.clone(), path_reuse, adapts })
}
