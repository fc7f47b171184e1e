//! A run in an address. After `#v1.` follows the compressed text of the run's recording, where no server sees it. A run
//! of a built-in scene is named instead, as in `#scene=spring&method=rk4`.

use std::collections::BTreeMap;
use std::fmt;

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use miniz_oxide::deflate::compress_to_vec_zlib;
use miniz_oxide::inflate::{TINFLStatus, decompress_to_vec_zlib_with_limit};

use super::Session;
use super::race::{Author, Mode, lanes_that_race};
use crate::scene::{Action, Check, LaneId, LaneSpec, MAX_FILE_BYTES, SCENES, Scene, nearest};
use crate::sim::TickRate;
use crate::sim::integrators::{METHODS, Method, method};

/// First letter of a link.
const MARK: char = '#';
/// Letter before the version of a packed run; a point ends the version.
const VERSION_MARK: char = 'v';
/// The version written, and the newest one read.
const VERSION: u32 = 1;
/// The letter that ends a packed run and each setting.
const END: char = '&';
/// Settings that name a run, like the options of `regatta play`.
const SCENE: &str = "scene";
const METHOD: &str = "method";
const TICK_HZ: &str = "tick-hz";
const RACE: &str = "race";
/// Settings of a page, which belong to no run.
const OF_A_PAGE: [&str; 6] = ["tick", "play", "panels", "theme", "instrument", "loop"];
/// Maximum number of letters of an unknown word that a message quotes.
const QUOTED: usize = 40;
/// Compression level, 0 to 10.
const LEVEL: u8 = 10;

/// Length of the longest link in letters, which is roughly the longest argument that every system accepts. The window's
/// field accepts no longer link either.
pub const MAX_LETTERS: usize = 100_000;

/// The reason why a link leads to no run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinkError {
    /// A newer release made the link.
    #[error(
        "the link is of {}, and this release reads up to {VERSION}; update regatta",
        format_name(*version)
    )]
    Newer {
        /// The link's format, or [`u32::MAX`] for a number that is too large.
        version: u32,
    },
    /// A part of the link is missing or was changed.
    #[error("the link is broken; copy it whole, from #v to its end")]
    Broken,
    /// The link unpacks to more bytes than a scene file may have.
    #[error(
        "the link unpacks to more than {MAX_FILE_BYTES} bytes, the most of a scene file; make a shorter run"
    )]
    TooLong,
    /// The link contains an unknown name.
    #[error("the link asks for {thing} {written:?}, and there is none; {remedy}")]
    Unknown {
        /// Kind of the name, which is a setting, or the setting whose value the name is.
        thing: String,
        /// The name as written.
        written: String,
        /// The remedy.
        remedy: String,
    },
    /// The link names a method that cannot step its scene.
    #[error("the link names a method that cannot run: {reason}; name another")]
    Refused {
        /// The reason why the method cannot step the scene.
        reason: String,
    },
}

impl LinkError {
    /// Returns the error for a name that is missing from `known`.
    pub fn unknown(thing: &str, written: &str, known: &[&str]) -> Self {
        let remedy = match nearest(written, known.iter().map(|name| (*name, *name))) {
            Some(meant) => format!("did you mean {meant:?}?"),
            None if known.len() <= 2 * OF_A_PAGE.len() => format!("write {}", known.join(", ")),
            None => "it may be of a newer release".into(),
        };
        let written = written.chars().take(QUOTED).collect();
        Self::Unknown { thing: thing.to_owned(), written, remedy }
    }
}

fn format_name(version: u32) -> String {
    match version {
        u32::MAX => "a much newer format".into(),
        version => format!("format {version}"),
    }
}

/// Whether a text is a link, or an address that ends in one.
pub fn is_link(written: &str) -> bool {
    let written = percent_decoded(written);
    let Some((_, fragment)) = written.rsplit_once(MARK) else { return false };
    let names = [SCENE, METHOD, TICK_HZ];
    let is_named = |part: &str| part.split_once('=').is_some_and(|(key, _)| names.contains(&key));
    fragment.split(END).any(|part| packed_run(part).is_some() || is_named(part))
}

/// A parsed link.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Link {
    /// The text after the mark, without punctuation around the link.
    fragment: String,
    /// Version and letters of a packed run.
    packed: Option<(u32, String)>,
    /// Keys and values of the settings that name a run, in order. Below are those of the settings for the page.
    names: Vec<(String, String)>,
    settings: Vec<(String, String)>,
}

