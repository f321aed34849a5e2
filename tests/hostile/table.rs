//! Mutations of tables that keep most of their lines and cells.
use rand::{Rng, rngs::SmallRng};

use super::mutation::{NUMBERS, pick, text};

/// Changes a cell or a line, or the text.
pub fn mutate(bytes: &mut Vec<u8>, random: &mut SmallRng) -> bool {
    let Some(mut lines) = lines(bytes).filter(|lines| !lines.is_empty() && random.random_bool(0.7)) else {
        return text(bytes, random);
    };
    let [one, other] = [0; 2].map(|_| random.random_range(0..lines.len()));
    match random.random_range(0..5) {
        0 => drop(lines.remove(one)),
        1 => lines.swap(one, other),
        2 => {
            let copies = vec![lines[one].clone(); 1 << random.random_range(0..8)];
            drop(lines.splice(other..other, copies));
        }
        _ => {
            let column = random.random_range(0..lines[one].len());
            let of_other = lines[other].get(column).cloned().unwrap_or_default();
            lines[one][column] = if random.random_bool(0.5) { pick(&NUMBERS, random).to_owned() } else { of_other };
        }
    }
    *bytes = lines.iter().map(|cells| cells.join(",") + "\n").collect::<String>().into_bytes();
    false
}

/// The cells of a table. Quotes stay part of them, so a cell with a comma counts as several.
fn lines(bytes: &[u8]) -> Option<Vec<Vec<String>>> {
    let text = std::str::from_utf8(bytes).ok()?;
    Some(text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect())
}
