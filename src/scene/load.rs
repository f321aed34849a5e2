//! Reading a scene file.
use std::{io::Read, path::Path};

use super::{
    Scene,
    carried::load_carried,
    diagnostic::{SceneError, SourceText},
    locate::locate,
    read::read as read_description,
    syntax::{Slips, slips},
    wording::in_plain_words,
};
use crate::{
    file::open_regular,
    image::looks_like,
    memory::{Size, reserve},
};
use crate::{file::open_regular, image::looks_like};

/// Larger files are refused before they are read.
const LARGEST_FILE: u64 = 64 << 20;

/// Reads and compiles a scene file, or the scene that a picture carries.
pub fn load(path: &Path) -> Result<Scene, SceneError> {
    if let Some(carried) = load_carried(path) {
        return carried;
    }
    let bytes = read(path)?;
    if let Some(kind) = not_text(&bytes) {
        let message = format!("this is not a text file{kind}");
        return Err(SceneError::of_file(
            path,
            message,
            "a scene is one TOML file, saved as UTF-8 text, or a PNG or EXR that Noisefall has written with its scene",
        ));
    }
    let name = path.display().to_string();
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(&error.into_bytes()).into_owned();
        let source = SourceText { name: name.clone(), text };
        source.error(valid..valid + 1, "the file is not UTF-8 text", "this byte is not UTF-8").with_help("save the file as UTF-8")
    })?;
    parse(&name, text)
}

/// Compiles the text of a scene file; `name` is what errors call it, and paths in the file are relative to its folder.
pub fn parse(name: &str, text: String) -> Result<Scene, SceneError> {
    let source = SourceText { name: name.to_owned(), text };
    let (description, damage, mut errors) = understood(&source)?;
    let _described = reserve("the values of the file", DESCRIBED * source.text.len() as u64)
        .map_err(|error| SceneError::of_file(Path::new(name), error.to_string(), "give more memory"))?;
    let folder = Path::new(name).parent().unwrap_or(Path::new(""));
    match compile(&description, &source.text, folder, &damage) {
        Ok(scene) if errors.is_empty() => return Ok(scene),
        Ok(_) => {}
        Err(problems) => errors.extend(locate(problems, &source)),
    }
    let nothing = || SceneError::of_file(Path::new(name), "this is no scene", "a scene is one TOML file");
    Err(SceneError::of_all(errors).unwrap_or_else(nothing))
}

/// Reads the description of the text of a scene file, without the files that it names.
pub fn describe(name: &str, text: String) -> Result<SceneDescription, SceneError> {
    let source = SourceText { name: name.to_owned(), text };
    let (description, _, errors) = understood(&source)?;
    SceneError::of_all(errors).map_or(Ok(description), Err)
}

/// What a text says: all of it that can be understood, what was left out, and why.
fn understood(source: &SourceText) -> Result<(SceneDescription, Damage, Vec<SceneError>), SceneError> {
    let bytes = (PARSING + KEPT) * source.text.len() as u64;
    let _parsing = reserve(format_args!("{} of text", Size(source.text.len() as u64)), bytes).map_err(|error| {
        let help = "keep large meshes in files of their own, as OBJ or PLY";
        SceneError::of_file(Path::new(&source.name), error.to_string(), help)
    })?;
    let table = DeTable::parse(&source.text).map_err(|first| not_toml(source, &first))?;
    if table.get_ref().is_empty() {
        return Err(source.error(0..0, "the file is empty; a scene begins with `format = 1`", "nothing is said"));
    }
    check_format(source, table.get_ref())?;
    let mut description = SceneDescription::default();
    let (damage, errors) = read_description(&mut description, &table, source);
    Ok((description, damage, errors))
}

/// All errors of a text that is not TOML: what can be told from the text itself, and what the reader says of other lines; `first` is what it
/// says first.
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

/// A file of another version is told so, whatever else it says.
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

/// What the file looks like, as the end of a sentence, if it is no text at all: then none of it can be shown.
fn not_text(bytes: &[u8]) -> Option<String> {
    let start = &bytes[..bytes.len().min(4096)];
    let is_control = |byte: &u8| *byte < 0x20 && !b"\t\n\r\x0c".contains(byte);
    match looks_like(start) {
        Some(kind) => Some(format!(": it looks like {kind}")),
        None if start.starts_with(b"\xff\xfe") || start.starts_with(b"\xfe\xff") => {
            Some(" of the kind that is read here: it looks like UTF-16".to_owned())
        }
        None => start.iter().any(is_control).then(String::new),
    }
}

fn read(path: &Path) -> Result<Vec<u8>, SceneError> {
    let unreadable = |error: std::io::Error| {
        let help = match error.kind() {
            std::io::ErrorKind::NotFound => "check the path; scenes that come with Noisefall are in `scenes/`",
            std::io::ErrorKind::PermissionDenied => "check the permissions of the file",
            _ => "a scene is one TOML file",
        };
        let reason = match error.kind() {
            std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
            _ => format!("cannot be read: {error}"),
        };
        SceneError::of_file(path, reason, help)
    };
    let file = open_regular(path).map_err(unreadable)?;
    let mut bytes = Vec::new();
    // Reading stops past the limit whatever size the file claims: it may grow meanwhile.
    file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_FILE {
        let message = format!("the file is larger than {} MB", LARGEST_FILE >> 20);
        return Err(SceneError::of_file(path, message, "a scene file is short text; keep large data in files of their own"));
    }
    Ok(bytes)
}
