//! The zoom and the pan of a body's cell on the stage.

/// Minimum and maximum zoom. The first shows a body that has left the frame far behind, the second the last pixels of a
/// body.
const ZOOMS: (f64, f64) = (1.0 / 8.0, 64.0);

/// Maximum distance of the view's middle from the middle of the fitted frame, relative to the frame. Up to this
/// distance a person can zoom in on everything that is visible at the minimum zoom.
const FARTHEST: f64 = 4.5;

/// Greatest distance of a kept place from the middle of the view, relative to the view.
const KEPT: f64 = 0.45;

/// A zoom and a pan relative to the frame that the camera fits. Their unit is the size of the frame, so that they do
/// not depend on the size of the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZoomPan {
    /// Magnification relative to the fitted frame, within [`ZOOMS`].
    zoom: f64,
    /// Place of the middle of the view, across and down from the middle of the fitted frame, in widths and heights of
    /// the frame.
    centre: [f64; 2],
}

impl Default for ZoomPan {
    /// Creates the view of the whole frame, as the camera fits it.
    fn default() -> Self {
        Self { zoom: 1.0, centre: [0.0; 2] }
    }
}

impl ZoomPan {
    /// Returns the magnification relative to the fitted frame, from 1/8 to 64.
    pub fn zoom(&self) -> f64 {
        self.zoom
    }

    /// Converts a place of the fitted frame to a place in the view. Both are given across and down from the middle, in
    /// widths and heights.
    pub fn place_in_view(&self, place: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.zoom * (place[i] - self.centre[i]))
    }

    /// Zooms in by the factor `times`. The place that is at `about` stays there.
    pub fn zoomed(self, times: f64, about: [f64; 2]) -> Self {
        let zoom = (self.zoom * times).clamp(ZOOMS.0, ZOOMS.1);
        let centre = [0, 1].map(|i| self.centre[i] + about[i] / self.zoom - about[i] / zoom);
        Self { zoom, centre: centre.map(within_reach) }
    }

    /// Pans no further than necessary to keep this place of the fitted frame in view. A place outside the fitted frame
    /// is not kept.
    pub fn keeping(self, place: [f64; 2]) -> Self {
        if self == Self::default() || place.iter().any(|part| part.is_nan() || part.abs() > 0.5) {
            return self;
        }
        let centre = [0, 1].map(|i| {
            let reach = KEPT / self.zoom;
            self.centre[i].clamp(place[i] - reach, place[i] + reach)
        });
        Self { centre, ..self }
    }

    /// Pans by fractions of the frame's width and height.
    pub fn panned(self, by: [f64; 2]) -> Self {
        let centre = [0, 1].map(|i| within_reach(self.centre[i] - by[i] / self.zoom));
        Self { centre, ..self }
    }
}

fn within_reach(centre: f64) -> f64 {
    centre.clamp(-FARTHEST, FARTHEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zooming_keeps_the_point_under_the_pointer() {
        let mut zoom_pan = ZoomPan::default().panned([0.2, -0.1]);
        for (times, about) in [(1.3, [0.3, -0.4]), (5.0, [-0.5, 0.5]), (0.1, [0.1, 0.2])] {
            let place = [0, 1].map(|i| zoom_pan.centre[i] + about[i] / zoom_pan.zoom);
            zoom_pan = zoom_pan.zoomed(times, about);
            for (seen, about) in zoom_pan.place_in_view(place).into_iter().zip(about) {
                assert!((seen - about).abs() < 1e-12, "{times} about {about}: {seen}");
            }
        }
    }

    #[test]
    fn a_pan_moves_the_view_equally_at_every_zoom() {
        for times in [0.2, 1.0, 30.0] {
            let zoom_pan = ZoomPan::default().zoomed(times, [0.1, 0.3]);
            let (before, after) = (
                zoom_pan.place_in_view([0.0; 2]),
                zoom_pan.panned([0.25, -0.125]).place_in_view([0.0; 2]),
            );
            assert!((after[0] - before[0] - 0.25).abs() < 1e-12);
            assert!((after[1] - before[1] + 0.125).abs() < 1e-12);
        }
    }

    #[test]
    fn a_kept_place_stays_in_the_view_of_any_zoom_and_pan() {
        for place in [[0.0, 0.0], [0.3, -0.4], [-0.5, 0.5]] {
            for times in [0.2, 1.0, 3.0, 64.0] {
                for by in [[0.0, 0.0], [0.4, -0.2], [-7.0, 9.0]] {
                    let chosen = ZoomPan::default().zoomed(times, [0.4, -0.4]).panned(by);
                    let kept = chosen.keeping(place);
                    let seen = kept.place_in_view(place);
                    let was = chosen.place_in_view(place);
                    let is_default = chosen == ZoomPan::default();
                    for axis in 0..2 {
                        assert!(
                            is_default || seen[axis].abs() <= KEPT + 1e-9,
                            "{chosen:?}: {seen:?}"
                        );
                        let is_moved = (seen[axis] - was[axis]).abs() > 1e-9;
                        assert_eq!(is_moved, !is_default && was[axis].abs() > KEPT + 1e-9);
                    }
                }
            }
        }
        let chosen = ZoomPan::default().zoomed(4.0, [0.4, 0.4]);
        assert_eq!(chosen.keeping([0.6, 0.0]), chosen, "the fitted frame does not show it");
        assert_eq!(chosen.keeping([f64::NAN, 0.0]), chosen);
    }

    #[test]
    fn zoom_and_pan_have_bounds() {
        let about = [0.4, 0.4];
        assert_eq!(ZoomPan::default().zoomed(1e9, about).zoom(), 64.0);
        assert_eq!(ZoomPan::default().zoomed(1e-9, about).zoom(), 0.125);
        let far = ZoomPan::default().panned([-100.0, 100.0]);
        assert_eq!(far.place_in_view([FARTHEST, -FARTHEST]), [0.0; 2]);
        let there_and_back = ZoomPan::default().zoomed(2.0, about).zoomed(0.5, about);
        assert_eq!(there_and_back, ZoomPan::default());
    }
}
