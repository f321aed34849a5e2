//! Covering arrays: few rows in which all combinations of a few factors appear.
//!
//! D. Cohen, S. Dalal, M. Fredman and G. Patton, "The AETG System: An Approach to Testing Based on Combinatorial Design", IEEE
//! Transactions on Software Engineering 23(7), 1997. Factors may exist only at one level of another factor, as the parameters of a kind
//! do. What cannot be combined is found by asking, and left out.
use rand::{Rng, RngCore, seq::SliceRandom};

use super::marks::{Items, Marks};

/// Rows that are made for each one that is kept.
const CANDIDATES: usize = 3;
/// Rows of a combination that are refused before it counts as impossible.
const MOST_TRIES: usize = 50;

/// Something that varies between rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Factor {
    /// The number of its levels, at least 1.
    pub levels: usize,
    /// The factor before it, and the level of that, where this one exists; `None` if it always does.
    pub parent: Option<(usize, usize)>,
    /// Whether its levels are kinds. What exists at one of them is a parameter of that kind, and is combined with its other parameters and
    /// with kinds, but not with the parameters of other kinds.
    pub is_choice: bool,
}

/// The level of every factor; `None` where the factor does not exist.
pub type Row = Vec<Option<usize>>;

/// A covering array.
#[derive(Default)]
pub struct CoveringArray {
    pub rows: Vec<Row>,
    /// The number of combinations that the rows contain.
    pub covered: usize,
    /// Combinations of (factor, level) that no scene can have.
    pub impossible: Vec<Vec<(usize, usize)>>,
}

/// Makes rows that contain every combination of levels of `strength` factors, 2 or 3. `refused` says which levels of a row cannot be
/// combined, if it cannot be used.
pub fn covering_array(
    factors: &[Factor],
    strength: usize,
    random: &mut dyn RngCore,
    mut refused: impl FnMut(&Row) -> Option<Vec<(usize, usize)>>,
) -> CoveringArray {
    let mut cover = Cover::new(factors);
    let mut missing = Marks::new(&cover.agreements(), strength);
    let mut array = CoveringArray::default();
    let mut tries = 0;
    while let Some(combination) = missing.any(random) {
        if cover.contains_impossible(&combination) || tries > MOST_TRIES {
            if tries > MOST_TRIES {
                array.impossible.push(combination.iter().map(|item| cover.items[*item]).collect());
            }
            tries = 0;
            missing.clear(&cover.set_of(&combination));
            continue;
        }
        let rows = (0..CANDIDATES).map(|_| cover.row(&combination, &missing, random));
        let (_, row) = rows.max_by_key(|(gain, _)| *gain).unwrap_or_default();
        if let Some(levels) = refused(&row).filter(|levels| !levels.is_empty()) {
            tries += 1;
            if cover.forbid(&levels) {
                array.impossible.push(levels);
            }
            continue;
        }
        tries = 0;
        array.covered += missing.clear(&cover.items_of(&row));
        array.rows.push(row);
    }
    array
}

/// All levels of all factors are numbered as items.
struct Cover<'f> {
    factors: &'f [Factor],
    /// The first item of each factor.
    firsts: Vec<usize>,
    /// The factor and the level of each item.
    items: Vec<(usize, usize)>,
    /// The items that each item needs, and itself.
    needs: Vec<Vec<usize>>,
    /// The kind of which each item is a parameter.
    kinds: Vec<Option<usize>>,
    /// Sets of items that cannot be combined.
    impossible: Vec<Vec<usize>>,
}

impl<'f> Cover<'f> {
    fn new(factors: &'f [Factor]) -> Self {
        let (mut firsts, mut items, mut needs) = (Vec::new(), Vec::<(usize, usize)>::new(), Vec::<Vec<usize>>::new());
        for (number, factor) in factors.iter().enumerate() {
            firsts.push(items.len());
            for level in 0..factor.levels {
                let mut own = factor.parent.map_or_else(Vec::new, |(parent, at)| needs[firsts[parent] + at].clone());
                own.push(items.len());
                needs.push(own);
                items.push((number, level));
            }
        }
        let kind = |needs: &Vec<usize>| needs[..needs.len() - 1].iter().copied().find(|item| factors[items[*item].0].is_choice);
        let kinds = needs.iter().map(kind).collect();
        Cover { factors, firsts, needs, kinds, items, impossible: Vec::new() }
    }

