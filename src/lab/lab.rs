//! The lab: a race, the clock that drives it, and how it is looked at. Commands in, state out.

use std::sync::Arc;

use super::clock::{Clock, Due};
use super::command::{Command, SPEED_LADDER, TICK_LADDER};
use super::display::{Ask, Display, Instrument, Interpolation, Mode, Pace};
use super::history::History;
use super::race::Race;
use super::scene::{LaneSpec, SCENES, Scene};
use super::thinking::{Advice, Findings, Question, Thinker, entries};
use super::verdict::Verdict;
use crate::sim::bodies::Input;

/// What a person chose and a restart keeps; a script's changes are not in it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Choice {
    entry: usize,
    tick_hz: u32,
}

/// A scene being run and looked at.
pub struct Lab {
    scene: Arc<Scene>,
    /// The list of methods that digits and lanes refer to: the scene's lanes, then all other methods.
    entries: Vec<LaneSpec>,
    choice: Choice,
    mode: Mode,
    /// The method flown in solo, the lane selected in a race, by its place on the list.
    active: usize,
    race: Race,
    clock: Clock,
    running: bool,
    throttle: f64,
    rudder: f64,
    dropped: u64,
    next_scripted: usize,
    display: Display,
    pace: Option<Pace>,
    notice: Option<String>,
    findings: Option<Findings>,
}

/// The method that the program opens with: right on every scene it is not meant to fail on.
const OPENING_METHOD: &str = "rk4";

impl Lab {
    /// Opens a scene, running, in solo mode, under Runge-Kutta where it is on the list and else under
    /// the first method listed.
    pub fn new(scene: Scene) -> Self {
        let entries = entries(&scene);
        let entry = entries.iter().position(|spec| spec.method.id == OPENING_METHOD).unwrap_or(0);
        let choice = Choice { entry, tick_hz: scene.tick_hz };
        let mut lab = Self {
            race: Race::new(&scene, []),
            clock: Clock::new(scene.tick_hz),
            scene: Arc::new(scene),
            entries,
            choice,
            mode: Mode::Solo,
            active: entry,
            running: true,
            throttle: 1.0,
            rudder: 0.0,
            dropped: 0,
            next_scripted: 0,
            display: Display {
                ghost: true,
                interpolation: Interpolation::Hermite,
                instrument: Instrument::Metric(0),
                body: 0,
                help: false,
                motion: true,
            },
            pace: None,
            notice: None,
            findings: None,
        };
        lab.restart();
        lab
    }

    /// The scene that is open.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }
    /// The methods that digits and lanes refer to: the scene's lanes, which race, then all others.
    pub fn entries(&self) -> &[LaneSpec] {
        &self.entries
    }
    /// Solo or race.
    pub fn mode(&self) -> Mode {
        self.mode
    }
    /// The method flown in solo, the lane selected in a race, by its place on the list.
    pub fn active(&self) -> usize {
        self.active
    }
    /// The lanes and the truth.
    pub fn race(&self) -> &Race {
        &self.race
    }
    /// The clock.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }
    /// Whether time runs.
    pub fn running(&self) -> bool {
        self.running
    }
    /// The throttle, -1 to 1.
    pub fn throttle(&self) -> f64 {
        self.throttle
    }
    /// The rudder, from -1, hard right, to 1, hard left.
    pub fn rudder(&self) -> f64 {
        self.rudder
    }
    /// Ticks given up since the scene was opened or restarted.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }
    /// How the lab is looked at.
    pub fn display(&self) -> &Display {
        &self.display
    }
    /// How fast the driver goes; `None` where there is no real time, as in a capture.
    pub fn pace(&self) -> Option<Pace> {
        self.pace
    }
    /// The latest thing worth telling, such as a screenshot's file name.
    pub fn notice(&self) -> Option<&str> {
        self.notice.as_deref()
    }
    /// What is to be said of the method on this place of the list, over the scene from its start at the
    /// present tick rate and throttle; `None` until it was [learnt](Self::learn).
    pub fn verdict(&self, entry: usize) -> Option<&Verdict> {
        self.findings.as_ref()?.verdicts.get(entry)?.as_ref()
    }
    /// What is known of every method on this scene, as far as it was [learnt](Self::learn) and is shown.
    pub fn advice(&self) -> Option<&Advice> {
        self.findings.as_ref()?.advice.as_ref()
    }
    /// Whether any body takes an input, by its name on the body's [card](crate::sim::bodies::Kind).
    pub fn takes(&self, input: &str) -> bool {
        self.scene.bodies.iter().any(|body| body.kind.inputs.contains(&input))
    }

