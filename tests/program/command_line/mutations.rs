//! A thousand mutated files, links and texts: none crashes the program or makes it run for ever, as SECURITY.md
//! promises. The seed is printed, and `REGATTA_SEED` sets another.

use std::fs::{self, File};
use std::path::Path;
use std::process::Stdio;
use std::thread;
use std::time::{Duration, Instant};

use super::{regatta, run};
use crate::dice::Dice;

const INPUTS: usize = 1000;
const THREADS: usize = 4;
/// Longest time of an input, on a busy machine without optimisation. The program takes a tenth of a second.
const MOST: Duration = Duration::from_secs(60);

/// What is put into a text.
const PIECES: &[&str] = &[
    "-1",
    "0",
    "1e308",
    "1e-320",
    "nan",
    "inf",
    "99999999999999999999",
    "0.1",
    "\"",
    "'",
    "[",
    "]",
    "[[",
    "{",
    "}",
    "(",
    ")",
    ",",
    ";",
    "=",
    "==",
    "+",
    "*",
    "^",
    "-",
    "\n",
    "\r",
    "\t",
    "\u{2028}",
    "é",
    "\u{1b}[31m",
    "\0",
    "x",
    "v",
    "h",
    "dt",
    "target",
    "let ",
    "var ",
    "float ",
    "memory ",
    "if ",
    "else ",
    "a(x, v)",
    "x = ",
    "v = v * 0.9\n",
    "abs(",
    "clamp(x, ",
    "null",
    "true",
    "#",
    "//",
    "/*",
    "tick_hz = ",
    "[[spring]]\n",
    "method = \"rk4\"\n",
    "NA",
    "0,",
];

const METHODS: &[&str] = &[
    "v += h * a(x, v)\nx += h * v\n",
    "let k1 = a(x, v)\nlet k2 = a(x + h * v, v + h * k1)\nx += h * v + h * h * k1 / 2\nv += h * (k1 + k2) / 2\n",
    "memory last = nan\nlet now = a(x, v)\nif h < 0.1 { v += h * now } else { v = 0 }\nx += h * v\nlast = now\n",
    "float v = v * 0.9;\nx += v * dt;\nv += a(x, v) * dt;\n",
];
const RULES: &[&str] = &[
    "v = (v + (target - x) * 0.2) * 0.85; x += v",
    "float v = v * 0.9; x += v * dt",
    "x = Mathf.Lerp(x, target, 0.1f); // a remark",
    "memory prev = 0\nold = x; x += (x - prev) * 0.98; prev = old",
    "v -= sign(v) * min(abs(v), 3 * dt); if v > 1 { v = 1 } else if v < -1 { v = -1 }\nx += v * dt",
];
const LOGS: &[&str] = &[
    "Application,ProcessID,MsBetweenPresents,MsBetweenDisplayChange,FrameType\ng,1,16.7,16.7,X\ng,1,16.6,NA,Application\n",
    "16.7\n16.6\n33.4\n16.7\n",
    "fps,frametime,cpu_load,gpu_load,elapsed\n60,16.7,1,2,100\n61,16.4,1,2,200\n",
    "{\"Info\":{\"ProcessName\":\"g\"},\"Runs\":[{\"CaptureData\":{\"MsBetweenPresents\":[9.7,12.2,9],\"Dropped\":[0,1,0]}}]}",
];
const SCENE: &str = "title = \"t\"\ntick_hz = 60\nseconds = 1\nmethods = [\"rk4\", \"mine\"]\n[[method]]\nid = \"mine\"\n\
    step = \"\"\"\nv += h * a(x, v)\nx += h * v\n\"\"\"\n[[law]]\nname = \"b\"\nconstants = { k = 40.0 }\n\
    [law.coordinates.y]\nstart = 1.0\nacceleration = \"-k*y - 0.1*vy + max(y, 0)\"\n[[spring]]\nmass_kg = 1.0\n\
    stiffness_n_per_m = 40.0\n[[command]]\nat_s = 0.01\nkick = 1.0\n";

