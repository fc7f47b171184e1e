//! What the tests of this layer share: a device.

use std::io::{self, Write};

use super::{AdapterPreference, Gpu};

/// A software device, or a line on stderr that says which test did not run and why.
pub(super) fn gpu_or_skip(test: &str) -> Option<Gpu> {
    Gpu::headless(AdapterPreference::CpuOnly)
        // Not `eprintln!`, which the test runner hides when a test passes.
        .inspect_err(|error| drop(writeln!(io::stderr(), "SKIPPED {test}: {error}")))
        .ok()
}
