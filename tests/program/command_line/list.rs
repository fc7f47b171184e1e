//! `list` and `completions`.

use regatta::run::METRICS;
use regatta::scene::{SCENES, SceneGroup};
use regatta::sim::bodies::{BODIES, Body, Net, kind, stepped_kinds};
use regatta::sim::integrators::{METHODS, SpinMap};
use regatta::sim::law::{UNITS, functions, operators, values};
use regatta::studio::KEYS;
use serde_json::Value;

use super::{run, stdout_of};

fn listing(what: &str) -> Vec<Value> {
    serde_json::from_str(&stdout_of(&format!("list {what} --format json"))).unwrap()
}

/// The values of `key` in every object.
fn column<'a>(listing: &'a [Value], key: &str) -> Vec<&'a str> {
    listing.iter().map(|object| object[key].as_str().unwrap()).collect()
}

#[test]
fn every_table_is_listed_whole_and_in_order() {
    let ids: Vec<_> = METHODS.iter().map(|method| method.id).collect();
    assert_eq!(column(&listing("methods"), "id"), ids);
    let ids: Vec<_> = BODIES.iter().map(|body| body.id).collect();
    assert_eq!(column(&listing("bodies"), "id"), ids);
    let ids: Vec<_> = METRICS.iter().map(|metric| metric.id).collect();
    assert_eq!(column(&listing("metrics"), "id"), ids);
    let names: Vec<_> = SCENES.iter().map(|scene| scene.name).collect();
    let scenes = listing("scenes");
    assert_eq!(column(&scenes, "name"), names);
    let groups: Vec<_> = SCENES.iter().map(|scene| scene.group.title()).collect();
    assert_eq!(column(&scenes, "group"), groups);
    let keys: Vec<_> = KEYS.iter().map(|binding| binding.shown).collect();
    assert_eq!(column(&listing("keys"), "keys"), keys);
}

#[test]
fn a_method_is_listed_with_all_of_its_card() {
    let methods = listing("methods");
    for (object, method) in methods.iter().zip(METHODS) {
        let keys: Vec<_> = object.as_object().unwrap().keys().map(String::as_str).collect();
        let expected = "id name also family order order_with_drag evaluations exact_if_linear symplectic reversible \
                        stability_limit tolerance restart keeps_time as_printed only only_because \
                        default_substeps engine_tick_hz engine_version engine_logged \
                        engine_damping_ratio_at_1_hz engine_free_spin \
                        engine_free_spin_opt_in about caveat source";
        assert_eq!(keys.join(" "), expected);
        let only = stepped_kinds(method).zip(method.only.map(|only| only.reason));
        let (bodies, reason) = only.unzip();
        assert_eq!((&object["only"], &object["only_because"]), (&bodies.into(), &reason.into()));
        let also = (!method.also.is_empty()).then(|| method.also.join(", "));
        assert_eq!(object["also"], Value::from(also), "{}", method.id);
        assert_eq!(object["exact_if_linear"], method.exact_if_linear);
        assert_eq!(object["order"], method.order);
        assert_eq!(object["order_with_drag"], method.order_with_drag);
        assert_eq!(object["evaluations"], Value::from(method.evaluations));
        assert_eq!(object["symplectic"], method.symplectic);
        assert_eq!(object["default_substeps"], method.default_substeps);
        let engine = method.engine.map(|engine| (engine.tick_hz, engine.damping_ratio));
        let (tick_hz, ratio) = engine.unzip();
        assert_eq!(object["engine_tick_hz"], Value::from(tick_hz), "{}", method.id);
        assert_eq!(object["engine_damping_ratio_at_1_hz"], Value::from(ratio.flatten()));
        let logged = method.engine.and_then(|engine| engine.logged);
        assert_eq!(object["engine_logged"], Value::from(logged), "{}", method.id);
        let version =
            method.engine.map(|engine| engine.version).filter(|version| !version.is_empty());
        assert_eq!(object["engine_version"], Value::from(version), "{}", method.id);
        let spin = method.engine.and_then(|engine| engine.free_spin);
        let default = spin.map(|spin| spin.default.id());
        assert_eq!(object["engine_free_spin"], Value::from(default), "{}", method.id);
        let opt_in = spin.and_then(|spin| spin.opt_in).map(SpinMap::id);
        assert_eq!(object["engine_free_spin_opt_in"], Value::from(opt_in), "{}", method.id);
        assert_eq!(object["stability_limit"], Value::from(method.stability_limit));
    }
}

