//! Scenes of others read and write nothing outside of their folder, unless the user says so.
#![cfg(unix)]
use std::{
    fs,
    os::unix::fs::symlink,
    path::{Path, PathBuf},
    process::Output,
};

use crate::command_line::{Shell, text};

/// A text that must not be printed.
const SECRET: &str = "root:x:0:0:the first line of a secret file";
/// A PNG of one pixel.
const PNG: [u8; 69] = [
    137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0, 1, 0, 0, 0, 1, 8, 2, 0, 0, 0, 144, 119, 83, 222, 0, 0,
    0, 12, 73, 68, 65, 84, 120, 156, 99, 248, 207, 192, 0, 0, 3, 1, 1, 0, 201, 254, 146, 239, 0, 0, 0, 0, 73, 69, 78, 68, 174,
    66, 96, 130,
];

/// A user's folders: `home/scenes/room` is the folder of the scene, and has links out of it.
struct Home(Shell);

impl Home {
    fn new() -> Home {
        let home = Home(Shell::new());
        for folder in ["scenes/room/.hidden", "scenes/common", "private/.ssh", ".ssh"] {
            fs::create_dir_all(home.path(folder)).expect("a folder");
        }
        for folder in ["private", "private/.ssh", ".ssh", "scenes/room/.hidden", "scenes/common"] {
            for name in ["key", "key.xml", "key.pbrt", "key.obj", "key.mtl", "key.gltf", "key.spd", "key.toml"] {
                fs::write(home.path(folder).join(name), SECRET).expect("it is written");
            }
            fs::write(home.path(folder).join("photo.png"), PNG).expect("it is written");
        }
        for (link, to) in [("l", "../../private"), ("photo.png", "../../private/photo.png"), ("key.mtl", "../../.ssh/key.mtl")] {
            symlink(to, home.path("scenes/room").join(link)).expect("a link");
        }
        home
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path(name)
    }

    /// Writes a scene, and runs a command on it.
    fn run(&self, name: &str, scene: &str, command: &[&str]) -> Output {
        let path = self.path("scenes/room").join(name);
        fs::write(&path, scene).expect("it is written");
        let words: Vec<&str> =
            command.iter().map(|word| if *word == "SCENE" { path.to_str().expect("text") } else { word }).collect();
        self.0.run(&words)
    }

    /// All commands that read scenes.
    fn commands() -> [&'static [&'static str]; 6] {
        [
            &["render", "SCENE", "-o", "out.png", "--spp", "1", "--size", "4x4"],
            &["check", "SCENE"],
            &["convert", "SCENE", "-o", "out.toml"],
            &["convert", "SCENE", "-o", "out.glb"],
            &["convert", "SCENE", "-o", "out.xml"],
            &["sheet", "SCENE", "-o", "sheet.png", "--spp", "1", "--size", "4x4"],
        ]
    }

    /// Fails if a secret was printed or copied.
    fn assert_kept(&self, what: &str, output: &Output) {
        let said = format!("{}{}", text(&output.stdout), text(&output.stderr));
        assert!(!said.contains("root:x") && !said.contains("secret file"), "{what}: {said}");
        for name in ["out.files", "out.glb"] {
            assert!(!self.path(name).exists(), "{what}: {name} was written");
        }
    }
}

/// Whether a message names the option, which the end of a line may divide.
fn names_the_option(said: &str) -> bool {
    said.replace(|c: char| c.is_whitespace() || c == '│', "").contains("--allow-outside")
}

/// Scenes of Mitsuba that name a folder, and a file in it.
fn mitsuba(folder: &str, file: &str, element: &str) -> String {
    let file = match element {
        "include" => format!("<include filename=\"{file}\"/>"),
        "image" => format!(
            "<shape type=\"sphere\"><bsdf type=\"diffuse\"><texture type=\"bitmap\" name=\"reflectance\">\
             <string name=\"filename\" value=\"{file}\"/></texture></bsdf></shape>"
        ),
        "shape" => format!("<shape type=\"obj\"><string name=\"filename\" value=\"{file}\"/></shape>"),
        _ => format!("<emitter type=\"constant\"><spectrum name=\"radiance\" filename=\"{file}\"/></emitter>"),
    };
    format!("<scene version=\"3.0.0\">\n<path value=\"{folder}\"/>\n{file}\n</scene>")
}

