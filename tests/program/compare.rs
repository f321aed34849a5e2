//! `noisefall compare`: error, bias in standard errors, FLIP and pictures of the difference.
use super::command_line::{Shell, scene, text};

fn compare(shell: &Shell, arguments: &[&str]) -> serde_json::Value {
    let output = shell.run(&[&["compare"], arguments, &["--json"]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_str(&text(&output.stdout)).expect("a line of JSON")
}

fn render(shell: &Shell, file: &str, options: &[&str]) {
    let base = ["render", &scene("cornell_spheres"), "-o", file, "--spp", "32", "--size", "128x128"];
    let output = shell.run(&[&base[..], options].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
}

#[test]
fn a_bias_is_told_from_noise() {
    let shell = Shell::new();
    render(&shell, "a.exr", &["--seed", "1"]);
    render(&shell, "b.exr", &["--seed", "2"]);
    render(&shell, "capped.exr", &["--seed", "3", "--max-bounces", "4"]);
    let noise = compare(&shell, &["a.exr", "b.exr"]);
    let bias = compare(&shell, &["capped.exr", "b.exr"]);
    assert_eq!(noise["block_z"].as_array().map(Vec::len), Some(16));
    assert!(noise["bias_in_standard_errors"].as_f64().is_some_and(|z| z.abs() < 4.5), "{noise}");
    assert!(bias["bias_in_standard_errors"].as_f64().is_some_and(|z| z < -6.0), "{bias}");
    if cfg!(feature = "flip") {
        let flip = |line: &serde_json::Value| line["flip"].as_f64().expect("a number");
        assert!(flip(&compare(&shell, &["a.exr", "a.exr"])) == 0.0 && flip(&bias) > flip(&noise) && flip(&noise) > 0.0);
    }
}

#[test]
fn differences_are_written_as_numbers_and_as_colours() {
    let shell = Shell::new();
    render(&shell, "a.exr", &["--seed", "1"]);
    render(&shell, "b.exr", &["--seed", "2"]);
    let said = |file: &str| {
        let output = shell.run(&["compare", "a.exr", "b.exr", "-o", file]);
        assert!(output.status.success() && shell.path(file).is_file(), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    assert!(said("difference.png").contains("full colour is a difference of"));
    assert!(said("difference.exr").contains("A less B"));
    // Less what it has more is what is equal.
    let twice = compare(&shell, &["difference.exr", "difference.exr"]);
    assert_eq!(twice["rmse"].as_f64(), Some(0.0));
    let refused = shell.run(&["compare", "a.exr", "b.exr", "-o", "nowhere/difference.png"]);
    assert!(refused.status.code() == Some(1) && text(&refused.stderr).contains("there is no folder"));
}
