//! The effect of every game loop in the table on time: over a day, with odd frames, and on the motion of an even
//! display.

use rayon::prelude::*;
use regatta::loops::{POLICIES, Pacer, RefreshRate, TimeBase, policy};

/// The ticks per second in all tests.
const TICK_HZ: u32 = 60;
const SECOND_NS: i64 = 1_000_000_000;

/// Uniform noise that is the same in every run (Marsaglia's xorshift).
struct Noise(u64);

impl Noise {
    fn new() -> Self {
        Self(0x9E37_79B9_7F4A_7C15)
    }

    /// A whole number from `-most` to `most`.
    fn within(&mut self, most: i64) -> i64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        ((self.0 >> 32) % (2 * most as u64 + 1)) as i64 - most
    }
}

/// The expected effect of a loop on time, at 60 ticks and frames per second. Times are in ticks.
struct Expected {
    id: &'static str,
    /// The time of frames that is neither simulated nor given up, at the least and most in a day of frames; `None` for a
    /// loop that does not look at the time.
    owed: Option<[f64; 2]>,
    /// The steps of a hundred frames of no time after a second, and the time simulated in them.
    none: (u32, f64),
    /// The steps of a frame of 10 s after a second, the time simulated in it, and the time given up.
    ten_s: (u32, f64, f64),
}

const fn expected(
    id: &'static str,
    owed: Option<[f64; 2]>,
    none: (u32, f64),
    ten_s: (u32, f64, f64),
) -> Expected {
    Expected { id, owed, none, ten_s }
}

const EXPECTED: &[Expected] = &[
    expected("variable", Some([0.0, 0.0]), (0, 0.0), (1, 600.0, 0.0)),
    expected("lockstep", None, (100, 100.0), (1, 1.0, 0.0)),
    expected("clamped-variable", Some([0.0, 0.0]), (0, 0.0), (1, 2.0, 598.0)),
    expected("semi-fixed", Some([0.0, 0.0]), (0, 0.0), (6, 600.0, 0.0)),
    expected("fixed", Some([0.0, 1.0]), (0, 0.0), (15, 15.0, 585.0)),
    expected("fixed-linear", Some([0.0, 1.0]), (0, 0.0), (15, 15.0, 585.0)),
    expected("fixed-hermite", Some([0.0, 1.0]), (0, 0.0), (15, 15.0, 585.0)),
    expected("fixed-extrapolated", Some([0.0, 1.0]), (0, 0.0), (15, 15.0, 585.0)),
    expected("render-tick", Some([0.0, 1.0]), (0, 0.0), (15, 15.0, 585.0)),
    expected("whole-refresh", Some([-0.02, 1.02]), (1, 1.0), (15, 15.0, 585.0)),
    expected("snapped", Some([-0.02, 1.02]), (1, 1.0), (1, 1.0, 599.0)),
    expected("hysteresis", Some([-0.5, 1.5]), (0, 0.0), (8, 8.0, 591.0)),
    expected("median", Some([-0.1, 0.1]), (9, 5.142), (1, 1.0, 0.0)),
    expected("slow-down", Some([0.0, 1.0]), (0, 0.0), (1, 1.0, 598.0)),
];

fn rate(numerator: u32, denominator: u32) -> RefreshRate {
    RefreshRate::new(numerator, denominator)
}

/// The loop with this id before its first frame.
fn pacer(id: &str, refresh: RefreshRate) -> Pacer {
    Pacer::new(policy(id).unwrap(), TimeBase::new(TICK_HZ, refresh))
}

fn in_ticks(pacer: &Pacer, time: i128) -> f64 {
    time as f64 / pacer.base().tick() as f64
}

/// The loop after a second of frames at 60 Hz.
fn after_a_second(id: &str) -> Pacer {
    let refresh = rate(60, 1);
    let mut pacer = pacer(id, refresh);
    for n in 0..60 {
        pacer.frame(refresh.refresh_ns(n + 1) - refresh.refresh_ns(n));
    }
    pacer
}

#[test]
fn every_loop_of_the_table_is_tested_here() {
    let here: Vec<_> = EXPECTED.iter().map(|expected| expected.id).collect();
    let table: Vec<_> = POLICIES.iter().map(|card| &*card.id).collect();
    assert_eq!(here, table);
}

