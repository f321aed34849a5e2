//! Compiles an edited scene exactly, off the UI thread, when the drag ends.
use std::{path::PathBuf, sync::Arc};

use noisefall_base::declare::Precision;
use noisefall_scene::scene::{Scene, description::SceneDescription};

use super::background_task::BackgroundTask;

/// A scene after an edit.
#[derive(Clone)]
pub struct EditedScene {
    pub scene: Arc<Scene>,
    pub description: Arc<SceneDescription>,
    /// Folder of its relative file paths.
    pub folder: PathBuf,
}

/// An exact scene, and its warnings.
pub struct SettledScene {
    pub scene: Arc<Scene>,
    pub warnings: Vec<String>,
}

pub struct ExactCompile {
    ctx: egui::Context,
    /// The last edit, until its work is started.
    edited: Option<EditedScene>,
    pending: Option<BackgroundTask<SettledScene>>,
}

impl ExactCompile {
    pub fn new(ctx: &egui::Context) -> ExactCompile {
        ExactCompile { ctx: ctx.clone(), edited: None, pending: None }
    }

    /// The latest edit. Results for earlier ones are dropped.
    pub fn note(&mut self, edited: EditedScene) {
        (self.edited, self.pending) = (Some(edited), None);
    }

    /// Forgets the scene.
    pub fn forget(&mut self) {
        (self.edited, self.pending) = (None, None);
    }

    /// Starts the work for the latest edit, if it has not started.
    pub fn start(&mut self) {
        if let Some(edited) = self.edited.take() {
            self.pending = Some(BackgroundTask::start(&self.ctx, |_| settled(edited)));
        }
    }

    /// The settled scene, once.
    pub fn take(&mut self) -> Option<SettledScene> {
        BackgroundTask::take(&mut self.pending)?.ok()
    }
}

fn settled(edited: EditedScene) -> SettledScene {
    let EditedScene { scene, description, folder } = edited;
    // If files vanish in the meantime, the scene stays as it is.
    let exact = (!scene.is_exact()).then(|| description.rebuild(&folder, &scene, Precision::Exact).ok()).flatten();
    let scene = exact.map_or(scene, Arc::new);
    SettledScene { warnings: scene.warnings().to_vec(), scene }
}

#[cfg(test)]
mod tests {
    use std::{
        path::Path,
        time::{Duration, Instant},
    };

    use noisefall_scene::shape::{Transform, mesh::Mesh};

    use super::*;

    fn wait(exact_compile: &mut ExactCompile) -> SettledScene {
        let start = Instant::now();
        loop {
            if let Some(settled) = exact_compile.take() {
                return settled;
            }
            assert!(start.elapsed() < Duration::from_secs(60), "it never came");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn a_moved_mesh_gets_its_own_tree_when_the_drag_ends() {
        let mut description = SceneDescription::default();
        description.add_object("knot", Mesh::default());
        let before = description.build(Path::new("")).expect("it is a scene");
        description.objects[0].transform.push(Transform::Translate(glam::DVec3::X));
        let description = Arc::new(description);
        let moved = description.rebuild(Path::new(""), &before, Precision::Interactive).expect("it is a scene");
        assert!(!moved.is_exact());
        let edited = EditedScene { scene: Arc::new(moved), description, folder: PathBuf::new() };
        let mut exact_compile = ExactCompile::new(&egui::Context::default());
        exact_compile.note(edited.clone());
        assert!(exact_compile.take().is_none(), "it waits for the end of the drag");
        exact_compile.start();
        let settled = wait(&mut exact_compile);
        assert!(settled.scene.is_exact() && !settled.warnings.is_empty());
        exact_compile.note(edited);
        exact_compile.start();
        exact_compile.forget();
        assert!(exact_compile.take().is_none());
    }
}
