//! No file of a layer depends on one that depends on it.
//!
//! A file depends on the files whose items it names. A re-exported name is followed to its own file. Tests at a
//! file's end may look wherever they like.
//!
//! A module and the files below it are one thing in several files: a file may name the module that it is a part of.
//! In return, whoever names a part from outside depends on the whole.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::slice;

use super::paths::named;
use super::rooms::{Room, of_room, rooms};
use super::{Source, none, sources};

/// A module's path from the crate's root, such as `["commands", "sweep", "grid"]`.
type Module = Vec<String>;

/// The module that is in the file at this path.
fn module_of(path: &str) -> Module {
    let inside = path.trim_start_matches("src/").trim_end_matches(".rs").trim_end_matches("/mod");
    inside.split('/').map(String::from).collect()
}

/// The modules of the files with the paths that they name, from the crate's root and not yet followed.
fn names(sources: &[Source]) -> BTreeMap<Module, Vec<Module>> {
    let modules: BTreeSet<Module> = sources.iter().map(|source| module_of(&source.path)).collect();
    let names_in = |source: &Source| {
        let module = module_of(&source.path);
        let tests = ["#[cfg(test)]\nmod ", "#[cfg(all(test, "];
        let ends = tests.iter().filter_map(|start| source.text.find(start));
        let code = &source.text[..ends.min().unwrap_or(source.text.len())];
        let names = named(code).into_iter();
        let names = names.filter_map(|path| from_the_root(&module, &path, &modules)).collect();
        (module, names)
    };
    sources.iter().map(names_in).collect()
}

/// A path written in `module`, from the crate's root; `None` if it leads to another crate.
fn from_the_root(module: &Module, path: &[String], modules: &BTreeSet<Module>) -> Option<Module> {
    let ups = path.iter().take_while(|part| *part == "super").count();
    match &*path[0] {
        "crate" => Some(path[1..].to_vec()),
        "self" => Some([module, &path[1..]].concat()),
        "super" => Some([&module[..module.len().checked_sub(ups)?], &path[ups..]].concat()),
        _ => {
            let child = [module, &path[..1]].concat();
            modules.contains(&child).then(|| [module, path].concat())
        }
    }
}

/// The file that defines `path`.
fn owner(path: &[String], names: &BTreeMap<Module, Vec<Module>>) -> Option<Module> {
    let module = (1..=path.len()).rev().find(|&n| names.contains_key(&path[..n]))?;
    let (module, rest) = path.split_at(module);
    let is_in_a_child =
        |name: &&Module| name.starts_with(module) && names.contains_key(&name[..module.len() + 1]);
    let is_item = |name: &&Module| !rest.is_empty() && name.last() == rest.first();
    match names[module].iter().find(|name| is_in_a_child(name) && is_item(name)) {
        Some(handed_on) => owner(handed_on, names),
        None => Some(module.to_vec()),
    }
}

/// The modules that `module` depends on by naming an item of `owner`: `owner` itself, and every module around `owner`
/// that is not around `module`.
fn depended_on(module: &Module, owner: &Module) -> Vec<Module> {
    let wholes = (1..=owner.len()).map(|n| owner[..n].to_vec());
    wholes.filter(|whole| !module.starts_with(whole)).collect()
}

/// The files that each file depends on.
fn dependencies(sources: &[Source]) -> BTreeMap<Module, BTreeSet<Module>> {
    let names = names(sources);
    let of = |(module, named): (&Module, &Vec<Module>)| {
        // A file above alone, as in `pub(in crate::commands)`, is no dependency.
        let items = named.iter().filter(|path| !module.starts_with(path));
        let owners = items.filter_map(|path| owner(path, &names));
        let all = owners.flat_map(|owner| depended_on(module, &owner));
        let all = all.filter(|owner| owner != module && names.contains_key(owner));
        (module.clone(), all.collect())
    };
    names.iter().map(of).collect()
}

