//! Randomly modified files: each is a valid scene or refused.
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::SQUARE;
use crate::import::{ImportOptions, read};

const MTL: &str = "newmtl a\nKd 0.5 0.5 0.5\nKs 1 1 1\nNs 100\nNi 1.5\nd 0.5\nillum 2\nmap_Kd -s 2 2 1 -o 0 0 a.png\nnewmtl b\n\
    Pr 0.5\nPm 1\nKe 1 1 1\naniso 0.5\nTf 0.5 0.5 0.5\nillum 7\n";

fn mutated(text: &str, random: &mut SmallRng) -> Vec<u8> {
    const PIECES: [&[u8]; 10] = [b"-", b"9", b"nan", b"1e99", b"\n", b" ", b"newmtl ", b"-s ", b"../", b"\xff"];
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..random.random_range(1..5) {
        let at = random.random_range(0..=bytes.len());
        let end = (at + random.random_range(1..12)).min(bytes.len());
        match random.random_range(0..3) {
            0 => drop(bytes.drain(at..end)),
            1 => drop(bytes.splice(at..at, PIECES[random.random_range(0..PIECES.len())].iter().copied())),
            _ => bytes.extend_from_within(at..end),
        }
    }
    bytes
}

#[test]
fn libraries_that_are_mutated_make_valid_scenes() {
    let folder = tempfile::tempdir().expect("a folder");
    let (obj, mtl) = (folder.path().join("a.obj"), folder.path().join("a.mtl"));
    let text = format!("mtllib a.mtl\n{SQUARE}usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1 3 4\n");
    std::fs::write(folder.path().join("a.png"), "not looked at").expect("it is written");
    std::fs::write(&obj, text).expect("it is written");
    let mut random = SmallRng::seed_from_u64(5);
    for _ in 0..1000 {
        let library = mutated(MTL, &mut random);
        std::fs::write(&mtl, &library).expect("it is written");
        let mut scene = read(&obj, &ImportOptions::default()).expect("the mesh is valid");
        let problems = noisefall_base::declare::check(&mut scene.description);
        assert!(problems.is_empty(), "{problems:?} of {:?}", String::from_utf8_lossy(&library));
    }
}
