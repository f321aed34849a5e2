//! Mutations that keep most of the structure, so that readers get far into a file before they meet the damage.
use std::ops::Range;

use rand::{Rng, rngs::SmallRng};

use super::{
    bases::{File, Structure, glb},
    checksums, json, packed, table,
};

/// Stands for the folder above the scenes in paths.
pub const ROOT: &str = "@ROOT@";
/// A mutation that repeats parts does not make a file longer than this, bytes.
const LONGEST: usize = 1 << 18;
pub const NUMBERS: [&str; 14] = [
    "0",
    "-1",
    "1",
    "255",
    "65535",
    "2147483647",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "1e308",
    "-1e308",
    "1e-320",
    "NaN",
    "inf",
];
const PIECES: [&str; 25] = [
    "<!DOCTYPE a [<!ENTITY b \"ha\"><!ENTITY c \"&b;&b;&b;\"><!ENTITY d SYSTEM \"file:///etc/passwd\">]>",
    "&c;",
    "&d;",
    "&#0;",
    "<![CDATA[",
    "<!--",
    "<include filename=\"scene.xml\"/>",
    "<ref id=\"wood\"/>",
    "<ref id=\"group\"/>",
    "<alias id=\"wood\" as=\"glass\"/>",
    "<ref name=\"value\" id=\"wood\"/>",
    "$spp",
    "Include \"scene.pbrt\"\n",
    "Import \"part.pbrt\"\n",
    "ObjectInstance \"thing\"\n",
    "NamedMaterial \"mixed\"\n",
    "mtllib scene.obj\n",
    "usemtl \n",
    "\\\n",
    "\"",
    "\u{0}",
    "\u{feff}",
    "é",
    "]",
    "}",
];
const OPENERS: [&str; 10] = [
    "<bsdf type=\"twosided\">",
    "<shape type=\"merge\">",
    "<a>",
    "[",
    "{\"a\":",
    "(",
    "AttributeBegin\n",
    "TransformBegin\n",
    "{ a = ",
    "[[a.b]]\n",
];
const OUTSIDE: [&str; 6] =
    ["../../secret", "@ROOT@/secret", "file://@ROOT@/secret", "%2e%2e/%2e%2e/secret", "..\\..\\secret", "./../x/../../secret"];

/// Changes a file. Returns whether it now names a file outside of its folder.
pub fn mutate((_, structure, bytes): &mut File, random: &mut SmallRng) -> bool {
    match structure {
        Structure::Text => text(bytes, random),
        Structure::Json => json::mutate(bytes, random),
        Structure::Glb => container(bytes, random),
        Structure::Bytes => raw(bytes, random),
        Structure::Table => table::mutate(bytes, random),
        Structure::Serialized => packed::mutate(bytes, random),
        Structure::Sections => {
            raw(bytes, random);
            if random.random_bool(0.8) {
                checksums::of_sections(bytes);
            }
            false
        }
        Structure::Png => {
            raw(bytes, random);
            if random.random_bool(0.8) {
                checksums::of_chunks(bytes);
            }
            false
        }
    }
}

pub fn pick<T: Copy>(list: &[T], random: &mut SmallRng) -> T {
    list[random.random_range(0..list.len())]
}

/// A range of up to `most` bytes.
fn range(length: usize, most: usize, random: &mut SmallRng) -> Range<usize> {
    let start = random.random_range(0..=length);
    start..(start + random.random_range(0..=most)).min(length)
}

pub fn raw(bytes: &mut Vec<u8>, random: &mut SmallRng) -> bool {
    let some = range(bytes.len(), 32, random);
    match random.random_range(0..7) {
        0 => bytes.truncate(some.start),
        1 => drop(bytes.drain(some)),
        2 => {
            let copy = bytes[some.clone()].to_vec();
            drop(bytes.splice(some.start..some.start, copy));
        }
        3 => drop(bytes.splice(some.start..some.start, (0..some.len()).map(|_| random.random::<u8>()).collect::<Vec<_>>())),
        4 if some.start < bytes.len() => bytes[some.start] ^= 1u8 << random.random_range(0..8u32),
        _ => {
            let number = number(random);
            let at = some.start.saturating_sub(random.random_range(0..8));
            bytes.iter_mut().skip(at).zip(number).for_each(|(byte, new)| *byte = new);
        }
    }
    false
}

/// A number that is hard to add to or to multiply with, in any size and byte order.
fn number(random: &mut SmallRng) -> Vec<u8> {
    const WHOLE: [u64; 9] = [0, 1, 0x7f, 0xff, 0xffff, 0x7fff_ffff, 0xffff_ffff, 0x0fff_ffff_ffff_ffff, u64::MAX];
    const REAL: [f32; 6] = [0.0, -1.0, 1e38, -1e38, f32::INFINITY, f32::NAN];
    let mut bytes = match random.random_range(0..5) {
        0 => vec![pick(&WHOLE, random) as u8],
        1 => (pick(&WHOLE, random) as u16).to_le_bytes().to_vec(),
        2 => (pick(&WHOLE, random) as u32).to_le_bytes().to_vec(),
        3 => pick(&WHOLE, random).to_le_bytes().to_vec(),
        _ => pick(&REAL, random).to_le_bytes().to_vec(),
    };
    if random.random_bool(0.5) {
        bytes.reverse();
    }
    bytes
}

