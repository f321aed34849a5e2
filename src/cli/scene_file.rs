//! Scene arguments: files of any format, and the options of those of other programs.
use std::path::Path;

use noisefall_base::quote;
use noisefall_formats::import::{self, ImportOptions, Opened, Remarks, is_foreign};

use super::{
    loading::with_bar,
    messages::{Failure, tell},
};

/// Largest number of remarks that are printed.
const MOST_REMARKS: usize = 20;

#[derive(clap::Args, Clone, Debug, Default)]
pub struct SceneOptions {
    /// Value of a parameter of a scene, such as spp=16 for $spp in a Mitsuba scene. Can be repeated
    #[arg(short = 'D', long = "define", value_name = "NAME=VALUE", value_parser = define, help_heading = HEADING)]
    defines: Vec<(String, String)>,
    /// Time of the animations of a glTF scene; without it, the pose that the file states
    #[arg(long, value_name = "SECONDS", value_parser = time, allow_negative_numbers = true, help_heading = HEADING)]
    at: Option<f64>,
    /// Variant of the materials of a glTF scene
    #[arg(long, value_name = "NAME", help_heading = HEADING)]
    variant: Option<String>,
    /// Read files outside the folder of the scene too, if it names them
    #[arg(long, help_heading = HEADING)]
    pub allow_outside: bool,
    /// Fail if anything in the scene cannot be imported exactly
    #[arg(long, help_heading = HEADING)]
    pub strict: bool,
}

const HEADING: &str = "Scenes of other programs";

impl SceneOptions {
    /// The options of the reader, for images of this size.
    pub fn import_options(&self, size: Option<[u32; 2]>) -> ImportOptions {
        ImportOptions {
            size,
            defines: self.defines.clone(),
            time: self.at,
            variant: self.variant.clone(),
            allow_outside: self.allow_outside,
            ..ImportOptions::default()
        }
    }

    /// Opens a scene file of any format, and prints the remarks about it on standard error.
    pub fn open(&self, path: &Path) -> Result<Opened, Failure> {
        self.open_for(path, None)
    }

    /// Opens a scene file for images of this size, as [`Self::open`] does.
    pub fn open_for(&self, path: &Path, size: Option<[u32; 2]>) -> Result<Opened, Failure> {
        self.open_with(path, &self.import_options(size))
    }

    /// Opens a scene file whose former names are rewritten, as [`Self::open`] does.
    pub fn open_rewritten(&self, path: &Path) -> Result<Opened, Failure> {
        self.open_with(path, &ImportOptions { rewrites: true, ..self.import_options(None) })
    }

    fn open_with(&self, path: &Path, options: &ImportOptions) -> Result<Opened, Failure> {
        if let Some(note) = self.unused(path) {
            tell(&note);
        }
        let opened = with_bar(&options.progress, || import::open(path, options)).map_err(|error| error.report())?;
        self.report(path, &opened.remarks, "imported exactly")?;
        Ok(opened)
    }

