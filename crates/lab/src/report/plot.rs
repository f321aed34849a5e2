//! Plots as SVG and PNG.
use std::ops::Range;

use plotters::{coord::Shift, prelude::*};

pub use super::axis::Axis;
use super::{Figure, axis::AxisScale, font, picture::rgb_png};

/// Colours that are distinct for colour-blind readers too (M. Okabe and K. Ito, "Color Universal Design", 2008).
const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(60, 60, 60),
];
const GREY: RGBColor = RGBColor(150, 150, 150);
/// Width and height of a single plot, in pixels.
const ALONE: (u32, u32) = (660, 340);
/// Width and height of each of two plots side by side, in pixels.
pub const BESIDE: (u32, u32) = (560, 380);

/// Style of a curve.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// A solid line.
    Line,
    /// A dashed line.
    Dashed,
    /// Points without a line.
    Points,
    /// A dashed line that is not a measurement: grey, and last in the order.
    Guide,
}

/// A curve of a plot.
pub struct Curve {
    /// Its name in the legend.
    pub name: String,
    /// How it is drawn.
    pub style: Style,
    /// Its points, x and y.
    pub points: Vec<(f64, f64)>,
    /// Its colour, red, green and blue, if that is not by the order.
    pub colour: Option<[u8; 3]>,
}

/// A curve of these points.
pub fn curve(name: impl Into<String>, style: Style, points: Vec<(f64, f64)>) -> Curve {
    Curve { name: name.into(), style, points, colour: None }
}

impl Curve {
    /// Gives the curve a colour, red, green and blue.
    pub fn coloured(self, colour: [u8; 3]) -> Curve {
        Curve { colour: Some(colour), ..self }
    }
}

/// A plot that can be written in several formats.
pub struct Plot {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The curves, the last one on top.
    pub curves: Vec<Curve>,
}

impl Plot {
    /// The plot as SVG.
    pub fn svg(&self) -> String {
        svg(self.size, self.x, self.y, &self.curves)
    }

    /// The plot as PNG, with twice as many pixels per side.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        png(self.size, self.x, self.y, &self.curves)
    }
}

/// [`svg`] in a figure.
pub fn plot(caption: impl Into<String>, x: Axis, y: Axis, curves: &[Curve]) -> Figure {
    Figure { caption: caption.into(), element: svg(ALONE, x, y, curves) }
}

/// Curves on common axes. Those without a colour are coloured by their order; points and lines with the same name share one.
pub fn svg(size: (u32, u32), x: Axis, y: Axis, curves: &[Curve]) -> String {
    let mut svg = String::new();
    let drawn = draw(&SVGBackend::with_string(&mut svg, size).into_drawing_area(), 1, x, y, curves);
    drawn.map_or_else(|error| format!("<p>this plot could not be drawn: {error}</p>"), |()| svg)
}

fn png(size: (u32, u32), x: Axis, y: Axis, curves: &[Curve]) -> Result<Vec<u8>, String> {
    const SCALE: u32 = 2;
    let size = (size.0 * SCALE, size.1 * SCALE);
    let mut pixels = vec![255; 3 * size.0 as usize * size.1 as usize];
    let drawn = draw(&BitMapBackend::with_buffer(&mut pixels, size).into_drawing_area(), SCALE, x, y, curves);
    drawn.map_err(|error| error.to_string())?;
    rgb_png([size.0, size.1], &pixels)
}

