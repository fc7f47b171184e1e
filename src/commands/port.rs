//! `regatta port`: finds the settings with which a spring moves the same in every engine.

use clap::builder::RangedU64ValueParser;
use clap::{ArgGroup, Args};

use super::argument::{brief, frequency, number, positive};
use super::error::Error;
use super::help::flowing;
use super::id::{CODE_FORM, Id};
use super::identify::LogArgs;
use super::output::table::TableFormat;
use super::terminal::print_status;
use super::tick_rate::{rate_of_a_log, rate_of_a_step};
use crate::regular_file;
use crate::scene::MAX_SUBSTEPS;
use crate::sim::integrators::{METHODS, Method};
use crate::tools::Rule;
use crate::tools::identify::Identification;
use crate::tools::port;
use crate::tools::port::{
    Approach, DriveLimits, Ported, Setup, UI_SPRINGS, UiSpring, Wish, drive_limits, followers,
    setups,
};
use crate::tools::source_code::CodeForm;

mod report;
mod wish_source;

use wish_source::WishSource;

const ABOUT: &str = "\
For each engine, port finds the settings with which its ticks show the wish:

  --frequency F --damping-ratio R  the motion that a player should see
  --from engine-X:KEY=VALUE,…      the motion of engine X with its own settings; substeps, tick_hz and
                                   mode are keys too
  --from LOG.csv                   the motion in a log, read as by `regatta identify`; a chase gives
                                   settings of followers
  --from lerp:0.1@60fps            a value that chases a target: also lerp-dt:20@30fps,
                                   smooth-damp:SECONDS and half-life:SECONDS
  --from friction:0.9@60fps        a velocity that keeps this fraction in each frame
  --from per-frame-decay:stiffness=0.2,decay=0.85
                                   v = (v + (target - x) * stiffness) * decay; x += v in a frame
  --from swiftui:KEY=VALUE,…       a spring of a user interface; other keys have its library's defaults

Springs of user interfaces, with the version that tests compare each with: {dialects}.

A library that steps by frames is read and set as it moves at --tick-hz frames per second. Each ends a
motion by its own rule of rest: --ends prints when, and the part of the way that is left, over a way of 1.

The frequency is that of the spring without its damping; with a damping ratio d it swings √(1 - d²)
times as fast. The word is

  reached      the engine shows the wish, to rounding
  nearest      it does not; these settings come nearest
  unreachable  its own damping is too strong: its floor is the least damping ratio that it shows at
               this frequency; or it explodes

An engine without substeps, such as Chipmunk and Godot, runs N of them as N ticks of dt / N, made by the
game; in PhysX they are position iterations. With --drive the wish gives the gains of
a drive, as written in --from, and port finds their limits: in the engine's own drive, and in a force of
user code held for --decimation ticks.

Examples:
  regatta port --frequency 2.5Hz --damping-ratio 0.3 --mass 80
  regatta port --frequency 1Hz --to engine-box2d,engine-jolt --tick-hz 50
  regatta port --from spring.csv --tick-hz 60 --format json
  regatta port --from lerp:0.1@60fps --as csharp
  regatta port --from swiftui:duration=0.5,bounce=0.3 --to compose,css
  regatta port --from react-spring:tension=170,friction=26 --to ui --tick-hz 30
  regatta port --from react-native:tension=50,friction=1 --ends";

/// Print settings that make a spring move the same in every engine
#[derive(Debug, Args)]
#[command(after_long_help = flowing(&about()))]
#[command(group = ArgGroup::new("wish").required(true))]
pub(super) struct PortArgs {
    /// The frequency that a player should see
    #[arg(long, value_name = "Hz", group = "wish", value_parser = frequency)]
    #[arg(allow_hyphen_values = true)]
    frequency: Option<f64>,

    /// The damping ratio that a player should see [default: 0]
    ///
    /// At 1 it is critically damped and no longer swings.
    #[arg(long, value_name = "RATIO", value_parser = number)]
    #[arg(allow_negative_numbers = true, requires = "frequency", conflicts_with = "from")]
    damping_ratio: Option<f64>,

