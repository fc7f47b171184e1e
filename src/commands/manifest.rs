//! `manifest.json` describes a capture, so that `regatta verify` can judge it later.
//!
//! The file is UTF-8 JSON beside the frames. It appears whole, after the frames that it lists. Its numbers are exact,
//! because floats are the shortest decimals that read back to the same bits. This is [`SCHEMA`] 1:
//!
//! - `schema`: the number of this description. `regatta`: the version of the program that drew.
//! - `settings`: everything on which the run depends.
//!   - `scene`: `name`, `text` (the TOML) and the text's `hash`.
//!   - `lanes`: the scene's lanes, with the command line applied. Each has a `method` and its `substeps`. If the
//!     scene gives them, it also has its `tolerance` and its `joint`, the spring setting of an engine.
//!   - `methods`: a person's own methods, if any. Each has its `id`, and its lines as `step`.
//!   - `race`: whether all lanes race. If not, the `selected` method is shown solo. `null` selects the scene's opening
//!     method, or among many lanes the best one.
//!   - `tick_hz`: the tick rate at the start. It is a number if it is a decimal, else a ratio such as `"60000/1001"`.
//!   - `frames`: the requested number of frames. `fps`: frames per second. `size`: width and height of a frame in
//!     pixels. `scale`: pixels per point.
//!   - `panels`: whether panels are shown. `instrument` and `cloud`: the requested ones, if any. `motion`: whether
//!     trails fade and the camera glides.
//!   - `theme`: present only if it is `light`. `loop`: the trace of the loop lab, if the lab is shown. `mark_every`:
//!     number of ticks between two marks.
//! - `settings_hash`: the hash of `settings` as JSON without spaces.
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
//! - `marks`: the state of each lane at the end, and at each `tick` that is a multiple of `mark_every`. Each of the
//!   `lanes` has its `hash` and, body by body, `q` and `v`. JSON has no numbers that are not finite, so these are the
//!   strings `inf`, `-inf` and `NaN`.
//!
//! `regatta verify` recomputes all of it, and compares, except `regatta` and `adapter`: no later program can know what
//! drew then.
//!
//! A lane's `hash` is [`Race::lane_hashes`](crate::run::Race::lane_hashes). The other hashes are 64 bits of XXH3
//! ([`fingerprint`]). All hashes are hexadecimal. There is no seed, because nothing in a run is random.

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Map, Value};
use xxhash_rust::xxh3::xxh3_64;

use crate::run::diff::is_same_number;
use crate::sim::TickRate;

/// Number of the schema that is described above. Manifests with another number cannot be judged.
pub const SCHEMA: u32 = 1;

/// Maximum size of a manifest that is read, in bytes. It is twice that of a capture of a million frames with its marks.
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
    pub settings: Settings,
    pub settings_hash: String,
    pub adapter: Adapter,
    pub complete: bool,
    pub frames: Vec<FrameEntry>,
    pub lanes: Vec<LaneEnd>,
    pub marks: Vec<Mark>,
}

/// Everything on which a run depends.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the module describes every field")]
pub struct Settings {
    pub scene: SceneText,
    pub lanes: Vec<LaneEntry>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub methods: Vec<OwnEntry>,
    pub race: bool,
    /// The trace on which the loop lab is shown.
    #[serde(default, rename = "loop", skip_serializing_if = "Option::is_none")]
    pub loop_trace: Option<String>,
    pub selected: Option<String>,
    #[serde(with = "exact")]
    pub tick_hz: TickRate,
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

/// Conversion of a tick rate to JSON that reads back as the same rate. It is a number if the rate is a decimal, or else
/// text such as `1/0.015`.
mod exact {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

    use crate::sim::TickRate;

    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Written {
        Whole(u32),
        Decimal(f64),
        Ratio(String),
    }

