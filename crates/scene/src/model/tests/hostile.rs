//! Randomly modified files: each is read or rejected, without a panic.
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{
    super::{Model, Named, decode, decode_parts},
    stl,
};
use noisefall_base::progress::Progress;

const OBJ: &str = "# a square\nv 0 0 0\nv 1 0 0 1\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\n\
    f 1/1/1 2/2/1 3/1/2 \\\n 4/2/1\ng a\nf -1//-1 -2//-2 -3//-1\nf 1 2 3\n";
const HEADER: &str = "element vertex 4\nproperty float x\nproperty double y\nproperty short z\nproperty float nx\n\
    property float ny\nproperty char nz\nproperty float s\nproperty float t\nelement tag 2\nproperty list uint uchar bytes\n\
    element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\nelement none 7\nend_header\n";

fn text_ply() -> Vec<u8> {
    let vertices = "0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n1 1 0 0 0 1 1 1\n0 1 0 0 0 0 0 1\n";
    format!("ply\nformat ascii 1.0\n{HEADER}{vertices}2 7 8\n0\n4 0 1 2 3 255\n3 0 1 2 0\n").into_bytes()
}

fn binary_ply(big_endian: bool) -> Vec<u8> {
    let name = if big_endian { "binary_big_endian" } else { "binary_little_endian" };
    let mut file = format!("ply\nformat {name} 1.0\n{HEADER}").into_bytes();
    let mut push = |little: &[u8]| {
        let mut bytes = little.to_vec();
        if big_endian {
            bytes.reverse();
        }
        file.extend(bytes);
    };
    for (x, y) in [(0u8, 0u8), (1, 0), (1, 1), (0, 1)] {
        push(&f32::from(x).to_le_bytes());
        push(&f64::from(y).to_le_bytes());
        push(&[3, 0]);
        (0..2).for_each(|_| push(&0.5f32.to_le_bytes()));
        push(&[9]);
        (0..2).for_each(|_| push(&f32::from(x).to_le_bytes()));
    }
    push(&2u32.to_le_bytes());
    (0..2).for_each(|_| push(&[7]));
    push(&0u32.to_le_bytes());
    for corners in [&[0, 1, 2, 3][..], &[3, 2, 1]] {
        push(&[corners.len() as u8]);
        corners.iter().for_each(|corner: &u32| push(&corner.to_le_bytes()));
        push(&[255]);
    }
    file
}

/// Changes, inserts, removes or repeats a few bytes, inserts typical pieces of such files, or truncates the file.
fn mutated(file: &[u8], random: &mut SmallRng) -> Vec<u8> {
    const PIECES: [&[u8]; 12] =
        [b"9", b"000000000", b"-", b" ", b"\n", b"nan", b"/", b"\\\n", b"uint", b"list ", b"\xff\xff\xff\xff", b"f "];
    let mut file = file.to_vec();
    for _ in 0..random.random_range(1..4) {
        let at = random.random_range(0..=file.len());
        let end = (at + random.random_range(1..20)).min(file.len());
        match random.random_range(0..6) {
            0 => file.truncate(at),
            1 => drop(file.drain(at..end)),
            2 => drop(file.splice(at..at, PIECES[random.random_range(0..PIECES.len())].iter().copied())),
            3 => file.extend_from_within(at..end),
            4 => file[at..end].iter_mut().take(1).for_each(|byte| *byte ^= 1 << random.random_range(0..8)),
            _ => file[at..end].iter_mut().take(1).for_each(|byte| *byte = random.random()),
        }
    }
    file
}

