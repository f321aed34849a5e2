//! Names, chapters and files of the listed scenes.
use super::*;

#[test]
fn a_scene_is_called_by_its_title_or_else_by_its_file() {
    assert_eq!(name("A title", Path::new("some/tiny_lamp.toml")), "A title");
    assert_eq!(name("", Path::new("some/tiny_lamp.toml")), "tiny lamp");
}

#[test]
fn a_file_is_named_after_its_scene() {
    let stems = ["Studio", "Veach's plates: MIS", BUILT_IN_NAME, "…"].map(file_stem);
    assert_eq!(stems, ["studio", "veach_s_plates_mis", "cornell_spheres", "scene"]);
}

#[test]
fn a_scene_is_a_shipped_one_while_nobody_has_changed_it() {
    let (scenes, path) = (find(), Path::new("scenes/furnace.toml"));
    let text = ShippedScene::all().into_iter().find(|scene| scene.name == "furnace").expect("it is shipped").text;
    assert!(is_shipped(&scenes, path, text));
    assert!(!is_shipped(&scenes, path, &format!("{text}\n")), "someone's own");
    assert!(!is_shipped(&scenes, Path::new("elsewhere/furnace.toml"), text), "a copy");
}

#[test]
fn shipped_scenes_are_in_the_order_of_their_chapters_and_each_has_one() {
    let scenes = find();
    let order: Vec<&str> = CHAPTERS.iter().map(|(chapter, _)| *chapter).collect();
    assert_eq!(order, ["The box", "Noise", "Estimators", "Materials", "Geometry", "Limits"]);
    let places: Vec<Option<usize>> =
        scenes.iter().map(|entry| order.iter().position(|chapter| *chapter == entry.chapter)).collect();
    assert!(places.len() > 20 && places.is_sorted(), "{places:?}");
    assert!(places.iter().all(Option::is_some), "a shipped scene has no chapter: {:?}", scenes.last().map(|entry| &entry.path));
    assert_eq!(
        scenes.len(),
        CHAPTERS.iter().map(|(_, names)| names.len()).sum::<usize>(),
        "a chapter has a scene that is not there"
    );
}

#[test]
fn the_built_in_scene_is_listed_once_and_has_notes_like_others() {
    let scenes = find();
    let built_in = open_entry(&scenes, None).expect("it is listed");
    assert!(built_in.path.ends_with("cornell_spheres.toml") && built_in.notes.starts_with("Two balls"));
    let file = Path::new("scenes/furnace.toml");
    assert!(open_entry(&scenes, Some(file)).is_some_and(|entry| entry.path.ends_with("furnace.toml")));
    assert!(open_entry(&scenes, Some(Path::new("nowhere.toml"))).is_none() && open_entry(&[], None).is_none());
}

#[test]
fn the_scenes_in_the_program_are_those_of_the_folder() {
    let stems = |entries: Vec<CatalogueEntry>| {
        let mut stems: Vec<_> = entries.into_iter().map(|entry| (entry.path.with_extension(""), entry.name)).collect();
        stems.iter_mut().for_each(|(path, _)| *path = path.file_name().unwrap_or_default().into());
        stems.sort();
        stems
    };
    assert_eq!(stems(shipped()), stems(list(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes"))));
}

#[test]
fn scenes_of_a_user_come_after_those_of_the_program() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["zebra.toml", "lamps.toml"] {
        std::fs::write(folder.path().join(name), "format = 1\n").expect("it is written");
    }
    let scenes = entries(None, folder.path());
    let is_own = |entry: &CatalogueEntry| entry.path.starts_with(in_full(folder.path()));
    assert_eq!(scenes.iter().filter(|entry| !is_own(entry)).count(), shipped().len());
    assert!(scenes[shipped().len()..].iter().all(|entry| is_own(entry) && entry.chapter == OTHERS));
}

#[test]
fn a_folder_lists_its_scenes_and_an_opened_scene_is_listed_once_under_its_last_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("it is written");
    // The file is longer than the part that is read.
    let long = "x".repeat(2 * LONGEST_HEAD as usize);
    write("titled.toml", &format!("format = 1\ntitle = \"Zebra\"\n[camera]\ntitle = \"{long}\"\n"));
    write("plain_one.toml", "format = 1\n[camera]\ntitle = \"no\"\n");
    write("notes.txt", "title = \"no scene\"");
    let mut scenes = list(folder.path());
    scenes.sort_by(|a, b| a.name.cmp(&b.name));
    assert_eq!(scenes.iter().map(|scene| scene.name.as_str()).collect::<Vec<_>>(), ["Zebra", "plain one"]);
    assert_eq!(remember(&mut scenes, "Another name", &folder.path().join("titled.toml")), "Another name");
    assert_eq!((scenes.len(), scenes[0].name.as_str()), (2, "Another name"));
    remember(&mut scenes, "New", &folder.path().join("new.toml"));
    assert_eq!((scenes.len(), scenes[2].name.as_str()), (3, "New"));
    assert!(scenes[2].path.ends_with("new.toml"));
    assert_eq!(remember(&mut scenes, "New", &folder.path().join("copy.toml")), "New (copy.toml)");
    assert_eq!(remember(&mut scenes, "New", &folder.path().join("new.toml")), "New");
}
