//! The loops of engines and libraries by name, and loops of a person's own, each a file of lines.

use std::sync::{Arc, LazyLock};

use super::policy::{Build, Engine, PolicyCard, RENDER_TICK};
use crate::run::race::Interpolation;
use crate::sim::law::{ExpressionFault, LoopText};

/// Lists the engines, each with its file in `assets/engine-loops`.
macro_rules! engines {
    ($($id:literal),+ $(,)?) => {
        [$(($id, include_str!(concat!("../../assets/engine-loops/", $id, ".loop")))),+]
    };
}

/// Every engine and library whose loop is known, with its lines.
pub static ENGINES: LazyLock<Vec<Arc<PolicyCard>>> = LazyLock::new(|| {
    let files = engines![
        "arcade",
        "babylon-lockstep",
        "bevy",
        "cannon-es",
        "colyseus-timer",
        "excalibur",
        "excalibur-max60",
        "fixedstep",
        "framesync",
        "godot",
        "gsap",
        "gsap-fps60",
        "kaplay-fixed",
        "kivy-interval",
        "kontra",
        "littlejs",
        "love",
        "mainloop-js",
        "matter-runner",
        "melonjs",
        "p2-es",
        "panda3d-bullet",
        "phaser",
        "phaser-arcade",
        "phaser-arcade-limit60",
        "phaser-limit60",
        "pixi",
        "pixi-max60",
        "playcanvas",
        "pygame-tick",
        "pyglet-interval",
        "r3-rapier",
        "three-timer",
        "unity",
        "unreal",
    ];
    let read = |(id, text)| own_loop(id, text).expect("a file that the tests read");
    files.into_iter().map(read).collect()
});

/// Returns the card of the lines of a text under an id, with the claims of its remarks.
pub(super) fn card(id: &str, text: &str, lines: LoopText) -> PolicyCard {
    let (shows, has_fixed_tick) = (lines.shows(), lines.has_fixed_tick());
    let claim = |key| LoopText::claim(text, key).to_owned();
    let or = |key, other: &str| if claim(key).is_empty() { other.to_owned() } else { claim(key) };
    let constants = LoopText::constants(text).into_iter();
    let is_sign = |c: char| c.is_ascii_digit() || " .-*/".contains(c);
    let settings = constants.filter(|(_, _, value)| value.chars().all(is_sign));
    let settings: Vec<String> =
        settings.map(|(name, _, value)| format!("{name}={value}")).collect();
    let (name, has_render_tick) = (or("name", id), claim("draws") == RENDER_TICK);
    let drawn = Interpolation::ALL.into_iter().find(|it| it.name() == claim("draws"));
    let plain = if shows && !has_render_tick { Interpolation::Linear } else { Interpolation::Raw };
    PolicyCard {
        id: id.to_owned(),
        formula: claim("gives"),
        has_max_ticks: settings.iter().any(|setting| setting.starts_with("max_ticks=")),
        constants: settings.join(", "),
        odd_frames: claim("caveat"),
        users: or("users", &name),
        name,
        source: claim("known"),
        drawing: drawn.unwrap_or(plain),
        has_render_tick,
        has_fixed_tick,
        needs_exact_clock: has_fixed_tick && !shows && claim("steady").is_empty(),
        is_usual: !claim("usual").is_empty(),
        build: Build::Lines(Arc::new(lines)),
        engine: Some(Engine {
            version: claim("version"),
            caveat: claim("caveat"),
            advice: claim("set"),
        }),
    }
}

/// Returns the loop of a person's own lines under an id, such as the name of their file.
///
/// # Errors
/// The first fault of the lines.
///
/// ```
/// use regatta_loops::own_loop;
///
/// let raw = own_loop("mine", "memory owed = 0; owed += dt\nwhile owed >= H { tick 1; owed -= H }").unwrap();
/// assert!(raw.has_fixed_tick);
/// assert!(own_loop("mine", "owed = dt").is_err());
/// ```
pub fn own_loop(id: &str, text: &str) -> Result<Arc<PolicyCard>, ExpressionFault> {
    Ok(Arc::new(card(id, text, LoopText::read(text)?)))
}

/// Returns the engine with this id.
pub fn engine(id: &str) -> Option<&'static Arc<PolicyCard>> {
    ENGINES.iter().find(|card| card.id == id)
}

impl PolicyCard {
    /// Returns the same loop of lines with constants set to other numbers.
    ///
    /// # Errors
    /// The name of the first unknown constant, with the names of the known ones.
    pub fn with_settings(
        self: &Arc<Self>,
        settings: &[(String, f64)],
    ) -> Result<Arc<Self>, (String, Vec<String>)> {
        let is_set = self.engine.is_some() && !settings.is_empty();
        let Some(text) = self.lines().filter(|_| is_set) else {
            return match settings.first() {
                Some((name, _)) => Err((name.clone(), Vec::new())),
                None => Ok(self.clone()),
            };
        };
        let mut text = text.to_owned();
        for (name, value) in settings {
            text = LoopText::set(&text, name, *value).map_err(|known| (name.clone(), known))?;
        }
        let card = own_loop(&self.id, &text);
        Ok(card.expect("a number in the place of another leaves the lines valid"))
    }
}
