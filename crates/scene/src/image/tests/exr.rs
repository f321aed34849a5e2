//! Channels of OpenEXR files.
use std::io::Cursor;

use ::exr::prelude::{AnyChannel, AnyChannels, FlatSamples, Image, Vec2, WritableImage, f16};

use super::{ImageFormatError, Opacity, Picture, read};
use crate::image::{Encoding, decode};

/// A file of 2 × 1 pixels with channels of these names. The value of the first one is 0.5 and 1, and each next one 1 more.
fn file(names: &[&str], half: bool) -> Vec<u8> {
    let channel = |(number, name): (usize, &&str)| {
        let values = [0.5, 1.0].map(|x| x + number as f32);
        let samples = if half { FlatSamples::F16(values.map(f16::from_f32).to_vec()) } else { FlatSamples::F32(values.to_vec()) };
        AnyChannel::new(*name, samples)
    };
    let channels = AnyChannels::sort(names.iter().enumerate().map(channel).collect());
    let mut bytes = Vec::new();
    Image::from_channels(Vec2(2, 1), channels).write().to_buffered(Cursor::new(&mut bytes)).expect("it is encoded");
    bytes
}

#[test]
fn the_channels_that_make_a_picture_are_found() {
    let colour = [0.5, 1.5, 2.5];
    for (names, expected) in [
        (&["R", "G", "B"][..], colour),
        (&["R", "G", "B", "A", "Z", "layer.R"], colour),
        (&["r", "g", "b"], colour),
        (&["R", "G"], [0.5, 1.5, 0.0]),
        (&["Y"], [0.5; 3]),
        (&["Y", "A"], [0.5; 3]),
        (&["R"], [0.5; 3]),
        (&["Z"], [0.5; 3]),
        (&["depth.V", "depth.A"], [0.5; 3]),
        (&["diffuse.R", "diffuse.G", "diffuse.B"], colour),
        (&["View.Combined.R", "View.Combined.G", "View.Combined.B", "View.AO.R", "View.AO.G", "View.AO.B"], colour),
        (&["n.X", "n.Y", "n.Z"], colour),
        (&["a.Y", "b.Z"], [0.5; 3]),
        (&["a.R", "a.G", "a.B", "Z"], colour),
    ] {
        for half in [false, true] {
            let picture = read(&file(names, half)).unwrap_or_else(|error| panic!("{names:?}: {error}"));
            assert_eq!(picture.radiance[0], expected, "{names:?}");
        }
    }
}

#[test]
fn opacity_is_that_of_the_layer() {
    let opacities = |names: &[&str]| -> Vec<f32> {
        let picture: Picture<Opacity> = decode(&mut Cursor::new(file(names, false)), Encoding::Linear).expect("it is an image");
        picture.radiance.iter().map(|Opacity(x)| *x).collect()
    };
    assert_eq!(opacities(&["A", "Y"]), [0.5, 1.0]);
    assert_eq!(opacities(&["d.A", "d.R", "d.G", "d.B"]), [0.5, 1.0]);
    assert_eq!(opacities(&["A", "d.R", "d.G", "d.B"]), [1.0, 1.0]);
}

#[test]
fn files_without_a_picture_are_refused_by_the_names_of_their_channels() {
    let Err(ImageFormatError::Unreadable(reason)) = read(&file(&["U", "V"], false)) else { panic!("it is read") };
    assert!(reason.contains("`U`, `V`") && reason.contains("R, G and B"), "{reason}");
}
