//! Keeps a long render in a file beside the recovery files, and looks for those that other runs of the program have left.
use std::{
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

use noisefall_render::render::{KeepHandle, checkpoint::CheckpointFile};

use super::{
    background_task::BackgroundTask,
    catalogue::name_in,
    checkpoint_render::RenderToKeep,
    recovery_files::{OwnFile, begin, is_in_use, left_files, remove},
};

/// Render time before the first file, and between two.
const PAUSE: Duration = Duration::from_secs(60);
/// The time between two files is at least this many times what the last one took.
const SHARE: u32 = 100;
/// Larger images are not kept without being asked: one file of this size is enough for 4096 × 3072 pixels.
const MOST_PIXELS: u64 = 4096 * 3072;
/// Time between two looks at the lock of another window, and the number of looks.
const LOOK: Duration = Duration::from_millis(100);
const MOST_LOOKS: usize = 100;
const PREFIX: &str = "progress-";
const EXTENSION: &str = "nf";

/// A render that a window has left behind.
#[derive(Clone, Debug)]
pub struct FoundRender {
    pub file: PathBuf,
    /// Name of its scene.
    pub scene: String,
    /// Time that it has been rendered.
    pub rendered: Duration,
    /// Time since it was kept.
    pub age: Duration,
}

/// Keeps the render of this window. A folder that cannot be read or written is not reported.
#[derive(Default)]
pub struct ProgressCheckpoints {
    /// The folder of the files; without one, nothing is kept.
    folder: Option<PathBuf>,
    own: Option<OwnFile>,
    /// Number of the image, its render time, and time that its file took, at the last attempt.
    last: (u64, Duration, Duration),
    writing: Option<BackgroundTask<Duration>>,
    search: Option<BackgroundTask<Option<FoundRender>>>,
    /// The file from which this window continues: it goes when the render has another one, or ends in order.
    superseded: Option<PathBuf>,
}

impl ProgressCheckpoints {
    /// Keeps renders in this folder, and looks for one that was left there.
    pub fn in_folder(ctx: &egui::Context, folder: &Path) -> ProgressCheckpoints {
        let of_search = folder.to_owned();
        let search = BackgroundTask::start(ctx, move |cancelled| find_patiently(&of_search, cancelled));
        ProgressCheckpoints { folder: Some(folder.to_owned()), search: Some(search), ..ProgressCheckpoints::default() }
    }

    /// Whether an image should be kept now. The file of an image that is no longer rendered is removed.
    pub fn is_due(&mut self, generation: u64, elapsed: Duration) -> bool {
        if let Some(Ok(took)) = BackgroundTask::take(&mut self.writing) {
            self.last.2 = took;
            self.superseded.take().into_iter().for_each(|file| remove(&file));
        }
        if self.folder.is_none() || self.writing.is_some() {
            return false;
        }
        if self.last.0 != generation {
            self.own.take().into_iter().for_each(|own| remove(&own.path));
            // A render that continues is in its file already.
            let since = if self.superseded.is_some() { elapsed } else { Duration::ZERO };
            self.last = (generation, since, Duration::ZERO);
        }
        let (_, since, took) = self.last;
        elapsed.saturating_sub(since) >= PAUSE.max(SHARE * took)
    }

    /// Writes the file of a render.
    pub fn keep(&mut self, render: RenderToKeep, worker: KeepHandle, elapsed: Duration) {
        self.last.1 = elapsed;
        let pixels = render.request.camera.resolution.map(u64::from).iter().product::<u64>();
        let Some(folder) = self.folder.as_ref().filter(|_| pixels <= MOST_PIXELS) else { return };
        if self.own.is_none() {
            self.own = begin(folder, PREFIX, EXTENSION).ok();
        }
        let Some(path) = self.own.as_ref().map(|own| own.path.clone()) else { return };
        self.writing = Some(BackgroundTask::start(&egui::Context::default(), move |_| {
            let start = Instant::now();
            let _ = render.save(&worker, &path);
            start.elapsed()
        }));
    }

    /// Takes note of the file from which a scene was opened.
    pub fn begin(&mut self, file: Option<&Path>) {
        self.superseded = file.filter(|file| file.parent() == self.folder.as_deref()).map(Path::to_owned);
    }

    /// Removes the files, because the window ends in order.
    pub fn forget(&mut self) {
        self.folder = None;
        let own = self.own.take().map(|own| own.path.clone());
        own.into_iter().chain(self.superseded.take()).for_each(|file| remove(&file));
    }

    /// The render that was found, once.
    pub fn take(&mut self) -> Option<FoundRender> {
        BackgroundTask::take(&mut self.search)?.ok()?
    }
}

/// The latest render of a window that has ended, or that ends soon: a program that was killed holds its lock until its memory is freed.
fn find_patiently(folder: &Path, cancelled: &dyn Fn() -> bool) -> Option<FoundRender> {
    for _ in 0..MOST_LOOKS {
        let found = find(folder);
        if found.is_some() || cancelled() || !left_files(folder, EXTENSION).any(|file| is_in_use(&file)) {
            return found;
        }
        std::thread::sleep(LOOK);
    }
    None
}

/// The latest render that no window has open.
fn find(folder: &Path) -> Option<FoundRender> {
    let found = left_files(folder, EXTENSION).filter(|file| !is_in_use(file)).filter_map(|file| {
        let header = CheckpointFile::open(&file).ok()?.header().clone();
        let age = file.metadata().and_then(|metadata| metadata.modified()).ok()?.elapsed().unwrap_or_default();
        let rendered = Duration::try_from_secs_f64(header.counters.seconds).ok()?;
        Some(FoundRender { file, scene: name_in(header.scene.text.as_bytes(), &header.scene.name), rendered, age })
    });
    found.min_by_key(|found| found.age)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_render_is_kept_after_a_minute_and_then_as_often_as_its_file_allows() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut keeper = ProgressCheckpoints::in_folder(&egui::Context::default(), folder.path());
        let seconds = Duration::from_secs;
        assert!(!keeper.is_due(1, seconds(59)) && keeper.is_due(1, seconds(60)));
        keeper.last = (1, seconds(60), seconds(2));
        assert!(!keeper.is_due(1, seconds(259)) && keeper.is_due(1, seconds(260)));
        assert!(!keeper.is_due(2, seconds(59)), "another image");
        assert!(!ProgressCheckpoints::default().is_due(1, seconds(600)), "without a folder");
    }

    #[test]
    fn the_file_goes_with_its_image_and_when_the_window_ends_in_order() {
        let folder = tempfile::tempdir().expect("a folder");
        let keeper = || {
            let mut keeper = ProgressCheckpoints { folder: Some(folder.path().to_owned()), ..ProgressCheckpoints::default() };
            keeper.last.0 = 1;
            let own = begin(folder.path(), PREFIX, EXTENSION).expect("it can be written");
            std::fs::write(&own.path, "a render").expect("it is written");
            keeper.own = Some(own);
            keeper
        };
        let count = || left_files(folder.path(), EXTENSION).count();
        let mut other_image = keeper();
        assert!(!other_image.is_due(1, Duration::ZERO) && count() == 1);
        assert!(!other_image.is_due(2, Duration::ZERO) && count() == 0);
        let mut ends = keeper();
        ends.forget();
        assert_eq!(count(), 0);
        drop(keeper());
        assert_eq!(count(), 1, "it stays when the window is lost");
        assert!(find(folder.path()).is_none(), "it is no whole file");
    }
}