    pub(super) fn serialize<S: Serializer>(rate: &TickRate, to: S) -> Result<S::Ok, S::Error> {
        match rate.decimal_hz() {
            Some(_) => rate.serialize(to),
            None => to.collect_str(rate),
        }
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<TickRate, D::Error> {
        let rate = match Written::deserialize(from)? {
            Written::Whole(hz) => Ok(hz.into()),
            Written::Decimal(hz) => hz.try_into(),
            Written::Ratio(text) => text.parse(),
        };
        rate.map_err(de::Error::custom)
    }
}

impl Settings {
    /// Returns the hash by which altered settings are recognised.
    pub fn hash(&self) -> String {
        let text = serde_json::to_string(self).expect("all keys are strings");
        fingerprint(text.as_bytes())
    }
}

/// A person's own method.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the module describes every field")]
pub struct OwnEntry {
    pub id: String,
    pub step: String,
    /// The exact frame rate of the author, if the lines are a rule. A method has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fps: Option<String>,
}

/// The scene file, as it was at the time of the capture.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the module describes every field")]
pub struct SceneText {
    pub name: String,
    pub hash: String,
    pub text: String,
}

/// A lane of the scene.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the module describes every field")]
pub struct LaneEntry {
    pub method: String,
    pub substeps: u32,
    /// Tolerance that the scene gives in place of the method's own, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Frequency in hertz and damping ratio of the engine's spring setting, if the scene gives them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<[f64; 2]>,
    /// Rule for impacts, if it is not the default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impact: Option<String>,
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

/// A lane at the end of the capture.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the module describes every field")]
pub struct LaneEnd {
    pub method: String,
    pub substeps: u32,
    pub hash: String,
    pub halted: Option<u64>,
    /// The name, the halt and the metrics of each body.
    pub bodies: Vec<Map<String, Value>>,
}

/// The state of all lanes at a tick.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the module describes every field")]
pub struct Mark {
    pub tick: u64,
    pub lanes: Vec<LaneMark>,
}

/// The state of a lane at a tick.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the module describes every field")]
pub struct LaneMark {
    pub hash: String,
    #[serde(serialize_with = "write_rows", deserialize_with = "read_rows")]
    pub q: Vec<Vec<f64>>,
    #[serde(serialize_with = "write_rows", deserialize_with = "read_rows")]
    pub v: Vec<Vec<f64>>,
}

impl LaneMark {
    /// Whether both marks have the same state. NaN equals NaN here.
    pub fn is_same(&self, other: &Self) -> bool {
        let rows = |a: &[Vec<f64>], b: &[Vec<f64>]| {
            let values = |a: &Vec<f64>, b: &Vec<f64>| {
                a.len() == b.len() && a.iter().zip(b).all(|(&a, &b)| is_same_number(a, b))
            };
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| values(a, b))
        };
        self.hash == other.hash && rows(&self.q, &other.q) && rows(&self.v, &other.v)
    }
}

impl Manifest {
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

/// A number in JSON, or a word for infinity or NaN, because JSON has no such numbers.
#[derive(Deserialize, Serialize)]
#[serde(untagged)]
enum AnyNumber {
    Number(f64),
    Word(String),
}

fn write_rows<S: Serializer>(rows: &[Vec<f64>], to: S) -> Result<S::Ok, S::Error> {
    let value = |&number: &f64| {
        if number.is_finite() {
            AnyNumber::Number(number)
        } else {
            AnyNumber::Word(number.to_string())
        }
    };
    to.collect_seq(rows.iter().map(|row| row.iter().map(value).collect::<Vec<_>>()))
}

fn read_rows<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Vec<f64>>, D::Error> {
    let number = |value| match value {
        AnyNumber::Number(number) => Ok(number),
        AnyNumber::Word(word) => match &*word {
            "inf" => Ok(f64::INFINITY),
            "-inf" => Ok(f64::NEG_INFINITY),
            "NaN" => Ok(f64::NAN),
            _ => Err(serde::de::Error::custom(format!("{word:?} is no number"))),
        },
    };
    let rows = Vec::<Vec<AnyNumber>>::deserialize(from)?;
    rows.into_iter().map(|row| row.into_iter().map(number).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fingerprint_matches_the_reference_vectors() {
        // The hash is one of the reference implementation's own test vectors.
        assert_eq!(fingerprint(b""), "2d06800538d394c2");
    }

    #[test]
    fn every_value_survives_writing_and_reading() {
        let q = [0.1, -0.0, f64::MAX, 5e-324, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
        let mark = LaneMark { hash: "0".into(), q: vec![q.to_vec(), vec![]], v: vec![] };
        let text = serde_json::to_string(&mark).unwrap();
        assert!(text.contains(r#"5e-324,"inf","-inf","NaN"]"#), "{text}");
        let read: LaneMark = serde_json::from_str(&text).unwrap();
        assert!(read.is_same(&mark));
        assert_eq!(serde_json::to_string(&read).unwrap(), text);
        let mut other = mark.clone();
        other.q[0][6] = 1.0;
        assert!(!other.is_same(&mark));
    }

    #[test]
    fn a_tick_rate_survives_writing_as_number_or_text() {
        #[derive(Debug, PartialEq, Deserialize, Serialize)]
        struct Rate(#[serde(with = "exact")] TickRate);
        for (rate, json) in [
            ("60", "60"),
            ("66.667", "66.667"),
            ("9999.999999999", "9999.999999999"),
            ("1/0.015", "\"1/0.015\""),
            ("60000/1001", "\"60000/1001\""),
        ] {
            let rate = Rate(rate.parse().unwrap());
            assert_eq!(serde_json::to_string(&rate).unwrap(), json);
            assert_eq!(serde_json::from_str::<Rate>(json).unwrap(), rate);
        }
        for bad in ["1e9", "-1", "\"fast\"", "59.94005994006"] {
            let error = serde_json::from_str::<Rate>(bad).unwrap_err().to_string();
            assert!(error.contains("give a rate from 0.01 to 10000 Hz"), "{bad}: {error}");
        }
    }

    #[test]
    fn a_word_in_place_of_a_number_is_quoted_in_the_error() {
        let text = r#"{"hash":"0","q":[["many"]],"v":[]}"#;
        let error = serde_json::from_str::<LaneMark>(text).unwrap_err().to_string();
        assert!(error.contains(r#""many" is no number"#), "{error}");
    }
}
