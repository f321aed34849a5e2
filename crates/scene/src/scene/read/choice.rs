//! Reads a choice: the alternative that a table or a name selects.
use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use super::reader::Reader;
use crate::scene::wording::unknown;
use noisefall_base::declare::{Alternative, Choice, Entry, Looks, Parameter, Path};

impl<'t> Reader<'t> {
    /// The alternative that a name stands for.
    pub(super) fn choose_by_name(&mut self, choice: &Choice, value: &'t Spanned<DeValue<'t>>, now: usize) -> usize {
        let name = value.get_ref().as_str().unwrap_or_default();
        let takes_name = |outline: &[Entry]| !outline.iter().any(|entry| entry.parameter.is_required);
        let error = match choice.alternatives.iter().position(|alternative| alternative.name == name) {
            Some(place) if takes_name(&choice.alternatives[place].outline) => return place,
            Some(_) => self.source.error(value.span(), format!("`{name}` needs a value"), format!("write {{ {name} = … }}")),
            None => {
                let named = |name| Entry { parameter: Parameter::new(name, ""), looks: Looks::Text };
                let names = choice.alternatives.iter().filter(|alternative| takes_name(&alternative.outline));
                let names: Vec<Entry> = names.map(|alternative| named(alternative.name)).collect();
                unknown(self.source, value.span(), "value", name, &names)
            }
        };
        self.fail(error);
        now
    }

    /// The alternative whose keys the table has.
    pub(super) fn choose_by_keys(&mut self, choice: &Choice, table: &'t DeTable<'t>, now: usize) -> usize {
        let given = |outline: &[Entry]| outline.iter().find_map(|entry| table.get_key_value(entry.parameter.key));
        let own: Vec<_> = choice.alternatives.iter().map(|alternative| given(&alternative.outline)).collect();
        let mut places = (0..own.len()).filter(|place| own[*place].is_some());
        let (what, span) = (choice.what, self.frame().span.clone());
        match (places.next(), places.next()) {
            (Some(place), None) => place,
            (Some(first), Some(second)) => {
                let [a, b] = [first, second].map(|place| choice.alternatives[place].name);
                let place = own[second].map_or(span, |(key, _)| key.span());
                let message = format!("`{a}` and `{b}` exclude each other: give only one {what}");
                let error = self.source.error(place, message, "remove one of them");
                self.fail(error);
                first
            }
            _ => {
                let is_optional =
                    |alternative: &Alternative| !alternative.outline.iter().any(|entry| entry.parameter.is_required);
                if is_optional(&choice.alternatives[now]) {
                    return now;
                }
                let names: Vec<String> =
                    choice.alternatives.iter().map(|alternative| format!("`{}`", alternative.name)).collect();
                let table = self.path.0.last().map_or_else(|| what.to_owned(), |step| Path(vec![step.clone()]).to_string());
                let message = format!("`{table}` has none of {}", names.join(", "));
                let error = self.source.error(span, message, format!("give exactly one {what}"));
                self.frame().missing.insert(0, error);
                self.frame().chooses_nothing = true;
                now
            }
        }
    }
}
