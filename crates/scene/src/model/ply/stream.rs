//! Binary files of fixed rows, decoded while they are read: the bytes of the file are never in memory all at once.
use std::io::{Read, Seek, SeekFrom};

use super::{
    super::{Model, ModelFormatError},
    bulk::{self, BLOCK, Rows},
    header::{Element, Encoding, Header, Layout, is_ply},
    slots::{Slots, reserve_vertices, slots},
    values::{Binary, Values},
};
use noisefall_base::{memory::Reservation, progress::Progress};

/// Headers that are longer are read with the whole file.
const LONGEST_HEADER: u64 = 1 << 16;

/// Reads a file from its beginning. `None` if it must be read as a whole, which also finds the place of an error.
pub fn read(file: &mut (impl Read + Seek), length: u64, progress: &Progress) -> Result<Option<Model>, ModelFormatError> {
    in_blocks(file, length, BLOCK, progress)
}

/// Reads a file in blocks of `block` bytes.
fn in_blocks(
    file: &mut (impl Read + Seek),
    length: u64,
    block: usize,
    progress: &Progress,
) -> Result<Option<Model>, ModelFormatError> {
    let mut start = Vec::new();
    file.by_ref().take(LONGEST_HEADER).read_to_end(&mut start)?;
    let Some(header) = is_ply(&start).then(|| Header::read(&start).ok()).flatten() else { return Ok(None) };
    let Encoding::Binary { big_endian } = header.encoding else { return Ok(None) };
    if !header.elements.iter().all(is_of_rows) {
        return Ok(None);
    }
    file.seek(SeekFrom::Start(header.end as u64))?;
    let mut rows = Rows::new(file, length.saturating_sub(header.end as u64), block);
    if big_endian {
        elements::<Binary<true>>(&header, &mut rows, progress)
    } else {
        elements::<Binary<false>>(&header, &mut rows, progress)
    }
}

/// Whether the element is vertices without lists, triangles, or nothing.
fn is_of_rows(element: &Element) -> bool {
    match element.name.as_str() {
        _ if element.properties.is_empty() => true,
        "vertex" => element.properties.iter().all(|property| matches!(property.layout, Layout::One(_))),
        "face" => bulk::polygons(element).is_some(),
        _ => false,
    }
}

fn elements<V: Values>(header: &Header, rows: &mut Rows, progress: &Progress) -> Result<Option<Model>, ModelFormatError> {
    let mut model = Model::default();
    let mut room = Reservation::none();
    let vertices = header.element("vertex").map_or(0, |element| element.count);
    for element in header.elements.iter().filter(|element| !element.properties.is_empty()) {
        // Memory is reserved, and allocated, only for what the file can hold.
        let least: usize = element.properties.iter().map(|property| property.layout.head().size()).sum();
        if element.count.saturating_mul(least as u64) > rows.bytes.limit() {
            return Ok(None);
        }
        if element.name == "vertex" {
            let slots: Slots = slots(element);
            reserve_vertices(element, &slots, &mut room)?;
            let Some(found) = bulk::vertices::<V>(element, &slots, rows, progress)? else { return Ok(None) };
            model = Model { triangles: model.triangles, ..found };
        } else {
            room.grow(format_args!("{} triangles", element.count), (size_of::<[u32; 3]>() as u64).saturating_mul(element.count))?;
            let Some(found) = bulk::triangles::<V>(element, vertices, rows, progress)? else { return Ok(None) };
            model.triangles = found;
        }
    }
    Ok(Some(model))
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::{super::decode, *};

    /// A strip of triangles, with a normal and a colour per vertex.
    fn file(big_endian: bool, index: &str) -> Vec<u8> {
        let (format, count) = (if big_endian { "big" } else { "little" }, 30i32);
        let numbers = ["double x", "double y", "double z", "float nx", "float ny", "float nz", "uchar red", "uchar green"];
        let properties: String = numbers.iter().chain(&["uchar blue"]).map(|name| format!("property {name}\n")).collect();
        let faces = count - 2;
        let header = format!(
            "ply\nformat binary_{format}_endian 1.0\nelement nothing 9\nelement vertex {count}\n{properties}element face {faces}\n\
             property list uchar {index} vertex_indices\nend_header\n"
        );
        let mut file = header.into_bytes();
        let mut push = |little: &[u8]| match big_endian {
            true => file.extend(little.iter().rev()),
            false => file.extend(little),
        };
        for i in 0..count {
            let x = f64::from(i);
            [x, (x * 0.7).sin(), x * x].iter().for_each(|x| push(&x.to_le_bytes()));
            [0.0, 0.6f32, 0.8].iter().for_each(|x| push(&x.to_le_bytes()));
            [i, 255 - i, 7].iter().for_each(|x| push(&[*x as u8]));
        }
        for i in 0..faces {
            push(&[3]);
            let corners = [i, i + 1, i + 2];
            corners.iter().for_each(|corner| if index == "int" { push(&corner.to_le_bytes()) } else { push(&[*corner as u8]) });
        }
        file
    }

    fn streamed(bytes: &[u8], block: usize) -> Result<Option<Model>, ModelFormatError> {
        in_blocks(&mut Cursor::new(bytes), bytes.len() as u64, block, &Progress::default())
    }

    #[test]
    fn blocks_of_any_size_give_the_same_mesh() {
        for (big_endian, index) in [(false, "int"), (true, "int"), (false, "uchar")] {
            let bytes = file(big_endian, index);
            let whole = decode(&bytes, &Progress::default()).expect("it is a mesh");
            assert_eq!((whole.vertices[4][0], whole.triangles[27], whole.colours.is_some()), (4.0, [27, 28, 29], true));
            for block in 0..bytes.len() {
                assert_eq!(streamed(&bytes, block), Ok(Some(whole.clone())), "{block} bytes");
            }
        }
    }

    #[test]
    fn broken_files_are_left_to_the_reader_of_values() {
        let bytes = file(false, "int");
        assert!((0..bytes.len()).all(|length| streamed(&bytes[..length], 64) == Ok(None)));
        let mut broken = bytes.clone();
        // The last corner.
        broken[bytes.len() - 1] = 0xff;
        assert_eq!(streamed(&broken, 64), Ok(None));
        let error = decode(&broken, &Progress::default()).expect_err("there is no such vertex").to_string();
        assert!(error.contains("face 27: vertex -16777187 does not exist"), "{error}");
    }

    #[test]
    fn reading_ends_when_it_is_cancelled() {
        let (bytes, progress) = (file(false, "int"), Progress::default());
        progress.cancel();
        let read = read(&mut Cursor::new(&bytes), bytes.len() as u64, &progress);
        assert!(matches!(read, Err(ModelFormatError::Cancelled(_))));
    }
}