    fn item(&self, (factor, level): (usize, usize)) -> usize {
        self.firsts[factor] + level
    }

    fn set_of(&self, items: &[usize]) -> Items {
        let mut set = Items::new(self.items.len());
        items.iter().for_each(|item| set.insert(*item));
        set
    }

    fn items_of(&self, row: &Row) -> Items {
        let levels = row.iter().enumerate().filter_map(|(factor, level)| Some((factor, (*level)?)));
        self.set_of(&levels.map(|level| self.item(level)).collect::<Vec<_>>())
    }

    /// The items with which each item is combined.
    fn agreements(&self) -> Vec<Items> {
        let all = 0..self.items.len();
        let with = |a: usize| self.set_of(&all.clone().filter(|b| self.agree(a, *b)).collect::<Vec<_>>());
        all.clone().map(with).collect()
    }

    /// Whether two items are combined: they and what they need are levels of different factors or the same, and they are not parameters of
    /// two kinds.
    fn agree(&self, a: usize, b: usize) -> bool {
        let clash = |a: usize, b: usize| a != b && self.items[a].0 == self.items[b].0;
        let are_of_two = self.kinds[a].zip(self.kinds[b]).is_some_and(|(a, b)| a != b);
        a != b && !are_of_two && !self.needs[a].iter().any(|a| self.needs[b].iter().any(|b| clash(*a, *b)))
    }

    /// Leaves out a set of levels from now on. Returns false if that was known.
    fn forbid(&mut self, levels: &[(usize, usize)]) -> bool {
        let set: Vec<usize> = levels.iter().map(|level| self.item(*level)).collect();
        let is_new = !self.impossible.contains(&set);
        self.impossible.extend(is_new.then_some(set));
        is_new
    }

    /// Whether items that are needed by these cannot be combined.
    fn contains_impossible(&self, items: &[usize]) -> bool {
        let needed: Vec<usize> = items.iter().flat_map(|item| self.needs[*item].iter().copied()).collect();
        self.impossible.iter().any(|set| set.iter().all(|item| needed.contains(item)))
    }

    /// A row with a combination, and the number of missing combinations in it. Each factor gets the level that adds most of them.
    fn row(&self, combination: &[usize], missing: &Marks, random: &mut dyn RngCore) -> (usize, Row) {
        let mut row: Row = vec![None; self.factors.len()];
        let (mut used, mut listed) = (Items::new(self.items.len()), Vec::new());
        for item in combination.iter().flat_map(|item| &self.needs[*item]) {
            let (factor, level) = self.items[*item];
            if row[factor].replace(level).is_none() {
                used.insert(*item);
                listed.push(*item);
            }
        }
        let mut gain = 1;
        let exists = |row: &Row, factor: usize| self.factors[factor].parent.is_none_or(|(parent, at)| row[parent] == Some(at));
        let mut order: Vec<usize> = (0..self.factors.len()).collect();
        order.shuffle(random);
        // Parameters of a kind follow it.
        loop {
            let mut is_done = true;
            for factor in &order {
                if row[*factor].is_some() || !exists(&row, *factor) {
                    continue;
                }
                let (more, level) = self.best_level(*factor, (&used, &listed), missing, random);
                (gain, row[*factor], is_done) = (gain + more, Some(level), false);
                used.insert(self.item((*factor, level)));
                listed.push(self.item((*factor, level)));
            }
            if is_done {
                return (gain, row);
            }
        }
    }

    /// The level of a factor with most of the missing combinations, one of the first by chance.
    fn best_level(
        &self,
        factor: usize,
        (used, listed): (&Items, &[usize]),
        missing: &Marks,
        random: &mut dyn RngCore,
    ) -> (usize, usize) {
        let count = self.factors[factor].levels;
        let start = random.random_range(0..count);
        let gain = |level: usize| {
            let item = self.item((factor, level));
            let completes =
                |set: &Vec<usize>| set.contains(&item) && set.iter().all(|other| *other == item || used.contains(*other));
            if self.impossible.iter().any(completes) { None } else { Some(missing.among(item, used, listed)) }
        };
        let gains = (start..start + count).map(|level| (gain(level % count), level % count));
        let (gain, level) = gains.reduce(|best, next| if next.0 > best.0 { next } else { best }).unwrap_or((None, 0));
        (gain.unwrap_or(0), level)
    }
}
