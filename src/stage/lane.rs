//! A lane as the stage names and marks it: a method's in a race, or a loop's in the loop lab.

use super::letters::fitting;
use super::moment::DrawContext;
use super::{Picture, Rect};
use crate::look::palette::{Rgba, STALE, fade};
use crate::measure::{Outcome, Severity, Verdict};
use crate::run::MenuIndex;
use crate::run::past::History;
use crate::run::race::{Entrant, Halt, LaneBody};
use crate::scene::LaneId;

/// A lane with a key, a name and a verdict.
pub(super) trait StageLane {
    /// The number by which its key and its body show.
    fn number(&self) -> String;
    fn name(&self) -> String;
    fn colour(&self) -> Rgba;
    fn is_selected(&self) -> bool;

    /// The colour of the verdict and its ever shorter wordings, if it is known.
    fn verdict(&self) -> Option<(Rgba, Vec<String>)>;

    fn numbered_name(&self) -> String {
        format!("{} {}", self.number(), self.name())
    }

    /// The colour of the verdict and its longest wording that fits, in letters of this width.
    fn verdict_within(&self, letter: f32, room: f32) -> Option<(Rgba, String)> {
        let (colour, wordings) = self.verdict()?;
        Some((colour, fitting(wordings, letter, room)?))
    }

    /// Marks the row of the selected lane with a bar at its left.
    fn mark(&self, picture: &mut Picture, row: Rect) {
        if self.is_selected() {
            let (x, top) = (row.min[0] + 2.5, row.min[1] + 4.0);
            let bottom = (row.max[1] - 4.0).max(top);
            picture.pen(row).line([x, top], [x, bottom], 3.0, self.colour());
        }
    }
}

/// A lane of a race at the moment drawn.
#[derive(Clone, Copy)]
pub(super) struct RaceLane<'a> {
    pub(super) moment: &'a DrawContext<'a>,
    pub(super) entrant: &'a Entrant,
}

impl<'a> RaceLane<'a> {
    pub(super) fn id(self) -> LaneId {
        self.entrant.id
    }

    pub(super) fn entry(self) -> MenuIndex {
        self.moment.studio.entry(self.entrant)
    }

    /// Colour and dash pattern.
    pub(super) fn style(self) -> (Rgba, [f32; 2]) {
        self.moment.style(self.entry())
    }

    pub(super) fn bodies(self) -> &'a [LaneBody] {
        self.entrant.lane.bodies()
    }

    /// The halt of its only body. In a scene of several, each body's cell reports its halt.
    pub(super) fn lone_halt(self) -> Option<&'a Halt> {
        let [body] = self.bodies() else { return None };
        body.halted()
    }

    /// The recent past of its body with this index in the scene.
    pub(super) fn history(self, body: usize) -> &'a History {
        &self.moment.studio.past().histories(self.id())[body]
    }
}

/// The verdict on the method, on one line.
pub(super) struct Chip {
    pub(super) sign: &'static str,
    /// Colours of the sign and of the rim.
    pub(super) colours: [Rgba; 2],
    /// The verdict in words, and a shorter version, if there is one.
    pub(super) wordings: Vec<String>,
}

impl Chip {
    /// The chip of a body under a lane's method, if its verdict is known.
    pub(super) fn of(lane: RaceLane<'_>, index: usize) -> Option<Self> {
        Self::in_words(lane, index, |verdict| verdict.wordings(false))
    }

    /// Like [`Chip::of`], in the first of these wordings of the verdict, with the second as the shorter version.
    pub(super) fn in_words(
        lane: RaceLane<'_>,
        index: usize,
        wordings: impl FnOnce(&Verdict) -> Vec<String>,
    ) -> Option<Self> {
        let (studio, palette, entry) = (lane.moment.studio, lane.moment.palette, lane.entry());
        let halt = lane.bodies()[index].halted();
        let verdict = studio.viewer.verdict_from_here(&studio.deck, entry)?;
        let outcome = halt.map_or(verdict.outcome(), Outcome::of_halt);
        let severity = outcome.severity();
        if verdict.body != index || severity == Severity::Unknown {
            return None;
        }
        let is_current = studio.viewer.is_judged_now(&studio.deck, entry);
        let tone = palette.of_severity(severity);
        let tone = if is_current || halt.is_some() { tone } else { fade(tone, STALE) };
        let mut wordings = halt.map_or_else(|| wordings(verdict), |halt| fates(halt).into());
        wordings.truncate(2);
        Some(Self { sign: outcome.sign().glyph(), colours: [tone, lane.colour()], wordings })
    }
}

/// The end of a body and its time, and only the end.
pub(super) fn fates(halt: &Halt) -> [String; 2] {
    [halt.fate(), halt.ending().into()]
}

impl StageLane for RaceLane<'_> {
    fn number(&self) -> String {
        (self.entry() + 1).to_string()
    }

    fn name(&self) -> String {
        self.moment.studio.lane_name(self.entry())
    }

    fn colour(&self) -> Rgba {
        self.style().0
    }

    fn is_selected(&self) -> bool {
        self.id() == self.moment.studio.selected().id
    }

    fn verdict(&self) -> Option<(Rgba, Vec<String>)> {
        if let Some(halt) = self.lone_halt() {
            return Some((self.moment.palette.bad, fates(halt).into()));
        }
        let studio = self.moment.studio;
        let body = studio.viewer.verdict_from_here(&studio.deck, self.entry())?.body;
        let Chip { sign, colours, wordings } = Chip::of(*self, body)?;
        let signed = wordings.iter().map(|words| format!("{sign} {words}"));
        Some((colours[0], signed.chain([sign.into()]).collect()))
    }
}
