//! Image files.
use std::fs;

use noisefall_kernel::measure::SampleNoise;
use noisefall_render::render::{
    Display, Frame, ToneMap,
    denoise::LABEL,
    image_file::{SETTINGS_KEY, check_target, provenance, read, save},
    tone::to_srgb,
    view::View,
};

fn frame() -> Frame {
    let radiance = (0..12).map(|i| [i as f32 / 12.0, 0.5, 2.0 * i as f32]).collect();
    Frame { width: 4, height: 3, full_resolution: [4, 3], radiance, ..Frame::default() }
}

#[test]
fn a_png_has_the_pixels_of_the_screen_and_the_settings() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("picture.PNG");
    let display = Display { exposure: -1.0, tone_map: ToneMap::Aces, ..Display::default() };
    save(&frame(), display, "the settings: ρ = 0.5", &path).expect("it is saved");
    let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(&path).expect("it is there")));
    let mut reader = decoder.read_info().expect("it is a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut bytes).expect("it has pixels");
    let mut shown = Vec::new();
    to_srgb(&frame().radiance, display, &mut shown);
    let rgb: Vec<u8> = shown.iter().flat_map(|pixel| pixel[..3].to_vec()).collect();
    assert_eq!(bytes, rgb, "file and screen differ");
    assert!(reader.info().srgb.is_some());
    let text = &reader.info().utf8_text[0];
    assert_eq!((text.keyword.as_str(), text.get_text().expect("text")), (SETTINGS_KEY, "the settings: ρ = 0.5".to_owned()));
}

#[test]
fn an_exr_has_the_radiance_bit_for_bit_and_the_settings() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("picture.exr");
    save(&frame(), Display { exposure: 3.0, ..Display::default() }, "settings", &path).expect("it is saved");
    let picture = read(&path).expect("it is an EXR");
    assert_eq!((picture.width, picture.height, picture.radiance), (4, 3, frame().radiance));
    let meta = exr::meta::MetaData::read_from_file(&path, false).expect("it has a header");
    let text = meta.headers[0].own_attributes.other.get(&exr::meta::attribute::Text::from(SETTINGS_KEY));
    assert!(format!("{text:?}").contains("settings"));
}

/// 40 × 36 pixels in four blocks, with variances that differ everywhere.
fn noisy_frame() -> Frame {
    let variance: Vec<[f32; 3]> = (0..40 * 36).map(|i| [i as f32, 0.5 * i as f32, 1e-7 * i as f32]).collect();
    let noise =
        SampleNoise { width: 40, variance, blocks: vec![0.5, 0.25, 0.125, 4.0], block_degrees: 31.0, effective_samples: 1234.5 };
    let radiance = (0..40 * 36).map(|i| [i as f32, 1.0, 2.0]).collect();
    let size = Frame { width: 40, height: 36, full_resolution: [40, 36], ..Frame::default() };
    Frame { radiance, noise: Some(noise), rel_mse_estimate: Some(0.0625), ..size }
}

#[test]
fn an_exr_keeps_the_variances_of_its_means_beside_ordinary_colours() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("picture.exr");
    let settings = r#"{ "settings": { "sampler": "independent", "seed": 17 } }"#;
    save(&noisy_frame(), Display::default(), settings, &path).expect("it is saved");
    assert_eq!(read(&path).expect("it is an EXR").radiance, noisy_frame().radiance);
    let found = provenance(&path);
    assert_eq!((found.noise, found.rel_mse_estimate), (noisy_frame().noise, Some(0.0625)));
    assert_eq!((found.seed, found.is_independent), (Some(17), true));
    let meta = exr::meta::MetaData::read_from_file(&path, false).expect("it has a header");
    let names: Vec<String> = meta.headers[0].channels.list.iter().map(|channel| channel.name.to_string()).collect();
    assert_eq!((meta.headers.len(), names.join(" ")), (1, "B G R variance.B variance.G variance.R variance.block".to_owned()));
    // A varying pixel must not become exact by rounding to single precision.
    let mut dim = noisy_frame();
    if let Some(noise) = &mut dim.noise {
        noise.blocks = vec![1e-60, 0.0, 1e60, 1.0];
    }
    save(&dim, Display::default(), settings, &path).expect("it is saved");
    let blocks = provenance(&path).noise.expect("variances").blocks;
    assert!(blocks[0] > 0.0 && blocks[0] < 1e-30 && blocks[1] == 0.0 && blocks[2] > 1e30 && blocks[2].is_finite(), "{blocks:?}");
}

