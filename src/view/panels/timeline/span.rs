//! The part of a run's time that the timeline shows, its mapping to a track, and its zoom.

use egui::Rangef;

/// Room ahead of a run that is longer than its scene, relative to the time since the scene's end.
const AHEAD: f64 = 0.1;
/// Place of the present after the view has moved to follow it, relative to the view's length.
const FOLLOWED_AT: f64 = 0.8;

/// A range of time, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::panels) struct Span {
    pub(in crate::panels) from_s: f64,
    pub(in crate::panels) to_s: f64,
}

impl Span {
    /// Creates the view of a whole run that ends at `end_s`. The view reaches to the end of the scene, or beyond that
    /// with some room ahead.
    pub(in crate::panels) fn whole(scene_s: f64, end_s: f64) -> Self {
        Self { from_s: 0.0, to_s: scene_s.max(end_s + AHEAD * (end_s - scene_s)) }
    }

    pub(in crate::panels) fn length_s(self) -> f64 {
        self.to_s - self.from_s
    }

    /// Returns the x of time `t` on a track.
    pub(in crate::panels) fn x(self, t: f64, track: Rangef) -> f32 {
        track.min + ((t - self.from_s) / self.length_s()) as f32 * track.span()
    }

    /// Returns the time at `x` on a track.
    pub(in crate::panels) fn t(self, x: f32, track: Rangef) -> f64 {
        self.from_s + f64::from((x - track.min) / track.span()) * self.length_s()
    }

    /// Returns the view enlarged by `factor`, with `about_s` at the same place. The view is at least `min_s` long and
    /// stays within `whole`.
    pub(in crate::panels) fn zoomed(
        self,
        about_s: f64,
        factor: f64,
        min_s: f64,
        whole: Self,
    ) -> Self {
        let length_s = (self.length_s() / factor).max(min_s).min(whole.length_s());
        let part = (about_s - self.from_s) / self.length_s();
        let from_s = about_s - part * length_s;
        Self { from_s, to_s: from_s + length_s }.within(whole)
    }

    /// Returns the view of the same length `by_s` later, but within `whole`.
    pub(in crate::panels) fn moved(self, by_s: f64, whole: Self) -> Self {
        Self { from_s: self.from_s + by_s, to_s: self.to_s + by_s }.within(whole)
    }

    /// Returns the view, moved so that it shows `now_s` if it does not yet.
    pub(in crate::panels) fn following(self, now_s: f64, whole: Self) -> Self {
        if (self.from_s..=self.to_s).contains(&now_s) {
            return self;
        }
        self.moved(now_s - self.from_s - FOLLOWED_AT * self.length_s(), whole)
    }

    fn within(self, whole: Self) -> Self {
        let length_s = self.length_s().min(whole.length_s());
        let from_s = self.from_s.clamp(whole.from_s, whole.to_s - length_s);
        Self { from_s, to_s: from_s + length_s }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRACK: Rangef = Rangef { min: 100.0, max: 900.0 };
    const WHOLE: Span = Span { from_s: 0.0, to_s: 20.0 };

    fn assert_near(span: Span, from_s: f64, to_s: f64) {
        let off = (span.from_s - from_s).abs().max((span.to_s - to_s).abs());
        assert!(off < 1e-9, "{span:?}, not {from_s} to {to_s}");
    }

    #[test]
    fn the_full_span_covers_the_scene_and_leaves_room_for_a_longer_run() {
        assert_eq!(Span::whole(20.0, 3.0), WHOLE);
        assert_eq!(Span::whole(20.0, 19.9), WHOLE, "its end stays in its place to the last");
        assert_near(Span::whole(20.0, 100.0), 0.0, 108.0);
    }

    #[test]
    fn a_position_on_the_track_converts_to_its_time_and_back() {
        let span = Span { from_s: 4.0, to_s: 8.0 };
        assert_eq!((span.x(4.0, TRACK), span.x(7.0, TRACK)), (100.0, 700.0));
        for x in [100.0, 333.0, 900.0] {
            assert!((span.x(span.t(x, TRACK), TRACK) - x).abs() < 1e-3);
        }
    }

    #[test]
    fn zooming_keeps_the_time_under_the_pointer_in_its_place() {
        let mut span = WHOLE;
        for _ in 0..5 {
            span = span.zoomed(7.0, 1.3, 0.01, WHOLE);
            assert!((span.x(7.0, TRACK) - WHOLE.x(7.0, TRACK)).abs() < 1e-2, "{span:?}");
        }
        assert!(span.length_s() < 20.0 / 3.0);
    }

    #[test]
    fn zooming_stops_at_the_full_and_at_the_smallest_span() {
        assert_near(WHOLE.zoomed(20.0, 1e9, 0.5, WHOLE), 19.5, 20.0);
        assert_near(Span { from_s: 3.0, to_s: 5.0 }.zoomed(5.0, 1e-9, 0.5, WHOLE), 0.0, 20.0);
        assert_near(Span { from_s: 0.0, to_s: 4.0 }.zoomed(4.0, 0.5, 0.5, WHOLE), 0.0, 8.0);
    }

    #[test]
    fn a_span_stays_within_the_run_and_follows_the_present() {
        let span = Span { from_s: 4.0, to_s: 8.0 };
        assert_near(span.moved(1.0, WHOLE), 5.0, 9.0);
        assert_near(span.moved(-9.0, WHOLE), 0.0, 4.0);
        assert_near(span.moved(99.0, WHOLE), 16.0, 20.0);
        assert_eq!(span.following(7.9, WHOLE), span);
        assert_near(span.following(10.0, WHOLE), 6.8, 10.8);
        assert_near(span.following(1.0, WHOLE), 0.0, 4.0);
    }
}
