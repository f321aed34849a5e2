//! The meaning of the properties of a vertex.
use std::sync::LazyLock;

use super::header::{Element, Kind, Layout};
use noisefall_base::{
    math::colour::linear_from_srgb,
    memory::{Reservation, TooMuch},
};

/// Numbers of a vertex: position, normal, texture coordinates, colour and opacity, tangent and its handedness.
pub const NUMBERS: usize = 16;
pub const FIRST_COLOUR: usize = 8;
pub const OPACITY: usize = 11;
pub const FIRST_TANGENT: usize = 12;
/// Layouts of the properties of a vertex, and the number that each is.
pub type Slots = Vec<(Layout, Option<usize>)>;

/// The index of a property among the numbers of a vertex.
fn slot(name: &str) -> Option<usize> {
    let name = name.to_ascii_lowercase();
    let names: [&[&str]; NUMBERS] = [
        &["x"],
        &["y"],
        &["z"],
        &["nx"],
        &["ny"],
        &["nz"],
        &["s", "u", "texture_u", "texture_s", "tu"],
        &["t", "v", "texture_v", "texture_t", "tv"],
        &["red", "r", "diffuse_red"],
        &["green", "g", "diffuse_green"],
        &["blue", "b", "diffuse_blue"],
        &["alpha", "a", "diffuse_alpha"],
        &["tx"],
        &["ty"],
        &["tz"],
        &["tw"],
    ];
    names.iter().position(|names| names.contains(&name.as_str()))
}

/// The meaning of each property of an element.
pub fn slots(element: &Element) -> Slots {
    let mut is_there = [false; NUMBERS];
    // Of properties that mean the same the first counts.
    let mut wanted = |name: &str| slot(name).filter(|slot| !std::mem::replace(&mut is_there[*slot], true));
    element.properties.iter().map(|p| (p.layout, wanted(&p.name))).collect()
}

/// Reserves memory for vertices that are read in bulk.
pub fn reserve_vertices(element: &Element, slots: &Slots, room: &mut Reservation) -> Result<(), TooMuch> {
    let numbers = slots.iter().filter(|(_, slot)| slot.is_some()).count() as u64 + 1;
    room.grow(format_args!("{} vertices", element.count), numbers.saturating_mul(4 * element.count))
}

/// Linear values of sRGB bytes.
static LINEAR: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| linear_from_srgb(byte as f64 / f64::from(u8::MAX)) as f32));

/// A channel of a colour in linear light, or opacity.
pub fn linear(number: f32, kind: Kind, slot: usize) -> f32 {
    match kind.full() {
        None => number,
        Some(full) if slot == OPACITY => number / full,
        Some(_) if kind == Kind::U8 => LINEAR[usize::from(number as u8)],
        Some(full) => linear_from_srgb(f64::from(number / full)) as f32,
    }
}
