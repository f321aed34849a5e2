//! Pages, formulas and plots.
use super::{Figure, formula, page, plot::*};

#[test]
fn a_letter_behind_an_underscore_is_an_index() {
    assert_eq!(formula("L_e + ρ L").into_string(), "L<sub>e</sub> + ρ L");
    assert_eq!(formula("x_Mx_ω y").into_string(), "x<sub>M</sub>x<sub>ω</sub> y");
    assert_eq!(formula("∫ f dω_i").into_string(), "∫ f dω<sub>i</sub>");
    assert_eq!(formula("F_avg² E_avg/(1 − E_avg)").into_string(), "F<sub>avg</sub>² E<sub>avg</sub>/(1 − E<sub>avg</sub>)");
    assert_eq!(formula("against cornell_box.exr and max_bounces").into_string(), "against cornell_box.exr and max_bounces");
    assert_eq!(formula("a_").into_string(), "a_");
    assert_eq!(formula("a < b").into_string(), "a &lt; b");
    assert_eq!(formula("").into_string(), "");
}

#[test]
fn a_page_has_its_title_style_and_body() {
    let body = Figure { caption: "what L_o is".to_owned(), element: "<svg/>".to_owned() }.markup();
    let page = page("A & B", ":root { --width: 9rem; }", &body);
    assert!(page.starts_with("<!DOCTYPE html>") && page.contains("<title>A &amp; B</title>") && page.contains("--width: 9rem"));
    assert!(page.contains("<figure><svg/><figcaption>what L<sub>o</sub> is</figcaption></figure>"), "{page}");
}

#[test]
fn figures_are_files_of_their_own_but_tables_are_not() {
    let svg = |element: &str| Figure { caption: String::new(), element: element.to_owned() }.svg();
    let drawn = plot("", Axis::linear("x"), Axis::linear("y"), &[curve("c", Style::Line, vec![(0.0, 1.0), (1.0, 2.0)])]);
    let file = drawn.svg().expect("a plot");
    assert!(file.starts_with("<svg") && file.contains("xmlns=\"http://www.w3.org/2000/svg\"") && file.contains("polyline"));
    let picture = svg("<img width='172' height='9' alt='a' src='data:image/png;base64,AA=='>").expect("an image");
    assert!(picture.starts_with("<svg xmlns=") && picture.contains("<image width=\"172\" height=\"9\""), "{picture}");
    assert!(picture.contains("href=\"data:image/png;base64,AA==\""), "{picture}");
    assert_eq!(svg("<table></table>"), None);
}

#[test]
fn a_png_is_an_svg_of_its_size() {
    let png = super::picture::rgb_png([3, 2], &[7; 18]).expect("a PNG");
    let svg = String::from_utf8(super::picture::svg(&png).expect("an SVG")).expect("text");
    assert!(
        svg.starts_with("<svg xmlns=") && svg.contains("<image width=\"3\" height=\"2\" href=\"data:image/png;base64,"),
        "{svg}"
    );
    assert!(super::picture::svg(b"no PNG").is_err());
}

/// The texts of a drawing.
fn texts(svg: &str) -> Vec<String> {
    let parts = svg.split("<text").skip(1).filter_map(|part| part.split_once('>')?.1.split_once("</text>"));
    parts.map(|(text, _)| text.trim().to_owned()).collect()
}

fn numbers(element: &str, attribute: &str) -> Vec<f64> {
    let start = format!(" {attribute}=\"");
    let parts = element.split(&start).skip(1);
    parts.filter_map(|part| part.split_once('"')?.0.parse().ok()).collect()
}

/// The centres of the dots.
fn dots(svg: &str) -> Vec<[f64; 2]> {
    let circles = svg.split("<circle").skip(1).filter_map(|part| part.split_once("/>").map(|(circle, _)| circle.to_owned()));
    circles.map(|circle| [numbers(&circle, "cx")[0], numbers(&circle, "cy")[0]]).collect()
}

