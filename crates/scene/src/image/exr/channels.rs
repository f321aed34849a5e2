//! The channels of an OpenEXR file that make the image.
//!
//! "Technical Introduction to OpenEXR", 2013, "Channel Names": names of channels in layers are `layer.R`. Of several sets the first of
//! these counts, and then one without layer, one in a layer that is named as the whole image, and one in any other layer.
//!
//! | channels | image |
//! |---|---|
//! | `R G B`, or `R G` | colour |
//! | `Y`, luminance | grey |
//! | `X Y Z`, such as those of normals | colour |
//! | a single one, and perhaps `A` | grey |
use ::exr::{
    math::Vec2,
    meta::{attribute::ChannelDescription, header::Header},
    prelude::Text,
};

use noisefall_base::quote;

/// Channels by their names in the file. Those that are missing have names that no channel has.
#[derive(Debug, PartialEq)]
pub enum Channels {
    Grey { value: Text, opacity: Text },
    Colour { red: Text, green: Text, blue: Text, opacity: Text },
}

/// Names of layers that hold the whole image, after the last point.
const WHOLE: [&str; 6] = ["combined", "beauty", "rgba", "rgb", "color", "colour"];

/// The channels of the image. An error is a sentence about the file that names its channels.
pub fn choose(headers: &[Header]) -> Result<Channels, String> {
    let is_whole = |channel: &ChannelDescription| channel.sampling == Vec2(1, 1);
    let readable = headers.iter().filter(|header| header.channels.list.iter().all(is_whole));
    let sets = readable.flat_map(layers).flat_map(|layer| layer.sets());
    if let Some((_, channels)) = sets.min_by_key(|(rank, _)| *rank) {
        return Ok(channels);
    }
    let all = || headers.iter().flat_map(|header| &header.channels.list);
    let list = |keep: &dyn Fn(&ChannelDescription) -> bool| {
        const MOST: usize = 16;
        let names = all().filter(|channel| keep(channel)).map(|channel| format!("`{}`", quote::piece(&channel.name.to_string())));
        names.take(MOST).collect::<Vec<_>>().join(", ")
    };
    Err(if all().all(is_whole) {
        format!("none of its channels {} is an image: expected R, G and B, or Y, or a single one", list(&|_| true))
    } else {
        let coarse = list(&|channel| !is_whole(channel));
        format!("its channels {coarse} have fewer samples than the image has pixels; save it as R, G and B")
    })
}

/// Channels whose names begin alike, up to the last point.
struct Layer<'a> {
    prefix: &'a str,
    /// The rest of each name.
    names: Vec<&'a str>,
}

fn layers(header: &Header) -> Vec<Layer<'_>> {
    let mut layers: Vec<Layer> = Vec::new();
    for channel in &header.channels.list {
        // Names that are not ASCII cannot be asked for.
        let Some(full) = str::from_utf8(channel.name.as_slice()).ok().filter(|name| name.is_ascii()) else { continue };
        let (prefix, name) = full.split_at(full.rfind('.').map_or(0, |point| point + 1));
        match layers.iter_mut().find(|layer| layer.prefix == prefix) {
            Some(layer) => layer.names.push(name),
            None => layers.push(Layer { prefix, names: vec![name] }),
        }
    }
    layers
}

impl Layer<'_> {
    /// The sets of channels that make an image, with their ranks; the least is the best.
    fn sets(&self) -> Vec<((u8, u8), Channels)> {
        let find = |short: &str| self.names.iter().find(|name| name.eq_ignore_ascii_case(short)).map(|name| self.full(name));
        let opacity = || find("A").unwrap_or_else(|| self.full("A"));
        let mut sets = Vec::new();
        for (rank, [red, green, blue]) in [(0, ["R", "G", "B"]), (2, ["X", "Y", "Z"])] {
            let (Some(red), Some(green), third) = (find(red), find(green), find(blue)) else { continue };
            // X and Y alone are no colour, but Y is a luminance.
            if third.is_some() || rank == 0 {
                let blue = third.unwrap_or_else(|| self.full(blue));
                sets.push((rank, Channels::Colour { red, green, blue, opacity: opacity() }));
            }
        }
        if let Some(value) = find("Y").filter(|_| find("X").is_none()) {
            sets.push((1, Channels::Grey { value, opacity: opacity() }));
        }
        let mut others = self.names.iter().filter(|name| !name.eq_ignore_ascii_case("A"));
        if let (Some(single), None) = (others.next(), others.next()) {
            sets.push((3, Channels::Grey { value: self.full(single), opacity: opacity() }));
        }
        let of_layer = self.rank();
        sets.into_iter().map(|(rank, channels)| ((rank, of_layer), channels)).collect()
    }

    fn full(&self, name: &str) -> Text {
        Text::from(format!("{}{name}", self.prefix).as_str())
    }

    fn rank(&self) -> u8 {
        let last = self.prefix.trim_end_matches('.').rsplit('.').next().unwrap_or_default();
        match last {
            "" => 0,
            last if WHOLE.iter().any(|whole| whole.eq_ignore_ascii_case(last)) => 1,
            _ => 2,
        }
    }
}
