//! A fault of a scene file, with its description, its remedy, and the kinds of fault that the reader distinguishes.

use super::clip::clip;
use super::nearest::offer;
use super::wanted::{Place, Wanted};
use crate::sim::bodies::Fault;

/// A fault of a scene file, or of an edited value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{what}; {remedy}")]
pub(super) struct SceneFault {
    pub(super) what: String,
    pub(super) remedy: String,
    pub(super) kind: FaultKind,
}

/// The kinds of fault that the reader distinguishes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum FaultKind {
    Other,
    /// A repeated key or table. The rest of the file can be read.
    Duplicate {
        is_table: bool,
    },
    /// An unknown key, with the known key that is most like it.
    Unknown(Option<String>),
    /// A key of the top of the file in a table.
    Misplaced(&'static str),
    /// None of these keys is present.
    Missing(Vec<&'static str>),
    /// A value that may be meant as a body's table, but is not a table.
    NoTable,
    /// The values of a body do not go together.
    Values(Fault),
}

impl SceneFault {
    pub(super) fn new(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { what: what.into(), remedy: remedy.into(), kind: FaultKind::Other }
    }

    pub(super) fn of(self, kind: FaultKind) -> Self {
        Self { kind, ..self }
    }

    /// Returns an unknown key, in a place for `known` keys.
    pub(super) fn unknown_key(
        key: &str,
        place: Place,
        nearest: Option<&str>,
        known: &[&str],
    ) -> Self {
        let what = format!("unknown key `{}` {place}", clip(key));
        let kind = FaultKind::Unknown(nearest.map(str::to_owned));
        Self::new(what, offer(nearest, known, '`')).of(kind)
    }

    /// Returns the fault of a value of the wrong type. A value in the place of a table array may be meant as a body's
    /// table.
    pub(super) fn wrong_type(subject: &str, found: &str, wanted: &Wanted) -> Self {
        let fault =
            Self::new(format!("{subject} is {found}, not {}", wanted.noun()), wanted.remedy());
        match wanted {
            Wanted::Tables(_) => fault.of(FaultKind::NoTable),
            _ => fault,
        }
    }

    pub(super) fn out_of_range(subject: &str, value: &str, wanted: &Wanted) -> Self {
        Self::new(format!("{subject} is {value}, out of range"), wanted.remedy())
    }
}

/// Makes the fault of values that do not go together.
impl From<Fault> for SceneFault {
    fn from(fault: Fault) -> Self {
        Self::new(&*fault.what, &*fault.remedy).of(FaultKind::Values(fault))
    }
}
