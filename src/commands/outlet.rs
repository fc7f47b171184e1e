//! Where one stream of bytes goes: standard output, or a file that appears whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};

use super::capture::CaptureError;
use super::frame_folder::{failure, part_of};

/// The path that means standard output.
pub(super) const STDOUT: &str = "-";

/// A stream being written.
pub(super) enum Outlet {
    Stdout(BufWriter<io::Stdout>),
    File {
        /// None once it is closed.
        part: Option<BufWriter<File>>,
        path: PathBuf,
    },
}

impl Outlet {
    /// Opens standard output or makes a file, beside an older one if `replace` says so, for bytes that
    /// are no text.
    pub(super) fn open(path: &Path, replace: bool) -> Result<Self, CaptureError> {
        if path == Path::new(STDOUT) && io::stdout().is_terminal() {
            return Err(CaptureError::Terminal);
        }
        Self::open_for_text(path, replace)
    }

    /// The same for text, which may go to a terminal.
    pub(super) fn open_for_text(path: &Path, replace: bool) -> Result<Self, CaptureError> {
        if path == Path::new(STDOUT) {
            return Ok(Outlet::Stdout(BufWriter::new(io::stdout())));
        }
        // A device or a link is nothing to be replaced by a file.
        let is_taken = fs::symlink_metadata(path).is_ok_and(|entry| !entry.is_file() || !replace);
        if is_taken {
            return Err(CaptureError::Taken { path: path.to_owned() });
        }
        let part = File::create(part_of(path)).map_err(failure("write", path))?;
        Ok(Outlet::File { part: Some(BufWriter::new(part)), path: path.to_owned() })
    }

    /// What to call it.
    pub(super) fn name(&self) -> String {
        match self {
            Outlet::Stdout(_) => "standard output".into(),
            Outlet::File { path, .. } => path.display().to_string(),
        }
    }

    /// What a failure to write means.
    pub(super) fn failed(&self, error: io::Error) -> CaptureError {
        match self {
            Outlet::Stdout(_) => CaptureError::Output(error),
            Outlet::File { path, .. } => failure("write", path)(error).into(),
        }
    }

    /// Writes what is left; the file takes its name.
    pub(super) fn close(mut self) -> Result<(), CaptureError> {
        self.flush().map_err(|error| self.failed(error))?;
        if let Outlet::File { part, path } = &mut self {
            *part = None;
            if let Err(error) = fs::rename(part_of(path), &*path) {
                let _ = fs::remove_file(part_of(path));
                return Err(failure("write", path)(error).into());
            }
        }
        Ok(())
    }
}

impl Write for Outlet {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Outlet::Stdout(out) => out.write(bytes),
            Outlet::File { part, .. } => part.as_mut().expect("it is open").write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Outlet::Stdout(out) => out.flush(),
            Outlet::File { part, .. } => part.as_mut().expect("it is open").flush(),
        }
    }
}

impl Drop for Outlet {
    fn drop(&mut self) {
        if let Outlet::File { part: Some(_), path } = self {
            // Half a file is none.
            let _ = fs::remove_file(part_of(path));
        }
    }
}
