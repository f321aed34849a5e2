//! Pictures on disk.
use std::fs;

use noisefall::render::{
    Display, Frame, ToneMap,
    display::to_srgb,
    image_file::{SETTINGS_KEY, check_target, read, save},
};

fn frame() -> Frame {
    let radiance = (0..12).map(|i| [i as f32 / 12.0, 0.5, 2.0 * i as f32]).collect();
    Frame { width: 4, height: 3, full_resolution: [4, 3], radiance, ..Frame::default() }
}

#[test]
fn a_png_has_the_pixels_of_the_screen_and_the_settings() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("picture.PNG");
    let display = Display { exposure: -1.0, tone_map: ToneMap::Aces };
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

#[test]
fn what_cannot_be_written_is_said_and_leaves_nothing_behind() {
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
fn names_of_temporary_files_are_not_told() {
    // No file can be made there, whoever tries.
    let error = check_target(std::path::Path::new("/proc/picture.png")).expect_err("it fails").to_string();
    assert!(error.contains("/proc/picture.png: cannot be written") && !error.contains(".part"), "{error}");
}

#[test]
fn what_is_no_picture_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["broken.png", "broken.exr"] {
        let path = folder.path().join(name);
        fs::write(&path, b"this is no picture").expect("it is written");
        assert!(read(&path).expect_err("it is refused").to_string().contains(name));
    }
}
