use std::collections::BTreeSet;

use super::*;
use crate::trace::Frame;

const HZ_60: RefreshRate = RefreshRate::new(60, 1);
const REFRESH_NS: i64 = 16_666_667;

fn first(id: &str, refresh: RefreshRate, count: usize, steps: u32) -> Vec<Frame> {
    let trace = trace_card(id).expect("in the table").trace(refresh);
    let mut frames = trace.frames();
    (0..count).map(|_| frames.next(steps).expect("without end")).collect()
}

fn durations(frames: &[Frame]) -> Vec<i64> {
    frames.windows(2).map(|pair| pair[1].began_ns - pair[0].began_ns).collect()
}

/// Returns the index and the duration of each frame that does not last one refresh of 60 Hz.
fn odd_durations(frames: &[Frame]) -> Vec<(usize, i64)> {
    let long = durations(frames).into_iter().enumerate();
    long.filter(|&(_, ns)| (ns - REFRESH_NS).abs() > 1).collect()
}

#[test]
fn ids_are_unique_and_fit_to_be_typed() {
    let ids: BTreeSet<&str> = TRACES.iter().map(|card| card.id).collect();
    assert_eq!(ids.len(), TRACES.len());
    for id in ids {
        let fits = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "-.".contains(c);
        assert!(id.chars().all(fits), "{id}");
    }
}

#[test]
fn every_trace_starts_at_zero_and_advances_at_every_rate() {
    for card in TRACES {
        for rate in [RefreshRate::new(1, 1), HZ_60, RefreshRate::new(1000, 1)] {
            for steps in [0, 1, 40] {
                let frames = first(card.id, rate, 2000, steps);
                assert_eq!(frames[0].began_ns, 0, "{}", card.id);
                assert!(frames.windows(2).all(|pair| pair[0].began_ns < pair[1].began_ns));
                let shown: Vec<_> = frames.iter().filter_map(|f| f.displayed_ns).collect();
                assert!(shown.is_sorted_by(|a, b| a < b), "{} at {rate} Hz", card.id);
                assert_eq!(frames, first(card.id, rate, 2000, steps), "{}", card.id);
            }
        }
    }
}

#[test]
fn only_edge_and_heartbeat_display_a_frame_before_its_start() {
    for card in TRACES {
        let frames = first(card.id, HZ_60, 2000, 1);
        let early = frames.iter().any(|f| f.displayed_ns.is_some_and(|at| at < f.began_ns));
        assert_eq!(early, ["edge", "heartbeat"].contains(&card.id), "{}", card.id);
    }
}

#[test]
fn cards_name_the_seeds() {
    for (id, seed) in [("edge", EDGE_SEED), ("jitter", JITTER_SEED)] {
        assert!(trace_card(id).unwrap().about.contains(&format!("seed {seed})")), "{id}");
    }
}

#[test]
fn the_edge_is_half_a_millisecond_wide_on_both_sides() {
    let frames = first("edge", HZ_60, 10_000, 0);
    let off: Vec<i64> = frames.iter().map(|f| f.began_ns - f.displayed_ns.unwrap()).collect();
    assert_eq!(off[0], 0);
    let (least, most) = (*off.iter().min().unwrap(), *off.iter().max().unwrap());
    assert!((-499_999..-499_000).contains(&least), "{least}");
    assert!((499_001..=499_999).contains(&most), "{most}");
    let mean = off.iter().sum::<i64>() / 10_000;
    assert!(mean.abs() < 10_000, "{mean}");
}

#[test]
fn a_missed_refresh_delays_its_picture_and_the_next_frame() {
    let frames = first("missed-vsync", HZ_60, 100, 0);
    let late: Vec<usize> =
        (0..100).filter(|&n| frames[n].displayed_ns != Some(frames[n].began_ns)).collect();
    assert_eq!(late, [29, 59, 89]);
    let odd = odd_durations(&frames);
    assert_eq!(odd.iter().map(|(n, _)| *n).collect::<Vec<_>>(), late);
    for (n, ns) in odd {
        assert!((ns - 2 * REFRESH_NS).abs() <= 1);
        assert!((frames[n].displayed_ns.unwrap() - frames[n].began_ns - REFRESH_NS).abs() <= 1);
    }
}

#[test]
fn long_frames_last_as_long_as_named() {
    assert_eq!(
        odd_durations(&first("hitch-100ms", HZ_60, 300, 0)),
        [(120, 100_000_000), (241, 100_000_000)]
    );
    assert_eq!(
        odd_durations(&first("alt-tab-5s", HZ_60, 700, 0)),
        [(300, 5_000_000_000), (601, 5_000_000_000)]
    );
}

#[test]
fn a_heartbeat_alternates_long_and_short_frames_displayed_evenly() {
    let frames = first("heartbeat", HZ_60, 100, 0);
    for (n, ns) in durations(&frames).into_iter().enumerate() {
        let quarters = if n % 2 == 0 { 5 } else { 3 };
        assert!((ns - quarters * REFRESH_NS / 4).abs() <= 2, "frame {n}: {ns}");
        assert_eq!(frames[n].displayed_ns, Some(HZ_60.refresh_ns(n as u64)));
    }
}

#[test]
fn a_spiral_frame_lasts_as_long_as_the_steps_before_it() {
    assert!(odd_durations(&first("spiral", HZ_60, 100, 0)).is_empty());
    for steps in [1, 15] {
        let expected = 20_800_000 * i64::from(steps);
        assert!(durations(&first("spiral", HZ_60, 100, steps)).iter().all(|&ns| ns == expected));
    }
}

#[test]
fn jitter_misses_some_refreshes_and_runs_ahead_by_at_most_one_frame() {
    let frames = first("jitter", HZ_60, 10_000, 0);
    let waits = frames.iter().map(|f| f.displayed_ns.unwrap() - f.began_ns);
    assert!(waits.clone().all(|ns| ns > REFRESH_NS / 2 && ns < 4 * REFRESH_NS + 2));
    let shown: Vec<i64> = frames.iter().map(|f| f.displayed_ns.unwrap()).collect();
    let missed = shown.windows(2).filter(|pair| pair[1] - pair[0] > REFRESH_NS + 1).count();
    assert!((30..80).contains(&missed), "{missed}");
}

#[test]
fn the_generator_is_splitmix64() {
    let mut noise = Noise::new(1_234_567);
    let known = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973];
    assert_eq!([noise.bits(), noise.bits()], known);
}

#[test]
fn numbers_cover_their_range_evenly() {
    let (mut noise, mut counts) = (Noise::new(1), [0; 5]);
    for _ in 0..5000 {
        counts[noise.up_to(4) as usize] += 1;
    }
    assert!(counts.iter().all(|count| (900..1100).contains(count)), "{counts:?}");
}
