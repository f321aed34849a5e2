//! Scenes of other programs.
//!
//! A reader translates a file into a [`SceneDescription`], as if it had been written by hand: everything else, the window and the
//! command line included, works with the description. What cannot be translated exactly is listed as a [`Remark`].
pub mod absorbing;
mod budget;
pub mod gltf;
pub mod lighting;
mod memory;
pub mod mesh;
mod missing;
pub mod mitsuba;
pub mod names;
mod new_files;
mod open;
pub mod paths;
pub mod pbrt;
pub mod pictures;
mod reach;
mod remark;
pub mod remarks;
pub mod spectrum;
mod spelling;
pub mod studio;
mod tube;
mod unit;
mod uv_maps;

use std::path::Path;

pub use self::{
    missing::{Missing, Unresolved},
    names::Names,
    new_files::NewFiles,
    open::{Opened, load, open},
    paths::Folder,
    reach::refusal,
    remark::Remark,
    remarks::Remarks,
};
use noisefall_base::{declare::Assets, progress::Progress};
use noisefall_scene::scene::{SceneError, description::SceneDescription};

/// A scene of another program.
#[derive(Default)]
pub struct Imported {
    /// The scene. Paths of files on disk are relative to the folder of the file that was read, or absolute.
    pub description: SceneDescription,
    /// Meshes and images that exist in memory only: [`noisefall_scene::model::Model`] by paths such as `meshes/chair.ply`, and encoded image
    /// files, as `Vec<u8>`, by paths such as `textures/wood.png`.
    pub assets: Assets,
    /// Remarks on parts that were not imported exactly.
    pub remarks: Remarks,
}

/// Choices of the user about a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportOptions {
    /// Values of parameters, such as `-D spp=16` for Mitsuba's `$spp`.
    pub defines: Vec<(String, String)>,
    /// Time of animations, seconds; the pose that the file states without them if `None`.
    pub time: Option<f64>,
    /// Name of the variant of materials.
    pub variant: Option<String>,
    /// Whether files outside the folder of the scene may be read.
    pub allow_outside: bool,
    /// Whether former names in a scene file of Noisefall are rewritten before it is read.
    pub rewrites: bool,
    /// Size of the image that is rendered, pixels. A perspective camera of glTF keeps its angle across the height at any size.
    pub size: Option<[u32; 2]>,
    /// Shows how far the reader is, and cancels it.
    pub progress: Progress,
}

/// Whether a file is a scene of another program, by its name.
pub fn is_foreign(path: &Path) -> bool {
    reader(path).is_some()
}

/// Reads a scene of another program.
pub fn read(path: &Path, options: &ImportOptions) -> Result<Imported, SceneError> {
    match reader(path) {
        Some(read) => {
            let folder = Folder::new(path, options);
            let mut imported = folder.missing.finish(read(path, options, &folder))?;
            imported.assets.set_sources(folder.found());
            memory::reserve_kept(&mut imported.assets, &imported.description)
                .map_err(|error| SceneError::of_file(path, error.to_string(), "raise the memory limit"))?;
            Ok(imported)
        }
        None => Err(SceneError::of_file(
            path,
            "the format is not known",
            "scenes end in .toml, .gltf, .glb, .xml, .pbrt, .obj, .ply or .stl",
        )),
    }
}

/// Reads a file, and those of its folder that it names.
type ImportReader = fn(&Path, &ImportOptions, &Folder) -> Result<Imported, SceneError>;

fn reader(path: &Path) -> Option<ImportReader> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    Some(match extension.as_str() {
        "gltf" | "glb" => gltf::read,
        "xml" => mitsuba::read,
        "pbrt" => pbrt::read,
        "obj" | "ply" | "stl" => mesh::read,
        _ => return None,
    })
}
