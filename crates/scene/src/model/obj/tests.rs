//! Chunks: the result does not depend on their size.
use super::{super::ModelFormatError, Faces, Lists, text::Chunks};
use noisefall_base::{
    memory::Reservation,
    progress::{Cancelled, Progress},
};

const TEXT: &str = "# a comment \\\nv 0 0 0 1 0 0\nv 1 0 0\\\n\\\n\n\n 0.5 0.5 0.5\nv 1 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nf -1 -2 \\\n-3\nusemtl a\nv 0 1 0\n\
    v 2 2 2 0 1 0\nf 1/1 2/2 3/-1 4/-2 5/1\nvn 1 0 0\nf 1//-1 2//-2 -1//1\nusemtl b\nmtllib c\nf 5 4 3\n";

/// Everything that chunks of a size hold, as text.
fn read(text: &str, size: usize) -> String {
    let progress = Progress::default();
    let chunks = Chunks::of(text, size, &progress);
    assert_eq!(chunks.list.concat(), text);
    let mut room = Reservation::none();
    let (lists, before) = match Lists::read(&chunks, &mut room) {
        Ok(read) => read,
        Err(error) => return error.to_string(),
    };
    let faces = match Faces::read(&chunks, &lists, &before, &mut room) {
        Ok(faces) => faces,
        Err(error) => return error.to_string(),
    };
    let Lists { places, uvs, normals, colours } = &lists;
    let corners: Vec<[u32; 3]> = faces.corners.iter().map(|corner| [corner.place, corner.uv, corner.normal]).collect();
    let switches: Vec<_> = faces.switches.iter().map(|of| (of.material, of.corner, of.triangle, of.polygon)).collect();
    let Faces { triangles, polygons, libraries, .. } = &faces;
    format!("{places:?}{uvs:?}{normals:?}{colours:?}{corners:?}{triangles:?}{polygons:?}{switches:?}{libraries:?}")
}

#[test]
fn chunks_of_any_size_are_the_same() {
    let whole = read(TEXT, TEXT.len());
    assert!(whole.contains("\"b\""), "{whole}");
    for size in 0..TEXT.len() {
        assert_eq!(read(TEXT, size), whole, "{size} bytes");
        assert_eq!(read(&TEXT.replace('\n', "\r"), size), whole, "{size} bytes");
        assert_eq!(read(&TEXT.replace('\n', "\r\n"), size), whole, "{size} bytes");
    }
}

#[test]
fn errors_have_the_line_of_the_file() {
    for broken in ["f 1 2 9", "v 0 0", "f 1 2 -9", "vn x"] {
        let text = TEXT.replace("usemtl b", broken) + "f 1 2\n";
        let whole = read(&text, text.len());
        assert!(whole.starts_with("line 20: "), "{whole}");
        (0..text.len()).for_each(|size| assert_eq!(read(&text, size), whole, "{size} bytes"));
    }
}

#[test]
fn reading_ends_when_it_is_cancelled() {
    let progress = Progress::default();
    assert!(super::decode(TEXT.as_bytes(), &progress).is_ok());
    progress.cancel();
    assert_eq!(super::decode(TEXT.as_bytes(), &progress), Err(ModelFormatError::Cancelled(Cancelled)));
}
