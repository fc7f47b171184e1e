//! A run in an address: the text of its recording, compressed, after `#v1.`, where no server sees it.

use std::collections::BTreeMap;

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use miniz_oxide::deflate::compress_to_vec_zlib;
use miniz_oxide::inflate::{TINFLStatus, decompress_to_vec_zlib_with_limit};

use crate::scene::{Check, LaneId, MAX_FILE_BYTES, Scene};

/// What stands before the version, which ends at a point.
const MARK: &str = "#v";
/// The version that is written, and the newest that is read.
const VERSION: u32 = 1;
/// What ends the run: a page's own settings follow.
const SETTINGS: char = '&';
/// How hard it is compressed, 0 to 10.
const LEVEL: u8 = 10;

/// The most letters of a link that every system takes as an argument, roughly. A field of the window takes no more.
pub const MAX_LETTERS: usize = 100_000;

/// Why a link leads to no run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinkError {
    /// It was made by a newer release.
    #[error(
        "the link is of {}, and this release reads up to {VERSION}; update regatta",
        format_name(*version)
    )]
    Newer {
        /// Its format; the largest stands for those beyond.
        version: u32,
    },
    /// A part of it is missing or was changed.
    #[error("the link is broken; copy it whole, from #v to its end")]
    Broken,
    /// It unpacks to more than a scene file may have.
    #[error(
        "the link unpacks to more than {MAX_FILE_BYTES} bytes, the most of a scene file; make a shorter run"
    )]
    TooLong,
}

fn format_name(version: u32) -> String {
    match version {
        u32::MAX => "a much newer format".into(),
        version => format!("format {version}"),
    }
}

/// Whether a text is a link, or an address that ends in one.
pub fn is_link(written: &str) -> bool {
    parts(written).is_some()
}

/// The version of a link, and the letters of its run.
fn parts(written: &str) -> Option<(u32, &str)> {
    let (_, after) = written.rsplit_once(MARK)?;
    let (version, run) = after.split_once('.')?;
    let is_version = !version.is_empty() && version.bytes().all(|digit| digit.is_ascii_digit());
    let run = run.split(SETTINGS).next().unwrap_or_default().trim_end();
    // A version of many digits is newer, whichever it is.
    is_version.then(|| (version.parse().unwrap_or(u32::MAX), run))
}

/// The ticks of a run's checks that a link keeps: few that are early too, for a motion may have come to rest at the end.
fn kept(scene: &Scene) -> Vec<u64> {
    let mut ticks: Vec<u64> = scene.checks.iter().map(|check| check.tick).collect();
    ticks.sort_unstable();
    ticks.dedup();
    let places = [0, ticks.len() / 8, ticks.len().saturating_sub(1)];
    match ticks.len() <= places.len() {
        true => ticks,
        false => places.map(|place| ticks[place]).into(),
    }
}

/// The link to a run, `#v1.` and letters that an address may have: its scene with its script, and some of its checks, each
/// lane's last among them.
///
/// # Errors
/// If its text is longer than a scene file may be.
///
/// ```
/// use regatta::run::link;
/// use regatta::scene::Scene;
///
/// let scene = Scene::built_in("spring").expect("a built-in scene");
/// let link = link::to(&scene).expect("a short scene");
/// assert!(link.starts_with("#v1.") && link.len() < 1000);
/// let text = link::text(&link).expect("it was made just now");
/// assert_eq!(Scene::parse("spring", &text).expect("a scene").to_toml(), scene.to_toml());
/// ```
pub fn to(scene: &Scene) -> Result<String, LinkError> {
    let (kept, mut short) = (kept(scene), scene.clone());
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
    // With a checksum: a letter that was changed must not be another run.
    let packed = compress_to_vec_zlib(text.as_bytes(), LEVEL);
    Ok(format!("{MARK}{VERSION}.{}", URL_SAFE_NO_PAD.encode(packed)))
}

/// The text of the scene file that a [link](is_link) holds, or an address that ends in one.
///
/// # Errors
/// Why it holds none. It never unpacks more than a scene file may have.
pub fn text(written: &str) -> Result<String, LinkError> {
    let (version, run) = parts(written).ok_or(LinkError::Broken)?;
    match version {
        VERSION => {}
        0 => return Err(LinkError::Broken),
        _ => return Err(LinkError::Newer { version }),
    }
    let packed = URL_SAFE_NO_PAD.decode(run).map_err(|_| LinkError::Broken)?;
    let bytes =
        decompress_to_vec_zlib_with_limit(&packed, MAX_FILE_BYTES).map_err(|error| match error
            .status
        {
            TINFLStatus::HasMoreOutput => LinkError::TooLong,
            _ => LinkError::Broken,
        })?;
    String::from_utf8(bytes).map_err(|_| LinkError::Broken)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Session;
    use crate::scene::Action;

    #[test]
    fn a_run_comes_back_from_its_address_to_the_bit_whatever_stands_around_it() {
        let mut session = Session::racing(Scene::built_in("harbour").unwrap().into());
        for i in 0..300 {
            session.run(12);
            session.act(Action::Kick(f64::from(i % 7) - 3.0));
        }
        session.run(1);
        let recording = session.recording(session.race().tick());
        let link = to(&recording).unwrap();
        // A minute, with a kick five times a second.
        assert!(link.len() < 8_000, "{} bytes", link.len());
        let around = format!("https://example.org/play/{link}&panels=off&play");
        let read = Scene::parse("link", &text(&around).unwrap()).unwrap();
        let mut again = Session::racing(read.clone().into());
        again.run(session.race().tick());
        assert_eq!(again.race().state_hash(), session.race().state_hash());
        let last = recording.checks.last().unwrap();
        assert!(read.checks.len() == 3 * recording.lanes.len() && read.checks.contains(last));
    }

    #[test]
    fn what_leads_to_no_run_is_refused_in_a_sentence() {
        let link = to(&Scene::built_in("spring").unwrap()).unwrap();
        assert_eq!(text(&link.replace("#v1.", "#v2.")), Err(LinkError::Newer { version: 2 }));
        let far = text(&link.replace("#v1.", "#v99999999999."));
        let far = far.unwrap_err().to_string();
        assert!(far.starts_with("the link is of a much newer format, and this"), "{far}");
        assert!(text(&format!("https://x.org/#video/{link}")).is_ok());
        // Whichever letter is another, it is no other run.
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
}
