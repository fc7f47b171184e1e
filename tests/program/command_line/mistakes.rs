//! Wrong arguments and wrong scene files: exit code 2, the reason and the remedy.

use std::fs;

use clap::CommandFactory;
use regatta::commands::Cli;
use regatta::scene::Scene;

use super::{refusal, regatta, run, run_in, stderr, stdout_of};

#[test]
fn each_mistake_is_named_with_its_remedy() {
    for (arguments, said) in [
        ("trace --scene shp", "is called \"shp\"; did you mean ship?"),
        ("trace --scene Stiff", "did you mean stiff?"),
        ("trace --scene spring --method lerp-dt", "lerp-dt does not step the body \"spring\""),
        ("capture --out x --scene follow --method lerp-dt", "such as `follow`; name another"),
        (
            "advise --scene lerp --method smooth-damp",
            "smooth-damp does not step the body \"camera\"",
        ),
        ("sweep --scene spring --method lerp-dt", "lerp-dt does not step"),
        ("loop --scene spring --method smooth-damp", "smooth-damp does not step"),
        ("trace --scene nosuch.toml", "give one of these, or the path of a scene file"),
        ("trace --scene nosuch.toml", "no file and no built-in scene (harbour, spring, ship, "),
        ("trace --scene .", ". is a directory without manifest.json; give a scene file, or the"),
        ("trace --method rk5", "did you mean rk4? `regatta list methods` names all"),
        ("trace --method xpbd", "did you mean linearly-implicit-euler?"),
        ("trace --method soft_constraint", "did you mean linearly-implicit-euler?"),
        ("trace --method x", "no such method. `regatta list methods` names all"),
        ("--method runge-kutta", "did you mean rk4?"),
        ("trace --tick-hz 0", "give a rate from 0.01 to 10000 Hz"),
        ("trace --tick-hz 10001", "give a rate from 0.01 to 10000 Hz"),
        ("trace --tick-hz 59,9", "'59,9' for '--tick-hz <N>'"),
        ("trace --seconds -1", "give 0 to 31536000 seconds"),
        ("trace --seconds inf", "give 0 to 31536000 seconds"),
        ("trace --seconds NaN", "give 0 to 31536000 seconds"),
        ("trace --seconds soon", "give a number of seconds, such as 8.5"),
        ("trace --every 0", "0 is not in 1..="),
        ("trace --sceen ship", "a similar argument exists: '--scene'"),
        ("trace --format xml", "csv, json"),
        ("list", "<scenes|methods|impacts|bodies|metrics|policies|engine-loops|traces|keys>"),
        ("list method", "a similar value exists: 'methods'"),
        ("sail", "unrecognized subcommand 'sail'"),
        ("harbor", "tip: there is `regatta harbour`"),
        ("question", "tip: there is `regatta questions`"),
        ("keyz", "tip: there is `regatta keys`"),
        ("nosuch.toml", "no file and no built-in scene"),
        ("trace nosuch.toml", "no file and no built-in scene"),
        ("spring --scene ship", "the argument '--scene <NAME|FILE>' cannot be used multiple times"),
        ("trace --method euler", "did you mean explicit-euler, "),
        ("--method euler", "semi-implicit-euler"),
        ("--loop times.txt", "give it to `regatta loop --trace`"),
        ("completions", "<SHELL>"),
        ("capture --scene ship", "--out <DIR|FILE>"),
        ("capture --out x --size 0x720", "each side has 1 to 8192 pixels"),
        ("capture --out x --size 1280x8193", "each side has 1 to 8192 pixels"),
        ("capture --out x --size big", "such as 1280x720"),
        ("capture --out x --scale 0", "give a number from 0.5 to 4"),
        ("capture --out x --fps 0", "0 is not in 1..=1000"),
        ("capture --out x --frames 0", "0 is not in 1..=1000000"),
        ("capture --out x --frames 2 --seconds 2", "cannot be used with"),
        ("capture --out x --frames 1000000 --size 8192x8192", "fewer --frames or a smaller --size"),
        ("capture --out x --fps 1000 --seconds 9999", "a lower --fps or fewer --seconds"),
        ("capture --out LICENSE-MIT", "LICENSE-MIT is not a directory; give another --out"),
        ("capture --out src", "src is not empty; give another --out, or --force"),
        ("capture --out x --panels some", "on, off"),
        ("capture --out x --scene rope --loop", "is a net, which the loop lab does not take"),
        ("capture --out x --format avi", "png, gif, y4m, sheet"),
        ("capture --out x --format gif --fps 51", "at most 50 frames a second, not 51"),
        ("capture --out src --format gif", "src is a directory; give --out a file"),
        ("capture --out none.gif/", "none.gif/ ends like a directory; give --out a file"),
        ("capture --out src --format gif --force", "src is a directory; give --out a file"),
        ("capture --out x.apng", "regatta writes no .apng files; give --format y4m --out -"),
        ("capture --out x.png --format gif", "give a name that ends in .gif, or --format sheet"),
        ("capture --out x.gif --format png", "give the name of a directory, or --format gif"),
        ("capture --out x.gif --format sheet", "give a name that ends in .png, or --format gif"),
        (
            "capture --out x.txt",
            "regatta capture writes no .txt files; give x.txt without its ending",
        ),
        ("capture --out x.sheet", "a name that ends in .gif, .y4m or .png"),
        ("capture --out x.csv --format gif", "or a name that ends in .gif"),
        ("capture --out x.mp4", "regatta writes no .mp4 files; give --format y4m --out -"),
        ("capture --out x.mp4 --format y4m", "give a name that ends in .y4m, or"),
        ("capture --out x.gif --fps 51", "at most 50 frames a second, not 51"),
        ("capture --out -", "numbered pictures need a directory; give --format y4m, gif"),
        ("capture --out LICENSE-MIT --format y4m", "LICENSE-MIT already exists"),
        ("capture --out x --format sheet --frames 9999", "fewer --frames or a smaller --size"),
        ("capture --out x --mark-every 0", "0 is not in 1..="),
        ("identify /dev/zero --tick-hz 60", "cannot read the log /dev/zero: it is no regular file"),
        ("identify src --tick-hz 60", "cannot read the log src: it is a directory"),
        ("loop --trace /dev/zero", "cannot read the trace /dev/zero: it is no regular file"),
        ("advise --scene /dev/zero", "cannot read the scene file /dev/zero: it is no regular file"),
        ("verify src", "cannot judge src/manifest.json: No such file"),
        ("verify nowhere", "`regatta capture` writes it"),
        ("verify src --max-pixels 101", "give a percentage from 0 to 100"),
        ("verify src --report xml x", "no report format is called \"xml\"; give junit or json"),
        ("verify src --report json x --report xml y", "no report format is called \"xml\""),
        ("verify src --report json x --report junit x", "two reports would go to x"),
        ("verify src --bless", "cannot judge src/manifest.json: No such file"),
    ] {
        let message = refusal(arguments, 2);
        assert!(message.starts_with("error: "), "{arguments}: {message}");
        assert!(message.contains(said), "{arguments}: {message}");
    }
}

