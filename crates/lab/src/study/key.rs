//! Keys of measurements: hashes of everything that a measurement depends on.

/// FNV-1a, 64 bits (G. Fowler, L. C. Noll and K.-P. Vo): the same on every machine and in every version, unlike the hashes of `std`.
pub fn hash(parts: &[&[u8]]) -> u64 {
    const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0100_0000_01b3;
    // The length of each part is hashed too, so bytes cannot move from one part to the next unnoticed.
    let step = |state: u64, byte: &u8| (state ^ u64::from(*byte)).wrapping_mul(PRIME);
    parts.iter().fold(OFFSET, |state, part| {
        let state = (part.len() as u64).to_le_bytes().iter().fold(state, step);
        part.iter().fold(state, step)
    })
}

/// Hash of the bits of an image.
pub fn hash_of_picture(radiance: &[[f32; 3]]) -> u64 {
    let bytes: Vec<u8> = radiance.iter().flatten().flat_map(|c| c.to_le_bytes()).collect();
    hash(&[&bytes])
}

/// A key as 16 hexadecimal digits.
pub fn text(key: u64) -> String {
    format!("{key:016x}")
}

pub fn is_key(text: &str) -> bool {
    text.len() == 16 && u64::from_str_radix(text, 16).is_ok()
}
