//! The denoised view.
use noisefall_render::render::{denoise::LABEL, view::View};

use super::*;

#[test]
fn the_denoised_view_has_its_label_and_is_computed_only_while_it_is_shown() {
    let mut window = window("cornell_spheres");
    window.state_mut().look_mut().view = View::Denoised;
    let is_labelled = |app: &App| app.results.legend.as_ref().is_some_and(|legend| legend.title == LABEL);
    wait(&mut window, "the denoised image", is_labelled);
    window.run_steps(2);
    assert!(window.query_by_label("biased: denoised").is_some() && window.query_by_label("unbiased").is_none());
    let results = &window.state().results;
    assert!(results.values.radiance.is_some(), "the number under the pointer is denoised too");
    assert!(results.shown.as_ref().is_some_and(|frame| frame.halves.is_some()));
    window.state_mut().look_mut().view = View::Radiance;
    let is_plain =
        |app: &App| app.results.legend.is_none() && app.shown_frame().as_ref().is_some_and(|frame| frame.halves.is_none());
    wait(&mut window, "a frame without halves", is_plain);
    let state = window.state();
    assert!(state.results.shown.as_ref().is_some_and(|frame| state.background.denoiser.of(frame).is_none()), "nothing is kept");
}
