//! Metadata of images by this program: their scene and settings.
use std::{
    fs::File,
    io::{BufRead, BufReader, Seek},
};

use ::exr::{
    meta::{MetaData, attribute::AttributeValue},
    prelude::Text,
};
use ::png::Decoder;

use super::{PNG, looks_like};

/// Key of the text chunk or attribute.
pub const SETTINGS_KEY: &str = "noisefall";

/// The text of a PNG or EXR file, if it has one. Reads only headers.
pub fn carried_text(file: File) -> Option<String> {
    let mut file = BufReader::new(file);
    let is_png = looks_like(file.fill_buf().ok()?) == Some(PNG);
    if is_png { of_png(file) } else { of_exr(file) }
}

fn of_png(file: impl BufRead + Seek) -> Option<String> {
    let reader = Decoder::new(file).read_info().ok()?;
    // We write it as it is. What is compressed may be of any length.
    let text = reader.info().utf8_text.iter().find(|text| text.keyword == SETTINGS_KEY && !text.compressed)?;
    text.get_text().ok()
}

fn of_exr(mut file: impl BufRead + Seek) -> Option<String> {
    let header = MetaData::read_from_buffered(&mut file, false).ok()?.headers.into_iter().next()?;
    match header.own_attributes.other.get(&Text::from(SETTINGS_KEY))? {
        AttributeValue::Text(text) => Some(text.to_string()),
        _ => None,
    }
}
