//! The machine and program that times were measured with.
use std::{
    fs,
    time::{SystemTime, UNIX_EPOCH},
};

use noisefall_base::math::SimdLevel;
use noisefall_render::render::threads::Threads;

/// The machine and the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Model of the processor.
    pub cpu: String,
    /// Number of cores that the program may use.
    pub cores: usize,
    /// Number of render threads.
    pub threads: usize,
    /// The SIMD level.
    pub simd: String,
    /// The operating system.
    pub os: String,
    /// The version of Noisefall.
    pub version: String,
    /// The commit of Noisefall.
    pub commit: String,
    /// Date as YYYY-MM-DD, UTC.
    pub date: String,
}

impl Machine {
    /// This machine and program.
    pub fn here(threads: &Threads) -> Machine {
        let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
        Machine {
            cpu: cpu(),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            threads: threads.count(),
            simd: SimdLevel::best().name().to_owned(),
            os: os(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: noisefall_render::COMMIT.to_owned(),
            date: date(seconds / 86_400),
        }
    }
}

/// Model of the processor from `/proc/cpuinfo`, or the architecture on other systems.
fn cpu() -> String {
    let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    model.map_or_else(|| std::env::consts::ARCH.to_owned(), |(_, name)| name.trim().to_owned())
}

fn os() -> String {
    let release = fs::read_to_string("/etc/os-release").unwrap_or_default();
    let name = release.lines().find_map(|line| line.strip_prefix("PRETTY_NAME="));
    let kernel = fs::read_to_string("/proc/sys/kernel/osrelease").unwrap_or_default();
    let name = name.map_or(std::env::consts::OS, |name| name.trim_matches('"'));
    if kernel.is_empty() { name.to_owned() } else { format!("{name}, kernel {}", kernel.trim()) }
}

/// The Gregorian date a number of days after 1 January 1970.
fn date(days: u64) -> String {
    let is_leap = |year: u64| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let (mut year, mut left) = (1970, days);
    while left >= 365 + u64::from(is_leap(year)) {
        left -= 365 + u64::from(is_leap(year));
        year += 1;
    }
    let mut month = 1;
    for length in [31, 28 + u64::from(is_leap(year)), 31, 30, 31, 30, 31, 31, 30, 31, 30] {
        if left < length {
            break;
        }
        left -= length;
        month += 1;
    }
    format!("{year}-{month:02}-{:02}", left + 1)
}

#[cfg(test)]
mod tests {
    use super::date;

    #[test]
    fn days_are_dates() {
        assert_eq!([date(0), date(59), date(11_016), date(20_454)], ["1970-01-01", "1970-03-01", "2000-02-29", "2026-01-01"]);
        assert_eq!([date(11_322), date(20_088), date(47_540)], ["2000-12-31", "2024-12-31", "2100-02-28"]);
        assert_eq!([date(47_541), date(20_628)], ["2100-03-01", "2026-06-24"]);
    }
}
