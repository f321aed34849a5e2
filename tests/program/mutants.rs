//! The mutants of the mutation run fit the source.
use std::path::Path;

#[test]
fn every_mutant_has_one_place() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut wrong = Vec::new();
    for list in ["mutation/mutants.toml", "crates/lab/mutants.toml"] {
        let text = std::fs::read_to_string(root.join(list)).expect("the list is there");
        let table: toml::Table = text.parse().expect("it is TOML");
        let mutants = table["mutant"].as_array().expect("a list of tables");
        assert!(mutants.len() > 30, "{list}");
        for mutant in mutants {
            let [name, file, original] = ["name", "file", "original"].map(|key| mutant[key].as_str().expect("text"));
            let count = std::fs::read_to_string(root.join(file)).map_or(0, |source| source.matches(original).count());
            if count != 1 {
                wrong.push(format!("{list}: {name}: {count} places in {file}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
