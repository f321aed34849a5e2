//! Splits lights into two groups by the surface area orientation heuristic over bins.
use glam::Vec3;

use super::cluster::Item;

const BINS: usize = 12;

/// A group of lights, and its cost: power × extent² × the measure of its cone.
#[derive(Clone, Copy)]
struct LightGroup {
    count: usize,
    power: f32,
    /// Sum of power × normal.
    along: Vec3,
    low: Vec3,
    high: Vec3,
}

impl LightGroup {
    const NONE: LightGroup =
        LightGroup { count: 0, power: 0.0, along: Vec3::ZERO, low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    fn of(item: &Item) -> LightGroup {
        // Of two-sided lights, which have no side, normals are made comparable by one of their signs.
        let axis = if item.two_sided && item.axis.dot(Vec3::new(0.1, 1.0, 0.01)) < 0.0 { -item.axis } else { item.axis };
        LightGroup {
            count: 1,
            power: item.power,
            along: axis * item.power,
            low: item.center - item.radius,
            high: item.center + item.radius,
        }
    }

    fn merge(&mut self, other: &LightGroup) {
        self.count += other.count;
        self.power += other.power;
        self.along += other.along;
        self.low = self.low.min(other.low);
        self.high = self.high.max(other.high);
    }

    fn cost(&self) -> f32 {
        // Directions that fill a cap evenly have a mean of length 1 − x with x = (1 − cos θ)/2. The solid angle weighed by cosine
        // that lights of a cone of half angle θ shine into (Conty and Kulla, M_Ω) is π at x = 0, 3.57π at 1/2 and 4π at 1.
        let x = if self.power > 0.0 { (1.0 - self.along.length() / self.power).max(0.0) } else { 0.0 };
        self.power * (self.high - self.low).length_squared() * (1.0 + x * (7.28 - 4.28 * x))
    }
}

/// Reorders two or more lights into two consecutive groups, and returns their sizes and costs. Neither group is empty.
fn split(items: &mut [Item]) -> [(usize, f32); 2] {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for item in items.iter() {
        low = low.min(item.center);
        high = high.max(item.center);
    }
    let count = BINS.min(items.len());
    let scale = (high - low).map(|extent| if extent > 0.0 { count as f32 / extent } else { 0.0 });
    let bin = |item: &Item, axis: usize| (((item.center[axis] - low[axis]) * scale[axis]) as usize).min(count - 1);
    let mut bins = [[LightGroup::NONE; BINS]; 3];
    for item in items.iter() {
        let group = LightGroup::of(item);
        for (axis, bins) in bins.iter_mut().enumerate() {
            bins[bin(item, axis)].merge(&group);
        }
    }
    let mut best = Cut { cost: [f32::INFINITY; 2], axis: 0, first: 0 };
    for (axis, bins) in bins.iter().enumerate() {
        best_cut(&bins[..count], axis, &mut best);
    }
    if best.cost[0] == f32::INFINITY {
        // All in one place: what they cost does not matter.
        let half = items.len() / 2;
        return [(half, 0.0), (items.len() - half, 0.0)];
    }
    let lower = partition(items, |item| bin(item, best.axis) < best.first);
    [(lower, best.cost[0]), (items.len() - lower, best.cost[1])]
}

/// A split between two bins.
struct Cut {
    /// Costs of both groups.
    cost: [f32; 2],
    axis: usize,
    /// The first bin of the upper group.
    first: usize,
}

/// Sets `best` to the cheapest split between these bins, if it is cheaper.
fn best_cut(bins: &[LightGroup], axis: usize, best: &mut Cut) {
    let mut above = [0.0; BINS];
    let mut upper = LightGroup::NONE;
    for (i, bin) in bins.iter().enumerate().rev() {
        upper.merge(bin);
        above[i] = if upper.count > 0 { upper.cost() } else { f32::INFINITY };
    }
    let mut lower = LightGroup::NONE;
    for (i, bin) in bins.iter().enumerate().take(bins.len() - 1) {
        lower.merge(bin);
        let cost = if lower.count > 0 { [lower.cost(), above[i + 1]] } else { [f32::INFINITY; 2] };
        if cost[0] + cost[1] < best.cost[0] + best.cost[1] {
            *best = Cut { cost, axis, first: i + 1 };
        }
    }
}

/// Moves items that are `lower` to the front, and returns their number.
fn partition(items: &mut [Item], lower: impl Fn(&Item) -> bool) -> usize {
    let mut count = 0;
    for i in 0..items.len() {
        if lower(&items[i]) {
            items.swap(i, count);
            count += 1;
        }
    }
    count
}

/// Repeatedly splits the group with the highest cost, until there are `most` groups or all are single lights. Returns their
/// sizes.
pub(super) fn groups(items: &mut [Item], most: usize) -> Vec<usize> {
    if items.len() <= most {
        return vec![1; items.len()];
    }
    // Size and cost of each; single lights are never split.
    let mut groups = vec![(items.len(), f32::INFINITY)];
    while groups.len() < most {
        let several = groups.iter().enumerate().filter(|(_, group)| group.0 > 1);
        let costliest = several.reduce(|a, b| if b.1.1 > a.1.1 { b } else { a });
        let at = costliest.expect("there are more lights than groups").0;
        let begin: usize = groups[..at].iter().map(|group| group.0).sum();
        let parts = split(&mut items[begin..begin + groups[at].0]);
        groups.splice(at..=at, parts);
    }
    groups.into_iter().map(|group| group.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At x = 0, 1/2 and 1 the measure of the cone is 1, 3.57 and 4 times π.
    #[test]
    fn the_cost_of_a_group_is_its_power_extent_and_cone() {
        let group =
            |along: f32| LightGroup { count: 2, power: 3.0, along: Vec3::X * along, low: Vec3::ZERO, high: Vec3::splat(2.0) };
        for (along, cone) in [(3.0, 1.0), (1.5, 3.57), (0.0, 4.0)] {
            let cost = group(along).cost();
            assert!((cost / (3.0 * 12.0) - cone).abs() < 1e-4, "{along}: {cost}");
        }
        assert_eq!(LightGroup { power: 0.0, ..group(0.0) }.cost(), 0.0);
    }
}
