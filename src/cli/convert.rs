//! `noisefall convert`: writes a scene of any format as a scene file of Noisefall, of Mitsuba, or as glTF.
use std::{
    path::{Path, PathBuf},
    process::ExitCode,
    sync::Arc,
};

use noisefall_formats::{
    export::{self, ExportSource, Exported},
    import::Opened,
};
use noisefall_scene::scene::describe;

use super::{
    messages::{Failure, print, wrong_usage},
    scene_file::SceneOptions,
};

const NOTES: &str = "\
Meshes and textures go to the folder OUT.files beside the scene file, or into OUT.glb. Files that lie in the folder of the scene \
file stay where they are. Existing files of the same names are replaced. Warnings list the parts of the scene that \
the format cannot express, and their substitutes. A .toml that becomes a .toml keeps its comments, and gets the current names of keys \
that had other names before version 0.1.

Examples:
  noisefall convert room.gltf -o room.toml
  noisefall convert room.toml -o room.xml
  noisefall convert room.toml -o room.glb";

#[derive(clap::Args)]
#[command(after_help = NOTES)]
pub struct Arguments {
    /// Scene file: .toml, .gltf, .glb, .xml (Mitsuba), .pbrt, .obj, .ply, .stl, or an image that carries its scene
    scene: PathBuf,
    /// Scene file to write: .toml, .xml (Mitsuba), .gltf or .glb
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    options: SceneOptions,
}

pub fn run(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let Arguments { scene: path, output, options } = arguments;
    if let Err(unknown) = export::check(output) {
        return Ok(wrong_usage(&unknown.to_string()));
    }
    if is_same(path, output) {
        return Ok(wrong_usage(&format!("{}: the converted scene would replace the scene itself", output.display())));
    }
    let Opened { scene, description, .. } = options.open_rewritten(path)?;
    let text = description.is_none().then(|| scene.source.clone());
    let of_text = || describe(&path.display().to_string(), scene.source.clone()).map(Arc::new);
    let description = description.map_or_else(of_text, Ok).map_err(|error| error.report())?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let source = ExportSource {
        description: &description,
        assets: &scene.assets,
        folder,
        allow_outside: options.allow_outside,
        text: text.as_deref(),
    };
    let prepared = export::prepare(source, output).map_err(|error| error.to_string())?;
    options.report(output, &prepared.remarks, "written exactly")?;
    let exported = prepared.write().map_err(|error| error.to_string())?;
    print(&format!("{}: {}", output.display(), outcome(&exported, description.objects.len())))?;
    Ok(ExitCode::SUCCESS)
}

fn is_same(a: &Path, b: &Path) -> bool {
    a.canonicalize().ok().zip(b.canonicalize().ok()).is_some_and(|(a, b)| a == b)
}

/// Describes the result, as in `12 objects; 3 files written and 2 copied to room.files`.
fn outcome(exported: &Exported, objects: usize) -> String {
    let objects = if objects == 1 { "1 object".to_owned() } else { format!("{objects} objects") };
    let Exported { folder: Some(folder), written, copied, .. } = exported else { return objects };
    let files = |count: usize| if count == 1 { "1 file".to_owned() } else { format!("{count} files") };
    let what = match (written, copied) {
        (written, 0) => format!("{} written to", files(*written)),
        (0, copied) => format!("{} copied to", files(*copied)),
        (written, copied) => format!("{} written and {copied} copied to", files(*written)),
    };
    format!("{objects}; {what} {}", folder.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outcome_counts_files() {
        let of = |written, copied| {
            let folder = (written + copied > 0).then(|| PathBuf::from("a.files"));
            outcome(&Exported { folder, written, copied }, 2)
        };
        assert_eq!(of(0, 0), "2 objects");
        assert_eq!(of(3, 0), "2 objects; 3 files written to a.files");
        assert_eq!(of(0, 1), "2 objects; 1 file copied to a.files");
        assert_eq!(of(1, 2), "2 objects; 1 file written and 2 copied to a.files");
    }
}
