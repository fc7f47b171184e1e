//! What Linux says of a process that a test has started: it is the same on a busy machine as on an idle one.

use std::fs;
use std::time::Duration;

/// The fields of a process or thread after its name, which is in brackets and may hold spaces.
fn fields(stat: &str) -> &str {
    stat.rsplit_once(") ").expect("Linux writes it so").1
}

/// How long processors have worked for a process that is not yet waited for.
pub(crate) fn time(process: u32) -> Duration {
    let stat = fs::read_to_string(format!("/proc/{process}/stat")).expect("it is there");
    let ticks = fields(&stat).split(' ').skip(11).take(2);
    let ticks = ticks.map(|field| field.parse::<u64>().expect("a number"));
    // Linux reports a hundred of them per second, independent of the kernel's own rate.
    Duration::from_millis(10 * ticks.sum::<u64>())
}

/// Whether it has ended, and is not yet waited for.
#[allow(dead_code, reason = "tests/window asks the process itself")]
pub(crate) fn has_ended(process: u32) -> bool {
    let stat = fs::read_to_string(format!("/proc/{process}/stat")).expect("it is there");
    fields(&stat).starts_with('Z')
}

/// Whether all of its threads wait for something.
#[allow(dead_code, reason = "tests/program waits for none that does nothing")]
pub(crate) fn sleeps(process: u32) -> bool {
    let mut threads = fs::read_dir(format!("/proc/{process}/task")).expect("it is there");
    threads.all(|thread| {
        let stat = thread.and_then(|thread| fs::read_to_string(thread.path().join("stat")));
        stat.is_ok_and(|stat| fields(&stat).starts_with('S'))
    })
}
