//! The outline of the selected object, from the object ids of the pixels, off the UI thread.
use std::{ops::Range, sync::Arc};

use noisefall_kernel::integrator::Features;

use super::search::{Patience, Question, Search};

/// The lines between pixels of an object and others, from corner to corner in pixels.
#[derive(Debug, PartialEq)]
pub struct Outline(pub Vec<[[u32; 2]; 2]>);

/// An outline of more lines is made of coarser pixels.
const MOST_LINES: usize = 8000;

impl Outline {
    /// The outline of the pixels that satisfy a predicate.
    pub fn of(size: [u32; 2], is_inside: &dyn Fn(u32, u32) -> bool) -> Outline {
        let mut step = 1;
        loop {
            let outline = Outline::of_blocks(size, step, is_inside);
            if outline.0.len() <= MOST_LINES || step > size[0].max(size[1]) {
                return outline;
            }
            step *= 2;
        }
    }

    /// Outlines blocks of pixels, each represented by its upper left pixel.
    fn of_blocks([width, height]: [u32; 2], step: u32, is_inside: &dyn Fn(u32, u32) -> bool) -> Outline {
        let [columns, rows] = [width.div_ceil(step), height.div_ceil(step)];
        let inside = |column: u32, row: u32| column < columns && row < rows && is_inside(column * step, row * step);
        let mut lines = Vec::new();
        let mut add = |ends: [[u32; 2]; 2]| lines.push(ends.map(|[x, y]| [(x * step).min(width), (y * step).min(height)]));
        for row in 0..=rows {
            let is_edge = |column: u32| (row > 0 && inside(column, row - 1)) != inside(column, row);
            runs(columns, is_edge).for_each(|run| add([[run.start, row], [run.end, row]]));
        }
        for column in 0..=columns {
            let is_edge = |row: u32| (column > 0 && inside(column - 1, row)) != inside(column, row);
            runs(rows, is_edge).for_each(|run| add([[column, run.start], [column, run.end]]));
        }
        Outline(lines)
    }
}

/// The longest runs of numbers below `count` that satisfy a predicate.
fn runs(count: u32, is_in: impl Fn(u32) -> bool) -> impl Iterator<Item = Range<u32>> {
    let mut next = 0;
    std::iter::from_fn(move || {
        let start = (next..count).find(|at| is_in(*at))?;
        let end = (start..count).find(|at| !is_in(*at)).unwrap_or(count);
        next = end;
        Some(start..end)
    })
}

/// The features and the objects of an outline.
#[derive(Clone)]
struct Subject(Arc<Features>, Range<u32>);

impl Question for Subject {
    fn is_same(&self, other: &Subject) -> bool {
        Arc::ptr_eq(&self.0, &other.0) && self.1 == other.1
    }

    fn is_near(&self, other: &Subject) -> bool {
        self.is_same(other)
    }
}

/// Finds outlines on another thread; keeps the last one.
pub struct OutlineFinder {
    ctx: egui::Context,
    search: Search<Subject, Arc<Outline>>,
}

impl OutlineFinder {
    pub fn new(ctx: &egui::Context) -> OutlineFinder {
        OutlineFinder { ctx: ctx.clone(), search: Search::default() }
    }

    /// The outline of these objects, as soon as it is known.
    pub fn of(&mut self, features: &Arc<Features>, objects: Range<u32>) -> Option<Arc<Outline>> {
        let subject = Subject(features.clone(), objects);
        self.search.ask(&self.ctx, &subject, Patience::Cancels, |Subject(features, objects)| {
            move |_| {
                let is_inside = |x: u32, y: u32| objects.contains(&features.object[(y * features.width + x) as usize]);
                Some(Arc::new(Outline::of([features.width, features.height], &is_inside)))
            }
        });
        self.search.found().map(|(_, outline)| outline.clone())
    }

    /// Forgets all outlines: nothing is selected.
    pub fn clear(&mut self) {
        self.search = Search::default();
    }
}

#[cfg(test)]
mod tests {
    use noisefall_base::math::SimdLevel;
    use noisefall_kernel::integrator::features;
    use noisefall_scene::scene::{Camera, built_in};

    use super::*;

    /// The outline of an image of letters, where `#` is inside.
    fn outline(rows: &[&str]) -> Vec<[[u32; 2]; 2]> {
        let size = [rows[0].len() as u32, rows.len() as u32];
        Outline::of(size, &|x, y| rows[y as usize].as_bytes()[x as usize] == b'#').0
    }

    #[test]
    fn a_rectangle_has_four_lines() {
        let lines = outline(&["....", ".##.", ".##.", "...."]);
        assert_eq!(lines, [[[1, 1], [3, 1]], [[1, 3], [3, 3]], [[1, 1], [1, 3]], [[3, 1], [3, 3]]]);
    }

    #[test]
    fn a_full_image_is_outlined_at_its_edge_and_an_empty_one_is_not() {
        assert_eq!(outline(&["##", "##"]).len(), 4);
        assert!(outline(&["..", ".."]).is_empty());
    }

    #[test]
    fn the_length_of_an_outline_is_the_number_of_sides_between_inside_and_outside() {
        let lines = outline(&["#.#", "...", "##."]);
        let length: u32 = lines.iter().map(|[from, to]| (to[0] - from[0]) + (to[1] - from[1])).sum();
        assert_eq!(length, 4 + 4 + 6);
    }

    #[test]
    fn a_speckled_object_has_a_coarser_outline() {
        let checker = |x: u32, y: u32| (x + y).is_multiple_of(2);
        let lines = Outline::of([400, 300], &checker).0;
        assert!(!lines.is_empty() && lines.len() <= MOST_LINES, "{}", lines.len());
        assert!(lines.iter().flatten().all(|[x, y]| *x <= 400 && *y <= 300));
    }

    #[test]
    fn the_finder_outlines_the_objects_that_are_asked_for() {
        let scene = built_in();
        let camera = Camera { resolution: [32, 32], ..scene.camera };
        let features = Arc::new(features(SimdLevel::best(), &scene, &camera, &|| false).expect("nothing interrupts it"));
        let mut finder = OutlineFinder::new(&egui::Context::default());
        let mut wait = |objects: Range<u32>| {
            let start = std::time::Instant::now();
            loop {
                if let Some(outline) = finder.of(&features, objects.clone()) {
                    return outline;
                }
                assert!(start.elapsed().as_secs() < 60, "it never came");
                std::thread::yield_now();
            }
        };
        let all = wait(0..scene.objects.len() as u32);
        let none = wait(0..0);
        assert!(!all.0.is_empty() && none.0.is_empty());
        let first = wait(0..scene.objects.len() as u32);
        assert_eq!(first, all);
        finder.clear();
        assert!(finder.of(&features, 0..0).is_none());
    }
}
