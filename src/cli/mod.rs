//! The command line. Exit status: 0 done, 1 failed with a message on standard error, 2 wrong usage, 130 interrupted.
#[cfg(feature = "reports")]
mod bench;
mod check;
mod checkpointing;
mod compare;
mod completions;
mod convert;
#[cfg(feature = "reports")]
mod evidence;
mod figures;
mod flip;
mod folder;
mod frame_checkpoints;
mod headings;
mod layers;
#[cfg(feature = "reports")]
mod lists;
mod live;
mod loaded_image;
mod loading;
mod man;
mod meant;
mod merge;
mod messages;
mod options;
mod output;
mod progress;
mod render;
mod render_memory;
mod replay;
mod samples;
mod scene_file;
mod scenes;
mod sequence;
mod settings;
#[cfg(feature = "reports")]
mod sheet;
mod shot;
mod split_image;
mod stop;
#[cfg(feature = "reports")]
mod study;
mod summary;
#[cfg(feature = "reports")]
mod triangle;
mod unused;
#[cfg(feature = "reports")]
mod validate;
mod watched_files;

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
    process::ExitCode,
};

use clap::{CommandFactory, Parser, Subcommand};
use noisefall_base::declare::nearest;
use noisefall_scene::scene::{ShippedScene, description::SceneDescription};

pub use self::messages::Failure;
use self::{
    messages::{print, tell, wrong_usage},
    scene_file::SceneOptions,
};

/// Interactive progressive path tracer.
///
/// Without a command, opens the window on SCENE, or on the built-in scene.
#[derive(Parser)]
#[command(name = "noisefall", version, args_conflicts_with_subcommands = true)]
struct Arguments {
    /// Scene file to open in the window: .toml, .gltf, .glb, .xml (Mitsuba), .pbrt, .obj, .ply or .stl; or the name of a scene
    /// that `noisefall scenes` lists
    scene: Option<PathBuf>,
    #[command(flatten)]
    options: SceneOptions,
    /// Memory limit for scenes and images, such as 4G or 500M [default: half of the machine's memory]
    #[arg(long, value_name = "SIZE", global = true, value_parser = options::memory)]
    memory: Option<u64>,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    /// Render a scene to a PNG or EXR file, without a window
    Render(Box<render::Arguments>),
    /// Merge partial renders into one bit-identical image
    Merge(merge::Arguments),
    /// Measure the error of image A against reference B
    Compare(compare::Arguments),
    /// Compare the renderer with exact solutions and write a report
    #[cfg(feature = "reports")]
    Validate(validate::Arguments),
    /// Find the settings that reach an error in the least time, and write a report
    #[cfg(feature = "reports")]
    Study(study::Arguments),
    /// Collect images, convergence, bias and equal-time comparisons of a scene for a report
    #[cfg(feature = "reports")]
    Evidence(evidence::Arguments),
    /// Render images with several settings onto one labelled sheet
    #[cfg(feature = "reports")]
    Sheet(sheet::Arguments),
    /// Measure where the time of a render goes, by stage and bounce
    #[cfg(feature = "reports")]
    Bench(bench::Arguments),
    /// Report errors and likely mistakes in scene files
    Check(check::Arguments),
    /// Convert a scene to a scene file of Noisefall, to XML of Mitsuba 3, or to glTF, with its meshes and textures
    Convert(convert::Arguments),
    /// Print the JSON Schema of scene files, for editors
    Schema,
    /// List the scenes that come with the program, or write their files
    Scenes(scenes::Arguments),
    /// Write manual pages of the program and its commands
    Man(man::Arguments),
    /// Print a script that completes commands and options in a shell
    Completions(completions::Arguments),
}

