//! Elements such as vertices: differences from one element to the next, byte by byte, in groups of sixteen of few bits.
use super::{Reader, signed};

/// The first byte of a stream, without and with a choice of modes, and the least number of bytes behind its blocks.
const PLAIN: (u8, usize) = (0xa0, 32);
const MODES: (u8, usize) = (0xa1, 24);
/// Elements of a group.
const GROUP: usize = 16;
/// Bytes of a block, and its greatest number of elements.
const BLOCK_BYTES: usize = 8192;
const BLOCK: usize = 256;

/// How four bytes follow from those of the element before.
#[derive(Clone, Copy)]
enum Channel {
    /// By differences of bytes.
    Bytes,
    /// By differences of numbers of 16 bits.
    Shorts,
    /// By the bits that differ, rotated.
    Bits(u32),
}

impl Channel {
    fn of(code: u8) -> Option<Channel> {
        match (code & 15, code >> 4) {
            (0, 0) => Some(Channel::Bytes),
            (1, 0) => Some(Channel::Shorts),
            (2, rotation) => Some(Channel::Bits(rotation.into())),
            _ => None,
        }
    }

    fn next(self, last: [u8; 4], code: [u8; 4]) -> [u8; 4] {
        match self {
            Channel::Bytes => std::array::from_fn(|i| last[i].wrapping_add(signed(code[i].into()) as u8)),
            Channel::Shorts => {
                let half = |i: usize| {
                    let [last, code] = [last, code].map(|bytes| u16::from_le_bytes([bytes[i], bytes[i + 1]]));
                    last.wrapping_add(signed(code.into()) as u16).to_le_bytes()
                };
                let ([a, b], [c, d]) = (half(0), half(2));
                [a, b, c, d]
            }
            Channel::Bits(rotation) => (u32::from_le_bytes(last) ^ u32::from_le_bytes(code).rotate_left(rotation)).to_le_bytes(),
        }
    }
}

/// The elements; `None` if the stream is damaged. `stride` is a multiple of four up to 256.
pub fn decoded(packed: &[u8], stride: usize, count: usize) -> Option<Vec<u8>> {
    let (header, rest) = packed.split_first()?;
    let (_, least) = [PLAIN, MODES].into_iter().find(|(first, _)| first == header)?;
    let has_modes = *header == MODES.0;
    let end = stride + if has_modes { stride / 4 } else { 0 };
    let (blocks, tail) = rest.split_at_checked(rest.len().checked_sub(end.max(least))?)?;
    let (last, channels) = tail[tail.len() - end..].split_at(stride);
    let mut last = last.as_chunks::<4>().0.to_vec();
    let mut reader = Reader(blocks);
    let most = ((BLOCK_BYTES / stride) & !(GROUP - 1)).min(BLOCK);
    // It grows as the stream goes on: a short stream can claim any count.
    let mut elements = Vec::new();
    for first in (0..count).step_by(most) {
        let size = most.min(count - first);
        let controls = if has_modes { Some(reader.take(stride / 4)?) } else { None };
        elements.resize((first + size) * stride, 0);
        let block = &mut elements[first * stride..];
        for (place, last) in last.iter_mut().enumerate() {
            let channel = Channel::of(channels.get(place).copied().unwrap_or(0))?;
            let control = |byte: usize| controls.map(|controls| (controls[place] >> (2 * byte)) & 3);
            let columns = [0, 1, 2, 3].map(|byte| column(&mut reader, size, control(byte)));
            let [Some(a), Some(b), Some(c), Some(d)] = columns else { return None };
            for (at, element) in block.chunks_exact_mut(stride).enumerate() {
                *last = channel.next(*last, [a[at], b[at], c[at], d[at]]);
                element[4 * place..4 * place + 4].copy_from_slice(last);
            }
        }
    }
    reader.0.is_empty().then_some(elements)
}

/// The codes of one byte of all elements of a block, filled up to whole groups.
fn column(reader: &mut Reader, size: usize, control: Option<u8>) -> Option<Vec<u8>> {
    let groups = size.div_ceil(GROUP);
    let widths = match control {
        None => [0, 2, 4, 8],
        Some(0) => [0, 1, 2, 4],
        Some(1) => [1, 2, 4, 8],
        Some(2) => return Some(vec![0; size]),
        Some(_) => return reader.take(size).map(<[u8]>::to_vec),
    };
    let choices = reader.take(groups.div_ceil(4))?;
    let mut codes = Vec::with_capacity(groups * GROUP);
    for group in 0..groups {
        match widths[usize::from((choices[group / 4] >> (2 * (group % 4))) & 3)] {
            0 => codes.extend([0; GROUP]),
            8 => codes.extend_from_slice(reader.take(GROUP)?),
            bits => narrow(reader, bits, &mut codes)?,
        }
    }
    Some(codes)
}

/// A group of codes of 1, 2 or 4 bits. One of all ones stands for a byte that follows the group.
fn narrow(reader: &mut Reader, bits: usize, codes: &mut Vec<u8>) -> Option<()> {
    let packed = reader.take(GROUP * bits / 8)?;
    let escape = (1 << bits) - 1;
    for at in (0..GROUP * bits).step_by(bits) {
        // The first code of a byte is in its highest bits, but single bits begin with the lowest.
        let shift = if bits == 1 { at % 8 } else { 8 - bits - at % 8 };
        let code = (packed[at / 8] >> shift) & escape;
        codes.push(if code == escape { reader.byte()? } else { code });
    }
    Some(())
}