    /// The settings of an engine or a user interface, a log, or a chase
    ///
    /// ID:KEY=VALUE,…, LOG.csv, or how a value chases its target.
    #[arg(long, value_name = "SOURCE", group = "wish")]
    from: Option<String>,

    /// The mass on the spring in kg
    #[arg(long, value_name = "kg", default_value = "1", value_parser = positive)]
    #[arg(allow_negative_numbers = true)]
    mass: f64,

    /// Ticks per second of the engines and of a log, frames per second of user interfaces
    ///
    /// [default: 60, or by the times of a log]
    #[arg(long, value_name = "N", value_parser = rate_of_a_log)]
    #[arg(allow_negative_numbers = true)]
    tick_hz: Option<f64>,

    /// The length of a tick, in place of --tick-hz
    #[arg(long = "step", value_name = "s", value_parser = rate_of_a_step, conflicts_with = "tick_hz")]
    #[arg(allow_negative_numbers = true)]
    step_hz: Option<f64>,

    /// Substeps per tick, 1 to 1000 [default: each engine's own]
    #[arg(long, value_name = "N")]
    #[arg(value_parser = RangedU64ValueParser::<u32>::new().range(1..=u64::from(MAX_SUBSTEPS)))]
    substeps: Option<u32>,

    /// Engines and user interfaces, all engines, or all of the others: ui
    ///
    /// [default: all, or ui if --from names one]
    #[arg(long, value_name = "ID,…|all|ui", value_delimiter = ',')]
    #[arg(value_parser = TARGET, hide_possible_values = true)]
    to: Vec<Target>,

    /// When each user interface ends the motion, and how much of the way is left then
    #[arg(long, conflicts_with_all = ["drive", "substeps"])]
    ends: bool,

    /// The limits of a drive with these gains
    #[arg(long)]
    drive: bool,

    /// How many ticks a drive in user code holds its force
    #[arg(long, value_name = "N", default_value = "1", requires = "drive")]
    #[arg(value_parser = RangedU64ValueParser::<u32>::new().range(1..=1000))]
    decimation: u32,

    /// Print the motion as code of your own too: rust, c, cpp, csharp, gdscript, javascript, lua or step
    ///
    /// As a function that moves the same at any frame rate, in text.
    #[arg(long = "as", value_name = "LANGUAGE", value_parser = CODE_FORM, hide_possible_values = true)]
    #[arg(conflicts_with_all = ["drive", "ends"])]
    form: Option<CodeForm>,

    #[command(flatten)]
    read: LogArgs,

    /// The format: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    format: TableFormat,
}

/// An engine or a user interface for which settings are found, or all of one kind.
#[derive(Clone, Copy, Debug)]
enum Target {
    Engines,
    /// An engine, and the id that was asked for, which is its own or that of another engine with the same map.
    Engine(&'static Method, &'static str),
    UiSprings,
    UiSpring(&'static UiSpring),
}

/// Whether the method belongs to an engine whose spring has settings.
fn has_modes(method: &Method) -> bool {
    method.engine.is_some_and(|engine| !engine.modes.is_empty())
}

fn engines() -> impl Iterator<Item = &'static Method> {
    METHODS.iter().filter(|method| has_modes(method))
}

/// Parser for the id of an engine or user interface that has a spring, or for all of one kind.
const TARGET: Id<Target> = Id::new("engine or user interface with a spring", || {
    let dialects = UI_SPRINGS.iter().map(|it| (it.id.into(), Target::UiSpring(it)));
    let all = [("all".into(), Target::Engines), ("ui".into(), Target::UiSprings)];
    let engines = engines().flat_map(|it| {
        let ids = [it.id].into_iter().chain(it.also.iter().copied());
        ids.map(move |id| (id.into(), Target::Engine(it, id)))
    });
    all.into_iter().chain(engines).chain(dialects).collect()
});

/// Ticks per second where none are given.
const USUAL_HZ: f64 = 60.0;

