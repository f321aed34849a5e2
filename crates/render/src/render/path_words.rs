//! Numbers in the text of a path.

/// A colour.
pub fn three(values: [f32; 3]) -> String {
    values.map(number).join(" ")
}

/// A point or a direction.
pub fn place([x, y, z]: [f32; 3]) -> String {
    format!("{x:.5} {y:.5} {z:.5}")
}

/// Five decimals, or five significant digits if the number is very small or large.
pub fn number(x: f32) -> String {
    if x == 0.0 || (1e-3..1e4).contains(&x.abs()) { format!("{x:.5}") } else { format!("{x:.4e}") }
}