/// A run that a link names.
#[derive(Clone, Debug)]
pub struct Named {
    /// The scene with the link's tick rate. If the link names several methods, these are the scene's lanes.
    pub scene: Scene,
    /// The methods, in order.
    pub methods: Vec<&'static Method>,
    /// Whether the scene's lanes race.
    pub races: bool,
}

impl Link {
    /// Parses a link, or an address that ends in one. An address without a link gives an empty link. Percent codes are
    /// decoded, and punctuation at the end is removed, which may come from a sentence around the address.
    ///
    /// # Errors
    /// If a setting is unknown, or no run follows the version.
    pub fn read(written: &str) -> Result<Self, LinkError> {
        let written = percent_decoded(written);
        let fragment = written.rsplit_once(MARK).map_or("", |(_, fragment)| fragment);
        // No run and no setting ends in one of these letters.
        let is_around = |end: char| !(end.is_ascii_alphanumeric() || end == '-' || end == '_');
        let fragment = fragment.trim_end_matches(is_around);
        let mut link = Self { fragment: fragment.to_owned(), ..Self::default() };
        for part in fragment.split(END) {
            if let Some((version, run)) = packed_run(part) {
                link.packed = Some((version, run.to_owned()));
                continue;
            }
            let version = part.strip_prefix(VERSION_MARK).unwrap_or_default();
            if version.starts_with(|first: char| first.is_ascii_digit()) {
                return Err(LinkError::Broken);
            }
            let (key, value) = part.split_once('=').unwrap_or((part, ""));
            match key {
                "" => continue,
                SCENE | METHOD | TICK_HZ | RACE => &mut link.names,
                key if OF_A_PAGE.contains(&key) => &mut link.settings,
                key => {
                    let known = [&[SCENE, METHOD, TICK_HZ, RACE], &OF_A_PAGE[..]].concat();
                    return Err(LinkError::unknown("setting", key, &known));
                }
            }
            .push((key.to_owned(), value.trim().to_owned()));
        }
        match link.names.first().filter(|_| link.packed.is_some()) {
            // A packed run already has its scene and methods.
            Some((name, _)) => Err(LinkError::unknown("setting", name, &OF_A_PAGE)),
            None => Ok(link),
        }
    }

    /// Returns the keys and values of the page's settings, in order.
    pub fn settings(&self) -> impl Iterator<Item = (&str, &str)> {
        self.settings.iter().map(|(key, value)| (&**key, &**value))
    }

    /// Returns the tick at which to pause; `None` for a run that starts or resumes by itself.
    pub fn tick(&self) -> Option<u64> {
        let value =
            |wanted| self.settings().find(|(key, _)| *key == wanted).map(|(_, value)| value);
        value("tick").filter(|_| value("play").is_none())?.parse().ok()
    }

    /// Whether the link holds a whole run.
    pub fn is_packed(&self) -> bool {
        self.packed.is_some()
    }

    /// Whether the link names a scene, a method, a rate or a race.
    pub fn names_anything(&self) -> bool {
        !self.names.is_empty()
    }

    /// Whether the link names lanes that race.
    pub fn asks_to_race(&self) -> bool {
        self.names.iter().any(|(key, _)| key == RACE)
    }

    /// Returns the run that the link names. The default scene is the first of [`SCENES`].
    ///
    /// # Errors
    /// If the scene, a method or the rate is unknown, or if a method cannot step the scene.
    pub fn named(&self) -> Result<Named, LinkError> {
        let of = |wanted| self.names.iter().filter(move |(key, _)| key == wanted);
        let values = |wanted| of(wanted).flat_map(|(_, value)| value.split(','));
        let name = values(SCENE).last().unwrap_or(SCENES[0].name);
        let names = || SCENES.iter().map(|scene| scene.name).collect::<Vec<_>>();
        let mut scene =
            Scene::built_in(name).ok_or_else(|| LinkError::unknown(SCENE, name, &names()))?;
        let ids = || METHODS.iter().map(|method| method.id).collect::<Vec<_>>();
        let known = |id: &str| method(id).ok_or_else(|| LinkError::unknown(METHOD, id, &ids()));
        let methods: Vec<&'static Method> = values(METHOD).map(known).collect::<Result<_, _>>()?;
        if let Some(refusal) = methods.iter().find_map(|method| scene.refusal(method)) {
            return Err(LinkError::Refused { reason: refusal.to_string() });
        }
        if let Some(hz) = values(TICK_HZ).last() {
            let range = format!("{} to {}", TickRate::MIN, TickRate::MAX);
            let known = hz.parse::<TickRate>();
            scene =
                scene.at_tick_hz(known.map_err(|_| LinkError::unknown(TICK_HZ, hz, &[&range]))?);
        }
        let races = self.asks_to_race() || methods.len() > 1;
        Ok(Named { scene: scene.with_methods(&methods), methods, races })
    }

