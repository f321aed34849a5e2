//! Checksums that fit again after a mutation.

/// Corrects the checksums of the sections of a render file.
pub fn of_sections(file: &mut [u8]) {
    let mut at = 12;
    while let Some(length) = file.get(at + 4..at + 12).and_then(|eight| Some(u64::from_le_bytes(eight.try_into().ok()?))) {
        let Some(end) = usize::try_from(length).ok().and_then(|length| length.checked_add(at + 12)) else { return };
        let Some(content) = file.get(at..end) else { return };
        let mut sum = flate2::Crc::new();
        sum.update(content);
        let Some(place) = file.get_mut(end..end.saturating_add(4)) else { return };
        place.copy_from_slice(&sum.sum().to_le_bytes());
        at = end + 4;
    }
}

/// Corrects the checksums of the chunks of a PNG.
pub fn of_chunks(file: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = file.get(at..at + 4).map(|four| u32::from_be_bytes([four[0], four[1], four[2], four[3]]) as usize) {
        let end = at + 8 + length;
        let Some(content) = file.get(at + 4..end) else { return };
        let mut sum = flate2::Crc::new();
        sum.update(content);
        let Some(place) = file.get_mut(end..end + 4) else { return };
        place.copy_from_slice(&sum.sum().to_be_bytes());
        at = end + 4;
    }
}
