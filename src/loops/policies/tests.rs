use super::*;
use crate::{FrameLimits, Pacer, RefreshRate, Steps, TimeBase};

/// Returns a loop on a display of 60 Hz with 60 ticks a second.
fn pacer(id: &str) -> Pacer {
    let base = TimeBase::new(60, RefreshRate::new(60, 1));
    Pacer::new(policy(id).unwrap(), base)
}

/// Returns a tick or a refresh in the unit of time, divided by 100.
fn hundredth(pacer: &Pacer) -> i128 {
    pacer.base().tick() / 100
}

/// Returns the steps of frames with these durations in hundredths of a tick of 16 ms.
fn frames(pacer: &mut Pacer, hundredths: impl IntoIterator<Item = i64>) -> Vec<Steps> {
    let frame = |hundredths: i64| pacer.frame(hundredths * 160_000);
    hundredths.into_iter().map(frame).collect()
}

/// Returns a loop whose tick and refresh last 16 ms, so that a hundredth is a whole number of nanoseconds.
fn even(id: &str) -> Pacer {
    let base =
        TimeBase::new("62.5".parse::<crate::sim::TickRate>().unwrap(), RefreshRate::new(125, 2));
    Pacer::new(policy(id).unwrap(), base)
}

fn counts(steps: &[Steps]) -> Vec<u32> {
    steps.iter().map(|steps| steps.count).collect()
}

#[test]
fn usual_and_opening_loops_have_a_digit_key() {
    let digits = 10;
    let usual = POLICIES.iter().enumerate().filter(|(_, card)| card.is_usual);
    let count = usual.clone().filter(|(index, _)| *index < digits).count();
    assert_eq!(count, usual.count());
    assert!(POLICIES.len() > digits && count >= 5, "{count}");
}

#[test]
fn times_of_lines_are_whole_and_exact_at_any_usual_rate() {
    for tick_hz in ["60", "50", "64", "30", "144", "59.94"] {
        for refresh in [
            RefreshRate::new(60, 1),
            RefreshRate::new(2997, 50),
            RefreshRate::of_period(16_666_667),
        ] {
            let base = TimeBase::new(tick_hz.parse::<crate::sim::TickRate>().unwrap(), refresh);
            let mut pacer = Pacer::new(policy("variable").unwrap(), base);
            let mut fixed = Pacer::new(policy("whole-refresh").unwrap(), base);
            for ns in [1, 16_666_667, 999_999_999, 10_000_000_001, 44_999_999_999] {
                assert_eq!(pacer.frame(ns).span, base.nanoseconds(ns), "{tick_hz} {refresh}: {ns}");
                let Steps { count, span, dropped, .. } = fixed.frame(ns);
                assert_eq!(span, i128::from(count) * base.tick());
                assert_eq!(dropped % base.tick(), 0, "{tick_hz} {refresh}: {ns}");
                assert!((0.0..1.0).contains(&fixed.alpha()));
            }
        }
    }
}

#[test]
fn limits_take_the_place_of_the_constants_of_the_lines() {
    let base = TimeBase::new(60, RefreshRate::new(60, 1));
    let made = |id: &str, limits| {
        Pacer::limited(policy(id).unwrap(), base, limits).frame(1_000_000_000).count
    };
    let limits = FrameLimits::default;
    assert_eq!(made("fixed", limits()), 15);
    assert_eq!(made("fixed", FrameLimits { max_ticks: Some(20), ..limits() }), 20);
    assert_eq!(made("fixed", FrameLimits { max_frame_ms: Some(500), ..limits() }), 30);
    let clamp = Some(crate::LongFrame::Clamp(2_000_000_000));
    assert_eq!(made("fixed", FrameLimits { long_frame: clamp, ..limits() }), 60);
    assert_eq!(made("hysteresis", FrameLimits { max_ticks: Some(3), ..limits() }), 3);
    assert_eq!(made("semi-fixed", FrameLimits { max_ticks: Some(4), ..limits() }), 4);
}

#[test]
fn noise_at_the_edge_of_a_tick_repeats_and_doubles_no_frame() {
    let noise = (0..1000).map(|i| 100 + [-3, 5, -2, 3, -5, 2][i % 6]);
    let made = counts(&frames(&mut even("hysteresis"), noise.clone()));
    assert!(made[1..].iter().all(|&count| count == 1), "{made:?}");
    // Without hysteresis, ticks flip between none and two.
    let made = counts(&frames(&mut even("fixed"), noise));
    assert!(made.iter().filter(|&&count| count == 0).count() > 100);
}

#[test]
fn a_tick_of_drift_is_corrected_in_one_frame() {
    let made = counts(&frames(&mut even("hysteresis"), [99; 1000]));
    assert_eq!(made.iter().filter(|&&count| count == 0).count(), 10);
    let made = counts(&frames(&mut even("hysteresis"), [101; 1000]));
    assert_eq!(made.iter().filter(|&&count| count == 2).count(), 10);
    assert_eq!(made.iter().filter(|&&count| count == 1).count(), 990);
}

#[test]
fn another_rate_becomes_typical() {
    for (hundredths, known) in [(200, vec![2]), (50, vec![0, 1]), (40, vec![0, 1])] {
        let mut pacer = even("hysteresis");
        let made = frames(&mut pacer, vec![100; 50].into_iter().chain(vec![hundredths; 1000]));
        let made = counts(&made);
        let (settled, total) = (&made[100..], made.iter().sum::<u32>());
        assert!(settled.iter().all(|count| known.contains(count)), "{hundredths} %");
        assert!(total.abs_diff(50 + 10 * hundredths as u32) <= 1, "{hundredths} %: {total}");
        assert!((-0.5..1.5).contains(&pacer.alpha()), "{}", pacer.alpha());
    }
}