    /// Says how the bodies move when nothing is to fade or glide.
    pub fn set_motion(&mut self, motion: bool) {
        self.display.motion = motion;
    }
    /// Tells the lab how fast its driver goes.
    pub fn set_pace(&mut self, pace: Pace) {
        self.pace = Some(pace);
    }
    /// Gives people something to read.
    pub fn set_notice(&mut self, notice: impl Into<String>) {
        self.notice = Some(notice.into());
    }

    /// The window's title: people and tests read it.
    pub fn title(&self) -> String {
        let race = if self.mode == Mode::Race { "race: " } else { "" };
        let paused = if self.running { "" } else { " (paused)" };
        format!(
            "Regatta - {} - {race}{} - {} Hz{paused}",
            self.scene.name,
            self.entries[self.active].method.name,
            self.clock.tick_hz(),
        )
    }

    /// Does what a person asked for. What is not the lab's business comes back.
    pub fn apply(&mut self, command: Command) -> Option<Ask> {
        match command {
            Command::Method(_)
            | Command::Pick(_)
            | Command::NextMethod
            | Command::PreviousMethod => {
                self.perform(command);
                self.choice.entry = self.active;
            }
            Command::TickHz(_) => {
                self.perform(command);
                self.choice.tick_hz = self.clock.tick_hz();
            }
            Command::TickRateUp => {
                let higher = TICK_LADDER.iter().find(|&&hz| hz > self.clock.tick_hz());
                return higher.and_then(|&hz| self.apply(Command::TickHz(hz)));
            }
            Command::TickRateDown => {
                let lower = TICK_LADDER.iter().rfind(|&&hz| hz < self.clock.tick_hz());
                return lower.and_then(|&hz| self.apply(Command::TickHz(hz)));
            }
            Command::SpeedPercent(percent) => self.clock.set_speed_percent(percent),
            Command::SpeedUp => {
                let faster = SPEED_LADDER.iter().find(|&&p| p > self.clock.speed_percent());
                self.clock.set_speed_percent(*faster.unwrap_or(&self.clock.speed_percent()));
            }
            Command::SpeedDown => {
                let slower = SPEED_LADDER.iter().rfind(|&&p| p < self.clock.speed_percent());
                self.clock.set_speed_percent(*slower.unwrap_or(&self.clock.speed_percent()));
            }
            Command::Throttle(_)
            | Command::ThrottleUp
            | Command::ThrottleDown
            | Command::Rudder(_)
            | Command::RudderLeft
            | Command::RudderRight
            | Command::Kick(_) => {
                self.perform(command);
            }
            Command::ToggleRace => {
                self.mode = if self.mode == Mode::Solo { Mode::Race } else { Mode::Solo };
                match self.mode {
                    Mode::Race => self.restart(),
                    Mode::Solo => self.race.keep_only(self.active),
                }
            }
            Command::TogglePause => self.running = !self.running,
            Command::TickForward => {
                self.running = false;
                self.tick();
            }
            Command::Restart => self.restart(),
            Command::Scene(index) => self.open(index % SCENES.len()),
            Command::NextScene => self.open_beside(1),
            Command::PreviousScene => self.open_beside(SCENES.len() - 1),
            Command::ToggleGhost => self.display.ghost = !self.display.ghost,
            Command::NextInterpolation => {
                self.display.interpolation = match self.display.interpolation {
                    Interpolation::Raw => Interpolation::Linear,
                    Interpolation::Linear => Interpolation::Hermite,
                    Interpolation::Hermite => Interpolation::Raw,
                };
                let name = self.display.interpolation.name();
                self.set_notice(format!("drawing between ticks: {name}"));
            }
            Command::Instrument(instrument) => self.display.instrument = instrument,
            Command::NextInstrument => {
                let mut after = Instrument::all().skip_while(|i| *i != self.display.instrument);
                self.display.instrument = after.nth(1).unwrap_or(Instrument::Metric(0));
            }
            Command::Body(body) => self.display.body = body.min(self.scene.bodies.len() - 1),
            Command::ToggleHelp => self.display.help = !self.display.help,
            Command::Escape if self.display.help => self.display.help = false,
            Command::Escape => return Some(Ask::Quit),
            Command::Screenshot => return Some(Ask::Screenshot),
            Command::ToggleFullScreen => return Some(Ask::ToggleFullScreen),
        }
        None
    }

