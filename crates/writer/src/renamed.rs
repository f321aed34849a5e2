//! Rewrites the former names of keys and values in a scene file.
use noisefall_scene::scene::{RENAMED, Renamed};
use toml_edit::{DocumentMut, Item, Key, Table, Value};

use crate::update::like;

/// The text of a scene file with the names of today, and its comments; `None` if it has no former name, or is not TOML.
pub fn renamed(text: &str) -> Option<String> {
    let mut document: DocumentMut = text.parse().ok()?;
    let changes = RENAMED.iter().filter(|renamed| match renamed.place {
        [] => rename_key(document.as_table_mut(), renamed),
        place => rename_value(document.as_item_mut(), place, renamed),
    });
    (changes.count() > 0).then(|| like(text, document.to_string()))
}

/// Renames a key. All entries are put back in their order.
fn rename_key(table: &mut Table, Renamed { former, now, .. }: &Renamed) -> bool {
    if !table.contains_key(former) || table.contains_key(now) {
        return false;
    }
    let keys: Vec<String> = table.iter().map(|(key, _)| key.to_owned()).collect();
    let entries: Vec<(Key, Item)> = keys.iter().filter_map(|key| table.remove_entry(key)).collect();
    for (key, item) in entries {
        let key = if key.get() == *former {
            Key::new(*now).with_leaf_decor(key.leaf_decor().clone()).with_dotted_decor(key.dotted_decor().clone())
        } else {
            key
        };
        table.insert_formatted(&key, item);
    }
    true
}

fn rename_value(file: &mut Item, place: &[&str], Renamed { former, now, .. }: &Renamed) -> bool {
    let item = place.iter().try_fold(file, |item, key| item.as_table_like_mut()?.get_mut(key));
    let Some(value) = item.and_then(Item::as_value_mut).filter(|value| value.as_str() == Some(*former)) else { return false };
    let decor = value.decor().clone();
    *value = Value::from(*now);
    *value.decor_mut() = decor;
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn former_names_are_rewritten_and_the_rest_stays() {
        let old = "# A room.\nformat = 1\nbackground.radiance = 1 # dim\ntitle = 'a'\n[render] # how\nestimator = 'forward' # slow\n\
                   reuse = \"bright\"\n[truth] # known\nradiance = 1\n# two\n[[lamps]]\npoint = {}\n[[objects]]\n[[lamps]] # b\n";
        let new = "# A room.\nformat = 1\nenvironment.radiance = 1 # dim\ntitle = 'a'\n[render] # how\nestimator = \"light_tracing\" # slow\n\
                   reuse = \"outliers\"\n[reference] # known\nradiance = 1\n# two\n[[lights]]\npoint = {}\n[[objects]]\n[[lights]] # b\n";
        assert_eq!(renamed(old).as_deref(), Some(new));
        assert_eq!(renamed(&old.replace('\n', "\r\n")), Some(new.replace('\n', "\r\n")));
        assert_eq!(renamed(new), None);
        let inline = renamed("render = { reuse = 'on', spp = 3 }\n");
        assert_eq!(inline.as_deref(), Some("render = { reuse = \"suffixes\", spp = 3 }\n"));
        assert_eq!(renamed("lamps = ["), None);
    }
}
