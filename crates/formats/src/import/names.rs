//! Unique names.
use std::collections::{HashMap, HashSet};

/// Longer names are cut: each object repeats the name of its material.
const LONGEST: usize = 120;

/// The names that are given so far in one table, such as that of the materials.
#[derive(Clone, Debug, Default)]
pub struct Names {
    taken: HashSet<String>,
    /// The last number that was appended to a name.
    numbers: HashMap<String, usize>,
}

impl Names {
    /// A name that is not taken yet: `wanted`, or `wanted 2` and so on. `fallback` replaces an empty one.
    pub fn unique(&mut self, wanted: &str, fallback: &str) -> String {
        let wanted = wanted.trim();
        let base: String = if wanted.is_empty() { fallback } else { wanted }.chars().take(LONGEST).collect();
        if self.taken.insert(base.clone()) {
            return base;
        }
        let number = self.numbers.entry(base.clone()).or_insert(1);
        loop {
            *number += 1;
            let name = format!("{base} {number}");
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_unless_they_are_taken() {
        let mut names = Names::default();
        let given = ["Wood", "Wood", "Wood 2", "", " ", "Wood", "é"].map(|name| names.unique(name, "material"));
        assert_eq!(given, ["Wood", "Wood 2", "Wood 2 2", "material", "material 2", "Wood 3", "é"]);
    }

    #[test]
    fn long_names_are_cut_and_stay_unique() {
        let mut names = Names::default();
        let long = "ü".repeat(1000);
        let given = [0; 2].map(|_| names.unique(&long, "material"));
        assert!(given[0] == "ü".repeat(LONGEST) && given[1] == format!("{} 2", given[0]));
    }
}