#[test]
fn a_bad_scene_file_is_shown_line_by_line() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "title = \"x\"\ntick_hz = 60\nseconds = nan\nmethods = [\"rk5\"]\n[[sprong]]\n";
    fs::write(folder.path().join("bad.toml"), scene).unwrap();
    let expected = "\
bad.toml:3:11: `seconds` is nan, out of range; write a number from 0.0001 to 31536000
  |
3 | seconds = nan
  |           ^^^
bad.toml:4:12: unknown method \"rk5\" in `methods`; did you mean \"rk4\"?
  |
4 | methods = [\"rk5\"]
  |            ^^^^^
bad.toml:5:3: unknown table `sprong`; did you mean `[[spring]]`?
  |
5 | [[sprong]]
  |   ^^^^^^
";
    for command in ["trace", "play", "capture --out x"] {
        let output = run_in(folder.path(), &format!("{command} --scene bad.toml"));
        assert_eq!(stderr(&output), expected, "{command}");
        assert_eq!(output.status.code(), Some(2), "{command}");
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_without_a_writer_is_refused_without_waiting() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.csv");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    for command in [
        "identify pipe.csv --tick-hz 60",
        "loop --trace pipe.csv",
        "loop --scene pipe.csv",
        "trace --scene pipe.csv",
        "verify pipe.csv",
    ] {
        let output = run_in(folder.path(), command);
        assert_eq!(output.status.code(), Some(2), "{command}");
        let said = stderr(&output);
        assert!(said.contains("no regular file but a pipe or a device"), "{command}: {said}");
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_as_manifest_or_frame_is_refused_without_waiting() {
    let folder = tempfile::tempdir().unwrap();
    let make = |path: &str| {
        let path = folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        assert!(std::process::Command::new("mkfifo").arg(&path).status().unwrap().success());
    };
    make("manifest/manifest.json");
    make("frame/frame-000000.png");
    make("swap/.regatta-blessed/manifest.json");
    let pipe = "no regular file but a pipe or a device";
    let capture = "capture --scene ship --frames 1 --size 64x36 --out";
    for (command, told) in [
        ("verify manifest", pipe),
        ("verify manifest --physics-only", pipe),
        ("verify manifest --bless", "manifest.json was not made by regatta"),
        (&*format!("{capture} manifest --force"), "manifest.json was not made by regatta"),
        (&*format!("{capture} frame --force"), "frame-000000.png was not made by regatta"),
        ("verify swap", "manifest.json"),
    ] {
        let output = run_in(folder.path(), command);
        assert_eq!(output.status.code(), Some(2), "{command}");
        let said = stderr(&output);
        assert!(said.contains(told), "{command}: {said}");
    }
    run_in(folder.path(), &format!("{capture} clip"));
    fs::remove_file(folder.path().join("clip/frame-000000.png")).unwrap();
    make("clip/frame-000000.png");
    let output = run_in(folder.path(), "verify clip");
    let said = [stderr(&output), String::from_utf8(output.stdout).unwrap()].concat();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains(&format!("cannot be read: it is {pipe}")), "{said}");
}

#[test]
fn a_message_quotes_at_most_a_line_of_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let long = "x".repeat(1_000_000);
    for (text, command) in [
        (format!("tick,{long}\n0,1\n"), "identify long --tick-hz 60"),
        (format!("tick,x\n0,{long}\n"), "identify long --tick-hz 60"),
        (format!("{long}\n1\n"), "loop --trace long"),
        (format!("MsBetweenPresents,MsBetweenDisplayChange\n{long},1\n"), "loop --trace long"),
        (format!("title = '{long}'\n"), "trace --scene long"),
        (long.clone(), "trace --scene long"),
    ] {
        fs::write(folder.path().join("long"), text).unwrap();
        let output = run_in(folder.path(), command);
        assert_eq!(output.status.code(), Some(2), "{command}");
        let said = stderr(&output);
        let longest = said.lines().map(|line| line.chars().count()).max();
        assert!(longest < Some(600) && said.contains("long:"), "{longest:?}: {said:.900}");
    }
}