    /// What there is to be found out: a verdict on each method of the list at the present tick rate and
    /// throttle, and advice while it is shown. For a [`Thinker`].
    pub fn question(&self) -> Question {
        Question {
            scene: Arc::clone(&self.scene),
            tick_hz: self.clock.tick_hz(),
            throttle: self.throttle,
            advice: self.display.instrument == Instrument::Advice,
        }
    }

    /// Takes in what was found out, unless it is of another scene.
    pub fn learn(&mut self, findings: Findings) {
        if findings.question.is_of(&self.scene) {
            self.findings = Some(findings);
        }
    }

    /// Finds out here and now whatever there is to be.
    pub fn think(&mut self) {
        let question = self.question();
        if !self.findings.as_ref().is_some_and(|known| known.answer(&question)) {
            self.learn(Thinker::new(question).finish());
        }
    }

    /// Takes in a frame of `frame_ns` nanoseconds of real time, and steps what is due.
    pub fn advance(&mut self, frame_ns: i64) -> Due {
        self.advance_seen(frame_ns, |_| ())
    }

    /// As [`Lab::advance`], and shows itself to `after_tick` after every tick.
    pub fn advance_seen(&mut self, frame_ns: i64, mut after_tick: impl FnMut(&Lab)) -> Due {
        if !self.running {
            return Due::default();
        }
        // A tick rate that the script sets at this tick is that of the time from here on.
        self.follow_script();
        let due = self.clock.advance(frame_ns);
        for _ in 0..due.ticks {
            self.tick();
            after_tick(self);
        }
        self.dropped += due.dropped;
        due
    }

    /// Does what the script says for this tick, and steps to the next.
    pub fn tick(&mut self) {
        self.follow_script();
        let halted = self.halted_lanes();
        self.race.step();
        self.race.record();
        if self.halted_lanes() > halted {
            self.announce_halt();
        }
    }

    /// Does what the script says for the present tick, once.
    fn follow_script(&mut self) {
        while let Some(scripted) = self.scene.script.get(self.next_scripted)
            && scripted.tick <= self.race.tick()
        {
            let command = scripted.command;
            self.next_scripted += 1;
            self.perform(command);
        }
    }

    /// What both a person and a script can do: everything that touches the bodies.
    fn perform(&mut self, command: Command) {
        match command {
            Command::Method(method) => {
                let listed = self.entries.iter().position(|spec| spec.method == method);
                self.pick(listed.expect("every method is on the list"));
            }
            Command::Pick(entry) => self.pick(entry),
            Command::NextMethod => self.pick_beside(1),
            Command::PreviousMethod => self.pick_beside(-1),
            Command::TickHz(tick_hz) => {
                self.clock.set_tick_hz(tick_hz);
                self.race.set_tick_hz(self.clock.tick_hz());
            }
            Command::Throttle(part) => self.set_throttle(part),
            Command::ThrottleUp => self.set_throttle(tenths(self.throttle, 1.0)),
            Command::ThrottleDown => self.set_throttle(tenths(self.throttle, -1.0)),
            Command::Rudder(part) => self.set_rudder(part),
            Command::RudderLeft => self.set_rudder(tenths(self.rudder, 1.0)),
            Command::RudderRight => self.set_rudder(tenths(self.rudder, -1.0)),
            Command::Kick(times) => self.race.input(Input::Kick(times)),
            _ => {}
        }
    }