/// Every file that depends on itself by way of others, with a shortest way.
fn circles(sources: &[Source]) -> Vec<Vec<Module>> {
    let dependencies = dependencies(sources);
    let circle = |start: &Module| {
        let (mut ways, mut seen) = (VecDeque::from([vec![start.clone()]]), BTreeSet::new());
        while let Some(way) = ways.pop_front() {
            for next in dependencies.get(way.last()?).into_iter().flatten() {
                let longer = [&way[..], slice::from_ref(next)].concat();
                if next == start {
                    return Some(longer);
                }
                if seen.insert(next) {
                    ways.push_back(longer);
                }
            }
        }
        None
    };
    dependencies.keys().filter_map(circle).collect()
}

fn shown(circle: &[Module]) -> String {
    circle.iter().map(|module| module.join("::")).collect::<Vec<_>>().join(" → ")
}

/// The page is a crate of its own, whose paths begin at `src/web`.
fn of_the_page() -> Vec<Source> {
    let files = sources("src/web", &["rs"]).into_iter();
    files.map(|file| Source { path: file.path.replacen("src/web/", "src/", 1), ..file }).collect()
}

/// The files of a room, with all paths from the root of `src`. Those of a package begin at the room.
fn from_src(room: &Room) -> Vec<Source> {
    let files = of_room(&room.name).into_iter();
    let here = if room.is_package() { format!("crate::{}::", room.name) } else { "crate::".into() };
    files.map(|file| Source { text: file.text.replace("crate::", &here), ..file }).collect()
}

#[test]
fn no_file_depends_on_itself() {
    let in_rooms = rooms().into_iter().flat_map(|room| circles(&from_src(&room)));
    let circles: Vec<_> = in_rooms.chain(circles(&of_the_page())).collect();
    none(circles.iter().map(|circle| shown(circle)).collect());
}

#[test]
fn naming_a_part_counts_as_depending_on_its_whole() {
    let file = |path: &str, text: &str| Source { path: path.into(), text: text.into() };
    let root = file("src/a/mod.rs", "mod b;\nmod c;");
    let part = file("src/a/c/d.rs", "use super::C;\npub struct D;");
    let found = |b: &str, c: &str| -> Vec<String> {
        let files = [("mod.rs", &*root.text), ("b.rs", b), ("c.rs", c), ("c/d.rs", &*part.text)];
        let files = files.map(|(name, text)| file(&format!("src/a/{name}"), text));
        circles(&files).iter().map(|circle| shown(circle)).collect()
    };
    none(found("use super::c::d::D;", "mod d;\nuse d::D;\npub struct C;"));
    let circle = found("use super::c::d::D;", "mod d;\npub struct C;\nuse super::b;");
    assert_eq!(circle, ["a::b → a::c → a::b", "a::c → a::b → a::c"]);
}

#[test]
fn circles_through_reexported_names_are_detected() {
    let file = |path: &str, text: &str| Source { path: path.into(), text: text.into() };
    let root = file("src/a/mod.rs", "mod b;\nmod c;\nuse b::go;\npub use c::{C, D};");
    let b = file("src/a/b.rs", "use super::C; fn go() {}");
    let c = |text: &str| file("src/a/c/mod.rs", text);
    let d =
        file("src/a/c/d.rs", "pub struct D;\n#[cfg(test)]\nmod tests {\nuse super::super::C;\n}");
    let found = |text: &str| -> Vec<String> {
        let files = [&root, &b, &c(text), &d].map(|f| file(&f.path, &f.text));
        circles(&files).iter().map(|circle| shown(circle)).collect()
    };
    none(found("mod d; pub use d::D; pub struct C(D); use crate::elsewhere::X;"));
    assert_eq!(found("use crate::a::b;"), ["a::b → a::c → a::b", "a::c → a::b → a::c"]);
    assert_eq!(found("fn f() { super::b::go() }").len(), 2);
    none(found("mod d; pub use d::D; pub struct C(D); use super::{C as _, D as _};"));
    none(found("use super::tell;"));
    none(found("pub(in crate::a) struct C;"));
}
