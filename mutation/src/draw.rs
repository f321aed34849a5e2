//! Draws mutants over all folders, in the same way for the same seed.
use std::collections::{BTreeMap, HashMap, HashSet};

use crate::mutant::Mutant;

/// Every folder has at least this many mutants, if it has places for them.
const LEAST: usize = 3;
/// At most this many in one function, or one careful test would count for many.
const IN_ONE_FUNCTION: usize = 2;

pub struct Draw {
    /// All candidates, in the order in which they are drawn.
    order: Vec<Mutant>,
    /// How many each folder is to have; all if absent.
    quotas: Option<BTreeMap<String, usize>>,
    /// Those that are always among them.
    pub given: Vec<Mutant>,
    /// Keys of those that do not compile.
    pub rejected: HashSet<String>,
}

impl Draw {
    /// Draws all of them.
    pub fn all(candidates: Vec<Mutant>) -> Draw {
        Draw { order: candidates, quotas: None, given: Vec::new(), rejected: HashSet::new() }
    }

    pub fn new(mut candidates: Vec<Mutant>, count: usize, seed: u64) -> Draw {
        let quotas = quotas(&candidates, count);
        let mut kinds: HashMap<(String, &str), f64> = HashMap::new();
        for mutant in &candidates {
            *kinds.entry((mutant.folder().to_owned(), mutant.operator)).or_default() += 1.0;
        }
        // Literals are many and early returns are few: a kind of which there are n is drawn in proportion to √n.
        let mut random = Random(seed);
        candidates.sort_by_cached_key(|mutant| {
            let weight = 1.0 / kinds[&(mutant.folder().to_owned(), mutant.operator)].sqrt();
            (-random.next().ln() / weight * 1e12) as u64
        });
        Draw { order: candidates, quotas: Some(quotas), given: Vec::new(), rejected: HashSet::new() }
    }

    /// The mutants drawn so far; with `spare`, some more of each folder in place of those that will not compile.
    pub fn mutants(&self, spare: bool) -> Vec<Mutant> {
        let compiling = self.order.iter().filter(|mutant| !self.rejected.contains(&mutant.key()));
        let Some(quotas) = &self.quotas else { return in_order(compiling.cloned().collect()) };
        let quota = |quota: usize| if spare { quota + quota / 2 + 2 } else { quota };
        let mut left: HashMap<&str, usize> = quotas.iter().map(|(folder, &count)| (folder.as_str(), quota(count))).collect();
        let mut functions: HashMap<(&str, &str), usize> = HashMap::new();
        let mut drawn = self.given.clone();
        for mutant in compiling {
            let left = left.entry(mutant.folder()).or_default();
            let in_function = functions.entry((&mutant.file, &mutant.function)).or_default();
            if *left > 0 && *in_function < IN_ONE_FUNCTION {
                *left -= 1;
                *in_function += 1;
                drawn.push(mutant.clone());
            }
        }
        in_order(drawn)
    }
}

/// By their places.
fn in_order(mut mutants: Vec<Mutant>) -> Vec<Mutant> {
    mutants.sort_by(|a, b| (&a.file, a.range.start, a.range.end).cmp(&(&b.file, b.range.start, b.range.end)));
    mutants
}

/// Shares the count among the folders by their lines that could be wrong.
fn quotas(candidates: &[Mutant], count: usize) -> BTreeMap<String, usize> {
    let mut lines: BTreeMap<String, HashSet<(&str, usize)>> = BTreeMap::new();
    for mutant in candidates {
        lines.entry(mutant.folder().to_owned()).or_default().insert((&mutant.file, mutant.line));
    }
    let all: usize = lines.values().map(HashSet::len).sum();
    let rest = count.saturating_sub(LEAST * lines.len()) as f64;
    let quota = |lines: usize| LEAST.min(count / 20 + 1) + (rest * lines as f64 / all as f64).round() as usize;
    lines.iter().map(|(folder, lines)| (folder.clone(), quota(lines.len()))).collect()
}

/// SplitMix64.
struct Random(u64);

impl Random {
    /// In (0, 1).
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (((x ^ (x >> 31)) >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::finder;

    fn candidates() -> Vec<Mutant> {
        let function = |i: usize| format!("fn f{i}(a: u32, b: u32) {{ if a < b + {i} {{ g(a, b); }}\n h(a * b - 3); }}\n");
        let file = |lines| (0..lines).map(function).collect::<String>();
        let files = [("src/a/x.rs", file(60)), ("src/b/y.rs", file(20)), ("src/c/z.rs", file(2))];
        files.iter().flat_map(|(name, text)| finder::mutants(name, text).expect("it is Rust")).collect()
    }

    #[test]
    fn folders_share_the_count_by_lines_and_functions_have_few() {
        let draw = Draw::new(candidates(), 40, 1);
        let mutants = draw.mutants(false);
        let of = |folder: &str| mutants.iter().filter(|mutant| mutant.folder() == folder).count();
        assert_eq!([of("src/a"), of("src/b"), of("src/c")], [26, 11, 4]);
        for mutant in &mutants {
            assert!(
                mutants.iter().filter(|other| (&other.file, &other.function) == (&mutant.file, &mutant.function)).count() <= 2
            );
        }
    }

    #[test]
    fn the_seed_decides_and_mutants_that_do_not_compile_are_replaced() {
        let keys = |draw: &Draw| draw.mutants(false).iter().map(Mutant::key).collect::<HashSet<_>>();
        let mut draw = Draw::new(candidates(), 40, 1);
        let first = keys(&draw);
        assert_eq!(first, keys(&Draw::new(candidates(), 40, 1)));
        assert_ne!(first, keys(&Draw::new(candidates(), 40, 2)));
        let spare: HashSet<String> = draw.mutants(true).iter().map(Mutant::key).collect();
        assert!(spare.len() > first.len() && spare.is_superset(&first));
        let bad = first.iter().next().expect("there is one").clone();
        draw.rejected.insert(bad.clone());
        assert!(!keys(&draw).contains(&bad) && keys(&draw).len() == first.len());
    }
}