#[test]
fn no_path_of_mitsuba_leads_out_by_a_link_or_to_hidden_files() {
    let home = Home::new();
    let files =
        [("include", "key"), ("include", "key.xml"), ("image", "photo.png"), ("shape", "key.obj"), ("spectrum", "key.spd")];
    for folder in ["l", "./l", "l/.ssh", "../../.ssh", "../../private/.ssh", "../room/l", ".hidden", "../common/../../.ssh"] {
        for (element, file) in files {
            for command in Home::commands() {
                let done = home.run("a.xml", &mitsuba(folder, file, element), command);
                let said = text(&done.stderr);
                assert!(done.status.code() == Some(1) && names_the_option(&said), "{folder}, {element}: {said}");
                home.assert_kept(folder, &done);
            }
        }
    }
    for (folder, file) in [("../common", "../../.ssh/key"), ("../common", "key"), ("..", "room/l/key"), (".", "l/key")] {
        let done = home.run("a.xml", &mitsuba(folder, file, "include"), &["check", "SCENE"]);
        assert_eq!(done.status.code(), Some(1), "{folder}");
        home.assert_kept(folder, &done);
    }
    let shared = home.run("a.xml", &mitsuba("../common", "photo.png", "image"), Home::commands()[0]);
    assert!(shared.status.success(), "a folder that scenes share: {}", text(&shared.stderr));
    let allowed = home.run("a.xml", &mitsuba("l", "photo.png", "image"), &["check", "SCENE", "--allow-outside"]);
    assert!(allowed.status.success(), "{}", text(&allowed.stderr));
}

#[test]
fn no_other_format_leads_out_either() {
    let home = Home::new();
    let gltf = |uri: &str| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":
{{"POSITION":0}},"material":0}}]}}],"materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],"textures":[{{"source":0}}],
"images":[{{"uri":"{uri}"}}],"accessors":[{{"componentType":5126,"count":3,"type":"VEC3","bufferView":0}}],
"bufferViews":[{{"buffer":0,"byteLength":36}}],"buffers":[{{"byteLength":36,"uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}]}}"#
        )
    };
    let pbrt = |file: &str| {
        format!(
            "WorldBegin\nTexture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"{file}\"\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n"
        )
    };
    let obj = |library: &str| format!("mtllib {library}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let mut scenes = vec![
        ("a.pbrt", "WorldBegin\nInclude \"l/key.pbrt\"\n".to_owned()),
        ("a.pbrt", "WorldBegin\nInclude \".hidden/key.pbrt\"\n".to_owned()),
        ("a.obj", obj("key.mtl")),
        ("a.obj", obj("../../.ssh/key.mtl")),
    ];
    for file in ["photo.png", "l/photo.png", "../../.ssh/photo.png", ".hidden/photo.png"] {
        scenes.extend([("a.gltf", gltf(file)), ("a.pbrt", pbrt(file))]);
    }
    for (name, scene) in scenes {
        for command in Home::commands() {
            let done = home.run(name, &scene, command);
            // A refused file of a mesh is only a remark: then there is nothing to copy.
            let is_copied = home.path("out.files").exists() && done.status.success();
            assert!(!is_copied || !has_photo(&home.path("out.files")), "{name} {scene}");
            let _ = fs::remove_dir_all(home.path("out.files"));
            let _ = fs::remove_file(home.path("out.glb"));
            home.assert_kept(name, &done);
        }
    }
}

/// Whether a folder has the bytes of the photo.
fn has_photo(folder: &Path) -> bool {
    let entries = fs::read_dir(folder).expect("a folder").flatten().map(|entry| entry.path());
    { entries }.any(|path| if path.is_dir() { has_photo(&path) } else { fs::read(path).is_ok_and(|bytes| bytes == PNG) })
}

