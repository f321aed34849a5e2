//! Notes and warnings of the commands.
use super::command_line::{Shell, scene, text};

#[test]
#[cfg(all(unix, not(target_os = "macos")))]
fn without_a_display_a_bad_scene_is_named_too() {
    let shell = Shell::new();
    let said = text(&shell.run(&["nosuch.toml"]).stderr);
    assert!(said.contains("there is no such file") && said.contains("no display"), "{said}");
    std::fs::write(shell.path("bad.toml"), "format = 1\ncamera = 3\n").expect("it is written");
    let said = text(&shell.run(&["bad.toml"]).stderr);
    assert!(said.contains("bad.toml:2:10") && said.contains("no display"), "{said}");
}

#[test]
fn the_likely_cause_of_a_black_picture_is_printed() {
    let shell = Shell::new();
    let said = |scene: &str| {
        let output = shell.run(&["render", scene, "-o", "out.png", "--spp", "4", "--size", "8x8"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        (text(&output.stderr), text(&output.stdout))
    };
    let (notes, summary) = said(&scene("inside_lit_outside"));
    assert!(notes.contains("entirely black: the camera is inside `wall`") && summary.contains("no light found"), "{notes}");
    let (notes, _) = said(&scene("outside_lit_inside"));
    assert!(notes.contains("entirely black: no path found light"), "{notes}");
    let (notes, summary) = said(&scene("furnace"));
    assert!(!notes.contains("black") && !summary.contains("no light"), "{notes}");
}

#[test]
fn roulette_with_infinite_variance_has_a_warning() {
    let shell = Shell::new();
    let notes = |roulette: &str| {
        let options = ["-o", "out.png", "--spp", "2", "--size", "8x8", "--roulette", roulette];
        text(&shell.run(&[&["render", &scene("furnace")][..], &options].concat()).stderr)
    };
    // The walls reflect one half in uniform directions: (1/2)² · 4/3.
    assert!(
        notes("0.2").contains("warning: survival of 0.2") && notes("0.2").contains("the variance is infinite"),
        "{}",
        notes("0.2")
    );
    assert!(notes("0.4").is_empty() && notes("off").is_empty() && notes("throughput").is_empty(), "{}", notes("0.4"));
}

#[test]
fn a_reference_of_another_size_or_kind_is_reported() {
    let shell = Shell::new();
    let furnace = std::fs::read_to_string(scene("furnace")).expect("it is shipped");
    let reference = furnace.find("[reference]").expect("it has one");
    std::fs::write(shell.path("scene.toml"), format!("{}[reference]\nimage = \"true.exr\"\n", &furnace[..reference]))
        .expect("written");
    let missing = shell.run(&["check", "scene.toml"]);
    assert!(text(&missing.stderr).contains("true.exr: cannot be read") && text(&missing.stderr).contains("scene.toml:"));
    std::fs::write(shell.path("true.exr"), "no image").expect("it is written");
    assert!(text(&shell.run(&["check", "scene.toml"]).stderr).contains("not an image"));

    let render = |to: &str, from: &str, size: &str| shell.run(&["render", from, "-o", to, "--spp", "2", "--size", size]);
    assert!(render("true.exr", &scene("furnace"), "16x9").status.success());
    let same = render("out.exr", "scene.toml", "16x9");
    assert!(text(&same.stdout).contains("error") && !text(&same.stderr).contains("true image"));
    let other = render("out.exr", "scene.toml", "16x10");
    assert!(text(&other.stderr).contains("the reference image is 16 × 9 and this one 16 × 10"), "{}", text(&other.stderr));
    assert!(render("out.png", "scene.toml", "16x9").status.success());
    let compared = shell.run(&["compare", "out.png", "true.exr"]);
    assert!(compared.status.success() && text(&compared.stderr).contains("a PNG is clipped"));
    assert!(text(&shell.run(&["compare", "true.exr", "true.exr"]).stderr).is_empty());
}

#[test]
#[cfg(unix)]
fn a_link_is_written_through() {
    let shell = Shell::new();
    std::fs::create_dir(shell.path("disk")).expect("a folder");
    std::os::unix::fs::symlink("disk/there.png", shell.path("link.png")).expect("a link");
    for _ in 0..2 {
        let output = shell.run(&["render", &scene("furnace"), "-o", "link.png", "--spp", "1", "--size", "8x8"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(shell.path("link.png").is_symlink() && shell.path("disk/there.png").is_file());
    }
}

#[test]
fn options_without_effect_are_named() {
    let shell = Shell::new();
    let small = ["--spp", "8", "--size", "16x16"];
    let said = |rest: &[&str]| {
        let done = shell.run(&[&["render", &scene("cornell_box")], &small[..], rest].concat());
        assert!(done.status.success(), "{rest:?}: {}", text(&done.stderr));
        text(&done.stderr)
    };
    for (options, note) in [
        (
            &["-o", "a.png", "--adaptive", "on", "--reuse", "suffixes"][..],
            "warning: `adaptive` is not used: path reuse is on (reused suffixes)",
        ),
        (
            &["-o", "a.png", "--adaptive", "on", "--estimator", "bidirectional"],
            "warning: `adaptive` is not used: light paths reach",
        ),
        (
            &["-o", "a.png", "--reuse", "both", "--estimator", "light_tracing"],
            "warning: `reuse` is not used: all pixels share the light paths",
        ),
        (
            &["-o", "a.png", "--merging", "on", "--estimator", "mis"],
            "warning: `merging` is not used: it belongs to the estimator",
        ),
        (&["-o", "a.exr", "--tone", "aces"], "affect a PNG only"),
        (
            &["-o", "a.png", "-D", "a=1", "--at", "2", "--variant", "b"],
            "warning: -D affects scenes of Mitsuba only; --at affects",
        ),
    ] {
        assert!(said(options).contains(note), "{options:?}: {}", said(options));
    }
    let plain = said(&["-o", "a.png", "--adaptive", "on", "--reuse", "off", "--estimator", "mis"]);
    assert!(!plain.contains("shared") && !plain.contains("light paths"), "{plain}");
    assert_eq!(said(&["-o", "a.png", "--reuse", "off"]), "");
    let samples = ["--samples", "0..8", "--size", "16x16", "--adaptive", "on", "--reuse", "suffixes", "--exposure", "1"];
    let done = shell.run(&[&["render", &scene("cornell_box"), "-o", "a.nf"], &samples[..]].concat());
    let notes = text(&done.stderr);
    assert!(notes.contains("`adaptive` is not used") && notes.contains("a file of samples has no display"), "{notes}");
    let merged = text(&shell.run(&["merge", "a.nf", "-o", "b.exr", "--tone", "agx"]).stderr);
    assert!(merged.contains("affect a PNG only"), "{merged}");
    let replayed = ["render", &scene("furnace"), "--pixel", "1,1", "--size", "8x8", "--spp", "9", "--exposure", "1"];
    assert!(text(&shell.run(&replayed).stderr).contains("does not use --spp, --exposure"));
}
