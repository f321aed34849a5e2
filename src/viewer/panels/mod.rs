//! Panels: each shows what it is given, and returns what was asked for.
pub mod camera;
pub mod display;
pub mod frame_times;
#[cfg_attr(not(test), expect(dead_code, reason = "the window edits no scenes yet"))]
pub mod inspector;
pub mod objects;
#[cfg_attr(not(test), expect(dead_code, reason = "the window edits no scenes yet"))]
pub mod outliner;
pub mod pixel_readout;
pub mod presets;
pub mod sampling;
pub mod scene;
pub mod status_bar;
pub mod stop;
#[cfg_attr(not(test), expect(dead_code, reason = "the window edits no scenes yet"))]
pub mod subject;
pub mod toolbar;
pub mod views;
pub mod window;
