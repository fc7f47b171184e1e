//! The program as a process.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::Duration;

use crate::processor;

/// The program running.
pub(crate) struct Program(Child);

impl Program {
    /// Starts the program in this folder, with nothing of this machine's display or settings.
    pub(crate) fn start(folder: &Path, arguments: &str, variables: &[(&str, &str)]) -> Self {
        // A window of before, which has its instruments round the stage.
        let remembered = folder.join("config/regatta/window.toml");
        if !remembered.exists() {
            std::fs::create_dir_all(remembered.parent().expect("it is in a folder")).unwrap();
            std::fs::write(remembered, "measure = true\n").unwrap();
        }
        let mut command = Command::new(env!("CARGO_BIN_EXE_regatta"));
        for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET", "WGPU_BACKEND", "RUST_LOG"]
        {
            command.env_remove(variable);
        }
        command
            .args(arguments.split_whitespace())
            .current_dir(folder)
            // Where it is unset, libwayland says so on standard error.
            .env("XDG_RUNTIME_DIR", folder)
            // The window remembers its own settings here, not the user's.
            .env("XDG_CONFIG_HOME", folder.join("config"))
            .envs(variables.iter().copied())
            .stdin(Stdio::null())
            .stderr(Stdio::piped());
        Self(command.spawn().unwrap())
    }

    /// Waits for a line with this text on standard error. Without one, returns everything that it read.
    pub(crate) fn says(&mut self, text: &str) -> Result<(), String> {
        let mut said = String::new();
        let mut stderr = BufReader::new(self.0.stderr.as_mut().expect("it is piped"));
        while !said.contains(text) {
            if stderr.read_line(&mut said).unwrap() == 0 {
                return Err(said);
            }
        }
        Ok(())
    }

    /// How it ended, if it did.
    pub(crate) fn ended(&mut self) -> Option<ExitStatus> {
        self.0.try_wait().unwrap()
    }

    /// Everything on standard error until the end of the program.
    pub(crate) fn said(&mut self) -> String {
        let mut said = String::new();
        self.0.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        said
    }

    pub(crate) fn processor_time(&self) -> Duration {
        processor::time(self.0.id())
    }

    /// The memory that it uses and shares with no file, in MB.
    pub(crate) fn memory_mb(&self) -> f64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.0.id())).unwrap();
        let line = status.lines().find_map(|line| line.strip_prefix("RssAnon:")).expect("on Linux");
        line.trim().trim_end_matches(" kB").parse::<f64>().unwrap() / 1024.0
    }

    /// Whether all of its threads wait for something.
    pub(crate) fn sleeps(&self) -> bool {
        processor::sleeps(self.0.id())
    }

    /// Stops the program for `span`, like a busy machine does.
    pub(crate) fn stop_for(&self, span: Duration) {
        stop_for(&self.0, span);
    }

    /// Asks it to end, as the system does.
    pub(crate) fn terminate(&self) {
        send("TERM", &self.0);
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        end(&mut self.0);
    }
}

/// Stops a process for so long.
pub(crate) fn stop_for(child: &Child, span: Duration) {
    send("STOP", child);
    std::thread::sleep(span);
    send("CONT", child);
}

fn send(signal: &str, child: &Child) {
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-s", signal, &id]).status().unwrap().success());
}

pub(crate) fn end(child: &mut Child) {
    let _ = child.kill();
    let _ = child.wait();
}
