//! Metadata of images by this program: their scene and settings.
use std::{
    fs::File,
    io::{BufRead, BufReader},
};

use ::exr::{
    meta::{MetaData, attribute::AttributeValue},
    prelude::Text,
};
use ::png::Decoder;

use super::{PNG, Source, looks_like};

/// Key of the text chunk or attribute.
pub const SETTINGS_KEY: &str = "noisefall";

/// The text of a PNG or EXR file, if it has one. Reads only headers.
pub fn embedded_text(file: File) -> Option<String> {
    let mut file = BufReader::new(file);
    let is_png = looks_like(file.fill_buf().ok()?) == Some(PNG);
    if is_png { of_png(&mut file) } else { of_exr(&mut file) }
}

fn of_png(file: &mut dyn Source) -> Option<String> {
    let reader = Decoder::new(file).read_info().ok()?;
    // We write it as it is. What is compressed may be of any length.
    let text = reader.info().utf8_text.iter().find(|text| text.keyword == SETTINGS_KEY && !text.compressed)?;
    text.get_text().ok()
}

fn of_exr(file: &mut dyn Source) -> Option<String> {
    let header = MetaData::read_from_buffered(file, false).ok()?.headers.into_iter().next()?;
    match header.own_attributes.other.get(&Text::from(SETTINGS_KEY))? {
        AttributeValue::Text(text) => Some(text.to_string()),
        _ => None,
    }
}
