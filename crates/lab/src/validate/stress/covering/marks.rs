//! Sets of items, and of combinations of items.
use rand::{Rng, RngCore};

/// A set of items.
#[derive(Clone)]
pub struct Items(Vec<u64>);

impl Items {
    /// An empty set of items below `count`.
    pub fn new(count: usize) -> Items {
        Items(vec![0; count.div_ceil(64)])
    }

    pub fn insert(&mut self, item: usize) {
        self.0[item / 64] |= 1 << (item % 64);
    }

    pub fn contains(&self, item: usize) -> bool {
        self.0[item / 64] >> (item % 64) & 1 == 1
    }

    /// The items of the set in ascending order.
    pub fn list(&self) -> Vec<usize> {
        (0..64 * self.0.len()).filter(|item| self.contains(*item)).collect()
    }
}

/// A set of combinations of items. Each combination of the first items, in every order, has a row of bits for the last one.
pub struct Marks {
    count: usize,
    strength: usize,
    /// Words of a row.
    words: usize,
    bits: Vec<u64>,
}

impl Marks {
    /// All combinations of `strength` items, 2 or 3, that agree with each other.
    pub fn new(agree: &[Items], strength: usize) -> Marks {
        let count = agree.len();
        let words = count.div_ceil(64);
        let mut bits = Vec::with_capacity(count.pow(strength as u32 - 1) * words);
        for a in agree {
            match strength {
                2 => bits.extend(&a.0),
                _ => (0..count).for_each(|b| {
                    let both = a.0.iter().zip(&agree[b].0).map(|(a, b)| a & b);
                    bits.extend(both.map(|word| if a.contains(b) { word } else { 0 }));
                }),
            }
        }
        Marks { count, strength, words, bits }
    }

    /// A combination of the set.
    pub fn any(&self, random: &mut dyn RngCore) -> Option<Vec<usize>> {
        let start = random.random_range(0..self.bits.len());
        let from = |at: usize| Some(at + self.bits[at..].iter().position(|word| *word != 0)?);
        let place = from(start).or_else(|| from(0))?;
        let (mut row, last) = (place / self.words, place % self.words * 64 + self.bits[place].trailing_zeros() as usize);
        let mut items = vec![last];
        for _ in 1..self.strength {
            items.push(row % self.count);
            row /= self.count;
        }
        Some(items)
    }

    /// The number of combinations of an item with others.
    pub fn among(&self, item: usize, others: &Items, listed: &[usize]) -> usize {
        if self.strength == 2 {
            return self.common(item, others);
        }
        listed.iter().map(|other| self.common(item * self.count + other, others)).sum::<usize>() / 2
    }

    /// Removes all combinations of items, and returns their number.
    pub fn clear(&mut self, items: &Items) -> usize {
        let (listed, count) = (items.list(), self.count);
        let rows: Vec<usize> = match self.strength {
            2 => listed,
            _ => listed.iter().flat_map(|a| listed.iter().map(move |b| a * count + b)).collect(),
        };
        let mut cleared = 0;
        for row in rows {
            cleared += self.common(row, items);
            let start = row * self.words;
            self.bits[start..start + self.words].iter_mut().zip(&items.0).for_each(|(word, other)| *word &= !other);
        }
        // Each of them is there in every order of its items.
        cleared / if self.strength == 2 { 2 } else { 6 }
    }

    /// The number of combinations of a row with these items as the last one.
    fn common(&self, row: usize, items: &Items) -> usize {
        let start = row * self.words;
        let both = self.bits[start..start + self.words].iter().zip(&items.0);
        both.map(|(word, other)| (word & other).count_ones() as usize).sum()
    }
}
