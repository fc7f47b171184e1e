//! `sweep`: a row for every run, in one order for any number of threads, and the picture of the rows.

use std::collections::BTreeMap;
use std::fs;
use std::io::Read;
use std::process::Stdio;
use std::time::Duration;

use regatta::scene::{SCENES, Scene};
use regatta::sim::integrators::{GENERAL_METHODS, method};
use serde_json::Value;

use super::advise::ON_SPRING;
#[cfg(unix)]
use super::{ended_by, start};
use super::{names, refusal, regatta, run_in, stderr, stdout_of};

pub(crate) const HEADER: &str = "scene,body,method,tick_hz,seconds,error,energy_drift_percent,\
                      evaluations_per_s,ns_per_s,verdict,halted,half_life_ms,overshoot_percent,parameter,value";

/// The rows of `sweep` with these options, by column.
fn rows(options: &str) -> Vec<Value> {
    serde_json::from_str(&stdout_of(&format!("sweep {options} --format json"))).unwrap()
}

fn text<'a>(row: &'a Value, column: &str) -> &'a str {
    row[column].as_str().unwrap_or_else(|| panic!("{column} of {row}"))
}

fn number(row: &Value, column: &str) -> f64 {
    row[column].as_f64().unwrap_or_else(|| panic!("{column} of {row}"))
}

#[test]
fn every_scene_body_method_and_rate_has_a_row_in_that_order() {
    let csv = stdout_of(
        "sweep --scene spring --scene harbour --method rk4 --method explicit-euler --method rk4 \
         --tick-hz 60,15 --tick-hz 30,60 --seconds 1",
    );
    let mut expected = vec![HEADER.to_owned()];
    for scene in ["spring", "harbour"] {
        for body in Scene::built_in(scene).unwrap().bodies {
            // The order of the table, not that of the options.
            for id in ["explicit-euler", "rk4"] {
                let rates = [15, 30, 60].map(|hz| format!("{scene},{},{id},{hz},1.0,", body.name));
                expected.extend(rates);
            }
        }
    }
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), expected.len());
    for (line, start) in lines.into_iter().zip(expected) {
        assert!(line.starts_with(&start), "{line} is not {start}");
        assert_eq!(line.split(',').count(), 15, "{line}");
    }
}

#[test]
fn without_options_all_methods_sweep_all_scenes_by_octaves() {
    let rows = rows("--seconds 0.001");
    let mut scenes: Vec<&str> = rows.iter().map(|row| text(row, "scene")).collect();
    scenes.dedup();
    assert_eq!(scenes, SCENES.iter().map(|scene| scene.name).collect::<Vec<_>>());
    let of_spring = || rows.iter().filter(|row| row["scene"] == "spring");
    let rates: Vec<u64> = of_spring().take(6).map(|row| row["tick_hz"].as_u64().unwrap()).collect();
    assert_eq!(rates, [15, 30, 60, 120, 240, 480]);
    let ids: Vec<&str> = of_spring().step_by(6).map(|row| text(row, "method")).collect();
    assert_eq!(
        ids,
        GENERAL_METHODS.iter().filter(|it| it.is_for_games()).map(|it| it.id).collect::<Vec<_>>()
    );
}

#[test]
fn only_a_followers_row_has_half_life_and_overshoot() {
    let rows = rows("--scene lerp --scene spring --method lerp-dt --method rk4 --tick-hz 60");
    let of = |id: &str| rows.iter().find(|row| text(row, "method") == id).unwrap();
    let half_life = number(of("lerp-dt"), "half_life_ms");
    let rate = Scene::built_in("lerp").unwrap().bodies[0].values[1];
    // Within a step it is a straight line in the logarithm.
    let wanted = 1e3 / 60.0 * 0.5_f64.ln() / (1.0 - rate / 60.0).ln();
    assert!((half_life - wanted).abs() < 1e-6, "{half_life} ms, not {wanted} ms");
    assert_eq!(number(of("lerp-dt"), "overshoot_percent"), 0.0);
    let spring = rows.iter().find(|row| row["scene"] == "spring").unwrap();
    assert!(spring["half_life_ms"].is_null() && spring["overshoot_percent"].is_null(), "{spring}");
}