#[test]
fn points_lie_at_their_logarithms_and_upwards() {
    let points = vec![(1.0, 0.01), (10.0, 0.1), (1000.0, 10.0)];
    let svg = svg(BESIDE, Axis::log("samples"), Axis::log("error"), &[curve("a curve", Style::Points, points)]);
    let dots = dots(&svg);
    assert_eq!(dots.len(), 3, "{svg}");
    // A decade, then two, in both directions; SVG counts downwards.
    for (axis, sign) in [(0, 1.0), (1, -1.0)] {
        let [first, second] = [dots[1][axis] - dots[0][axis], dots[2][axis] - dots[1][axis]];
        assert!(sign * first > 20.0 && (second / first - 2.0).abs() < 0.05, "{dots:?}");
    }
    let texts = texts(&svg);
    for label in ["samples", "error", "1", "10", "100", "1000", "0.01", "0.1", "a curve"] {
        assert!(texts.iter().any(|text| text == label), "{label}: {texts:?}");
    }
    assert!(svg.contains("560") && svg.contains("380"));
}

#[test]
fn points_of_a_linear_axis_lie_at_their_values() {
    let points = vec![(0.0, 1.0), (1.0, 2.0), (3.0, 5.0)];
    let figure = plot("L_o", Axis::linear("x"), Axis::linear("y"), &[curve("c", Style::Points, points)]);
    let dots = dots(&figure.element);
    assert!(((dots[2][0] - dots[1][0]) / (dots[1][0] - dots[0][0]) - 2.0).abs() < 0.05, "{dots:?}");
    assert!(((dots[2][1] - dots[1][1]) / (dots[1][1] - dots[0][1]) - 3.0).abs() < 0.05, "{dots:?}");
    assert!(figure.caption == "L_o" && figure.element.contains("660"));
}

#[test]
fn lines_and_points_of_a_name_share_a_colour_and_guides_are_grey() {
    let points = || vec![(1.0, 1.0), (2.0, 3.0), (4.0, 9.0)];
    let of = |name: &str, style| curve(name, style, points());
    let curves =
        [of("a", Style::Line), of("a", Style::Points), of("b", Style::Dashed), of("b", Style::Points), of("guide", Style::Guide)];
    let svg = svg(BESIDE, Axis::log("x"), Axis::log("y"), &curves);
    let count = |colour: &str| svg.matches(colour).count();
    // Blue, orange red, and no third colour of curves.
    assert!(count("#0072B2") > 3 && count("#D55E00") > 3 && count("#009E73") == 0 && count("#969696") > 0, "{svg}");
    let named = |name: &str| texts(&svg).iter().filter(|text| *text == name).count();
    assert_eq!([named("a"), named("b"), named("guide")], [1, 1, 1], "each name stands once in the legend");
}

#[test]
fn a_single_point_and_none_are_drawn_too() {
    for points in [vec![(2.0, 2.0)], Vec::new()] {
        for axis in [Axis::log, Axis::linear] {
            let count = points.len();
            let svg = svg(BESIDE, axis("x"), axis("y"), &[curve("c", Style::Points, points.clone())]);
            assert!(svg.starts_with("<svg") && dots(&svg).len() == count, "{svg}");
        }
    }
}

/// The legend goes where no points are.
#[test]
fn the_legend_lies_in_the_emptiest_corner() {
    let cluster = |x: f64, y: f64| (0..30).map(move |i| (x + f64::from(i % 6) * 0.02, y + f64::from(i / 6) * 0.02));
    let corners = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)];
    for empty in 0..4 {
        let mut points: Vec<(f64, f64)> = Vec::new();
        corners.iter().enumerate().filter(|(corner, _)| *corner != empty).for_each(|(_, (x, y))| points.extend(cluster(*x, *y)));
        // The range reaches into the empty corner.
        points.extend([(0.55, 0.55), (1.1, 0.5), (0.5, 1.1)]);
        let svg = svg(BESIDE, Axis::linear("x"), Axis::linear("y"), &[curve("the only curve", Style::Points, points)]);
        let (x, y) = legend_place(&svg);
        let (right, top) = (x > 280.0, y < 190.0);
        assert_eq!((right, top), (corners[empty].0 > 0.5, corners[empty].1 > 0.5), "corner {empty}: {x} {y}");
    }
}

