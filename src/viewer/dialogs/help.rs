//! The window that lists keys and mouse.
use egui::{Align2, RichText};

const KEYS: [(&str, &[(&str, &str)]); 5] = [
    ("Render", &[("Space", "pause, resume"), (".", "one more sample per pixel, then pause"), ("Ctrl+R", "restart")]),
    (
        "Image",
        &[
            ("P", "drag and wheel pan and zoom the image"),
            ("Wheel, drag", "zoom, pan"),
            ("Ctrl+wheel, middle drag", "the same with any tool; with Camera, middle drag orbits"),
            ("F, double-click", "fit the image to the window"),
            ("1", "one image pixel per screen pixel"),
            ("[  ]", "half a stop darker, brighter"),
            ("V, Shift+V", "next view, previous view"),
            ("B", "drag marks a region to render first; Esc clears it"),
            ("I", "click shows the samples of a pixel and their paths"),
        ],
    ),
    (
        "Camera",
        &[
            ("C", "drag and wheel move the camera"),
            ("Drag, middle drag", "orbit"),
            ("Right drag, Shift+drag", "pan, also Shift+middle drag"),
            ("Wheel", "dolly"),
            ("W A S D", "fly forwards, left, back, right"),
            ("Q  E", "fly down, up"),
            ("On the tab Edit", "letters fly only while nothing is selected"),
            ("Arrows", "turn"),
            ("Shift", "fly and turn faster"),
            ("Home", "the scene's camera"),
        ],
    ),
    (
        "Scene and selected object",
        &[
            ("Click", "select an object, or the icon of a light; Esc clears the selection"),
            ("Shift+A", "add a shape, a light, a material or a texture, on the tab Edit"),
            ("Drag from the list", "assign a material or a texture to an object"),
            ("Drop a file", "open a scene; add a mesh, a texture or a sky"),
            ("Right click", "in the list or the image: duplicate, rename, delete, change type, rest on floor"),
            ("F2, double click", "in the list on the tab Edit: rename the selected part"),
            ("L", "look at the object"),
            ("Shift+D", "duplicate and move"),
            ("X, Delete", "delete"),
            ("G  R  S", "move, rotate, scale, while the pointer is over the image"),
            ("X  Y  Z", "then: restrict to an axis (Shift: to a plane)"),
            ("0 … 9  .  −", "then: type the exact value"),
            ("Ctrl", "then: snap to steps"),
            ("Enter, click", "then: keep; Esc or right click discards"),
        ],
    ),
    (
        "Window",
        &[
            ("Ctrl+Z, Ctrl+Shift+Z, Ctrl+Y", "undo, redo: scene, camera, settings, stop target, view"),
            ("Ctrl+O", "open a scene"),
            ("Ctrl+S", "save the scene"),
            ("Ctrl+E", "save the image"),
            ("Ctrl+C", "copy the image, or the error message that is open"),
            ("F1", "this help"),
            ("F2  F3  F4  F5", "convergence, compare, bounces, pixel"),
            ("F6", "gallery of scenes"),
            ("Ctrl + or -, Ctrl+0", "larger or smaller interface; reset"),
            ("F11", "full screen"),
            ("F12", "frame times of the window"),
            ("Esc", "close"),
        ],
    ),
];

/// Shows the keys while `is_open` is set. Returns whether the tour is to start.
pub fn show(ctx: &egui::Context, is_open: &mut bool) -> bool {
    let (mut open, mut tour) = (*is_open, false);
    egui::Window::new("Keyboard and mouse")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            let most = ctx.content_rect().height() - 130.0;
            egui::ScrollArea::vertical().max_height(most).min_scrolled_height(most).show(ui, keys);
            tour = ui
                .button("Take the tour")
                .on_hover_text("Shows noise, bounces, roulette and bidirectional paths in five short steps.")
                .clicked();
        });
    *is_open = open && !tour;
    tour
}

fn keys(ui: &mut egui::Ui) {
    egui::Grid::new("help").num_columns(2).spacing([24.0, 5.0]).show(ui, |ui| {
        for (group, keys) in KEYS {
            ui.label(RichText::new(group).strong());
            ui.end_row();
            for (key, does) in keys {
                ui.label(RichText::new(*key).monospace());
                ui.label(*does);
                ui.end_row();
            }
            ui.end_row();
        }
    });
}
