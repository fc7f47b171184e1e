//! A harness for tests that want more than a compiler: where that is missing, a test is reported as ignored with the
//! package that brings it, and the last line counts those.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::process::{Command, ExitCode, Stdio};

use libtest_mimic::{Arguments, Trial};

/// Something that a machine may lack.
#[derive(Clone, Copy)]
pub(crate) struct Need {
    /// Debian's package of it, and who else has to bring it.
    package: &'static str,
    is_met: fn() -> bool,
}

impl Need {
    pub(crate) const fn new(package: &'static str, is_met: fn() -> bool) -> Self {
        Self { package, is_met }
    }
}

/// Whether a program is there to be run.
pub(crate) fn has(program: &str, argument: &str) -> bool {
    let mut command = Command::new(program);
    command.arg(argument).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok()
}

/// Tests by name, each with what it wants.
pub(crate) struct Tests {
    arguments: Arguments,
    trials: Vec<Trial>,
    met: BTreeMap<&'static str, bool>,
    missing: BTreeMap<String, usize>,
}

impl Tests {
    pub(crate) fn new() -> Self {
        let mut arguments = Arguments::from_args();
        let threads = std::env::var("RUST_TEST_THREADS").ok();
        let threads = threads.and_then(|threads| threads.parse().ok());
        arguments.test_threads = arguments.test_threads.or(threads);
        Self { arguments, trials: Vec::new(), met: BTreeMap::new(), missing: BTreeMap::new() }
    }

    pub(crate) fn add(&mut self, name: &str, needs: &[Need], test: fn()) {
        let asked = &self.arguments;
        let is_it = |part: &String| if asked.exact { name == part } else { name.contains(part) };
        let is_asked = asked.filter.iter().all(is_it) && !asked.skip.iter().any(is_it);
        let mut is_met = |need: &&Need| *self.met.entry(need.package).or_insert_with(need.is_met);
        let lacks = needs.iter().filter(|need| is_asked && !asked.list && !is_met(need));
        let lacks: Vec<&str> = lacks.map(|need| need.package).collect();
        let mut trial = Trial::test(name, move || {
            test();
            Ok(())
        });
        if !lacks.is_empty() {
            let wanted = format!("wants {}", lacks.join(", "));
            *self.missing.entry(wanted.clone()).or_default() += 1;
            trial = trial.with_kind(wanted).with_ignored_flag(true);
        }
        self.trials.push(trial);
    }

    /// Runs those that the command line asks for.
    pub(crate) fn run(self) -> ExitCode {
        let conclusion = libtest_mimic::run(&self.arguments, self.trials);
        for (wanted, count) in self.missing {
            let _ = writeln!(io::stderr(), "{count} ignored: each {wanted}");
        }
        conclusion.exit_code()
    }
}

/// Adds the tests of modules, or of modules of a module: `needs => module { test, … }`.
macro_rules! tests {
    ($to:ident: $($needs:expr => $module:ident { $($name:ident),+ $(,)? })+) => {
        $($($to.add(
            concat!(stringify!($module), "::", stringify!($name)),
            &$needs,
            $module::$name,
        );)+)+
    };
    ($to:ident of $outer:ident: $($needs:expr => $module:ident { $($name:ident),+ $(,)? })+) => {
        $($($to.add(
            concat!(stringify!($outer), "::", stringify!($module), "::", stringify!($name)),
            &$needs,
            $outer::$module::$name,
        );)+)+
    };
}
pub(crate) use tests;