/// Changes a text at some places.
fn mutated(dice: &mut Dice, text: &str) -> String {
    let mut text = text.to_owned();
    for _ in 0..=dice.below(4) {
        let [a, b] = [(); 2].map(|()| text.floor_char_boundary(dice.below(text.len() + 1)));
        let (from, to) = (a.min(b), a.max(b).min(text.ceil_char_boundary(a.min(b) + 12)));
        let piece = PIECES[dice.below(PIECES.len())];
        match dice.below(4) {
            0 => text.replace_range(from..to, ""),
            1 => text.replace_range(from..to, piece),
            2 => text.insert_str(from, piece),
            _ => text.insert_str(from, &text[from..to].repeat(1 + dice.below(3))),
        }
    }
    text
}

/// Returns the arguments of one input, whose file is in `folder`.
fn input(dice: &mut Dice, folder: &Path, links: &[String]) -> Vec<String> {
    let file = |name: &str, text: &str| {
        let path = folder.join(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let one = |dice: &mut Dice, texts: &[&str]| {
        let text = texts[dice.below(texts.len())];
        mutated(dice, text)
    };
    let language = ["rust", "c", "cpp", "csharp", "gdscript", "javascript", "lua"][dice.below(7)];
    let words: Vec<String> = match dice.below(6) {
        0 => {
            vec!["show".into(), file("m.step", &one(dice, METHODS)), "--as".into(), language.into()]
        }
        1 => vec!["rule".into(), file("r.step", &one(dice, RULES)), "--as".into(), language.into()],
        2 => vec!["loop".into(), "--trace".into(), file("l.csv", &one(dice, LOGS))],
        3 => {
            let link = &links[dice.below(links.len())];
            vec!["verify".into(), mutated(dice, link).replace('\0', "")]
        }
        4 => vec!["rule".into(), "--scene".into(), file("s.step", &one(dice, RULES))],
        _ => {
            let scene = file("s.toml", &mutated(dice, SCENE));
            ["trace", "--seconds", "0.02", "--scene", &scene].map(String::from).to_vec()
        }
    };
    words
}

#[test]
fn mutated_inputs_end_with_a_result_or_a_reason() {
    let mut dice = Dice::new(77);
    let links: Vec<String> = ["spring", "harbour"]
        .map(|scene| String::from_utf8(run(&format!("link {scene}")).stdout).unwrap().trim().into())
        .into_iter()
        .chain([
            "#scene=spring&method=rk4".to_owned(),
            // A scene with the method `let v = v * 0.9`.
            "#v1.eNo1jssKgzAQRffzFUNWfYikUApd-CVBguhogiaKGYL06zuxdHfPmSd7XggbVKyAfT9b9xF6aUjUr3FIAg8IxG49s1HBR1ItGPOTbQt-\
             KPOnh8S0FVIKFmLMkjPeUNdvyHhv0Al0l6PCfIXjLzKUfmPStvs4ycbQpWTnqdyu5RP24xhJVLQb7TaIf2opfAEvGDXt".to_owned(),
        ])
        .collect();
    let folder = tempfile::tempdir().unwrap();
    thread::scope(|scope| {
        for n in 0..THREADS {
            let mut dice = Dice::new(1000 + n as u64 + dice.below(1 << 20) as u64);
            let (links, folder) = (&links, folder.path().join(n.to_string()));
            fs::create_dir(&folder).unwrap();
            scope.spawn(move || {
                for _ in 0..INPUTS / THREADS {
                    let words = input(&mut dice, &folder, links);
                    let said = folder.join("stderr");
                    let mut child = regatta()
                        .args(&words)
                        .stdin(Stdio::null())
                        .stdout(Stdio::null())
                        .stderr(File::create(&said).unwrap())
                        .spawn()
                        .unwrap();
                    let began = Instant::now();
                    let status = loop {
                        if let Some(status) = child.try_wait().unwrap() {
                            break status;
                        }
                        if began.elapsed() > MOST {
                            child.kill().unwrap();
                            panic!("{words:?} runs for ever");
                        }
                        thread::sleep(Duration::from_millis(2));
                    };
                    let said = String::from_utf8_lossy(&fs::read(&said).unwrap()).into_owned();
                    let input = words.iter().find_map(|word| fs::read_to_string(word).ok());
                    let is_ended =
                        matches!(status.code(), Some(0..=2)) && !said.contains("has a bug");
                    assert!(is_ended, "{words:?} {input:?}: {status}: {said}");
                    assert!(status.success() || !said.is_empty(), "{words:?}: no reason");
                }
            });
        }
    });
}
