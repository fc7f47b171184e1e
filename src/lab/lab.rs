//! The lab: a race, the clock that drives it, and how it is looked at. Commands in, state out.

use std::sync::Arc;

use super::analysis::{Advice, Findings, Question, Thinker, Verdict, entries};
use super::clock::{Clock, Due};
use super::command::{Command, SPEED_LADDER, TICK_LADDER};
use super::display::{Ask, Display, Instrument, Interpolation, Mode, Pace};
use super::history::History;
use super::notices;
use super::race::Race;
use super::scene::{LaneSpec, SCENES, Scene};
use super::script::{Control, Script};

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
    dropped: u64,
    script: Script,
    /// What a person has worked since the start: the script leaves it alone.
    by_hand: Vec<Control>,
    display: Display,
    pace: Option<Pace>,
    notice: Option<String>,
    findings: Option<Findings>,
}

impl Lab {
    /// Opens a scene, running, in solo mode, under the method that [it names](Scene::opening_method), else
    /// under the first of its lanes.
    pub fn new(scene: Scene) -> Self {
        let entries = entries(&scene);
        let opens_with = |spec: &LaneSpec| Some(spec.method) == scene.opening_method;
        let entry = scene.lanes.iter().position(opens_with).unwrap_or(0);
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
            dropped: 0,
            script: Script::default(),
            by_hand: Vec::new(),
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
        self.race.throttle()
    }
    /// The rudder, from -1, hard right, to 1, hard left.
    pub fn rudder(&self) -> f64 {
        self.race.rudder()
    }
    /// The simulated time in seconds with the part of a tick that is owed: it goes evenly with real time, while
    /// the race goes on tick by tick.
    pub fn time_with_owed_s(&self) -> f64 {
        self.race.t() + self.clock.alpha() / f64::from(self.clock.tick_hz())
    }
    /// Ticks given up since the scene was opened or restarted.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }
    /// How the lab is looked at.
    pub fn display(&self) -> &Display {
        &self.display
    }
    /// How fast the driver goes while time runs; `None` where there is no real time, as in a capture.
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
            | Command::Fly(_)
            | Command::NextMethod
            | Command::PreviousMethod => {
                self.take_in_hand(command);
                self.choice.entry = self.active;
            }
            Command::TickHz(_) => {
                self.take_in_hand(command);
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
            | Command::Kick(_) => self.take_in_hand(command),
            Command::ToggleRace => {
                self.mode = if self.mode == Mode::Solo { Mode::Race } else { Mode::Solo };
                // It may be of a lane that is no more.
                self.notice = None;
                match self.mode {
                    Mode::Race => self.restart(),
                    Mode::Solo => self.race.keep_only(self.active),
                }
            }
            Command::TogglePause => self.running = !self.running,
            Command::TickForward => {
                self.running = false;
                self.tick();
                self.race.record_present();
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
            entries: self.entries.clone(),
            tick_hz: self.clock.tick_hz(),
            throttle: self.throttle(),
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
        if due.ticks > 0 {
            self.race.record_present();
        }
        self.dropped += due.dropped;
        due
    }

    /// Does what the script says for this tick, and steps to the next.
    pub fn tick(&mut self) {
        self.follow_script();
        self.race.step();
        self.race.record();
        if let Some(told) = notices::of_halts(&self.scene, &self.entries, &self.race) {
            self.notice = Some(told);
        }
    }

    /// Does what the script says for the present tick, once.
    fn follow_script(&mut self) {
        while let Some(command) = self.script.due(self.race.tick()) {
            let is_by_hand = Control::of(command).is_some_and(|c| self.by_hand.contains(&c));
            if !is_by_hand && let Some(told) = self.perform(command) {
                self.notice = Some(told);
            }
        }
    }

    /// Does what a person asked for, who from then on has that control in hand: the script leaves it alone until
    /// the race is restarted.
    fn take_in_hand(&mut self, command: Command) {
        let done = self.perform(command);
        let taken = Control::of(command).filter(|control| !self.by_hand.contains(control));
        self.by_hand.extend(taken);
        let from_script = taken.filter(|&control| {
            self.script.to_come().any(|command| Control::of(command) == Some(control))
        });
        let released = from_script.map(|control| {
            format!("the {} is yours: the script leaves it alone until a restart", control.name())
        });
        let told: Vec<String> = done.into_iter().chain(released).collect();
        if !told.is_empty() {
            self.notice = Some(told.join("; "));
        }
    }

    /// What both a person and a script can do: everything that touches the bodies. Returns what there is to tell
    /// of it.
    fn perform(&mut self, command: Command) -> Option<String> {
        match command {
            Command::Method(method) => {
                let listed = self.entries.iter().position(|spec| spec.method == method);
                self.pick(listed.expect("every method is on the list"))
            }
            Command::Pick(entry) => self.pick(entry),
            Command::Fly(spec) => self.fly(spec),
            Command::NextMethod => self.pick_beside(1),
            Command::PreviousMethod => self.pick_beside(-1),
            Command::TickHz(tick_hz) => {
                self.clock.set_tick_hz(tick_hz);
                self.race.set_tick_hz(self.clock.tick_hz());
                None
            }
            command => {
                self.race.act(command);
                None
            }
        }
    }

    /// Whether there is something to pick at this place of the list: in a race, a lane.
    fn can_pick(&self, entry: usize) -> bool {
        match self.mode {
            Mode::Solo => entry < self.entries.len(),
            Mode::Race => self.race.entrants().iter().any(|entrant| entrant.entry == entry),
        }
    }

    fn pick(&mut self, entry: usize) -> Option<String> {
        if !self.can_pick(entry) {
            return None;
        }
        let taken_up = match self.mode {
            Mode::Solo => self.race.switch(0, entry, self.entries[entry]),
            Mode::Race => Vec::new(),
        };
        self.active = entry;
        notices::of_taken_up(&self.scene, &taken_up)
    }

    /// Gives a method of the list other substeps, its lane in a race too, and picks it. A race that it is not in begins
    /// again with it.
    fn fly(&mut self, spec: LaneSpec) -> Option<String> {
        let listed = self.entries.iter().position(|known| known.method == spec.method);
        let entry = listed.expect("every method is on the list");
        self.entries[entry] = spec;
        let flown = self.race.entrants().iter().position(|entrant| entrant.entry == entry);
        if self.mode == Mode::Race && flown.is_none() {
            self.choice.entry = entry;
            self.restart();
            return Some(format!("the race began again, with {} in it", spec.method.name));
        }
        let taken_up = flown.map(|index| self.race.switch(index, entry, spec));
        let notice = taken_up.and_then(|taken| notices::of_taken_up(&self.scene, &taken));
        self.pick(entry).or(notice)
    }

    /// The next place on the list that can be picked, round, `step` forward or back.
    fn pick_beside(&mut self, step: isize) -> Option<String> {
        let count = self.entries.len() as isize;
        let mut around =
            (1..=count).map(|i| (self.active as isize + i * step).rem_euclid(count) as usize);
        let entry = around.find(|&entry| self.can_pick(entry))?;
        self.pick(entry)
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
        self.dropped = 0;
        self.script = Script::new(&self.scene.script);
        self.by_hand.clear();
        self.notice = None;
    }

    fn open_beside(&mut self, offset: usize) {
        let here = SCENES.iter().position(|scene| scene.name == self.scene.name);
        self.open(here.map_or(0, |here| (here + offset) % SCENES.len()));
    }

    /// Opens a built-in scene under its own opening method; mode and look stay as they are.
    fn open(&mut self, index: usize) {
        let scene = Scene::built_in(SCENES[index].name).expect("every name in SCENES is built in");
        let mut lab = Lab::new(scene);
        lab.mode = self.mode;
        lab.display = Display { body: 0, ..self.display.clone() };
        lab.pace = self.pace;
        lab.clock.set_speed_percent(self.clock.speed_percent());
        lab.running = self.running;
        lab.restart();
        *self = lab;
    }

    /// The history of the displayed body in each lane, with the lane's place on the list.
    pub fn plotted(&self) -> impl Iterator<Item = (usize, &History)> {
        let body = self.display.body;
        self.race.entrants().iter().map(move |e| (e.entry, &e.histories[body]))
    }
}
