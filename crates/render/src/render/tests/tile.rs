//! Sums of a tile, whole and by blocks.
use super::*;
use noisefall_kernel::integrator::Blocks;

/// Its last blocks are 3 pixels wide and 5 high.
const SIZE: [u32; 2] = [19, 13];

fn tile() -> Tile {
    Tile::new([64, 32], SIZE)
}

fn assert_estimates(tile: &Tile, samples: impl Fn(u32, u32) -> u32) {
    for row in 0..SIZE[1] {
        let estimates = tile.estimates(row as usize);
        assert_eq!(estimates.len(), SIZE[0] as usize);
        for (column, estimate) in (0..).zip(estimates) {
            let [mean, variance] = exact(64 + column, 32 + row, samples(column, row));
            let found = estimate.variance_of_mean.expect("two samples");
            for (channel, factor) in [1.0, 2.0, 4.0].into_iter().enumerate() {
                assert!(is_about(estimate.mean[channel], factor * mean), "{column} {row}: {estimate:?} {mean}");
                assert!(
                    (found[channel] / (factor * factor * variance) - 1.0).abs() < 1e-3,
                    "{column} {row}: {found:?} {variance}"
                );
            }
        }
        let counts: Vec<u32> = tile.counts(row as usize).collect();
        assert!(counts.iter().zip(0..).all(|(count, column)| *count == samples(column, row)), "{row}: {counts:?}");
    }
}

#[test]
fn every_pixel_has_the_mean_and_variance_of_its_own_samples() {
    let mut tile = tile();
    add(&mut tile, 0..1);
    assert!(tile.estimates(0).iter().all(|estimate| estimate.variance_of_mean.is_none()));
    add(&mut tile, 1..5);
    assert_estimates(&tile, |_, _| 5);
    assert_eq!((tile.spp, tile.samples(), tile.invalid), (5, 5 * 19 * 13, 0));
    tile.forget();
    assert_eq!((tile.spp, tile.samples()), (0, 0));
    add(&mut tile, 0..3);
    assert_estimates(&tile, |_, _| 3);
}

#[test]
fn samples_that_are_no_light_are_black_counted_and_named() {
    for bad in [f32::NAN, f32::INFINITY, -1e-9] {
        for channel in 0..3 {
            let mut tile = tile();
            let mut radiance = vec![[1.0; 4]; (TILE * TILE) as usize];
            radiance[(12 * TILE + 17) as usize][channel] = bad;
            radiance[(12 * TILE + 18) as usize][channel] = bad;
            // Beyond the tile nothing counts.
            radiance[(12 * TILE + 19) as usize] = [bad; 4];
            assert_eq!(tile.add(&radiance), Some([64 + 17, 32 + 12]), "{bad} {channel}");
            assert_eq!(tile.invalid, 2);
            assert_eq!(tile.estimates(12).iter().map(|estimate| estimate.mean[0]).collect::<Vec<_>>()[16..], [1.0, 0.0, 0.0]);
        }
    }
}

#[test]
fn blocks_have_places_sizes_and_corners() {
    let tile = tile();
    assert_eq!(tile.blocks.len(), 6);
    assert_eq!([0, 2, 3, 5].map(|block| tile.area().corner(block)), [[64, 32], [80, 32], [64, 40], [80, 40]]);
    assert_eq!([0, 2, 3, 5].map(|block| tile.area().block_size(tile.area().place(block))), [[8, 8], [3, 8], [8, 5], [3, 5]]);
}

/// Brings a tile whose blocks have rates to an average, as a pass does.
fn bring(tile: &mut Tile, spp: u32) {
    while !tile.has_reached(spp) {
        let missing: Blocks = tile.missing(spp);
        let mut radiance = Vec::new();
        for ([x, y], sample) in missing.iter() {
            for slot in 0..BLOCK * BLOCK {
                let red = red(x + slot % BLOCK, y + slot / BLOCK, sample);
                radiance.push([red, 2.0 * red, 4.0 * red, 0.0]);
            }
        }
        assert_eq!(tile.add_blocks(&missing, &radiance), None);
    }
}

#[test]
fn blocks_get_samples_by_their_rates_and_stop_where_they_double() {
    let mut tile = tile();
    for (block, rate) in tile.blocks.iter_mut().zip([0, 1, -1, 2, -2, 4]) {
        block.rate = rate;
    }
    assert!(tile.is_adaptive());
    let counts = |tile: &Tile| tile.blocks.iter().map(|block| block.spp).collect::<Vec<_>>();
    // The samples that an empty tile needs for an average of 4: all blocks are alike.
    assert_eq!(tile.distance_to(4), 24);
    let mut stops = Vec::new();
    while tile.distance_to(12) > 0 {
        bring(&mut tile, 12);
        stops.push(counts(&tile));
        tile.double(0.01);
    }
    // Averages beyond 4 are multiplied, but no block has less than 4.
    assert_eq!(stops.last(), Some(&vec![12, 24, 6, 48, 4, 192]));
    assert!(stops.iter().take(3).zip([1, 2, 4]).all(|(stop, spp)| *stop == vec![spp; 6]), "{stops:?}");
    assert_eq!(stops[3], [8, 8, 6, 8, 4, 8]);
    assert_eq!(tile.distance_to(13), 1 + 2 + 4 + 16);
    tile.note_average(12);
    assert_eq!(tile.spp, 12);
    tile.note_average(13);
    assert_eq!(tile.spp, 12, "samples are missing");
    assert_estimates(&tile, |column, row| [[12, 24, 6], [48, 4, 192]][row as usize / 8][column as usize / 8]);
    assert_eq!(tile.samples(), 64 * (12 + 24) + 24 * 6 + 40 * (48 + 4) + 15 * 192);
}

#[test]
fn an_invalid_sample_of_a_block_is_named_with_its_number() {
    let mut tile = tile();
    tile.blocks[4].rate = 1;
    let mut blocks = Blocks::default();
    blocks.push(tile.area().corner(0), 0);
    blocks.push(tile.area().corner(4), 7);
    let mut radiance = vec![[1.0; 4]; 2 * 64];
    radiance[64 + 3 * 8 + 2][1] = f32::NAN;
    assert_eq!(tile.add_blocks(&blocks, &radiance), Some(([64 + 8 + 2, 32 + 8 + 3], 7)));
}
