//! Where a command's results go: standard output, files that appear whole or not at all, directories that
//! one process writes to at a time, and the formats of pictures and tables.

mod destination;
mod directory_lock;
pub(super) mod table;

pub(super) use destination::{
    Destination, Input, Output, STDOUT, begin_file, print, same_file_path,
};
pub(super) use directory_lock::{DirectoryLock, is_lock};
