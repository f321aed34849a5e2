//! Scenes to begin with.

/// A scene to begin with.
#[derive(Clone, Copy, Debug)]
pub struct Template {
    /// What a menu calls it.
    pub title: &'static str,
    /// One sentence: what it is for.
    pub doc: &'static str,
    /// The text of a scene file.
    pub text: &'static str,
}

/// All of them, in the order of a menu.
pub const TEMPLATES: [Template; 3] = [
    Template {
        title: "Empty room",
        doc: "A room without its front wall, lit by a lamp below the ceiling.",
        text: include_str!("templates/empty_room.toml"),
    },
    Template {
        title: "Studio",
        doc: "A ball on a seamless backdrop, lit by two soft boxes.",
        text: include_str!("templates/studio.toml"),
    },
    Template {
        title: "Furnace",
        doc: "A ball in uniform light: a material that absorbs nothing is invisible.",
        text: include_str!("templates/furnace.toml"),
    },
];