#[test]
fn a_constant_of_a_law_is_varied_like_a_parameter_of_a_body() {
    let rows = rows(
        "--scene quarter-car --scene ship --method semi-implicit-euler --tick-hz 100 --vary kt=1.6e6,1.6e5",
    );
    let told: Vec<_> =
        rows.iter().map(|row| (text(row, "scene"), row["parameter"].as_str())).collect();
    let car = ("quarter-car", Some("kt"));
    assert_eq!(told, [car, car, ("ship", None)]);
    assert_eq!([0, 1].map(|row| number(&rows[row], "value")), [1.6e5, 1.6e6]);
    assert!(rows[2]["value"].is_null());
    // ω h of the wheel is 0.7 and 2.
    assert_eq!([0, 1].map(|row| text(&rows[row]["verdict"], "word")), ["bounded", "blows-up"]);
    for (options, why) in [
        (
            "--scene ship --vary kt=1",
            "no body has a parameter \"kt\"; give one of `regatta list bodies`",
        ),
        (
            "--scene ship --vary mas_kg=1",
            "no body has a parameter \"mas_kg\"; did you mean mass_kg?",
        ),
        ("--scene ship --vary kt", "has no `=`"),
        ("--scene ship --vary kt=1,x", "\"x\" is no number"),
        ("--scene ship --vary mass_kg=-1", "--vary mass_kg=-1 on \"ship\""),
        ("--scene ship --vary mass_kg=1 --plot x.png", "cannot be used with"),
    ] {
        let said = refusal(&format!("sweep {options}"), 2);
        assert!(said.contains(why), "{options}: {said}");
    }
}

#[test]
fn json_and_csv_have_the_same_rows() {
    let folder = tempfile::tempdir().unwrap();
    // A name that needs quotes, and a run that is lost.
    let scene = "title = 'x'\ntick_hz = 60\nseconds = 2\n[[spring]]\nname = 'a, \"b\"'\n\
                 mass_kg = 1\nstiffness_n_per_m = 1e6\n";
    fs::write(folder.path().join("my.toml"), scene).unwrap();
    let sweep = "sweep --scene my.toml --scene ship --method rk4 --method bdf2";
    let output = |options: &str| {
        let output = run_in(folder.path(), &format!("{sweep} {options}"));
        assert_eq!((output.status.code(), stderr(&output)), (Some(0), String::new()));
        String::from_utf8(output.stdout).unwrap()
    };
    let (csv, json) = (output(""), output("--format json"));
    let objects: Vec<serde_json::Map<String, Value>> = serde_json::from_str(&json).unwrap();
    assert_eq!(csv.lines().next(), Some(HEADER));
    assert_eq!(csv.lines().count(), 1 + objects.len());
    assert_eq!(json.lines().count(), 2 + objects.len());
    for (line, object) in csv.lines().skip(1).zip(objects) {
        assert_eq!(object.keys().cloned().collect::<Vec<_>>().join(","), HEADER);
        let mut cells = cells(line);
        // A measured value differs from run to run.
        assert!(cells.remove(8).parse::<f64>().unwrap() > 0.0, "{line}");
        let others = object.iter().filter(|(key, _)| *key != "ns_per_s");
        let same = others.map(|(_, value)| match value {
            Value::Null => String::new(),
            Value::String(text) => text.clone(),
            Value::Object(verdict) => verdict["word"].as_str().unwrap().to_owned(),
            number => number.to_string(),
        });
        assert_eq!(cells, same.collect::<Vec<_>>());
    }
    assert!(csv.contains("\nmy.toml,\"a, \"\"b\"\"\",rk4,15,"), "{csv}");
}

/// The cells of a line of CSV, without their quotes.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut quoted) = (vec![String::new()], false);
    let mut characters = line.chars().peekable();
    while let Some(character) = characters.next() {
        match character {
            '"' if quoted && characters.next_if_eq(&'"').is_some() => {
                cells.last_mut().unwrap().push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            _ => cells.last_mut().unwrap().push(character),
        }
    }
    cells
}

#[test]
fn any_number_of_threads_makes_the_same_rows() {
    // The cloth and the bridge alone would take as long as all others.
    let scenes = SCENES.iter().filter(|scene| !["cloth", "bridge"].contains(&scene.name));
    let scenes: String = scenes.map(|scene| format!("--scene {} ", scene.name)).collect();
    let physics = |threads: u32| {
        let mut rows = rows(&format!("{scenes}--seconds 0.5 --tick-hz 30,60 --threads {threads}"));
        for row in &mut rows {
            let ns = row.as_object_mut().unwrap().remove("ns_per_s").unwrap();
            assert!(ns.is_null() || ns.as_f64().unwrap() > 0.0, "{row}: {ns}");
        }
        rows
    };
    let one = physics(1);
    assert!(one.len() > 500);
    assert!(one == physics(4));
}