#[test]
fn an_argument_longer_than_any_path_is_refused_in_a_line() {
    let folder = tempfile::tempdir().unwrap();
    let long = "x".repeat(100_000);
    for (place, command) in
        [(3, "trace --scene"), (3, "trace --method"), (2, "verify"), (2, "show"), (1, "")]
    {
        let output = run_in(folder.path(), &format!("{command} {long}"));
        assert_eq!(output.status.code(), Some(2), "{command}");
        let said = stderr(&output);
        let named = format!("argument {place} has 100000 bytes, and the limit is 4096");
        assert!(said.contains(&named) && said.len() < 600, "{said:.900}");
    }
    let path = format!("{}.toml", "x".repeat(200));
    let said = stderr(&run_in(folder.path(), &format!("trace --scene {path}")));
    assert!(said.contains(&path), "{said}");
}

#[test]
fn misplaced_links_and_long_arguments_are_truncated_in_messages() {
    let folder = tempfile::tempdir().unwrap();
    let link = format!("#v1.{}", "A".repeat(87_000));
    let (path, word) = ("x/".repeat(1500), "x".repeat(3000));
    for (command, why) in [
        (format!("loop --trace {link}"), "#v1.AAA"),
        (format!("loop --trace {link}"), "…: it is a link to a run; give a file"),
        (format!("identify {link} --tick-hz 60"), "…: it is a link to a run; give a file"),
        (format!("port --from {link}"), "…: it is a link to a run; give a file"),
        (format!("port --from swiftui:{link}"), "has no key \"#v1.AAA"),
        (format!("trace --method {link}"), "no such method"),
        (format!("show {link}"), "no such"),
        (format!("capture --out x --size {link}"), "such as 1280x720"),
        (
            format!("trace --scene #v{}.A", "9".repeat(400)),
            "the link is of a much newer format, and",
        ),
        (format!("trace --{word}"), "unexpected argument"),
        (format!("{word} x"), "unrecognized subcommand"),
        (format!("trace --method {word}"), "no such method"),
        (format!("trace --scene {path}"), "no built-in scene"),
        (format!("loop --trace {path}"), "no built-in trace"),
        (format!("identify {path} --tick-hz 60"), "cannot read the log"),
        (format!("verify {path}"), "cannot judge x/x/"),
        (format!("cloud --points 10 --seconds 0.1 --out {path}y"), "cannot write x/x/"),
        (format!("capture --frames 1 --out {path}y.avi"), "regatta writes no .avi files"),
    ] {
        let output = run_in(folder.path(), &command);
        assert!(matches!(output.status.code(), Some(1 | 2)), "{command:.60}");
        let said = stderr(&output);
        assert!(said.contains(why), "{command:.60}: {said:.900}");
        assert!(said.chars().count() < 1200, "{command:.60}: {said:.1500}");
    }
}

