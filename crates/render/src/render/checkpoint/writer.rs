//! Writes checkpoints while a render goes on.
use std::{
    path::{Path, PathBuf},
    thread::JoinHandle,
    time::{Duration, Instant},
};

use crossbeam_channel::Sender;

use super::film_sections;
use crate::{
    render::{film::Film, pass::panic_message, threads::Threads},
    render_file::{Counters, Encoded, Header, Writer},
};
use noisefall_base::{
    file,
    memory::{self, Reservation, TooMuch},
};

/// The render time between two checkpoints is at least this many times what the last one took from the render: they take 1 % of it
/// at most.
const SHARE: u32 = 100;

/// Where and how often a render is kept.
#[derive(Clone)]
pub struct CheckpointPlan {
    /// The file.
    pub path: PathBuf,
    /// Metadata of the file about the image.
    pub header: Header,
    /// Time between two checkpoints. It is longer if they would take more than 1 % of the time. `None` keeps on request only.
    pub every: Option<Duration>,
    /// Receives what becomes of the checkpoints.
    pub events: Sender<CheckpointEvent>,
}

/// Result of a checkpoint.
#[derive(Clone, Debug, PartialEq)]
pub enum CheckpointEvent {
    /// It is on the disk.
    Kept,
    /// Checkpoints take so long that the time between them is this.
    Slower {
        /// Time that the last one took from the render.
        took: Duration,
        /// The time until the next one.
        every: Duration,
    },
    /// It could not be written. The render and an earlier checkpoint are as they were.
    Failed(String),
}

/// Reserves memory for the snapshot of an image of this size.
pub fn reserve([width, height]: [u32; 2]) -> Result<Reservation, TooMuch> {
    let bytes = Film::kept_bytes([width, height]);
    // Counts and records of blocks, some with little more than a pixel.
    memory::reserve(format_args!("checkpoints of {width} × {height} pixels"), bytes + bytes / 8)
}

/// Writes the checkpoints of one image.
pub struct CheckpointWriter {
    plan: CheckpointPlan,
    /// End of the last checkpoint, or the start.
    last: Instant,
    /// Shortest time until the next one.
    pause: Duration,
    writing: Option<JoinHandle<Result<(), String>>>,
    /// Whether it was told that the pause is longer than asked for.
    is_slower: bool,
    _memory: Reservation,
}

impl CheckpointWriter {
    pub fn new(plan: CheckpointPlan) -> Result<CheckpointWriter, TooMuch> {
        let memory = reserve(plan.header.camera.resolution)?;
        let pause = plan.every.unwrap_or(Duration::MAX);
        Ok(CheckpointWriter { plan, last: Instant::now(), pause, writing: None, is_slower: false, _memory: memory })
    }

    /// Whether it is time for a checkpoint. Reports the one that was being written.
    pub fn is_due(&mut self) -> bool {
        if self.writing.as_ref().is_some_and(|writing| !writing.is_finished()) {
            return false;
        }
        self.report();
        self.plan.every.is_some() && self.last.elapsed() >= self.pause
    }

    /// Takes a snapshot of a render that stands still, and starts to write it.
    pub fn keep(&mut self, film: &Film, counters: Counters, threads: &Threads) {
        self.report();
        let start = Instant::now();
        let sections = threads.install(|| film_sections::encode(film));
        let header = Header { counters, ..self.plan.header.clone() };
        let path = self.plan.path.clone();
        let write = move || write(&path, &header, &sections);
        match std::thread::Builder::new().name("checkpoint".to_owned()).spawn(write) {
            Ok(writing) => self.writing = Some(writing),
            Err(error) => self.tell(CheckpointEvent::Failed(error.to_string())),
        }
        self.last = Instant::now();
        self.wait_longer(start.elapsed());
    }

    /// Waits until the checkpoint that is being written is on the disk, and reports it.
    pub fn report(&mut self) {
        let Some(writing) = self.writing.take() else { return };
        let written = writing.join().unwrap_or_else(|panic| Err(panic_message(&*panic)));
        self.tell(written.map_or_else(CheckpointEvent::Failed, |()| CheckpointEvent::Kept));
    }

    fn wait_longer(&mut self, took: Duration) {
        let Some(every) = self.plan.every else { return };
        let pause = every.max(SHARE * took);
        if pause > every && !self.is_slower {
            self.is_slower = true;
            self.tell(CheckpointEvent::Slower { took, every: pause });
        }
        self.pause = pause;
    }

    fn tell(&self, event: CheckpointEvent) {
        let _ = self.plan.events.send(event);
    }
}

impl Drop for CheckpointWriter {
    fn drop(&mut self) {
        self.report();
    }
}

fn write(path: &Path, header: &Header, sections: &[Encoded]) -> Result<(), String> {
    let written = file::replace_by(path, |to| {
        let mut writer = Writer::new(to, header)?;
        sections.iter().try_for_each(|section| writer.section(section))?;
        writer.finish().map(drop)
    });
    written.map_err(|error| error.to_string())
}