    /// Says which options have no effect on a scene with this name.
    fn unused(&self, path: &Path) -> Option<String> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        let is_any = |names: &[&str]| names.iter().any(|name| extension == *name);
        let (is_gltf, is_mitsuba) = (is_any(&["gltf", "glb"]), is_any(&["xml"]));
        let unused = [
            ("-D", !self.defines.is_empty() && !is_mitsuba, "scenes of Mitsuba"),
            ("--at", self.at.is_some() && !is_gltf, "scenes in glTF"),
            ("--variant", self.variant.is_some() && !is_gltf, "scenes in glTF"),
            ("--allow-outside", self.allow_outside && !is_foreign(path), "scenes of other programs, and `convert`,"),
        ];
        let unused: Vec<String> = unused
            .iter()
            .filter(|(_, is_unused, _)| *is_unused)
            .map(|(name, _, of)| format!("{name} affects {of} only"))
            .collect();
        (!unused.is_empty()).then(|| format!("warning: {}", unused.join("; ")))
    }

    /// Prints the remarks about a file on standard error, or fails if there are any and `--strict` is given. `done` is what they were
    /// not.
    pub fn report(&self, path: &Path, remarks: &Remarks, done: &str) -> Result<(), Failure> {
        if remarks.is_empty() {
            return Ok(());
        }
        let list = list(path, remarks, done);
        if self.strict {
            return Err(format!("{list}\nwith --strict, each of these is an error"));
        }
        tell(&format!("warning: {list}"));
        Ok(())
    }

    /// The options as words of a command, each with a space before it.
    pub fn words(&self) -> String {
        let outside = if self.allow_outside { " --allow-outside" } else { "" };
        self.words_of_scene() + outside
    }

    /// Returns the words without `--allow-outside`, which the user gives again each time.
    pub fn words_of_scene(&self) -> String {
        let defines = self.defines.iter().map(|(name, value)| format!("-D {}", quoted(&format!("{name}={value}"))));
        let time = self.at.map(|time| format!("--at {time}"));
        let variant = self.variant.as_ref().map(|name| format!("--variant {}", quoted(name)));
        defines.chain(time).chain(variant).map(|word| format!(" {word}")).collect()
    }
}

/// The remarks about a scene, one line each.
fn list(path: &Path, remarks: &Remarks, done: &str) -> String {
    let what = match remarks.len() {
        1 => "1 thing was".to_owned(),
        count => format!("{count} things were"),
    };
    let lines: String = remarks.lines(MOST_REMARKS).iter().map(|line| format!("\n  {line}")).collect();
    format!("{}: {what} not {done}:{lines}", quote::path(path))
}

/// A word of a command, quoted if it must be.
pub fn quoted(word: &str) -> String {
    shlex::try_quote(word).map_or_else(|_| word.to_owned(), std::borrow::Cow::into_owned)
}

fn define(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.split_once('=').ok_or("expected NAME=VALUE, such as spp=16")?;
    let name = name.trim_start_matches('$');
    if name.is_empty() { Err("the name is missing, as in spp=16".to_owned()) } else { Ok((name.to_owned(), value.to_owned())) }
}

fn time(text: &str) -> Result<f64, String> {
    let time = text.parse().ok().filter(|time: &f64| time.is_finite());
    time.ok_or_else(|| "expected a number of seconds".to_owned())
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Program {
        #[command(flatten)]
        options: SceneOptions,
    }

    #[test]
    fn options_are_read_and_written() {
        let words = ["render", "-D", "spp=16", "-D$file=a b=c", "--at", "-1.5", "--variant", "Red one", "--allow-outside"];
        let SceneOptions { strict, .. } = Program::parse_from(["render", "--strict"]).options;
        let options = Program::parse_from(words).options;
        let expected = ImportOptions {
            defines: vec![("spp".to_owned(), "16".to_owned()), ("file".to_owned(), "a b=c".to_owned())],
            time: Some(-1.5),
            variant: Some("Red one".to_owned()),
            allow_outside: true,
            ..ImportOptions::default()
        };
        assert!(strict && !options.strict);
        assert_eq!(options.import_options(None), expected);
        let again = shlex::split(&format!("render{}", options.words())).expect("they are words");
        assert_eq!(Program::parse_from(again).options.import_options(None), expected);
        assert_eq!(SceneOptions::default().words(), "");
        assert!(define("spp").is_err() && define("=3").is_err() && time("nan").is_err() && time("x").is_err());
    }

    #[test]
    fn a_long_list_of_remarks_is_cut() {
        let mut remarks = Remarks::default();
        (0..30).for_each(|i| remarks.add("a.xml:1:1", format!("`{i}`"), "nothing", "it is missing"));
        let list = list(Path::new("a.xml"), &remarks, "imported exactly");
        assert!(list.starts_with("a.xml: 30 things were not imported exactly:\n  a.xml:1:1: `0` → nothing: it is missing\n"));
        assert_eq!((list.lines().count(), list.lines().last()), (MOST_REMARKS + 2, Some("  … and 10 more")));
    }
}
