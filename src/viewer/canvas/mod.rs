//! The picture: zoom, camera moves, overlays.
pub mod black_notice;
pub mod drawing;
mod flight;
#[cfg_attr(not(test), expect(dead_code, reason = "the window selects nothing yet"))]
pub mod framing;
#[cfg_attr(not(test), expect(dead_code, reason = "the window selects nothing yet"))]
pub mod gizmo;
pub mod interaction;
pub mod navigation;
pub mod overlay;
#[cfg_attr(not(test), expect(dead_code, reason = "the window selects nothing yet"))]
pub mod picking;
pub mod picture_area;
pub mod picture_view;
#[cfg_attr(not(test), expect(dead_code, reason = "the window selects nothing yet"))]
pub mod projection;
#[cfg_attr(not(test), expect(dead_code, reason = "the window selects nothing yet"))]
pub mod selection;
