//! The loop of a driver, without a clock and without a screen. A turn goes from commands to ticks, to a picture, and to
//! the next commands.
//!
//! A driver counts time in nanoseconds from any origin. For each frame it calls [`begin`](FrameLoop::begin), executes
//! the requests, calls [`advance`](FrameLoop::advance), draws, and calls [`end`](FrameLoop::end) with the commands of
//! the panels.

use super::pace::PaceMeter;
use super::{Command, DriverRequest, Studio, ViewCommand};

/// Maximum time that a frame spends on simulation, in nanoseconds. A race that needs more time drops ticks, so that the
/// driver stays responsive.
const MAX_SIMULATION_NS: u64 = 50_000_000;

/// Share of the last frame in the mean time of a frame. The mean follows a change in a third of a second.
const PART_OF_LAST_FRAME: f64 = 0.05;

/// A task that a command leaves to the driver.
#[derive(Clone, Debug, PartialEq)]
pub enum ToDo {
    /// A request that remains after the studio has executed its part of the command.
    Request(DriverRequest),
    /// A command that the driver executes itself.
    Own(Command),
}

/// A studio that runs in real time.
pub struct FrameLoop {
    /// The studio.
    pub studio: Studio,
    /// Whether the driver executes a command itself.
    is_own: fn(&Command) -> bool,
    /// Commands that the next frame executes before time passes, in their order.
    asked: Vec<Command>,
    /// Tick to reach before time passes, and whether time runs after that.
    goal: Option<(u64, bool)>,
    /// Start of the last frame, or `None` after a pause or after time was skipped.
    last_frame_ns: Option<u64>,
    /// Real time of the last [`advance`](Self::advance).
    passed_ns: u64,
    /// Number of opened scenes when time last passed.
    openings: u64,
    /// Whether the next frame takes longer to draw, as the first frame of a scene does.
    draws_long: bool,
    meter: PaceMeter,
}

impl FrameLoop {
    /// Creates a loop whose driver executes the commands that `is_own` selects.
    pub fn new(studio: Studio, is_own: fn(&Command) -> bool, now_ns: u64) -> Self {
        Self {
            openings: studio.deck.openings(),
            studio,
            is_own,
            asked: Vec::new(),
            goal: None,
            last_frame_ns: None,
            passed_ns: now_ns,
            draws_long: true,
            meter: PaceMeter::default(),
        }
    }

    /// Queues commands, which the next frame executes.
    pub fn queue(&mut self, commands: impl IntoIterator<Item = Command>) {
        self.asked.extend(commands);
    }

    /// Returns the commands queued for the next frame, in their order.
    pub fn queued(&self) -> &[Command] {
        &self.asked
    }

    /// Moves to this tick before time passes. `runs` sets whether time runs after that.
    pub fn go_to(&mut self, tick: u64, runs: bool) {
        self.goal = Some((tick, runs));
    }

    /// Begins a frame: executes commands up to the first one that needs the driver, and returns the driver's part of
    /// it. The driver does its part and calls this function again, until the function returns `None`.
    pub fn begin(&mut self) -> Option<ToDo> {
        while !self.asked.is_empty() {
            let command = self.asked.remove(0);
            if (self.is_own)(&command) {
                return Some(ToDo::Own(command));
            }
            if let Some(request) = self.studio.apply(command) {
                return Some(ToDo::Request(request));
            }
        }
        None
    }

    /// Passes the time since the last frame. The present frame began at `now_ns`. Makes the ticks that are due, up to
    /// the tick `last`, as long as `clock` shows that the driver stays responsive.
    pub fn advance(&mut self, now_ns: u64, last: u64, clock: &dyn Fn() -> u64) {
        // The time to build another scene does not count as time of its run.
        if std::mem::replace(&mut self.openings, self.studio.deck.openings())
            != self.studio.deck.openings()
        {
            self.skip_time();
        }
        let frame_ns = self.last_frame_ns.map_or(0, |last| now_ns.saturating_sub(last));
        self.last_frame_ns = self.studio.running().then_some(now_ns);
        let passed_ns = now_ns.saturating_sub(std::mem::replace(&mut self.passed_ns, now_ns));
        if !self.studio.deck.time_runs() {
            self.studio.viewer.pass_time(i64::try_from(passed_ns).unwrap_or(i64::MAX));
        }
        let mut is_time_left = || clock().saturating_sub(now_ns) < MAX_SIMULATION_NS;
        if self.reach_goal(&mut is_time_left) {
            let frame_ns = i64::try_from(frame_ns).unwrap_or(i64::MAX);
            self.studio.advance_in_time(last, frame_ns, &mut is_time_left, &mut ());
        }
        self.studio.viewer.pace = Some(self.meter.pace());
    }

