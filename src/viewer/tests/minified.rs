//! An image with more pixels than the screen: every pixel counts.
use std::sync::Arc;

use noisefall_render::render::Frame;

use super::*;
use crate::viewer::background::{display_image::render, display_request::DisplayRequest};

/// The texture of the image.
fn texture_size(window: &Window) -> [usize; 2] {
    window.state().results.textures[0].as_ref().expect("an image is shown").size()
}

#[test]
fn fit_averages_over_the_pixels_of_the_screen() {
    let mut window = window("furnace");
    assert_eq!(texture_size(&window), [96, 64], "a magnified image has its own pixels");
    window.state_mut().budget_mut().max_spp = Some(1);
    window.state_mut().camera_mut().resolution = [2000, 250];
    wait(&mut window, "a large image", |app| {
        app.shown_frame().as_ref().is_some_and(|frame| frame.width == 2000 && frame.spp == 1)
    });
    wait(&mut window, "its texture", |app| {
        let size = app.results.textures[0].as_ref().map(egui::TextureHandle::size);
        app.picture_view().on_screen().map(|size| size.map(|side| side as usize)) == size
    });
    let [width, height] = texture_size(&window);
    assert!(width < 1280 && (width as f32 / height as f32 - 8.0).abs() < 0.1, "{width} {height}");
    // One pixel for one: nothing is averaged.
    click(&mut window, "1:1");
    wait(&mut window, "all pixels", |app| app.results.textures[0].as_ref().is_some_and(|texture| texture.size() == [2000, 250]));
}

#[test]
fn thin_lines_are_seen_however_small_the_picture_is() {
    let mut window = window("furnace");
    let app = window.state_mut();
    // A column in six is white: where the image has a sixth of its pixels, all have as much of it.
    let radiance = (0..96 * 64).map(|i| if i % 6 == 3 { [1.0; 3] } else { [0.0; 3] }).collect();
    let striped = Frame { width: 96, height: 64, full_resolution: [96, 64], radiance, ..Frame::default() };
    let request = app.display_request(Arc::new(striped));
    let shown = render(DisplayRequest { on_screen: Some([16, 11]), ..request });
    assert_eq!(shown.image.size, [16, 11]);
    let codes = || shown.image.pixels.iter().map(egui::Color32::r);
    let (least, most) = (codes().min().expect("pixels"), codes().max().expect("pixels"));
    assert!(most - least <= 1 && most.abs_diff(113) <= 1, "a sixth of white has the code 113: {least} {most}");
}
