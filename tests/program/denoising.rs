//! `render --denoise`.
use noisefall::render::{denoise::LABEL, image_file::read};

use crate::command_line::{Shell, scene, text};

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
    let [plain, denoised] = ["plain.exr", "denoised.exr"].map(|name| read(&shell.path(name)).expect("an image").radiance);
    assert_ne!(plain, denoised);
    let carries = |name: &str| {
        let bytes = std::fs::read(shell.path(name)).expect("it is there");
        bytes.windows(LABEL.len()).any(|text| text == LABEL.as_bytes())
    };
    assert!(carries("denoised.exr") && !carries("plain.exr"));
    let refused = render("one.exr", &["--spp", "1", "--denoise"]);
    assert!(refused.status.code() == Some(1) && text(&refused.stderr).contains("two samples"), "{}", text(&refused.stderr));
}
