//! Arguments in messages: cut where they are long, as a link to a run is.

use std::path::Path;

use clap::error::{ContextKind, ContextValue};

use crate::regular_file::is_link;
use crate::scene::{clip, cut};

/// The most characters of an argument in a message: more than a person writes, and no more than a few lines.
const MAX_SHOWN_CHARS: usize = 300;

/// A path for a message. Of a link, whose letters say nothing, the first few stand for it.
pub(super) fn brief(path: &Path) -> String {
    let written = path.display().to_string();
    if is_link(path) { clip(&written) } else { cut(MAX_SHOWN_CHARS, &written) }
}

/// An error of the command line, in which long arguments are cut.
pub(super) fn with_brief_arguments(mut error: clap::Error) -> clap::Error {
    let shorter = |(kind, value): (ContextKind, &ContextValue)| match value {
        ContextValue::String(text) => {
            let shown = cut(MAX_SHOWN_CHARS, text);
            (shown != *text).then_some((kind, ContextValue::String(shown)))
        }
        _ => None,
    };
    let long: Vec<(ContextKind, ContextValue)> = error.context().filter_map(shorter).collect();
    if !long.is_empty() {
        // A suggestion would repeat what is too long.
        error.remove(ContextKind::Suggested);
    }
    for (kind, shown) in long {
        error.insert(kind, shown);
    }
    error
}
