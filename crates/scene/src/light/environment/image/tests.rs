//! Sampling against the pdf, the pdf against radiance, and the orientation of the image.
use std::f64::consts::{PI, TAU};

use glam::DVec3;
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{EnvironmentImage, SkyTables, Turn, cell_means};
use crate::chi_squared::chi_squared;
use crate::{
    image::{Picture, Texels},
    shape::{Rotation, Transform, product},
};
use noisefall_base::math::{F, Lanes, One, SimdLevel, V, colour::luminance};

fn picture(width: u32, height: u32, radiance: impl FnMut(u32) -> [f32; 3]) -> Texels {
    (&Picture { width, height, radiance: (0..width * height).map(radiance).collect() }).into()
}

/// An image turned by degrees and multiplied by a factor.
fn environment(picture: Texels, rotate: f64, scale: f32) -> EnvironmentImage {
    EnvironmentImage::new(SkyTables::new(picture, scale, false).into(), rotate)
}

/// Degrees.
const ROTATE: f64 = 75.0;

/// Noise with a sun, in an image whose sides are not powers of two.
fn sky(width: u32, height: u32) -> EnvironmentImage {
    let mut random = SmallRng::seed_from_u64(3);
    let sun = height / 5 * width + width / 3;
    let sky = picture(width, height, |i| if i == sun { [900.0, 800.0, 500.0] } else { [random.random(), 0.1, 0.0] });
    environment(sky, ROTATE, 2.0)
}

fn direction(theta: f64, phi: f64) -> V<One> {
    let [x, y, z] = [theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin()];
    V { x: F(x as f32), y: F(y as f32), z: F(z as f32) }
}

/// Midpoints of the 2²³ cells of (0, 1), like those of the samplers.
fn unit(random: &mut SmallRng) -> F<One> {
    F(((f64::from(random.random_range(0..1u32 << 23)) + 0.5) / f64::from(1 << 23)) as f32)
}

/// The pdf integrated over bins of equal polar angle and azimuth, exactly: it is constant in every step of the sum, because 24
/// steps of a bin are 1/480 and 1/960 of the sphere's angles, [`ROTATE`] is a whole number of them, and so is a cell when the
/// image is small.
fn bin_probabilities(sky: &EnvironmentImage, rows: usize, columns: usize) -> Vec<f64> {
    const STEPS: usize = 24;
    let (theta_step, phi_step) = (PI / (rows * STEPS) as f64, TAU / (columns * STEPS) as f64);
    let mut bins = vec![0.0; rows * columns];
    for row in 0..rows * STEPS {
        let solid_angle = phi_step * ((row as f64 * theta_step).cos() - ((row + 1) as f64 * theta_step).cos());
        for column in 0..columns * STEPS {
            let d = direction((row as f64 + 0.5) * theta_step, (column as f64 + 0.5) * phi_step);
            bins[row / STEPS * columns + column / STEPS] += f64::from(sky.pdf(One, d).0) * solid_angle;
        }
    }
    bins
}