    /// Returns the text of the scene file in the link, or of the run that the link names.
    ///
    /// # Errors
    /// If the link is broken, too new or too long. The text never grows beyond the size that a scene file may have.
    pub fn text(&self) -> Result<String, LinkError> {
        let Some((version, run)) = &self.packed else {
            return Ok(self.named()?.into_scene().to_toml());
        };
        match *version {
            VERSION => {}
            0 => return Err(LinkError::Broken),
            version => return Err(LinkError::Newer { version }),
        }
        let packed = URL_SAFE_NO_PAD.decode(run).map_err(|_| LinkError::Broken)?;
        let bytes = decompress_to_vec_zlib_with_limit(&packed, MAX_FILE_BYTES).map_err(
            |error| match error.status {
                TINFLStatus::HasMoreOutput => LinkError::TooLong,
                _ => LinkError::Broken,
            },
        )?;
        String::from_utf8(bytes).map_err(|_| LinkError::Broken)
    }
}

impl fmt::Display for Link {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{MARK}{}", self.fragment)
    }
}

impl Named {
    /// Returns the scene with the opening method and mode that the link asks for.
    fn into_scene(self) -> Scene {
        let Self { mut scene, methods, races } = self;
        scene.opens_as_race |= races;
        if let [method] = methods[..]
            && method != scene.opening_lane().method
        {
            if scene.lanes.iter().all(|lane| lane.method != method) {
                scene.lanes.push(LaneSpec::plain(method));
            }
            // The scene's hint is about its former opening method.
            (scene.opening_method, scene.hint) = (Some(method), None);
        }
        scene
    }
}

/// Returns the version and letters of a packed run.
fn packed_run(part: &str) -> Option<(u32, &str)> {
    let (version, run) = part.strip_prefix(VERSION_MARK)?.split_once('.')?;
    let is_version = !version.is_empty() && version.bytes().all(|digit| digit.is_ascii_digit());
    // A version with too many digits is a newer one, too.
    is_version.then(|| (version.parse().unwrap_or(u32::MAX), run))
}

/// Decodes the percent codes that a messenger may add.
fn percent_decoded(written: &str) -> String {
    let mut parts = written.split('%');
    let mut bytes = parts.next().unwrap_or_default().as_bytes().to_vec();
    for part in parts {
        let code = part.get(..2).filter(|code| code.bytes().all(|digit| digit.is_ascii_hexdigit()));
        match code.and_then(|code| u8::from_str_radix(code, 16).ok()) {
            Some(byte) => bytes.extend([&[byte], &part.as_bytes()[2..]].concat()),
            None => bytes.extend([b"%", part.as_bytes()].concat()),
        }
    }
    String::from_utf8(bytes).unwrap_or_else(|_| written.to_owned())
}

/// Returns the ticks of the checks that a link keeps. Early checks matter, because a motion may rest at the end.
fn kept_ticks(scene: &Scene) -> Vec<u64> {
    let mut ticks: Vec<u64> = scene.checks.iter().map(|check| check.tick).collect();
    ticks.sort_unstable();
    ticks.dedup();
    let places = [0, ticks.len() / 8, ticks.len().saturating_sub(1)];
    match ticks.len() <= places.len() {
        true => ticks,
        false => places.map(|place| ticks[place]).into(),
    }
}

