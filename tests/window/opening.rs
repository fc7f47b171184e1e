//! Scene files opened in the window, and changed on disk.

use std::path::{Path, PathBuf};

use regatta::scene::SCENES;
use tempfile::TempDir;

use crate::desk::{Desk, until};

fn text(scene: &str) -> &'static str {
    SCENES.iter().find(|listed| listed.name == scene).unwrap().text
}

/// A folder with a file of this name and text, and the file's path.
fn file(name: &str, text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

fn type_path(desk: &Desk, path: &Path) {
    desk.press("o");
    desk.xdotool(&format!("type --delay 1 {}", path.display()));
}

pub(crate) fn a_typed_path_opens_its_scene_and_keeps_it_on_the_list() {
    let (_folder, path) = file("ship.toml", text("ship"));
    let desk = Desk::open("--scene spring");
    type_path(&desk, &path);
    desk.press("Escape 2");
    desk.titled("Regatta - spring - Semi-implicit Euler - 60 Hz");
    type_path(&desk, &path);
    desk.press("Return");
    desk.titled("Regatta - ship.toml - Explicit Euler - 2 Hz");
    desk.press("n");
    desk.titled("Regatta - harbour - Explicit Euler - 60 Hz");
    desk.press("b");
    desk.titled("Regatta - ship.toml - Explicit Euler - 2 Hz");
    desk.quit();
}

pub(crate) fn a_path_is_completed_by_tab() {
    let (folder, _) = file("swinging.toml", text("pendulum"));
    let desk = Desk::open("--scene spring");
    type_path(&desk, &folder.path().join("sw"));
    desk.press("Tab");
    desk.press("Return");
    desk.titled("Regatta - swinging.toml - Explicit Euler - 60 Hz");
    desk.quit();
}

pub(crate) fn a_path_without_a_scene_is_reported_and_the_run_continues() {
    let (folder, _) = file("other.toml", text("ship"));
    let desk = Desk::open("--scene spring");
    desk.press("space");
    until("a pause", || desk.title().contains("(paused").then_some(()));
    let title = desk.title();
    desk.still();
    let before = desk.sight();
    type_path(&desk, &folder.path().join("none.toml"));
    desk.press("Return");
    desk.still();
    assert_ne!(desk.sight(), before);
    assert_eq!(desk.title(), title);
    // The field is still there, with the path: it is mended at its end.
    for _ in 0.."none.toml".len() {
        desk.press("BackSpace");
    }
    desk.xdotool("type --delay 1 other.toml");
    desk.press("Return");
    desk.titled("Regatta - other.toml - Explicit Euler - 2 Hz (paused)");
    type_path(&desk, &folder.path().join("none.toml"));
    desk.press("Return");
    desk.still();
    desk.press_and_see("Escape");
    desk.press("space 2");
    desk.titled("Regatta - other.toml - Semi-implicit Euler - 2 Hz");
    desk.quit();
}

pub(crate) fn a_deleted_file_is_reported_and_a_restored_one_is_reread() {
    let before = text("spring");
    let (_folder, path) = file("mine.toml", before);
    let desk = Desk::open(&format!("--scene {}", path.display()));
    desk.titled("Regatta - mine.toml - Explicit Euler - 60 Hz");
    desk.press("space");
    until("a pause", || desk.title().contains("(paused").then_some(()));
    let title = desk.title();
    desk.still();
    let footer = || {
        let sight = desk.sight();
        let line = sight.height() - 26;
        image::imageops::crop_imm(&sight, 0, line, 700, 26).to_image()
    };
    let hint = footer();
    std::fs::remove_file(&path).unwrap();
    until("the notice", || (footer() != hint).then_some(()));
    desk.still();
    let gone = footer();
    std::fs::write(&path, before).unwrap();
    until("another notice", || (footer() != gone).then_some(()));
    assert_eq!(desk.title(), title, "the run is left alone");
    std::fs::remove_file(&path).unwrap();
    until("the same notice", || (footer() == gone).then_some(()));
    std::fs::write(&path, before.replace("tick_hz = 60", "tick_hz = 40")).unwrap();
    desk.titled(&title.replace("60 Hz", "40 Hz"));
    desk.quit();
}

pub(crate) fn a_file_changed_on_disk_is_taken_with_its_state_unless_it_is_broken() {
    let before = text("spring");
    let (folder, path) = file("mine.toml", before);
    let desk = Desk::open(&format!("--scene {}", path.display()));
    desk.titled("Regatta - mine.toml - Explicit Euler - 60 Hz");
    std::fs::write(&path, before.replace("tick_hz = 60", "tick_hz = 50")).unwrap();
    desk.titled("Regatta - mine.toml - Explicit Euler - 50 Hz");
    desk.press("space");
    until("a pause", || desk.title().contains("(paused").then_some(()));
    let title = desk.title();
    desk.still();
    // Paused, too; and as editors save, by another file renamed over it.
    let sight = desk.sight();
    let other = folder.path().join("mine.toml~");
    std::fs::write(&other, before.replace("tick_hz = 60", "tick_hz = sixty")).unwrap();
    std::fs::rename(&other, &path).unwrap();
    until("the mistakes", || (desk.sight() != sight).then_some(()));
    assert_eq!(desk.title(), title);
    std::fs::write(&path, before.replace("tick_hz = 60", "tick_hz = 40")).unwrap();
    desk.titled(&title.replace("50 Hz", "40 Hz"));
    desk.quit();
}

pub(crate) fn changed_lines_of_a_method_go_on_from_the_state_in_the_window() {
    let (_folder, path) = file("My_Step.step", "v += h * a(x, v); x += h * v");
    for options in ["", &format!(" --method {}", path.display())] {
        std::fs::write(&path, "v += h * a(x, v); x += h * v").unwrap();
        let desk = Desk::open(&format!("--scene spring{options}"));
        if options.is_empty() {
            type_path(&desk, &path);
            desk.press("Return");
        }
        until("the method", || desk.title().contains("my-step").then_some(()));
        desk.press("space");
        until("a pause", || desk.title().contains("(paused").then_some(()));
        let title = desk.title();
        desk.still();
        let sight = desk.sight();
        std::fs::write(&path, "x += h * v; v += h * a(x, v)").unwrap();
        until("a notice", || (desk.sight() != sight).then_some(()));
        assert_eq!(desk.title(), title);
        desk.quit();
    }
}