#[test]
fn samples_are_distributed_as_their_pdf() {
    const ROWS: usize = 20;
    const COLUMNS: usize = 40;
    const SAMPLES: usize = 1_000_000;
    for (width, height) in [(37, 19), (1, 1), (2, 3), (1500, 700)] {
        let sky = sky(width, height);
        let mut random = SmallRng::seed_from_u64(5);
        let mut counts = vec![0.0; ROWS * COLUMNS];
        let mut elsewhere = 0;
        for _ in 0..SAMPLES {
            let cell = (unit(&mut random), unit(&mut random));
            let (d, pdf) = sky.sample(One, cell, (unit(&mut random), unit(&mut random)));
            assert!((d.length_squared().0 - 1.0).abs() < 1e-6 && pdf.0 > 0.0);
            // At the rim of a cell rounding may put a direction into the next one.
            elsewhere += usize::from((sky.pdf(One, d).0 / pdf.0 - 1.0).abs() > 1e-6);
            let [x, y, z] = d.lane(0).map(f64::from);
            let row = (x.hypot(z).atan2(y) / PI * ROWS as f64) as usize;
            let column = (z.atan2(x) / TAU).rem_euclid(1.0) * COLUMNS as f64;
            counts[row.min(ROWS - 1) * COLUMNS + (column as usize).min(COLUMNS - 1)] += 1.0;
        }
        println!("{width} × {height}: {elsewhere} of {SAMPLES} samples have the pdf of the next cell");
        assert!(elsewhere < SAMPLES / 2000, "{elsewhere}");
        if width > 1000 {
            continue;
        }
        let expected = bin_probabilities(&sky, ROWS, COLUMNS);
        let whole: f64 = expected.iter().sum();
        assert!((whole - 1.0).abs() < 1e-6, "{whole}");
        let expected: Vec<f64> = expected.iter().map(|p| p * SAMPLES as f64).collect();
        let p = chi_squared(&counts, &expected);
        println!("{width} × {height}: p = {p:.3}");
        assert!(p > 1e-4, "{width} × {height}: p = {p}");
    }
}

#[test]
fn the_pdf_integrates_to_one() {
    let sky = sky(64, 32);
    let mut whole = 0.0;
    for row in 0..32 {
        for column in 0..64 {
            let share = TAU / 64.0 * ((PI * f64::from(row) / 32.0).cos() - (PI * f64::from(row + 1) / 32.0).cos());
            let (theta, phi) = (PI * (f64::from(row) + 0.5) / 32.0, TAU * (f64::from(column) + 0.5) / 64.0);
            // The image's cells are turned against the axes of φ.
            let d = direction(theta, phi - ROTATE.to_radians());
            whole += f64::from(sky.pdf(One, d).0) * share;
        }
    }
    println!("pdf integrates to {whole}");
    assert!((whole - 1.0).abs() < 1e-6, "{whole}");
}

#[test]
fn directions_with_light_have_a_density() {
    let lone = environment(picture(2000, 1000, |i| if i == 1_234_567 { [1e-30; 3] } else { [0.0; 3] }), 0.0, 1.0);
    let mut lit = 0;
    for i in 0..4_000_000 {
        let (row, column) = (617.0 + 0.5 + f64::from(i / 2000 % 2000) / 1000.0 - 1.0, f64::from(i % 2000) / 1000.0 + 566.5);
        let d = direction(PI * row / 1000.0, TAU * (column / 2000.0 - 0.75));
        let bright = lone.radiance(One, d).x.0 > 0.0;
        lit += i32::from(bright);
        assert!(!bright || lone.pdf(One, d).0 > 0.0);
    }
    assert!(lit > 1_000_000, "{lit}");
}

#[test]
fn the_middle_column_faces_minus_z_and_rotation_is_counter_clockwise_from_above() {
    let marked = |column: u32| picture(8, 4, move |i| if i / 8 == 0 { [9.0; 3] } else { [f32::from(i % 8 == column); 3] });
    let at = |sky: &EnvironmentImage, [x, y, z]: [f32; 3]| sky.radiance(One, V { x: F(x), y: F(y), z: F(z) }).x.0;
    // The middle of the image is the edge between columns 3 and 4.
    let sky = environment(marked(4), 22.5, 1.0);
    assert!((at(&sky, [0.0, 0.0, -1.0]) - 1.0).abs() < 1e-5);
    assert_eq!((at(&sky, [0.0, 1.0, 0.0]), at(&sky, [0.0, -1.0, 0.0])), (9.0, 1.0));
    let right = environment(marked(6), 22.5, 1.0);
    assert!((at(&right, [1.0, 0.0, 0.0]) - 1.0).abs() < 1e-5);
    let turned = environment(marked(4), 22.5 + 90.0, 1.0);
    assert!((at(&turned, [-1.0, 0.0, 0.0]) - 1.0).abs() < 1e-5);
}

