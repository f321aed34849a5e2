//! Layers of EXR files.
use std::path::Path;

use exr::prelude::{MetaData, ReadChannels, ReadLayers, read};

use crate::render::{
    Display, Frame, Series,
    image_file::{Contents, Format, read as read_image},
    layers::{Layer, LayerSources, channels, reserve},
};
use noisefall_kernel::integrator::Features;
use noisefall_scene::geometry::MISS;

fn frame() -> Frame {
    let radiance = vec![[0.5, 1.0, 2.0], [3.0, 4.0, 5.0]];
    Frame { width: 2, height: 1, full_resolution: [2, 1], radiance, spp: 7, counts: vec![7, 9], ..Frame::default() }
}

/// A surface in the first pixel, and none in the second.
fn features() -> Features {
    Features {
        width: 2,
        height: 1,
        normal: vec![[0.0, 0.6, 0.8], [0.0; 3]],
        albedo: vec![[0.1, 0.2, 0.3], [0.0; 3]],
        depth: vec![2.5, f32::INFINITY],
        position: vec![[1.0, 2.0, -3.0], [0.0; 3]],
        object: vec![4, MISS],
        material: vec![0, MISS],
        cost: vec![1.0; 2],
    }
}

fn series() -> Series {
    let mut terms = vec![vec![[0.0; 3]; 2]; 8];
    terms[0][1] = [3.0, 4.0, 5.0];
    terms[2][0] = [0.5, 1.0, 2.0];
    Series { terms, shares: Vec::new() }
}

/// A channel of a file.
fn plane(path: &Path, name: &str) -> Vec<f32> {
    let image = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes();
    let image = image.from_file(path).expect("it is an EXR");
    let channel = image.layer_data.channel_data.list.iter().find(|channel| channel.name == *name).expect("it has the channel");
    channel.sample_data.values_as_f32().collect()
}

#[test]
fn every_layer_has_its_channels_beside_the_image() {
    let (features, series) = (features(), series());
    let sources = LayerSources { features: Some(&features), series: Some(&series) };
    let (found, notes) = channels(&Layer::ALL, &frame(), &sources);
    assert!(notes.is_empty(), "{notes:?}");
    let contents = Contents { frame: &frame(), channels: &found, settings: "{}" };
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("layers.exr");
    contents.save(Display::default(), &path).expect("it is saved");
    let meta = MetaData::read_from_file(&path, false).expect("it has a header");
    let names: Vec<String> = meta.headers[0].channels.list.iter().map(|channel| channel.name.to_string()).collect();
    let expected = "Albedo.B Albedo.G Albedo.R B Bounce0.B Bounce0.G Bounce0.R Bounce1.B Bounce1.G Bounce1.R Bounce2.B Bounce2.G \
                    Bounce2.R Depth.Z G IndexMA.X IndexOB.X Normal.X Normal.Y Normal.Z Position.X Position.Y Position.Z R \
                    SampleCount.X";
    assert_eq!((meta.headers.len(), names.join(" ").as_str()), (1, expected), "bounces end with the last light");
    for (name, values) in [
        ("Depth.Z", [2.5, f32::INFINITY]),
        ("Normal.Y", [0.6, 0.0]),
        ("Position.Z", [-3.0, 0.0]),
        ("Albedo.G", [0.2, 0.0]),
        ("IndexOB.X", [5.0, 0.0]),
        ("IndexMA.X", [1.0, 0.0]),
        ("SampleCount.X", [7.0, 9.0]),
        ("Bounce0.G", [0.0, 4.0]),
        ("Bounce1.R", [0.0, 0.0]),
        ("Bounce2.B", [2.0, 0.0]),
    ] {
        assert_eq!(plane(&path, name), values, "{name}");
    }
    assert_eq!(read_image(&path).expect("it is an image").radiance, frame().radiance, "readers take the image");
    let bytes = || contents.encode(Display::default(), Format::Exr).expect("it is encoded");
    assert!(bytes() == bytes(), "the same image gives the same file");
}

#[test]
fn layers_that_an_image_lacks_are_left_out_with_a_note() {
    let nothing = Features { object: vec![MISS; 2], ..features() };
    let sources = LayerSources { features: Some(&nothing), series: None };
    let (found, notes) = channels(&Layer::ALL, &frame(), &sources);
    assert_eq!(found.iter().map(|channel| channel.name.as_str()).collect::<Vec<_>>(), ["SampleCount.X"]);
    assert_eq!(notes.len(), Layer::ALL.len() - 1);
    assert!(
        notes[0].contains("`bounces` is left out: no bounces") && notes[3].contains("`depth` is left out: the camera sees no")
    );
}

#[test]
fn the_note_of_a_layer_that_is_left_out_gives_the_true_reason() {
    let note = |layer: Layer, frame: &Frame, sources: &LayerSources| {
        let (found, notes) = channels(&[layer], frame, sources);
        assert!(found.is_empty(), "data of another image is of no use");
        notes.join("\n")
    };
    let small = Features { depth: Vec::new(), ..features() };
    let short = Series { terms: vec![Vec::new(); 8], shares: Vec::new() };
    let of_another = LayerSources { features: Some(&small), series: Some(&short) };
    let coarse = Frame { full_resolution: [4, 2], ..frame() };
    for (layer, frame, sources, reason) in [
        (Layer::Normal, frame(), of_another, "the surfaces were recorded at another resolution"),
        (Layer::Bounces, frame(), of_another, "the bounces were recorded at another resolution"),
        (Layer::Normal, frame(), LayerSources::default(), "no surfaces are recorded"),
        (Layer::Bounces, frame(), LayerSources::default(), "no bounces are recorded"),
        (Layer::Normal, Frame { full_resolution: [4, 2], ..frame() }, of_another, "the image is still coarse"),
        (Layer::Bounces, coarse, of_another, "the image is still coarse"),
    ] {
        let said = note(layer, &frame, &sources);
        assert_eq!(said, format!("the layer `{}` is left out: {reason}", layer.name()));
    }
}

#[test]
fn the_last_bounces_are_one_layer_and_a_black_image_has_the_first() {
    let mut all = series();
    all.terms[7][0] = [1.0; 3];
    let named = |series: &Series| {
        let sources = LayerSources { features: None, series: Some(series) };
        channels(&[Layer::Bounces], &frame(), &sources).0.into_iter().map(|channel| channel.name).collect::<Vec<_>>()
    };
    assert_eq!((named(&all).len(), named(&all)[21].as_str()), (24, "Bounce7AndMore.R"));
    let black = Series { terms: vec![vec![[0.0; 3]; 2]; 8], shares: Vec::new() };
    assert_eq!(named(&black), ["Bounce0.R", "Bounce0.G", "Bounce0.B"]);
}

#[test]
fn layers_that_do_not_fit_into_memory_are_refused_before_they_are_made() {
    let refused = reserve(&Layer::ALL, [1 << 30, 1 << 20]).expect_err("they do not fit").to_string();
    assert!(refused.starts_with("layers of 1073741824 × 1048576 pixels need"), "{refused}");
    assert!(reserve(&[], [1 << 30, 1 << 20]).is_ok(), "no layers need no memory");
}