#[test]
fn the_error_falls_with_the_methods_order() {
    for (scene, rates) in [("ship", "8,16,32"), ("spring", "240,480,960")] {
        let rows = rows(&format!("--scene {scene} --tick-hz {rates} --seconds 4"));
        let mut errors: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
        for row in &rows {
            errors.entry(text(row, "method")).or_default().push(number(row, "error"));
        }
        for id in [
            "explicit-euler",
            "semi-implicit-euler",
            "improved-euler",
            "velocity-verlet",
            "position-verlet",
            "ssp-rk3",
            "rk4",
            "implicit-midpoint",
            "gauss-legendre-4",
        ] {
            let card = method(id).unwrap();
            let order = if scene == "ship" { card.order_with_drag } else { card.order };
            for pair in errors[id].windows(2) {
                let slope = (pair[0] / pair[1]).log2();
                let off = (slope - f64::from(order)).abs();
                assert!(off < 0.25, "{scene}, {id}: {slope} is no order of {order}");
            }
        }
    }
}

#[test]
fn a_row_agrees_with_advise() {
    let some =
        ["explicit-euler", "rk4", "velocity-verlet", "dormand-prince-54", "implicit-midpoint"];
    let some: String = some.map(|id| format!("--method {id} ")).concat();
    let on_orbit = stdout_of(&format!("advise --scene orbit {some}--format json"));
    let on_orbit = serde_json::from_str(&on_orbit).unwrap();
    for (scene, advice, methods) in [("spring", &*ON_SPRING, ""), ("orbit", &on_orbit, &*some)] {
        let tick_hz = &advice["tick_hz"];
        let rows = rows(&format!("--scene {scene} {methods}--tick-hz {tick_hz}"));
        let advised = advice["methods"].as_array().unwrap();
        assert_eq!(rows.len(), advised.len());
        for (row, advised) in rows.iter().zip(advised) {
            assert_eq!(row["method"], advised["method"]);
            assert_eq!(row["verdict"], advised["verdict"], "{row}");
            assert_eq!(row["error"], advised["verdict"]["error"], "{row}");
        }
        let rk4 = rows.iter().find(|row| row["method"] == "rk4").unwrap();
        assert_eq!(number(rk4, "evaluations_per_s"), 4.0 * tick_hz.as_f64().unwrap());
    }
}

#[test]
fn only_a_conserved_energy_has_a_drift() {
    let rows = rows("--scene spring --scene ship --method explicit-euler --tick-hz 60 --seconds 1");
    let [spring, ship] = &rows[..] else { panic!("{rows:?}") };
    // (1 + z²)^60 with z = 2π/60.
    let growth = 100.0 * ((1.0 + (std::f64::consts::TAU / 60.0).powi(2)).powi(60) - 1.0);
    let drift = number(spring, "energy_drift_percent");
    assert!((drift / growth - 1.0).abs() < 1e-3, "{drift} %, not {growth}");
    assert!(ship["energy_drift_percent"].is_null());
}

#[test]
fn a_blow_up_has_a_row() {
    let rows = rows("--scene stiff --method semi-implicit-euler --tick-hz 49,60");
    let [lost, kept] = &rows[..] else { panic!("{rows:?}") };
    assert_eq!(lost["verdict"]["word"], "blows-up");
    let at = lost["verdict"]["failed_at_s"].as_f64().unwrap();
    assert!((4.1..4.2).contains(&at), "{lost}");
    let halted = text(lost, "halted");
    let is_told = halted.starts_with("blew up: ") && halted.contains("·10³⁸");
    assert!(is_told && !halted.contains('-'), "{lost}");
    assert!(lost["error"].is_null());
    // The verdict on this body is "blows up · at 4.14 s".
    assert!((4.1..4.2).contains(&number(lost, "seconds")), "{lost}");
    assert_eq!(number(lost, "evaluations_per_s"), 49.0);
    assert!(number(lost, "ns_per_s") > 0.0);
    assert_eq!((&kept["verdict"]["word"], number(kept, "seconds")), (&"bounded".into(), 5.0));
    assert!(kept["halted"].is_null());
}