/// Checks what the renderer relies on.
fn check(model: &Model) {
    let count = model.vertices.len();
    assert!(!model.triangles.is_empty());
    assert!(model.triangles.as_flattened().iter().all(|vertex| (*vertex as usize) < count));
    assert!(model.vertices.as_flattened().iter().all(|x| x.is_finite()));
    if let Some(normals) = &model.normals {
        let is_unit = |n: &[f32; 3]| (n.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-5;
        assert!(normals.len() == count && normals.iter().all(is_unit));
    }
    if let Some(uvs) = &model.uvs {
        assert!(uvs.len() == count && uvs.as_flattened().iter().all(|x| x.is_finite()));
    }
}

#[test]
fn mutated_files_are_read_or_refused() {
    let files = [OBJ.as_bytes().to_vec(), text_ply(), binary_ply(false), binary_ply(true)];
    files.iter().for_each(|file| check(&decode(file, Some(Named::Obj), &Progress::default()).expect("it is a mesh")));
    let (mut random, mut read) = (SmallRng::seed_from_u64(1), 0);
    for i in 0..10_000 {
        let file = mutated(&files[i % files.len()], &mut random);
        if let Ok(model) = decode(&file, Some(Named::Obj), &Progress::default()) {
            check(&model);
            // A triangle takes 6 bytes and a vertex of its own 2 at least: nothing comes from a claim alone.
            assert!(6 * model.triangles.len() <= 4 * file.len() && model.vertices.len() <= file.len());
            read += 1;
        }
    }
    // Else the mutations would be too coarse to get anywhere.
    assert!((1000..9000).contains(&read), "{read} could be read");
}

#[test]
fn cut_files_are_read_or_refused_at_every_length() {
    for file in [OBJ.as_bytes().to_vec(), text_ply(), binary_ply(false), binary_ply(true)] {
        (0..file.len())
            .filter_map(|length| decode(&file[..length], Some(Named::Obj), &Progress::default()).ok())
            .for_each(|model| check(&model));
    }
}

#[test]
fn mutated_stl_files_are_read_or_refused() {
    let files = [stl::TEXT.as_bytes().to_vec(), stl::binary("solid by hand", &stl::SQUARE), stl::binary("", &stl::SQUARE)];
    let (mut random, mut read) = (SmallRng::seed_from_u64(2), 0);
    for i in 0..6_000 {
        let file = mutated(&files[i % files.len()], &mut random);
        if let Ok(model) = decode(&file, Some(Named::Stl), &Progress::default()) {
            check(&model);
            assert!(12 * model.triangles.len() <= file.len() && model.vertices.len() <= file.len());
            read += 1;
        }
    }
    assert!((600..5400).contains(&read), "{read} could be read");
    for file in files {
        (0..file.len())
            .filter_map(|length| decode(&file[..length], Some(Named::Stl), &Progress::default()).ok())
            .for_each(|model| check(&model));
    }
}

#[test]
fn the_parts_of_mutated_files_have_the_triangles_of_the_whole() {
    let text = OBJ.replace("f -1", "usemtl a\nmtllib b c.mtl\nf -1").replace("f 1 2 3", "usemtl b\nf 1 2 3\nusemtl a\nf 4 3 2 1");
    let (mut random, mut read) = (SmallRng::seed_from_u64(3), 0);
    for _ in 0..4_000 {
        let file = mutated(text.as_bytes(), &mut random);
        let (whole, parts) =
            (decode(&file, Some(Named::Obj), &Progress::default()), decode_parts(&file, Some(Named::Obj), &Progress::default()));
        assert_eq!(whole.as_ref().err(), parts.as_ref().err());
        let (Ok(whole), Ok(parts)) = (whole, parts) else { continue };
        parts.list.iter().for_each(|part| check(&part.model));
        let triangles: usize = parts.list.iter().map(|part| part.model.triangles.len()).sum();
        assert_eq!(triangles, whole.triangles.len());
        read += 1;
    }
    assert!((400..3600).contains(&read), "{read} could be read");
}

#[test]
fn elements_without_properties_are_not_counted_through() {
    for name in ["tristrips", "face_tags"] {
        let text = format!(
            "ply\nformat ascii 1.0\nelement {name} 18446744073709551615\nelement vertex 3\nproperty float x\nproperty float y\n\
             property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1 0 0 0 1 0 3 0 1 2\n"
        );
        assert_eq!(decode(text.as_bytes(), None, &Progress::default()).expect("it is a mesh").triangles, [[0, 1, 2]], "{name}");
    }
}