#[test]
fn a_black_picture_has_no_light_and_a_density_all_the_same() {
    let black = environment(picture(3, 2, |_| [0.0; 3]), 0.0, 1.0);
    assert_eq!(black.mean_luminance(), 0.0);
    assert!(black.pdf(One, direction(1.0, 1.0)).0 > 0.0);
    let white = environment(picture(3, 2, |_| [1.0; 3]), 0.0, 3.0);
    assert!((white.mean_luminance() - 3.0).abs() < 1e-6);
}

#[test]
fn cell_means_are_those_of_the_bilinear_picture() {
    let steps = picture(5, 3, |i| [(i * i % 7) as f32; 3]);
    let texture = crate::texture::ImageTexture::new(steps.clone());
    let means = cell_means(&steps, 4, 8, [0.0, 1.0]);
    for (cell, mean) in means.iter().enumerate() {
        let at = |i: usize, cell: usize, cells: usize| F::<One>(((cell as f64 + (i as f64 + 0.5) / 64.0) / cells as f64) as f32);
        let value = |i: usize| texture.colour(One, at(i % 64, cell % 4, 4), at(i / 64, cell / 4, 8), crate::texture::Edge::Clamp);
        let exact = (0..4096).map(|i| f64::from(luminance(value(i).lane(0)))).sum::<f64>() / 4096.0;
        assert!((mean - exact).abs() < 1e-3, "{cell}: {mean} {exact}");
    }
}

#[test]
fn rows_at_the_poles_are_reached_there() {
    // Rows of 1, 2 and 4: at the poles, and half way between them.
    let rows = picture(2, 3, |i| [[1.0, 2.0, 4.0][i as usize / 2]; 3]);
    let sky = EnvironmentImage::new(SkyTables::new(rows.clone(), 1.0, true).into(), 0.0);
    let at = |theta: f32| sky.radiance(One, V { x: F(theta.sin()), y: F(theta.cos()), z: F(0.0) }).x.0;
    for (theta, exact) in [(0.0, 1.0), (0.25, 1.5), (0.5, 2.0), (0.75, 3.0), (1.0, 4.0)] {
        assert!((at(theta * std::f32::consts::PI) - exact).abs() < 1e-5, "{theta}: {}", at(theta * std::f32::consts::PI));
    }
    // Four rows of cells between the poles: means of a line from 1 to 2 over its halves, and of one from 2 to 4.
    let means = cell_means(&rows, 1, 4, [1.0 / 6.0, 2.0 / 3.0]);
    assert!(means.iter().zip([1.25, 1.75, 2.5, 3.5]).all(|(mean, exact)| (mean - exact).abs() < 1e-6), "{means:?}");
}

#[test]
fn the_mean_luminance_is_that_of_the_cells() {
    let mut random = SmallRng::seed_from_u64(5);
    let clouds = picture(6, 3, |_| [random.random(), random.random(), random.random()]);
    let means = cell_means(&clouds, 8, 4, [0.0, 1.0]);
    // The solid angle of a cell of row j of four: 2π/8 times the difference of the cosines.
    let solid_angle = |row: usize| TAU / 8.0 * ((PI * row as f64 / 4.0).cos() - (PI * (row + 1) as f64 / 4.0).cos());
    let exact = (0..32).map(|cell| means[cell] * solid_angle(cell / 8)).sum::<f64>() / (2.0 * TAU);
    let sky = environment(clouds, 40.0, 3.0);
    assert!((f64::from(sky.mean_luminance()) / exact - 3.0).abs() < 1e-5, "{} for {exact}", sky.mean_luminance());
}

