//! Stacked bars as SVG.
use maud::html;

/// Colours that are distinct for colour-blind readers too (M. Okabe and K. Ito, "Color Universal Design", 2008).
const COLOURS: [&str; 7] = ["#56b4e9", "#0072b2", "#009e73", "#d55e00", "#cc79a7", "#3c3c3c", "#969696"];
const HEIGHT: f64 = 240.0;
const BAR: f64 = 34.0;
const LEFT: f64 = 52.0;
const TOP: f64 = 40.0;
const LEGEND: f64 = 120.0;

/// A bar of several parts, the first at the bottom.
pub struct Bar {
    /// The name below the bar.
    pub name: String,
    /// The heights of its parts, 0 or more.
    pub parts: Vec<f64>,
}

/// An SVG of bars side by side, with the names of their parts.
pub fn stacked(title: &str, names: &[&str], bars: &[Bar]) -> String {
    let highest = bars.iter().map(|bar| bar.parts.iter().sum::<f64>()).fold(1e-9, f64::max);
    let scale = HEIGHT / highest;
    let (width, foot) = (LEFT + BAR * bars.len() as f64 + LEGEND, TOP + HEIGHT);
    let colour = |part: usize| COLOURS[part % COLOURS.len()];
    let picture = html! {
        svg xmlns="http://www.w3.org/2000/svg" width=(width) height=(foot + 40.0) font-family="sans-serif" font-size="12" {
            rect width="100%" height="100%" fill="#fff" {}
            text x=(LEFT) y="22" font-size="14" { (title) }
            @for (x, bar) in bars.iter().enumerate().map(|(place, bar)| (LEFT + BAR * place as f64, bar)) {
                @for (part, [bottom, top]) in edges(bar).into_iter().enumerate().filter(|(_, [bottom, top])| top > bottom) {
                    rect x=(x + 3.0) y=(rounded(foot - top * scale)) width=(BAR - 6.0) height=(rounded((top - bottom) * scale))
                        fill=(colour(part)) {}
                }
                text x=(x + BAR / 2.0) y=(foot + 18.0) text-anchor="middle" { (bar.name) }
            }
            @for (value, y) in [0.0, highest / 2.0, highest].map(|value| (value, foot - value * scale)) {
                text x=(LEFT - 8.0) y=(rounded(y + 4.0)) text-anchor="end" { (format!("{value:.1}")) }
            }
            @for (part, name) in names.iter().enumerate() {
                rect x=(width - LEGEND + 12.0) y=(TOP + 20.0 * part as f64) width="12" height="12" fill=(colour(part)) {}
                text x=(width - LEGEND + 30.0) y=(TOP + 20.0 * part as f64 + 10.0) { (name) }
            }
        }
    };
    picture.into_string()
}

/// Bottom and top of the parts.
fn edges(bar: &Bar) -> Vec<[f64; 2]> {
    let mut below = 0.0;
    let edge = |part: &f64| {
        let bottom = below;
        below += part;
        [bottom, below]
    };
    bar.parts.iter().map(edge).collect()
}

/// A coordinate with two decimals.
fn rounded(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_stand_on_each_other_and_the_highest_bar_fills_the_height() {
        let bars =
            [Bar { name: "0".to_owned(), parts: vec![1.0, 0.0, 3.0] }, Bar { name: "1 & more".to_owned(), parts: vec![2.0] }];
        assert_eq!(edges(&bars[0]), [[0.0, 1.0], [1.0, 1.0], [1.0, 4.0]]);
        let svg = stacked("time", &["rays", "film", "shading"], &bars);
        // The environment, two parts of the first bar and one of the second, and three of the legend.
        assert_eq!(svg.matches("<rect").count(), 1 + 2 + 1 + 3);
        assert!(svg.contains("y=\"40\" width=\"28\" height=\"180\"") && svg.contains("1 &amp; more"), "{svg}");
    }
}
