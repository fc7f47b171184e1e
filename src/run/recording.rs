//! A run as a scene, with the run's start, its actions, and its states as checks. [`Replay`] repeats such a scene and
//! compares.
//!
//! A recording has the start and the actions, and no states, because these follow to the bit. Its checks detect a
//! program or a platform that computes otherwise. They come once a second at most, so that a failed check shows the
//! second of the first difference, and the file stays readable.

use std::sync::Arc;

use super::course::Hashes;
use super::race::{Mode, Observer, PerformedAction, Race, Switch};
use super::{Run, Session};
use crate::scene::{Action, Check, LaneId, LaneSpec, MAX_FILE_BYTES, MIN_SECONDS, Scene, Scripted};
use crate::sim::integrators::Method;
use crate::sim::own_method;

/// Maximum number of checks of a recording, which keeps the file readable. A long run has fewer than one check per
/// second.
pub const MAX_CHECKS: usize = 8_000;

/// The reason why a run cannot be recorded.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RecordingError {
    /// The run's scene file would be too long to read.
    #[error(
        "this run has so many actions that its file would be {bytes} bytes long, and a scene file may be at most {MAX_FILE_BYTES}; record a shorter run"
    )]
    TooLong {
        /// Size of the scene file in bytes.
        bytes: usize,
    },
    /// The run has a body or a method written in Rust.
    #[error("{what} is written in Rust, and a scene file cannot hold it; compare hashes instead")]
    InRust {
        /// Name of the body, or id of the method.
        what: String,
    },
}

impl Session {
    /// Returns the text of the [recording](Session::recording) to tick `end`.
    ///
    /// # Errors
    /// If the text is too long for a scene file, or if the run has a body or a method written in Rust.
    pub fn recording_text(&self, end: u64) -> Result<String, RecordingError> {
        text(&self.recording(end))
    }

    /// Returns a scene whose race repeats this run to the bit, from its start to tick `end`; see [`Run::recording`].
    /// Repeats the ticks.
    pub fn recording(&self, end: u64) -> Scene {
        let mut run = Run::new(self.before_its_first_tick());
        (0..end).for_each(|_| run.tick(&mut ()));
        run.recording()
    }
}

/// Returns the text of a recording, in the words of the scene's author.
///
/// # Errors
/// If the text is too long for a scene file, or if the run has a body or a method written in Rust.
pub fn text(recording: &Scene) -> Result<String, RecordingError> {
    if let Some(what) = recording.in_rust() {
        return Err(RecordingError::InRust { what: what.to_owned() });
    }
    let text = recording.to_saved_toml();
    let bytes = text.len();
    if bytes > MAX_FILE_BYTES { Err(RecordingError::TooLong { bytes }) } else { Ok(text) }
}

impl Run {
    /// Returns a scene whose race repeats this run to the bit, from its start to the last tick reached.
    ///
    /// The scene lasts until the last tick reached, or as long as the run's scene if no tick was made. It has the run's
    /// initial parameters, lanes and rate, and all actions of the run as script. A [`Check`] covers every lane at every
    /// second and at the end. A recorded race [opens as a race](Scene::opens_as_race).
    ///
    /// An action that names a method without a lane becomes a switch of its lane, so that it works in a race, too.
    pub fn recording(&self) -> Scene {
        let (session, start, end) = (self.session(), self.start(), self.end());
        let lanes = start.entrants().iter().map(|entrant| entrant.id).collect();
        let mut recorder = ScriptRecorder { lanes, script: Vec::new() };
        let race = start.clone().after_actions(session.journal(), end, &mut recorder);
        let at_end = Hashes::of(&self.race_at_end());
        let mut scene = Scene {
            lanes: start.entrants().iter().map(|entrant| entrant.spec).collect(),
            tick_hz: start.tick_hz(),
            opening_method: None,
            equal_cost: false,
            opens_as_race: start.mode() == Mode::Race,
            script: Vec::new(),
            checks: Vec::new(),
            ..(**session.scene()).clone()
        };
        let before_end: Vec<_> = self.hashes().iter().filter(|it| it.tick < end).collect();
        let every = (before_end.len() * recorder.lanes.len()).div_ceil(MAX_CHECKS).max(1);
        let kept = before_end.into_iter().skip(every - 1).step_by(every);
        for Hashes { tick, of_lanes, .. } in kept.chain([&at_end]) {
            let check = |&(id, hash)| Check { tick: *tick, lane: recorder.lane(id), hash };
            scene.checks.extend(of_lanes.iter().map(check));
        }
        scene.script = recorder.script;
        if end > 0 {
            scene.seconds = race.t().max(MIN_SECONDS);
        }
        name_versions(&mut scene);
        scene
    }
}

