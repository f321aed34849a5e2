//! Detection of the processor's instruction set at run time, so that one release binary runs everywhere.
use fearless_simd::Level;

/// The vector instructions of a render. All levels give the same image, bit for bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SimdLevel {
    /// One lane, no vector instructions.
    Scalar,
    /// Four lanes: NEON.
    Bits128,
    /// Sixteen lanes in pairs of AVX2 registers.
    Avx2,
    /// Sixteen lanes in AVX-512 registers.
    Avx512,
}

impl SimdLevel {
    /// The levels that this processor supports, slowest first.
    pub fn available() -> Vec<SimdLevel> {
        let level = Level::new();
        let mut all = vec![SimdLevel::Scalar];
        #[cfg(target_arch = "x86_64")]
        {
            let x86 = [(level.as_avx2().is_some(), SimdLevel::Avx2), (level.as_avx512().is_some(), SimdLevel::Avx512)];
            all.extend(x86.into_iter().filter(|(has, _)| *has).map(|(_, level)| level));
        }
        #[cfg(target_arch = "aarch64")]
        if level.as_neon().is_some() {
            all.push(SimdLevel::Bits128);
        }
        let _ = level;
        all
    }

    /// The usual name of the instruction set.
    pub fn name(self) -> &'static str {
        match self {
            SimdLevel::Scalar => "none",
            SimdLevel::Bits128 => "NEON",
            SimdLevel::Avx2 => "AVX2",
            SimdLevel::Avx512 => "AVX-512",
        }
    }

    /// The widest level of this processor.
    pub fn best() -> SimdLevel {
        SimdLevel::available().into_iter().last().unwrap_or(SimdLevel::Scalar)
    }
}

/// Calls a function with the lane configuration of a [`SimdLevel`]: `in_lanes!(level, l => call(l, …))`. Falls back to a level
/// that the processor has. Unit tests are compiled for AVX2 and one lane only, which halves their build time; tests of whole images have all
/// levels.
#[macro_export]
macro_rules! in_lanes {
    ($level:expr, $l:ident => $call:expr) => {{
        use $crate::math::{
            lanes::One,
            level::SimdLevel,
            simd::{X4, X16},
        };
        let detected = ::fearless_simd::Level::new();
        let _ = (&detected, X4::<::fearless_simd::Fallback>, X16::<::fearless_simd::Fallback>);
        match $level {
            #[cfg(all(target_arch = "x86_64", not(test)))]
            SimdLevel::Avx512 if let Some(token) = detected.as_avx512() => {
                let $l = X16(token);
                $call
            }
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx2 | SimdLevel::Avx512 if let Some(token) = detected.as_avx2() => {
                let $l = X16(token);
                $call
            }
            #[cfg(target_arch = "aarch64")]
            SimdLevel::Bits128 if let Some(token) = detected.as_neon() => {
                let $l = X4(token);
                $call
            }
            _ => {
                let $l = One;
                $call
            }
        }
    }};
}
pub use in_lanes;

/// [`in_lanes!`] for code that is large: it is compiled for AVX2, which every processor with AVX-512 has too, for NEON, and for one lane.
#[macro_export]
macro_rules! in_few_lanes {
    ($level:expr, $l:ident => $call:expr) => {{
        use $crate::math::{
            lanes::One,
            level::SimdLevel,
            simd::{X4, X16},
        };
        let detected = ::fearless_simd::Level::new();
        let _ = (&detected, X4::<::fearless_simd::Fallback>, X16::<::fearless_simd::Fallback>);
        match $level {
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx2 | SimdLevel::Avx512 if let Some(token) = detected.as_avx2() => {
                let $l = X16(token);
                $call
            }
            #[cfg(target_arch = "aarch64")]
            SimdLevel::Bits128 if let Some(token) = detected.as_neon() => {
                let $l = X4(token);
                $call
            }
            _ => {
                let $l = One;
                $call
            }
        }
    }};
}
pub use in_few_lanes;
