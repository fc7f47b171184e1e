//! Reads a `[[method]]`, which is a method in its author's own lines.

use std::path::Path;

use super::errors::{SceneErrors, position};
use super::keys::{Key, quoted, rate};
use super::nearest::words;
use super::table::{Table, TextBlock};
use super::wanted::{Field, Wanted};
use super::{LaneSpec, MAX_LANES};
use crate::sim::integrators::Method;
use crate::sim::law::{ExpressionFault, Remedy, StepText};
use crate::sim::{MAX_OWN_ID_CHARS, TickRate, check_own_id, own_method, own_method_id, own_rule};

/// Name of the table array. The top of a file has a key of the same name, for the method with which the scene opens.
pub(super) const OWN: &str = "method";

const ID: Field =
    Field::required("id", "its name in lanes and commands", Wanted::Text(MAX_OWN_ID_CHARS));

/// A partly read own method.
#[derive(Default)]
pub(super) struct OwnDraft {
    id: Option<String>,
    step: Option<TextBlock>,
    fps: Option<TickRate>,
}

/// The keys of an own method.
pub(super) static OWN_KEYS: [Key<OwnDraft, Method>; 3] = [
    Key {
        field: ID,
        read: |own, row, field| own.id = row.text(field),
        write: |method| Some(quoted(method.id)),
    },
    Key {
        field: Field::optional(
            "fps",
            "for a rule: the frames per second for which it was written",
            Wanted::TickRate,
        ),
        read: |own, row, field| own.fps = row.tick_rate(field),
        write: |method| method.rule_fps().map(rate),
    },
    Key {
        field: Field::required("step", "its lines (`regatta help step`)", Wanted::Lines),
        read: |own, row, field| own.step = row.text_block(field),
        write: |method| method.own_text().map(lines),
    },
];

impl LaneSpec {
    /// Creates the lane of a method in a person's own lines, from the bytes of a file. The method's name is the stem of
    /// `file`.
    ///
    /// # Errors
    /// Fails with the first fault of the lines, or of the name.
    pub fn from_step(file: &str, bytes: &[u8]) -> Result<Self, SceneErrors> {
        let text = str::from_utf8(bytes)
            .map_err(|error| SceneErrors::not_utf8(file, bytes, error.valid_up_to()))?;
        let id = own_method_id(&Path::new(file).file_stem().unwrap_or_default().to_string_lossy());
        let of_name = |[what, remedy]: [String; 2]| {
            let what = format!("the file's name is the method's, and {what}");
            ExpressionFault { span: 0..0, what, remedy: Remedy::Words(remedy) }
        };
        let method = check_own_id(&id).map_err(of_name).and_then(|()| own_method(&id, text));
        method.map(Self::plain).map_err(|fault| SceneErrors::of_step(file, text, fault))
    }
}

/// Whether these are the lines of a rule, which call no acceleration.
pub fn is_rule(bytes: &[u8]) -> bool {
    let read = str::from_utf8(bytes).ok().and_then(|text| StepText::read(text).ok());
    read.is_some_and(|text| text.acceleration_at().is_none())
}

/// Returns the method or the rule of these lines.
///
/// # Errors
/// Fails with the first fault.
fn own(id: &str, text: &str, fps: Option<TickRate>) -> Result<&'static Method, ExpressionFault> {
    match fps {
        Some(fps) => own_rule(id, text, fps),
        None => own_method(id, text),
    }
}

/// Returns an own method or rule as a table of a scene file, after an empty line.
pub fn own_table(method: &Method) -> String {
    format!("\n[[{OWN}]]\n{}", Key::lines(&OWN_KEYS, method))
}

/// Writes lines as a TOML string of several lines.
fn lines(text: &str) -> String {
    let escaped = |sign: char| match sign {
        '\\' => "\\\\".to_owned(),
        '"' => "\\\"".to_owned(),
        sign if sign.is_control() && !"\n\t".contains(sign) => format!("\\u{:04X}", sign as u32),
        sign => sign.to_string(),
    };
    format!("\"\"\"\n{}\"\"\"", text.chars().map(escaped).collect::<String>())
}

/// Reads a file's own methods, so that its other keys can name them.
pub(super) fn read_own(text: &str, top: &mut Table<'_>) {
    if !top.has_tables(OWN) {
        return;
    }
    let rows = top.rows(OWN);
    if let Some(row) = rows.get(MAX_LANES) {
        let what = format!("the scene has {} methods of its own", rows.len());
        top.report_fault(row.header.clone(), what, format!("keep at most {MAX_LANES}"));
    }
    let mut ids: Vec<(String, usize)> = Vec::new();
    for mut row in rows.into_iter().take(MAX_LANES) {
        let mut draft = OwnDraft::default();
        Key::read_all(&OWN_KEYS, &mut draft, &mut row);
        let at = row.span(ID.key);
        if let Some(id) = draft.id {
            let first = ids.iter().find(|(other, _)| *other == id);
            let method = match (check_own_id(&id), first, draft.step) {
                (Err([what, remedy]), ..) => {
                    row.report_fault(at.clone(), what, remedy);
                    None
                }
                (_, Some((_, first)), _) => {
                    let (line, _) = position(text, *first);
                    let what = format!("the method on line {line} is called {id:?} already");
                    row.report_fault(at.clone(), what, "give it another `id`");
                    None
                }
                (.., None) => None,
                (.., Some(step)) => match own(&id, &step.text, draft.fps) {
                    Ok(method) => Some(method),
                    Err(fault) => {
                        row.report_fault(
                            step.span_in_file(&fault.span),
                            fault.what,
                            words(fault.remedy),
                        );
                        None
                    }
                },
            };
            top.add_own_method(&id, method);
            ids.push((id, at.start));
        }
        top.add_faults_of(row);
    }
}
