//! Hand-made image files, byte by byte.
mod exr;
mod pfm;

use std::io::Cursor;

use super::{Encoding, ImageFormatError, Opacity, Picture, Texels, check_length, check_unpacked, decode, read_opacity_of};
use noisefall_base::declare::Resources;

fn read(bytes: &[u8]) -> Result<Picture, ImageFormatError> {
    decode(&mut Cursor::new(bytes), Encoding::Linear)
}

fn hdr(header: &str, pixels: &[u8]) -> Vec<u8> {
    [header.as_bytes(), pixels].concat()
}

fn png(width: u32, height: u32, colour: png::ColorType, depth: png::BitDepth, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(data).expect("data");
    writer.finish().expect("an end");
    bytes
}

const HEADER: &str = "#?RADIANCE\n# by hand\nFORMAT=32-bit_rle_rgbe\n";

#[test]
fn a_plain_hdr_has_its_mantissas_times_powers_of_two() {
    let bytes = hdr(&format!("{HEADER}EXPOSURE=2\n\n-Y 2 +X 1\n"), &[128, 64, 0, 129, 7, 7, 7, 0]);
    let picture = read(&bytes).expect("it is an image");
    assert_eq!((picture.width, picture.height), (1, 2));
    assert_eq!(picture.radiance, [[0.5, 0.25, 0.0], [0.0; 3]]);
    // Spaces around values do not count, factors are multiplied, and may be small.
    let bytes = hdr("#?RADIANCE\nFORMAT= 32-bit_rle_rgbe \nEXPOSURE=0.5\nEXPOSURE= 0.25 \n\n-Y 1 +X 1\n", &[128, 64, 0, 129]);
    assert_eq!(read(&bytes).expect("it is an image").radiance, [[8.0, 4.0, 0.0]]);
}

#[test]
fn old_runs_repeat_a_pixel() {
    let pixels = [128, 128, 128, 129, 1, 1, 1, 2, 64, 64, 64, 129, 1, 1, 1, 3, 1, 1, 1, 1];
    let picture = read(&hdr(&format!("{HEADER}\n-Y 1 +X 263\n"), &pixels)).expect("it is an image");
    let greys: Vec<f32> = picture.radiance.iter().map(|pixel| pixel[0]).collect();
    assert_eq!(greys, [vec![1.0; 3], vec![0.5; 260]].concat());
}

#[test]
fn new_runs_fill_channel_by_channel() {
    let row = [&[2, 2, 0, 8][..], &[136, 128], &[4, 0, 64, 128, 192, 132, 32], &[136, 0], &[136, 129]].concat();
    let picture = read(&hdr(&format!("{HEADER}\n-Y 2 +X 8\n"), &row.repeat(2))).expect("it is an image");
    let greens = [0.0, 0.5, 1.0, 1.5, 0.25, 0.25, 0.25, 0.25].repeat(2);
    assert_eq!(picture.radiance, greens.into_iter().map(|green| [1.0, green, 0.0]).collect::<Vec<_>>());
}

#[test]
fn hdrs_are_upright_whatever_the_order_of_their_pixels() {
    // Two rows of three, as greys: 1 2 3 above 4 5 6.
    for (size, order) in [
        ("-Y 2 +X 3", [1, 2, 3, 4, 5, 6]),
        ("-Y 2 -X 3", [3, 2, 1, 6, 5, 4]),
        ("+Y 2 +X 3", [4, 5, 6, 1, 2, 3]),
        ("+Y 2 -X 3", [6, 5, 4, 3, 2, 1]),
        ("+X 3 -Y 2", [1, 4, 2, 5, 3, 6]),
        ("-X 3 -Y 2", [3, 6, 2, 5, 1, 4]),
        ("+X 3 +Y 2", [4, 1, 5, 2, 6, 3]),
        ("-X 3 +Y 2", [6, 3, 5, 2, 4, 1]),
    ] {
        let pixels: Vec<u8> = order.iter().flat_map(|grey| [2 * grey, 2 * grey, 2 * grey, 135]).collect();
        let picture = read(&hdr(&format!("{HEADER}\n{size}\n"), &pixels)).expect("it is an image");
        let greys: Vec<f32> = picture.radiance.iter().map(|pixel| pixel[0]).collect();
        assert_eq!((picture.width, picture.height, greys), (3, 2, vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), "{size}");
    }
}