#[test]
fn a_scene_of_ours_is_converted_without_files_from_outside_unless_that_is_allowed() {
    let home = Home::new();
    for file in ["photo.png", "l/photo.png", "../../private/photo.png", ".hidden/photo.png"] {
        let scene = format!(
            "format = 1\ncamera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [4, 4] }}\ntextures.t.image.path = \"{file}\"\n\
             materials.a.lambertian.albedo.texture = \"t\"\n[[objects]]\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\nmaterial = \"a\"\n"
        );
        for out in ["out.toml", "out.glb", "out.xml"] {
            let done = home.run("a.toml", &scene, &["convert", "SCENE", "-o", out]);
            let said = text(&done.stderr);
            assert!(done.status.code() == Some(1) && said.contains("--allow-outside permits it"), "{file}: {said}");
            home.assert_kept(file, &done);
            assert!(!home.path(out).exists());
        }
        let allowed = home.run("a.toml", &scene, &["convert", "SCENE", "-o", "allowed.toml", "--allow-outside"]);
        assert!(allowed.status.success(), "{file}: {}", text(&allowed.stderr));
    }
}

#[test]
fn a_kept_render_cannot_allow_itself_to_read_outside() {
    let home = Home::new();
    let keep = ["render", "SCENE", "-o", "out.png", "--spp", "1", "--size", "4x4", "--checkpoint", "out.nf", "--allow-outside"];
    let kept = home.run("a.xml", &mitsuba("l", "photo.png", "image"), &keep);
    assert!(kept.status.success(), "{}", text(&kept.stderr));
    let resume = ["render", "--resume", "out.nf", "-o", "again.png", "--spp", "2"];
    let refused = home.0.run(&resume);
    assert!(refused.status.code() == Some(1) && names_the_option(&text(&refused.stderr)), "{}", text(&refused.stderr));
    let allowed = home.0.run(&[&resume[..], &["--allow-outside"]].concat());
    assert!(allowed.status.success(), "{}", text(&allowed.stderr));
}

#[test]
fn a_conversion_follows_no_link_below_its_folder() {
    let home = Home::new();
    let gltf = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"a"}],"meshes":[{"name":"a","primitives":[
{"attributes":{"POSITION":0},"material":0}]}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],
"images":[{"name":"wood","uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC"}],
"accessors":[{"componentType":5126,"count":3,"type":"VEC3","bufferView":0}],"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;
    let convert = |out: &str| home.run("a.gltf", gltf, &["convert", "SCENE", "-o", out]);
    for extension in ["toml", "xml", "gltf"] {
        let out = format!("plain.{extension}");
        assert!(convert(&out).status.success());
        let files = home.path("plain.files");
        let written: Vec<PathBuf> = all_files(&files);
        assert!(!written.is_empty(), "{extension}: something is written below the folder");
        // A link in place of each file, of each folder, and of all.
        for (number, file) in written.iter().enumerate() {
            let inner = file.strip_prefix(&files).expect("it is inside");
            for (step, part) in inner.ancestors().enumerate() {
                let name = format!("{extension}{number}{step}");
                // Files are named after the scene.
                let part = PathBuf::from(part.to_string_lossy().replace("plain", &name));
                let (folder, mine) = (home.path(&format!("{name}.files")), home.path("mine"));
                fs::create_dir_all(&mine).expect("a folder");
                let link = folder.join(&part);
                fs::create_dir_all(link.parent().expect("a folder")).expect("folders");
                let is_file = step == 0;
                fs::write(mine.join("file"), "mine").expect("it is written");
                let link = if part.as_os_str().is_empty() { folder.clone() } else { link };
                symlink(if is_file { mine.join("file") } else { mine.clone() }, link).expect("a link");
                let done = convert(&format!("{name}.{extension}"));
                let said = text(&done.stderr);
                assert!(done.status.code() == Some(1) && said.contains("is a link"), "{extension} {}: {said}", part.display());
                assert!(!home.path(&format!("{name}.{extension}")).exists(), "the scene comes last");
                let left: Vec<_> = fs::read_dir(&mine).expect("it is there").flatten().map(|entry| entry.file_name()).collect();
                assert_eq!((left, fs::read(mine.join("file")).expect("it is there")), (vec!["file".into()], b"mine".to_vec()));
            }
        }
        fs::remove_dir_all(files).expect("it is there");
    }
}

fn all_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").flatten().map(|entry| entry.path());
    entries.flat_map(|path| if path.is_dir() { all_files(&path) } else { vec![path] }).collect()
}
