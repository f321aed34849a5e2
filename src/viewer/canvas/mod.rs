//! The image: zoom, camera moves, overlays.
pub mod drawing;
mod flight;
pub mod framing;
pub mod gizmo;
pub mod interaction;
pub mod light_icons;
pub mod navigation;
pub mod notice;
pub mod overlay;
pub mod picking;
pub mod picture_area;
pub mod picture_view;
pub mod projection;
pub mod selection;