    /// Whether there is something to pick at this place of the list: in a race, a lane.
    fn can_pick(&self, entry: usize) -> bool {
        match self.mode {
            Mode::Solo => entry < self.entries.len(),
            Mode::Race => self.race.entrants().iter().any(|entrant| entrant.entry == entry),
        }
    }

    fn pick(&mut self, entry: usize) {
        if !self.can_pick(entry) {
            return;
        }
        if self.mode == Mode::Solo && entry != self.active {
            self.race.switch(0, entry, self.entries[entry]);
        }
        self.active = entry;
    }

    /// The next place on the list that can be picked, round, `step` forward or back.
    fn pick_beside(&mut self, step: isize) {
        let count = self.entries.len() as isize;
        let around = (1..=count).map(|i| (self.active as isize + i * step).rem_euclid(count));
        if let Some(entry) = around.map(|entry| entry as usize).find(|&entry| self.can_pick(entry))
        {
            self.pick(entry);
        }
    }

    fn set_throttle(&mut self, part: f64) {
        self.throttle = part.clamp(-1.0, 1.0);
        self.race.input(Input::Throttle(self.throttle));
    }

    fn set_rudder(&mut self, part: f64) {
        self.rudder = part.clamp(-1.0, 1.0);
        self.race.input(Input::Rudder(self.rudder));
    }

    fn restart(&mut self) {
        let chosen = self.choice.entry;
        let racing = |&(entry, _): &(usize, LaneSpec)| match self.mode {
            Mode::Solo => entry == chosen,
            Mode::Race => entry < self.scene.lanes.len() || entry == chosen,
        };
        let lanes = self.entries.iter().copied().enumerate().filter(racing);
        self.race = Race::new(&self.scene, lanes);
        self.active = chosen;
        self.race.set_tick_hz(self.choice.tick_hz);
        self.race.record();
        self.clock.set_tick_hz(self.choice.tick_hz);
        self.clock.restart();
        self.throttle = 1.0;
        self.rudder = 0.0;
        self.dropped = 0;
        self.next_scripted = 0;
        self.notice = None;
    }

    fn open_beside(&mut self, offset: usize) {
        let here = SCENES.iter().position(|scene| scene.name == self.scene.name);
        self.open(here.map_or(0, |here| (here + offset) % SCENES.len()));
    }

    /// Opens a built-in scene; mode, method and look stay as they are.
    fn open(&mut self, index: usize) {
        let scene = Scene::built_in(SCENES[index].name).expect("every name in SCENES is built in");
        let method = self.entries[self.active].method;
        let mut lab = Lab::new(scene);
        lab.mode = self.mode;
        lab.display = Display { body: 0, ..self.display.clone() };
        lab.pace = self.pace;
        lab.clock.set_speed_percent(self.clock.speed_percent());
        lab.running = self.running;
        if let Some(entry) = lab.entries.iter().position(|spec| spec.method == method) {
            lab.choice.entry = entry;
        }
        lab.restart();
        *self = lab;
    }

    fn halted_lanes(&self) -> usize {
        self.race.entrants().iter().filter(|entrant| entrant.lane.halted().is_some()).count()
    }

    fn announce_halt(&mut self) {
        let halts = self.race.entrants().iter().filter_map(|entrant| {
            let halt = entrant.lane.halted()?;
            (halt.tick + 1 == self.race.tick()).then(|| {
                let method = self.entries[entrant.entry].method.name;
                let body = &self.scene.bodies[halt.body].name;
                format!("{method} halted at tick {}: {body} {}", halt.tick, halt.failure)
            })
        });
        self.notice = Some(halts.collect::<Vec<_>>().join("; "));
    }

    /// The history of the displayed body in each lane, with the lane's place on the list.
    pub fn plotted(&self) -> impl Iterator<Item = (usize, &History)> {
        let body = self.display.body;
        self.race.entrants().iter().map(move |e| (e.entry, &e.histories[body]))
    }
}

/// `part` and so many tenths more, in whole tenths, so that ten steps up and down end where they began.
fn tenths(part: f64, more: f64) -> f64 {
    ((part * 10.0).round() + more) / 10.0
}