    /// Makes ticks until the goal, if there is one. Returns whether no goal is left.
    fn reach_goal(&mut self, is_time_left: &mut dyn FnMut() -> bool) -> bool {
        let Some((goal, runs)) = self.goal else { return true };
        while self.studio.race().tick() < goal {
            if !is_time_left() {
                return false;
            }
            self.studio.tick();
        }
        self.goal = None;
        self.last_frame_ns = None;
        if self.studio.running() != runs {
            self.studio.apply(ViewCommand::TogglePause);
        }
        true
    }

    /// Ends a frame that began at `now_ns` and was displayed at `shown_ns`, and queues the commands of its panels.
    /// Returns the nanoseconds until the studio needs the next frame, which are 0 while time runs.
    pub fn end(&mut self, now_ns: u64, shown_ns: u64, commands: Vec<Command>) -> u64 {
        if std::mem::take(&mut self.draws_long) {
            self.stand_still(shown_ns);
        }
        self.meter.frame(now_ns, &self.studio);
        let work_ms = shown_ns.saturating_sub(now_ns) as f64 / 1e6;
        let mean_ms = self.studio.viewer.frame_ms.unwrap_or(work_ms);
        self.studio.viewer.frame_ms = Some(mean_ms + PART_OF_LAST_FRAME * (work_ms - mean_ms));
        self.asked.extend(commands);
        if self.studio.running() || !self.asked.is_empty() {
            return 0;
        }
        let viewer = &self.studio.viewer;
        let notices = [&viewer.notice, &viewer.quit_question].into_iter().flatten();
        let futures = Some(viewer.futures_left_ns).filter(|&left| left > 0);
        notices
            .map(|notice| notice.left_ns())
            .chain(futures)
            .min()
            .map_or(u64::MAX, i64::unsigned_abs)
    }

    /// Notes that the frame could not be drawn. Until the first frame of a scene is drawn, no time passes in its run.
    pub fn not_drawn(&mut self) {
        if self.draws_long {
            self.last_frame_ns = None;
        }
    }

    /// Excludes the time up to `now_ns` from the run. A driver calls this after long work.
    pub fn stand_still(&mut self, now_ns: u64) {
        self.last_frame_ns = self.last_frame_ns.map(|_| now_ns);
    }