/// Gives later versions of a person's own method names of their own, such as `mine-2`, because a file has one method
/// of each id.
fn name_versions(scene: &mut Scene) {
    let switched = scene.script.iter_mut().filter_map(|row| match &mut row.action {
        Action::Lane { spec, .. } => Some(&mut spec.method),
        _ => None,
    });
    let known = &mut scene.own_methods;
    let mut versions: Vec<[&'static Method; 2]> = Vec::new();
    for method in scene.lanes.iter_mut().map(|lane| &mut lane.method).chain(switched) {
        let of_id = |own: &&Method| own.id == method.id;
        let Some(text) = method.own_text().filter(|_| known.iter().any(of_id)) else { continue };
        if known.contains(method) {
            continue;
        }
        let named = versions.iter().find(|[version, _]| version == method).map(|[_, named]| *named);
        let named = named.or_else(|| {
            let ids = (2..).map(|version| format!("{}-{version}", method.id));
            let mut ids = ids.skip_while(|id| known.iter().any(|own| own.id == id));
            own_method(&ids.next()?, text).ok()
        });
        let Some(named) = named else { continue };
        versions.push([*method, named]);
        *method = named;
        if !known.contains(&named) {
            known.push(named);
        }
    }
}

/// Returns a solo recording with its lane among `lanes`, so that the menu offers the same methods as before. The
/// recording opens with its own method, and its script and checks refer to that lane. If `lanes` has another spec for
/// its method, the recording stays unchanged.
pub fn with_menu_lanes(recording: Scene, lanes: &[LaneSpec]) -> Scene {
    let ([flown], false) = (&recording.lanes[..], recording.opens_as_race) else {
        return recording;
    };
    let method = flown.method;
    let index = lanes.iter().position(|lane| lane.method == method);
    let Some(index) = index.filter(|&index| lanes[index] == *flown) else { return recording };
    let mut scene = Scene { lanes: lanes.to_vec(), opening_method: Some(method), ..recording };
    scene.checks.iter_mut().for_each(|check| check.lane = LaneId::of_index(index));
    for Scripted { action, .. } in &mut scene.script {
        if let Action::Lane { lane, .. } = action {
            *lane = LaneId::of_index(index);
        }
    }
    scene
}

/// Records the actions on a race as the script of a scene.
struct ScriptRecorder {
    /// The lanes at the start. The scene numbers them from 1.
    lanes: Vec<LaneId>,
    script: Vec<Scripted>,
}

impl ScriptRecorder {
    /// Returns the scene's number for this lane of the run.
    fn lane(&self, id: LaneId) -> LaneId {
        let index = self.lanes.iter().position(|lane| *lane == id);
        LaneId::of_index(index.expect("a lane is there from the start"))
    }
}

impl Observer for ScriptRecorder {
    fn before(&mut self, race: &Race, done: &PerformedAction) {
        let action = match (done.switch, &done.action) {
            (Some(Switch { lane, spec, .. }), _) => Action::Lane { lane: self.lane(lane), spec },
            (None, Action::Solo { lane }) => Action::Solo { lane: self.lane(*lane) },
            (None, other) => other.clone(),
        };
        self.script.push(Scripted { at_s: race.t(), action });
    }
}

/// A check, and the state of its lane as the race reached it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached {
    /// Index of the check in the scene.
    pub row: usize,
    /// Simulated time of the check in seconds.
    pub t: f64,
    /// Hash of the lane; `None` if the lane has left the race.
    pub hash: Option<u64>,
}

