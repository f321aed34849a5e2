//! Scene files that a text editor or another program changed.
use super::{Document, Edit, History, content::Content, document::read, tree::Tree};
use noisefall_base::declare::Problem;
use noisefall_scene::scene::{SceneError, description::SceneDescription};

/// The changes that another program wrote to the file of a document.
#[derive(Debug)]
pub struct Outside {
    content: Content,
    /// Whether the file has another camera than before.
    pub camera_changed: bool,
    /// Whether the file has other settings than before.
    pub settings_changed: bool,
    /// Whether anything else differs except comments and formatting.
    pub scene_changed: bool,
    /// Whether only comments and formatting differ. Then reloading is no step: undo and redo keep them.
    pub is_format: bool,
    /// Whether the document has unsaved changes too, which reloading would lose: the user has to choose.
    pub conflicts: bool,
}

impl Outside {
    /// The text of the file.
    pub fn text(&self) -> &str {
        &self.content.base.text
    }
}

impl Document {
    /// Compares a text that the file has now with the one it had. `None` if it is the same; an error if it cannot be read, and the
    /// document stays as it is.
    pub fn compare_outside(&self, text: &str) -> Result<Option<Outside>, SceneError> {
        if text == self.on_disk() {
            return Ok(None);
        }
        let name = self.path().map_or_else(String::new, |path| path.display().to_string());
        let mut content = read(&name, text)?;
        // An earlier text that cannot be read counts as different in every part.
        let before = read(&name, self.on_disk()).map(|before| before.description).unwrap_or_default();
        let [was, now] = [&before, &content.description];
        let camera_changed = was.camera != now.camera;
        let settings_changed = was.render != now.render;
        let scene_changed = *was != SceneDescription { camera: was.camera.clone(), render: was.render.clone(), ..now.clone() };
        let is_rewritten = camera_changed || settings_changed || scene_changed;
        let is_format = !is_rewritten && self.content.base.is(&before);
        if is_format {
            // Only comments and formatting differ: the document keeps its changes, in the new text.
            content.description = self.content.description.clone();
            content.origins = self.content.origins.clone();
        }
        let is_ours = Tree::of(&mut content.description.clone()).is_identical(&Tree::of(&mut self.content.description.clone()));
        let conflicts = self.has_changes() && !is_ours;
        Ok(Some(Outside { content, camera_changed, settings_changed, scene_changed, is_format, conflicts }))
    }

    /// Reloads the file, as a step that can be undone. Comments and formatting alone are no step.
    pub fn take_outside(&mut self, history: &mut History, outside: Outside) -> Result<(), Problem> {
        let text = outside.text().to_owned();
        if outside.is_format {
            // Every version has the new text, with its own values in it.
            self.content.base = outside.content.base;
            self.has_text(text);
            return Ok(());
        }
        let is_saved = outside.content.base.is(&outside.content.description);
        history.apply(self, &Edit::Reload(Box::new(outside.content)))?;
        if is_saved {
            self.saved(text);
        } else {
            self.differs_from(text);
        }
        Ok(())
    }

    /// Keeps the document although the file has another text now. Saving will replace it.
    pub fn keep_own(&mut self, on_disk: impl Into<String>) {
        self.differs_from(on_disk.into());
    }
}
