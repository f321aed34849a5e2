//! Compiles the text of a scene file.
use std::path::Path;

use toml::de::DeTable;

use super::{
    Scene, SceneText,
    compile::{Files, compile},
    damage::Damage,
    description::{FORMAT, SceneDescription},
    diagnostic::{SceneError, SourceText},
    locate::locate,
    nesting::too_deep,
    read::read as read_description,
    renamed,
    syntax::{Slips, slips},
    wording::in_plain_words,
};
use noisefall_base::{
    declare::Assets,
    memory::{Size, reserve},
    progress::Progress,
};

/// For longer texts with syntax errors only the first one is reported.
const LONGEST_SCANNED: usize = 1 << 18;

/// Bytes of memory per byte of text: the TOML while it is parsed, the description, and the text itself.
const PARSING: u64 = 115;

const DESCRIBED: u64 = 24;

const KEPT: u64 = 2;

/// The scene that the window opens by default; also `scenes/cornell_spheres.toml`.
pub const BUILT_IN: &str = include_str!(concat!(env!("NOISEFALL_SCENES"), "/cornell_spheres.toml"));

/// The default scene, a Cornell box of spheres.
pub fn built_in() -> Scene {
    parse("cornell_spheres.toml", BUILT_IN.to_owned()).expect("the built-in scene is valid: a test compiles it")
}

/// Compiles the text of a scene file. `name` is its name in errors; paths in the file are relative to the folder of `name`.
pub fn parse(name: &str, text: String) -> Result<Scene, SceneError> {
    parse_watched(name, text, &Progress::default())
}

/// Compiles the text of a scene file, with progress and cancellation.
pub fn parse_watched(name: &str, text: String, progress: &Progress) -> Result<Scene, SceneError> {
    parse_with_assets(name, text, Assets::default(), progress)
}

/// Compiles the text of a scene file, with files in memory.
pub fn parse_with_assets(name: &str, text: String, assets: Assets, progress: &Progress) -> Result<Scene, SceneError> {
    let source = SourceText { name: name.to_owned(), text };
    let Understood { description, damage, mut errors, former_names } = understood(&source)?;
    let nothing = || SceneError::of_file(Path::new(name), "this is not a scene", "a scene is one TOML file");
    let _described = reserve("the values of the file", DESCRIBED * source.text.len() as u64)
        .map_err(|error| SceneError::of_file(Path::new(name), error.to_string(), "raise the memory limit"))?;
    if errors.len() >= SceneError::MOST {
        return Err(SceneError::of_all(errors).unwrap_or_else(nothing));
    }
    let folder = Path::new(name).parent().unwrap_or(Path::new(""));
    let files = Files { folder, assets, progress: progress.clone() };
    let text = source.text.clone();
    match compile(&description, SceneText::new(Box::new(move || text)), files, &damage, None) {
        Ok(scene) if errors.is_empty() => return Ok(Scene { former_names, ..scene }),
        Ok(_) => {}
        Err(problems) => errors.extend(locate(problems, &source)),
    }
    Err(SceneError::of_all(errors).unwrap_or_else(nothing))
}

/// Reads the description of the text of a scene file, without the files that it names.
pub fn describe(name: &str, text: String) -> Result<SceneDescription, SceneError> {
    let source = SourceText { name: name.to_owned(), text };
    let Understood { description, errors, .. } = understood(&source)?;
    SceneError::of_all(errors).map_or(Ok(description), Err)
}

/// The content of a scene file.
struct Understood {
    description: SceneDescription,
    /// The incomplete tables.
    damage: Damage,
    errors: Vec<SceneError>,
    /// Warnings about former names.
    former_names: Vec<String>,
}

fn understood(source: &SourceText) -> Result<Understood, SceneError> {
    let bytes = (PARSING + KEPT) * source.text.len() as u64;
    let _parsing = reserve(format_args!("{} of text", Size(source.text.len() as u64)), bytes).map_err(|error| {
        let help = "keep large meshes in files of their own, as OBJ or PLY";
        SceneError::of_file(Path::new(&source.name), error.to_string(), help)
    })?;
    check_nesting(source)?;
    let table = DeTable::parse(&source.text).map_err(|first| not_toml(source, &first))?;
    if table.get_ref().is_empty() {
        return Err(source.error(0..0, "the file is empty; a scene begins with `format = 1`", "expected `format = 1`"));
    }
    check_format(source, table.get_ref())?;
    let mut description = SceneDescription::default();
    let (damage, errors) = read_description(&mut description, &table, source);
    Ok(Understood { description, damage, errors, former_names: renamed::warnings(table.get_ref()) })
}

/// Refuses brackets that nest too deeply to be parsed.
pub(super) fn check_nesting(source: &SourceText) -> Result<(), SceneError> {
    let refuse = |place| source.error(place, "too many brackets are open", "close the brackets before this one");
    too_deep(&source.text).map_or(Ok(()), |place| Err(refuse(place)))
}

/// All syntax errors of a text: those found in the text itself, and those of the TOML parser on other lines. `first` is the first
/// error of the parser.
fn not_toml(source: &SourceText, first: &toml::de::Error) -> SceneError {
    if source.text.len() > LONGEST_SCANNED {
        return in_plain_words(source, first);
    }
    let Slips { errors: mut all, unbalanced } = slips(source);
    if !unbalanced {
        for error in DeTable::parse_recoverable(&source.text).1.into_iter().take(SceneError::MOST) {
            let error = in_plain_words(source, &error);
            let line = |error: &SceneError| error.line_column().map(|place| place.0);
            if all.iter().all(|known| line(known) != line(&error)) {
                all.push(error);
            }
        }
    }
    SceneError::of_all(all).unwrap_or_else(|| in_plain_words(source, first))
}

/// The error for a file of another version, which takes precedence over all other errors.
fn check_format(source: &SourceText, table: &DeTable) -> Result<(), SceneError> {
    let Some((_, value)) = table.iter().find(|(key, _)| key.get_ref() == "format") else { return Ok(()) };
    let format = value.get_ref().as_integer().and_then(|format| i64::from_str_radix(format.as_str(), format.radix()).ok());
    match format {
        Some(format) if format != i64::from(FORMAT) => {
            let message = format!("this is scene format {format}, and Noisefall reads format {FORMAT}");
            Err(source.error(value.span(), message, format!("expected {FORMAT}")))
        }
        _ => Ok(()),
    }
}
