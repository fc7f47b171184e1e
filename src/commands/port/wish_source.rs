//! Parser of `--from`, which gives settings of an engine or of a user interface, a log, or a value that chases its
//! target.

use std::path::PathBuf;

use super::{TARGET, Target, USUAL_HZ};
use crate::scene::{MAX_SUBSTEPS, clip};
use crate::sim::integrators::{JointMode, JointQuantity, Method, Setting};
use crate::sim::number::significant;
use crate::tools::port::{Approach, Friction, Key, Setup, UiSpring, Wish, setups};

/// The source of a wish.
pub(super) enum WishSource {
    /// Settings of an engine.
    Engine(EngineSettings),
    /// Settings of a user interface. `shown` is the motion that the interface shows at its frame rate, and `as_given`
    /// that of a spring with these numbers, from which the interface may differ, as `note` says. `left` is the fraction
    /// of the way that is left at each frame, if the interface steps by them.
    UiSpring { shown: Wish, as_given: Wish, note: Option<String>, left: Vec<f64> },
    /// A velocity of which a constant part remains after each frame.
    Friction(Friction),
    /// A value that chases its target, and the frame rate if it has one.
    Approach(Approach, Option<f64>),
    /// The path of a log.
    Log(PathBuf),
}

/// Maximum number of frames of a motion without an end.
const MAX_FRAMES: usize = 10_000;

/// Parses a number, with this unit or without it.
fn with_unit(written: &str, unit: &str) -> Result<f64, String> {
    let number = written.strip_suffix(unit).unwrap_or(written).trim_end();
    let found = number.parse::<f64>().ok().filter(|number| number.is_finite());
    found.ok_or_else(|| match unit {
        "" => format!("\"{}\" is no number without a unit", clip(written)),
        unit => format!("\"{}\" is no number of {unit}; write it as 2.5{unit}", clip(written)),
    })
}

fn above_0(written: &str, unit: &str, what: &str) -> Result<f64, String> {
    let found = with_unit(written, unit)?;
    if found > 0.0 { Ok(found) } else { Err(format!("{what} is {written}; it must be above 0")) }
}

/// Splits an argument into a setting before the `@`, and a number of frames per second after it.
fn with_frames<'a>(written: &'a str, example: &str) -> Result<(&'a str, f64), String> {
    let parts = written.split_once('@');
    let (setting, fps) = parts.ok_or_else(|| format!("give the frames too: {example}"))?;
    Ok((setting, above_0(fps, "fps", "the rate of frames")?))
}

impl WishSource {
    /// Parses the argument of `--from`, for a tick rate in hertz and a body with this mass in kg.
    pub(super) fn parse(written: &str, tick_hz: f64, mass_kg: f64) -> Result<Self, String> {
        let Some((head, rest)) = written.split_once(':') else {
            return match TARGET.find(written) {
                Ok(Target::Engine(method, id)) => {
                    Err(format!("give its settings too: {}", example(method, id)))
                }
                Ok(Target::UiSpring(dialect)) => of_ui_spring(dialect, "", tick_hz, mass_kg),
                _ => Ok(WishSource::Log(written.into())),
            };
        };
        match head {
            "lerp" => {
                let (part, fps) = with_frames(rest, "lerp:0.1@60fps")?;
                let part = with_unit(part, "")?;
                let fits = part > 0.0 && part < 1.0;
                let wrong = || format!("the part is {part}; it must be between 0 and 1");
                Ok(WishSource::Approach(
                    Approach::of_lerp(fits.then_some(part).ok_or_else(wrong)?, fps),
                    Some(fps),
                ))
            }
            "lerp-dt" => {
                let (rate, fps) = with_frames(rest, "lerp-dt:20@30fps")?;
                let rate = above_0(rate, "", "the rate")?;
                let part = rate / fps;
                if part >= 1.0 {
                    let end = if part > 2.0 { "grows" } else { "overshoots" };
                    let end = if part == 1.0 { "is there in one frame" } else { end };
                    return Err(format!(
                        "{rate} at {fps} frames per second {end}; give a rate below the frames"
                    ));
                }
                Ok(WishSource::Approach(Approach::of_lerp(part, fps), Some(fps)))
            }
            "friction" => {
                let (kept, fps) = with_frames(rest, "friction:0.9@60fps")?;
                let kept = with_unit(kept, "")?;
                let fits = kept > 0.0 && kept < 1.0;
                let wrong = || format!("{kept} is kept; it must be between 0 and 1");
                Ok(WishSource::Friction(Friction {
                    kept: fits.then_some(kept).ok_or_else(wrong)?,
                    fps,
                }))
            }
            "per-frame-decay" => of_decay(rest, tick_hz, mass_kg),
            "smooth-damp" => {
                let seconds = above_0(rest, "s", "the smoothing time")?;
                Ok(WishSource::Approach(Approach::of_smooth_time(seconds), None))
            }
            "half-life" => {
                let half_life_s = above_0(rest, "s", "the half-life")?;
                Ok(WishSource::Approach(Approach { half_life_s }, None))
            }
            // A single letter before the colon is the drive of a path.
            _ if head.len() == 1 => Ok(WishSource::Log(written.into())),
            _ => match TARGET.find(head)? {
                Target::Engine(method, id) => {
                    of_engine((method, id), rest, tick_hz, mass_kg).map(WishSource::Engine)
                }
                Target::UiSpring(dialect) => of_ui_spring(dialect, rest, tick_hz, mass_kg),
                _ => Err(format!("{head} is all of a kind; name one")),
            },
        }
    }
}