#[test]
fn broken_hdrs_are_refused() {
    let refuses = |header: &str, pixels: &[u8], reason: &str| {
        let error = read(&hdr(header, pixels)).expect_err("it is broken").to_string();
        assert!(error.contains(reason), "{error}");
    };
    let sized = |size: &str| format!("{HEADER}\n{size}\n");
    refuses(&sized("-Y 1 +X 2"), &[1, 2, 3, 4, 5], "ends within its pixels");
    refuses(&sized("-Y 1 +X 2"), &[1, 1, 1, 1, 5, 5, 5, 5], "a run leaves");
    refuses(&sized("-Y 1 +X 2"), &[5, 5, 5, 5, 1, 1, 1, 9], "a run leaves");
    refuses(&sized("-Y 1 +X 8"), &[2, 2, 0, 8, 137, 1], "a run leaves");
    refuses(&sized("-Y 1 +X 8"), &[2, 2, 0, 8, 0], "a run leaves");
    refuses(&sized("-Y 1 +X 8"), &[2, 2, 0, 9, 136, 1], "another width");
    for size in ["+X 8 -X 1", "-Y 1", "-Y 1 +X 8 1", "Y 1 X 8", "-Y 1 +Z 8", "-Y 1 +X eight"] {
        refuses(&sized(size), &[], "not such as `-Y height +X width`");
    }
    refuses(&sized("-Y 0 +X 8"), &[], "no pixels");
    refuses(&sized("-Y 60000 +X 8"), &[], "8 × 60000");
    refuses(&sized("-Y 16384 +X 16384"), &[], "16384 × 16384");
    refuses("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n", &[], "32-bit_rle_xyze");
    refuses("#?RADIANCE\nEXPOSURE=0\n\n", &[], "is not a factor");
    refuses("#?RADIANCE\n", &[], "within its header");
    refuses(&format!("#?{}", "x".repeat(10_000)), &[], "within its header");
}

#[test]
fn pngs_of_any_depth_and_channels_are_read() {
    use png::{BitDepth, ColorType};
    let radiance = |bytes: &[u8]| read(bytes).expect("it is an image").radiance;
    assert_eq!(radiance(&png(1, 1, ColorType::Rgba, BitDepth::Eight, &[255, 0, 51, 7])), [[1.0, 0.0, 0.2]]);
    assert_eq!(radiance(&png(1, 1, ColorType::GrayscaleAlpha, BitDepth::Eight, &[51, 0])), [[0.2; 3]]);
    assert_eq!(radiance(&png(2, 1, ColorType::Grayscale, BitDepth::One, &[0b0100_0000])), [[0.0; 3], [1.0; 3]]);
    assert_eq!(radiance(&png(1, 1, ColorType::Rgb, BitDepth::Sixteen, &[0, 1, 255, 255, 0, 0])), [[1.0 / 65535.0, 1.0, 0.0]]);
    let grey: Result<Picture, ImageFormatError> =
        decode(&mut Cursor::new(png(1, 1, ColorType::Grayscale, BitDepth::Eight, &[188])), Encoding::Srgb);
    assert!((grey.expect("it is an image").radiance[0][1] - 0.502_886).abs() < 1e-6);
}

#[test]
fn opacity_is_linear_and_1_without_a_channel() {
    use png::{BitDepth, ColorType};
    let opacities = |bytes: &[u8]| -> Vec<f32> {
        let picture: Picture<Opacity> = decode(&mut Cursor::new(bytes), Encoding::Srgb).expect("it is an image");
        picture.radiance.iter().map(|Opacity(x)| *x).collect()
    };
    assert_eq!(opacities(&png(2, 1, ColorType::Rgba, BitDepth::Eight, &[255, 0, 51, 51, 1, 2, 3, 255])), [0.2, 1.0]);
    assert_eq!(opacities(&png(1, 1, ColorType::GrayscaleAlpha, BitDepth::Sixteen, &[255, 255, 51, 51])), [0.2]);
    assert_eq!(opacities(&png(1, 1, ColorType::Rgb, BitDepth::Eight, &[1, 2, 3])), [1.0]);
    assert_eq!(opacities(&png(1, 1, ColorType::Grayscale, BitDepth::Eight, &[1])), [1.0]);
    assert_eq!(opacities(&hdr(&format!("{HEADER}\n-Y 1 +X 1\n"), &[128, 64, 0, 129])), [1.0]);
}