#[test]
fn densities_are_in_proportion_to_the_light_of_cells() {
    // Eight columns, four rows, of powers of two: cells are texels that stand for themselves only at their middles, and the mean of
    // a cell is 3/4 of its texel, 1/8 of each neighbour's along either axis.
    let level = |i: u32| if i == 8 + 3 { 64.0 } else { 1.0 };
    let sky = environment(picture(8, 4, |i| [level(i); 3]), 0.0, 1.0);
    let at = |column: f64, row: f64| {
        let (theta, azimuth) = (PI * (row + 0.5) / 4.0, TAU * ((column + 0.5) / 8.0 - 0.5));
        // From −z towards +x.
        sky.pdf(
            One,
            V {
                x: F((theta.sin() * azimuth.sin()) as f32),
                y: F(theta.cos() as f32),
                z: F((-theta.sin() * azimuth.cos()) as f32),
            },
        )
        .0
    };
    let mean = |weight: f64| 1.0 + 63.0 * weight;
    let ratio =
        |a: f32, b: f64, c: f32, d: f64| assert!((f64::from(a / c) - b / d).abs() < 1e-4 * b / d, "{a}/{c} is not {b}/{d}");
    let peak = at(3.0, 1.0);
    ratio(peak, mean(0.75 * 0.75), at(6.0, 1.0), 1.0);
    ratio(peak, mean(0.75 * 0.75), at(2.0, 1.0), mean(0.125 * 0.75));
    ratio(peak, mean(0.75 * 0.75), at(4.0, 1.0), mean(0.125 * 0.75));
    ratio(peak, mean(0.75 * 0.75), at(3.0, 2.0), mean(0.75 * 0.125));
    ratio(at(6.0, 0.0), 1.0, at(6.0, 1.0), 1.0);
    ratio(at(6.0, 3.0), 1.0, at(6.0, 1.0), 1.0);
}

#[inline(always)]
fn lanes_of<L: Lanes>(l: L, sky: &EnvironmentImage, numbers: &[[f32; 16]; 4]) -> Vec<[u32; 8]> {
    let [index, coin, u, v] = [0, 1, 2, 3].map(|i| l.load(&numbers[i]));
    let (d, density) = sky.sample(l, (index, coin), (u, v));
    let (pdf, radiance) = (sky.pdf(l, d), sky.radiance(l, d));
    let numbers = [d.x, d.y, d.z, density, pdf, radiance.x, radiance.y, radiance.z].map(F::to_array);
    (0..L::N).map(|lane| numbers.map(|number| number[lane].to_bits())).collect()
}

#[test]
fn every_width_gives_the_same_bits() {
    let sky = sky(37, 19);
    let mut random = SmallRng::seed_from_u64(9);
    for _ in 0..500 {
        let numbers: [[f32; 16]; 4] = std::array::from_fn(|_| std::array::from_fn(|_| unit(&mut random).0));
        for level in SimdLevel::available() {
            let found = noisefall_base::math::in_lanes!(level, l => lanes_of(l, &sky, &numbers));
            let one = |lane: usize| lanes_of(One, &sky, &numbers.map(|n| [n[lane]; 16]))[0];
            assert_eq!(found, (0..found.len()).map(one).collect::<Vec<_>>(), "{level:?}");
        }
    }
}

#[test]
fn the_poles_have_the_density_of_the_rows_that_end_there() {
    // The lowest of four rows is nine times as bright: means of rows of cells are 1, 1, 2 and 8.
    let sky = environment(picture(8, 4, |i| [if i >= 24 { 9.0 } else { 1.0 }; 3]), 30.0, 1.0);
    let height = |row: u32| (PI * f64::from(row) / 4.0).cos() - (PI * f64::from(row + 1) / 4.0).cos();
    let light: f64 = [1.0, 1.0, 2.0, 8.0].iter().zip(0..).map(|(mean, row)| mean * TAU * height(row)).sum();
    for (y, mean) in [(1.0, 1.0), (-1.0, 8.0)] {
        let found = f64::from(sky.pdf(One, V { x: F(0.0), y: F(y), z: F(0.0) }).0);
        assert!((found * light / mean - 1.0).abs() < 1e-4, "{y}: {found}");
    }
}

