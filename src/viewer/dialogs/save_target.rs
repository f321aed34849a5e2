//! Files to save, and their names.
use std::path::{Path, PathBuf, is_separator};

use noisefall_base::file;
use noisefall_render::render::image_file::check_target;

use crate::viewer::background::catalogue::file_stem;

/// The content of a file to save.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SaveTarget {
    /// The scene file.
    Scene,
    Picture,
    /// The image as an EXR with layers.
    Layers,
    /// The render, to be continued.
    Progress,
    CurvesCsv,
    CurvesSvg,
    /// The path in the path inspector.
    Path,
}

impl SaveTarget {
    pub fn title(self) -> &'static str {
        match self {
            SaveTarget::Scene => "Save scene",
            SaveTarget::Picture => "Save image",
            SaveTarget::Layers => "Save image with layers",
            SaveTarget::Progress => "Save checkpoint",
            SaveTarget::CurvesCsv => "Save curves",
            SaveTarget::CurvesSvg => "Save plot",
            SaveTarget::Path => "Save path",
        }
    }

    pub fn explanation(self) -> &'static str {
        match self {
            SaveTarget::Picture => {
                "PNG stores the image as displayed (A of a comparison); EXR stores linear radiance. Both store the settings."
            }
            SaveTarget::Layers => {
                "EXR with radiance, albedo, normal, depth, position, object, material, samples and, if chosen, each number of bounces."
            }
            SaveTarget::Scene => {
                "TOML. Comments and formatting of the file are kept; paths in the scene are relative to its folder."
            }
            SaveTarget::Progress => {
                "NF stores the scene and the samples. Open it, and the render continues as if it had never stopped."
            }
            SaveTarget::CurvesCsv => "CSV with a row for each figure: settings, samples, seconds, errors and bias.",
            SaveTarget::CurvesSvg => "SVG with the curves of all settings.",
            SaveTarget::Path => "TXT lists all terms of the path, TEX its nested sum, CSV the samples of the pixel.",
        }
    }

    /// The extensions of its files.
    pub fn extensions(self) -> &'static [&'static str] {
        match self {
            SaveTarget::Scene => &["toml"],
            SaveTarget::Picture => &["png", "exr"],
            SaveTarget::Layers => &["exr"],
            SaveTarget::Progress => &["nf"],
            SaveTarget::CurvesCsv => &["csv"],
            SaveTarget::CurvesSvg => &["svg"],
            SaveTarget::Path => &["txt", "tex", "csv"],
        }
    }

    pub fn check(self, path: &Path) -> Result<(), String> {
        if self == SaveTarget::Picture {
            return check_target(path).map_err(|error| error.to_string());
        }
        if self == SaveTarget::Layers && !self.takes(path) {
            return Err("The name must end in .exr.".to_owned());
        }
        if self == SaveTarget::Progress && !self.takes(path) {
            return Err("The name must end in .nf.".to_owned());
        }
        if self == SaveTarget::Scene && !self.takes(path) {
            return Err("The name must end in .toml.".to_owned());
        }
        if self == SaveTarget::Path && !self.takes(path) {
            return Err("The name must end in .txt, .tex or .csv.".to_owned());
        }
        file::check(path).map_err(|error| error.to_string())
    }

    /// The path with the usual extension if its name has none.
    pub fn completed(self, path: PathBuf) -> PathBuf {
        let is_folder = path.to_string_lossy().ends_with(is_separator);
        if is_folder || path.extension().is_some() { path } else { path.with_extension(self.extensions()[0]) }
    }

    /// Whether a file has one of the extensions.
    pub fn takes(self, path: &Path) -> bool {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        extension.is_some_and(|extension| self.extensions().contains(&extension.as_str()))
    }
}

/// The names and folders that a suggested name is made of.
#[derive(Clone, Copy, Debug, Default)]
pub struct SceneNames<'a> {
    /// The scene file.
    pub path: Option<&'a Path>,
    pub title: &'a str,
    /// The last file that was saved of this scene, other than the scene.
    pub last_saved: Option<&'a Path>,
    /// The folder of the last file of another scene.
    pub folder: Option<&'a Path>,
}

/// A path that is not taken, named after the last file of this scene, or after the file of the scene, or else after its name.
pub fn suggested_path(target: SaveTarget, scene: &SceneNames<'_>) -> PathBuf {
    let extension = target.extensions()[0];
    let is_scene = target == SaveTarget::Scene;
    let of_file = scene.path.and_then(|path| path.file_stem()?.to_str().map(str::to_owned));
    let name = of_file.unwrap_or_else(|| file_stem(scene.title));
    let last = scene.last_saved.filter(|path| !is_scene && (extension != "png" || SaveTarget::Picture.takes(path)));
    let folder = scene.folder.filter(|_| !is_scene).map(Path::to_owned);
    let in_folder = || folder.or_else(|| std::env::current_dir().ok()).unwrap_or_default().join(&name);
    // Paths in a scene are relative to its folder.
    let path = last.or(scene.path.filter(|_| is_scene)).map_or_else(in_folder, Path::to_owned);
    let keeps = extension == "png" && SaveTarget::Picture.takes(&path);
    free(&if keeps { path } else { path.with_extension(extension) })
}

