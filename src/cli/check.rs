//! `noisefall check`: reads and compiles scene files. A scene with a `[reference]` is also rendered as a small image and compared
//! with it.
use std::path::PathBuf;

use noisefall_base::math::SimdLevel;
use noisefall_formats::import::Opened;
use noisefall_render::render::{reference, threads::Threads};

use super::{
    messages::{Failure, print},
    scene_file::SceneOptions,
};

#[derive(clap::Args)]
pub struct Arguments {
    /// Scene files: .toml, .gltf, .glb, .xml (Mitsuba), .pbrt, .obj, .ply or .stl
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    options: SceneOptions,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut reports = Vec::new();
    for path in &arguments.scenes {
        match arguments.options.open(path) {
            Err(report) => reports.push(report),
            Ok(Opened { scene, .. }) => {
                let [width, height] = scene.camera.resolution;
                let objects = match scene.objects.len() {
                    1 => "1 object".to_owned(),
                    n => format!("{n} objects"),
                };
                print(&format!("{}: ok, {objects}, {width} × {height}", path.display()))?;
                let threads = Threads::new(0, SimdLevel::best()).map_err(|error| error.to_string())?;
                for warning in scene.warnings().iter().chain(&reference::contradiction(&scene, &threads)) {
                    print(&format!("{}: warning: {warning}", path.display()))?;
                }
            }
        }
    }
    if reports.is_empty() { Ok(()) } else { Err(reports.join("\n\n")) }
}
