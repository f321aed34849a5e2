//! Properties of exact sums, over random values, orders and groupings.
use rand::{Rng, SeedableRng, rngs::SmallRng, seq::SliceRandom};

use super::*;

/// Values of any f32 magnitude, some of them 0, or of few magnitudes.
fn values(random: &mut SmallRng) -> Vec<f64> {
    let [low, high] = [random.random_range(-149..=127), random.random_range(-149..=127)];
    let exponents = low.min(high)..=low.max(high);
    let value = |random: &mut SmallRng| {
        let mantissa = if random.random_bool(0.2) { 0 } else { random.random_range(0..1u32 << 24) };
        f64::from((f64::from(mantissa) * 2f64.powi(random.random_range(exponents.clone()) - 23)) as f32)
    };
    (0..random.random_range(1..60)).map(|_| value(random)).collect()
}

/// The sums of values and of their squares.
fn sum(values: &[f64]) -> ExactSums {
    let mut sums = ExactSums::new(2);
    values.iter().for_each(|x| sums.add(0, &[*x, x * x]));
    sums
}

fn of_one(values: &[f64]) -> f64 {
    sum(values).value(0)
}

/// Joins sums in random pairs.
fn joined(mut parts: Vec<ExactSums>, random: &mut SmallRng) -> ExactSums {
    while parts.len() > 1 {
        let part = parts.swap_remove(random.random_range(0..parts.len()));
        let into = random.random_range(0..parts.len());
        parts[into].merge(&part);
    }
    parts.remove(0)
}

fn rebuilt(sums: &ExactSums, count: u64) -> Option<ExactSums> {
    let (high, low, bins) = sums.parts();
    ExactSums::from_parts(high.to_vec(), low.to_vec(), &bins.collect::<Vec<_>>(), count)
}

#[test]
fn no_order_and_no_grouping_changes_a_bit() {
    let mut random = SmallRng::seed_from_u64(1);
    for _ in 0..20_000 {
        let mut values = values(&mut random);
        let whole = sum(&values);
        values.shuffle(&mut random);
        assert_eq!(sum(&values), whole);
        let size = random.random_range(1..=values.len());
        let parts: Vec<_> = values.chunks(size).map(sum).chain([ExactSums::new(2)]).collect();
        assert_eq!(joined(parts, &mut random), whole);
        assert_eq!(rebuilt(&whole, values.len() as u64), Some(whole));
    }
}

#[test]
fn sums_agree_with_f64_at_every_magnitude() {
    let mut random = SmallRng::seed_from_u64(2);
    for _ in 0..20_000 {
        let values = values(&mut random);
        let largest = values.iter().copied().fold(0.0, f64::max);
        let bound = |largest: f64| 1.01 * values.len() as f64 * 2f64.powi(-40) * largest;
        let sums = sum(&values);
        assert!((sums.value(0) - values.iter().sum::<f64>()).abs() <= bound(largest));
        assert!((sums.value(1) - values.iter().map(|x| x * x).sum::<f64>()).abs() <= bound(largest * largest));
    }
}

#[test]
fn runs_of_sums_are_those_of_each_alone() {
    let mut random = SmallRng::seed_from_u64(3);
    let lists: Vec<Vec<f64>> = (0..37).map(|_| values(&mut random)).collect();
    let longest = lists.iter().map(Vec::len).max().unwrap_or_default();
    let mut sums = ExactSums::new(40);
    for n in 0..longest {
        let of_lists: Vec<f64> = lists.iter().map(|list| list.get(n).copied().unwrap_or_default()).collect();
        sums.add(3, &of_lists);
    }
    assert_eq!(sums.values(0..3).collect::<Vec<_>>(), [0.0; 3]);
    assert!(sums.values(3..40).eq(lists.iter().map(|list| of_one(list))));
}

#[test]
fn single_values_come_back() {
    for x in [0.0, f32::from_bits(1), f32::MIN_POSITIVE, 1e-38, 0.1, 1.0, 3.0e7, 1e38, f32::MAX].map(f64::from) {
        let sums = sum(&[x]);
        assert_eq!(sums.value(0), x);
        assert!((sums.value(1) - x * x).abs() <= 2f64.powi(-40) * x * x, "{x:e}");
    }
}

#[test]
fn equal_values_have_their_exact_sum() {
    let x = f64::from(0.1f32);
    assert_eq!(of_one(&vec![x; 100_000]), 100_000.0 * x);
}

#[test]
fn small_values_count_beside_a_large_one_down_to_two_to_the_minus_forty() {
    let values = [vec![1.0], vec![2f64.powi(-40); 1000], vec![2f64.powi(-42); 1000]].concat();
    assert_eq!(of_one(&values), 1.0 + 1000.0 * 2f64.powi(-40));
}

#[test]
fn as_many_values_as_are_allowed_do_not_overflow() {
    // Just below the limit of a bin, with the largest possible multiple of the bin below.
    let value = 2f64.powi(39) - 0.5;
    let mut sums = ExactSums::new(1);
    sums.add(0, &[value]);
    for _ in 0..23 {
        let half = sums.clone();
        sums.merge(&half);
    }
    assert_eq!(sums.value(0), value * f64::from(MOST_VALUES));
    assert!(rebuilt(&sums, MOST_VALUES.into()).is_some() && rebuilt(&sums, 1).is_none());
}

#[test]
fn impossible_sums_are_refused() {
    let of = |high: i64, low: i64, bin: u16| ExactSums::from_parts(vec![high], vec![low], &[bin as u8], 1);
    let most = 1 << 39;
    assert!(of(most, -most, BINS - 1).is_some());
    assert!(of(most + 1, 0, 0).is_none() && of(-1, 0, 0).is_none());
    assert!(of(0, most + 1, 0).is_none() && of(0, i64::MIN, 0).is_none());
    assert!(of(0, 0, BINS).is_none());
    assert!(ExactSums::from_parts(vec![0], vec![0, 0], &[0], 1).is_none());
}

#[test]
fn a_quick_value_is_the_value_but_for_rounding() {
    let mut random = SmallRng::seed_from_u64(9);
    for _ in 0..200 {
        let sums = sum(&values(&mut random));
        for i in 0..2 {
            let (exact, quick) = (sums.value(i), sums.quick_value(i));
            assert!((quick - exact).abs() <= 4.0 * f64::EPSILON * exact, "{quick} {exact}");
        }
    }
}
