//! The manual's test for continuous integration, in a stranger's crate: it passes as it is printed, and fails
//! as soon as any lane's method is another.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{env, fs};

use regatta::lab::{Race, Scene};

use regatta::manual::{CHAPTERS, chapter};
const SCENE: &str = include_str!("../../assets/scenes/stiff.toml");
/// No lane of the scene.
const OTHER: &str = "midpoint";

/// What the manual prints in a language.
fn blocks(language: &str) -> impl Iterator<Item = &'static str> {
    let fence = format!("```{language}\n");
    let blocks = |text: &'static str| {
        let texts: Vec<_> = text.split(&*fence).skip(1).collect();
        texts.into_iter().map(|rest| rest.split("```").next().unwrap())
    };
    CHAPTERS.iter().flat_map(|chapter| blocks(chapter.text)).collect::<Vec<_>>().into_iter()
}

/// The test as the manual prints it.
fn recipe() -> &'static str {
    let mut tests = blocks("rust").filter(|block| block.contains("#[test]"));
    tests.next().expect("the manual prints a test")
}

/// The body of one's own as the manual prints it, as a program. It is judged for a shorter time, since it is not optimised.
fn custom_body() -> String {
    let mut bodies = blocks("rust").filter(|block| block.contains("impl System for"));
    let printed = bodies.next().expect("the manual prints a body");
    let shorter = printed.replace("seconds: 5.0", "seconds: 0.5");
    assert_ne!(shorter, printed, "the manual judges it for another time");
    format!("fn main() {{\n{shorter}}}\n")
}

/// The dependencies as the manual prints them, on this source tree.
fn manifest() -> String {
    let mut tables = blocks("toml").filter(|table| table.contains("[dependencies]\nregatta = "));
    let printed = tables.next().expect("the manual prints the dependencies");
    let here = format!("path = {:?}", env!("CARGO_MANIFEST_DIR"));
    let dependencies = printed.replace("version = \"0.1\"", &here);
    assert_ne!(dependencies, printed, "the manual prints another version");
    format!(
        "[package]\nname = \"stranger\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n\
         {dependencies}\n[workspace]\n"
    )
}

/// A package beside the others in the target folder, so that what it depends on is compiled once.
struct Stranger {
    folder: PathBuf,
    target: PathBuf,
}

impl Stranger {
    fn new(folder: &str) -> Self {
        let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("stranger-target");
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(folder);
        let write = |path: &str, text: &str| {
            let path = folder.join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        };
        write("Cargo.toml", &manifest());
        write("Cargo.lock", include_str!("../../Cargo.lock"));
        write("src/lib.rs", "");
        write("tests/physics.rs", recipe());
        for (name, text) in examples().filter(runs_without_graphics) {
            write(&format!("examples/{name}.rs"), &text);
        }
        write("examples/printed_body.rs", &custom_body());
        Self { folder, target }
    }

    /// Runs the package's tests with this scene.
    fn test(&self, scene: &str) -> Output {
        let file = self.folder.join("assets/scenes/stiff.toml");
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, scene).unwrap();
        self.cargo(&["test", "--quiet", "--offline", "--test", "physics"])
    }

    fn cargo(&self, arguments: &[&str]) -> Output {
        // Its few steps take less than optimising would.
        let unoptimised = ["--config", "profile.dev.package.regatta.opt-level=0"];
        Command::new(env!("CARGO"))
            .args(unoptimised)
            .args(arguments)
            .current_dir(&self.folder)
            .env("CARGO_TARGET_DIR", &self.target)
            .env_remove("RUSTFLAGS")
            .env_remove("RUSTC_WORKSPACE_WRAPPER")
            .output()
            .expect("cargo runs this test too")
    }
}

/// Whether an example needs no more than a game's tests have.
fn runs_without_graphics((name, _): &(String, String)) -> bool {
    let declared = format!("[[example]]\nname = \"{name}\"\nrequired-features = ");
    let (_, needed) = include_str!("../../Cargo.toml").split_once(&declared).unwrap_or_default();
    !["[\"view\"]", "[\"window\"]"].iter().any(|layer| needed.starts_with(layer))
}

/// The programs of `examples`, by their names.
fn examples() -> impl Iterator<Item = (String, String)> {
    let folder = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples")).unwrap();
    folder.map(|entry| {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        (name, fs::read_to_string(path).unwrap())
    })
}

fn said(output: &Output) -> String {
    let [out, err] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    format!("{out}{err}")
}

#[test]
fn the_manuals_test_passes_and_fails_for_every_lane_whose_method_is_another() {
    let stranger = Stranger::new("stranger-with-a-test");
    let output = stranger.test(SCENE);
    assert!(output.status.success(), "{}", said(&output));
    assert!(said(&output).contains("1 passed"), "{}", said(&output));
    let lanes = Scene::parse("stiff.toml", SCENE).unwrap().lanes;
    assert!(lanes.len() > 1);
    for lane in lanes {
        let output = stranger.test(&with_another(lane.method.id));
        let said = said(&output);
        assert!(!output.status.success(), "{} may change unseen", lane.method.id);
        assert!(said.contains("the_physics_is_what_it_was") && said.contains(OTHER), "{said}");
    }
}

#[test]
fn the_examples_run_in_a_package_of_their_own() {
    let stranger = Stranger::new("stranger-with-examples");
    let mut ran = 0;
    for example in examples() {
        let name = &example.0;
        let file = format!("`examples/{name}.rs`");
        assert!(chapter("library").unwrap().text.contains(&file), "the manual leaves out {name}");
        if !runs_without_graphics(&example) {
            continue;
        }
        ran += 1;
        let output = stranger.cargo(&["run", "--quiet", "--offline", "--example", name]);
        assert!(output.status.success() && !output.stdout.is_empty(), "{}", said(&output));
    }
    assert!(ran > 5 && ran < examples().count(), "{ran} examples");
    let output = stranger.cargo(&["run", "--quiet", "--offline", "--example", "printed_body"]);
    assert!(
        output.status.success() && said(&output).contains("body at 60 Hz"),
        "{}",
        said(&output)
    );
}

/// The scene with another method in this one's lane.
fn with_another(id: &str) -> String {
    let methods = SCENE.lines().find(|line| line.starts_with("methods = ")).unwrap();
    let changed =
        SCENE.replace(methods, &methods.replace(&format!("\"{id}\""), &format!("{OTHER:?}")));
    assert_ne!(changed, SCENE);
    // Without the opening method, which may be the one that is gone.
    changed
        .lines()
        .filter(|line| !line.starts_with("method = "))
        .map(|l| format!("{l}\n"))
        .collect()
}

#[test]
fn another_method_shows_in_its_own_hash_and_in_no_other() {
    let hashes = |text: &str| {
        let mut race = Race::of_scene(&Scene::parse("stiff.toml", text).unwrap());
        race.run(600);
        race.lane_hashes().collect::<Vec<_>>()
    };
    let printed = hashes(SCENE);
    for (n, lane) in Scene::parse("stiff.toml", SCENE).unwrap().lanes.iter().enumerate() {
        let found = hashes(&with_another(lane.method.id));
        let changed: Vec<usize> = (0..found.len()).filter(|&i| found[i] != printed[i]).collect();
        assert_eq!(changed, [n]);
    }
}
