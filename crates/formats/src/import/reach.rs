//! Files that a scene may read without the permission of the user. All paths are free of links.
use std::path::{Component, Path, PathBuf};

/// Steps upwards to a folder that scenes share, as many as Mitsuba's own scenes take.
const HIGHEST: usize = 3;

/// Why a file within a folder is not read; `None` if it is.
pub fn refusal(folder: &Path, file: &Path) -> Option<&'static str> {
    match file.strip_prefix(folder) {
        Err(_) => Some("lies outside the folder of the scene"),
        Ok(inside) if is_hidden(inside) => Some("is hidden, or lies in a hidden folder"),
        Ok(_) => None,
    }
}

/// Why a folder that a scene names as one of those that it shares with others is not read; `None` if it is. `own` is the folder of the
/// scene, and `named` a relative path that leads from there to `shared`.
pub fn refusal_to_share(own: &Path, named: &Path, shared: &Path) -> Option<&'static str> {
    if let Ok(inside) = shared.strip_prefix(own) {
        return is_hidden(inside).then_some("is hidden, or lies in a hidden folder");
    }
    if own.starts_with(shared) {
        return Some("holds the folder of the scene");
    }
    let common: PathBuf = own.components().zip(shared.components()).take_while(|(a, b)| a == b).map(|(part, _)| part).collect();
    let steps = own.components().count() - common.components().count();
    let above = || common.components().any(|part| matches!(part, Component::Normal(_)));
    if steps > HIGHEST || !above() {
        return Some("is too far above the folder of the scene");
    }
    if shared.strip_prefix(&common).is_ok_and(is_hidden) {
        return Some("is hidden, or lies in a hidden folder");
    }
    (without_links(own, named) != shared).then_some("lies behind a link that leads out of the folder of the scene")
}

/// Where a relative path leads from a folder if there are no links.
fn without_links(from: &Path, named: &Path) -> PathBuf {
    let mut path = from.to_owned();
    for part in named.components() {
        match part {
            Component::Normal(name) => path.push(name),
            Component::ParentDir => _ = path.pop(),
            _ => {}
        }
    }
    path
}

/// Whether a part of a path is hidden: keys, passwords and histories are.
fn is_hidden(path: &Path) -> bool {
    path.components().any(|part| part.as_os_str().as_encoded_bytes().starts_with(b"."))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_the_folder_are_read_unless_they_are_hidden() {
        let refused = |file: &str| refusal(Path::new("/home/a/.scenes/room"), Path::new(file));
        assert_eq!(refused("/home/a/.scenes/room/textures/wood.png"), None, "the user chose the folder");
        assert!(refused("/home/a/.scenes/room2/wood.png").is_some_and(|why| why.contains("outside")));
        for hidden in ["/home/a/.scenes/room/.ssh/id", "/home/a/.scenes/room/.netrc"] {
            assert!(refused(hidden).is_some_and(|why| why.contains("hidden")), "{hidden}");
        }
    }

    #[test]
    fn a_folder_is_shared_if_it_is_near_in_sight_and_not_behind_a_link() {
        let refused = |named: &str, shared: &str| {
            refusal_to_share(Path::new("/home/a/scenes/room"), Path::new(named), Path::new(shared)).unwrap_or_default()
        };
        for (named, shared) in [
            ("textures", "/home/a/scenes/room/textures"),
            ("link", "/home/a/scenes/room/textures"),
            ("../common", "/home/a/scenes/common"),
            ("./../../other/./maps", "/home/a/other/maps"),
            ("../../../b", "/home/b"),
        ] {
            assert_eq!(refused(named, shared), "", "{named}");
        }
        for (named, shared, why) in [
            ("..", "/home/a/scenes", "holds the folder"),
            ("../../../..", "/", "holds the folder"),
            ("../../../../etc", "/etc", "too far above"),
            ("../../.ssh", "/home/a/.ssh", "hidden"),
            ("../../.config/keys", "/home/a/.config/keys", "hidden"),
            (".git", "/home/a/scenes/room/.git", "hidden"),
            ("l", "/home/a/private", "behind a link"),
            ("../l", "/home/a/private", "behind a link"),
            ("l/../common", "/home/a/common", "behind a link"),
            ("l", "/etc", "too far above"),
        ] {
            assert!(refused(named, shared).contains(why), "{named}: {}", refused(named, shared));
        }
        assert!(refusal_to_share(Path::new("/room"), Path::new("../etc"), Path::new("/etc")).is_some(), "all of the disk");
    }
}
