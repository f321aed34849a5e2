//! Finds points near a place.

/// Points in the order of the cubes that they lie in.
#[derive(Default)]
pub struct Grid {
    points: Vec<[f32; 3]>,
    /// The cubes of the points, with their indices.
    cells: Vec<([i32; 3], u32)>,
    radius: f32,
}

impl Grid {
    /// Takes these points in place of those that it has, for searches within a radius.
    pub fn fill(&mut self, points: impl Iterator<Item = [f32; 3]>, radius: f32) {
        self.radius = radius;
        self.points.clear();
        self.points.extend(points);
        self.cells.clear();
        for (index, point) in self.points.iter().enumerate() {
            let cell = self.cell(*point, 0.0);
            self.cells.push((cell, index as u32));
        }
        self.cells.sort_unstable();
    }

    /// Adds the indices of all points nearer to `p` than the radius to `found`, always in the same order.
    pub fn find(&self, p: [f32; 3], found: &mut Vec<u32>) {
        let (low, high) = (self.cell(p, -self.radius), self.cell(p, self.radius));
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                let first = self.cells.partition_point(|(cell, _)| *cell < [x, y, low[2]]);
                let in_row = self.cells[first..].iter().take_while(|(cell, _)| *cell <= [x, y, high[2]]);
                found.extend(in_row.map(|(_, index)| *index).filter(|index| self.is_near(p, *index)));
            }
        }
    }

    /// The cube of a point that is shifted along each axis. Its edges are twice as long as the radius.
    fn cell(&self, [x, y, z]: [f32; 3], by: f32) -> [i32; 3] {
        let along = |x: f32| ((x + by) / (2.0 * self.radius)).floor() as i32;
        [along(x), along(y), along(z)]
    }

    fn is_near(&self, p: [f32; 3], index: u32) -> bool {
        let q = self.points[index as usize];
        let [x, y, z] = [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
        x * x + y * y + z * z < self.radius * self.radius
    }
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng, rngs::SmallRng};

    use super::*;

    #[test]
    fn it_finds_the_same_points_as_a_full_search() {
        let mut random = SmallRng::seed_from_u64(1);
        let mut grid = Grid::default();
        for radius in [0.01f32, 0.1, 0.7] {
            let mut points: Vec<[f32; 3]> = (0..500).map(|_| [0, 1, 2].map(|_| random.random_range(-1.0..1.0))).collect();
            // A point that occurs twice.
            points.push(points[0]);
            grid.fill(points.iter().copied(), radius);
            for _ in 0..200 {
                let p = [0, 1, 2].map(|_| random.random_range(-1.2f32..1.2));
                let mut found = Vec::new();
                grid.find(p, &mut found);
                found.sort_unstable();
                let near = |q: &[f32; 3]| (0..3).map(|i| (p[i] - q[i]) * (p[i] - q[i])).sum::<f32>() < radius * radius;
                let all: Vec<u32> = (0..points.len() as u32).filter(|i| near(&points[*i as usize])).collect();
                assert_eq!(found, all);
            }
        }
    }

    #[test]
    fn places_beyond_all_numbers_have_nothing_near() {
        let mut grid = Grid::default();
        grid.fill([[0.0; 3], [f32::INFINITY; 3]].into_iter(), 0.1);
        let mut found = Vec::new();
        for x in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
            grid.find([x, 0.0, 0.0], &mut found);
        }
        assert!(found.is_empty());
    }
}
