//! The list of remarks about a file.
use std::{collections::HashMap, fmt};

use super::Remark;

/// Further remarks are counted only.
const MOST: usize = 1000;

/// Remarks in the order of their first places. Those that differ in their place alone are one, with a count.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remarks {
    list: Vec<Counted>,
    known: HashMap<[String; 3], usize>,
    /// Remarks that are not in the list.
    left_out: usize,
}

/// A remark, with the number of places that it applies to.
#[derive(Clone, Debug, PartialEq)]
pub struct Counted {
    /// The remark about the first place.
    pub remark: Remark,
    /// All places, the first included.
    pub count: usize,
}

impl Remarks {
    /// Adds a remark: see [`Remark`].
    pub fn add(
        &mut self,
        place: impl Into<String>,
        found: impl Into<String>,
        used: impl Into<String>,
        effect: impl Into<String>,
    ) {
        self.push(Remark { place: place.into(), found: found.into(), used: used.into(), effect: effect.into() });
    }

    /// Adds a remark.
    pub fn push(&mut self, remark: Remark) {
        let key = [remark.found.clone(), remark.used.clone(), remark.effect.clone()];
        if let Some(index) = self.known.get(&key) {
            self.list[*index].count += 1;
        } else if self.list.len() < MOST {
            self.known.insert(key, self.list.len());
            self.list.push(Counted { remark, count: 1 });
        } else {
            self.left_out += 1;
        }
    }

    /// The remarks, without those beyond the first thousand.
    pub fn iter(&self) -> std::slice::Iter<'_, Counted> {
        self.list.iter()
    }

    /// Number of different remarks.
    pub fn len(&self) -> usize {
        self.list.len() + self.left_out
    }

    /// Whether everything was imported exactly.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The remarks as text, one line each: the first `most`, and the number of the others.
    pub fn lines(&self, most: usize) -> Vec<String> {
        let mut lines: Vec<String> = self.list.iter().take(most).map(Counted::to_string).collect();
        let others = self.len() - lines.len();
        if others > 0 {
            lines.push(format!("… and {others} more"));
        }
        lines
    }
}

impl fmt::Display for Counted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Remark { place, found, used, effect } = &self.remark;
        let others = match self.count {
            0 | 1 => String::new(),
            2 => " and another place".to_owned(),
            count => format!(" and {} more places", count - 1),
        };
        write!(f, "{place}{others}: {found} → {used}: {effect}")
    }
}

impl Extend<Remark> for Remarks {
    fn extend<I: IntoIterator<Item = Remark>>(&mut self, remarks: I) {
        remarks.into_iter().for_each(|remark| self.push(remark));
    }
}

impl FromIterator<Remark> for Remarks {
    fn from_iter<I: IntoIterator<Item = Remark>>(remarks: I) -> Remarks {
        let mut all = Remarks::default();
        all.extend(remarks);
        all
    }
}

impl From<Vec<Remark>> for Remarks {
    fn from(remarks: Vec<Remark>) -> Remarks {
        remarks.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_remarks_are_one_with_a_count() {
        let mut remarks = Remarks::default();
        for place in ["a.xml:1:1", "a.xml:2:1", "a.xml:3:1"] {
            remarks.add(place, "`hair`", "plastic", "strands look smooth");
        }
        remarks.add("a.xml:4:1", "`disk`", "nothing", "it is missing");
        let shown = remarks.lines(9);
        assert_eq!(shown[0], "a.xml:1:1 and 2 more places: `hair` → plastic: strands look smooth");
        assert_eq!(shown[1], "a.xml:4:1: `disk` → nothing: it is missing");
        assert_eq!(remarks.lines(1)[1], "… and 1 more");
    }

    #[test]
    fn the_list_is_bounded() {
        let remarks: Remarks = (0..5000)
            .map(|i| Remark { place: "a".into(), found: i.to_string(), used: String::new(), effect: String::new() })
            .collect();
        assert_eq!((remarks.iter().len(), remarks.len(), remarks.lines(MOST).len()), (MOST, 5000, MOST + 1));
    }
}