#[test]
fn a_hitch_is_caught_up_by_at_most_eight_ticks() {
    for (hundredths, hitch) in [(700, [6, 2]), (60_000, [8, 2])] {
        let durations = [100; 20].into_iter().chain([hundredths]).chain([100; 20]);
        let made = counts(&frames(&mut even("hysteresis"), durations));
        assert_eq!(made[20..22], hitch);
        assert!(made[..20].iter().chain(&made[22..]).all(|&count| count == 1));
    }
}

#[test]
fn noise_is_smoothed_sixteenfold() {
    let mut pacer = even("median");
    let (refresh, unit) = (pacer.base().refresh(), hundredth(&pacer));
    let noise = (0..1000).map(|i| if i % 2 == 0 { 106 } else { 94 });
    for (n, steps) in frames(&mut pacer, noise).iter().enumerate() {
        // At most four of the seven kept durations are late, so the mean noise is at most 6/7.
        assert!((steps.span - refresh).abs() < 2 * unit, "frame {n}: {}", steps.span / unit);
    }
}

#[test]
fn a_hitch_is_paid_back_and_a_new_rate_is_adopted() {
    let mut pacer = even("median");
    let (refresh, unit) = (pacer.base().refresh(), hundredth(&pacer));
    let spans: Vec<i128> = frames(&mut pacer, [1100, 100]).iter().map(|steps| steps.span).collect();
    assert_eq!(spans, [refresh, refresh + 1000 * unit / 16]);
    frames(&mut pacer, [100; 200]);
    assert!(pacer.owed().abs() < unit, "{} % of a refresh", pacer.owed() / unit);
    let last = frames(&mut pacer, [200; 200])[199].span;
    assert!(pacer.owed().abs() < unit && (last - 2 * refresh).abs() < unit);
}

#[test]
fn no_step_is_negative_and_the_debt_is_bounded() {
    let mut pacer = even("median");
    let bound = 16 * 60_000 * hundredth(&pacer);
    for i in 0..10_000 {
        let hundredths = match i % 29 {
            0 => 60_000,
            1..=20 => 0,
            _ => 100,
        };
        assert!(frames(&mut pacer, [hundredths])[0].span >= 0);
        assert!(pacer.owed().abs() < bound, "frame {i}: {}", pacer.owed());
    }
}

#[test]
fn a_duration_near_one_to_eight_refreshes_is_rounded() {
    let base = TimeBase::new(60, RefreshRate::new(100, 1));
    for (given, made) in [
        (9.81, 10.0),
        (10.19, 10.0),
        (19.9, 20.0),
        (80.1, 80.0),
        (0.0, 0.0),
        (0.1, 0.1),
        (9.8, 9.8),
        (10.2, 10.2),
        (15.0, 15.0),
        (90.0, 90.0),
        (90.1, 90.1),
    ] {
        let ns = |ms: f64| (ms * 1e6).round() as i64;
        let mut pacer = Pacer::new(policy("snapped").unwrap(), base);
        // The mean of the frame and of three refreshes before it.
        let mut since = base.nanoseconds(ns(made)) + 3 * base.refresh();
        let steps = pacer.frame(ns(given));
        since = since / 4 - steps.span;
        assert_eq!((pacer.alpha() * base.tick() as f64).round() as i128, since, "{given} ms");
    }
}

#[test]
fn the_mean_loses_no_time() {
    let mut pacer = pacer("snapped");
    let (mut given, refresh) = (0, pacer.base().refresh());
    for i in 0..1000 {
        // No duration is near a refresh.
        let ns = 1_000_000 + i * i % 777;
        given += pacer.base().nanoseconds(ns);
        pacer.frame(ns);
    }
    for _ in 0..3 {
        pacer.frame(0);
    }
    // The initial refreshes count with 3, 2 and 1 quarters.
    let since = (pacer.alpha() * pacer.base().tick() as f64).round() as i128;
    let left = given + refresh * 6 / 4 - pacer.simulated() - since;
    assert!((0..4).contains(&left), "{left}");
}

#[test]
fn a_debt_over_eight_ticks_is_dropped_entirely() {
    let mut pacer = even("snapped");
    let tick = pacer.base().tick();
    let mut dropped = 0;
    frames(&mut pacer, [125]);
    for steps in frames(&mut pacer, [800; 4]) {
        dropped += steps.dropped;
    }
    // The last frame owed a part of a tick, then eight more.
    assert_eq!(pacer.alpha(), 0.0);
    assert!(dropped > 8 * tick && dropped < 9 * tick);
    assert_eq!(frames(&mut pacer, [801])[0].dropped, 801 * tick / 100 - tick);
}

/// Returns the refreshes that frames of these hundredths of a refresh count as.
fn refreshes(hundredths: impl IntoIterator<Item = i64>) -> Vec<i128> {
    let mut pacer = even("whole-refresh");
    frames(&mut pacer, hundredths).iter().map(|steps| steps.count.into()).collect()
}

#[test]
fn a_frame_counts_as_the_nearest_refreshes_and_at_least_one() {
    assert_eq!(refreshes([100, 97, 104, 99, 240, 60, 100]), [1, 1, 1, 1, 2, 1, 1]);
    assert_eq!(refreshes([60, 60, 60, 60]), [1, 1, 1, 0]);
}

#[test]
fn frames_that_do_not_wait_for_the_display_make_the_game_no_faster() {
    for hundredths in [1, 10, 37, 50, 90] {
        let frames = 10_000;
        let count: i128 = refreshes(vec![hundredths; frames]).iter().sum();
        let ahead = count * 100 - i128::from(hundredths) * frames as i128;
        assert!((0..=150).contains(&ahead), "{hundredths} %: {ahead} % of a refresh ahead");
    }
}
