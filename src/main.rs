//! Regatta's program: command line in, exit code out. 0 is success, 1 a failed run, 2 a mistake in the command line
//! or in a scene file, 130 an interrupt.

use std::io::{self, Write};
use std::panic::{self, Location, PanicHookInfo};
use std::path::Path;
#[cfg(target_os = "linux")]
use std::process::Command;
use std::process::ExitCode;

use regatta::commands::{self, Cli};

/// Log filter: these libraries report errors only, and some parts of them nothing: EGL and Vulkan, the frames of
/// Wayland windows, and its protocol. Drivers that are not installed are tried too, and any failure that matters comes
/// back as an error value. `RUST_LOG` overrides it.
const LOG_FILTER: &str = "warn,arboard=error,wgpu_core=error,wgpu_hal=error,wgpu_hal::gles::egl=off,naga=error,\
     wgpu_hal::vulkan::instance=off,sctk_adwaita=off,wayland_backend=off";

fn main() -> ExitCode {
    panic::set_hook(Box::new(report_bug));
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or(LOG_FILTER))
        .format(|out, record| {
            let message = record.args().to_string();
            let message = commands::visible(&message);
            writeln!(out, "[{} {}] {message}", record.level(), record.target())
        })
        .init();
    panic::catch_unwind(run).unwrap_or(ExitCode::FAILURE)
}

fn run() -> ExitCode {
    let cli = match Cli::read(std::env::args_os()) {
        Ok(cli) => cli,
        Err(answer) => {
            // Help and version also arrive here. A closed pipe is no reason to complain.
            let printed = answer.print().and_then(|()| io::stdout().flush());
            if let Err(error) = printed
                && !answer.use_stderr()
                && error.kind() != io::ErrorKind::BrokenPipe
            {
                commands::print_status(&format!("error: cannot write to standard output: {error}"));
                return ExitCode::FAILURE;
            }
            return ExitCode::from(u8::try_from(answer.exit_code()).unwrap_or(1));
        }
    };
    #[cfg(target_os = "linux")]
    restart_without_wayland(&cli);
    match commands::run(cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            commands::print_error(&error);
            ExitCode::from(error.exit_code())
        }
    }
}

/// Restarts the program with an `XDG_RUNTIME_DIR` in which there is no Wayland, if the variable is unset and a driver
/// may draw. Mesa looks for Wayland before it lists its adapters, and libwayland complains about the variable on
/// standard error. A restart is the only safe way to set it before there are drivers and threads.
#[cfg(target_os = "linux")]
fn restart_without_wayland(cli: &Cli) {
    use std::os::unix::process::CommandExt;

    const NOWHERE: &str = "/nonexistent";
    let is_path = |name| std::env::var_os(name).is_some_and(|it| Path::new(&it).is_absolute());
    let names_a_socket = is_path("WAYLAND_DISPLAY") || std::env::var_os("WAYLAND_SOCKET").is_some();
    if !cli.may_take_a_device() || is_path("XDG_RUNTIME_DIR") || names_a_socket {
        return;
    }
    let mut arguments = std::env::args_os();
    if let (Ok(program), Some(name)) = (std::env::current_exe(), arguments.next()) {
        let mut again = Command::new(program);
        let failed = again.arg0(name).args(arguments).env("XDG_RUNTIME_DIR", NOWHERE).exec();
        log::info!("libwayland may complain: {failed}");
    }
}

fn report_bug(panic: &PanicHookInfo<'_>) {
    // A library that cannot start a thread, because the system refuses, is no bug of ours.
    let said = panic.payload_as_str().unwrap_or_default();
    if ["failed to spawn thread", "ThreadPoolBuildError"].iter().any(|what| said.contains(what)) {
        return commands::print_status(
            "error: the system starts no more threads for this program; let it (ulimit -u, ulimit -v)",
        );
    }
    // The keyboard's library is loaded late, and its loader panics without it.
    if said.contains("could not be loaded") {
        return commands::print_status(&format!("error: {said}; {}", commands::WINDOW_LIBRARIES));
    }
    // winit takes some extensions of a display for granted.
    let is_of_winit = |place: &Location<'_>| {
        let mut parts = Path::new(place.file()).components();
        parts.any(|part| part.as_os_str().to_string_lossy().starts_with("winit-"))
    };
    if panic.location().is_some_and(is_of_winit) {
        return commands::print_status(&format!(
            "error: the window system lacks what winit needs: {said}; regatta capture draws without a window"
        ));
    }
    // Not `eprintln!`, which itself panics if standard error is closed.
    commands::print_status(&format!(
        "error: regatta has a bug, and stopped: {panic}\n\
         Please report it with these lines and the command that you gave."
    ));
}