impl PortArgs {
    /// Returns the tick rate in Hz, from either of its options.
    fn tick_hz(&self) -> f64 {
        self.step_hz.or(self.tick_hz).unwrap_or(USUAL_HZ)
    }

    /// Prints an answer and, with `--as`, the code of the motion, which is that of these lines at this frame rate.
    fn print_with_code(
        &self,
        mut text: String,
        lines: impl FnOnce() -> String,
        fps: f64,
    ) -> Result<(), Error> {
        if let (Some(form), TableFormat::Text) = (self.form, self.format) {
            let lines = lines();
            let code = Rule::read(&lines, fps).map_err(|fault| fault.what);
            let code = code.and_then(|rule| rule.code(&lines, form)).map_err(Error::mistake)?;
            text += &format!("\n{}", code.text);
        }
        self.format.print(&text)
    }
}

/// Returns the line of the exact chase.
fn chase(approach: Approach) -> String {
    format!("x += (target - x) * (1.0 - exp(-{:?} * dt))", approach.rate())
}

fn about() -> String {
    let with_version = |dialect: &UiSpring| match dialect.version {
        "" => dialect.id.to_owned(),
        version => format!("{} ({version})", dialect.id),
    };
    let dialects: Vec<String> = UI_SPRINGS.iter().map(with_version).collect();
    ABOUT.replace("{dialects}", &dialects.join(", "))
}

/// The setup of an engine, with its settings. They are `None` if no settings come near the wish.
struct PortedEngine {
    setup: Setup,
    ported: Option<Ported>,
}

/// A drive in an engine. With the engine's first mode, the drive may also be a force in the user's code.
struct Drive {
    setup: Setup,
    limits: Vec<DriveLimits>,
}

/// Whether the setup has the names of an engine that is asked for.
fn is_asked(setup: &Setup, asked: &[Target]) -> bool {
    let asks = |asked: &Target| match asked {
        Target::Engines => true,
        Target::Engine(_, id) => setup.is_of(id),
        Target::UiSprings | Target::UiSpring(_) => false,
    };
    asked.iter().any(asks)
}

/// Returns the dialects, each once.
fn asked_dialects(asked: &[Target]) -> Vec<&'static UiSpring> {
    let asked = asked.iter().flat_map(|asked| match asked {
        Target::UiSprings => UI_SPRINGS,
        Target::UiSpring(dialect) => std::slice::from_ref(*dialect),
        Target::Engines | Target::Engine(..) => &[],
    });
    let mut dialects: Vec<&'static UiSpring> = Vec::new();
    for dialect in asked {
        if !dialects.iter().any(|known| std::ptr::eq(*known, dialect)) {
            dialects.push(dialect);
        }
    }
    dialects
}

