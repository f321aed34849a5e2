//! Renders the numbered frames of a turntable or a camera path, off the UI thread.
use std::{
    ops::ControlFlow,
    path::{Path, PathBuf},
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
};

use noisefall_base::{file::numbered, math::SimdLevel};
use noisefall_render::render::{
    Budget, Display, Published, RenderRequest, State,
    image_file::{Contents, check_target},
    settings_text::settings_text,
    still::StillRenderer,
    threads::Threads,
};
use noisefall_scene::scene::{Camera, CameraSequence};

use super::background_task::BackgroundTask;

/// The treatment of frames whose file exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExistingFrames {
    /// They are counted first, and nothing is rendered if there are any.
    Ask,
    Keep,
    Replace,
}

/// Frames to render.
#[derive(Clone)]
pub struct SequenceRequest {
    pub cameras: CameraSequence,
    /// Samples per pixel of every frame.
    pub spp: u32,
    /// Path of the images, with `#` for every digit of the number.
    pub files: PathBuf,
    pub existing: ExistingFrames,
    /// The scene, the first camera of a turntable, and the settings.
    pub image: RenderRequest,
    /// Display transform of a PNG.
    pub display: Display,
    pub threads: usize,
}

/// Progress of the frames. Those that are kept count as rendered.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SequenceProgress {
    /// Number of the frame that is rendered, from 1.
    pub frame: usize,
    pub frames: usize,
    /// Samples per pixel of that frame so far.
    pub spp: u32,
}

/// How the work ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SequenceEnd {
    /// All frames are there; this many were rendered.
    Done { rendered: usize, frames: usize },
    /// It was stopped after this many frames.
    Stopped { rendered: usize, frames: usize },
    /// The user has to decide about the files that exist.
    Exist { existing: usize, frames: usize },
}

pub struct SequenceTask {
    pub request: SequenceRequest,
    progress: Arc<Mutex<SequenceProgress>>,
    stop: Arc<AtomicBool>,
    pending: Option<BackgroundTask<Result<SequenceEnd, String>>>,
}

impl SequenceTask {
    pub fn start(ctx: &egui::Context, request: SequenceRequest) -> SequenceTask {
        let (progress, stop) = (Arc::new(Mutex::default()), Arc::new(AtomicBool::new(false)));
        let (told, stopped, of, window) = (progress.clone(), stop.clone(), request.clone(), ctx.clone());
        let pending = BackgroundTask::start(ctx, move |cancelled| {
            let tell = |progress| {
                *told.lock().unwrap_or_else(PoisonError::into_inner) = progress;
                window.request_repaint();
            };
            render(&of, &tell, &|| cancelled() || stopped.load(Ordering::Relaxed))
        });
        SequenceTask { request, progress, stop, pending: Some(pending) }
    }