/// Its width is a part of the plot's: a quarter for these letters, where a point lies a third away from the right.
#[test]
fn the_legend_lies_beside_points_that_it_does_not_reach() {
    let points = vec![(0.0, 0.5), (1.0, 0.5), (0.7, 1.0), (0.5, 0.0)];
    let svg = svg(BESIDE, Axis::linear("x"), Axis::linear("y"), &[curve("the only curve", Style::Points, points)]);
    let (x, y) = legend_place(&svg);
    assert!(x > 280.0 && y < 190.0, "{x} {y}");
}

fn legend_place(svg: &str) -> (f64, f64) {
    let at = svg.find("the only curve").expect("a legend");
    let element = &svg[svg[..at].rfind("<text").expect("a text")..at];
    (numbers(element, "x")[0], numbers(element, "y")[0])
}

#[test]
fn labels_are_short_however_large_or_small_the_values_are() {
    let labels = |values: [f64; 2]| {
        let points = values.map(|y| (1.0, y)).to_vec();
        texts(&svg(BESIDE, Axis::linear("x"), Axis::linear("y"), &[curve("c", Style::Points, points)]))
    };
    assert!(labels([0.0, 40_000.0]).iter().any(|label| label == "4e4"));
    assert!(labels([0.0, 0.0004]).iter().any(|label| label == "4e-4"));
    assert!(labels([-9_000.0, 9_000.0]).iter().any(|label| label == "5000"));
}

/// Around a value that stands alone the axis goes a tenth of it to both sides, or a tenth of 1 where it is smaller.
#[test]
fn an_axis_of_one_value_has_room_around_it() {
    for (value, least, most) in [(0.0, -0.1, 0.1), (50.0, 45.0, 55.0), (-0.01, -0.11, 0.09)] {
        let range = Axis::linear("y").range([value].into_iter());
        assert!((range.start - least).abs() < 1e-9 && (range.end - most).abs() < 1e-9, "{value}: {range:?}");
    }
}

#[test]
fn curves_of_one_name_take_one_line_of_the_legend() {
    let curves = |names: &[&str]| -> Vec<Curve> { names.iter().map(|name| curve(*name, Style::Line, Vec::new())).collect() };
    let height = |names: &[&str]| legend_size(&curves(names), BESIDE).1;
    assert_eq!(height(&["a", "a", "b"]), height(&["a", "b"]));
    assert!(height(&["a", "b"]) > height(&["a"]));
}

#[test]
fn axes_have_their_own_titles_and_scales() {
    let points = vec![(1.0, 1.0), (10.0, 2.0), (100.0, 4.0)];
    let figure = plot("", Axis::log("along the bottom"), Axis::linear("up the side"), &[curve("c", Style::Points, points)]);
    let is_turned = |label: &str| {
        let at = figure.element.find(label).expect("a title");
        figure.element[figure.element[..at].rfind("<text").expect("a text")..at].contains("rotate")
    };
    assert!(!is_turned("along the bottom") && is_turned("up the side"));
    let dots = dots(&figure.element);
    let ratio = |axis: usize| (dots[2][axis] - dots[1][axis]) / (dots[1][axis] - dots[0][axis]);
    assert!((ratio(0) - 1.0).abs() < 0.05 && (ratio(1) - 2.0).abs() < 0.05, "{dots:?}");
}

/// Even two of them: places at even distances of the logarithm would be odd numbers.
#[test]
fn labels_of_a_logarithmic_axis_are_round_numbers() {
    let points = vec![(4.5, 4.5), (11.0, 11.0)];
    let svg = svg(BESIDE, Axis::log("x"), Axis::log("y"), &[curve("c", Style::Points, points)]);
    let labels: Vec<String> = texts(&svg).into_iter().filter(|text| text.parse::<f64>().is_ok()).collect();
    assert!(labels.len() == 4 && labels.iter().all(|label| label == "5" || label == "10"), "{labels:?}");
}
