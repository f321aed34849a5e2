//! Building blocks of reports. Each report is one self-contained HTML file that prints well, with plots as SVG.
mod axis;
mod font;
pub mod picture;
pub mod plot;
pub mod sheet;
pub mod stack;
pub mod table;
#[cfg(test)]
mod tests;

use maud::{DOCTYPE, Markup, PreEscaped, html};

/// The style of all reports.
const STYLE: &str = "
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, sans-serif; color: #1b1b1b; background: #fff; max-width: var(--width); margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; margin-bottom: .2rem; } h2 { font-size: 1.25rem; margin-top: 2.6rem; }
table { border-collapse: collapse; width: 100%; font-size: .86rem; font-variant-numeric: tabular-nums; margin: 1rem 0; }
th, td { text-align: left; padding: .25rem .5rem; border-bottom: 1px solid #ddd; vertical-align: top; }
thead th { border-bottom: 2px solid #888; } td.n, th.n { text-align: right; white-space: nowrap; }
.holds { color: #00654a; font-weight: 600; white-space: nowrap; } .fails { color: #b00020; font-weight: 700; white-space: nowrap; }
.source { color: #555; font-size: .86rem; }
figure { margin: 1.2rem 0; } figure svg, figure img { max-width: 100%; height: auto; }
figcaption { font-size: .86rem; color: #444; }
@media print { body { font-size: 11pt; margin: 0; --width: none; } section { break-inside: auto; } figure, tr { break-inside: avoid; } }
";

/// An image or a plot with its caption.
pub struct Figure {
    /// The caption, whose indices follow underscores.
    pub caption: String,
    /// An `svg` or `img` element.
    pub element: String,
}

impl Figure {
    /// The figure as HTML.
    pub fn markup(&self) -> Markup {
        html! { figure { (PreEscaped(&self.element)) figcaption { (formula(&self.caption)) } } }
    }

    /// The figure as a separate file: plots as they are, images inside an SVG of their size; `None` for tables.
    pub fn svg(&self) -> Option<String> {
        if self.element.starts_with("<svg") {
            return Some(self.element.clone());
        }
        let after = |key: &str| self.element.split_once(key)?.1.split_once('\'').map(|(value, _)| value);
        let (width, height, source) = (after("width='")?, after("height='")?, after("src='")?);
        Some(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\"><image width=\"{width}\" \
             height=\"{height}\" style=\"image-rendering: pixelated\" href=\"{source}\"/></svg>"
        ))
    }
}

/// A whole page; `style` is specific to this report, and must set at least `--width` of `:root`.
pub fn page(title: &str, style: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) (PreEscaped(style)) }
            }
            body { (body) }
        }
    };
    page.into_string()
}

/// Text with indices: what follows an underscore behind a single letter, which is a letter, or a word in lower case as in `E_avg`.
/// Other underscores, as in names of files, stay.
pub fn formula(text: &str) -> Markup {
    let mut parts = text.split('_');
    let first = parts.next().unwrap_or_default();
    let pieces = parts.scan(first, |before, part| {
        let piece = part.split_at(if ends_in_a_symbol(before) { index_length(part) } else { 0 });
        *before = piece.1;
        Some(piece)
    });
    html! {
        (first)
        @for (index, rest) in pieces {
            @if index.is_empty() { "_" } @else { sub { (index) } }
            (rest)
        }
    }
}

/// Whether the last letter is that of a quantity and not of a word: Greek, or alone.
fn ends_in_a_symbol(text: &str) -> bool {
    let mut letters = text.chars().rev();
    let last = letters.next().filter(|letter| letter.is_alphabetic());
    last.is_some_and(|letter| !letter.is_ascii() || !letters.next().is_some_and(|before| before.is_ascii_alphabetic()))
}

/// Bytes of the index that a text begins with.
fn index_length(text: &str) -> usize {
    let word = text.len() - text.trim_start_matches(|letter: char| letter.is_ascii_lowercase()).len();
    if word > 0 { word } else { text.chars().next().map_or(0, char::len_utf8) }
}