    pub fn progress(&self) -> SequenceProgress {
        *self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Drops the frame that is being rendered, and ends the work.
    pub fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Takes the end of the work and removes the task. `None` while it runs, or if there is none.
    pub fn take(task: &mut Option<SequenceTask>) -> Option<(SequenceRequest, Result<SequenceEnd, String>)> {
        let end = BackgroundTask::take(&mut task.as_mut()?.pending)?;
        let SequenceTask { request, .. } = task.take()?;
        Some((request, end.unwrap_or_else(|_| Err("rendering the frames failed unexpectedly".to_owned()))))
    }
}

/// Renders the frames one by one. A frame is written when it is finished.
fn render(request: &SequenceRequest, tell: &dyn Fn(SequenceProgress), stops: &dyn Fn() -> bool) -> Result<SequenceEnd, String> {
    let cameras = request.cameras.cameras(&request.image.camera)?;
    let numbered = |(camera, number)| numbered(&request.files, number).map(|path| (camera, path));
    let shots: Vec<(Camera, PathBuf)> = cameras.into_iter().zip(1..).filter_map(numbered).collect();
    let frames = shots.len();
    if frames == 0 {
        return Err("the name of the files has no #".to_owned());
    }
    shots.iter().try_for_each(|(_, path)| check_target(path)).map_err(|error| error.to_string())?;
    let existing = shots.iter().filter(|(_, path)| path.is_file()).count();
    if existing > 0 && request.existing == ExistingFrames::Ask {
        return Ok(SequenceEnd::Exist { existing, frames });
    }
    let threads = Threads::new(request.threads, SimdLevel::best()).map_err(|error| error.to_string())?;
    let mut stills = StillRenderer::new(threads, Budget { max_spp: Some(request.spp), ..Budget::default() });
    let mut rendered = 0;
    for (frame, (camera, path)) in (1..).zip(&shots) {
        if request.existing != ExistingFrames::Replace && path.is_file() {
            continue;
        }
        let mut watch = |published: &Published| {
            tell(SequenceProgress { frame, frames, spp: published.status.spp });
            if stops() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let image = RenderRequest { camera: *camera, ..request.image.clone() };
        let published = stills.picture(image.clone(), &mut watch).map_err(|error| error.to_string())?;
        if stops() {
            return Ok(SequenceEnd::Stopped { rendered, frames });
        }
        if let State::Failed(failure) = &published.status.state {
            return Err(format!("the renderer failed: {}", failure.message));
        }
        write(&image, request.display, &published, path)?;
        rendered += 1;
    }
    Ok(SequenceEnd::Done { rendered, frames })
}

fn write(image: &RenderRequest, display: Display, published: &Published, path: &Path) -> Result<(), String> {
    let RenderRequest { scene, camera, settings } = image;
    let text = settings_text(scene, camera, settings, display, &published.frame, &[]);
    let contents = Contents { frame: &published.frame, channels: &[], settings: &text };
    contents.save(display, path).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use noisefall_render::render::image_file::read;
    use noisefall_scene::scene::built_in;

    use super::*;

    fn request(files: PathBuf) -> SequenceRequest {
        let scene = built_in();
        let camera = Camera { resolution: [24, 16], ..scene.camera };
        SequenceRequest {
            cameras: CameraSequence::Turntable(3),
            spp: 2,
            files,
            existing: ExistingFrames::Ask,
            image: RenderRequest { settings: scene.settings, scene: Arc::new(scene), camera },
            display: Display::default(),
            threads: 1,
        }
    }

    #[test]
    fn every_frame_is_the_image_of_its_camera_and_none_is_replaced_unasked() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |number: u32| folder.path().join(format!("turn-{number:02}.exr"));
        let request = request(folder.path().join("turn-##.exr"));
        let never = &|| false;
        let end = render(&request, &|_| (), never);
        assert_eq!(end, Ok(SequenceEnd::Done { rendered: 3, frames: 3 }));
        let mut stills = StillRenderer::new(
            Threads::new(1, SimdLevel::best()).expect("a thread can be had"),
            Budget { max_spp: Some(2), ..Budget::default() },
        );
        for (number, camera) in (1..).zip(request.image.camera.turntable(3)) {
            let image = RenderRequest { camera, ..request.image.clone() };
            let still = stills.picture(image, &mut |_| ControlFlow::Continue(())).expect("it runs");
            assert_eq!(read(&path(number)).expect("an image").radiance, still.frame.radiance, "frame {number}");
        }
        std::fs::write(path(1), "mine").expect("it is written");
        std::fs::remove_file(path(2)).expect("it is there");
        assert_eq!(render(&request, &|_| (), never), Ok(SequenceEnd::Exist { existing: 2, frames: 3 }));
        assert!(!path(2).exists());
        let with = |existing| render(&SequenceRequest { existing, ..request.clone() }, &|_| (), never);
        assert_eq!(with(ExistingFrames::Keep), Ok(SequenceEnd::Done { rendered: 1, frames: 3 }));
        assert!(path(2).exists() && std::fs::read(path(1)).expect("it is there") == b"mine");
        assert_eq!(with(ExistingFrames::Replace), Ok(SequenceEnd::Done { rendered: 3, frames: 3 }));
        assert!(read(&path(1)).is_ok());
    }

    #[test]
    fn a_stop_leaves_whole_frames_and_a_mistake_is_reported() {
        let folder = tempfile::tempdir().expect("a folder");
        let request = request(folder.path().join("#.png"));
        let stops = || folder.path().join("1.png").exists();
        assert_eq!(render(&request, &|_| (), &stops), Ok(SequenceEnd::Stopped { rendered: 1, frames: 3 }));
        assert!(read(&folder.path().join("1.png")).is_ok() && !folder.path().join("2.png").exists());
        let refused = |request: SequenceRequest| render(&request, &|_| (), &|| false).expect_err("it is refused");
        assert!(refused(SequenceRequest { files: folder.path().join("frame.png"), ..request.clone() }).contains('#'));
        let nowhere = folder.path().join("nowhere/#.png");
        assert!(refused(SequenceRequest { files: nowhere, ..request.clone() }).contains("there is no folder"));
        let cameras = CameraSequence::Path(folder.path().join("path.toml"));
        assert!(refused(SequenceRequest { cameras, ..request }).contains("path.toml"));
    }
}