#[test]
fn the_opacity_of_an_exr_is_read_as_grey_within_its_range() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.exr");
    let opacity = [0.25, 7.0, -1.0, f32::NAN];
    ::exr::prelude::write_rgba_file(&path, 4, 1, |x, _| (0.5f32, 0.5f32, 0.5f32, opacity[x])).expect("it is written");
    let texels = read_opacity_of(&Resources::new("").file(&path.display().to_string())).expect("it is an image");
    let greys = [0.25, 1.0, 0.0, 0.0].map(|x: f32| [x, x, x, 0.0]);
    assert_eq!((texels.width, texels.height, texels.radiance), (4, 1, greys.to_vec()));
    assert_eq!(super::read_light(&path, Encoding::Srgb).expect("it is light").radiance[3], [0.5, 0.5, 0.5, 0.0]);
}

#[test]
fn an_exr_whose_tiles_are_much_larger_than_the_image_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.exr");
    ::exr::prelude::write_rgba_file(&path, 4, 1, |_, _| (0.5f32, 0.5f32, 0.5f32, 1.0f32)).expect("it is written");
    let mut bytes = std::fs::read(&path).expect("it is there");
    let name = b"tiles\0tiledesc\0";
    let at = bytes.windows(name.len()).position(|window| window == name).expect("it has tiles") + name.len() + 4;
    // The highest byte of the width.
    bytes[at + 3] = 0x10;
    let Err(error) = decode::<[f32; 4]>(&mut Cursor::new(bytes), Encoding::Srgb) else { panic!("it is read") };
    assert!(error.to_string().contains("tiles of 268435520 × 64 pixels"), "{error}");
}

/// 3 × 2 pixels of 10, 20, … 60, in the passes of Adam7.
#[rustfmt::skip]
const IN_PASSES: [u8; 75] = [
    137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0, 3, 0, 0, 0, 2,
    8, 0, 0, 0, 1, 207, 24, 9, 80, 0, 0, 0, 18, 73, 68, 65, 84, 120, 218, 99, 224, 98, 144, 99,
    16, 97, 208, 48, 178, 1, 0, 2, 178, 0, 211, 229, 163, 165, 171, 0, 0, 0, 0, 73, 69, 78, 68, 174,
    66, 96, 130,
];

#[test]
fn pngs_in_passes_are_read() {
    let greys: Vec<f32> = read(&IN_PASSES).expect("it is an image").radiance.iter().map(|pixel| pixel[1] * 255.0).collect();
    let expected = [10.0, 20.0, 30.0, 40.0, 50.0, 60.0];
    assert!(greys.len() == 6 && greys.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-4), "{greys:?}");
    assert!(matches!(read(&IN_PASSES[..IN_PASSES.len() - 30]), Err(ImageFormatError::Unreadable(_))));
}

/// Four columns of colours, two rows.
const COLOURS: [u8; 24] = [255, 0, 51, 0, 0, 0, 102, 102, 102, 255, 255, 255, 1, 2, 3, 4, 5, 6, 250, 251, 252, 51, 0, 255];

/// The colours as linear numbers, row by row.
fn colours() -> Vec<[f32; 3]> {
    COLOURS.chunks(3).map(|rgb| [0, 1, 2].map(|i| (f64::from(rgb[i]) / 255.0) as f32)).collect()
}

