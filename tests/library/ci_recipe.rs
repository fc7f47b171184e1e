//! The manual's recipe for another package. Its test passes, and fails as soon as any lane has another method. Its
//! body and the examples compile with this library alone, and its dependencies are valid in a package.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;
use std::{env, fs};

use regatta::manual::{CHAPTERS, chapter};
use regatta::run::Race;
use regatta::scene::Scene;

use crate::printed::texts;

const SCENE: &str = include_str!("../../assets/scenes/stiff.toml");
/// No lane of the scene.
const OTHER: &str = "midpoint";

/// The manual's code blocks in one language.
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

/// The manual's custom body as a program, judged over a shorter time because it is not optimised.
fn custom_body() -> String {
    let mut bodies = blocks("rust").filter(|block| block.contains("impl System for"));
    let printed = bodies.next().expect("the manual prints a body");
    let shorter = printed.replace("seconds: 5.0", "seconds: 0.5");
    assert_ne!(shorter, printed, "the manual judges it for another time");
    format!("fn main() {{\n{shorter}}}\n")
}

/// The dependencies as the manual prints them, on this source tree.
fn manifest() -> String {
    let mut tables =
        blocks("toml").filter(|table| table.contains("[dependencies]\nregatta-sim = "));
    let printed = tables.next().expect("the manual prints the dependencies");
    let dependencies = printed.replace("../regatta", env!("CARGO_MANIFEST_DIR"));
    assert_ne!(dependencies, printed, "the manual prints another version");
    format!(
        "[package]\nname = \"stranger\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n\
         {dependencies}\n[workspace]\n"
    )
}

/// The products of Cargo with the features of these tests: the library, and the example programs by name.
static MADE: LazyLock<(PathBuf, Vec<(String, PathBuf)>)> = LazyLock::new(|| {
    let mut made = Command::new(env!("CARGO"));
    made.args(["build", "--examples", "--offline", "--quiet", "--message-format", "json"]);
    made.current_dir(env!("CARGO_MANIFEST_DIR"));
    if !cfg!(debug_assertions) {
        made.arg("--release");
    }
    if !cfg!(feature = "accessibility") {
        let parts = if cfg!(feature = "window") { "cli,window" } else { "cli" };
        made.args(["--no-default-features", "--features", parts]);
    }
    let made = made.output().expect("cargo runs this test too");
    assert!(made.status.success(), "{}", said(&made));
    let (mut library, mut examples) = (None, Vec::new());
    for line in String::from_utf8(made.stdout).unwrap().lines() {
        let made: serde_json::Value = serde_json::from_str(line).unwrap();
        let target = &made["target"];
        let (name, kind) = (target["name"].as_str(), target["kind"][0].as_str());
        let file = |file: &serde_json::Value| file.as_str().map(PathBuf::from);
        match (name, kind) {
            (Some("regatta"), Some("lib")) => {
                let mut files = made["filenames"].as_array().unwrap().iter().filter_map(file);
                library = files.find(|file| file.extension().is_some_and(|it| it == "rlib"));
            }
            (Some(name), Some("example")) => {
                examples.extend(file(&made["executable"]).map(|file| (name.to_owned(), file)));
            }
            _ => {}
        }
    }
    (library.expect("these tests are linked with it"), examples)
});

/// A folder of a stranger's package.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("stranger").join(name);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Compiles a program of a stranger's, who has this library and nothing else.
fn compile(name: &str, text: &str, arguments: &[&str]) -> PathBuf {
    let folder = folder("tests");
    let source = folder.join(name).with_extension("rs");
    fs::write(&source, text).unwrap();
    let (library, _) = &*MADE;
    let output = Command::new(Path::new(env!("CARGO")).with_file_name("rustc"))
        .args(["--edition", "2024", "--extern"])
        .arg(format!("regatta={}", library.display()))
        .arg("-L")
        .arg(format!("dependency={}", library.with_file_name("deps").display()))
        .arg("-L")
        .arg(format!("dependency={}", library.with_file_name("").display()))
        .arg("--out-dir")
        .arg(&folder)
        .args(arguments)
        .arg(&source)
        .output()
        .expect("cargo has a compiler");
    assert!(output.status.success(), "{}", said(&output));
    folder.join(name).with_extension(env::consts::EXE_EXTENSION)
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
    let files = folder.map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    files.map(|path| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        (name, fs::read_to_string(path).unwrap())
    })
}

fn said(output: &Output) -> String {
    let [out, err] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    format!("{out}{err}")
}

