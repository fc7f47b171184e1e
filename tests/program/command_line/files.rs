//! Other people's files, other writers, links and devices: foreign files stay unchanged.

use std::fs;
use std::path::Path;
use std::time::Duration;

use regatta::scene::Scene;

#[cfg(unix)]
use super::ended_by;
use super::{names, run_in, start, stderr};

const GIF: &str = "capture --scene spring --frames 3 --size 32x18 --scale 0.5";

#[test]
fn the_extension_of_a_file_sets_its_format() {
    let folder = tempfile::tempdir().unwrap();
    for (out, begin) in
        [("run.gif", &b"GIF89a"[..]), ("run.y4m", b"YUV4MPEG2 "), ("run.png", b"\x89PNG\r\n")]
    {
        let output = run_in(folder.path(), &format!("{GIF} --out {out}"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        assert!(fs::read(folder.path().join(out)).unwrap().starts_with(begin), "{out}");
    }
    assert_eq!(names(folder.path()), ["run.gif", "run.png", "run.y4m"]);
}

#[cfg(unix)]
#[test]
fn files_named_like_unfinished_ones_are_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let clip = folder.path().join("clip");
    fs::create_dir(&clip).unwrap();
    fs::write(folder.path().join("elsewhere"), "mine").unwrap();
    fs::write(folder.path().join("run.gif.part"), "mine").unwrap();
    for name in ["frame-000000.png.part", "manifest.json.part"] {
        std::os::unix::fs::symlink("../elsewhere", clip.join(name)).unwrap();
    }
    for out in ["run.gif", "clip --force"] {
        let output = run_in(folder.path(), &format!("{GIF} --out {out}"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
    for name in ["elsewhere", "run.gif.part"] {
        assert_eq!(fs::read(folder.path().join(name)).unwrap(), b"mine", "{name}");
    }
    let links = ["frame-000000.png.part", "manifest.json.part"];
    assert!(links.iter().all(|name| fs::read_link(clip.join(name)).is_ok()));
    assert_eq!(names(&clip).len(), 3 + 1 + 2);
}

#[test]
fn a_foreign_manifest_or_frame_is_never_replaced() {
    for (name, mine) in [
        ("manifest.json", r#"{ "name": "my web app", "version": "1.0", "frames": [] }"#),
        ("frame-000001.png", "a frame of another program"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let clip = folder.path().join("clip");
        fs::create_dir(&clip).unwrap();
        fs::write(clip.join(name), mine).unwrap();
        let output = run_in(folder.path(), &format!("{GIF} --out clip --force"));
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        let reason = format!("clip/{name} was not made by regatta and is not replaced; move it");
        assert!(stderr(&output).contains(&reason), "{}", stderr(&output));
        assert_eq!(names(&clip), [name]);
        assert_eq!(fs::read_to_string(clip.join(name)).unwrap(), mine);
    }
}

#[cfg(unix)]
#[test]
fn a_directory_being_written_is_locked_against_writers_and_judges() {
    let folder = tempfile::tempdir().unwrap();
    let endless = GIF.replace("--frames 3", "--frames 100000");
    let first = start(folder.path(), &format!("{endless} --out clip"));
    while !folder.path().join("clip/frame-000002.png").exists() {
        std::thread::sleep(Duration::from_millis(5));
    }
    for other in ["--out clip", "--out clip --force"] {
        let output = run_in(folder.path(), &format!("{GIF} {other}"));
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        let reason =
            "another regatta is writing to clip; wait until it has finished, or give another --out";
        assert!(stderr(&output).contains(reason), "{other}: {}", stderr(&output));
    }
    let judged = run_in(folder.path(), "verify clip");
    assert_eq!(judged.status.code(), Some(2));
    assert!(stderr(&judged).contains("another regatta is writing to it"), "{}", stderr(&judged));
    assert_eq!(ended_by("-INT", first).status.code(), Some(130));
    let output = run_in(folder.path(), &format!("{GIF} --out clip --force"));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(names(&folder.path().join("clip")).len(), 4);
}

#[test]
fn two_writers_of_one_file_leave_one_whole_result() {
    let folder = tempfile::tempdir().unwrap();
    let runs = [GIF.replace("spring", "ship"), GIF.replace("spring", "orbit")];
    let alone = |n: usize| format!("{} --out {n}.gif", runs[n]);
    (0..2).for_each(|n| _ = run_in(folder.path(), &alone(n)));
    let whole = [0, 1].map(|n| fs::read(folder.path().join(format!("{n}.gif"))).unwrap());
    assert!(whole[0] != whole[1]);
    for _ in 0..3 {
        let writers = runs
            .each_ref()
            .map(|run| start(folder.path(), &format!("{run} --out run.gif --force")));
        for writer in writers {
            let output = writer.wait_with_output().unwrap();
            assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        }
        assert!(whole.contains(&fs::read(folder.path().join("run.gif")).unwrap()));
        assert_eq!(names(folder.path()), ["0.gif", "1.gif", "run.gif"]);
    }
}

#[cfg(unix)]
#[test]
fn a_symbolic_link_stays_and_its_target_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("real")).unwrap();
    fs::write(path("real/old.gif"), "old").unwrap();
    std::os::unix::fs::symlink("real/old.gif", path("link.gif")).unwrap();
    std::os::unix::fs::symlink("real/new.gif", path("dangling.gif")).unwrap();
    for (link, target) in [("link.gif", "real/old.gif"), ("dangling.gif", "real/new.gif")] {
        let capture = format!("{GIF} --out {link}");
        let refused = run_in(folder.path(), &capture);
        assert_eq!(refused.status.code(), Some(2), "{}", stderr(&refused));
        assert!(stderr(&refused).contains(&format!("{link} already exists; give another --out")));
        let forced = run_in(folder.path(), &format!("{capture} --force"));
        assert_eq!(forced.status.code(), Some(0), "{}", stderr(&forced));
        assert_eq!(fs::read_link(path(link)).unwrap(), Path::new(target));
        assert!(fs::read(path(target)).unwrap().starts_with(b"GIF89a"));
    }
    assert_eq!(names(&path("real")), ["new.gif", "old.gif"]);
    std::os::unix::fs::symlink("ring.gif", path("ring.gif")).unwrap();
    let refused = run_in(folder.path(), &format!("{GIF} --out ring.gif --force"));
    assert_eq!(refused.status.code(), Some(1), "{}", stderr(&refused));
}

#[test]
fn an_output_never_replaces_an_input() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let scene = Scene::built_in("spring").unwrap().to_toml();
    fs::create_dir(path("x")).unwrap();
    fs::write(path("in"), &scene).unwrap();
    let mut forms = vec!["in", "./in", "./x/../in"];
    #[cfg(unix)]
    for (link, target) in [("link", "in"), ("x/far", "../link")] {
        std::os::unix::fs::symlink(target, path(link)).unwrap();
        forms.push(link);
    }
    let sweep = "sweep --method rk4 --tick-hz 60 --seconds 0.1 --scene";
    let game_loop = "loop --trace edge --policy fixed --seconds 1 --scene";
    let cloud = "cloud --points 10 --seconds 0.1 --scene";
    for (command, option) in [
        (format!("{sweep} spring --scene"), "--out"),
        (sweep.to_owned(), "--plot"),
        (cloud.to_owned(), "--out"),
        (game_loop.to_owned(), "--out"),
        (game_loop.to_owned(), "--frame-rows"),
        (game_loop.to_owned(), "--plot"),
        ("capture --format gif --scene".to_owned(), "--out"),
        ("capture --format sheet --scene".to_owned(), "--out"),
        ("play --seconds 0.1 --scene".to_owned(), "--record"),
    ] {
        for form in &forms {
            for (read, written) in [("in", *form), (*form, "in")] {
                let command = format!("{command} {read} {option} {written}");
                for command in [command.clone(), format!("{command} --force")] {
                    let output = run_in(folder.path(), &command);
                    let said = stderr(&output);
                    assert_eq!(output.status.code(), Some(2), "{command}: {said}");
                    let why =
                        format!("{written} is the scene that is run; give another {option}\n");
                    assert!(said.ends_with(&why), "{command}: {said}");
                    assert_eq!(fs::read_to_string(path("in")).unwrap(), scene, "{command}");
                }
            }
        }
    }
    // A file with the name of a built-in scene does not replace the scene.
    fs::write(path("spring"), "mine").unwrap();
    let output = run_in(folder.path(), &format!("{cloud} spring --out spring --force"));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let same = "loop --trace edge --policy fixed --seconds 1 --out a.csv --frame-rows ./x/../a.csv";
    let output = run_in(folder.path(), same);
    assert!(stderr(&output).contains("two outputs would go to the same place"));
}
