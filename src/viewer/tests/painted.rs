//! Places, lengths and colours of painted parts that have no label of their own.
use std::sync::Arc;

use egui::{Color32, Rect, Shape, pos2};
use noisefall_render::render::{
    Frame, Region, Series,
    colour_map::ColourMap,
    view::{Legend, Scale, ZScoreHistogram},
};

use super::{labels::app, *};
use crate::viewer::{canvas::picture_area::PictureArea, instruments::tabs::InstrumentTab};

/// All that a part of the window paints.
fn painted(mut part: impl FnMut(&mut egui::Ui)) -> Vec<Shape> {
    let harness = Harness::builder().with_size(SIZE).build_ui(|ui| part(ui));
    let mut shapes = Vec::new();
    harness.output().shapes.iter().for_each(|clipped| flatten(&clipped.shape, &mut shapes));
    shapes
}

fn flatten(shape: &Shape, into: &mut Vec<Shape>) {
    match shape {
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| flatten(shape, into)),
        shape => into.push(shape.clone()),
    }
}

/// Filled rectangles with their colours, from left to right.
fn fills(shapes: &[Shape]) -> Vec<(Rect, Color32)> {
    let rects = shapes.iter().filter_map(|shape| if let Shape::Rect(rect) = shape { Some((rect.rect, rect.fill)) } else { None });
    let mut fills: Vec<_> = rects.collect();
    fills.sort_by(|a, b| a.0.left().total_cmp(&b.0.left()));
    fills
}

/// Where a text stands.
fn text(shapes: &[Shape], said: &str) -> Rect {
    let rect = |shape: &Shape| match shape {
        Shape::Text(text) if text.galley.text() == said => Some(text.galley.rect.translate(text.pos.to_vec2())),
        _ => None,
    };
    shapes.iter().find_map(rect).unwrap_or_else(|| panic!("{said:?} is not painted"))
}

fn near(found: f32, exact: f32) {
    assert!((found - exact).abs() < 0.6, "{found} is not {exact}");
}

/// An image of 64 × 64 pixels, five points each.
const AREA: PictureArea = PictureArea {
    clip: Rect::from_min_max(pos2(100.0, 100.0), pos2(420.0, 420.0)),
    rect: Rect::from_min_max(pos2(100.0, 100.0), pos2(420.0, 420.0)),
    resolution: vec2(64.0, 64.0),
};

#[test]
fn a_legend_has_its_colours_from_left_to_right_with_their_numbers_below() {
    let mut app = app();
    let scale = Scale { map: ColourMap::Viridis, ends: [1.0, 100.0], log: true, unit: "m" };
    let entries = vec![([200, 10, 20], "first".to_owned()), ([20, 210, 30], "second".to_owned())];
    app.results.legend = Some(Legend { title: "Depth".to_owned(), scale: Some(scale), entries });
    let shapes = painted(|ui| app.overlays(ui, &AREA, None));
    let colour = |place: f32| {
        let [r, g, b] = ColourMap::Viridis.of(place);
        Color32::from_rgb(r, g, b)
    };
    let strips: Vec<_> = fills(&shapes).into_iter().filter(|(rect, _)| (rect.height() - 12.0).abs() < 0.01).collect();
    assert_eq!(strips.len(), 125);
    assert_eq!([strips[0].1, strips[62].1, strips[124].1], [0.5, 62.5, 124.5].map(|i| colour(i / 125.0)));
    let [left, right, bottom] = [strips[0].0.left(), strips[124].0.right() - 0.5, strips[0].0.bottom()];
    near(left, 100.0 + 12.0 + 10.0);
    near(right - left, 250.0);
    let [low, middle, high] = ["1", "10", "100"].map(|number| text(&shapes, number));
    near(low.left(), left);
    near(middle.center().x, (left + right) / 2.0);
    near(high.right(), right);
    assert!([low, middle, high].into_iter().all(|number| number.top() > bottom));
    assert!(text(&shapes, "Depth, m").bottom() < strips[0].0.top());
    let square =
        |r, g, b| fills(&shapes).into_iter().find(|(_, fill)| *fill == Color32::from_rgb(r, g, b)).expect("it is painted").0;
    let (first, second) = (square(200, 10, 20), square(20, 210, 30));
    for (square, name) in [(first, "first"), (second, "second")] {
        let name = text(&shapes, name);
        assert!((name.center().y - square.center().y).abs() < 5.0 && name.left() > square.right(), "{square:?} {name:?}");
    }
    assert!(first.bottom() < second.top() && first.top() > low.bottom());
}