/// Returns the link to a run, which is `#v1.` and letters that an address may have. The link holds the scene with its
/// script, and a few of its checks, among them the last check of each lane.
///
/// # Errors
/// If the run's text is longer than a scene file may be.
///
/// ```
/// use regatta_run::link;
/// use regatta_scene::Scene;
///
/// let scene = Scene::built_in("spring").expect("a built-in scene");
/// let link = link::link_to_run(&scene).expect("a short scene");
/// assert!(link.starts_with("#v1.") && link.len() < 1000);
/// let text = link::text(&link).expect("it was made just now");
/// assert_eq!(Scene::parse("spring", &text).expect("a scene").to_toml(), scene.to_toml());
/// ```
pub fn link_to_run(scene: &Scene) -> Result<String, LinkError> {
    let (kept, mut short) = (kept_ticks(scene), scene.clone());
    let mut last = BTreeMap::<LaneId, u64>::new();
    for Check { tick, lane, .. } in &scene.checks {
        let last = last.entry(*lane).or_default();
        *last = (*last).max(*tick);
    }
    let stays = |check: &Check| kept.contains(&check.tick) || last[&check.lane] == check.tick;
    short.checks.retain(stays);
    let text = short.to_toml();
    if text.len() > MAX_FILE_BYTES {
        return Err(LinkError::TooLong);
    }
    // The checksum prevents a changed letter from opening another run.
    let packed = compress_to_vec_zlib(text.as_bytes(), LEVEL);
    Ok(format!("{MARK}{VERSION_MARK}{VERSION}.{}", URL_SAFE_NO_PAD.encode(packed)))
}

/// Returns the link to the built-in scene of this name.
pub fn to_built_in(name: &str) -> String {
    format!("{MARK}{SCENE}={name}")
}

/// Returns the link that names a run from its start, at any present tick; `None` if the run needs a packed link. Only
/// an unedited built-in scene can be named, under methods and at a rate that a link can name.
pub fn link_by_name(session: &Session) -> Option<String> {
    let (scene, start) = (session.scene(), session.start());
    let built_in = Scene::built_in(&scene.name).filter(|_| scene.in_rust().is_none())?;
    let as_built_in = Scene {
        lanes: built_in.lanes.clone(),
        opening_method: built_in.opening_method,
        tick_hz: built_in.tick_hz,
        opens_as_race: built_in.opens_as_race,
        opens_in_bands: built_in.opens_in_bands,
        equal_cost: built_in.equal_cost,
        hint: built_in.hint.clone(),
        ..(**scene).clone()
    };
    if as_built_in.to_toml() != built_in.to_toml() {
        return None;
    }
    let mut flown: Vec<LaneSpec> = start.entrants().iter().map(|entrant| entrant.spec).collect();
    for row in session.journal().rows().iter().filter(|row| row.author == Author::Person) {
        match (row.tick, &row.action, start.mode()) {
            (0, Action::Method(method), Mode::Solo) => {
                flown = start.methods().iter().filter(|it| it.method == *method).copied().collect();
                flown.truncate(1);
            }
            _ => return None,
        }
    }
    let methods: Vec<&'static Method> = flown.iter().map(|spec| spec.method).collect();
    let (names, race) = match start.mode() {
        Mode::Race if flown == lanes_that_race(&built_in) => (false, !built_in.opens_as_race),
        Mode::Race if flown.len() > 1 && flown == built_in.lanes_of(&methods) => (true, false),
        Mode::Race => return None,
        Mode::Solo => {
            let opened = built_in.clone().with_methods(&methods);
            let list = opened.method_list();
            let listed = list.into_iter().find(|spec| Some(&spec.method) == methods.first());
            let is_menu = scene.lanes == lanes_that_race(&opened) || scene.lanes == opened.lanes;
            if !is_menu || listed.is_none() || listed != flown.first().copied() {
                return None;
            }
            let is_opening = methods[0] == built_in.opening_lane().method;
            (!is_opening || built_in.opens_as_race, false)
        }
    };
    let mut link = to_built_in(&built_in.name);
    if names {
        let ids: Vec<&str> = methods.iter().map(|method| method.id).collect();
        link += &format!("{END}{METHOD}={}", ids.join(","));
    }
    if start.tick_hz() != built_in.tick_hz {
        link += &format!("{END}{TICK_HZ}={}", start.tick_hz());
    }
    if race {
        link += &format!("{END}{RACE}");
    }
    Some(link)
}

