//! A room of `src` names the rooms that the table at the head of `src/lib.rs` lets it name, and no other. Cargo keeps a room with
//! a package to what its manifest lists.

use std::collections::BTreeSet;

use super::paths::named;
use super::{Source, none, root, sources};

/// A row of the table.
pub(super) struct Room {
    pub(super) name: String,
    package: String,
    may_name: BTreeSet<String>,
    open_first: String,
}

/// The text in backticks.
fn ticked(text: &str) -> &str {
    text.split('`').nth(1).unwrap_or_default()
}

/// The rooms, from the lowest up.
pub(super) fn rooms() -> Vec<Room> {
    let text = std::fs::read_to_string(root().join("src/lib.rs")).expect("the crate's page");
    let rows = text.lines().filter_map(|line| line.strip_prefix("| ")).skip(1);
    let rows = rows.map(|row| row.trim_end_matches(" |").split(" | ").collect::<Vec<_>>());
    let room = |cells: Vec<&str>| Room {
        name: ticked(cells[0]).into(),
        package: ticked(cells[1]).into(),
        may_name: ticked(cells[3]).split_whitespace().map(String::from).collect(),
        open_first: ticked(cells[4]).into(),
    };
    rows.map(room).collect()
}

impl Room {
    /// Whether the room is a package of its own, whose paths begin in its folder.
    pub(super) fn is_package(&self) -> bool {
        self.package == format!("regatta-{}", self.name)
    }

    /// The rooms that the package's manifest lists for more than its tests.
    fn listed(&self) -> BTreeSet<String> {
        let manifest = root().join("src").join(&self.name).join("Cargo.toml");
        let manifest = std::fs::read_to_string(manifest).expect("a room's manifest");
        let (_, after) = manifest.split_once("[dependencies]\n").unwrap_or_default();
        let lines = after.lines().take_while(|line| !line.starts_with('['));
        let names = lines.filter_map(|line| line.strip_prefix("regatta-"));
        names.filter_map(|name| name.split(['.', ' ']).next()).map(String::from).collect()
    }
}

/// The files of a room: its folder, and the file of the same name.
pub(super) fn of_room(name: &str) -> Vec<Source> {
    let all = sources("src", &["rs"]).into_iter();
    let (file, folder) = (format!("src/{name}.rs"), format!("src/{name}/"));
    all.filter(|source| source.path == file || source.path.starts_with(&folder)).collect()
}

/// The rooms that a file outside its tests names and may not.
fn strangers(source: &Source, room: &Room, rooms: &[Room]) -> Vec<String> {
    let code = source.text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let named = named(code).into_iter().filter(|path| path[0] == "crate");
    let others = named.filter_map(|path| path.get(1).cloned()).filter(|other| *other != room.name);
    let is_room = |name: &String| rooms.iter().any(|room| room.name == *name);
    let found: BTreeSet<String> =
        others.filter(|other| is_room(other) && !room.may_name.contains(other)).collect();
    found.into_iter().map(|other| format!("{} may not name {other}", source.path)).collect()
}

#[test]
fn a_room_names_only_the_rooms_that_its_row_lists() {
    let rooms = rooms();
    assert!(rooms.len() > 10 && rooms.iter().all(|room| !of_room(&room.name).is_empty()));
    for (n, room) in rooms.iter().enumerate() {
        let below: BTreeSet<String> = rooms[..n].iter().map(|room| room.name.clone()).collect();
        let listed = room.may_name.iter().filter(|name| !below.contains(*name));
        none(listed.map(|name| format!("{} lists {name}, which is above it", room.name)).collect());
        assert!(root().join("src").join(&room.open_first).exists(), "{}", room.open_first);
        if room.is_package() {
            assert_eq!(room.listed(), room.may_name, "the manifest of {}", room.name);
            continue;
        }
        assert_eq!(room.package, "regatta", "{}", room.name);
        let is_test = |source: &Source| source.path.ends_with("/tests.rs");
        let files = of_room(&room.name).into_iter().filter(|source| !is_test(source));
        none(files.flat_map(|source| strangers(&source, room, &rooms)).collect());
    }
}

#[test]
fn every_folder_of_the_source_is_a_room_or_a_text() {
    let rooms = rooms();
    let folders = std::fs::read_dir(root().join("src")).expect("a folder").flatten();
    let folders = folders.filter(|entry| entry.path().is_dir()).map(|entry| entry.file_name());
    let known = |name: &str| {
        ["manual", "web"].contains(&name) || rooms.iter().any(|room| room.name == name)
    };
    none(folders.filter_map(|name| name.into_string().ok()).filter(|name| !known(name)).collect());
}

#[test]
fn a_name_from_a_room_above_is_detected() {
    let text = "use crate::{commands::Cli, sim::State};\nfn f(a: crate::view::A) {}";
    let (rooms, source) =
        (rooms(), Source { path: "src/window/event.rs".into(), text: text.into() });
    let window = rooms.iter().find(|room| room.name == "window").expect("a room");
    assert_eq!(strangers(&source, window, &rooms).len(), 2);
    let run = rooms.iter().find(|room| room.name == "run").expect("a room");
    assert!(run.is_package() && run.listed().contains("sim") && !window.is_package());
}
