//! Compilers of other languages, for tests of code that is given away.

use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::process::Command;

/// An empty folder for compiled files.
pub(crate) fn build_folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Whether a compiler succeeds. Where it is not installed, says that `test` is skipped.
pub(crate) fn compiled_or_skip(test: &str, command: &mut Command) -> bool {
    match command.output() {
        Ok(output) => {
            let said = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
            assert!(output.status.success(), "{}{}", said[0], said[1]);
            true
        }
        Err(error) => {
            let compiler = command.get_program().to_string_lossy();
            let _ = writeln!(io::stderr(), "SKIPPED {test}: {compiler}: {error}");
            false
        }
    }
}