#[test]
fn every_card_is_complete_and_its_id_easy_to_type() {
    for card in POLICIES.iter() {
        let kebab = |c: char| c.is_ascii_lowercase() || c == '-';
        assert!(card.id.chars().all(kebab), "{}", card.id);
        for text in [&card.name, &card.formula, &card.odd_frames, &card.users, &card.source] {
            assert!(!text.is_empty(), "{}", card.id);
        }
        assert_eq!(POLICIES.iter().filter(|other| *other == card).count(), 1, "{}", card.id);
    }
}

/// Runs a loop for `hours` of frames on a display, each starting within 0.09 ms of a refresh, and checks its debt.
fn no_drift(expected: &Expected, refresh: RefreshRate, hours: f64) {
    let Some([least, most]) = expected.owed else { return };
    let mut pacer = pacer(expected.id, refresh);
    let mut noise = Noise::new();
    let bounds = [least, most].map(|ticks| (ticks * pacer.base().tick() as f64) as i128);
    let mut before = 0;
    for n in 1..=(hours * 3600.0 * refresh.hz()) as u64 {
        let began = refresh.refresh_ns(n) + noise.within(90_000);
        pacer.frame(began - before);
        before = began;
        let owed = pacer.owed();
        let (id, ticks) = (expected.id, in_ticks(&pacer, owed));
        assert!(bounds[0] <= owed && owed <= bounds[1], "{id}, frame {n}: {ticks} ticks owed");
    }
    assert!(pacer.dropped() == 0 || expected.id == "slow-down", "{}", expected.id);
    let passed = pacer.base().nanoseconds(before);
    assert_eq!(pacer.simulated() + pacer.dropped() + pacer.owed(), passed, "{}", expected.id);
}

#[test]
fn no_loop_drifts_in_a_day_of_timer_noise() {
    let rates = [rate(60, 1), rate(2997, 50), rate(144, 1)];
    EXPECTED.par_iter().for_each(|expected| {
        for refresh in rates {
            // A whole day at each rate would take a debug build a minute.
            let hours = if refresh.hz() == 60.0 { 24.0 } else { 1.0 };
            no_drift(expected, refresh, hours);
        }
    });
}

#[test]
fn a_loop_that_ignores_time_drifts_with_the_display() {
    let refresh = rate(2997, 50);
    let mut lockstep = pacer("lockstep", refresh);
    let frames = 24 * 2997 * 72;
    for n in 0..frames {
        lockstep.frame(refresh.refresh_ns(n + 1) - refresh.refresh_ns(n));
    }
    let late_s = lockstep.base().seconds(lockstep.owed());
    assert!((late_s - 86.4).abs() < 1e-6, "{late_s} s in a day");

    // Snapping takes a duration that is a little short for a refresh each time.
    let mut snapped = pacer("snapped", rate(60, 1));
    for _ in 0..60_000 {
        snapped.frame(SECOND_NS / 60 - 150_000);
    }
    let ahead_s = -snapped.base().seconds(snapped.owed());
    assert!((ahead_s - 9.0).abs() < 0.02, "{ahead_s} s ahead in 1000 s");
}

#[test]
fn slow_down_loses_time_to_a_slow_display_but_not_to_timer_noise() {
    let lost = |refresh: RefreshRate, noise_ns| {
        let mut slow = pacer("slow-down", refresh);
        let (mut noise, mut before) = (Noise::new(), 0);
        for n in 1..=200_000 {
            let began = refresh.refresh_ns(n) + noise.within(noise_ns);
            slow.frame(began - before);
            before = began;
        }
        slow.dropped() as f64 / (slow.dropped() + slow.simulated()) as f64
    };
    near("at 60 Hz", lost(rate(60, 1), 0), 0.0, 0.0);
    near("at 59.94 Hz", lost(rate(2997, 50), 0), 0.001, 1e-5);
    near("at 30 Hz", lost(rate(30, 1), 0), 0.5, 1e-4);
    near("at 60 Hz with noise", lost(rate(60, 1), 90_000), 0.0, 1e-6);
    near("at 144 Hz with noise", lost(rate(144, 1), 90_000), 0.0, 0.0);
}