#[test]
fn the_memory_of_a_sky_is_that_of_its_texels_and_cells() {
    // Texels of 16 bytes; cells, twice as many a side at most, of 64; and a mean for every cell of a row of texels.
    assert_eq!(SkyTables::bytes([37, 19]), 16 * 37 * 19 + 64 * 74 * 38 + 8 * 74 * 19);
    assert_eq!(SkyTables::bytes([5000, 3000]), 16 * 5000 * 3000 + 64 * 1024 * 512 + 8 * 1024 * 3000);
}

/// A rotation, a mirroring, and both with a translation and a scale that do not matter.
fn turns() -> Vec<Vec<Transform>> {
    let rotation = Transform::Rotate(Rotation { axis: DVec3::new(1.0, 2.0, -0.5), degrees: 70.0 });
    let mirror = Transform::Scale(DVec3::new(-1.0, 1.0, 1.0));
    let all = vec![mirror.clone(), rotation.clone(), Transform::Translate(DVec3::X), Transform::Scale(DVec3::splat(2.0))];
    vec![vec![rotation], vec![mirror], all]
}

#[test]
fn a_turned_image_is_the_image_in_turned_directions() {
    let straight = sky(37, 19);
    let mut random = SmallRng::seed_from_u64(4);
    for list in turns() {
        let matrix = product(&list).expect("it is valid").matrix3;
        let turned = EnvironmentImage { turn: Turn::of(&list).expect("it is a turn"), ..sky(37, 19) };
        let mut same = 0;
        for _ in 0..2000 {
            let d = direction(PI * random.random::<f64>(), TAU * random.random::<f64>());
            let there = (matrix * glam::Vec3::from(d.lane(0)).as_dvec3()).normalize().as_vec3().to_array();
            let there = V::splat(One, there);
            let [a, b] = [straight.radiance(One, d), turned.radiance(One, there)].map(|light| luminance(light.lane(0)));
            assert!((a - b).abs() < 1e-2 * (1.0 + a), "{a} {b}");
            same += u32::from((straight.pdf(One, d).0 / turned.pdf(One, there).0 - 1.0).abs() < 1e-6);
            let numbers = [0; 4].map(|_| unit(&mut random));
            let [index, coin, u, v] = numbers;
            let ((a, pdf), (b, same_pdf)) =
                (straight.sample(One, (index, coin), (u, v)), turned.sample(One, (index, coin), (u, v)));
            assert_eq!(pdf.0, same_pdf.0);
            let expected = (matrix * glam::Vec3::from(a.lane(0)).as_dvec3()).normalize();
            assert!(expected.distance(glam::Vec3::from(b.lane(0)).as_dvec3()) < 1e-6);
        }
        // At the rim of a cell rounding may take a direction to the next one.
        assert!(same > 1990, "{same}");
    }
}

#[test]
fn transforms_that_distort_directions_are_refused_and_none_is_no_turn() {
    assert!(Turn::of(&[]).expect("nothing is wrong").is_none());
    assert!(Turn::of(&[Transform::Scale(DVec3::new(1.0, 2.0, 1.0))]).is_err());
    let sheared = [[1.0, 0.1, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    assert!(Turn::of(&[Transform::Matrix(sheared)]).is_err());
    // A quarter turn of another program, in single precision.
    let e = 1e-6;
    let turned = [[e, 0.0, 1.0, 5.0], [0.0, 1.0, e, 0.0], [-1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let turn = Turn::of(&[Transform::Matrix(turned)]).expect("it is a rotation").expect("it is there");
    let d = turn.to_world(One, V { x: F(1.0), y: F(0.0), z: F(0.0) });
    assert!((d.z.0 + 1.0).abs() < 1e-6 && (d.length_squared().0 - 1.0).abs() < 1e-6);
}
