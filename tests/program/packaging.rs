//! The files that a package installs with the program agree with the program.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
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
fn packaged_manual_pages_and_completions_match_the_command_line() {
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
            "assets/linux/{name} is out of date; write it with BLESS=1 cargo test --test program packaging"
        );
    }
    let listed = |part: &str| fs::read_dir(folder().join(part)).unwrap().count();
    assert_eq!(listed("man") + listed("completions"), files().len(), "no file is left over");
}

#[test]
fn the_icon_is_square_and_the_metadata_has_the_package_version() {
    let icon = image::open(folder().join("regatta.png")).unwrap();
    assert_eq!((icon.width(), icon.height()), (256, 256));
    let about = fs::read_to_string(folder().join("org.example.regatta.metainfo.xml")).unwrap();
    assert!(about.contains(&format!("version=\"{}\"", env!("CARGO_PKG_VERSION"))));
}

/// The crates in the program on this system, as `name version`.
fn crates() -> BTreeSet<String> {
    let mut tree = Command::new(env!("CARGO"));
    tree.args(["tree", "--package", "regatta", "--offline", "--locked"]);
    tree.args(["--edges", "normal", "--prefix", "none"]);
    let output = tree.current_dir(env!("CARGO_MANIFEST_DIR")).output().expect("cargo runs this");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("names");
    let named = text.lines().map(|line| {
        let mut words = line.split(' ');
        let [name, version] = [words.next(), words.next()].map(Option::unwrap_or_default);
        format!("{name} {}", version.trim_start_matches('v'))
    });
    named.filter(|named| !named.starts_with("regatta")).collect()
}

#[test]
fn the_licence_of_every_crate_in_the_program_is_packed_with_it() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let [kept, lock, manifest] = ["assets/linux/licenses.txt", "Cargo.lock", "Cargo.toml"]
        .map(|file| fs::read_to_string(here.join(file)).unwrap());
    let listed = kept.lines().filter_map(|line| line.strip_prefix("crate: "));
    let listed: BTreeSet<String> = listed.map(String::from).collect();
    let missing: Vec<String> = crates().difference(&listed).cloned().collect();
    assert!(missing.is_empty(), ".ci/licences writes them: {missing:?}");
    let is_locked = |named: &&String| {
        let (name, version) = named.split_once(' ').expect("two words");
        lock.contains(&format!("\nname = \"{name}\"\nversion = \"{version}\"\n"))
    };
    let gone: Vec<&String> = listed.iter().filter(|named| !is_locked(named)).collect();
    assert!(gone.is_empty() && listed.len() > 250, ".ci/licences leaves them out: {gone:?}");
    for packed in
        ["LICENSE-APACHE", "LICENSE-MIT", "assets/fonts/*.txt", "assets/linux/licenses.txt"]
    {
        assert!(manifest.contains(&format!("[\"{packed}\", \"usr/share/doc/regatta/")), "{packed}");
    }
}

/// Cargo drops `strip` of a package that has a table of its own in a profile.
#[test]
fn no_profile_of_what_is_shipped_has_a_table_for_a_package_of_ours() {
    let manifest = include_str!("../../Cargo.toml");
    let (_, manifest) = manifest.split_once("[profile.release]").expect("a profile");
    let is_profile = |line: &&str| line.starts_with("[profile.");
    let tables = manifest.lines().filter(is_profile).filter(|line| line.contains("regatta"));
    assert_eq!(tables.collect::<Vec<_>>(), [""; 0]);
    let is_row = |line: &&str| line.starts_with("regatta") && line.contains("opt-level");
    let rows = manifest.lines().filter(is_row);
    assert_eq!(rows.collect::<Vec<_>>(), [""; 0]);
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
