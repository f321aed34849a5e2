//! Files that a reader makes in memory.
use super::Names;
use noisefall_base::declare::Assets;
use noisefall_scene::model::Model;

/// Files that a reader makes in memory, each under a path of its own.
#[derive(Default)]
pub struct NewFiles {
    /// The files.
    pub assets: Assets,
    names: Names,
}

impl NewFiles {
    /// Adds a mesh, and returns its path.
    pub fn add_model(&mut self, name: &str, model: Model) -> String {
        let path = format!("meshes/{}.ply", self.names.unique(name, "mesh"));
        self.assets.insert(path.clone(), model);
        path
    }

    /// Adds an encoded image, and returns its path. `extension` is that of its format.
    pub fn add_image(&mut self, name: &str, extension: &str, bytes: Vec<u8>) -> String {
        let path = format!("textures/{}.{extension}", self.names.unique(name, "image"));
        self.assets.insert(path.clone(), bytes);
        path
    }
}