#[test]
fn the_list_of_methods_appears_once_in_the_errors_of_a_scene() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "title = 'x'\ntick_hz = 60\nseconds = 1\nmethods = ['qqq', 'rk5', 'zzz']\n\
        [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\nx0_m = 1\n\
        [[lane]]\nmethod = 'www'\n";
    fs::write(folder.path().join("bad.toml"), scene).unwrap();
    let said = stderr(&run_in(folder.path(), "trace --scene bad.toml"));
    assert_eq!(said.matches("\"velocity-verlet\"").count(), 1, "{said}");
    assert!(said.contains("4:12: unknown method \"qqq\" in `methods`; write one of"), "{said}");
    assert!(said.contains("unknown method \"rk5\" in `methods`; did you mean \"rk4\"?"), "{said}");
    assert!(said.contains("unknown method \"zzz\" in `methods`; mend it as on line 4\n"), "{said}");
    assert!(said.contains("unknown method \"www\" in `method`; mend it as on line 4\n"), "{said}");
}

#[test]
fn binary_and_oversized_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (bytes, said) in [
        (vec![0xff, 0xfe], "bad.toml:1:1: the file is not text: byte 0 is not UTF-8"),
        (vec![b'#'; 5 << 20], "bad.toml:1:1: the file holds more than 1048576 bytes"),
        (vec![], "bad.toml:1:1: the file holds no scene"),
    ] {
        fs::write(folder.path().join("bad.toml"), bytes).unwrap();
        let output = run_in(folder.path(), "trace --scene bad.toml");
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).starts_with(said), "{}", stderr(&output));
    }
}

#[test]
fn help_and_version_go_to_standard_output() {
    for arguments in ["--help", "-h", "help trace", "trace --help", "--version", "help capture"] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(0), "{arguments}");
        assert!(!output.stdout.is_empty() && output.stderr.is_empty(), "{arguments}");
    }
}

#[test]
fn the_first_example_names_the_method_that_the_harbour_opens_with() {
    let opening = Scene::built_in("harbour").unwrap().opening_method.unwrap();
    let example = format!("open the harbour under {}\n", opening.name.to_lowercase());
    let help = stdout_of("--help").to_lowercase();
    assert!(help.contains(&example), "{help}");
}