#[test]
fn files_without_variances_have_no_noise_estimate() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    save(&frame(), Display::default(), r#"{ "settings": { "sampler": "sobol" } }"#, &path("plain.exr")).expect("it is saved");
    save(&noisy_frame(), Display::default(), "no JSON", &path("text.exr")).expect("it is saved");
    save(&noisy_frame(), Display::default(), "{}", &path("picture.png")).expect("it is saved");
    fs::write(path("broken.exr"), &fs::read(path("text.exr")).expect("a file")[..700]).expect("it is written");
    let plain = provenance(&path("plain.exr"));
    assert!(plain.noise.is_none() && plain.rel_mse_estimate.is_none() && plain.seed.is_none() && !plain.is_independent);
    let text = provenance(&path("text.exr"));
    assert!(text.noise.is_some() && text.seed.is_none() && !text.is_independent);
    for name in ["picture.png", "broken.exr", "nowhere.exr"] {
        let found = provenance(&path(name));
        assert!(found.noise.is_none() && !found.is_independent, "{name}");
    }
}

#[test]
fn files_of_both_formats_tell_whether_they_are_denoised() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["picture.exr", "picture.png"] {
        let path = folder.path().join(name);
        let is_denoised = |settings: String| {
            save(&frame(), Display::default(), &settings, &path).expect("it is saved");
            provenance(&path).is_denoised
        };
        // The command line labels the image, and the window names the view.
        assert!(is_denoised(format!(r#"{{ "image": "{LABEL}" }}"#)), "{name}");
        assert!(is_denoised(format!(r#"{{ "view": "{}" }}"#, View::Denoised.title())), "{name}");
        assert!(!is_denoised(format!(r#"{{ "view": "{}" }}"#, View::Albedo.title())), "{name}");
        assert!(!is_denoised(format!(r#"{{ "title": "{LABEL}" }}"#)) && !is_denoised("no JSON".to_owned()), "{name}");
    }
}

#[test]
fn a_failed_write_is_reported_and_leaves_nothing_behind() {
    let folder = tempfile::tempdir().expect("a folder");
    let attempt = |path: &std::path::Path| save(&frame(), Display::default(), "", path).expect_err("it fails").to_string();
    assert!(attempt(&folder.path().join("picture.jpg")).contains(".png"));
    assert!(attempt(&folder.path().join("nowhere/picture.png")).contains("there is no folder"));
    fs::create_dir(folder.path().join("taken.png")).expect("a folder");
    assert!(attempt(&folder.path().join("taken.png")).contains("cannot be written"));
    assert_eq!(fs::read_dir(folder.path()).expect("it is there").count(), 1, "a temporary file is left");
    assert!(check_target(&folder.path().join("fine.exr")).is_ok());
    assert!(check_target(&folder.path().join("nowhere/fine.exr")).is_err());
}

#[test]
#[cfg(target_os = "linux")]
fn temporary_files_are_not_named_in_messages() {
    // Nobody can create a file there.
    let error = check_target(std::path::Path::new("/proc/picture.png")).expect_err("it fails").to_string();
    assert!(error.contains("/proc/picture.png: cannot be written") && !error.contains(".part"), "{error}");
}

#[test]
fn files_that_are_not_pictures_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["broken.png", "broken.exr"] {
        let path = folder.path().join(name);
        fs::write(&path, b"this is no image").expect("it is written");
        assert!(read(&path).expect_err("it is refused").to_string().contains(name));
    }
}

/// Both image formats can be opened in place of a scene, with their camera and settings.
#[test]
fn a_picture_opens_as_the_scene_that_it_shows() {
    use super::command_line::{Shell, json, scene, text};
    let shell = Shell::new();
    let made = [
        "--spp",
        "4",
        "--size",
        "24x16",
        "--seed",
        "9",
        "--estimator",
        "path",
        "--roulette",
        "0.5",
        "--max-bounces",
        "7",
        "--reuse",
        "off",
    ];
    for name in ["depth_of_field", "furnace", "motion_blur"] {
        for picture in ["a.png", "a.exr"] {
            let render = |from: &str, to: &str, options: &[&str]| {
                let done = shell.run(&[&["render", from, "-o", to, "--json"], options].concat());
                json(&done)
            };
            let first = render(&scene(name), picture, &made);
            let again = render(picture, "again.exr", &["--spp", "4"]);
            for key in ["width", "height", "seed", "estimator", "roulette", "max_bounces", "mean"] {
                assert_eq!(first[key], again[key], "{name} {picture}: {key}");
            }
            assert!(text(&shell.run(&["check", picture]).stdout).contains(": ok, "));
        }
        // The new image carries the scene too.
        assert!(text(&shell.run(&["check", "again.exr"]).stdout).contains("24 × 16"));
    }
    let study =
        ["study", "a.png", "-o", "study", "--spp", "2", "--estimators", "mis", "--directions", "bsdf", "--samplers", "sobol"];
    let done = shell.run(&[&study[..], &["--roulette", "throughput", "--seconds", "1000"]].concat());
    assert!(done.status.success(), "{}", text(&done.stderr));
}

#[test]
fn pictures_whose_scene_cannot_be_used_are_reported() {
    use noisefall_render::render::{Display, Frame};
    use noisefall_scene::scene::load;
    let folder = tempfile::tempdir().expect("a folder");
    let frame = Frame { width: 1, height: 1, full_resolution: [1, 1], radiance: vec![[1.0; 3]], ..Frame::default() };
    let scene = noisefall_scene::scene::built_in();
    let carried = |scene_text: &str, camera: serde_json::Value, roulette: serde_json::Value| {
        let mut settings = serde_json::json!(scene.settings);
        settings["roulette"] = roulette;
        serde_json::json!({ "scene": scene_text, "camera": camera, "settings": settings }).to_string()
    };
    let camera = || serde_json::json!(scene.camera);
    let mut blind = camera();
    blind["fov"] = 0.0.into();
    let off = || serde_json::json!("off");
    let with_texture = scene.source.replacen("[[objects]]", "[textures.a]\nimage = { path = \"b.png\" }\n[[objects]]", 1);
    for (text, says) in [
        ("{}".to_owned(), "this looks like"),
        ("no JSON".to_owned(), "this looks like"),
        (carried("format = 1\ncamera = 3", camera(), off()), "the image carries this scene"),
        (carried(&with_texture, camera(), off()), "b.png"),
        (carried(&scene.source, blind, off()), "the camera of the image cannot be used"),
        (carried(&scene.source, camera(), serde_json::json!({ "fixed": 0.0 })), "`fixed` is out of range: 0"),
    ] {
        for name in ["a.png", "a.exr"] {
            let path = folder.path().join(name);
            save(&frame, Display::default(), &text, &path).expect("it is saved");
            let report = load(&path).err().unwrap_or_else(|| panic!("{text} is used")).report();
            // Lines are wrapped behind a bar.
            let words: Vec<&str> = report.split_whitespace().filter(|word| *word != "│").collect();
            assert!(words.join(" ").contains(says), "{says}: {report}");
        }
    }
}
