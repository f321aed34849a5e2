//! Saves the open scene off the UI thread, one file at a time.
use std::path::{Path, PathBuf};

use crossbeam_channel::TryRecvError;
use noisefall_base::declare::{OwnedValue, Path as ParameterPath};
use noisefall_edit::edit::{Edit, Version, Written};

use super::{file_tasks::PendingSave, state::App};
use crate::viewer::background::{
    catalogue,
    file_state::{SaveResult, save},
    recent,
};
use crate::viewer::dialogs::{
    save_target::SaveTarget,
    unsaved::{Leaving, SaveRequest},
};

impl App {
    /// Saves the scene to its file. A scene without a file asks for one, and so does one that comes with the program: it stays as it
    /// came.
    pub fn save_scene(&mut self) {
        let Some(editor) = &self.editor else { return };
        let document = &editor.document;
        let is_own = document.path().is_some_and(|path| !catalogue::is_shipped(&self.catalogue, path, document.on_disk()));
        if !is_own {
            return self.ask_where_to_save();
        }
        let leaving = self.window.leaving.take();
        self.request_save(SaveRequest { leaving, ..SaveRequest::default() });
    }

    pub fn ask_where_to_save(&mut self) {
        self.open_save_dialog(SaveTarget::Scene);
    }

    /// Saves the scene to a file that was chosen. It is the file of the scene from then on.
    pub fn save_scene_to(&mut self, path: &Path) {
        let leaving = self.window.leaving.take();
        self.request_save(SaveRequest { path: Some(path.to_owned()), replaces: true, leaving });
    }

    /// Saves the scene when the last save has ended.
    pub fn request_save(&mut self, request: SaveRequest) {
        self.keep_exposure();
        if let Some(saving) = &mut self.saving {
            let earlier = saving.next.take().unwrap_or_default();
            saving.next = Some(request.after(earlier));
            return;
        }
        let Some(editor) = &self.editor else { return };
        let Some(path) = request.path.as_deref().or(editor.document.path()).map(Path::to_owned) else { return };
        let (document, opened) = (editor.document.clone(), self.session.path().map(Path::to_owned));
        let assets = self.session.opened.as_ref().map(|opened| opened.scene.assets.clone()).unwrap_or_default();
        let (to, replaces) = (path.clone(), request.replaces);
        let result = self.background.saver.run(move || save(&document, opened.as_deref(), &assets, &to, replaces));
        self.saving = Some(PendingSave { request, path, result, next: None });
    }

    /// Gives the scene the exposure of the window: it is saved with the scene.
    fn keep_exposure(&mut self) {
        let exposure = self.session.look.display.exposure;
        let Some(editor) = &self.editor else { return };
        if editor.document.description().render.exposure != exposure {
            self.edit(&Edit::set(ParameterPath::of("render.exposure"), OwnedValue::Number(f64::from(exposure))));
        }
    }

    /// Receives the result of a save. Then what waited for it goes on.
    pub fn receive_saved(&mut self) {
        let Some(saving) = &self.saving else { return };
        let result = match saving.result.try_recv() {
            Ok(result) => result,
            Err(TryRecvError::Empty) => return,
            Err(TryRecvError::Disconnected) => SaveResult::Failed("saving failed unexpectedly".to_owned()),
        };
        let Some(PendingSave { request, path, next, .. }) = self.saving.take() else { return };
        self.outside.recheck();
        match result {
            SaveResult::Written(written) => {
                self.take_saved(&path, written);
                request.leaving.into_iter().for_each(|leaving| self.ask_to_leave(leaving));
            }
            SaveResult::Exported(version) => self.take_exported(path, version, request.leaving),
            SaveResult::Differs(state) => self.follow_file(state, Some(request)),
            SaveResult::Failed(error) => self.tell(format!("Not saved: {error}"), true),
        }
        next.into_iter().for_each(|next| self.request_save(next));
    }

    /// Goes on with a scene of another program in the file that was written: its meshes and textures are files now.
    fn take_exported(&mut self, path: PathBuf, version: Version, leaving: Option<Leaving>) {
        if self.editor.as_ref().is_some_and(|editor| editor.document.version() != version) {
            let text = format!("Saved {} without your latest changes. Save again to include them.", path.display());
            return self.tell(text, true);
        }
        self.tell(format!("Saved {}", path.display()), false);
        if let Some(leaving) = leaving {
            return self.leave(leaving);
        }
        self.window.kept_view = Some((Some(path.clone()), self.session.window_view()));
        self.background.loader.open(Some(path));
    }

    fn take_saved(&mut self, path: &Path, written: Written) {
        let has_error = !self.shows_document();
        let (Some(editor), Some(opened)) = (&mut self.editor, &mut self.session.opened) else { return };
        editor.document.note_written(written);
        self.dialogs.conflict = None;
        if opened.path.as_deref() != Some(path) {
            let name = catalogue::name(&editor.document.description().title, path);
            opened.name = catalogue::remember(&mut self.catalogue, &name, path);
            opened.path = Some(path.to_owned());
            self.window.forget_last_saved();
            self.preferences.change(|saved| recent::note(&mut saved.recent, path));
        }
        let left_out = if self.session.view_differs() { ". The view is not the scene's camera, and is not saved." } else { "" };
        let error = if has_error { ". The scene has an error: the file cannot be opened until it is fixed." } else { "" };
        self.tell(format!("Saved {}{error}{left_out}", path.display()), has_error);
    }
}
