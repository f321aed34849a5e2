//! A report of the reader of scene files, laid out for the width of a window.

/// The characters between the number of a line and its text.
const RULES: [char; 5] = ['│', '·', '╭', '╰', '├'];
/// Stands for what is cut off.
const CUT: char = '…';

/// The report in lines of at most `columns` characters. Sentences are wrapped. Lines of the file are cut to what is around the marked
/// place, so that the marks stay below it.
pub fn fitted(report: &str, columns: usize) -> String {
    let mut lines = Vec::new();
    let all: Vec<&str> = report.lines().collect();
    for run in all.chunk_by(|a, b| gutter(a).is_some() == gutter(b).is_some()) {
        if gutter(run[0]).is_some() {
            lines.extend(excerpt(run, columns));
        } else {
            run.iter().for_each(|line| wrap(line, columns, &mut lines));
        }
    }
    lines.join("\n")
}

/// The characters before the text of a line of the file, if the line is one or belongs to one.
fn gutter(line: &str) -> Option<usize> {
    let rule = line.chars().position(|c| RULES.contains(&c))?;
    let is_margin = line.chars().take(rule).all(|c| c == ' ' || c.is_ascii_digit());
    is_margin.then_some(rule + 1)
}

/// Lines of a file with marks below them, cut to the same columns.
fn excerpt(lines: &[&str], columns: usize) -> Vec<String> {
    let width = gutter(lines[0]).unwrap_or(0);
    let room = columns.saturating_sub(width).max(1);
    let texts: Vec<Vec<char>> = lines.iter().map(|line| line.chars().skip(width).collect()).collect();
    let is_mark = |line: &str| line.chars().nth(width - 1) == Some('·');
    let marks = texts.iter().zip(lines).filter(|(_, line)| is_mark(line)).map(|(text, _)| text);
    let begin = marks.clone().filter_map(|text| text.iter().position(|c| *c != ' ')).min().unwrap_or(0);
    let end = marks.map(Vec::len).max().unwrap_or(0);
    // Some of what is before the mark is shown too.
    let start = if end <= room { 0 } else { (end - room).max(begin.saturating_sub(room / 3)).min(begin) };
    let cut = |(line, text): (&&str, &Vec<char>)| {
        let head: String = line.chars().take(width).collect();
        // The place of the file ends in its line and column.
        let start = if head.ends_with('╭') { text.len().saturating_sub(room) } else { start };
        let mut shown: Vec<char> = text.iter().skip(start).take(room).copied().collect();
        if start > 0 && shown.first().is_some_and(|first| *first != ' ') {
            shown[0] = CUT;
        }
        if text.len() > start + room {
            shown.pop();
            shown.push(CUT);
        }
        head + &shown.into_iter().collect::<String>()
    };
    lines.iter().zip(&texts).map(cut).collect()
}

/// Breaks a line between words, and a word that is longer than a line anywhere. What follows is indented as the text is.
fn wrap(line: &str, columns: usize, lines: &mut Vec<String>) {
    let count = |text: &str| text.chars().count();
    let indent = " ".repeat((line.len() - line.trim_start().len()).min(columns / 2));
    let mut current = indent.clone();
    for word in line.split_whitespace() {
        let is_first = current.trim().is_empty();
        if !is_first && count(&current) + 1 + count(word) > columns {
            lines.push(std::mem::replace(&mut current, indent.clone()));
        } else if !is_first {
            current.push(' ');
        }
        for letter in word.chars() {
            if count(&current) == columns {
                lines.push(std::mem::replace(&mut current, indent.clone()));
            }
            current.push(letter);
        }
    }
    lines.push(if current.trim().is_empty() { String::new() } else { current });
}

#[cfg(test)]
mod tests {
    use super::*;

    const REPORT: &str = "  × unknown key `filterx`
   ╭─[/home/someone/scenes/room.toml:3:61]
 2 │ title = \"a title\"
 3 │ camera = { eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, filterx = \"box\", shutter = [0, 1] }
   ·                                                            ───┬───
   ·                                                               ╰── did you mean `filter`?
   ╰────
  help: expected one of `eye`, `look_at`, `up`, `fov`, `resolution`, `projection`";

    #[test]
    fn a_report_that_fits_is_left_as_it_is() {
        assert_eq!(fitted(REPORT, 120), REPORT);
    }

    #[test]
    fn a_long_line_is_cut_around_its_mark_and_sentences_are_wrapped() {
        let fitted = fitted(REPORT, 50);
        let lines: Vec<&str> = fitted.lines().collect();
        assert!(lines.iter().all(|line| line.chars().count() <= 50), "{fitted}");
        assert_eq!(lines[1], "   ╭─[/home/someone/scenes/room.toml:3:61]");
        let place = |line: &str, what: &str| line.find(what).map(|byte| line[..byte].chars().count());
        assert!(lines[3].contains('…') && place(lines[3], "filterx").is_some(), "{fitted}");
        assert_eq!(place(lines[3], "filterx"), place(lines[4], "───┬───"), "{fitted}");
        assert!(lines[5].ends_with("did you mean `filter`?"), "{fitted}");
        assert_eq!(lines[7..], ["  help: expected one of `eye`, `look_at`, `up`,", "  `fov`, `resolution`, `projection`"]);
    }

    #[test]
    fn the_end_of_a_long_place_and_every_letter_of_a_long_word_are_kept() {
        let fitted_place = fitted("   ╭─[/a/very/long/folder/of/a/scene/room.toml:3:61]\n 3 │ x\n   ╰────", 30);
        assert!(fitted_place.starts_with("   ╭…") && fitted_place.contains("room.toml:3:61]\n"), "{fitted_place}");
        let word = "x".repeat(70);
        let lines = fitted(&format!("  {word} end"), 30);
        assert!(lines.lines().all(|line| line.chars().count() <= 30) && lines.matches('x').count() == 70, "{lines}");
    }
}
