//! Files that an export makes: meshes and images.
use crate::import::Names;
use noisefall_base::declare::Assets;

/// No file that a scene names lies here.
const FOLDER: &str = "new files";

/// The files of a scene in memory, and those that the export makes besides.
pub struct NewAssets {
    /// All of them.
    pub assets: Assets,
    names: Names,
    /// The paths of all files that the exported scene names.
    pub named: Vec<String>,
}

impl NewAssets {
    /// Starts with the files of the scene.
    pub fn new(assets: &Assets) -> NewAssets {
        NewAssets { assets: assets.clone(), names: Names::default(), named: Vec::new() }
    }

    /// Adds a file to a folder, and returns its path. `extension` has no dot.
    pub fn add<T: Send + Sync + 'static>(&mut self, folder: &str, name: &str, extension: &str, content: T) -> String {
        // Names of scenes are no paths.
        let name: String = name.chars().map(|c| if "/\\.$".contains(c) { '_' } else { c }).collect();
        let path = format!("{FOLDER}/{folder}/{}.{extension}", self.names.unique(&name, "unnamed"));
        self.assets.insert(path.clone(), content);
        self.named.push(path.clone());
        path
    }

    /// Names a file of the scene.
    pub fn name(&mut self, path: &str) -> String {
        self.named.push(path.to_owned());
        path.to_owned()
    }
}
