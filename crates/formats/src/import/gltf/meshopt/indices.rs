//! Lists of indices: of triangles by the edges and vertices that were used last, and others by differences.
use super::{Reader, signed};

/// First bytes of the streams.
const TRIANGLES: u8 = 0xe1;
const INDICES: u8 = 0xd1;
/// Bytes behind the data: a table of codes of triangles, and padding.
const TABLE: usize = 16;
const PADDING: usize = 4;
/// Codes of a third vertex from this one on are no place among the last vertices: one before the last explicit vertex, one after it, or a
/// difference.
const NEARBY: u8 = 13;
/// A vertex as a difference to the last such vertex.
const EXPLICIT: u8 = 15;

/// Triangles as the decoder remembers them.
#[derive(Default)]
struct Memory {
    edges: Last<[u32; 2]>,
    vertices: Last<u32>,
    /// The vertex that has not been named yet.
    next: u32,
    /// The last explicit vertex.
    last: u32,
}

/// The last sixteen of a kind.
#[derive(Default)]
struct Last<T> {
    list: [T; 16],
    count: usize,
}

impl<T: Copy> Last<T> {
    /// The one that came `back` before the latest; `None` if there was none.
    fn get(&self, back: u8) -> Option<T> {
        self.count.checked_sub(1 + usize::from(back)).map(|at| self.list[at % 16])
    }

    fn push(&mut self, latest: T) {
        self.list[self.count % 16] = latest;
        self.count += 1;
    }
}

impl Memory {
    fn new_vertex(&mut self) -> u32 {
        self.next = self.next.wrapping_add(1);
        self.next.wrapping_sub(1)
    }

    fn explicit(&mut self, difference: u32) -> u32 {
        self.last = self.last.wrapping_add(difference);
        self.last
    }

    /// A triangle on an edge of an earlier one.
    fn on_edge(&mut self, code: u8, data: &mut Reader) -> Option<[u32; 3]> {
        let [a, b] = self.edges.get(code >> 4)?;
        let c = match code & 15 {
            0 => self.new_vertex(),
            place if place < NEARBY => self.vertices.get(place)?,
            EXPLICIT => self.explicit(signed(data.number()?)),
            NEARBY => self.explicit(u32::MAX),
            _ => self.explicit(1),
        };
        if code & 15 == 0 || code & 15 >= NEARBY {
            self.vertices.push(c);
        }
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        Some([a, b, c])
    }

    /// A triangle by its vertices: whether the first is explicit, and the codes of the others.
    fn free(&mut self, is_explicit: bool, codes: u8, data: &mut Reader) -> Option<[u32; 3]> {
        let kinds = [if is_explicit { EXPLICIT } else { 0 }, codes >> 4, codes & 15];
        let mut triangle = [0; 3];
        // All are chosen before any is remembered.
        for (vertex, kind) in triangle.iter_mut().zip(kinds) {
            *vertex = match kind {
                0 => self.new_vertex(),
                EXPLICIT => self.explicit(signed(data.number()?)),
                place => self.vertices.get(place - 1)?,
            };
        }
        for (vertex, _) in triangle.iter().zip(kinds).filter(|(_, kind)| matches!(*kind, 0 | EXPLICIT)) {
            self.vertices.push(*vertex);
        }
        let [a, b, c] = triangle;
        [[b, a], [c, b], [a, c]].into_iter().for_each(|edge| self.edges.push(edge));
        Some(triangle)
    }
}

/// Triangles, as indices of `stride` bytes; `None` if the stream is damaged.
pub fn triangles(packed: &[u8], stride: usize, count: usize) -> Option<Vec<u8>> {
    let (rest, table) = packed.split_at_checked(packed.len().checked_sub(TABLE)?)?;
    let mut reader = Reader(rest);
    if reader.byte()? != TRIANGLES {
        return None;
    }
    let (codes, data) = reader.0.split_at_checked(count / 3)?;
    let (mut data, mut memory) = (Reader(data), Memory::default());
    let mut bytes = Vec::with_capacity(count * stride);
    for code in codes {
        let triangle = match code {
            0xff | 0xfe => {
                let codes = data.byte()?;
                if codes == 0 {
                    memory.next = 0;
                }
                memory.free(*code == 0xff, codes, &mut data)?
            }
            0xf0.. => memory.free(false, table[usize::from(code & 15)], &mut data)?,
            _ => memory.on_edge(*code, &mut data)?,
        };
        triangle.into_iter().for_each(|index| bytes.extend_from_slice(&index.to_le_bytes()[..stride]));
    }
    data.0.is_empty().then_some(bytes)
}

/// Indices of any meaning; `None` if the stream is damaged. Each follows one of two earlier ones.
pub fn indices(packed: &[u8], stride: usize, count: usize) -> Option<Vec<u8>> {
    let (rest, _) = packed.split_at_checked(packed.len().checked_sub(PADDING)?)?;
    let mut reader = Reader(rest);
    if reader.byte()? != INDICES {
        return None;
    }
    // Each index takes a byte at least.
    if count > reader.0.len() {
        return None;
    }
    let (mut last, mut bytes) = ([0u32; 2], Vec::with_capacity(count * stride));
    for _ in 0..count {
        let code = reader.number()?;
        let last = &mut last[(code & 1) as usize];
        *last = last.wrapping_add(signed(code >> 1));
        bytes.extend_from_slice(&last.to_le_bytes()[..stride]);
    }
    reader.0.is_empty().then_some(bytes)
}
