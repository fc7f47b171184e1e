//! Compilers of other languages, for tests of code that is given away.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// An empty folder for compiled files.
pub(crate) fn build_folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// The compiler of these tests, for code of their edition.
pub(crate) fn rustc() -> Command {
    let mut rustc = Command::new(env::var_os("RUSTC").unwrap_or("rustc".into()));
    rustc.arg("--edition=2024");
    rustc
}

/// Asserts that a compiler succeeds.
#[track_caller]
pub(crate) fn compile(compiler: &mut Command) {
    let output = compiler.output().unwrap();
    let said = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
    assert!(output.status.success(), "{}{}", said[0], said[1]);
}
