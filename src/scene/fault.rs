//! A fault of a scene file: what is wrong, what to do about it, and the little that the reader asks of it.

use super::clip::clip;
use super::nearest::offer;
use super::wanted::{Place, Wanted};
use crate::sim::bodies::Fault;

/// A fault of a scene file or of a value that is set.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{what}; {remedy}")]
pub(super) struct SceneFault {
    pub(super) what: String,
    pub(super) remedy: String,
    pub(super) kind: FaultKind,
}

/// What the reader asks of a fault.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum FaultKind {
    Other,
    /// A key or a table is given twice: the rest of the file can be read.
    Duplicate {
        is_table: bool,
    },
    /// There is no such key; this one is like it.
    Unknown(Option<String>),
    /// A key of the top stands in a table.
    Misplaced(&'static str),
    /// None of these keys is there.
    Missing(Vec<&'static str>),
    /// What may be meant as a body's table is none.
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

    /// A key that is not known in a place where these are.
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

    /// A value of the wrong type. A table array may be meant as a body's.
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

/// The values of a body do not go together.
impl From<Fault> for SceneFault {
    fn from(fault: Fault) -> Self {
        Self::new(&*fault.what, &*fault.remedy).of(FaultKind::Values(fault))
    }
}
