//! Reads the values of binary sections.
use super::RenderFileError;

/// The payload of a section, read from front to back.
pub struct Fields<'b>(&'b [u8]);

/// A value that has a fixed number of bytes, little-endian.
pub trait Decode: Sized {
    /// Takes the value from the front.
    fn decode(fields: &mut Fields) -> Result<Self, RenderFileError>;
}

macro_rules! numbers {
    ($($number:ty)*) => {
        $(impl Decode for $number {
            #[inline]
            fn decode(fields: &mut Fields) -> Result<$number, RenderFileError> {
                fields.bytes().map(<$number>::from_le_bytes)
            }
        })*
    };
}

numbers!(u8 i8 u32 u64 i64 f32 f64);

impl<T: Decode + Copy + Default, const N: usize> Decode for [T; N] {
    #[inline]
    fn decode(fields: &mut Fields) -> Result<[T; N], RenderFileError> {
        let mut values = [T::default(); N];
        for value in &mut values {
            *value = T::decode(fields)?;
        }
        Ok(values)
    }
}

impl<'b> Fields<'b> {
    /// The values of a payload.
    pub fn of(payload: &'b [u8]) -> Fields<'b> {
        Fields(payload)
    }

    /// The next value.
    #[inline]
    pub fn take<T: Decode>(&mut self) -> Result<T, RenderFileError> {
        T::decode(self)
    }

    /// The next values. Nothing is allocated unless they are there.
    pub fn list<T: Decode>(&mut self, count: usize) -> Result<Vec<T>, RenderFileError> {
        if count.checked_mul(size_of::<T>()).is_none_or(|bytes| bytes > self.0.len()) {
            return Err(too_short());
        }
        (0..count).map(|_| self.take()).collect()
    }

    /// Whether no values are left.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Fails if values are left.
    pub fn end(self) -> Result<(), RenderFileError> {
        if self.0.is_empty() { Ok(()) } else { Err(RenderFileError::contents("a section is longer than its values")) }
    }

    #[inline]
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], RenderFileError> {
        let (first, rest) = self.0.split_first_chunk().ok_or_else(too_short)?;
        self.0 = rest;
        Ok(*first)
    }
}

fn too_short() -> RenderFileError {
    RenderFileError::contents("a section is shorter than its values")
}
