//! The picture: zoom, camera moves, overlays.
pub mod black_notice;
pub mod drawing;
mod flight;
pub mod interaction;
pub mod navigation;
pub mod overlay;
pub mod picture_area;
pub mod picture_view;
#[cfg_attr(not(test), expect(dead_code, reason = "no gizmo is drawn yet"))]
pub mod projection;
