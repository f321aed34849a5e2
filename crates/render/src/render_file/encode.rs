//! Values of binary sections, little-endian.

/// Appends values to the payload of a section; [`super::Fields`] reads them.
pub trait Encode {
    /// Appends itself.
    fn encode(&self, to: &mut Vec<u8>);
}

macro_rules! numbers {
    ($($number:ty)*) => {
        $(impl Encode for $number {
            #[inline]
            fn encode(&self, to: &mut Vec<u8>) {
                to.extend_from_slice(&self.to_le_bytes());
            }
        })*
    };
}

numbers!(u8 i8 u32 u64 i64 f32 f64);

impl<T: Encode, const N: usize> Encode for [T; N] {
    #[inline]
    fn encode(&self, to: &mut Vec<u8>) {
        self.iter().for_each(|value| value.encode(to));
    }
}

impl<T: Encode> Encode for [T] {
    #[inline]
    fn encode(&self, to: &mut Vec<u8>) {
        self.iter().for_each(|value| value.encode(to));
    }
}