#[test]
fn rows_go_to_a_file_that_is_replaced_only_when_forced() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = "sweep --scene ship --method rk4 --tick-hz 2 --out rows.csv";
    let file = folder.path().join("rows.csv");
    fs::write(&file, "mine").unwrap();
    let refused = run_in(folder.path(), sweep);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("rows.csv already exists; give another --out, or --force"));
    assert_eq!(fs::read(&file).unwrap(), b"mine");

    let forced = run_in(folder.path(), &format!("{sweep} --force"));
    assert_eq!(forced.status.code(), Some(0), "{}", stderr(&forced));
    assert!(forced.stdout.is_empty());
    assert_eq!(stderr(&forced), "wrote 1 row: rows.csv\n");
    assert!(fs::read_to_string(&file).unwrap().starts_with(HEADER));
    assert_eq!(names(folder.path()), ["rows.csv"]);
}

#[test]
fn mistakes_are_refused_before_anything_is_swept() {
    for (options, said) in [
        ("--method rk5", "did you mean rk4? `regatta list methods` names all"),
        ("--scene shp", "is called \"shp\"; did you mean ship?"),
        ("--tick-hz 0", "give a rate from 0.01 to 10000 Hz"),
        ("--tick-hz 60,10001", "'10001' for"),
        ("--tick-hz 60,", "'' for"),
        ("--seconds 0", "give more than 0 seconds"),
        ("--seconds -1", "give 0 to 31536000 seconds"),
        ("--threads 0", "0 is not in 1..=256"),
        ("--format xml", "csv, json"),
        ("--plot src", "src is a directory; give --plot a file"),
        ("--plot LICENSE-MIT", "LICENSE-MIT already exists; give another --plot, or --force"),
        ("--plot -", "rows and picture would go to the same place"),
        ("--plot x --out ./x", "rows and picture would go to the same place"),
    ] {
        let message = refusal(&format!("sweep {options}"), 2);
        assert!(message.starts_with("error: ") && message.contains(said), "{options}: {message}");
    }
    for option in ["--out", "--plot"] {
        let message = refusal(&format!("sweep {option} no/x"), 1);
        assert!(message.starts_with("error: cannot write no/x: No such file"), "{message}");
        let remedy = format!("; give another {option}, in a directory that is there\n");
        assert!(message.ends_with(&remedy), "{message}");
    }
}

#[test]
fn a_pipe_that_closes_early_ends_a_sweep_quietly() {
    let mut child = regatta()
        .args(["sweep", "--scene", "ship"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let mut said = String::new();
    child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
    assert_eq!((child.wait().unwrap().code(), &*said), (Some(0), ""));
}

#[cfg(unix)]
#[test]
fn a_signal_ends_the_longest_sweep_at_once_without_a_file() {
    let folder = tempfile::tempdir().unwrap();
    // Weeks.
    let sweep = "sweep --seconds 31536000 --tick-hz 10000 --out rows.csv";
    for signal in ["-INT", "-TERM", "-HUP"] {
        let child = start(folder.path(), sweep);
        while names(folder.path()).is_empty() {
            std::thread::sleep(Duration::from_millis(1));
        }
        let output = ended_by(signal, child);
        assert_eq!(stderr(&output), "error: interrupted; nothing was written\n", "{signal}");
        assert_eq!(output.status.code(), Some(130), "{signal}");
        assert!(names(folder.path()).is_empty(), "{signal}");
    }
}

#[test]
fn a_file_name_sets_the_format_and_must_not_contradict_it() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = "sweep --scene spring --method rk4 --tick-hz 60 --seconds 0.1";
    for (out, start) in [("rows.json", "[\n{"), ("rows.CSV", HEADER), ("rows", HEADER)] {
        let output = run_in(folder.path(), &format!("{sweep} --out {out}"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let written = fs::read_to_string(folder.path().join(out)).unwrap();
        assert!(written.starts_with(start), "{out}: {written}");
    }
    for (options, said) in [
        (
            "--format csv --out a.json",
            "a.json would not hold what its name says; give --out a name that",
        ),
        ("--format json --out a.csv", "ends in .json, or --format csv"),
        ("--out a.png", "give --out a name that ends in .csv or .json"),
        ("--plot a.gif", "a.gif would hold PNG; give --plot a name that ends in .png"),
    ] {
        let output = run_in(folder.path(), &format!("{sweep} {options}"));
        assert_eq!((output.status.code(), &*output.stdout), (Some(2), &b""[..]), "{options}");
        assert!(stderr(&output).contains(said), "{}", stderr(&output));
    }
    assert_eq!(names(folder.path()), ["rows", "rows.CSV", "rows.json"]);
}
