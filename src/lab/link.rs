//! A run in an address: the text of its recording, compressed, after `#v1.`, where no server sees it.

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::{TINFLStatus, decompress_to_vec_with_limit};

use super::scene::{MAX_FILE_BYTES, Scene};

/// What stands before the version, which ends at a point.
const MARK: &str = "#v";
/// The version that is written, and the newest that is read.
const VERSION: u32 = 1;
/// What ends the run: a page's own settings follow.
const SETTINGS: char = '&';
/// How hard it is compressed, 0 to 10.
const LEVEL: u8 = 10;

/// Why a link leads to no run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinkError {
    /// It was made by a newer release.
    #[error(
        "the link is of format {version}, and this release reads up to {VERSION}; update regatta"
    )]
    Newer {
        /// Its format.
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

/// Whether a text is a link, or an address that ends in one.
pub fn is_link(written: &str) -> bool {
    parts(written).is_some()
}

/// The version of a link, and what follows it.
fn parts(written: &str) -> Option<(u32, &str)> {
    let (_, after) = written.split_once(MARK)?;
    let (version, run) = after.split_once('.')?;
    Some((version.parse().ok()?, run))
}

/// The link to a run, `#v1.` and letters that an address may have: its scene with its script, and of its checks the last.
///
/// ```
/// use regatta::lab::{Scene, link};
///
/// let scene = Scene::built_in("spring").expect("a built-in scene");
/// let link = link::to(&scene);
/// assert!(link.starts_with("#v1.") && link.len() < 1000);
/// let text = link::text(&link).expect("it was made just now");
/// assert_eq!(Scene::parse("spring", &text).expect("a scene").to_toml(), scene.to_toml());
/// ```
pub fn to(scene: &Scene) -> String {
    let mut scene = scene.clone();
    let last = scene.checks.iter().map(|check| check.tick).max();
    scene.checks.retain(|check| Some(check.tick) == last);
    let packed = compress_to_vec(scene.to_toml().as_bytes(), LEVEL);
    format!("{MARK}{VERSION}.{}", URL_SAFE_NO_PAD.encode(packed))
}

/// The text of the scene file that a [link](is_link) holds, or an address that ends in one.
///
/// # Errors
/// Why it holds none. It never unpacks more than a scene file may have.
pub fn text(written: &str) -> Result<String, LinkError> {
    let (version, run) = parts(written).ok_or(LinkError::Broken)?;
    if version > VERSION {
        return Err(LinkError::Newer { version });
    }
    let run = run.split(SETTINGS).next().unwrap_or_default().trim_end();
    let packed = URL_SAFE_NO_PAD.decode(run).map_err(|_| LinkError::Broken)?;
    let bytes =
        decompress_to_vec_with_limit(&packed, MAX_FILE_BYTES).map_err(|error| {
            match error.status {
                TINFLStatus::HasMoreOutput => LinkError::TooLong,
                _ => LinkError::Broken,
            }
        })?;
    String::from_utf8(bytes).map_err(|_| LinkError::Broken)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{Action, Session};

    #[test]
    fn a_run_comes_back_from_its_address_to_the_bit_whatever_stands_around_it() {
        let mut session = Session::racing(Scene::built_in("harbour").unwrap().into());
        for i in 0..300 {
            session.run(12);
            session.act(Action::Kick(f64::from(i % 7) - 3.0));
        }
        session.run(1);
        let recording = session.recording(session.race().tick());
        let link = to(&recording);
        // A minute, with a kick five times a second.
        assert!(link.len() < 8_000, "{} bytes", link.len());
        let around = format!("https://example.org/play/{link}&panels=off&play");
        let read = Scene::parse("link", &text(&around).unwrap()).unwrap();
        let mut again = Session::racing(read.clone().into());
        again.run(session.race().tick());
        assert_eq!(again.race().state_hash(), session.race().state_hash());
        let last = recording.checks.last().unwrap();
        assert!(read.checks.len() == recording.lanes.len() && read.checks.contains(last));
    }

    #[test]
    fn what_leads_to_no_run_is_refused_in_a_sentence() {
        let link = to(&Scene::built_in("spring").unwrap());
        assert_eq!(text(&link.replace("#v1.", "#v2.")), Err(LinkError::Newer { version: 2 }));
        for broken in ["#v1.", "#v1.%%%", "#v1.AAAA", &link[..link.len() / 2], "spring.toml"] {
            assert_eq!(text(broken), Err(LinkError::Broken), "{broken}");
        }
        let bomb = compress_to_vec(&vec![b' '; 64 << 20], LEVEL);
        let bomb = format!("#v1.{}", URL_SAFE_NO_PAD.encode(bomb));
        assert_eq!(text(&bomb), Err(LinkError::TooLong));
        assert!(!is_link("a#b.toml") && !is_link("spring") && is_link("x#v9.y"));
    }
}
