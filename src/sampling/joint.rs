//! The decisions near the camera as one Sobol point: pixel and first light sample are stratified together.
//!
//! Further on, and for single coordinates, points of two dimensions are padded: paths that long differ in too much for more
//! dimensions to help; with the first direction, the fifth and sixth coordinate, the error grew again by 9 % at 256 spp. Direction numbers: S. Joe and F. Y. Kuo, "Constructing Sobol sequences with better two-dimensional
//! projections", SIAM J. Sci. Comput. 30(5), 2008.
use super::Dimension;

const DIMENSIONS: usize = 4;

/// Degree s, coefficients a and initial numbers m of the primitive polynomials of dimensions 2, 3, …
const POLYNOMIALS: [(u32, u32, [u32; 3]); DIMENSIONS - 1] = [(1, 0, [1, 0, 0]), (2, 1, [1, 3, 0]), (3, 1, [1, 3, 1])];

/// Columns of the generator matrices, with the bits in reverse order.
static COLUMNS: [[u32; 32]; DIMENSIONS] = columns();

const fn columns() -> [[u32; 32]; DIMENSIONS] {
    let mut columns = [[0; 32]; DIMENSIONS];
    let mut bit = 0;
    while bit < 32 {
        columns[0][bit] = 1 << bit;
        bit += 1;
    }
    let mut dimension = 1;
    while dimension < DIMENSIONS {
        let (degree, a, initial) = POLYNOMIALS[dimension - 1];
        let mut v = [0u32; 32];
        let mut k = 0;
        while k < 32 {
            if k < degree as usize {
                v[k] = initial[k] << (31 - k);
            } else {
                let s = degree as usize;
                v[k] = v[k - s] ^ (v[k - s] >> degree);
                let mut i = 1;
                while i < s {
                    if (a >> (s - 1 - i)) & 1 == 1 {
                        v[k] ^= v[k - i];
                    }
                    i += 1;
                }
            }
            columns[dimension][k] = v[k].reverse_bits();
            k += 1;
        }
        dimension += 1;
    }
    columns
}

/// The number of a sample, and its point of the joint sequence.
#[derive(Clone, Copy, Debug)]
pub struct SampleNumber {
    pub index: u32,
    /// Coordinates as 32-bit fractions, their bits in reverse order.
    joint: [u32; DIMENSIONS],
}

impl SampleNumber {
    pub fn new(index: u32) -> SampleNumber {
        let coordinate = |columns: &[u32; 32]| {
            let bits = columns.iter().enumerate().filter(|(bit, _)| index >> bit & 1 == 1);
            bits.fold(0, |sum, (_, column)| sum ^ column)
        };
        SampleNumber { index, joint: std::array::from_fn(|dimension| coordinate(&COLUMNS[dimension])) }
    }

    /// The two coordinates of a decision, reversed, if it belongs to the joint point.
    #[inline(always)]
    pub(super) fn joint(&self, dimension: Dimension) -> Option<[u32; 2]> {
        let first = match dimension {
            Dimension::PIXEL => 0,
            _ if dimension == Dimension::light(1) => 2,
            _ => return None,
        };
        Some([self.joint[first], self.joint[first + 1]])
    }
}
