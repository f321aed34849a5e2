//! Scenes of pbrt-v4.
//!
//! A text is split into tokens (`tokens.rs`) and parameters (`parameter_lists.rs`). Directives change the graphics state (`state.rs`) or
//! add to the description. Materials and textures are translated when a shape first uses them.
//!
//! pbrt's world is left-handed, in that its camera sees +x at the right when it looks along +z with +y up: see `camera.rs`.
mod assemble;
mod camera;
mod colour_spaces;
mod directives;
mod import;
mod lights;
mod materials;
mod media;
mod moving;
mod named_spectra;
mod options;
mod parameter_lists;
mod parameters;
mod reading;
mod records;
mod settings;
mod shapes;
mod source;
mod spectra;
mod state;
mod surfaces;
#[cfg(test)]
mod tests;
mod textures;
mod tokens;
mod transforms;

use std::path::Path;

use self::{directives::Interpreter, import::Import, tokens::Tokens};
use super::{
    Folder, ImportOptions, Imported,
    lighting::{self, Sizes},
};
use noisefall_scene::scene::SceneError;

/// Reads the file and all that it includes.
pub fn read(path: &Path, _: &ImportOptions, folder: &Folder) -> Result<Imported, SceneError> {
    let mut import = Import::new(folder.clone());
    let help = "a scene of pbrt-v4 is a text file; packed ones end in .pbrt.gz";
    let source = import.files.text(path).map_err(|message| SceneError::of_file(path, message, help))?;
    let known = folder.resolved(path);
    let mut import = Interpreter::new(import).run(Tokens::new(source), known)?;
    import.assemble()?;
    let mut to = import.finish();
    let (sizes, place) = (Sizes::unknown(&to), path.file_name().unwrap_or_default().to_string_lossy());
    lighting::complete(&mut to, folder, &sizes, &place);
    Ok(to)
}