/// The race of a scene, which runs past all checks of the scene in the order of their ticks.
pub struct Replay {
    session: Session,
    /// Indices of the checks still ahead, with the next one last.
    rows: Vec<usize>,
}

impl Replay {
    /// Creates a replay at the start of the race.
    pub fn new(scene: Arc<Scene>) -> Self {
        let mut rows: Vec<usize> = (0..scene.checks.len()).rev().collect();
        rows.sort_by_key(|&row| std::cmp::Reverse(scene.checks[row].tick));
        Self { session: Session::racing(scene), rows }
    }

    /// Returns the scene with its checks.
    pub fn scene(&self) -> &Arc<Scene> {
        self.session.scene()
    }

    /// Whether the replay has reached all checks.
    pub fn is_over(&self) -> bool {
        self.rows.is_empty()
    }

    /// Runs to the next check, for at most this number of ticks, and notifies the observer. Returns `None` if the check
    /// is farther away, or if there is no check left.
    pub fn run_to_next_check(
        &mut self,
        ticks: u64,
        observer: &mut dyn Observer,
    ) -> Option<Reached> {
        let row = *self.rows.last()?;
        let Check { tick, lane, .. } = self.session.scene().checks[row];
        let now = self.session.race().tick();
        let end = tick.min(now.saturating_add(ticks));
        (now..end).for_each(|_| self.session.tick(observer));
        if end < tick {
            return None;
        }
        self.rows.pop();
        let race = self.session.race();
        Some(Reached { row, t: race.t(), hash: race.lane_hash(lane) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_equal_a_fresh_recording_after_any_edit_of_the_past() {
        for (scene, seed) in [("harbour", 1_u64), ("helm", 2), ("spring", 3)] {
            let session = Session::racing(Scene::built_in(scene).unwrap().into());
            let mut run = Run::new(session);
            let (mut state, mut most) = (seed, 0);
            let mut below = |count: u64| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                (state >> 33) % count
            };
            for step in 0..60 {
                match below(8) {
                    0 => _ = run.act(Action::Kick(below(5) as f64 - 2.0)),
                    1 => _ = run.act(Action::TickHz((20 + below(80) as u32).into())),
                    2 => _ = run.act(Action::Throttle(below(3) as f64 / 2.0)),
                    3 => _ = run.undo(),
                    4 => _ = run.redo(),
                    5 => run.seek(below(run.end() + 1)),
                    _ => (0..below(90)).for_each(|_| run.tick(&mut ())),
                }
                let again = run.session().recording(run.end());
                let noted = run.recording();
                assert_eq!(noted.to_toml(), again.to_toml(), "{scene}, {step}");
                most = most.max(noted.checks.len());
            }
            assert!(most > 10, "{scene}: {most}");
        }
    }

    #[test]
    fn a_sliced_replay_reaches_every_check_with_the_same_hash() {
        let mut session = Session::racing(Scene::built_in("harbour").unwrap().into());
        session.run(100);
        let recording = session.recording(100);
        let mut replay = Replay::new(recording.clone().into());
        let mut reached = Vec::new();
        let mut slices = 0;
        while !replay.is_over() {
            reached.extend(replay.run_to_next_check(7, &mut ()));
            slices += 1;
        }
        assert!(slices > 14 && reached.len() == recording.checks.len());
        assert!(reached.iter().all(|it| it.hash == Some(recording.checks[it.row].hash)));
        assert!(reached.is_sorted_by_key(|it| recording.checks[it.row].tick));
    }
}