/// Returns the motion of a value for which `v = (v + (target - x) * stiffness) * decay; x += v` is computed once a
/// frame.
fn of_decay(written: &str, fps: f64, mass_kg: f64) -> Result<WishSource, String> {
    let how = "write per-frame-decay:stiffness=0.2,decay=0.85, where decay is what is left of v";
    let mut values = [None; 2];
    for pair in written.split(',') {
        let (key, value) = pair.split_once('=').ok_or(how)?;
        let index = ["stiffness", "decay"].iter().position(|known| *known == key.trim());
        let index = index.ok_or(how)?;
        if values[index].replace(above_0(value.trim(), "", key)?).is_some() {
            return Err(format!("{key} is given twice"));
        }
    }
    let [Some(stiffness), Some(decay)] = values else { return Err(how.into()) };
    let wish = Wish::of_decay_per_frame([stiffness, decay], fps, mass_kg)?;
    let frame = |[left, v]: &[f64; 2]| {
        let v = (v + left * stiffness) * decay;
        Some([left - v, v])
    };
    let frames = std::iter::successors(Some([1.0, 0.0]), frame).take(MAX_FRAMES);
    let left = frames.map(|[left, _]| left).collect();
    Ok(WishSource::UiSpring { shown: wish, as_given: wish, note: None, left })
}

/// Shows how to write the settings of an engine.
fn example(method: &'static Method, id: &str) -> String {
    let mode = modes(method, id).next().expect("an engine with a spring");
    let [stiffness, damping] = mode.settings().map(|setting| setting.name);
    format!("{id}:{stiffness}=NUMBER,{damping}=NUMBER")
}

