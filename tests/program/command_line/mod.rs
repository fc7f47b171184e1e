//! The program as its users meet it: arguments in; bytes, messages and exit codes out.
#![cfg(feature = "desktop")]

mod advise;
mod bless;
mod capture;
mod chapter;
mod cloud;
mod diff;
mod examples;
mod files;
mod help;
mod identify;
mod link;
mod list;
mod loop_frames;
mod loops;
mod manifest;
mod mcp;
mod mishaps;
mod mistakes;
mod mutations;
mod own_methods;
mod port;
mod recordings;
mod report;
mod rule;
mod running;
mod schema;
mod show;
mod signals;
mod sweep;
mod sweep_plots;
mod tick_rates;
mod trace;
mod unknown_logs;
mod verify;
mod verify_reports;

#[cfg(unix)]
use running::ended_by;
#[cfg(target_os = "linux")]
use running::work_after;
use running::{dimensions, names, refusal, regatta, run, run_in, start, stderr, stdout_of};

/// Waits until processors have worked as long for a program that goes on.
#[cfg(target_os = "linux")]
fn until_worked(child: &mut std::process::Child, work: std::time::Duration) {
    while crate::processor::time(child.id()) < work {
        assert_eq!(child.try_wait().unwrap(), None, "it goes on");
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
}