#[test]
fn a_body_is_listed_with_the_keys_of_its_table() {
    let bodies = listing("bodies");
    for (object, body) in bodies.iter().zip(BODIES.iter()) {
        for (listed, parameter) in
            object["parameters"].as_array().unwrap().iter().zip(&body.parameters)
        {
            assert_eq!(listed["key"], *parameter.key);
            assert_eq!(listed["unit"], *parameter.unit);
            assert_eq!(listed["acts"], parameter.acts.id());
            assert_eq!(listed["default"], Value::from(parameter.default));
        }
    }
    for (object, body) in bodies.iter().zip(BODIES.iter()) {
        assert_eq!(object["truth"], body.truth.id());
        assert_eq!(object["engine_refusal"], Value::from(body.class.engine_refusal()));
        assert_eq!(object["aimed_accuracy"], Value::from(body.truth.aimed_accuracy()));
        let coordinates = object["coordinates"].as_array().unwrap();
        let names: Vec<_> = coordinates.iter().map(|c| c["name"].as_str().unwrap()).collect();
        let expected: Vec<_> =
            body.coordinates(&body.plain_values()).iter().map(|c| c.name.to_string()).collect();
        assert_eq!(names, expected);
        assert!(!names.is_empty() && names.iter().all(|name| name.is_ascii()));
    }
    let text = stdout_of("list bodies");
    assert!(text.contains("[[spring]]\n"), "{text}");
    let pendulum = kind("pendulum").unwrap().class.engine_refusal().unwrap();
    for refused in [
        format!("  No method of an engine except held-force:\n    {pendulum}.\n"),
        format!(
            "  No method of an engine except held-force:\n    {}.\n",
            Net::CLASS.engine_refusal().unwrap()
        ),
        "  No method of an engine:\n    a follower moves".to_owned(),
    ] {
        assert!(text.contains(&refused), "{refused}: {text}");
    }
    assert!(text.contains("  stiffness_n_per_m  "), "{text}");
    let of_laws = text.split("[[law]]").nth(1).expect("a list of what laws are made of");
    let words = operators().chain(values()).chain(UNITS).map(str::to_owned);
    for word in functions().chain(words) {
        assert!(of_laws.contains(&word), "{word}: {of_laws}");
    }
    assert!(of_laws.lines().all(|line| line.chars().count() <= 110), "{of_laws}");
}

#[test]
fn text_lists_have_a_line_for_each_entry_under_a_heading() {
    for (what, entries) in [
        ("methods", METHODS.len()),
        // Each group has a heading after an empty line.
        ("scenes", SCENES.len() + 2 * SceneGroup::ALL.len()),
        ("metrics", METRICS.len()),
        ("keys", KEYS.len()),
    ] {
        let text = stdout_of(&format!("list {what}"));
        assert_eq!(text.lines().count(), 1 + entries, "{text}");
        assert!(text.lines().all(|line| line.trim_end() == line), "{text}");
    }
}

#[test]
fn completions_name_scenes_and_methods() {
    for shell in ["bash", "fish", "zsh"] {
        let script = stdout_of(&format!("completions {shell}"));
        assert!(script.contains("semi-implicit-euler"), "{shell}");
        assert!(script.contains("harbour"), "{shell}");
    }
    assert_eq!(run("completions tcsh").status.code(), Some(2));
}