#[test]
fn the_dependencies_in_the_manual_are_valid_in_a_package() {
    let package = folder("package");
    fs::write(folder("package/src").join("lib.rs"), "").unwrap();
    fs::write(package.join("Cargo.toml"), manifest()).unwrap();
    fs::write(package.join("Cargo.lock"), include_str!("../../Cargo.lock")).unwrap();
    let mut tree = Command::new(env!("CARGO"));
    tree.args(["tree", "--offline", "--edges", "features"]).current_dir(&package);
    let output = tree.output().expect("cargo runs this test too");
    assert!(output.status.success(), "{}", said(&output));
    let tree = said(&output);
    assert!(tree.contains("regatta feature \"lab\"") && !tree.contains("wgpu"), "{tree}");
}

#[test]
fn the_manuals_test_fails_for_every_lane_with_another_method() {
    let run = |scene: &str| {
        fs::write(folder("assets/scenes").join("stiff.toml"), scene).unwrap();
        let test = compile("physics", recipe(), &["--test"]);
        Command::new(test).output().expect("it was just compiled")
    };
    let output = run(SCENE);
    assert!(output.status.success(), "{}", said(&output));
    assert!(said(&output).contains("1 passed"), "{}", said(&output));
    let lanes = Scene::parse("stiff.toml", SCENE).unwrap().lanes;
    assert!(lanes.len() > 1);
    for lane in lanes {
        let output = run(&with_another(lane.method.id));
        let said = said(&output);
        assert!(!output.status.success(), "{} may change unseen", lane.method.id);
        assert!(said.contains("the_physics_is_what_it_was") && said.contains(OTHER), "{said}");
    }
}

/// Another glam, with the parts that the manual uses.
const OTHER_GLAM: &str = "#[derive(Clone, Copy)]
pub struct DVec2 { x: f64, y: f64 }
impl DVec2 {
    pub const fn from_array([x, y]: [f64; 2]) -> Self { Self { x, y } }
    pub const fn to_array(self) -> [f64; 2] { [self.x, self.y] }
}";

#[test]
fn the_manuals_lines_for_another_glam_compile_with_another_glam() {
    let library = compile("glam", OTHER_GLAM, &["--crate-type", "rlib"]);
    let other = format!("glam={}", library.with_file_name("libglam.rlib").display());
    let printed = blocks("rust").find(|block| block.contains("use glam::"));
    let printed = printed.expect("the manual has a paragraph on it");
    assert!(printed.contains("use regatta::prelude::*;"), "{printed}");
    let program = format!("{printed}\nfn main() {{}}\n");
    compile("beside_glam", &program, &["--extern", &other, "--emit", "metadata"]);
}

#[test]
fn the_examples_run_with_the_library_alone() {
    let mut ran = 0;
    for example in examples() {
        let (name, text) = &example;
        let file = format!("`examples/{name}.rs`");
        assert!(chapter("library").unwrap().text.contains(&file), "the manual leaves out {name}");
        if !runs_without_graphics(&example) {
            continue;
        }
        ran += 1;
        compile(name, text, &["--emit", "metadata"]);
        let made = MADE.1.iter().find(|made| made.0 == *name).expect("it is made beside the tests");
        let output = Command::new(&made.1).current_dir(env!("CARGO_MANIFEST_DIR")).output();
        let output = output.expect("it was just made");
        assert!(output.status.success() && !output.stdout.is_empty(), "{}", said(&output));
    }
    assert!(ran > 5 && ran < examples().count(), "{ran} examples");
    let output = Command::new(compile("printed_body", &custom_body(), &[])).output().unwrap();
    assert!(
        output.status.success() && said(&output).contains("body at 60 Hz"),
        "{}",
        said(&output)
    );
}

/// The output of the program above an output block, which is named there as `examples/NAME.rs` or printed in full.
fn printed_by(above: &str, number: usize) -> String {
    let paragraph = above.trim_end().rsplit("\n\n").next().unwrap_or_default();
    let named = paragraph.rsplit_once("`examples/").and_then(|(_, rest)| rest.split_once(".rs`"));
    let program = match named {
        Some((name, _)) => {
            let made = MADE.1.iter().find(|made| made.0 == name);
            made.expect("it is made beside the tests").1.clone()
        }
        None => {
            let (_, rust) = above.rsplit_once("```rust\n").expect("a program stands above");
            let (rust, _) = rust.split_once("```").expect("a block ends");
            compile(&format!("printed_{number}"), &format!("fn main() {{\n{rust}}}\n"), &[])
        }
    };
    let output = Command::new(program).current_dir(env!("CARGO_MANIFEST_DIR")).output();
    let output = output.expect("it was just made");
    assert!(output.status.success(), "{}", said(&output));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn every_program_of_the_manual_prints_the_output_below_it() {
    let mut compared = Vec::new();
    for text in texts() {
        for block in text.blocks() {
            let is_synopsis = block.body.starts_with("regatta ");
            if block.language == "text" && !is_synopsis {
                text.hold(block.body, &printed_by(block.above, compared.len()));
                compared.push(text.name);
            }
        }
    }
    assert_eq!(compared, ["library", "stable"]);
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
fn another_method_changes_only_its_own_hash() {
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