/// Draws the plot, with all lengths multiplied by `scale`.
fn draw<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    scale: u32,
    x: Axis,
    y: Axis,
    curves: &[Curve],
) -> Result<(), Box<dyn std::error::Error>>
where
    B::ErrorType: 'static,
{
    font::register();
    // Labels are black, wherever the file is shown.
    area.fill(&WHITE)?;
    let size = area.dim_in_pixel();
    let size = (size.0 / scale, size.1 / scale);
    let small = ("sans-serif", 13 * scale);
    let all = || curves.iter().flat_map(|curve| curve.points.iter().copied());
    let (xs, ys) = (x.range(all().map(|(a, _)| x.place(a))), y.range(all().map(|(_, b)| y.place(b))));
    let within = |(a, b): (f64, f64)| (part(&xs, x.place(a)), part(&ys, y.place(b)));
    let corner = emptiest_corner(curves.iter().flat_map(|curve| between(curve).map(within)), legend_size(curves, size));
    let (xs, ys) = (AxisScale::new(x, xs), AxisScale::new(y, ys));
    let labels = [xs.ticks.len(), ys.ticks.len()];
    let mut chart = ChartBuilder::on(area)
        .margin(8 * scale)
        .x_label_area_size(42 * scale)
        .y_label_area_size(64 * scale)
        .build_cartesian_2d(xs, ys)?;
    chart
        .configure_mesh()
        .x_desc(x.label)
        .y_desc(y.label)
        .x_labels(labels[0])
        .y_labels(labels[1])
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(225, 225, 225))
        .x_label_formatter(&|place| x.text(*place))
        .y_label_formatter(&|place| y.text(*place))
        .label_style(small)
        .axis_desc_style(("sans-serif", 14 * scale))
        .draw()?;
    let mut names: Vec<(&str, Option<[u8; 3]>)> = Vec::new();
    for curve in curves {
        let known = names.iter().position(|name| *name == (&curve.name, curve.colour));
        let number = known.unwrap_or(names.len());
        let colour = match (curve.style, curve.colour) {
            (Style::Guide, _) => GREY,
            (_, Some([red, green, blue])) => RGBColor(red, green, blue),
            _ => COLOURS[number % COLOURS.len()],
        };
        let places = curve.points.iter().map(|&(a, b)| (x.place(a), y.place(b)));
        let line = colour.stroke_width(2 * scale);
        let series = match curve.style {
            Style::Line => chart.draw_series(LineSeries::new(places, line))?,
            Style::Dashed | Style::Guide => chart.draw_series(DashedLineSeries::new(places, 5 * scale, 4 * scale, line))?,
            Style::Points => chart.draw_series(places.map(|place| Circle::new(place, 3 * scale, colour.filled())))?,
        };
        if known.is_none() {
            names.push((&curve.name, curve.colour));
            series.label(&curve.name).legend(move |(x, y)| PathElement::new([(x, y), (x + 16 * scale as i32, y)], line));
        }
    }
    chart
        .configure_series_labels()
        .background_style(WHITE.mix(0.85))
        .border_style(RGBColor(200, 200, 200))
        .label_font(small)
        .legend_area_size(30 * scale)
        .position(corner)
        .draw()?;
    area.present()?;
    Ok(())
}

/// Position in a range, from 0 to 1.
fn part(range: &Range<f64>, x: f64) -> f64 {
    (x - range.start) / (range.end - range.start)
}

/// The points of a curve, and points between them along its line.
fn between(curve: &Curve) -> impl Iterator<Item = (f64, f64)> {
    const STEPS: u32 = 8;
    let geometric = |a: f64, b: f64, t: f64| if a > 0.0 && b > 0.0 { a * (b / a).powf(t) } else { a + (b - a) * t };
    let lines = curve.points.windows(2).filter(|_| curve.style != Style::Points);
    let inner = lines.flat_map(move |ends| {
        let [(a, b), (c, d)] = [ends[0], ends[1]];
        (1..STEPS).map(move |step| f64::from(step) / f64::from(STEPS)).map(move |t| (geometric(a, c, t), geometric(b, d, t)))
    });
    curve.points.iter().copied().chain(inner)
}

/// Approximate width and height of the legend, relative to the plot.
pub(super) fn legend_size(curves: &[Curve], size: (u32, u32)) -> (f64, f64) {
    const LETTER: f64 = 7.0;
    const LINE: f64 = 18.0;
    let mut names: Vec<&str> = curves.iter().map(|curve| curve.name.as_str()).collect();
    names.dedup();
    let longest = names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    let (width, height) = (40.0 + LETTER * longest as f64, 16.0 + LINE * names.len() as f64);
    (width / f64::from(size.0), height / f64::from(size.1))
}

/// The corner in which a legend of this size hides the fewest points.
fn emptiest_corner(places: impl Iterator<Item = (f64, f64)>, (width, height): (f64, f64)) -> SeriesLabelPosition {
    const CORNERS: [(SeriesLabelPosition, f64, f64); 4] = [
        (SeriesLabelPosition::UpperRight, 1.0, 1.0),
        (SeriesLabelPosition::LowerRight, 1.0, 0.0),
        (SeriesLabelPosition::UpperLeft, 0.0, 1.0),
        (SeriesLabelPosition::LowerLeft, 0.0, 0.0),
    ];
    let places: Vec<_> = places.collect();
    let hidden = |&(_, x, y): &(SeriesLabelPosition, f64, f64)| {
        places.iter().filter(|(a, b)| (a - x).abs() < width && (b - y).abs() < height).count()
    };
    CORNERS.into_iter().min_by_key(hidden).map_or(SeriesLabelPosition::UpperRight, |(corner, ..)| corner)
}