pub(super) fn run(args: &PortArgs) -> Result<(), Error> {
    let from = args.from.as_deref().map(|written| {
        WishSource::parse(written, args.tick_hz(), args.mass)
            .map_err(|fault| Error::mistake(format!("--from {}: {fault}", brief(written.as_ref()))))
    });
    let from = from.transpose()?;
    let usual = match from {
        _ if args.ends => Target::UiSprings,
        Some(WishSource::UiSpring { .. }) if !args.drive => Target::UiSprings,
        _ => Target::Engines,
    };
    let (mut tick_hz, mut read, mut frames) = (args.tick_hz(), None, Vec::new());
    let wish = match from {
        Some(WishSource::Approach(..) | WishSource::Friction(_)) if args.drive => {
            return Err(Error::mistake(
                "--drive is for a spring; give --frequency, or settings of an engine in --from",
            ));
        }
        Some(WishSource::Approach(approach, fps)) => {
            let ports = followers(approach, fps);
            let text = report::followers(approach, &ports, args.format);
            return args.print_with_code(text, || chase(approach), args.tick_hz());
        }
        Some(WishSource::Friction(friction)) => {
            let text = report::friction(&friction, args.format);
            let lines = || format!("v *= exp(-{:?} * dt)", friction.rate());
            return args.print_with_code(text, lines, friction.fps);
        }
        Some(WishSource::Engine(settings)) if args.drive => settings.as_given(),
        Some(WishSource::Engine(settings)) => settings.as_visible().map_err(|fault| {
            let written = args.from.as_deref().unwrap_or_default();
            Error::mistake(format!("--from {}: {fault}", brief(written.as_ref())))
        })?,
        Some(WishSource::UiSpring { as_given, .. }) if args.drive => as_given,
        Some(WishSource::UiSpring { shown, note, left, .. }) => {
            note.iter().for_each(|note| print_status(note));
            frames = left;
            shown
        }
        Some(WishSource::Log(path)) => {
            let log = args.read.read(&path, (args.step_hz.or(args.tick_hz), USUAL_HZ))?;
            (tick_hz, read) = (log.tick_hz(), Some(log.taken().clone()));
            let found = args.read.identify(&log, args.mass);
            if let Some(half_life_s) = found.as_ref().and_then(Identification::chase_half_life_s)
                && !args.drive
            {
                let approach = Approach { half_life_s };
                let ports = followers(approach, None);
                let text = report::followers(approach, &ports, args.format);
                return args.print_with_code(text, || chase(approach), tick_hz);
            }
            let seen = found.and_then(|found| found.effective).filter(|seen| seen.omega > 0.0);
            let none = || {
                Error::mistake(format!(
                    "{}: no spring can be seen in it; give --k, log v too, or log for longer",
                    regular_file::table_name(&path)
                ))
            };
            Wish::of(seen.ok_or_else(none)?, args.mass)
        }
        None => Wish {
            frequency_hz: args.frequency.expect("one of the group is given"),
            damping_ratio: args.damping_ratio.unwrap_or(0.0),
            mass_kg: args.mass,
        },
    };
    let asked = if args.to.is_empty() { &[usual][..] } else { &args.to[..] };
    let mut setups = setups(None, tick_hz, args.substeps);
    setups.retain(|setup| is_asked(setup, asked));
    let dialects = asked_dialects(asked);
    for (option, is_given) in [("--drive", args.drive), ("--substeps", args.substeps.is_some())] {
        if is_given && setups.is_empty() || args.drive && !dialects.is_empty() {
            return Err(Error::mistake(format!(
                "{option} is for engines; leave it out, or name one"
            )));
        }
    }
    if args.ends && !setups.is_empty() {
        return Err(Error::mistake("--ends is for user interfaces; name one, or leave --to out"));
    }
    // A drive may have any frequency, because the question is only whether it is stable.
    match setups.is_empty() || args.drive {
        true => wish.check_numbers(tick_hz).map_err(Error::mistake)?,
        false => wish.check(tick_hz).map_err(Error::mistake)?,
    }
    let is_table = args.ends && matches!(args.format, TableFormat::Text);
    let text = if is_table {
        report::ends((&wish, tick_hz), &dialects)
    } else if args.drive {
        let limits = |setup: Setup| {
            let of = |held| drive_limits(setup, wish.joint(), held);
            let modes = setup.method.engine.map_or(&[][..], |engine| engine.modes);
            let is_first = modes.first() == Some(setup.mode);
            let own_force = is_first.then(|| of(Some(args.decimation)));
            Drive { setup, limits: [of(None)].into_iter().chain(own_force).collect() }
        };
        let drives: Vec<Drive> = setups.into_iter().map(limits).collect();
        report::drives((&wish, tick_hz, read.as_ref()), &drives, args.format)
    } else {
        let of = |setup| PortedEngine { setup, ported: port(&wish, setup) };
        let all: Vec<PortedEngine> = setups.into_iter().map(of).collect();
        let of = |it: &'static UiSpring| (it, it.port_of_frames(&wish, &frames, tick_hz));
        let dialects = dialects.into_iter().map(of).collect::<Vec<_>>();
        report::springs((&wish, tick_hz, read.as_ref()), &all, &dialects, args.format)
    };
    let own = UI_SPRINGS.iter().find(|it| it.id == "per-frame").expect("it is in the table");
    args.print_with_code(text, || own.port(&wish, tick_hz).code, tick_hz)
}