#[test]
fn frames_of_zero_and_of_ten_seconds_behave_as_on_the_cards() {
    for expected in EXPECTED {
        for nothing in [0, -1, i64::MIN] {
            let mut pacer = after_a_second(expected.id);
            let (mut count, mut span) = (0, 0);
            for _ in 0..100 {
                let steps = pacer.frame(nothing);
                assert_eq!(steps.dropped, 0, "{}", expected.id);
                count += steps.count;
                span += steps.span;
            }
            let (steps, ticks) = expected.none;
            let made = in_ticks(&pacer, span);
            assert!((made - ticks).abs() < 1e-3, "{}: {made} ticks in {count}", expected.id);
            assert_eq!(count, steps, "{}", expected.id);
            assert_eq!(pacer.frame(0).count, u32::from(expected.owed.is_none()));
        }
        let mut pacer = after_a_second(expected.id);
        let steps = pacer.frame(10 * SECOND_NS);
        let (count, span, dropped) = expected.ten_s;
        assert_eq!(steps.count, count, "{}", expected.id);
        let made = [steps.span, steps.dropped].map(|time| in_ticks(&pacer, time));
        assert!((made[0] - span).abs() < 1e-3, "{}: {} ticks", expected.id, made[0]);
        assert!((made[1] - dropped).abs() < 1e-3, "{}: {} dropped", expected.id, made[1]);
    }
}

#[test]
fn all_time_is_simulated_dropped_or_owed_for_any_frames() {
    for card in POLICIES.iter() {
        let mut pacer = pacer(&card.id, rate(2997, 50));
        let mut noise = Noise::new();
        let (mut passed, mut simulated, mut dropped) = (0, 0, 0);
        for n in 0..100_000 {
            let duration_ns = match noise.within(500) {
                0 => 10 * SECOND_NS,
                1..20 => 0,
                20..40 => -SECOND_NS,
                40..80 => 300_000_000 + noise.within(250_000_000),
                _ => 16_683_350 + noise.within(2_000_000),
            };
            let steps = pacer.frame(duration_ns);
            passed += pacer.base().nanoseconds(duration_ns.max(0));
            simulated += steps.span;
            dropped += steps.dropped;
            assert!(steps.span >= 0 && steps.dropped >= 0, "{}, frame {n}", card.id);
            assert_eq!(steps.span > 0, steps.count > 0, "{}, frame {n}", card.id);
            if card.has_fixed_tick {
                assert_eq!(steps.span, i128::from(steps.count) * pacer.base().tick());
            }
            assert_eq!([pacer.simulated(), pacer.dropped()], [simulated, dropped], "{}", card.id);
            assert_eq!(pacer.owed(), passed - simulated - dropped, "{}", card.id);
        }
        // The debt of a smoothed step is below sixteen times the longest frame, and snapping wanders.
        let most = match &*card.id {
            "lockstep" => continue,
            "median" => 160.0 * f64::from(TICK_HZ),
            "snapped" => 60.0,
            _ => 2.0,
        };
        let owed = in_ticks(&pacer, pacer.owed());
        assert!(owed.abs() < most, "{}: {owed} ticks owed", card.id);
    }
}

/// The look of the motion, from the shown moments alone.
struct Motion {
    /// The part of the frames that show the same moment as the one before.
    repeated: f64,
    /// The part of the frames that show a moment two ticks later.
    double: f64,
    /// The root of the mean square of the animation error, in milliseconds.
    error_ms: f64,
    /// The mean time from the moment shown to the frame, in ticks.
    latency: f64,
}

/// Runs a loop on an even display; frame n begins at refresh n and as much later as `late_ns` says.
fn motion(id: &str, refresh: RefreshRate, mut late_ns: impl FnMut() -> i64) -> Motion {
    const FRAMES: u64 = 400_000;
    let mut pacer = pacer(id, refresh);
    let [tick, refresh_time] = [pacer.base().tick(), pacer.base().refresh()];
    let (mut repeated, mut double, mut squares, mut latency) = (0, 0, 0.0, 0.0);
    let (mut before_ns, mut before) = (0, pacer.drawn_moment());
    for n in 1..=FRAMES {
        let began_ns = refresh.refresh_ns(n) + late_ns();
        pacer.frame(began_ns - before_ns);
        let shown = pacer.drawn_moment();
        repeated += u64::from(shown == before);
        double += u64::from(shown == before + 2 * tick);
        let error_ms = pacer.base().milliseconds(shown - before - refresh_time);
        squares += error_ms * error_ms;
        latency += in_ticks(&pacer, i128::from(n) * refresh_time - shown);
        (before_ns, before) = (began_ns, shown);
    }
    let frames = FRAMES as f64;
    Motion {
        repeated: repeated as f64 / frames,
        double: double as f64 / frames,
        error_ms: (squares / frames).sqrt(),
        latency: latency / frames,
    }
}

