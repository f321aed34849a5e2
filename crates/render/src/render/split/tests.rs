//! Exact sums of tiles with known samples, and their sections.
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{
    NoSamples, SampleFile, SampleRanges, SplitPicture, section,
    sums::{TileSums, TooManySamples},
    write,
};
use crate::{
    render::{area::Area, checkpoint::tests::small_render, exact_sum::MOST_VALUES},
    render_file::{Header, ImageFacts, Kind},
};
use noisefall_base::{file::faults::lose_nothing, math::SimdLevel};
use noisefall_kernel::integrator::{BLOCK, TILE};
use noisefall_scene::scene::PathReuse;

/// Its last blocks are 3 pixels wide and 5 high.
const AREA: Area = Area { origin: [64, 32], size: [19, 13] };

/// A sample of each slot of a tile.
fn sample(random: &mut SmallRng) -> Vec<[f32; 4]> {
    let slot = |random: &mut SmallRng| [0, 1, 2, 3].map(|_| random.random_range(0.0f32..1.0).powi(8) * 100.0);
    (0..TILE * TILE).map(|_| slot(random)).collect()
}

/// The samples of a block, out of those of its tile.
fn of_block(radiance: &[[f32; 4]], block: usize) -> Vec<[f32; 4]> {
    let [left, top] = AREA.place(block);
    let slot = |slot: u32| {
        let (x, y) = ((left + slot % BLOCK).min(TILE - 1), (top + slot / BLOCK).min(TILE - 1));
        radiance[(y * TILE + x) as usize]
    };
    (0..BLOCK * BLOCK).map(slot).collect()
}

fn tile(samples: u32) -> TileSums {
    let (mut random, mut sums) = (SmallRng::seed_from_u64(1), TileSums::new(AREA));
    (0..samples).for_each(|_| assert_eq!(sums.add(SimdLevel::best(), &sample(&mut random)), None));
    sums
}

#[test]
fn tiles_and_their_blocks_have_the_same_sums_at_every_level() {
    for level in SimdLevel::available() {
        let (mut random, mut whole, mut blocks) = (SmallRng::seed_from_u64(1), TileSums::new(AREA), TileSums::new(AREA));
        for _ in 0..5 {
            let radiance = sample(&mut random);
            whole.add(level, &radiance);
            (0..AREA.blocks()).for_each(|block| _ = blocks.add_block(level, block, &of_block(&radiance, block)));
        }
        assert_eq!(whole, tile(5), "{level:?}");
        assert_eq!(TileSums { whole: whole.whole.clone(), ..blocks }, whole);
    }
}

#[test]
fn invalid_samples_are_black_and_the_first_is_named() {
    let mut random = SmallRng::seed_from_u64(1);
    let mut radiance = sample(&mut random);
    let mut expected = radiance.clone();
    for (slot, value) in [(2 * TILE + 18, f32::NAN), (5 * TILE + 1, -1.0), (5 * TILE + 2, f32::INFINITY), (12 * TILE, -0.5)] {
        radiance[slot as usize][1] = value;
        expected[slot as usize] = [0.0; 4];
    }
    let (mut found, mut black) = (TileSums::new(AREA), TileSums::new(AREA));
    assert_eq!(found.add(SimdLevel::best(), &radiance), Some([64 + 18, 32 + 2]));
    assert_eq!(black.add(SimdLevel::best(), &expected), None);
    assert_eq!((found.invalid, TileSums { invalid: 0, ..found }), (4, black));
    let last = AREA.blocks() - 1;
    let found = TileSums::new(AREA).add_block(SimdLevel::best(), last, &of_block(&radiance, last));
    assert_eq!(found, None, "the last block has none");
    let found = TileSums::new(AREA).add_block(SimdLevel::best(), 3, &of_block(&radiance, 3));
    assert_eq!(found, Some([64, 32 + 12]));
}