pub fn run() -> ExitCode {
    stop::survive_size_limits();
    if let Some(mistake) = mistaken_command(&std::env::args_os().skip(1).collect::<Vec<_>>()) {
        return wrong_usage(&mistake);
    }
    let arguments = Arguments::try_parse().unwrap_or_else(|error| meant::with_advice(error, &Arguments::command()).exit());
    arguments.memory.into_iter().for_each(noisefall_base::memory::set_limit);
    let succeeded = |()| ExitCode::SUCCESS;
    let done = match arguments.command {
        None => window(arguments.scene, &arguments.options).map(succeeded),
        Some(Command::Render(arguments)) => render::run(&arguments),
        Some(Command::Merge(arguments)) => merge::run(&arguments),
        Some(Command::Compare(arguments)) => compare::run(&arguments),
        Some(Command::Convert(arguments)) => convert::run(&arguments),
        Some(Command::Check(arguments)) => check::run(&arguments).map(succeeded),
        #[cfg(feature = "reports")]
        Some(Command::Validate(arguments)) => validate::run(&arguments).map(succeeded),
        #[cfg(feature = "reports")]
        Some(Command::Study(arguments)) => study::run(&arguments),
        #[cfg(feature = "reports")]
        Some(Command::Evidence(arguments)) => evidence::run(&arguments),
        #[cfg(feature = "reports")]
        Some(Command::Sheet(arguments)) => sheet::run(&arguments),
        #[cfg(feature = "reports")]
        Some(Command::Bench(arguments)) => bench::run(&arguments),
        Some(Command::Schema) => schema().map(succeeded),
        Some(Command::Scenes(arguments)) => scenes::run(&arguments).map(succeeded),
        Some(Command::Man(arguments)) => man::run(&arguments, Arguments::command()).map(succeeded),
        Some(Command::Completions(arguments)) => completions::run(&arguments, Arguments::command()).map(succeeded),
    };
    done.unwrap_or_else(|message| {
        tell(&message);
        ExitCode::FAILURE
    })
}

/// Prints the JSON Schema, which is generated from the declarations of the scene format.
fn schema() -> Result<(), Failure> {
    let schema = noisefall_base::declare::schema("Noisefall scene", &mut SceneDescription::default());
    print(&format!("{schema:#}"))
}

/// Error message if the first argument looks like a mistyped command.
fn mistaken_command(arguments: &[OsString]) -> Option<String> {
    let word = arguments.first()?.to_str()?;
    let commands = Arguments::command();
    let names: Vec<_> = commands.get_subcommands().map(clap::Command::get_name).chain(["help"]).collect();
    let path = Path::new(word);
    let is_path = word.starts_with('-') || word.contains(['.', '/', '\\']) || path.exists() || ShippedScene::of(path).is_some();
    if is_path || names.contains(&word) {
        return None;
    }
    let meant = nearest(word, names.iter().copied());
    let advice = meant.map(|meant| format!("did you mean `{meant}`?"));
    // A single word that resembles no command is more likely a scene file that does not exist.
    let advice = advice.or_else(|| (arguments.len() > 1).then(|| "`noisefall --help` lists them".to_owned()))?;
    Some(format!("there is no command `{word}`; {advice}"))
}

/// Opens the window. If that fails, errors of the scene are reported as well.
fn window(scene: Option<PathBuf>, options: &SceneOptions) -> Result<(), Failure> {
    open_window(scene.clone(), options).map_err(|no_window| match scene.and_then(|path| options.open(&path).err()) {
        Some(bad_scene) => format!("{bad_scene}\n\n{no_window}"),
        None => no_window,
    })
}

#[cfg(feature = "viewer")]
fn open_window(scene: Option<PathBuf>, options: &SceneOptions) -> Result<(), Failure> {
    let (options, strict) = (options.import_options(None), options.strict);
    crate::viewer::run(crate::viewer::GivenScene { path: scene, options, strict })
}

#[cfg(not(feature = "viewer"))]
fn open_window(_: Option<PathBuf>, _: &SceneOptions) -> Result<(), Failure> {
    Err("this build has no window (feature `viewer` is off); use `noisefall render SCENE -o image.png`".to_owned())
}
