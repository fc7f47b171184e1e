//! How a person zooms and pans a body's part of the stage.

/// The least and the greatest zoom: from a body that has left the frame far behind, to its last pixels.
pub const ZOOMS: (f64, f64) = (1.0 / 8.0, 64.0);

/// How far the middle of the view may be from the middle of the fitted frame, in frames: as far as shows at the least
/// zoom, so that whatever can be seen can be zoomed in on.
const FARTHEST: f64 = 4.5;

/// A zoom and a pan over the frame that the camera fits. It is in parts of the frame, so that it holds at every size of
/// the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// How many times larger than fitted, within [`ZOOMS`].
    zoom: f64,
    /// What is seen in the middle: across and down from the middle of the fitted frame, in its widths and heights.
    centre: [f64; 2],
}

impl Default for Lens {
    /// The whole frame, as the camera fits it.
    fn default() -> Self {
        Self { zoom: 1.0, centre: [0.0; 2] }
    }
}

impl Lens {
    /// How many times larger than fitted.
    pub fn zoom(&self) -> f64 {
        self.zoom
    }

    /// Where a place of the fitted frame is seen. Both are across and down from the middle, in widths and heights.
    pub fn seen(&self, place: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.zoom * (place[i] - self.centre[i]))
    }

    /// The lens that zooms `times` further in, with what is seen at `about` kept there.
    pub fn zoomed(self, times: f64, about: [f64; 2]) -> Self {
        let zoom = (self.zoom * times).clamp(ZOOMS.0, ZOOMS.1);
        let centre = [0, 1].map(|i| self.centre[i] + about[i] / self.zoom - about[i] / zoom);
        Self { zoom, centre: centre.map(within_reach) }
    }

    /// The lens that moves what is seen by so many widths and heights.
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
    fn what_is_under_the_pointer_stays_there_while_zooming() {
        let mut lens = Lens::default().panned([0.2, -0.1]);
        for (times, about) in [(1.3, [0.3, -0.4]), (5.0, [-0.5, 0.5]), (0.1, [0.1, 0.2])] {
            let place = [0, 1].map(|i| lens.centre[i] + about[i] / lens.zoom);
            lens = lens.zoomed(times, about);
            for (seen, about) in lens.seen(place).into_iter().zip(about) {
                assert!((seen - about).abs() < 1e-12, "{times} about {about}: {seen}");
            }
        }
    }

    #[test]
    fn a_pan_moves_what_is_seen_by_as_much_at_every_zoom() {
        for times in [0.2, 1.0, 30.0] {
            let lens = Lens::default().zoomed(times, [0.1, 0.3]);
            let (before, after) = (lens.seen([0.0; 2]), lens.panned([0.25, -0.125]).seen([0.0; 2]));
            assert!((after[0] - before[0] - 0.25).abs() < 1e-12);
            assert!((after[1] - before[1] + 0.125).abs() < 1e-12);
        }
    }

    #[test]
    fn zoom_and_pan_have_bounds() {
        let about = [0.4, 0.4];
        assert_eq!(Lens::default().zoomed(1e9, about).zoom(), 64.0);
        assert_eq!(Lens::default().zoomed(1e-9, about).zoom(), 0.125);
        let far = Lens::default().panned([-100.0, 100.0]);
        assert_eq!(far.seen([FARTHEST, -FARTHEST]), [0.0; 2]);
        let there_and_back = Lens::default().zoomed(2.0, about).zoomed(0.5, about);
        assert_eq!(there_and_back, Lens::default());
    }
}