#[test]
fn scores_are_bars_at_their_places_under_the_normal_curve() {
    let mut app = app();
    let mut density = vec![0.0; 50];
    (density[30], density[10]) = (0.5, 0.25);
    app.results.scores = Some(ZScoreHistogram { density, beyond: 0.05, mean: 0.1, deviation: 1.2 });
    let shapes = painted(|ui| app.overlays(ui, &AREA, None));
    let blue = Color32::from_rgb(86, 180, 233);
    let bars: Vec<Rect> =
        fills(&shapes).into_iter().filter(|(rect, fill)| *fill == blue && rect.height() > 1.0).map(|bar| bar.0).collect();
    let [lower, higher] = bars[..] else { panic!("{bars:?}") };
    // From −5 to 5 over 250 points; half a unit of density is the most, with a twentieth of room.
    let left = 100.0 + 12.0 + 10.0;
    near(lower.center().x, left + 25.0 * (-2.9 + 5.0));
    near(higher.center().x, left + 25.0 * (1.1 + 5.0));
    near(lower.width(), 5.0);
    near(higher.height(), 96.0 / 1.05);
    near(lower.height(), 48.0 / 1.05);
    assert_eq!(lower.bottom(), higher.bottom());
    let curve =
        shapes.iter().find_map(|shape| if let Shape::Path(path) = shape { Some(&path.points) } else { None }).expect("a curve");
    let top = curve.iter().min_by(|a, b| a.y.total_cmp(&b.y)).expect("points");
    near(top.x, left + 125.0);
    near(higher.bottom() - top.y, 96.0 * 0.398_942 / 0.525);
    near(curve[0].x, left);
    for (z, said) in [(-4.0, "-4"), (0.0, "0"), (2.0, "2")] {
        near(text(&shapes, said).center().x, left + 25.0 * (z + 5.0));
    }
    text(&shapes, "mean +0.10 (0), deviation 1.20 (1 or less); 5.0 % beyond");
}

#[test]
fn a_region_is_framed_with_the_tiles_that_it_takes() {
    let mut app = app();
    app.budget_mut().region = Some(Region { from: [10, 40], to: [20, 50] });
    let frames = |app: &mut App| {
        let shapes = painted(|ui| app.overlays(ui, &AREA, None));
        let frame = |shape: &Shape| match shape {
            Shape::Rect(rect) if rect.stroke.width > 0.0 => Some((rect.stroke.width, rect.rect)),
            _ => None,
        };
        shapes.iter().filter_map(frame).collect::<Vec<_>>()
    };
    let rect = |from: [f32; 2], to: [f32; 2]| Rect::from_min_max(from.into(), to.into());
    let region = rect([150.0, 300.0], [200.0, 350.0]);
    assert_eq!(frames(&mut app), [(1.0, rect([100.0, 260.0], [260.0, 420.0])), (2.5, region), (1.5, region)]);
    // A region that is being drawn replaces the earlier one.
    app.window.marking = Some(Region { from: [0, 0], to: [2, 2] });
    assert_eq!(frames(&mut app)[2], (1.5, rect([100.0, 100.0], [110.0, 110.0])));
}

#[test]
fn bars_of_bounces_are_as_high_as_their_shares() {
    let mut app = app();
    let shares = [0.5, 0.25].into_iter().chain([0.01; 14]).chain([0.02; 5]).collect();
    let series = Some(Series { terms: Vec::new(), shares });
    app.results.second_frame = Some(Arc::new(Frame { spp: 7, series, ..Frame::default() }));
    for (up_to, chosen) in [(false, vec![1]), (true, vec![0, 1])] {
        (app.session.bounces.k, app.session.bounces.up_to) = (1, up_to);
        let shapes = painted(|ui| app.instrument(ui, InstrumentTab::Bounces));
        // Of what is as wide, numbers in fields stand elsewhere.
        let mut bars: Vec<_> = fills(&shapes).into_iter().filter(|(rect, _)| (rect.width() - 40.0).abs() < 0.1).collect();
        let base = bars.iter().find(|(rect, _)| rect.height() > 60.0).expect("the highest bar").0.bottom();
        bars.retain(|(rect, _)| (rect.bottom() - base).abs() < 0.01);
        assert_eq!(bars.len(), 17, "{bars:?}");
        for (k, height) in [(0, 64.0), (1, 32.0), (2, 1.28), (15, 1.28), (16, 12.8)] {
            assert!((bars[k].0.height() - height).abs() < 0.1, "{k}: {:?}", bars[k]);
        }
        assert!(bars.windows(2).all(|pair| pair[0].0.right() < pair[1].0.left()));
        let accented = (0..17).filter(|k| bars[*k].1 != Color32::GRAY).collect::<Vec<_>>();
        assert_eq!(accented, chosen);
        near(text(&shapes, "10 %").center().x, bars[16].0.center().x);
    }
}
