//! Triangles of primitives, and the vertices that they use.
use rayon::prelude::*;

use super::{accessor::Picks, refusal::Found};

/// Topology of a primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mode {
    Triangles,
    Strip,
    Fan,
    /// Points or lines, which have no surface.
    None(&'static str),
}

impl Mode {
    /// The mode of a number in the file.
    pub fn of(code: Option<u32>) -> Found<Mode> {
        Ok(match code.unwrap_or(4) {
            0 => Mode::None("points"),
            1..=3 => Mode::None("lines"),
            4 => Mode::Triangles,
            5 => Mode::Strip,
            6 => Mode::Fan,
            code => return Err(format!("there is no primitive mode {code}").into()),
        })
    }

    /// Triangles of a list of corners. Corners that complete no triangle are left out.
    pub fn triangles(self, corners: &[u32]) -> Vec<[u32; 3]> {
        match self {
            Mode::Triangles => corners.chunks_exact(3).map(|corner| [corner[0], corner[1], corner[2]]).collect(),
            // Every second triangle is turned, so that all face the same side.
            Mode::Strip => {
                let turned = |(place, corner): (usize, &[u32])| [corner[0], corner[1 + place % 2], corner[2 - place % 2]];
                corners.windows(3).enumerate().map(turned).collect()
            }
            Mode::Fan => {
                let Some((center, rim)) = corners.split_first() else { return Vec::new() };
                rim.windows(2).map(|corner| [corner[0], corner[1], *center]).collect()
            }
            Mode::None(_) => Vec::new(),
        }
    }
}

/// Renumbers the vertices so that only those that triangles use are left, and returns which ones these are.
///
/// Primitives often share one large list of vertices. Each must not get a copy of the whole.
pub fn compact(triangles: &mut [[u32; 3]], count: usize) -> Found<Picks> {
    let Some(greatest) = triangles.par_iter().flatten_iter().copied().max() else { return Ok(Picks::First(0)) };
    if greatest as usize >= count {
        return Err(format!("a triangle names vertex {greatest}; there are {count}").into());
    }
    let corners = 3 * triangles.len();
    if count <= corners {
        return Ok(numbered(triangles, count));
    }
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let number = |vertex: u32| used.binary_search(&vertex).unwrap_or_default() as u32;
    triangles.iter_mut().flatten().for_each(|vertex| *vertex = number(*vertex));
    Ok(Picks::These(used))
}

/// Renumbers the vertices by a table of all of them.
fn numbered(triangles: &mut [[u32; 3]], count: usize) -> Picks {
    let mut numbers = vec![u32::MAX; count];
    triangles.iter().flatten().for_each(|vertex| numbers[*vertex as usize] = 0);
    if numbers.iter().all(|number| *number == 0) {
        return Picks::First(count);
    }
    let mut used = Vec::new();
    for (vertex, number) in numbers.iter_mut().enumerate().filter(|(_, number)| **number == 0) {
        *number = used.len() as u32;
        used.push(vertex as u32);
    }
    triangles.iter_mut().flatten().for_each(|vertex| *vertex = numbers[*vertex as usize]);
    Picks::These(used)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_face_one_side() {
        let corners = [0, 1, 2, 3, 4];
        assert_eq!(Mode::Triangles.triangles(&corners), [[0, 1, 2]]);
        assert_eq!(Mode::Strip.triangles(&corners), [[0, 1, 2], [1, 3, 2], [2, 3, 4]]);
        assert_eq!(Mode::Fan.triangles(&corners), [[1, 2, 0], [2, 3, 0], [3, 4, 0]]);
        for mode in [Mode::Triangles, Mode::Strip, Mode::Fan, Mode::None("points")] {
            assert!(mode.triangles(&[]).is_empty() && mode.triangles(&[7, 8]).is_empty(), "{mode:?}");
        }
    }

    #[test]
    fn only_vertices_that_are_used_are_left() {
        let compacted = |triangles: &[[u32; 3]], count| {
            let mut triangles = triangles.to_vec();
            compact(&mut triangles, count).map(|picks| (picks, triangles))
        };
        assert_eq!(compacted(&[[0, 1, 2]], 3), Ok((Picks::First(3), vec![[0, 1, 2]])));
        assert_eq!(compacted(&[[2, 0, 2], [2, 0, 0]], 4), Ok((Picks::These(vec![0, 2]), vec![[1, 0, 1], [1, 0, 0]])));
        assert_eq!(compacted(&[[900, 5, 7]], 1000), Ok((Picks::These(vec![5, 7, 900]), vec![[2, 0, 1]])));
        assert!(compacted(&[[0, 1, 3]], 3).is_err() && compacted(&[[0, 1, u32::MAX]], 3).is_err());
    }
}
