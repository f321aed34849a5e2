//! Keys of measurements: the same whenever, and only when, all is the same that they depend on.

/// FNV-1a, 64 bits (G. Fowler, L. C. Noll and K.-P. Vo): the same on every machine and in every version, unlike the hashes of `std`.
pub fn hash(parts: &[&[u8]]) -> u64 {
    const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0100_0000_01b3;
    // Each part begins with its length: else bytes could move from one part to the next unnoticed.
    let step = |state: u64, byte: &u8| (state ^ u64::from(*byte)).wrapping_mul(PRIME);
    parts.iter().fold(OFFSET, |state, part| {
        let state = (part.len() as u64).to_le_bytes().iter().fold(state, step);
        part.iter().fold(state, step)
    })
}

/// The bits of a picture.
pub fn hash_of_picture(radiance: &[[f32; 3]]) -> u64 {
    let bytes: Vec<u8> = radiance.iter().flatten().flat_map(|c| c.to_le_bytes()).collect();
    hash(&[&bytes])
}

/// As it stands in files: 16 hexadecimal digits.
pub fn text(key: u64) -> String {
    format!("{key:016x}")
}

pub fn is_key(text: &str) -> bool {
    text.len() == 16 && u64::from_str_radix(text, 16).is_ok()
}