/// Returns the modes of the engine with this id, which is that of the card or of another engine with the same map.
fn modes(method: &'static Method, id: &str) -> impl Iterator<Item = &'static JointMode> {
    let setups = setups(Some(&[method]), USUAL_HZ, None).into_iter();
    setups.filter(move |setup| setup.is_of(id)).map(|setup| setup.mode)
}

/// Returns the motion of a user interface with settings of the form `key=value,…`. A setting that is missing has the
/// library's own value, except for a mass of 1, which is `mass_kg`.
fn of_ui_spring(
    dialect: &UiSpring,
    written: &str,
    frame_hz: f64,
    mass_kg: f64,
) -> Result<WishSource, String> {
    let usual = |key: &Key| match (key.name, key.usual) {
        ("mass", 1.0) => mass_kg,
        (_, usual) => usual,
    };
    let mut values: Vec<f64> = dialect.keys.iter().map(usual).collect();
    let mut given = Vec::new();
    for pair in written.split(',').filter(|_| !written.is_empty()) {
        let (key, value) = pair.split_once('=').unwrap_or((pair, ""));
        let names: Vec<&str> = dialect.keys.iter().map(|key| key.name).collect();
        let index = names.iter().position(|name| *name == key.trim()).ok_or_else(|| {
            let value = |key: &Key| if key.switch.is_some() { "true" } else { "NUMBER" };
            let pairs = dialect.keys.iter().map(|key| format!("{}={}", key.name, value(key)));
            let pairs = pairs.collect::<Vec<_>>().join(",");
            format!("{} has no key \"{}\"; write {pairs}", dialect.id, clip(key.trim()))
        })?;
        if given.contains(&index) {
            return Err(format!("{key} is given twice"));
        }
        given.push(index);
        values[index] = match (&dialect.keys[index].switch, value.trim()) {
            (Some(_), "true") => 1.0,
            (Some(_), "false") => 0.0,
            (Some(_), other) => return Err(format!("{key} is \"{other}\"; write true or false")),
            (None, number) => with_unit(number, "").map_err(|fault| format!("{key}: {fault}"))?,
        };
    }
    let of_mass = |wish| if dialect.has_mass() { wish } else { Wish { mass_kg, ..wish } };
    let [as_given, shown] =
        [dialect.as_given(&values)?, dialect.shown(&values, frame_hz)?].map(of_mass);
    let left = match dialect.steps() {
        "exact" => Vec::new(),
        _ => dialect.run(&values, frame_hz)?.0,
    };
    let said = |wish: Wish| {
        let [hz, ratio] = [wish.frequency_hz, wish.damping_ratio].map(|x| significant(x, 4));
        (format!("{hz} Hz, damping ratio {ratio}"), ratio)
    };
    let ((shows, ratio), (says, given)) = (said(shown), said(as_given));
    let css = UiSpring::of_id("css").expect("it is in the table");
    let ahead_s = css.port_of_frames(&shown, &left, frame_hz).delay_s.map(|delay_s| -delay_s);
    let ahead = ahead_s.filter(|ahead_s| ahead_s.abs() > 1e-3).map_or(String::new(), |ahead_s| {
        let way = if ahead_s > 0.0 { "ahead of" } else { "behind" };
        format!("; it runs {} ms {way} such a spring", significant(1e3 * ahead_s.abs(), 2))
    });
    let switch = dialect.keys.iter().find(|key| key.switch.is_some());
    let note = (shows != says).then(|| match (dialect.id, switch) {
        (id, Some(Key { name, .. })) => {
            format!("{id} shows damping ratio {ratio} here; with {name}=true it is {given}")
        }
        (id, None) => {
            let by_frames = format!(" at {frame_hz} frames per second");
            let at = if dialect.steps() == "exact" { "" } else { &by_frames };
            format!("{id} shows {shows}{at}; its numbers say {says}{ahead}")
        }
    });
    Ok(WishSource::UiSpring { shown, as_given, note, left })
}

/// The settings of a spring in an engine.
pub(super) struct EngineSettings {
    setup: Setup,
    /// Stiffness in 1/s² and damping in 1/s, each per unit of mass.
    joint: [f64; 2],
    mass_kg: f64,
}

impl EngineSettings {
    /// Returns the motion of the spring by its equation of motion.
    pub(super) fn as_given(&self) -> Wish {
        Wish::of_joint(self.joint, self.mass_kg)
    }

    /// Returns the motion that the engine shows with these settings.
    pub(super) fn as_visible(&self) -> Result<Wish, String> {
        let Setup { method, tick_hz, substeps, .. } = self.setup;
        let seen = self.setup.visible_motion(self.joint).ok_or_else(|| {
            format!("nothing swings so in {} ×{substeps} at {tick_hz} Hz; tick faster", method.id)
        })?;
        let wish = Wish::of(seen, self.mass_kg);
        if wish.damping_ratio < -1e-9 {
            let ratio = wish.damping_ratio;
            return Err(format!(
                "so set, {} ×{substeps} at {tick_hz} Hz gains energy: its damping ratio is {ratio:.4}; damp more, or tick faster",
                method.id
            ));
        }
        Ok(Wish { damping_ratio: wish.damping_ratio.max(0.0), ..wish })
    }
}

/// Parses the settings of an engine in the form `key=value,…`.
fn of_engine(
    (method, id): (&'static Method, &'static str),
    written: &str,
    tick_hz: f64,
    mass_kg: f64,
) -> Result<EngineSettings, String> {
    let modes: Vec<&JointMode> = modes(method, id).collect();
    let (mut mode, mut tick_hz, mut substeps) = (None, tick_hz, method.default_substeps);
    let mut values: Vec<(&str, &str)> = Vec::new();
    for pair in written.split(',') {
        let wrong = || format!("\"{}\" is no KEY=VALUE; write {}", clip(pair), example(method, id));
        let (key, value) = pair.split_once('=').ok_or_else(wrong)?;
        match key.trim() {
            "mode" => {
                let known = modes.iter().copied().find(|mode| mode.id == value);
                let ids = || modes.iter().map(|mode| mode.id).collect::<Vec<_>>().join(", ");
                mode = Some(
                    known.ok_or_else(|| format!("no mode {}; there are {}", clip(value), ids()))?,
                );
            }
            "tick_hz" => tick_hz = above_0(value, "Hz", "tick_hz")?,
            "substeps" => {
                let number = value.parse().ok().filter(|n| (1..=MAX_SUBSTEPS).contains(n));
                substeps = number.ok_or_else(|| {
                    format!("substeps is {}; give 1 to {MAX_SUBSTEPS}", clip(value))
                })?;
            }
            key if values.iter().any(|(known, _)| *known == key) => {
                return Err(format!("{key} is given twice"));
            }
            key => values.push((key, value)),
        }
    }
    let names = |mode: &JointMode| mode.settings().map(|setting| setting.name);
    let tried = || modes.iter().copied().filter(|known| mode.is_none_or(|mode| mode == *known));
    let fits = |mode: &&JointMode| values.iter().all(|(key, _)| names(mode).contains(key));
    let Some(mode) = tried().find(fits) else {
        let known: Vec<String> = tried().map(|mode| names(mode).join(" and ")).collect();
        let keys: Vec<&str> = values.iter().map(|(key, _)| *key).collect();
        let (keys, known) = (clip(&keys.join(" and ")), known.join(", or "));
        return Err(format!("{id} has no {keys}; it has {known}"));
    };
    let [stiffness, damping] = mode.settings();
    let value = |setting: Setting| {
        let given = values.iter().find(|(key, _)| *key == setting.name);
        given.map(|(_, value)| with_unit(value, setting.quantity.unit())).transpose()
    };
    let first = value(stiffness).map_err(|fault| format!("{}: {fault}", stiffness.name))?;
    let second = value(damping).map_err(|fault| format!("{}: {fault}", damping.name))?;
    let first = first.ok_or_else(|| format!("give {} too", stiffness.name))?;
    let second = second.unwrap_or(damping.usual);
    if first <= 0.0 || second < 0.0 {
        let (name, value, wanted) = match first <= 0.0 {
            true => (stiffness.name, first, "above 0"),
            false => (damping.name, second, "0 or more"),
        };
        return Err(format!("{name} is {value}; it must be {wanted}"));
    }
    match damping.quantity {
        JointQuantity::Undamped if second > 0.0 => {
            let is_damped = |other: &&JointMode| other.damping.quantity != JointQuantity::Undamped;
            let other = modes.iter().copied().find(is_damped);
            let other = other.map_or(String::new(), |it| format!(", or mode={}", it.id));
            return Err(format!(
                "{} is {second}, with which mode={} of {id} is not linear; give 0{other}",
                damping.name, mode.id
            ));
        }
        JointQuantity::MotorDamping if second == 0.0 => {
            return Err(format!(
                "{} is 0, with which {id} never moves, at any tick rate; give more, which damps less",
                damping.name
            ));
        }
        _ => {}
    }
    let setup = Setup { method, mode, tick_hz, substeps };
    Ok(EngineSettings { setup, joint: mode.joint([first, second], mass_kg), mass_kg })
}
