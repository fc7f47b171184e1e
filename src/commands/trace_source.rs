//! Finds the frame traces that `--trace` names. A name is that of a built-in trace, or else of a file with streams of
//! frames.

use std::path::{Path, PathBuf};

use super::argument::brief;
use super::error::Error;
use super::terminal::print_status;
use crate::loops::{
    FrameTrace, RefreshRate, TRACES, frames_on_display, steady_trace, trace_card, trace_file,
};
use crate::regular_file;
use crate::scene::nearest;
use crate::table::TableOptions;

/// Refresh rate of the display for a trace that suits any display.
const USUAL: RefreshRate = RefreshRate::new(60, 1);

fn remedy(path: &Path) -> String {
    let ids = TRACES.iter().map(|card| (card.id, card.id));
    match path.to_str().and_then(|id| nearest(id, ids)) {
        Some(id) => format!("did you mean {id}? `regatta list traces` names all"),
        None => "`regatta list traces` names all; a file is a CSV of PresentMon, OCAT, CapFrameX, FrameView, MangoHud, Unreal or FRAPS, or a list of frame times".into(),
    }
}

/// Returns the traces that are named. Those that have no display of their own are on a display of the rate `display`.
/// If none is named, returns frames at `fps`, or an even display of the rate `display`, or else all built-in traces. A
/// display without a rate shows each frame when it begins.
pub(super) fn traces(
    names: &[PathBuf],
    options: &TableOptions,
    display: Option<RefreshRate>,
    fps: Option<RefreshRate>,
) -> Result<Vec<FrameTrace>, Error> {
    match (names, display.or(fps)) {
        ([], Some(display)) => Ok(vec![match fps.filter(|fps| *fps != display) {
            Some(fps) => frames_on_display(fps, display),
            None => steady_trace(display),
        }]),
        ([], None) => Ok(TRACES.iter().map(|card| card.trace(USUAL)).collect()),
        (names, _) => {
            let found = names.iter().map(|name| named(name, options, display));
            Ok(found.collect::<Result<Vec<_>, _>>()?.concat())
        }
    }
}

fn named(
    path: &Path,
    options: &TableOptions,
    display: Option<RefreshRate>,
) -> Result<Vec<FrameTrace>, Error> {
    if let Some(card) = path.to_str().and_then(trace_card) {
        return match (card.refresh, display) {
            (Some(own), Some(display)) if own != display => {
                let trace = card.id;
                Err(Error::mistake(format!(
                    "the trace {trace} has a display of {own} Hz; leave --display-hz out, or name another --trace"
                )))
            }
            _ => Ok(vec![card.trace(display.unwrap_or(USUAL))]),
        };
    }
    let bytes = regular_file::read_table(path).map_err(|error| {
        Error::mistake(match error.is_missing() {
            true => format!(
                "no file and no built-in trace is called {:?}; {}",
                brief(path),
                remedy(path)
            ),
            false => format!("cannot read the trace {}: {error}", brief(path)),
        })
    })?;
    let name = regular_file::table_name(path);
    let traces = trace_file::from_table(&name, &bytes, options).map_err(Error::mistake)?;
    for summary in traces.iter().filter_map(FrameTrace::summary) {
        print_status(&summary);
    }
    Ok(match display {
        Some(display) => traces.into_iter().map(|trace| trace.on(display)).collect(),
        None => traces,
    })
}