/// The path, or the first of `name-2`, `name-3`, … that is not taken.
fn free(path: &Path) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    // A number that was added here before is counted on.
    let stem = stem.rsplit_once('-').filter(|(_, n)| n.parse::<u32>().is_ok()).map_or(&*stem, |(stem, _)| stem);
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let numbered = (2..10_000).map(|n| path.with_file_name(format!("{stem}-{n}.{extension}")));
    std::iter::once(path.to_owned()).chain(numbered).find(|path| !path.exists()).unwrap_or_else(|| path.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::instruments::path::copying::PathForm;

    #[test]
    fn a_name_that_is_taken_is_numbered_on() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        let write = |name: &str| std::fs::write(path(name), "taken").expect("it is written");
        assert_eq!(free(&path("shot.png")), path("shot.png"));
        write("shot.png");
        assert_eq!(free(&path("shot.png")), path("shot-2.png"));
        write("shot-2.png");
        assert_eq!(free(&path("shot.png")), path("shot-3.png"));
        assert_eq!(free(&path("shot-2.png")), path("shot-3.png"), "a number is counted on, and not added to");
        write("two-balls.exr");
        assert_eq!(free(&path("two-balls.exr")), path("two-balls-2.exr"));
    }

    #[test]
    fn a_scene_without_a_file_is_named_after_its_title() {
        let scene = SceneNames { title: "A studio of mine", ..SceneNames::default() };
        let suggested = |target: SaveTarget| suggested_path(target, &scene);
        assert!(suggested(SaveTarget::Scene).ends_with("a_studio_of_mine.toml"));
        assert!(suggested(SaveTarget::Picture).ends_with("a_studio_of_mine.png"));
    }

    #[test]
    fn a_later_scene_has_its_own_name_in_the_folder_of_the_last_file() {
        let [image, room] = ["/nowhere/pictures/ball.png", "/nowhere/scenes/room.toml"].map(Path::new);
        let same = SceneNames { path: Some(room), last_saved: Some(image), ..SceneNames::default() };
        assert_eq!(suggested_path(SaveTarget::CurvesCsv, &same), Path::new("/nowhere/pictures/ball.csv"));
        let other = SceneNames { last_saved: None, folder: image.parent(), ..same };
        assert_eq!(suggested_path(SaveTarget::Picture, &other), Path::new("/nowhere/pictures/room.png"));
        assert_eq!(suggested_path(SaveTarget::Scene, &other), room);
    }

    #[test]
    fn every_target_takes_its_own_extensions() {
        let takes = |target: SaveTarget, name: &str| target.takes(Path::new(name));
        assert!(
            takes(SaveTarget::Picture, "a.png") && takes(SaveTarget::Picture, "a.EXR") && !takes(SaveTarget::Picture, "a.csv")
        );
        assert!(
            takes(SaveTarget::CurvesCsv, "a.csv")
                && !takes(SaveTarget::CurvesCsv, "a.svg")
                && !takes(SaveTarget::CurvesCsv, "csv")
        );
        assert!(takes(SaveTarget::CurvesSvg, "a.svg") && !takes(SaveTarget::CurvesSvg, "a.png"));
        for extension in SaveTarget::Path.extensions() {
            assert!(takes(SaveTarget::Path, &format!("a.{extension}")) && PathForm::of_extension(extension).is_some());
        }
        assert!(!takes(SaveTarget::Path, "a.png") && SaveTarget::Path.check(Path::new("a.png")).is_err());
    }

    #[test]
    fn a_name_without_extension_is_completed_and_a_folder_is_not() {
        let completed = |target: SaveTarget, path: &str| target.completed(path.into());
        assert_eq!(completed(SaveTarget::Scene, "a/mine"), Path::new("a/mine.toml"));
        assert_eq!(completed(SaveTarget::Picture, "shot"), Path::new("shot.png"));
        assert_eq!(completed(SaveTarget::Layers, "shot"), Path::new("shot.exr"));
        assert_eq!(completed(SaveTarget::Picture, "shot.exr"), Path::new("shot.exr"));
        assert_eq!(completed(SaveTarget::Picture, "shot.jpg"), Path::new("shot.jpg"), "a wrong one is refused");
        assert_eq!(completed(SaveTarget::Scene, "folder/"), Path::new("folder/"));
    }

    #[test]
    fn a_folder_that_is_not_there_is_refused_before_anything_is_written() {
        let folder = tempfile::tempdir().expect("a folder");
        for (target, name) in [(SaveTarget::Picture, "a.png"), (SaveTarget::CurvesCsv, "a.csv"), (SaveTarget::CurvesSvg, "a.svg")]
        {
            assert_eq!(target.check(&folder.path().join(name)), Ok(()));
            assert!(target.check(&folder.path().join("nowhere").join(name)).is_err_and(|error| error.contains("nowhere")));
        }
        assert_eq!(SaveTarget::CurvesCsv.check(Path::new("a.csv")), Ok(()), "the current folder is there");
    }
}
