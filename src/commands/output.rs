//! Outputs of a command: standard output, files that appear whole or not at all, directories with one writer at a
//! time, and tables.

mod destination;
mod directory_lock;
pub(super) mod table;

pub(super) use destination::{
    Destination, Input, Output, STDOUT, begin_file, print, print_json, same_file_path,
};
pub(super) use directory_lock::{DirectoryLock, is_lock};