    /// Excludes the time up to the next frame from the run, and the time to draw that frame.
    pub fn skip_time(&mut self) {
        (self.draws_long, self.last_frame_ns) = (true, None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Action, Scene};
    use crate::{RunCommand, StageCommand, Step};

    const FRAME_NS: u64 = 16_666_667;

    /// Returns a loop on a scene after its first frame, and the time of the next frame.
    fn begun(scene: &str) -> (FrameLoop, u64) {
        let studio = Studio::new(Scene::built_in(scene).unwrap());
        let mut frames = FrameLoop::new(studio, |_| false, 0);
        frame(&mut frames, 0, Vec::new());
        (frames, FRAME_NS)
    }

    /// Makes a frame that begins at `now_ns` and takes no time. Its panels give these commands.
    fn frame(frames: &mut FrameLoop, now_ns: u64, commands: Vec<Command>) -> u64 {
        assert_eq!(frames.begin(), None);
        frames.advance(now_ns, u64::MAX, &|| now_ns);
        frames.end(now_ns, now_ns, commands)
    }

    #[test]
    fn the_time_of_a_frame_follows_the_work_on_it() {
        let (mut frames, mut now_ns) = begun("spring");
        for work_ns in [4_000_000, 12_000_000] {
            for _ in 0..200 {
                assert_eq!(frames.begin(), None);
                frames.advance(now_ns, u64::MAX, &|| now_ns);
                frames.end(now_ns, now_ns + work_ns, Vec::new());
                now_ns += FRAME_NS;
            }
            let ms = frames.studio.viewer.frame_ms.expect("it is measured");
            assert!((ms - work_ns as f64 / 1e6).abs() < 0.1, "{ms} ms of {work_ns} ns");
        }
    }

    #[test]
    fn time_advances_while_a_parameter_is_swept_or_dragged() {
        for is_held in [false, true] {
            let (mut frames, mut now_ns) = begun("spring");
            let kind = &frames.studio.scene().bodies[0].kind;
            let (parameter, _) = kind.parameter("stiffness_n_per_m").unwrap();
            frames.queue([ViewCommand::PointerDown(is_held).into()]);
            for n in 0..60 {
                let value = 40.0 + f64::from(n);
                let edit = RunCommand::Act(Action::Set { body: 0, parameter, value });
                frame(&mut frames, now_ns, vec![edit.into()]);
                now_ns += FRAME_NS;
            }
            let ticks = frames.studio.race().tick();
            assert!((58..=60).contains(&ticks), "{ticks} ticks in a second of edits");
        }
    }

    #[test]
    fn loading_a_scene_adds_no_time_to_its_run() {
        let (mut frames, mut now_ns) = begun("spring");
        frame(&mut frames, now_ns, Vec::new());
        assert_eq!(frames.studio.race().tick(), 1);
        for command in [StageCommand::SceneBeside(Step::Previous), StageCommand::Restart] {
            let is_opened = command != StageCommand::Restart;
            frames.queue([command.into()]);
            // The previous frame takes long, and so does the next one if a scene was opened.
            now_ns += 10 * FRAME_NS;
            frame(&mut frames, now_ns, Vec::new());
            assert_eq!(frames.studio.race().tick(), if is_opened { 0 } else { 10 });
            now_ns += FRAME_NS;
            frame(&mut frames, now_ns, Vec::new());
        }
    }

    #[test]
    fn no_time_passes_until_the_first_picture_of_a_scene_is_drawn() {
        let studio = Studio::new(Scene::built_in("spring").unwrap());
        let mut frames = FrameLoop::new(studio, |_| false, 0);
        for n in 0..5 {
            frames.advance(n * FRAME_NS, u64::MAX, &|| n * FRAME_NS);
            frames.not_drawn();
        }
        assert_eq!(frames.studio.race().tick(), 0);
        for n in 5..8 {
            frame(&mut frames, n * FRAME_NS, Vec::new());
            // A surface that is lost for a moment does not stop time.
            frames.not_drawn();
        }
        assert_eq!(frames.studio.race().tick(), 2);
    }

    #[test]
    fn a_distant_goal_is_reached_over_several_frames_before_time_passes() {
        let (mut frames, now_ns) = begun("spring");
        frames.go_to(100, false);
        let calls = std::cell::Cell::new(0);
        let clock = || {
            calls.set(calls.get() + 1);
            if calls.get() % 41 == 0 { u64::MAX } else { now_ns }
        };
        let mut reached = Vec::new();
        while reached.last() != Some(&100) {
            frames.advance(now_ns, u64::MAX, &clock);
            reached.push(frames.studio.race().tick());
        }
        assert_eq!((reached, frames.studio.running()), (vec![40, 80, 100], false));
    }

    #[test]
    fn requests_reach_the_driver_in_order_with_the_next_due_time() {
        let studio = Studio::new(Scene::built_in("spring").unwrap());
        let own = |command: &Command| *command == Command::Stage(StageCommand::OpenSpring);
        let mut frames = FrameLoop::new(studio, own, 0);
        let pause = Command::View(ViewCommand::TogglePause);
        frames.queue([
            Command::Ask(DriverRequest::Screenshot),
            StageCommand::OpenSpring.into(),
            pause.clone(),
        ]);
        assert_eq!(frames.begin(), Some(ToDo::Request(DriverRequest::Screenshot)));
        assert_eq!(frames.begin(), Some(ToDo::Own(StageCommand::OpenSpring.into())));
        assert!(frames.studio.running());
        assert_eq!((frames.begin(), frames.studio.running()), (None, false));
        frames.studio.viewer.notice = None;
        assert_eq!(frame(&mut frames, 0, Vec::new()), u64::MAX, "nothing changes");
        frames.studio.viewer.set_notice("it leaves");
        let due_ns = frame(&mut frames, 0, Vec::new());
        assert!((1_000_000_000..60_000_000_000).contains(&due_ns), "{due_ns} ns");
        assert_eq!(frame(&mut frames, 0, vec![pause]), 0, "a command waits");
    }

    #[test]
    fn a_notice_and_a_question_stay_after_a_long_pause_before_their_key() {
        let (mut frames, now_ns) = begun("spring");
        frames.queue([ViewCommand::TogglePause.into()]);
        frame(&mut frames, now_ns, Vec::new());
        let later_ns = 600_000_000_000;
        frames.queue([ViewCommand::UsualScale.into(), ViewCommand::Escape.into()]);
        frame(&mut frames, later_ns, Vec::new());
        assert!(frames.studio.viewer.notice.is_some());
        assert!(frames.studio.viewer.quit_question().is_some());
        frame(&mut frames, later_ns + 60_000_000_000, Vec::new());
        assert!(frames.studio.viewer.notice.is_none());
        assert!(frames.studio.viewer.quit_question().is_none());
    }
}