#[test]
fn formats_without_loss_are_read_as_they_were_written() {
    use ::image::{ExtendedColorType::Rgb8, ImageEncoder, codecs::tga::TgaEncoder, codecs::webp::WebPEncoder};
    let (mut tga, mut webp) = (Vec::new(), Vec::new());
    TgaEncoder::new(&mut tga).write_image(&COLOURS, 4, 2, Rgb8).expect("a TGA");
    WebPEncoder::new_lossless(&mut webp).write_image(&COLOURS, 4, 2, Rgb8).expect("a WebP");
    let linear = colours();
    for bytes in [&tga, &webp] {
        let picture = read(bytes).expect("it is an image");
        assert_eq!((picture.width, picture.height, &picture.radiance), (4, 2, &linear));
        let curved: Picture = decode(&mut Cursor::new(bytes), Encoding::Srgb).expect("it is an image");
        assert!((curved.radiance[2][0] - 0.132_868).abs() < 1e-6, "{:?}", curved.radiance[2]);
        assert!(matches!(read(&bytes[..bytes.len() / 2]), Err(ImageFormatError::Unreadable(_))), "the file is cut");
    }
    // Bottom-up TGAs begin with the last row.
    tga[17] ^= 1 << 5;
    assert_eq!(read(&tga).expect("it is an image").radiance, [&linear[4..], &linear[..4]].concat());
}

#[test]
fn jpegs_are_read() {
    use ::image::{
        ExtendedColorType::{L8, Rgb8},
        codecs::jpeg::JpegEncoder,
    };
    let encoded = |data: &[u8], colour| {
        let mut bytes = Vec::new();
        JpegEncoder::new_with_quality(&mut bytes, 100).encode(data, 16, 16, colour).expect("a JPEG");
        bytes
    };
    let colour = encoded(&[204, 102, 51].repeat(256), Rgb8);
    let grey = encoded(&[102; 256], L8);
    for (bytes, expected) in [(&colour, [0.8, 0.4, 0.2]), (&grey, [0.4; 3])] {
        let picture = read(bytes).expect("it is an image");
        assert_eq!((picture.width, picture.height, picture.radiance.len()), (16, 16, 256));
        // The colour transform rounds to whole codes.
        let is_near = |pixel: &[f32; 3]| (0..3).all(|i| (pixel[i] - expected[i]).abs() <= 2.0 / 255.0);
        assert!(picture.radiance.iter().all(is_near), "{:?}", picture.radiance[0]);
    }
    assert!(matches!(read(&colour[..20]), Err(ImageFormatError::Unreadable(_))));
    // The size stands behind the marker of the frame, height first.
    let frame = colour.windows(2).position(|marker| marker == [0xff, 0xc0]).expect("a frame");
    let mut wide = colour.clone();
    wide[frame + 7..frame + 9].copy_from_slice(&60_000u16.to_be_bytes());
    assert_eq!(read(&wide), Err(ImageFormatError::TooLarge(60_000, 16)));
}

#[test]
fn other_files_are_not_taken_for_a_tga() {
    let mut header = [0; 18];
    (header[2], header[12], header[14], header[16]) = (2, 1, 1, 24);
    assert!(matches!(read(&header), Err(ImageFormatError::Unreadable(_))), "a TGA without pixels");
    for (at, value) in [(1, 2), (2, 0), (2, 4), (2, 12), (16, 7), (16, 64)] {
        let mut other = header;
        other[at] = value;
        assert_eq!(read(&other), Err(ImageFormatError::NotAPicture), "{value} at {at}");
    }
    assert_eq!(read(&header[..17]), Err(ImageFormatError::NotAPicture));
    header[13] = 0xff;
    assert_eq!(read(&header), Err(ImageFormatError::TooLarge(0xff01, 1)));
}

#[test]
fn texels_are_the_same_colours_and_nothing_else() {
    let bytes = hdr(&format!("{HEADER}\n-Y 1 +X 2\n"), &[128, 64, 0, 129, 7, 7, 7, 0]);
    let texels: Picture<[f32; 4]> = decode(&mut Cursor::new(bytes), Encoding::Linear).expect("it is an image");
    assert_eq!(texels.radiance, [[1.0, 0.5, 0.0, 0.0], [0.0; 4]]);
    let picture = Picture { width: 2, height: 1, radiance: vec![[1.0, 0.5, 0.0], [0.0; 3]] };
    let copied = Texels::from(&picture);
    assert_eq!((copied.width, copied.height, copied.radiance), (2, 1, texels.radiance));
}

