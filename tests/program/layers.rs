//! Folders of the window depend downwards only. The order of the crates is for cargo to check.
use std::collections::BTreeSet;

use crate::imports::imports;

/// The folders of the window, from the top down.
const VIEWER: [&[&str]; 6] = [&["app"], &["panels", "dialogs"], &["instruments"], &["canvas"], &["background"], &["widgets"]];

#[test]
fn every_folder_of_the_window_has_its_layer() {
    let of_window = imports().into_keys().filter(|module| module.len() > 2 && module[0] == "viewer");
    let of_window: BTreeSet<String> = of_window.map(|module| module[1].clone()).collect();
    assert_eq!(of_window, VIEWER.iter().copied().flatten().map(|name| (*name).to_owned()).collect());
}

#[test]
fn arrows_between_folders_of_the_window_point_down() {
    let mut arrows = 0;
    let folder = |module: &[String]| (module.first()? == "viewer").then(|| module.get(1).cloned())?;
    for (module, used) in imports() {
        let name = module.join("/");
        for used in used {
            if module[..1] == ["viewer"] {
                assert!(used[..1] != ["cli"], "{name} knows the command line");
            }
            let (Some(from), Some(to)) = (folder(&module), folder(&used)) else { continue };
            let level = |folder: &str| VIEWER.iter().position(|layer| layer.contains(&folder));
            arrows += 1;
            if from != to {
                assert!(level(&from) < level(&to), "{name} uses {to}, which is not below {from}");
            }
        }
    }
    assert!(arrows > 100, "the search finds arrows: {arrows}");
}