/// Returns the text of the scene file in a [link](is_link), or in an address that ends in one.
///
/// # Errors
/// If there is no link, or if it is broken, too new or too long. The text never grows beyond the size that a scene file
/// may have.
pub fn text(written: &str) -> Result<String, LinkError> {
    if is_link(written) { Link::read(written)?.text() } else { Err(LinkError::Broken) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Session;
    use crate::scene::Action;

    #[test]
    fn a_run_survives_its_link_to_the_bit_in_any_surrounding_text() {
        let mut session = Session::racing(Scene::built_in("harbour").unwrap().into());
        for i in 0..300 {
            session.run(12);
            session.act(Action::Kick(f64::from(i % 7) - 3.0));
        }
        session.run(1);
        let recording = session.recording(session.race().tick());
        let link = link_to_run(&recording).unwrap();
        // The run is a minute with five kicks per second.
        assert!(link.len() < 8_000, "{} bytes", link.len());
        let around = format!("https://example.org/play/{link}&panels=off&play");
        for end in ["", ")", ").", ",", ">", " ", "\u{201d}"] {
            let coded = around.replace('.', "%2E").replace('&', "%26").replace('#', "%23");
            for around in [&around, &link, &coded] {
                assert_eq!(text(&format!("{around}{end}")), text(&link), "{end}");
            }
        }
        let read = Scene::parse("link", &text(&around).unwrap()).unwrap();
        let mut again = Session::racing(read.clone().into());
        again.run(session.race().tick());
        assert_eq!(again.race().state_hash(), session.race().state_hash());
        let last = recording.checks.last().unwrap();
        assert!(read.checks.len() == 3 * recording.lanes.len() && read.checks.contains(last));
    }

    #[test]
    fn a_broken_link_is_refused_in_a_sentence() {
        let link = link_to_run(&Scene::built_in("spring").unwrap()).unwrap();
        assert_eq!(text(&link.replace("#v1.", "#v2.")), Err(LinkError::Newer { version: 2 }));
        let far = text(&link.replace("#v1.", "#v99999999999."));
        let far = far.unwrap_err().to_string();
        assert!(far.starts_with("the link is of a much newer format, and this"), "{far}");
        assert!(text(&format!("https://x.org/#video/{link}")).is_ok());
        // No single changed letter opens another run.
        for place in "#v1.".len()..link.len() {
            let other = if link.as_bytes()[place] == b'A' { "B" } else { "A" };
            let mut changed = link.clone();
            changed.replace_range(place..=place, other);
            assert!(text(&changed).is_err(), "{place}");
        }
        for broken in
            ["#v1.", "#v0.AAAA", "#v1.%%%", "#v1.AAAA", &link[..link.len() / 2], "spring.toml"]
        {
            assert_eq!(text(broken), Err(LinkError::Broken), "{broken}");
        }
        let bomb = compress_to_vec_zlib(&vec![b' '; 64 << 20], LEVEL);
        let bomb = format!("#v1.{}", URL_SAFE_NO_PAD.encode(bomb));
        assert_eq!(text(&bomb), Err(LinkError::TooLong));
        assert!(!is_link("a#b.toml") && !is_link("spring") && is_link("x#v9.y"));
    }

    /// Returns a built-in scene's run at its start, either solo under the method with this menu index, or as a race.
    fn begun(name: &str, entry: Option<usize>) -> Session {
        let scene = Scene::built_in(name).unwrap();
        match entry {
            Some(entry) => Session::solo(scene.into(), entry),
            None => Session::racing(scene.into()),
        }
    }

    #[test]
    fn a_short_link_opens_the_same_run_of_every_scene() {
        for built_in in SCENES {
            let scene = Scene::built_in(built_in.name).unwrap();
            let solos = (0..scene.method_list().len()).step_by(3).map(Some);
            for entry in solos.chain([None]) {
                let run = begun(built_in.name, entry);
                let Some(link) = link_by_name(&run) else {
                    // Lanes at equal cost, or two lanes of one method, cannot be named.
                    assert!(entry.is_none() || scene.lanes.len() > 1, "{}", built_in.name);
                    continue;
                };
                assert!(link.len() < 80, "{link}");
                let named = Link::read(&link).unwrap().named().unwrap();
                assert_eq!(
                    named.races || named.scene.opens_as_race && named.methods.is_empty(),
                    run.mode() == Mode::Race,
                    "{link}"
                );
                let read = Scene::parse("link", &text(&link).unwrap()).unwrap();
                let again = match run.mode() {
                    Mode::Race => Session::racing(read.into()),
                    Mode::Solo => {
                        let opening = *read.opening_lane();
                        let entry = read.method_list().iter().position(|it| *it == opening);
                        Session::solo(read.into(), entry.unwrap())
                    }
                };
                assert_eq!(again.race().state_hash(), run.race().state_hash(), "{link}");
                assert!(link_by_name(&again).is_none(), "a file of another name is not the scene");
            }
        }
    }

    #[test]
    fn only_an_unedited_run_has_a_short_link() {
        let named = |change: &dyn Fn(&mut Session)| {
            let mut run = begun("spring", Some(0));
            change(&mut run);
            link_by_name(&run)
        };
        let rk4 = method("rk4").unwrap();
        assert_eq!(named(&|run| run.run(90)).unwrap(), "#scene=spring");
        let switched = named(&|run| _ = run.act(Action::Method(rk4)));
        assert_eq!(switched.unwrap(), "#scene=spring&method=rk4");
        assert_eq!(named(&|run| _ = run.act(Action::Kick(1.0))), None);
        let late = |run: &mut Session| {
            run.run(1);
            run.act(Action::Method(rk4));
        };
        assert_eq!(named(&late), None);
        let slow = Scene { tick_hz: 30.into(), ..Scene::built_in("spring").unwrap() };
        let race = Session::racing(slow.clone().into());
        assert_eq!(link_by_name(&race).unwrap(), "#scene=spring&tick-hz=30&race");
        let short = Scene { seconds: 3.0, ..slow.clone() };
        assert_eq!(link_by_name(&Session::racing(short.into())), None);
        let two = Scene { lanes: slow.lanes[..2].to_vec(), ..slow.clone() };
        assert_eq!(
            link_by_name(&Session::solo(two.into(), 0)),
            None,
            "other methods stand beside it"
        );
        let mut heavy = slow;
        heavy.bodies[0].values[0] *= 2.0;
        assert_eq!(link_by_name(&Session::racing(heavy.into())), None);
    }

    #[test]
    fn an_unknown_word_of_a_link_is_refused_by_its_name() {
        for (written, word, meant) in [
            ("#scen=spring", "setting \"scen\"", "did you mean \"scene\"?"),
            ("#scene=Spring", "scene \"Spring\"", "did you mean \"spring\"?"),
            ("#scene=spring&method=rk5", "method \"rk5\"", "did you mean \"rk4\"?"),
            ("#scene=xyzzy", "scene \"xyzzy\"", "newer release"),
            ("#scene=spring&tick-hz=0", "tick-hz \"0\"", "write 0.01 to 10000"),
            ("#scene=spring&xyzzy", "setting \"xyzzy\"", "write scene, method,"),
            ("#v1.AAAA&scene=spring", "setting \"scene\"", "write tick, play"),
        ] {
            let found = Link::read(written).and_then(|link| link.named().map(|_| link));
            let refused = found.unwrap_err().to_string();
            assert!(refused.contains(word) && refused.contains(meant), "{refused}");
            assert!(refused.starts_with("the link ") && !refused.contains('\n'), "{refused}");
        }
        let refused = Link::read("#scene=spring&method=lerp-per-frame").unwrap().named();
        assert!(matches!(refused, Err(LinkError::Refused { .. })));
        assert_eq!(Link::read("#v1"), Err(LinkError::Broken));
        assert_eq!(Link::read("https://example.org/page"), Ok(Link::default()));
        for coded in ["#scene%3Dspring%26method%3Drk4", "<https://x.org/#scene=spring&method=rk4>."]
        {
            let named = Link::read(coded).unwrap().named().unwrap();
            let ids: Vec<_> = named.methods.iter().map(|method| method.id).collect();
            assert_eq!((&*named.scene.name, &ids[..]), ("spring", &["rk4"][..]), "{coded}");
            assert!(is_link(coded) && text(coded).is_ok());
            let own = Link::read(coded).unwrap().to_string();
            assert_eq!(own, "#scene=spring&method=rk4");
        }
        assert_eq!(percent_decoded("100 %, %zz, %C3%A9 and %"), "100 %, %zz, é and %");
    }
}
