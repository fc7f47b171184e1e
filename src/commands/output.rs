//! Where a command's results go: standard output, files that appear whole or not at all, directories that
//! one process writes to at a time, and the formats of pictures and tables.

mod atomic_file;
mod atomic_output;
mod directory_lock;
mod file_error;
pub(super) mod picture_format;
pub(super) mod table;

pub(super) use atomic_file::{AtomicFile, Older, final_name, sync_directory, write_whole};
pub(super) use atomic_output::{
    AtomicOutput, OutputError, Place, STDOUT, finish, print, write_text,
};
pub(super) use directory_lock::{DirectoryLock, is_lock};
pub(super) use file_error::FileError;
