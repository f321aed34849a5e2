//! A file that is damaged in any way is read as it was written, or refused with a reason.
use std::io::Cursor;

use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::*;
use noisefall_scene::scene::built_in;

const TILE: Tag = Tag(*b"TEST");

fn header() -> Header {
    let scene = built_in();
    Header {
        kind: Kind::Progress,
        program: Header::PROGRAM.to_owned(),
        scene: CheckpointScene { text: scene.source.clone(), name: "a.toml".to_owned(), folder: "/".to_owned(), choices: None },
        camera: scene.camera,
        settings: scene.settings,
        target: Target { noise: Some(0.01), ..Target::default() },
        files: Vec::new(),
        probe: vec![(0, sha256(b"radiance"))],
        counters: Counters { seconds: 0.1 + 0.2, ..Counters::default() },
        samples: Vec::new(),
        image: None,
        remarks: Vec::new(),
    }
}

fn file() -> Vec<u8> {
    let mut writer = Writer::new(Vec::new(), &header()).expect("it is written");
    for number in 0..3u32 {
        let values = [f64::from(number), 0.1];
        writer.section(&Encoded::new(TILE, 20, |to| (number.encode(to), values.encode(to)).1)).expect("it is written");
    }
    writer.finish().expect("it is written")
}

/// The numbers in the sections.
fn read(bytes: &[u8]) -> Result<Vec<u32>, RenderFileError> {
    let mut reader = Reader::new(Cursor::new(bytes))?;
    assert_eq!(*reader.header(), header());
    let mut numbers = Vec::new();
    while let Some((tag, payload)) = reader.section()? {
        assert_eq!(tag, TILE);
        let mut fields = Fields::of(payload);
        numbers.push(fields.take()?);
        assert_eq!(fields.list::<f64>(2)?, [f64::from(numbers[numbers.len() - 1]), 0.1]);
        fields.end()?;
    }
    assert!(reader.section()?.is_none(), "the end stays the end");
    Ok(numbers)
}

#[test]
fn a_file_is_read_as_it_was_written() {
    assert_eq!(read(&file()).expect("it is whole"), [0, 1, 2]);
}

#[test]
fn a_file_that_is_cut_off_anywhere_says_so() {
    let whole = file();
    for length in 0..whole.len() {
        let error = read(&whole[..length]).expect_err("it is cut off").to_string();
        let expected = if length < 4 { "not a render file" } else { "cut off" };
        assert!(error.contains(expected), "{length}: {error}");
    }
}

#[test]
fn a_bit_that_flips_anywhere_is_noticed() {
    let whole = file();
    let mut random = SmallRng::seed_from_u64(1);
    for _ in 0..3000 {
        let mut flipped = whole.clone();
        let at = random.random_range(0..flipped.len());
        flipped[at] ^= 1u8 << random.random_range(0..8u32);
        assert!(read(&flipped).is_err(), "byte {at}");
    }
}

#[test]
fn other_files_versions_and_transfers_are_told_apart() {
    let told = |bytes: &[u8]| read(bytes).expect_err("it is refused").to_string();
    assert!(told(b"\x89PNG\r\n\x1a\n and more").contains("not a render file"));
    assert!(told(b"").contains("not a render file"));
    let mut newer = file();
    newer[8..12].copy_from_slice(&7u32.to_le_bytes());
    assert!(told(&newer).contains("version 7 of the format, and this program reads version 1"));
    let as_text: Vec<u8> = file().into_iter().filter(|byte| *byte != b'\r').collect();
    assert!(told(&as_text).contains("a transfer as text"));
    let mut longer = file();
    longer.extend_from_slice(b"more");
    assert!(told(&longer).contains("4 bytes follow its end"));
}

#[test]
fn sections_that_were_left_out_are_missed() {
    let mut writer = Writer::new(Vec::new(), &header()).expect("it is written");
    let section = Encoded::new(TILE, 20, |to| (0u32.encode(to), [0.0f64, 0.1].encode(to)).1);
    writer.section(&section).expect("it is written");
    let mut whole = writer.finish().expect("it is written");
    let end = whole.len() - (BEFORE + AFTER) as usize - 8;
    whole.drain(end - section.bytes().len()..end);
    assert!(read(&whole).expect_err("one is missing").to_string().contains("1 of its 2 sections"));
}

#[test]
fn lengths_are_compared_with_the_file_before_anything_is_allocated() {
    let mut huge = file();
    let length = START as usize + 4;
    huge[length..length + 8].copy_from_slice(&(1u64 << 60).to_le_bytes());
    assert!(matches!(read(&huge), Err(RenderFileError::CutOff(_))));
    assert!(Fields::of(&[0; 8]).list::<f64>(usize::MAX).is_err());
    assert!(Fields::of(&[0; 8]).list::<f64>(2).is_err());
    assert!(Fields::of(&[0; 8]).end().is_err());
}