#[test]
fn equal_samples_have_no_variance_and_noise_figures_follow_the_rest() {
    let picture = |sums: &TileSums| {
        let resolution = [TILE, TILE];
        let samples = SampleRanges::of(&[[0, sums.counts[0]]]).expect("a range");
        let mut picture = SplitPicture::new(resolution, samples, PathReuse::Off).expect("there is memory");
        picture.add(sums).expect("every pixel has samples");
        picture.frame()
    };
    let mut equal = TileSums::new(Area { origin: [0, 0], size: [TILE, TILE] });
    let radiance = sample(&mut SmallRng::seed_from_u64(3));
    (0..37).for_each(|_| _ = equal.add(SimdLevel::best(), &radiance));
    let frame = picture(&equal);
    let noise = frame.noise.expect("two samples or more");
    assert!(noise.variance.iter().all(|variance| *variance == [0.0; 3]) && noise.blocks == [0.0]);
    assert_eq!((noise.effective_samples, frame.rel_mse_estimate), (f64::INFINITY, Some(0.0)));
    assert!(frame.radiance.iter().zip(&radiance).all(|(mean, sample)| mean[..] == sample[..3]));

    let mut two = TileSums::new(Area { origin: [0, 0], size: [TILE, TILE] });
    [1.0, 3.0].iter().for_each(|x| _ = two.add(SimdLevel::best(), &vec![[*x, *x, *x, 0.0]; (TILE * TILE) as usize]));
    let frame = picture(&two);
    // Mean 2, and variance of the mean 1: relMSE 1/(4 + floor), whose mean square is 2² − 1, or that of the block, 4.
    assert!((frame.rel_mse_estimate.expect("it is known") - 1.0 / 4.04).abs() < 1e-6);
    let noise = frame.noise.expect("its noise");
    assert_eq!((noise.variance[7], noise.effective_samples), ([1.0; 3], 1024.0));
    // The channels are equal: 9 times the variance of each pixel, over (3 · 1024)².
    assert!((noise.blocks[0] - 1024.0 * 9.0 / (3.0f64 * 1024.0).powi(2)).abs() < 1e-12);
}

#[test]
fn pixels_without_samples_have_no_image() {
    let mut sums = tile(2);
    sums.counts[2] = 0;
    let samples = SampleRanges::of(&[[5, 7]]).expect("a range");
    let mut picture = SplitPicture::new([19, 13], samples.clone(), PathReuse::Off).expect("there is memory");
    assert_eq!(picture.add(&sums), Err(NoSamples(samples)));
}

#[test]
fn sums_of_too_many_samples_are_refused() {
    let (mut a, mut b) = (tile(1), tile(1));
    (a.counts[1], b.counts[1]) = (MOST_VALUES - 1, 1);
    assert_eq!(a.merge(&b), Ok(()));
    assert_eq!(a.merge(&b), Err(TooManySamples));
}

#[test]
fn sections_come_back_and_nonsense_is_refused() {
    let sums = tile(3);
    let section = section::encode(7, &sums);
    let payload = &section.bytes()[12..section.bytes().len() - 4];
    assert_eq!(section::decode(payload, 7, AREA).expect("it is whole"), sums);
    assert!(section::decode(payload, 8, AREA).is_err());
    assert!(section::decode(&payload[..payload.len() - 1], 7, AREA).is_err());
    assert!(section::decode(&[payload, &[0]].concat(), 7, AREA).is_err());
    // Checksums can be right by intent: whatever is read must be safe to join and to show.
    let mut random = SmallRng::seed_from_u64(5);
    for _ in 0..2000 {
        let mut changed = payload.to_vec();
        for _ in 0..random.random_range(1..4) {
            let at = random.random_range(0..changed.len());
            changed[at] = random.random();
        }
        let Ok(found) = section::decode(&changed, 7, AREA) else { continue };
        let _ = sums.clone().merge(&found);
        let mut picture = SplitPicture::new([128, 64], SampleRanges::default(), PathReuse::Suffixes).expect("there is memory");
        let _ = picture.add(&found);
    }
}

#[test]
fn a_disk_that_fails_at_any_moment_leaves_the_samples_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.nf");
    let resolution = [8, 4];
    let (header, _) = small_render(resolution, folder.path());
    let tile = TileSums::new(Area { origin: [0, 0], size: resolution });
    let write = |end: u32| {
        let header =
            Header { kind: Kind::Samples, samples: vec![[0, end]], image: Some(ImageFacts::default()), ..header.clone() };
        write(&path, &header, std::iter::once(&tile)).map_err(|error| error.to_string())
    };
    write(1).expect("it is written");
    lose_nothing(&path, &mut || write(2));
    assert_eq!(SampleFile::open(&path).expect("it is whole").samples().list(), [[0, 1]]);
}
