//! Rewrites a file so that numbers switch its mutants: one build serves all of them.
use std::ops::Range;

use crate::mutant::{Form, Mutant};

/// A file with mutants in it, and where each one lies in it.
pub struct Mutated {
    pub text: String,
    pub places: Vec<(Range<usize>, u32)>,
}

/// Plants mutants, each with its number, in the text of their file. `switch` is the path of the function that tells whether a
/// number is on.
pub fn insert(source: &str, mutants: &[(u32, &Mutant)], switch: &str) -> Mutated {
    let mut mutants = mutants.to_vec();
    mutants.sort_by_key(|(id, mutant)| (mutant.range.start, usize::MAX - mutant.range.end, *id));
    let mut inserted = Mutated { text: String::new(), places: Vec::new() };
    write(source, 0..source.len(), &mutants, switch, &mut inserted);
    inserted
}

/// Writes part of the source. The changed branch of a mutant is plain text; others within its place are in the branch as it was.
fn write(source: &str, range: Range<usize>, mut mutants: &[(u32, &Mutant)], switch: &str, to: &mut Mutated) {
    let mut at = range.start;
    while let [(id, mutant), rest @ ..] = mutants {
        let within = rest.iter().take_while(|(_, inner)| inner.range.start < mutant.range.end).count();
        to.text.push_str(&source[at..mutant.range.start]);
        let start = to.text.len();
        let (before, after) = match mutant.form {
            Form::Value => (format!("(if {switch}({id}) {{ {} }} else {{ ", mutant.changed), " })"),
            Form::Place => (format!("(*if {switch}({id}) {{ &{} }} else {{ &", mutant.changed), " })"),
            Form::Statement => (format!("if {switch}({id}) {{ {} }} else {{ ", mutant.changed), " }"),
        };
        to.text.push_str(&before);
        write(source, mutant.range.clone(), &rest[..within], switch, to);
        to.text.push_str(after);
        to.places.push((start..to.text.len(), *id));
        at = mutant.range.end;
        mutants = &rest[within..];
    }
    to.text.push_str(&source[at..range.end]);
}

impl Mutated {
    /// The innermost mutant at these bytes, else every mutant that they touch.
    pub fn at(&self, bytes: &Range<usize>) -> Vec<u32> {
        let around = self.places.iter().filter(|(place, _)| place.start <= bytes.start && bytes.end <= place.end);
        match around.min_by_key(|(place, _)| place.len()) {
            Some((_, id)) => vec![*id],
            None => {
                let touched = self.places.iter().filter(|(place, _)| place.start < bytes.end && bytes.start < place.end);
                touched.map(|(_, id)| *id).collect()
            }
        }
    }

    /// The mutant that is nearest to a byte. What it changes of types may come out elsewhere in the function.
    pub fn nearest(&self, byte: usize) -> Option<u32> {
        let distance = |place: &Range<usize>| place.start.saturating_sub(byte) + byte.saturating_sub(place.end);
        self.places.iter().min_by_key(|(place, _)| distance(place)).map(|(_, id)| *id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::finder;

    #[test]
    fn faults_within_mutants_are_switched_one_by_one() {
        let source = "fn f() { g(a + b.x); }";
        let all = finder::mutants("src/a.rs", source).expect("it is Rust");
        let numbered: Vec<_> = (1..).zip(&all).collect();
        let inserted = insert(source, &numbered, "on");
        assert_eq!(
            inserted.text,
            "fn f() { if on(1) {  } else { g((if on(2) { a - b.x } else { a + (*if on(3) { &b.y } else { &b.x }) })); } }"
        );
        let at = |text: &str| {
            let start = inserted.text.find(text).expect("it is there");
            inserted.at(&(start..start + text.len()))
        };
        assert_eq!((at("b.y"), at("a - b.x"), at("g(")), (vec![3], vec![2], vec![1]));
        assert_eq!(inserted.at(&(0..inserted.text.len())).len(), 3);
        assert_eq!((inserted.at(&(0..2)), inserted.nearest(1)), (Vec::new(), Some(1)));
    }

    #[test]
    fn several_mutants_of_one_place_are_switched_one_by_one() {
        let source = "fn f() { a < b }";
        let all = finder::mutants("src/a.rs", source).expect("it is Rust");
        let inserted = insert(source, &(1..).zip(&all).collect::<Vec<_>>(), "on");
        assert_eq!(inserted.text, "fn f() { (if on(1) { a <= b } else { (if on(2) { a > b } else { a < b }) }) }");
    }
}
