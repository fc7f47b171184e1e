//! `assets/schema.json`: what the commands print with `--format json`.

use std::fs;

use serde_json::Value;
use tempfile::tempdir;

use super::{run, run_in, stdout_of};

const LOG: &str = "tests/data/engines/box2d__spring_1hz_z005_60hz.csv";
const RUN: &str = "title = \"run\"\ntick_hz = 60\nseconds = 1\nmethods = [\"rk4\"]\n\
    [[spring]]\nmass_kg = 1.0\nstiffness_n_per_m = 40.0\n";

/// Runs of commands, each with the name of its schema.
const RUNS: &[(&str, &str)] = &[
    ("advise", "advise --frequency 1.5 --method rk4 --method explicit-euler"),
    ("advise", "advise --scene ball --method velocity-verlet --impact clamp"),
    ("advise", "advise --scene engines --method rk4 --method explicit-euler"),
    ("advise", "advise --scene damped --method rk4 --method explicit-euler --rates"),
    ("chapter", "chapter"),
    ("cloud", "cloud --scene liouville --points 100 --seconds 1"),
    ("fixture", "fixture --scene spring --seconds 1"),
    ("link", "link spring"),
    ("list methods", "list methods"),
    ("list scenes", "list scenes"),
    ("list bodies", "list bodies"),
    ("list metrics", "list metrics"),
    ("list policies", "list policies"),
    ("list impacts", "list impacts"),
    ("list traces", "list traces"),
    ("list engine-loops", "list engine-loops"),
    ("list keys", "list keys"),
    ("loop", "loop --trace steady-60 --policy fixed --policy whole-refresh"),
    ("loop", "loop --trace tests/data/frame-traces/presentmon_test_case_0.csv --policy fixed"),
    ("loop", "loop --trace edge --policy fixed --follow x+=(target-x)*8*dt"),
    ("port", "port --frequency 1.5 --damping-ratio 1.2"),
    ("port", "port --frequency 1.5 --drive --decimation 4"),
    ("rule", "rule v*=0.9;x+=v*dt"),
    ("rule", "rule v-=9.81*dt;x+=v*dt;if(x<0){x=0;v=-0.8*v}"),
    ("show", "show rk4"),
    ("show", "show fixed --as c"),
    ("show", "show clamp --as csharp"),
    ("sweep", "sweep --scene damped --method rk4 --method explicit-euler"),
    ("trace", "trace --scene spring --seconds 0.1"),
    ("trace --impacts", "trace --scene ball --seconds 2 --impacts"),
];

/// What is wrong with a value under a schema, each with the place of it.
fn faults(value: &Value, schema: &Value, place: &str, found: &mut Vec<String>) {
    let types = match &schema["type"] {
        Value::Null => return,
        Value::String(one) => vec![one.as_str()],
        Value::Array(all) => all.iter().filter_map(Value::as_str).collect(),
        other => panic!("{place}: {other}"),
    };
    let is_of = |name: &&str| match *name {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        other => panic!("{place}: {other}"),
    };
    if !types.iter().any(is_of) {
        found.push(format!("{place}: {value} is not of {types:?}"));
    }
    if let Some(object) = value.as_object() {
        for name in schema["required"].as_array().unwrap() {
            if !object.contains_key(name.as_str().unwrap()) {
                found.push(format!("{place}: without {name}"));
            }
        }
        for (name, inner) in object {
            match schema["properties"].get(name).or(schema.get("additionalProperties")) {
                Some(known) => faults(inner, known, &format!("{place}.{name}"), found),
                None => found.push(format!("{place}: {name} is not described")),
            }
        }
    }
    for inner in value.as_array().into_iter().flatten() {
        faults(inner, &schema["items"], &format!("{place}[]"), found);
    }
}

/// What a command prints to standard output; notes on the other one are allowed.
fn said_here(arguments: &str) -> String {
    String::from_utf8(run(arguments).stdout).unwrap()
}

#[test]
fn every_command_that_answers_in_json_prints_what_the_schema_says() {
    let text = fs::read_to_string("assets/schema.json").unwrap();
    let schemas: Value = serde_json::from_str(&text).unwrap();
    let mut found = Vec::new();
    let mut check = |name: &str, printed: &str| {
        let value: Value = serde_json::from_str(printed).unwrap();
        let schema = &schemas["$defs"][name];
        assert!(schema["description"].is_string(), "{name}");
        faults(&value, schema, name, &mut found);
    };
    for (name, arguments) in RUNS {
        check(name, &said_here(&format!("{arguments} --format json")));
    }
    check("identify", &said_here(&format!("identify {LOG} --tick-hz 60 --format json")));
    let spin = "tests/data/engines/bullet__tumble_a_60hz.csv --moments 1,2,3";
    check("identify", &said_here(&format!("identify {spin} --tick-hz 60 --format json")));
    let folder = tempdir().unwrap();
    let said =
        |arguments: &str| String::from_utf8(run_in(folder.path(), arguments).stdout).unwrap();
    fs::write(folder.path().join("run.toml"), RUN).unwrap();
    let link = said("link run.toml");
    check("verify", &said(&format!("verify {} --format json", link.trim())));
    said("capture --scene spring --frames 2 --size 64x36 --out clip");
    check("verify", &said("verify clip --format json"));
    for (file, method) in [("a.csv", "rk4"), ("b.csv", "midpoint")] {
        let rows = stdout_of(&format!("trace --scene spring --method {method} --seconds 1"));
        fs::write(folder.path().join(file), rows).unwrap();
    }
    check("diff", &said("diff a.csv b.csv --format json"));
    assert!(found.is_empty(), "{found:#?}");
    let checked = RUNS.iter().map(|(name, _)| *name).chain(["identify", "verify", "diff"]);
    let described = schemas["$defs"].as_object().unwrap();
    assert!(described.keys().all(|name| checked.clone().any(|it| it == name)), "one is not run");
}

#[test]
fn the_schema_refuses_what_it_does_not_describe() {
    let schemas: Value =
        serde_json::from_str(&fs::read_to_string("assets/schema.json").unwrap()).unwrap();
    for (value, wrong) in [
        (r#"{"link": "x", "letters": 1}"#, 0),
        (r#"{"link": 2, "letters": 1.5}"#, 2),
        (r#"{"link": "x", "words": 1}"#, 2),
        ("[]", 1),
    ] {
        let mut found = Vec::new();
        faults(
            &serde_json::from_str(value).unwrap(),
            &schemas["$defs"]["link"],
            "link",
            &mut found,
        );
        assert_eq!(found.len(), wrong, "{value}: {found:?}");
    }
}
