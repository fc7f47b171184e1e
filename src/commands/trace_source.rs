//! Finds the frame traces that `--trace` names: a built-in one, or else the streams of a file.

use std::path::{Path, PathBuf};

use super::error::Cause;
use crate::lab::nearest;
use crate::lab::pacing::trace_file::{self, TraceFileError};
use crate::lab::pacing::{FrameTrace, RefreshRate, TRACES, steady_trace, trace_card};
use crate::regular_file::{self, MAX_TABLE_BYTES, Unreadable};

/// The refresh rate of a trace that any display will do for.
const USUAL: RefreshRate = RefreshRate::new(60, 1);

/// The reason why a trace cannot be had.
#[derive(Debug, thiserror::Error)]
pub(super) enum TraceError {
    /// Neither a built-in trace nor a file has this name.
    #[error("no file and no built-in trace is called {path:?}; {}", remedy(.path))]
    NotFound {
        /// As it was given.
        path: PathBuf,
    },
    /// The file is there but is not read.
    #[error("cannot read the trace {}: {source}", .path.display())]
    Unreadable {
        /// As it was given.
        path: PathBuf,
        /// Why.
        source: Unreadable,
    },
    /// The file holds no trace.
    #[error("{source}")]
    Invalid {
        /// Why, and where.
        source: TraceFileError,
    },
    /// The trace has a display of its own.
    #[error(
        "the trace {trace} has a display of {own} Hz; leave --display-hz out, or name another --trace"
    )]
    OwnDisplay {
        /// The trace.
        trace: &'static str,
        /// Its rate.
        own: RefreshRate,
    },
}

impl Cause for TraceError {
    fn exit_code(&self) -> u8 {
        2
    }
}

fn remedy(path: &Path) -> String {
    let ids = TRACES.iter().map(|card| (card.id, card.id));
    match path.to_str().and_then(|id| nearest(id, ids)) {
        Some(id) => format!("did you mean {id}? `regatta list traces` names all"),
        None => "`regatta list traces` names all; a file is a CSV of PresentMon, OCAT, CapFrameX, FrameView or MangoHud".into(),
    }
}

/// The traces that these names stand for, on a display of this rate where they have none of their own. Without a name, an
/// even display of that rate, or else all built-in traces.
pub(super) fn traces(
    names: &[PathBuf],
    display: Option<RefreshRate>,
) -> Result<Vec<FrameTrace>, TraceError> {
    match (names, display) {
        ([], Some(display)) => Ok(vec![steady_trace(display)]),
        ([], None) => Ok(TRACES.iter().map(|card| card.trace(USUAL)).collect()),
        (names, display) => {
            let found = names.iter().map(|name| named(name, display));
            Ok(found.collect::<Result<Vec<_>, _>>()?.concat())
        }
    }
}

fn named(path: &Path, display: Option<RefreshRate>) -> Result<Vec<FrameTrace>, TraceError> {
    if let Some(card) = path.to_str().and_then(trace_card) {
        return match (card.refresh, display) {
            (Some(own), Some(display)) if own != display => {
                Err(TraceError::OwnDisplay { trace: card.id, own })
            }
            _ => Ok(vec![card.trace(display.unwrap_or(USUAL))]),
        };
    }
    let bytes = regular_file::read(path, MAX_TABLE_BYTES).map_err(|source| {
        let path = path.into();
        match source.is_missing() {
            true => TraceError::NotFound { path },
            false => TraceError::Unreadable { path, source },
        }
    })?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let traces =
        trace_file::from_bytes(&name, &bytes).map_err(|source| TraceError::Invalid { source })?;
    Ok(match display {
        Some(display) => traces.into_iter().map(|trace| trace.on(display)).collect(),
        None => traces,
    })
}
