//! Streams that are made by hand, after the tables of the specification.
use super::*;

#[test]
fn groups_of_bytes_have_four_widths() {
    // Vertices of four bytes: constant, +1, alternating +5 and −100 behind an escape, and any.
    let raw: Vec<u8> = (0..16).map(|i| 7 * i + 1).collect();
    let mut packed = vec![0xa0, 0, 1];
    packed.extend([0b1010_1010; 4]);
    packed.push(2);
    packed.extend([0xaf; 8]);
    packed.extend([199; 8]);
    packed.push(3);
    packed.extend(&raw);
    packed.extend([0; 28]);
    packed.extend([9, 0, 0, 0]);
    let decoded = attributes::decoded(&packed, 4, 16).expect("it is whole");
    let mut last = [9u8, 0, 0, 0];
    for (vertex, found) in decoded.chunks_exact(4).enumerate() {
        let third = if vertex % 2 == 0 { 5u8 } else { 100u8.wrapping_neg() };
        let differences = [0, 1, third, signed(raw[vertex].into()) as u8];
        last = std::array::from_fn(|i| last[i].wrapping_add(differences[i]));
        assert_eq!(found, last, "vertex {vertex}");
    }
    assert_eq!(attributes::decoded(&packed[..packed.len() - 1], 4, 16), None);
    assert_eq!(attributes::decoded(&[0xa2; 64], 4, 16), None, "another version");
}

#[test]
fn channels_and_bytes_have_modes() {
    let literal = [0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    let stream = |channel: u8| {
        // The four bytes: single bits with two escapes; as they are; none; and groups of none.
        let block = [&[0xa1, 0b0010_1101, 0, 0b10, 0b10, 2, 4][..], &literal, &[0]].concat();
        [&block[..], &[0; 19], &[10, 0, 7, 0, channel]].concat()
    };
    let decoded = |channel: u8| {
        let bytes = attributes::decoded(&stream(channel), 4, 16)?;
        Some(bytes.as_chunks::<4>().0.iter().map(|element| u32::from_le_bytes(*element)).collect::<Vec<_>>())
    };
    // From element 1, 3 and 9 on.
    let expected = |steps: [u32; 4]| [1, 2, 6, 7].into_iter().zip(steps).flat_map(|(n, x)| vec![x; n]).collect::<Vec<u32>>();
    let shorts = [10, 11, 139, 141].map(|x| x | 7 << 16);
    assert_eq!(decoded(1), Some(expected(shorts)));
    let first = 10 | 7 << 16;
    let bits = [first, first ^ 0x200, first ^ 0x1_0200, first ^ 0x1_0600];
    assert_eq!(decoded(0x82), Some(expected(bits)));
    assert_eq!((decoded(3), decoded(0x11)), (None, None), "no such mode");
    let short = stream(1);
    assert_eq!(attributes::decoded(&short, 4, 1 << 40), None, "a count beyond the bytes");
}

#[test]
fn triangles_follow_edges_and_last_vertices() {
    let read = |codes: &[u8], data: &[u8]| {
        let table = [[0u8; 14].as_slice(), &[0, 0]].concat();
        let packed = [&[0xe1], codes, data, &table].concat();
        let bytes = indices::triangles(&packed, 2, 3 * codes.len())?;
        Some(bytes.chunks_exact(2).map(|index| index[0].into()).collect::<Vec<u32>>())
    };
    // Three new vertices; the edge 2 → 0's other side with a new one; the same edge with vertex 1, the third last.
    assert_eq!(read(&[0xf0, 0x00], &[]), Some(vec![0, 1, 2, 0, 2, 3]));
    assert_eq!(read(&[0xf0, 0x02], &[]), Some(vec![0, 1, 2, 0, 2, 0]));
    // A vertex by its difference to the last explicit one, and its neighbours.
    assert_eq!(read(&[0xf0, 0x0f, 0x0e, 0x0d], &[20]), Some(vec![0, 1, 2, 0, 2, 10, 0, 10, 11, 0, 11, 10]));
    // All explicit: 3, 5 and 4; and a start over.
    assert_eq!(read(&[0xff], &[0xff, 6, 4, 1]), Some(vec![3, 5, 4]));
    assert_eq!(read(&[0xf0, 0xfe], &[0]), Some(vec![0, 1, 2, 0, 1, 2]));
    assert_eq!((read(&[0xff], &[0xff, 6]), read(&[0xf0], &[1])), (None, None), "too short, and too long");
    assert_eq!((read(&[0x00], &[]), read(&[0xf0, 0x05], &[])), (None, None), "edges and vertices that there are not");
    assert_eq!(read(&[0xff], &[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0, 0]), None, "a number of six bytes");
}

#[test]
fn indices_follow_one_of_two() {
    // 10 and 11 of the first, 200 of the second, and 9.
    let packed = [0xd1, 40, 4, 0xa1, 6, 6, 0, 0, 0, 0];
    let bytes = indices::indices(&packed, 4, 4).expect("it is whole");
    let found: Vec<u32> = bytes.as_chunks::<4>().0.iter().map(|index| u32::from_le_bytes(*index)).collect();
    assert_eq!(found, [10, 11, 200, 9]);
    assert_eq!(indices::indices(&packed, 4, 3), None);
}

#[test]
fn filters_unpack_directions_quaternions_and_numbers() {
    let mut directions = [0u8, 0, 127, 5, 127, 0, 127, 0, 0, 0, 64, 1].to_vec();
    assert!(filters::octahedral(&mut directions, 4));
    assert_eq!(directions, [0, 0, 127, 5, 127, 0, 0, 0, 0, 0, 127, 1]);
    let shorts = |numbers: &[i16]| numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    // A half turn about z lies 0 from the greatest number, which is the third one.
    let mut turn = shorts(&[0, 0, 0, 0x7fe]);
    assert!(filters::quaternions(&mut turn));
    assert_eq!(turn, shorts(&[0, 0, 32767, 0]));
    let code = |mantissa: i32, exponent: i32| (mantissa & 0xff_ffff | exponent << 24).to_le_bytes();
    let mut numbers = [code(3, -1), code(-5, 2), code(0, 7)].concat();
    assert!(filters::exponential(&mut numbers));
    assert_eq!(numbers, [1.5f32, -20.0, 0.0].map(f32::to_le_bytes).concat());
    // Grey of eight bits; of five bits a colour and half of the greatest alpha.
    let mut colours = [100, 0, 0, 0xff, 16, 0xfc, 0xfe, 0x17].to_vec();
    assert!(filters::colours(&mut colours, 4));
    assert_eq!(colours, [100, 100, 100, 255, 115, 115, 181, 123]);
}
