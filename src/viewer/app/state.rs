//! The state of the window.
use std::path::PathBuf;

use noisefall_render::render::threads::Threads;

use super::{
    file_tasks::OutsideChanges, file_tasks::PendingSave, history::History, results::Results, scene_editor::SceneEditor,
    selection::Selection, session::Session, window_state::Dialogs, window_state::WindowState,
};
use crate::viewer::background::{
    adviser::Adviser, background_task::BackgroundTask, catalogue, catalogue::CatalogueEntry, denoiser::Denoiser,
    display_pipeline::DisplayPipeline, dropped::DropReader, exact_compile::ExactCompile, feature_finder::FeatureFinder,
    file_watcher::FileWatcher, loader::Loader, opened_scene::GivenScene, preferences::Preferences,
    progress_checkpoints::ProgressCheckpoints, recovery_keeper::RecoveryKeeper, reference_task::ReferenceTask,
    render_worker::RenderWorkerHandle, saver::Saver, sequence_task::SequenceTask, tev_link::TevLink,
};
use crate::viewer::instruments::{convergence::history::History as ErrorHistory, path::inspector::PathInspector};
use crate::viewer::panels::frame_times::FrameTimes;
use crate::viewer::widgets::palette::{set_fonts, set_themes};

pub struct App {
    pub ctx: egui::Context,
    pub session: Session,
    pub history: History,
    pub results: Results,
    pub window: WindowState,
    /// Changes the open scene.
    pub editor: Option<SceneEditor>,
    /// Changes that other programs make to the files of the open scene.
    pub outside: OutsideChanges,
    pub saving: Option<PendingSave>,
    pub selection: Selection,
    pub instruments: Instruments,
    pub dialogs: Dialogs,
    pub background: Background,
    pub catalogue: Vec<CatalogueEntry>,
    pub preferences: Preferences,
    pub frame_times: FrameTimes,
}

/// The instruments that remember something.
pub struct Instruments {
    pub history: ErrorHistory,
    pub path: PathInspector,
}

/// The work that is done on other threads.
pub struct Background {
    pub worker: RenderWorkerHandle,
    pub display: DisplayPipeline,
    pub loader: Loader,
    pub drops: DropReader,
    pub exact_compile: ExactCompile,
    pub saver: Saver,
    pub files: FileWatcher,
    pub recovery: RecoveryKeeper,
    pub progress: ProgressCheckpoints,
    /// The image that is drawn for the clipboard.
    pub copying: Option<BackgroundTask<egui::ColorImage>>,
    pub features: FeatureFinder,
    pub denoiser: Denoiser,
    pub tev: TevLink,
    /// The numbered frames that are being rendered.
    pub sequence: Option<SequenceTask>,
    /// The reference that is being rendered, and the folder in which it is kept.
    pub reference: Option<ReferenceTask>,
    pub references: Option<PathBuf>,
    pub adviser: Option<Adviser>,
}

impl App {
    pub fn new(ctx: &egui::Context, threads: Threads, scene: GivenScene, preferences: Preferences) -> App {
        set_fonts(ctx);
        set_themes(ctx, preferences.now.theme.as_deref());
        if let Some(scale) = preferences.now.scale.filter(|scale| (0.5..=4.0).contains(scale)) {
            ctx.set_zoom_factor(scale);
        }
        let session = Session::new(threads.count());
        let mut background = Background {
            worker: RenderWorkerHandle::new(threads, ctx),
            display: DisplayPipeline::new(ctx),
            loader: Loader::new(ctx),
            drops: DropReader::new(ctx),
            exact_compile: ExactCompile::new(ctx),
            saver: Saver::new(ctx),
            files: FileWatcher::idle(),
            recovery: RecoveryKeeper::default(),
            progress: ProgressCheckpoints::default(),
            copying: None,
            features: FeatureFinder::new(ctx),
            denoiser: Denoiser::new(ctx),
            tev: TevLink::new(ctx),
            sequence: None,
            reference: None,
            references: None,
            adviser: None,
        };
        background.loader.open_given(scene);
        App {
            ctx: ctx.clone(),
            session,
            history: History::default(),
            results: Results::default(),
            window: WindowState::default(),
            editor: None,
            outside: OutsideChanges::default(),
            saving: None,
            selection: Selection::new(ctx),
            instruments: Instruments { history: ErrorHistory::default(), path: PathInspector::new(ctx) },
            dialogs: Dialogs::default(),
            background,
            catalogue: catalogue::find(),
            preferences,
            frame_times: FrameTimes::default(),
        }
    }

    /// Watches the files of the open scene, and keeps unsaved changes of this user in case the program ends unexpectedly.
    pub fn use_disk(&mut self) {
        self.background.recovery = RecoveryKeeper::of_user();
        if let Some(folder) = self.background.recovery.folder() {
            self.background.references = Some(folder.with_file_name("references"));
            self.background.progress = ProgressCheckpoints::in_folder(&self.ctx, folder);
        }
        match FileWatcher::start(&self.ctx) {
            Ok(files) => self.background.files = files,
            Err(error) => self.tell(format!("Changes by other programs are not noticed: {error}"), true),
        }
    }

    /// Shows a message over the image.
    pub fn tell(&mut self, text: String, is_error: bool) {
        self.dialogs.notices.add(text, is_error, self.ctx.input(|input| input.time));
    }
}
