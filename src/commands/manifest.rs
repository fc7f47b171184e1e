//! `manifest.json` describes a capture, so that `regatta verify` can judge it later.
//!
//! The file is UTF-8 JSON beside the frames. It appears whole, after the frames that it lists. Its numbers are exact,
//! because floats are the shortest decimals that read back to the same bits. This is [`SCHEMA`] 2:
//!
//! - `schema`: the number of this description. `regatta`: the version of the program that drew.
//! - `recording`: the TOML of the scene, with the command line applied. Its last `[[check]]` tables are the states of
//!   the lanes that ran, at the start, at each tick that is a multiple of `mark_every`, and at the end. A long run of
//!   many lanes has only some of these states, and always those of the end.
//! - `drawing`: all else on which the frames depend.
//!   - `scene`: the name of the scene. `scene_hash`: the hash of its file, without the command line.
//!   - `own_checks`: how many `[[check]]` tables of `recording` are the scene's own. They come first.
//!   - `race`: whether all lanes race. If not, the `selected` method is shown solo. `null` selects the scene's opening
//!     method, or among many lanes the best one.
//!   - `frames`: the requested number of frames. `fps`: frames per second. `size`: width and height of a frame in
//!     pixels. `scale`: pixels per point.
//!   - `panels`: whether panels are shown. `instrument` and `cloud`: the requested ones, if any. `motion`: whether
//!     trails fade and the camera glides.
//!   - `theme`: present only if it is `light`. `loop`: the trace of the loop lab, if the lab is shown. `mark_every`:
//!     number of ticks between two states.
//! - `settings_hash`: the hash of `recording` and `drawing`, as a list in JSON without spaces.
//! - `adapter`: what drew: `name`, `driver`, `driver_info`, `backend`, `kind`. Our own code is called `regatta`, of
//!   kind `Cpu`. Its `driver_info` has the instructions by which letters were filled, which may change a level of their
//!   pixels. All else of its frames is the same on every machine.
//! - `complete`: `false` if the capture was interrupted.
//! - `frames`: for each frame its `file`, the `tick` reached, the drawn part of the next tick as `alpha`, numerator
//!   and denominator, and `pixels`, the hash of its RGBA bytes.
//! - `lanes`: each lane at the end. It has its `method`, its `substeps`, the `hash` of its state, and the tick at which
//!   its first body `halted`, or `null`. Each of its `bodies` has its `name`, the tick at which it `halted` or `null`,
//!   and every metric of `regatta list metrics` against the exact solution. A metric that has no meaning for the body
//!   is `null`.
//!
//! `regatta verify` recomputes all of it, and compares, except `regatta` and `adapter`: no later program can know what
//! drew then.
//!
//! A lane's `hash` is [`Race::lane_hashes`](crate::run::Race::lane_hashes). The other hashes are 64 bits of XXH3
//! ([`fingerprint`]). All hashes are hexadecimal. There is no seed, because nothing in a run is random.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use xxhash_rust::xxh3::xxh3_64;

/// Number of the schema that is described above. Manifests with another number cannot be judged.
pub const SCHEMA: u32 = 2;

/// Maximum size of a manifest that is read, in bytes. It is twice that of a capture of a million frames.
pub(super) const MAX_BYTES: usize = 512 << 20;

/// File name of the manifest.
pub const FILE_NAME: &str = "manifest.json";

/// The contents of a manifest.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the module describes every field")]
pub struct Manifest {
    pub schema: u32,
    pub regatta: String,
    pub recording: String,
    pub drawing: Drawing,
    pub settings_hash: String,
    pub adapter: Adapter,
    pub complete: bool,
    pub frames: Vec<FrameEntry>,
    pub lanes: Vec<Value>,
}

/// All on which the frames depend besides the recording.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the module describes every field")]
pub struct Drawing {
    pub scene: String,
    pub scene_hash: String,
    pub own_checks: usize,
    pub race: bool,
    /// The trace on which the loop lab is shown.
    #[serde(default, rename = "loop", skip_serializing_if = "Option::is_none")]
    pub loop_trace: Option<String>,
    pub selected: Option<String>,
    pub frames: u32,
    pub fps: u32,
    pub size: [u32; 2],
    pub scale: f64,
    pub panels: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub instrument: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cloud: Option<String>,
    pub motion: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub theme: Option<String>,
    pub mark_every: u64,
}

/// Our own code or the graphics adapter that drew the frames.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the module describes every field")]
pub struct Adapter {
    pub name: String,
    pub driver: String,
    pub driver_info: String,
    pub backend: String,
    pub kind: String,
}

/// A frame of the capture.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the module describes every field")]
pub struct FrameEntry {
    pub file: String,
    pub tick: u64,
    pub alpha: [u64; 2],
    pub pixels: String,
}

impl Manifest {
    /// Returns the hash by which an altered run or drawing is recognised.
    pub fn hash(&self) -> String {
        let text = serde_json::to_string(&(&self.recording, &self.drawing));
        fingerprint(text.expect("all keys are strings").as_bytes())
    }

    /// Returns the text of the file. Each entry of a list has a line of its own, so that two manifests can be compared
    /// line by line.
    pub fn to_text(&self) -> String {
        let value = serde_json::to_value(self).expect("all keys are strings");
        let mut text = String::new();
        lay_out(&value, 0, &mut text);
        text.push('\n');
        text
    }
}

/// Breaks the objects and lists of the two outer levels into lines.
fn lay_out(value: &Value, depth: usize, text: &mut String) {
    let indent = "  ".repeat(depth + 1);
    let mut separator = "\n";
    match value {
        Value::Object(entries) if depth < 2 && !entries.is_empty() => {
            text.push('{');
            for (key, value) in entries {
                text.push_str(&format!("{separator}{indent}{}: ", Value::from(key.as_str())));
                // Each entry of a list takes one line.
                lay_out(value, depth + 1, text);
                separator = ",\n";
            }
            text.push_str(&format!("\n{}}}", &indent[2..]));
        }
        Value::Array(entries) if depth < 2 && !entries.is_empty() => {
            text.push('[');
            for value in entries {
                text.push_str(&format!("{separator}{indent}{value}"));
                separator = ",\n";
            }
            text.push_str(&format!("\n{}]", &indent[2..]));
        }
        value => text.push_str(&value.to_string()),
    }
}

/// Returns a hash of a text or of pixels, which this and other programs can compare later. It is XXH3 of `bytes`, with
/// 64 bits and the seed 0, as 16 hexadecimal digits.
pub fn fingerprint(bytes: &[u8]) -> String {
    format!("{:016x}", xxh3_64(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fingerprint_matches_the_reference_vectors() {
        // The hash is one of the reference implementation's own test vectors.
        assert_eq!(fingerprint(b""), "2d06800538d394c2");
    }
}
