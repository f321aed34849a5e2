//! Readers of the values of a PLY file, as text or binary.
use super::{
    super::{FilePosition, ModelFormatError, number},
    header::Kind,
};
use noisefall_base::quote;

pub trait Values {
    /// Minimum number of bytes per value.
    fn least_bytes(kind: Kind) -> usize;

    /// Position of the next value.
    fn place(&self) -> FilePosition;

    /// Bytes to the end of the file.
    fn left(&self) -> usize;

    /// A number, which may be infinite or NaN.
    fn number(&mut self, kind: Kind) -> Result<f32, ModelFormatError>;

    /// A whole number of an integer type.
    fn integer(&mut self, kind: Kind) -> Result<i64, ModelFormatError>;

    fn skip(&mut self, kind: Kind, count: u64) -> Result<(), ModelFormatError>;

    /// The bytes to the end of the file, if values are binary.
    fn bytes_left(&self) -> Option<&[u8]>;

    /// The number at the beginning of a block.
    fn number_at(block: &[u8], kind: Kind) -> f32;

    /// The whole number of an integer type at the beginning of a block.
    fn integer_at(block: &[u8], kind: Kind) -> i64;

    /// A number of four bytes.
    fn real(bytes: [u8; 4]) -> f32;

    /// A whole number of four bytes. Negative ones become those beyond 2³¹.
    fn whole(bytes: [u8; 4]) -> u32;
}

const ENDS: &str = "the file ends too early";

/// Words between white space.
pub struct Text<'a> {
    rest: &'a [u8],
    line: usize,
}

impl<'a> Text<'a> {
    pub fn new(bytes: &'a [u8], start: usize, lines: usize) -> Text<'a> {
        let mut text = Text { rest: &bytes[start..], line: lines + 1 };
        text.skip_space();
        text
    }

    fn skip_space(&mut self) {
        while let [byte, rest @ ..] = self.rest
            && byte.is_ascii_whitespace()
        {
            self.line += usize::from(*byte == b'\n');
            self.rest = rest;
        }
    }

    /// Converts the next word and advances.
    fn word<T>(&mut self, what: &str, convert: impl Fn(&str) -> Option<T>) -> Result<T, ModelFormatError> {
        let length = self.rest.iter().position(u8::is_ascii_whitespace).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(length);
        if word.is_empty() {
            return Err(self.place().broken(ENDS));
        }
        let value = str::from_utf8(word).ok().and_then(convert);
        let value = value.ok_or_else(|| self.place().broken(format!("{} is not {what}", quote::bytes(word))))?;
        self.rest = rest;
        self.skip_space();
        Ok(value)
    }
}

impl Values for Text<'_> {
    fn least_bytes(_: Kind) -> usize {
        // A digit and what separates it from the next.
        2
    }

    fn place(&self) -> FilePosition {
        FilePosition::Line(self.line)
    }

    fn left(&self) -> usize {
        self.rest.len()
    }

    fn number(&mut self, _: Kind) -> Result<f32, ModelFormatError> {
        self.word("a number", number::real)
    }

    fn integer(&mut self, _: Kind) -> Result<i64, ModelFormatError> {
        self.word("a whole number", number::whole)
    }

    fn skip(&mut self, _: Kind, count: u64) -> Result<(), ModelFormatError> {
        (0..count).try_for_each(|_| self.word("a value", |_| Some(())))
    }

    fn bytes_left(&self) -> Option<&[u8]> {
        None
    }

    fn number_at(_: &[u8], _: Kind) -> f32 {
        unreachable!("text has no blocks")
    }

    fn integer_at(_: &[u8], _: Kind) -> i64 {
        unreachable!("text has no blocks")
    }

    fn real(_: [u8; 4]) -> f32 {
        unreachable!("text has no blocks")
    }

    fn whole(_: [u8; 4]) -> u32 {
        unreachable!("text has no blocks")
    }
}

/// Contiguous binary values.
pub struct Binary<'a, const BIG_ENDIAN: bool> {
    rest: &'a [u8],
    length: usize,
}

impl<'a, const BIG_ENDIAN: bool> Binary<'a, BIG_ENDIAN> {
    pub fn new(bytes: &'a [u8], start: usize) -> Self {
        Binary { rest: &bytes[start..], length: bytes.len() }
    }

    /// The next bytes in little-endian order.
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], ModelFormatError> {
        let Some((bytes, rest)) = self.rest.split_first_chunk::<N>() else {
            return Err(FilePosition::Byte(self.length).broken(ENDS));
        };
        self.rest = rest;
        let mut bytes = *bytes;
        if BIG_ENDIAN {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl<const BIG_ENDIAN: bool> Values for Binary<'_, BIG_ENDIAN> {
    fn least_bytes(kind: Kind) -> usize {
        kind.size()
    }

    fn place(&self) -> FilePosition {
        FilePosition::Byte(self.length - self.rest.len())
    }

    fn left(&self) -> usize {
        self.rest.len()
    }

    fn number(&mut self, kind: Kind) -> Result<f32, ModelFormatError> {
        Ok(match kind {
            Kind::F32 => f32::from_le_bytes(self.bytes()?),
            Kind::F64 => f64::from_le_bytes(self.bytes()?) as f32,
            kind => self.integer(kind)? as f32,
        })
    }

    fn integer(&mut self, kind: Kind) -> Result<i64, ModelFormatError> {
        Ok(match kind {
            Kind::I8 => i8::from_le_bytes(self.bytes()?).into(),
            Kind::U8 => u8::from_le_bytes(self.bytes()?).into(),
            Kind::I16 => i16::from_le_bytes(self.bytes()?).into(),
            Kind::U16 => u16::from_le_bytes(self.bytes()?).into(),
            Kind::I32 => i32::from_le_bytes(self.bytes()?).into(),
            Kind::U32 => u32::from_le_bytes(self.bytes()?).into(),
            Kind::F32 | Kind::F64 => unreachable!("the header may give lengths and indices only whole types"),
        })
    }

    fn skip(&mut self, kind: Kind, count: u64) -> Result<(), ModelFormatError> {
        let rest = usize::try_from(count).ok().and_then(|count| self.rest.get(count.checked_mul(kind.size())?..));
        self.rest = rest.ok_or_else(|| FilePosition::Byte(self.length).broken(ENDS))?;
        Ok(())
    }

    fn bytes_left(&self) -> Option<&[u8]> {
        Some(self.rest)
    }

    #[inline]
    fn number_at(block: &[u8], kind: Kind) -> f32 {
        let mut value = Binary::<BIG_ENDIAN> { rest: block, length: 0 };
        value.number(kind).expect("a block holds whole rows")
    }

    #[inline]
    fn integer_at(block: &[u8], kind: Kind) -> i64 {
        let mut value = Binary::<BIG_ENDIAN> { rest: block, length: 0 };
        value.integer(kind).expect("a block holds whole rows")
    }

    #[inline(always)]
    fn real(bytes: [u8; 4]) -> f32 {
        if BIG_ENDIAN { f32::from_be_bytes(bytes) } else { f32::from_le_bytes(bytes) }
    }

    #[inline(always)]
    fn whole(bytes: [u8; 4]) -> u32 {
        if BIG_ENDIAN { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) }
    }
}
