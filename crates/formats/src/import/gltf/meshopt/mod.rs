//! Buffer views that are compressed by EXT_meshopt_compression or KHR_meshopt_compression, after their specifications.
//!
//! | part | file |
//! |---|---|
//! | elements such as vertices | `attributes.rs` |
//! | triangles, and other lists of indices | `indices.rs` |
//! | filters that pack directions, quaternions, numbers and colours | `filters.rs` |
mod attributes;
mod filters;
mod indices;

use super::{
    extensions::Meshopt,
    refusal::{Found, Refusal},
};

/// Bytes of the largest element that the format has.
const LARGEST: u64 = 256;

/// Number of bytes of a view without compression.
pub fn size(described: &Meshopt) -> Found<u64> {
    let Meshopt { byte_stride: stride, count, .. } = described;
    let size = count.checked_mul(*stride).filter(|_| (1..=LARGEST).contains(stride));
    Ok(size.ok_or("a view of meshopt has elements of no size, or too many")?)
}

/// These bytes, which must be as many as there is room for.
pub fn decompressed(described: &Meshopt, packed: &[u8]) -> Found<Vec<u8>> {
    let Meshopt { byte_stride: stride, count, mode, filter, .. } = described;
    let (stride, count) = (*stride as usize, *count as usize);
    let decoded = match mode.as_str() {
        "ATTRIBUTES" if stride.is_multiple_of(4) => attributes::decoded(packed, stride, count),
        "TRIANGLES" if matches!(stride, 2 | 4) && count.is_multiple_of(3) => indices::triangles(packed, stride, count),
        "INDICES" if matches!(stride, 2 | 4) => indices::indices(packed, stride, count),
        _ => None,
    };
    let mut bytes = decoded.ok_or_else(|| Refusal::from(format!("a view of meshopt in mode `{mode}` cannot be decoded")))?;
    let is_known = match (filter.as_str(), stride) {
        ("" | "NONE", _) => true,
        ("OCTAHEDRAL", 4 | 8) => filters::octahedral(&mut bytes, stride),
        ("QUATERNION", 8) => filters::quaternions(&mut bytes),
        ("COLOR", 4 | 8) => filters::colours(&mut bytes, stride),
        ("EXPONENTIAL", _) if stride.is_multiple_of(4) => filters::exponential(&mut bytes),
        _ => false,
    };
    is_known.then_some(bytes).ok_or_else(|| format!("there is no filter `{filter}` of meshopt for {stride} bytes").into())
}

/// Bytes that are read one after the other; `None` beyond their end.
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn byte(&mut self) -> Option<u8> {
        let (first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(*first)
    }

    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (part, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(part)
    }

    /// A number of up to 32 bits, seven of them in a byte, the lowest first.
    fn number(&mut self) -> Option<u32> {
        let mut number = 0;
        for shift in (0..35).step_by(7) {
            let byte = self.byte()?;
            number |= u32::from(byte & 127) << shift;
            if byte < 128 {
                return Some(number);
            }
        }
        None
    }
}

/// A difference whose lowest bit is its sign.
fn signed(code: u32) -> u32 {
    (code >> 1) ^ (code & 1).wrapping_neg()
}

#[cfg(test)]
mod tests;
