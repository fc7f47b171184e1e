//! The program beside other programs and things of a system: readers of its files, disks, pipes, a graphics device.

pub(crate) mod assistant;
#[cfg(target_os = "linux")]
pub(crate) mod disks;
pub(crate) mod fixture;
pub(crate) mod formats;
#[cfg(target_os = "linux")]
pub(crate) mod pipes;
#[path = "../../program/command_line/running.rs"]
mod running;
pub(crate) mod verify;

#[cfg(unix)]
use running::ended_by;
#[cfg(target_os = "linux")]
use running::{dimensions, start, work_after};
use running::{names, refusal, regatta, run_in, stderr, stdout_of};