#[test]
fn sizes_are_refused_by_the_header_alone() {
    let header = |width: u32, height: u32| {
        let mut bytes = png(1, 1, png::ColorType::Grayscale, png::BitDepth::Eight, &[0]);
        bytes[16..20].copy_from_slice(&width.to_be_bytes());
        bytes[20..24].copy_from_slice(&height.to_be_bytes());
        bytes.truncate(24);
        read(&bytes)
    };
    assert_eq!(header(60_000, 1), Err(ImageFormatError::TooLarge(60_000, 1)));
    assert_eq!(header(0, 4), Err(ImageFormatError::Empty(0, 4)));
    assert_eq!(header(u32::MAX, u32::MAX), Err(ImageFormatError::TooLarge(u32::MAX.into(), u32::MAX.into())));
    assert!(matches!(header(1, 1), Err(ImageFormatError::Unreadable(_))));
    assert_eq!(read(b"GIF89a"), Err(ImageFormatError::NotAPicture));
    assert_eq!(read(b""), Err(ImageFormatError::NotAPicture));
}

#[test]
fn a_bmp_has_its_rows_from_the_bottom() {
    let header = |size: u32| [&b"BM"[..], &size.to_le_bytes(), &[0; 4], &54u32.to_le_bytes(), &40u32.to_le_bytes()].concat();
    let shape = [1u32.to_le_bytes(), 2u32.to_le_bytes()].concat();
    let rest = [&[1, 0, 24, 0][..], &[0; 24]].concat();
    // Blue, green, red, and a byte that fills the row.
    let rows = [0, 0, 255, 0, 255, 0, 0, 0];
    let bytes = [header(62), shape, rest, rows.to_vec()].concat();
    assert_eq!(read(&bytes).expect("it is an image").radiance, [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
    assert!((0..bytes.len() - 1).all(|end| read(&bytes[..end]).is_err()));
}

#[test]
fn headers_that_claim_more_pixels_than_the_file_can_hold_are_refused() {
    let mut file = png(1, 1, png::ColorType::Grayscale, png::BitDepth::One, &[0]);
    // The checksum of the chunk is wrong too, but the decoder would allocate first.
    file[16..24].copy_from_slice(&[0, 0, 0x20, 0, 0, 0, 0x20, 0]);
    assert!(read(&file).is_err());
    let tall = read(&hdr(&format!("{HEADER}\n-Y 16384 +X 8\n"), &[])).expect_err("it has no pixels");
    assert!(tall.to_string().contains("ends within its pixels"), "{tall}");
    assert!(check_length(8256, 1, 1).is_ok() && check_length(8257, 1, 1).is_err());
}

#[test]
fn small_files_do_not_unpack_to_gigabytes() {
    // Flat images of half a gigabyte can be tiny; larger ones need bytes.
    assert!(check_unpacked(8192, 4096, 1).is_ok() && check_unpacked(8192, 4098, 1).is_err());
    assert!(check_unpacked(16_384, 8192, 12 << 20).is_ok() && check_unpacked(16_384, 8192, 9 << 20).is_err());
    // Each format that packs pixels, at the limits of its size.
    let [width, height] = [16_384u16, 8192];
    let mut hdr = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes();
    hdr.resize(4 * usize::from(height) + hdr.len(), 0);
    let mut tga = vec![0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    tga.extend([width.to_le_bytes(), height.to_le_bytes()].concat());
    tga.extend([24, 0]);
    tga.extend([255u8, 1, 2, 3].repeat(1 << 20));
    let mut bmp = b"BM".to_vec();
    bmp.extend([0u32, 0, 14 + 40 + 1024, 40, width.into(), height.into()].iter().flat_map(|word| word.to_le_bytes()));
    bmp.extend([1u16, 8].iter().flat_map(|word| word.to_le_bytes()));
    bmp.extend([1u32, 0, 0, 0, 256, 0].iter().flat_map(|word| word.to_le_bytes()));
    bmp.resize(bmp.len() + 1024, 7);
    bmp.extend([255u8, 9].repeat(1 << 19));
    for (name, bytes) in [("HDR", hdr), ("TGA", tga), ("BMP", bmp)] {
        let error = decode::<[f32; 3]>(&mut Cursor::new(&bytes[..]), Encoding::Srgb).expect_err("it is dense").to_string();
        assert!(error.contains("16384 × 8192 pixels are packed into"), "{name}: {error}");
    }
}
