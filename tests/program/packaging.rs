//! What a package installs beside the program is what the program says of itself.

use std::path::{Path, PathBuf};
use std::{env, fs};

use clap::CommandFactory;
use clap_complete::{Shell, generate};
use regatta::commands::Cli;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/linux")
}

/// The files, by their places in the folder: a page of the manual for each command, a script for each shell.
fn files() -> Vec<(String, Vec<u8>)> {
    let mut cli = Cli::command();
    cli.build();
    let page = |command: &clap::Command| {
        let mut page = Vec::new();
        let man = clap_mangen::Man::new(command.clone()).manual("Regatta").date("");
        man.render(&mut page).expect("memory takes a page");
        let name = command.get_display_name().unwrap_or(command.get_name()).to_owned();
        (format!("man/{name}.1"), page)
    };
    let pages = [&cli].into_iter().chain(cli.get_subcommands()).map(page);
    let script = |(shell, name): (Shell, &str)| {
        let mut script = Vec::new();
        generate(shell, &mut Cli::command(), "regatta", &mut script);
        (format!("completions/{name}"), script)
    };
    let shells =
        [(Shell::Bash, "regatta"), (Shell::Fish, "regatta.fish"), (Shell::Zsh, "_regatta")];
    pages.chain(shells.map(script)).collect()
}

#[test]
fn the_pages_and_completions_of_a_package_are_those_of_the_command_line() {
    let bless = env::var_os("BLESS").is_some_and(|value| value == "1");
    for (name, made) in files() {
        let path = folder().join(&name);
        if bless {
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, &made).unwrap();
        }
        let kept = fs::read(&path).unwrap_or_default();
        assert!(
            kept == made,
            "{name} is another; write it with BLESS=1 cargo test --test program packaging"
        );
    }
    let listed = |part: &str| fs::read_dir(folder().join(part)).unwrap().count();
    assert_eq!(listed("man") + listed("completions"), files().len(), "no file is left over");
}

#[test]
fn the_icon_is_square_and_the_version_that_of_the_package() {
    let icon = image::open(folder().join("regatta.png")).unwrap();
    assert_eq!((icon.width(), icon.height()), (256, 256));
    let about = fs::read_to_string(folder().join("org.example.regatta.metainfo.xml")).unwrap();
    assert!(about.contains(&format!("version=\"{}\"", env!("CARGO_PKG_VERSION"))));
}

#[test]
fn every_crate_that_a_profile_names_is_built() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let [manifest, lock] =
        ["Cargo.toml", "Cargo.lock"].map(|file| fs::read_to_string(here.join(file)).unwrap());
    let names = manifest.lines().filter_map(|line| line.split_once(" = { opt-level = "));
    let names: Vec<&str> = names.map(|(name, _)| name).filter(|name| *name != "\"*\"").collect();
    assert!(names.len() > 50, "{names:?}");
    for name in names {
        assert!(lock.contains(&format!("\nname = \"{name}\"\n")), "{name}");
    }
}