#[test]
fn short_help_fits_a_screen_and_long_help_wraps_with_whole_examples() {
    let cli = Cli::command();
    for command in [&cli].into_iter().chain(cli.get_subcommands()) {
        let name = command.get_name();
        let called: &[&str] = if name == cli.get_name() { &[] } else { &[name] };
        let [short, long] = [("-h", "80"), ("--help", "200")].map(|(help, columns)| {
            let said = regatta().args(called).arg(help).env("COLUMNS", columns).output().unwrap();
            String::from_utf8(said.stdout).unwrap()
        });
        for said in [&short, &long] {
            let widest = said.lines().max_by_key(|line| line.chars().count()).unwrap();
            assert!((20..=80).contains(&widest.chars().count()), "{name}: {widest}");
        }
        let lines = short.lines().count();
        assert!((5..=44).contains(&lines), "{name} -h has {lines} lines:\n{short}");
        assert!(!short.contains("Examples:"), "{name}");

        assert!(long.contains("\n\nExamples:\n  regatta"), "{name}: {long}");
        let after = command.get_after_long_help().unwrap().to_string();
        for example in after.lines().filter(|line| line.starts_with("  regatta")) {
            assert!(long.lines().any(|line| line == example), "{name} breaks {example}");
        }
        let lines: Vec<&str> = long.lines().collect();
        for pair in lines.windows(2) {
            let [indent, next] = [0, 1].map(|i| pair[i].len() - pair[i].trim_start().len());
            let begins = pair[1].trim_start().starts_with(['[', '-']);
            let is_in_a_paragraph = indent == next && [0, 6, 10].contains(&indent) && !begins;
            if let (true, Some(word)) = (is_in_a_paragraph, pair[1].split_whitespace().next()) {
                let joined = pair[0].chars().count() + 1 + word.chars().count();
                assert!(
                    joined > 80 || pair[0].trim().is_empty(),
                    "{name} breaks after {:?}",
                    pair[0]
                );
            }
        }
    }
}

#[test]
fn units_as_value_names_keep_their_case() {
    const UNITS: [&str; 7] = ["Hz", "kg", "N/m", "N s/m", "1/s", "ms", "s"];
    let cli = Cli::command();
    let mut found = std::collections::BTreeSet::new();
    for argument in
        [&cli].into_iter().chain(cli.get_subcommands()).flat_map(|it| it.get_arguments())
    {
        for value in argument.get_value_names().unwrap_or_default() {
            if let Some(unit) = UNITS.iter().find(|unit| unit.eq_ignore_ascii_case(value)) {
                assert_eq!(value.as_str(), *unit, "{argument}");
                found.insert(unit);
            }
        }
    }
    assert_eq!(found.len(), UNITS.len(), "{found:?}");
}

#[cfg(unix)]
#[test]
fn control_characters_become_visible_in_messages() {
    let folder = tempfile::tempdir().unwrap();
    let name = "a\u{1b}[31m\u{9b}2J.toml";
    let scene = "title = \"\u{88}\u{202e}t\"\r\ntick_hz = \"\u{9b}2J\"\r\n";
    fs::write(folder.path().join(name), scene).unwrap();
    let run = |arguments: &[&str]| {
        let output = regatta().current_dir(folder.path()).args(arguments).output().unwrap();
        let text = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
        let is_raw = |sign: char| sign.is_control() && !"\r\n".contains(sign) || sign == '\u{202e}';
        assert!(!text.contains(is_raw), "{arguments:?}: {text:?}");
        text
    };
    let told = run(&["trace", "--scene", name]);
    assert!(told.contains("a␛[31m�2J.toml:"), "{told}");
    for arguments in [
        &["link", name][..],
        &["diff", name, "spring"],
        &["diff", "spring", "b\u{1b}]0;c\u{7}.csv"],
        &["port", "--from", "_\u{88}:\u{1b}[2J"],
        &["port", "--to", "\u{1b}[31mred\u{9b}"],
        &["trace", "--\u{1b}[31mred"],
        &["help", "\u{1b}[31m\u{9b}"],
    ] {
        let told = run(arguments);
        assert!(told.contains('␛'), "{arguments:?}: {told}");
    }
}
