//! Hand-made PFM files.
use super::{ImageFormatError, read};

fn pfm(header: &str, numbers: &[f32], bytes: fn(f32) -> [u8; 4]) -> Vec<u8> {
    [header.as_bytes().to_vec(), numbers.iter().flat_map(|x| bytes(*x)).collect()].concat()
}

#[test]
fn rows_run_upwards_in_either_order_of_bytes() {
    let numbers: Vec<f32> = (0..12).map(|x| x as f32).collect();
    let expected = [[6.0, 7.0, 8.0], [9.0, 10.0, 11.0], [0.0, 1.0, 2.0], [3.0, 4.0, 5.0]];
    for (header, bytes) in [
        ("PF\n2 2\n-1.0\n", f32::to_le_bytes as fn(f32) -> [u8; 4]),
        ("PF\n2 2\n1.0\n", f32::to_be_bytes),
        ("PF 2\n2 -1e0 ", f32::to_le_bytes),
        ("PF\r\n2 2\r\n-1\r\n", f32::to_le_bytes),
    ] {
        let picture = read(&pfm(header, &numbers, bytes)).expect("it is an image");
        assert_eq!((picture.width, picture.height, &picture.radiance[..]), (2, 2, &expected[..]), "{header}");
    }
}

#[test]
fn one_channel_is_grey_and_the_factor_counts() {
    let picture = read(&pfm("Pf\n1 3\n-0.5\n", &[1.0, 2.0, 40.0], f32::to_le_bytes)).expect("it is an image");
    assert_eq!(picture.radiance, [[20.0; 3], [1.0; 3], [0.5; 3]]);
}

#[test]
fn broken_files_are_refused() {
    let refuses = |header: &str, numbers: &[f32], reason: &str| {
        let error = read(&pfm(header, numbers, f32::to_le_bytes)).expect_err("it is broken").to_string();
        assert!(error.contains(reason), "{error}");
    };
    refuses("PF\n2 1\n-1\n", &[0.0; 5], "ends within its pixels");
    refuses("PF\n16384 8192\n-1\n", &[0.0; 5], "ends within its pixels");
    refuses("PF\n2 1\n0\n", &[0.0; 6], "`0` is not a factor");
    refuses("PF\n2 1\nnan\n", &[0.0; 6], "is not a factor");
    refuses("PF\n2 -1\n1\n", &[0.0; 6], "`-1` is not a number of pixels");
    refuses("PF\n0 1\n1\n", &[0.0; 6], "no pixels");
    refuses("PF\n60000 1\n1\n", &[], "60000 × 1");
    refuses("PF\n2", &[], "within its header");
    refuses(&format!("PF\n{}", "1".repeat(1000)), &[], "not that of a PFM");
    assert_eq!(read(b"P6\n1 1\n255\nabc"), Err(ImageFormatError::NotAPicture));
}
