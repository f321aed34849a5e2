//! `noisefall sheet`: images with several settings on one sheet.
use super::command_line::{Shell, scene, text};

#[test]
fn a_sheet_has_a_picture_for_each_combination() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    let sheet = |file: &str, options: &[&str]| {
        let done = shell.run(&[&["sheet", &furnace, "-o", file, "--size", "220x10"], options].concat());
        assert!(done.status.success(), "{}", text(&done.stderr));
        (noisefall_render::render::image_file::read(&shell.path(file)).expect("an image"), text(&done.stdout))
    };
    let two = ["--spp", "2,1,2", "--estimators", "path,mis", "--max-bounces", "0", "--exposure", "-1"];
    let (picture, said) = sheet("a.png", &two);
    assert!(said.contains("4 images of 220 × 10"), "{said}");
    // Every pixel of the images is 1, or 0.5 with the exposure: four images of 2200 pixels, and hardly any pixel of the text.
    let grey = picture.radiance.iter().filter(|rgb| rgb.iter().all(|c| (c - 0.5).abs() < 0.01)).count();
    assert!((4 * 2200..4 * 2200 + 200).contains(&grey), "{grey}");
    let dark = picture.radiance.iter().filter(|rgb| rgb[1] < 0.2).count();
    assert!(dark > 200, "there are labels: {dark}");
    // As many columns as sample counts: two columns of two images.
    let (row, _) = sheet("row.png", &[&two[..], &["--columns", "4"]].concat());
    assert!(row.width > 2 * picture.width - 40 && row.height < picture.height);
    let wrong = shell.run(&["sheet", &furnace, "-o", "a.exr"]);
    assert!(wrong.status.code() == Some(2) && text(&wrong.stderr).contains("must end in .png"), "{}", text(&wrong.stderr));
    // Before anything is rendered.
    let huge = shell.run(&["sheet", &furnace, "-o", "a.png", "--size", "5000x5000", "--spp", "1,2,3,4,5,6", "--memory", "100G"]);
    assert!(huge.status.code() == Some(1) && text(&huge.stderr).contains("make the images smaller"), "{}", text(&huge.stderr));
    let large = shell.run(&["sheet", &furnace, "-o", "a.png", "--size", "9000x3000", "--memory", "100M"]);
    assert!(large.status.code() == Some(1) && text(&large.stderr).contains("9000 × 3000"), "{}", text(&large.stderr));
}

#[test]
fn another_seed_gives_other_pictures() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    // The image is red. The text, which contains the time, is grey.
    let red =
        std::fs::read_to_string(&furnace).expect("it is shipped").replace("radiance = 1.0 }", "radiance = [1.0, 0.5, 0.5] }");
    std::fs::write(shell.path("red.toml"), red).expect("it is written");
    let few = ["--size", "8x8", "--spp", "1", "--max-bounces", "2", "--exposure", "-2"];
    let picture = |seed: &str| {
        let done = shell.run(&[&["sheet", "red.toml", "-o", "a.png", "--seed", seed], &few[..]].concat());
        assert!(done.status.success(), "{}", text(&done.stderr));
        let sheet = noisefall_render::render::image_file::read(&shell.path("a.png")).expect("an image").radiance;
        sheet.into_iter().filter(|rgb| rgb[0] != rgb[1]).collect::<Vec<_>>()
    };
    let first = picture("1");
    assert!(first.len() == 64 && first == picture("1") && first != picture("2"), "{first:?}");
}