/// Words, quoted texts and signs.
fn tokens(bytes: &[u8]) -> Vec<Range<usize>> {
    let kind = |byte: u8| match byte {
        b' ' | b'\t' | b'\r' | b'\n' => 0,
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'.' | b'-' | b'+' | b'_' | 128.. => 1,
        _ => 2,
    };
    let mut tokens = Vec::new();
    let mut start = 0;
    for at in 1..=bytes.len() {
        let ends = at == bytes.len() || kind(bytes[at]) != kind(bytes[start]) || kind(bytes[start]) == 2;
        if ends {
            if kind(bytes[start]) != 0 {
                tokens.push(start..at);
            }
            start = at;
        }
    }
    tokens
}

pub fn text(bytes: &mut Vec<u8>, random: &mut SmallRng) -> bool {
    let tokens = tokens(bytes);
    if tokens.is_empty() || random.random_bool(0.15) {
        return raw(bytes, random);
    }
    let (one, other) = (pick_range(&tokens, random), pick_range(&tokens, random));
    let span = one.start.min(other.start)..one.end.max(other.end);
    match random.random_range(0..9) {
        0 => drop(bytes.drain(one)),
        1 => {
            let copy = bytes[other].to_vec();
            drop(bytes.splice(one, copy));
        }
        2 => {
            let numbers: Vec<_> = tokens.iter().filter(|token| bytes[token.start].is_ascii_digit()).cloned().collect();
            let one = if numbers.is_empty() { one } else { pick_range(&numbers, random) };
            drop(bytes.splice(one, pick(&NUMBERS, random).bytes()));
        }
        3 => drop(bytes.drain(span)),
        4 => {
            let times = (1usize << random.random_range(0..12u32)).min(LONGEST / span.len().max(1));
            let copies = bytes[span.clone()].repeat(times);
            drop(bytes.splice(span.start..span.start, copies));
        }
        5 => drop(bytes.splice(one.start..one.start, pick(&PIECES, random).bytes())),
        6 => {
            let opener = pick(&OPENERS, random);
            let deep = opener.repeat((1usize << random.random_range(0..15u32)).min(LONGEST / opener.len()));
            drop(bytes.splice(one.start..one.start, deep.bytes()));
        }
        7 => bytes.truncate(one.end),
        _ => return leave_folder(bytes, &tokens, random),
    }
    false
}

fn pick_range(list: &[Range<usize>], random: &mut SmallRng) -> Range<usize> {
    list[random.random_range(0..list.len())].clone()
}

/// A path outside of the folder with the same ending.
pub fn outside(name: &str, random: &mut SmallRng) -> Option<String> {
    let (_, ending) = name.rsplit_once('.').filter(|(start, end)| !start.is_empty() && end.chars().all(char::is_alphabetic))?;
    Some(match random.random_range(0..=OUTSIDE.len()) {
        place if place < OUTSIDE.len() => format!("{}.{ending}", OUTSIDE[place]),
        _ => format!("link.{ending}"),
    })
}

fn leave_folder(bytes: &mut Vec<u8>, tokens: &[Range<usize>], random: &mut SmallRng) -> bool {
    let name = |token: &Range<usize>| String::from_utf8_lossy(&bytes[token.clone()]).into_owned();
    let is_file =
        |token: &&Range<usize>| name(token).rsplit_once('.').is_some_and(|(_, end)| end.starts_with(char::is_alphabetic));
    let files: Vec<_> = tokens.iter().filter(is_file).cloned().collect();
    if files.is_empty() {
        return false;
    }
    let one = pick_range(&files, random);
    let path = outside(&name(&one), random);
    path.is_some_and(|path| {
        drop(bytes.splice(one, path.into_bytes()));
        true
    })
}

/// Changes the JSON or the bytes of a binary file whose chunks are whole, and otherwise any bytes.
fn container(file: &mut Vec<u8>, random: &mut SmallRng) -> bool {
    let length = |at: usize| Some(u32::from_le_bytes(file.get(at..at + 4)?.try_into().ok()?) as usize);
    let chunk = |at: usize| file.get(at + 8..(at + 8).checked_add(length(at)?)?).map(<[u8]>::to_vec);
    let chunks = chunk(12).and_then(|json| chunk(20 + json.len()).map(|bytes| (json, bytes)));
    let Some((mut json, mut bytes)) = chunks.filter(|_| random.random_bool(0.8)) else { return raw(file, random) };
    let leaves = if random.random_bool(0.7) { json::mutate(&mut json, random) } else { raw(&mut bytes, random) };
    *file = glb(&json, &bytes);
    leaves
}
