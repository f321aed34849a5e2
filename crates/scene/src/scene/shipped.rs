//! The scenes that are part of the program: the files in `scenes/`, with the images that they name.
use std::path::Path;

use include_dir::{Dir, File, include_dir};

use super::{Scene, diagnostic::SceneError, parse::parse_with_assets};
use noisefall_base::{declare::Assets, progress::Progress};

static FOLDER: Dir = include_dir!("$NOISEFALL_SCENES");

/// A scene that is part of the program. It is opened by its name where there is no file of that name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShippedScene {
    /// Its name: that of its file, without the extension.
    pub name: &'static str,
    /// The text of its file.
    pub text: &'static str,
}

impl ShippedScene {
    /// All of them, by name.
    pub fn all() -> Vec<ShippedScene> {
        let mut scenes: Vec<_> = FOLDER.files().filter_map(shipped).collect();
        scenes.sort_by_key(|scene| scene.name);
        scenes
    }

    /// The scene that a path means: it is the name of a scene, and there is no such file.
    pub fn of(path: &Path) -> Option<ShippedScene> {
        let name = path.to_str()?;
        ShippedScene::all().into_iter().find(|scene| scene.name == name && !path.exists())
    }

    /// The scene with this text.
    pub fn of_text(text: &str) -> Option<ShippedScene> {
        ShippedScene::all().into_iter().find(|scene| scene.text == text)
    }

    /// The files that the scene names, by the paths that it names them by.
    pub fn files(&self) -> impl Iterator<Item = (&'static str, &'static [u8])> {
        let files = FOLDER.dirs().flat_map(Dir::files).filter_map(|file| Some((file.path().to_str()?, file.contents())));
        files.filter(|(path, _)| self.text.contains(path))
    }

    /// Compiles the scene. Its files are in memory.
    pub fn load(&self, progress: &Progress) -> Result<Scene, SceneError> {
        let mut assets = Assets::default();
        self.files().for_each(|(path, bytes)| assets.insert(path, bytes.to_vec()));
        parse_with_assets(self.name, self.text.to_owned(), assets, progress)
    }
}

fn shipped(file: &'static File) -> Option<ShippedScene> {
    let name = file.path().to_str()?.strip_suffix(".toml")?;
    Some(ShippedScene { name, text: file.contents_utf8()? })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{load, load_watched};

    #[test]
    fn every_file_of_the_folder_is_a_scene_and_every_image_belongs_to_one() {
        let scenes = ShippedScene::all();
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        let count = |folder: &Path| std::fs::read_dir(folder).expect("it is there").filter_map(Result::ok).count();
        assert_eq!(scenes.len(), count(&folder) - 1, "all but the folder of images");
        let mut named: Vec<_> = scenes.iter().flat_map(ShippedScene::files).map(|(path, _)| path).collect();
        named.sort_unstable();
        named.dedup();
        assert_eq!(named.len(), count(&folder.join("assets")), "{named:?}");
    }

    #[test]
    fn a_scene_in_the_program_is_the_one_of_its_file() {
        let of_name = load(Path::new("sky_lit")).expect("it is part of the program");
        let of_file = load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/sky_lit.toml")).expect("a scene");
        assert_eq!((&*of_name.source, &of_name.title), (&*of_file.source, &of_file.title));
        assert_eq!(of_name.assets.paths().collect::<Vec<_>>(), ["assets/sky.exr"]);
        assert!(of_file.assets.is_empty());
    }

    #[test]
    fn a_file_comes_before_the_scene_of_the_same_name() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("furnace");
        std::fs::write(&path, "format = 1\n[camera]\n").expect("it is written");
        assert_eq!(ShippedScene::of(&path), None);
        assert_eq!(ShippedScene::of(Path::new("furnace")).map(|scene| scene.name), Some("furnace"));
        for other in ["furnace.toml", "./furnace", "scenes/furnace", "furnac", ""] {
            assert_eq!(ShippedScene::of(Path::new(other)), None, "{other}");
        }
        let missing = load_watched(Path::new("furnac"), &Progress::default()).err().expect("there is no such scene");
        assert!(missing.report().contains("`noisefall scenes` lists"), "{}", missing.report());
    }
}
