//! Scenes to start from.

/// A scene to start from.
#[derive(Clone, Copy, Debug)]
pub struct Template {
    /// Its title in a menu.
    pub title: &'static str,
    /// One sentence that describes it.
    pub doc: &'static str,
    /// The text of a scene file.
    pub text: &'static str,
}

/// All templates, in the order of the menu.
pub const TEMPLATES: [Template; 3] = [
    Template {
        title: "Empty room",
        doc: "A room without its front wall, lit by a light below the ceiling.",
        text: include_str!("empty_room.toml"),
    },
    Template { title: "Studio", doc: "A ball on a seamless backdrop, lit by two soft boxes.", text: include_str!("studio.toml") },
    Template {
        title: "Furnace",
        doc: "A ball in uniform light: a material that absorbs nothing is invisible.",
        text: include_str!("furnace.toml"),
    },
];
