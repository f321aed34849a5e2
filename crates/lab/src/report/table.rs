//! Tables of reports, as HTML, CSV and LaTeX.
use maud::{Markup, html};

/// A table. Cells are displayed text; columns of numbers are right-aligned.
pub struct Table {
    /// Base name of its files.
    pub name: String,
    /// The caption.
    pub caption: String,
    /// The columns.
    pub columns: Vec<Column>,
    /// The cells, row by row.
    pub rows: Vec<Vec<String>>,
}

/// A column of a table.
pub struct Column {
    /// Its heading.
    pub name: String,
    /// Whether its cells are aligned as numbers.
    pub is_number: bool,
}

impl Column {
    /// A column of texts.
    pub fn text(name: &str) -> Column {
        Column { name: name.to_owned(), is_number: false }
    }

    /// A column of numbers.
    pub fn number(name: &str) -> Column {
        Column { name: name.to_owned(), is_number: true }
    }
}

impl Table {
    /// The table as HTML.
    pub fn markup(&self) -> Markup {
        let class = |column: usize| if self.columns[column].is_number { "n" } else { "" };
        html! {
            figure {
                table {
                    thead { tr { @for (i, column) in self.columns.iter().enumerate() { th class=(class(i)) { (column.name) } } } }
                    tbody { @for row in &self.rows { tr { @for (i, cell) in row.iter().enumerate() { td class=(class(i)) { (cell) } } } } }
                }
                figcaption { (self.caption) }
            }
        }
    }

    /// The table as CSV for programs: numbers have a hyphen as minus sign, and cells with a dash, for unknown values, are empty.
    pub fn csv(&self) -> Result<Vec<u8>, String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(self.columns.iter().map(|column| &column.name)).map_err(|error| error.to_string())?;
        for row in &self.rows {
            let cells = row.iter().map(|cell| if cell == "–" { String::new() } else { cell.replace('−', "-") });
            writer.write_record(cells).map_err(|error| error.to_string())?;
        }
        writer.into_inner().map_err(|error| error.to_string())
    }

    /// A LaTeX `tabular`, for `\input` in a document.
    pub fn latex(&self) -> String {
        let columns: String = self.columns.iter().map(|column| if column.is_number { 'r' } else { 'l' }).collect();
        let line = |cells: Vec<String>| format!("  {} \\\\\n", cells.join(" & "));
        let head = line(self.columns.iter().map(|column| escaped(&column.name)).collect());
        let rows: String = self.rows.iter().map(|row| line(row.iter().map(|cell| escaped(cell)).collect())).collect();
        format!(
            "% {}\n\\begin{{tabular}}{{{columns}}}\n  \\hline\n{head}  \\hline\n{rows}  \\hline\n\\end{{tabular}}\n",
            self.caption
        )
    }
}

/// Escapes text for LaTeX.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '\\' => escaped.push_str("\\textbackslash{}"),
            '~' => escaped.push_str("\\textasciitilde{}"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => escaped.extend(['\\', c]),
            '−' => escaped.push_str("$-$"),
            '±' => escaped.push_str("$\\pm$"),
            '×' => escaped.push_str("$\\times$"),
            '≤' => escaped.push_str("$\\le$"),
            '–' => escaped.push_str("--"),
            _ => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_the_same_in_every_form() {
        let table = Table {
            name: "caps".to_owned(),
            caption: "Bias of caps".to_owned(),
            columns: vec![Column::text("cap & more"), Column::number("bias")],
            rows: vec![vec!["none, 50 %".to_owned(), "−0.5 ± 0.1".to_owned()], vec!["a_b".to_owned(), "–".to_owned()]],
        };
        let csv = String::from_utf8(table.csv().expect("CSV")).expect("text");
        assert_eq!(csv, "cap & more,bias\n\"none, 50 %\",-0.5 ± 0.1\na_b,\n");
        let latex = table.latex();
        assert!(latex.starts_with("% Bias of caps\n\\begin{tabular}{lr}\n"), "{latex}");
        assert!(
            latex.contains("cap \\& more & bias \\\\\n") && latex.contains("none, 50 \\% & $-$0.5 $\\pm$ 0.1 \\\\\n"),
            "{latex}"
        );
        assert!(latex.contains("  a\\_b & -- \\\\\n"), "{latex}");
        let html = table.markup().into_string();
        assert!(html.contains("<th class=\"n\">bias</th>") && html.contains("<td class=\"n\">−0.5 ± 0.1</td>"), "{html}");
    }
}
