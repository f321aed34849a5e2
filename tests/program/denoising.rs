//! `render --denoise`.
use std::fs;

use noisefall_render::render::{
    denoise::LABEL,
    image_file::{provenance, read},
};

use crate::command_line::{Shell, json, scene, text};

#[test]
fn a_denoised_image_says_so_and_differs_from_the_render() {
    let shell = Shell::new();
    let render = |name: &str, rest: &[&str]| {
        let furnace = scene("cornell_spheres");
        shell.run(&[&["render", &furnace, "-o", name, "--size", "32x24"], rest].concat())
    };
    assert!(render("plain.exr", &["--spp", "8"]).status.success());
    let done = render("denoised.exr", &["--spp", "8", "--denoise"]);
    assert!(done.status.success() && text(&done.stderr).contains(LABEL), "{}", text(&done.stderr));
    let line = text(&done.stdout);
    assert!(line.contains("biased: denoised") && !line.contains("unbiased") && !line.contains(", noise"), "{line}");
    let [plain, denoised] = ["plain.exr", "denoised.exr"].map(|name| read(&shell.path(name)).expect("an image").radiance);
    assert_ne!(plain, denoised);
    let carries = |name: &str| {
        let bytes = fs::read(shell.path(name)).expect("it is there");
        bytes.windows(LABEL.len()).any(|text| text == LABEL.as_bytes())
    };
    assert!(carries("denoised.exr") && !carries("plain.exr"));
    let refused = render("one.exr", &["--spp", "1", "--denoise"]);
    assert!(refused.status.code() == Some(1) && text(&refused.stderr).contains("two samples"), "{}", text(&refused.stderr));
    assert!(!shell.path("one.exr").exists());
    let figures = json(&render("denoised.png", &["--spp", "8", "--denoise", "--json"]));
    assert_eq!((&figures["biased"], &figures["rel_mse_estimate"]), (&"denoised".into(), &serde_json::Value::Null));
}

#[test]
fn an_image_that_cannot_be_denoised_is_saved_as_it_is() {
    let shell = Shell::new();
    // The first sample takes longer than this, and it is finished in any case.
    let short = ["--time", "0.000001", "--denoise"];
    let render = |name: &str, rest: &[&str]| {
        let done = shell.run(&[&["render", &scene("cornell_spheres"), "-o", name, "--size", "32x24"], rest].concat());
        assert!(done.status.success(), "{}", text(&done.stderr));
        done
    };
    let done = render("short.exr", &short);
    assert!(
        text(&done.stderr).contains("warning: the image is not denoised: denoising needs two samples"),
        "{}",
        text(&done.stderr)
    );
    assert!(text(&done.stdout).contains(" 1 spp ") && text(&done.stdout).contains(", unbiased;"), "{}", text(&done.stdout));
    render("plain.exr", &["--spp", "1"]);
    let [short, plain] = ["short.exr", "plain.exr"].map(|name| shell.path(name));
    assert_eq!(read(&short).expect("an image").radiance, read(&plain).expect("an image").radiance);
    assert!(!provenance(&short).is_denoised);
}

/// Renders 4 samples per pixel of 16 × 9 pixels.
fn rendered(shell: &Shell, scene: &str, name: &str, rest: &[&str]) {
    let done = shell.run(&[&["render", scene, "-o", name, "--spp", "4", "--size", "16x9"], rest].concat());
    assert!(done.status.success(), "{}", text(&done.stderr));
}

#[test]
fn a_comparison_says_which_image_is_denoised_and_takes_none_for_a_repeat() {
    let shell = Shell::new();
    for (name, rest) in [
        ("plain.exr", &["--seed", "1"][..]),
        ("other.exr", &["--seed", "2"]),
        ("denoised.exr", &["--seed", "3", "--denoise"]),
        ("denoised.png", &["--seed", "4", "--denoise"]),
    ] {
        rendered(&shell, &scene("cornell_spheres"), name, rest);
    }
    let compared = |files: &[&str]| shell.run(&[&["compare"], files].concat());
    let said = |files: &[&str]| text(&compared(files).stdout);
    for file in ["denoised.exr", "denoised.png"] {
        let remark = format!("warning: {file} is denoised, and so biased\n");
        assert!(said(&[file, "plain.exr"]).contains(&remark), "{}", said(&[file, "plain.exr"]));
        assert!(said(&[file, "plain.exr"]).contains("has no variances; render it without --denoise"));
        assert!(said(&["plain.exr", file]).contains(&remark), "{}", said(&["plain.exr", file]));
    }
    assert!(!said(&["plain.exr", "other.exr"]).contains("denoise"), "{}", said(&["plain.exr", "other.exr"]));
    for files in
        [["plain.exr", "other.exr", "--repeats", "denoised.exr"], ["denoised.exr", "other.exr", "--repeats", "plain.exr"]]
    {
        let refused = compared(&files);
        let told = text(&refused.stderr);
        assert!(refused.status.code() == Some(1) && told.contains("denoised.exr is denoised: A and its repeats"), "{told}");
    }
}

#[test]
fn a_denoised_image_is_no_reference() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    rendered(&shell, &furnace, "denoised.exr", &["--denoise"]);
    let text_of_scene = fs::read_to_string(&furnace).expect("it is shipped");
    let reference = text_of_scene.find("[reference]").expect("it has one");
    let declared = format!("{}[reference]\nimage = \"denoised.exr\"\n", &text_of_scene[..reference]);
    fs::write(shell.path("declared.toml"), declared).expect("it is written");
    let said = "the reference image is denoised, and so biased";
    let done = shell.run(&["render", "declared.toml", "-o", "out.exr", "--spp", "4", "--size", "16x9"]);
    assert!(done.status.success() && text(&done.stderr).contains(said), "{}", text(&done.stderr));
    assert!(!text(&done.stdout).contains(", error"), "{}", text(&done.stdout));
    let checked = shell.run(&["check", "declared.toml"]);
    assert!(checked.status.success() && text(&checked.stdout).contains(said), "{}", text(&checked.stdout));
    let studied = |arguments: &[&str]| {
        let refused = shell.run(&[&["study", "-o", "out"], arguments].concat());
        assert_eq!(refused.status.code(), Some(1), "{arguments:?}");
        text(&refused.stderr)
    };
    let told = studied(&["declared.toml"]);
    assert!(told.contains("the reference image") && told.contains("denoised.exr is denoised, and so biased"), "{told}");
    let told = studied(&[&furnace, "--reference", "denoised.exr"]);
    assert!(told.contains("denoised.exr: the image is denoised, and so biased; a reference must be a render"), "{told}");
}