/// Half a millisecond of noise, either way.
fn half_a_ms() -> impl FnMut() -> i64 {
    let mut noise = Noise::new();
    move || noise.within(500_000)
}

/// Rounding to nanoseconds, in milliseconds.
const ROUNDING_MS: f64 = 2e-6;

#[track_caller]
fn near(what: &str, found: f64, known: f64, tolerance: f64) {
    assert!((found - known).abs() <= tolerance, "{what}: {found}, not {known}");
}

#[test]
fn whole_ticks_judder_on_other_displays_and_interpolation_does_not() {
    // The errors in milliseconds follow from the numbers of ticks: with p of the frames repeated, √(p (1 − p)) ticks.
    let known = [
        (rate(2997, 50), 0.0, 0.001, 0.527),
        (rate(75, 1), 0.2, 0.0, 6.67),
        (rate(144, 1), 0.5833, 0.0, 8.22),
        (rate(240, 1), 0.75, 0.0, 7.22),
    ];
    for (refresh, repeated, double, error_ms) in known {
        let what = format!("fixed at {refresh} Hz");
        let fixed = motion("fixed", refresh, || 0);
        near(&what, fixed.repeated, repeated, 0.02 * repeated);
        near(&what, fixed.double, double, 0.02 * double);
        near(&what, fixed.error_ms, error_ms, 0.02 * error_ms);
        let linear = motion("fixed-linear", refresh, || 0);
        near(&what, linear.error_ms, 0.0, ROUNDING_MS);
    }
}

#[test]
fn timer_noise_at_the_edge_of_a_tick_repeats_and_doubles_frames() {
    let refresh = rate(60, 1);
    let fixed = motion("fixed", refresh, half_a_ms());
    near("repeated", fixed.repeated, 0.25, 0.005);
    near("double", fixed.double, 0.25, 0.005);
    near("error", fixed.error_ms, 11.79, 0.02 * 11.79);
    // However small it is.
    let mut noise = Noise::new();
    let least = motion("fixed", refresh, || noise.within(3));
    near("repeated with 3 ns", least.repeated, 0.25, 0.05);

    let hysteresis = motion("hysteresis", refresh, half_a_ms());
    near("hysteresis", hysteresis.repeated + hysteresis.double, 0.0, 1e-5);
}

#[test]
fn interpolation_shows_the_noise_and_whole_refreshes_heal_it() {
    for (refresh, what) in [(rate(60, 1), "60 Hz"), (rate(2997, 50), "59.94 Hz")] {
        let deviation_ms = 0.5 / 3.0_f64.sqrt();
        for id in ["variable", "fixed-linear", "fixed-hermite", "fixed-extrapolated", "render-tick"]
        {
            let known = 2.0_f64.sqrt() * deviation_ms;
            near(id, motion(id, refresh, half_a_ms()).error_ms, known, 0.02 * known);
        }
        near(what, motion("whole-refresh", refresh, half_a_ms()).error_ms, 0.0, 0.0);
        let mut noise = Noise::new();
        let slight = motion("snapped", refresh, || noise.within(90_000));
        near(what, slight.error_ms, 0.0, 0.0);
        let median = motion("median", refresh, half_a_ms()).error_ms;
        assert!(median < 0.15 * deviation_ms, "{what}: {median} ms");
    }
}

#[test]
fn latency_is_half_a_tick_raw_one_interpolated_and_none_extrapolated() {
    // No ratio of small numbers to the ticks, so that a frame begins anywhere in a tick.
    let refresh = RefreshRate::of_period(6_945_347);
    let late = |id| motion(id, refresh, || 0).latency;
    near("fixed", late("fixed"), 0.5, 0.005);
    let drawn = [
        ("fixed-linear", 1.0),
        ("fixed-hermite", 1.0),
        ("fixed-extrapolated", 0.0),
        ("render-tick", 0.0),
    ];
    for (id, ticks) in drawn {
        near(id, late(id), ticks, 1e-6);
    }
}
