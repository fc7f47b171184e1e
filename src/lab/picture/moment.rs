//! The moment that is drawn: where every body is between two ticks.

use super::Rgba;
use crate::lab::palette::Palette;
use crate::lab::race::Entrant;
use crate::lab::{History, Lab, LaneBody};

/// The part of a scene's duration that a chart recorder's paper holds: three swings of the harbour's
/// 1 Hz spring, and no more of a faster one than can be told apart.
const PAPER: f64 = 0.15;
/// The most that the paper holds, in seconds.
const LONGEST_PAPER_S: f64 = 3.0;

/// The moment that is drawn.
pub(super) struct Moment<'a> {
    pub(super) lab: &'a Lab,
    pub(super) palette: &'static Palette,
    /// How far the moment is from the previous tick to the present one.
    pub(super) alpha: f64,
    /// The last tick's length in seconds.
    h: f64,
    /// The moment in seconds.
    pub(super) t: f64,
    /// The moment at which lanes are drawn, in seconds: without interpolation the present tick.
    pub(super) lanes_t: f64,
    /// How far a chart recorder's trail reaches back, in seconds.
    pub(super) paper_s: f64,
}

impl<'a> Moment<'a> {
    pub(super) fn of(lab: &'a Lab) -> Self {
        let race = lab.race();
        let (alpha, h) = (lab.clock().alpha(), race.last_step_s());
        let t = race.t() - (1.0 - alpha) * h;
        Self {
            lab,
            palette: lab.display().theme.palette(),
            alpha,
            h,
            t,
            lanes_t: race.t() + h * lab.display().interpolation.shown(alpha),
            paper_s: (PAPER * lab.scene().seconds).min(LONGEST_PAPER_S),
        }
    }

    /// The colour and the dash pattern of the lane on this place of the list.
    pub(super) fn style(&self, entry: usize) -> (Rgba, [f32; 2]) {
        let lanes = self.lab.entries();
        self.lab.display().theme.lane_style(lanes, &lanes[entry])
    }

    /// A body's coordinates at the moment drawn.
    pub(super) fn coordinates(&self, body: &LaneBody) -> Vec<f64> {
        self.lab.display().interpolation.coordinates(body, self.alpha, self.h)
    }

    /// What is remembered of a body in a lane.
    pub(super) fn history(&self, entrant: &Entrant, body: usize) -> &'a History {
        let entrants = self.lab.race().entrants();
        let place = entrants.iter().position(|other| other.lane_number == entrant.lane_number);
        &self.lab.past().histories(place.expect("it is in the race"))[body]
    }
}

/// Whether a body leaves the line that it starts on: the one coordinate of the others is along it.
pub(super) fn turns(body: &LaneBody) -> bool {
    body.coordinates.len() > 1
}
