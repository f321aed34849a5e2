//! Corners of faces, and the indices that they are written with.
use super::lists::{Counts, Lists};
use noisefall_base::quote;

/// Marks a missing texture coordinate or normal of a corner.
pub const NONE: u32 = u32::MAX;

/// A corner of a face: indices into the lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Corner {
    pub place: u32,
    pub uv: u32,
    pub normal: u32,
}

/// Reads `place`, `place/uv`, `place//normal` or `place/uv/normal`. Texture coordinates and normals that do not exist are missing, and
/// are counted: programs that write files without them still name them.
pub fn corner(lists: &Lists, before: &Counts, word: &str, missing: &mut [usize; 2]) -> Result<Corner, String> {
    let mut rest = Some(word);
    let mut index = |what, count, before| match next_part(&mut rest) {
        None | Some("") => Ok(Some(NONE)),
        Some(part) => number(part, what).map(|number| resolved(number, count, before)),
    };
    let place = index("vertex", lists.places.len(), before.places)?;
    let uv = index("texture coordinate", lists.uvs.len(), before.uvs)?;
    let normal = index("normal", lists.normals.len(), before.normals)?;
    if place == Some(NONE) || rest.is_some() {
        return Err(format!("{} is not a corner: `vertex/texture coordinate/normal`", quote::bytes(word.as_bytes())));
    }
    let place = place.ok_or_else(|| no_vertex(word, lists.places.len(), before.places))?;
    let [uv, normal] = [(uv, 0), (normal, 1)].map(|(index, which)| {
        missing[which] += usize::from(index.is_none());
        index.unwrap_or(NONE)
    });
    Ok(Corner { place, uv, normal })
}

/// Takes the text before the next slash, or the rest.
fn next_part<'w>(rest: &mut Option<&'w str>) -> Option<&'w str> {
    let text = (*rest)?;
    let slash = text.bytes().position(|byte| byte == b'/');
    *rest = slash.map(|slash| &text[slash + 1..]);
    Some(&text[..slash.unwrap_or(text.len())])
}

fn number(index: &str, what: &str) -> Result<i64, String> {
    index.parse().map_err(|_| format!("{} is not a {what}'s number", quote::bytes(index.as_bytes())))
}

/// The error of a corner whose vertex is not in the list of `count`, of which `before` stand in earlier lines.
fn no_vertex(word: &str, count: usize, before: usize) -> String {
    let number = next_part(&mut Some(word)).unwrap_or_default();
    let there = if number.starts_with('-') { format!("{before} before this line") } else { format!("{count}, counted from 1") };
    format!("vertex {number} does not exist: there are {there}")
}

/// The corner at the beginning of a line and the bytes after it, if it is written in digits, slashes and minus signs, and exists. This
/// is most of the work of reading a file, so other notations, and errors, are left to [`corner`].
#[inline]
pub fn plain_corner<'w>(lists: &Lists, before: &Counts, mut rest: &'w [u8]) -> Option<(Corner, &'w [u8])> {
    let counts = [(lists.places.len(), before.places), (lists.uvs.len(), before.uvs), (lists.normals.len(), before.normals)];
    let (mut indices, mut is_ended) = ([NONE; 3], false);
    for (index, (count, before)) in indices.iter_mut().zip(counts) {
        let (number, length) = plain_number(rest)?;
        if length > 0 {
            *index = resolved(number, count, before)?;
        }
        rest = &rest[length..];
        match rest.first() {
            Some(b'/') => rest = &rest[1..],
            end => {
                is_ended = end.is_none_or(u8::is_ascii_whitespace);
                break;
            }
        }
    }
    let [place, uv, normal] = indices;
    (is_ended && place != NONE).then_some((Corner { place, uv, normal }, rest))
}

/// A number of up to nine digits at the beginning of a text, and its length, which may be 0; `None` for longer ones.
#[inline]
fn plain_number(text: &[u8]) -> Option<(i64, usize)> {
    const LONGEST: usize = 9;
    let is_negative = text.first() == Some(&b'-');
    let start = usize::from(is_negative);
    let (mut number, mut end) = (0, start);
    while let Some(digit) = text.get(end).map(|byte| byte.wrapping_sub(b'0')).filter(|digit| *digit < 10) {
        number = 10 * number + i64::from(digit);
        end += 1;
        if end - start > LONGEST {
            return None;
        }
    }
    if is_negative && end == start {
        return None;
    }
    Some((if is_negative { -number } else { number }, end))
}

/// The position in a list of `count` of a number that counts from 1, or back from the `before` elements of earlier lines.
#[inline]
fn resolved(number: i64, count: usize, before: usize) -> Option<u32> {
    let position = if number < 0 { before as i64 + number } else { number - 1 };
    (0..count as i64).contains(&position).then_some(position as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_corners_are_read_like_all_others() {
        let (lists, before) = (
            Lists { places: vec![[0.0; 3]; 12], uvs: vec![[0.0; 2]; 3], normals: vec![[0.0; 3]; 2], ..Lists::default() },
            Counts { places: 5, uvs: 3, normals: 0 },
        );
        let words = ["1", "12", "-5", "3/2", "3/", "3//", "3/2/", "3//1", "3/2/1", "3/-3/2", "007"];
        for word in words {
            let line = format!("{word} 1");
            let (found, rest) = plain_corner(&lists, &before, line.as_bytes()).unwrap_or_else(|| panic!("{word} is plain"));
            assert!(corner(&lists, &before, word, &mut [0; 2]) == Ok(found) && rest == b" 1", "{word}");
        }
        let unusual =
            ["0", "13", "-6", "/1", "3/4", "3//-1", "3/2/1/", "3/2/1/1", "-", "3/-", "+3", "3a", "3#", "3\\", "0000000001"];
        for word in unusual {
            assert!(plain_corner(&lists, &before, word.as_bytes()).is_none(), "{word}");
        }
        assert!(corner(&lists, &before, "+3", &mut [0; 2]) == Ok(Corner { place: 2, uv: NONE, normal: NONE }));
    }

    #[test]
    fn attributes_that_do_not_exist_are_missing_and_counted() {
        let (lists, before) = (Lists { places: vec![[0.0; 3]; 2], uvs: vec![[0.0; 2]], ..Lists::default() }, Counts::default());
        let mut missing = [0; 2];
        let mut read = |word| corner(&lists, &before, word, &mut missing);
        assert!(read("1/1/1") == Ok(Corner { place: 0, uv: 0, normal: NONE }));
        assert!(read("2/0/-4") == Ok(Corner { place: 1, uv: NONE, normal: NONE }));
        assert!(read("3/1").is_err() && read("1/x").is_err());
        assert_eq!(missing, [1, 2]);
    }
}
