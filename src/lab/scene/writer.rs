//! Writes a scene as the text of a file, from which the same scene is read back, to the bit.

use std::fmt::Write;

use toml::de::DeTable;

use super::{Check, Scene, SceneBody, Scripted};
use crate::lab::action::Action;
use crate::lab::lane_spec::LaneSpec;
use crate::sim::bodies::{Form, Grid, Lists, NetPlan, PlannedSpring, Range};
use crate::sim::law::{LawText, Layout};

impl Scene {
    /// Replaces the hashes in the checks of a scene file's `text`, in the order of the file. The rest of the text stays
    /// the same. If there are fewer hashes than checks, the last checks keep theirs.
    pub fn with_hashes(text: &str, hashes: &[u64]) -> String {
        let Ok(document) = DeTable::parse(text) else { return text.into() };
        let rows = document.get_ref().get("check").and_then(|checks| checks.get_ref().as_array());
        let rows = rows.into_iter().flatten().filter_map(|row| row.get_ref().as_table());
        let spans: Vec<_> = rows.filter_map(|row| Some(row.get("hash")?.span())).collect();
        let mut text = text.to_owned();
        // From the end, so that the places before stay where they are.
        for (span, hash) in spans.into_iter().zip(hashes).rev() {
            text.replace_range(span, &format!("\"{hash:016x}\""));
        }
        text
    }

    /// The text of a scene file that [reads](Scene::parse) as this scene.
    ///
    /// No text can say what a body or a method [in Rust](Scene::in_rust) is: that of such a scene cannot be read again.
    ///
    /// ```
    /// use regatta::lab::Scene;
    ///
    /// let scene = Scene::built_in("helm").expect("a built-in scene");
    /// let again = Scene::parse("helm.toml", &scene.to_toml()).expect("a scene");
    /// assert_eq!(again.to_toml(), scene.to_toml());
    /// ```
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        let mut line = |key: &str, value: String| {
            writeln!(text, "{key} = {value}").expect("a string takes all");
        };
        line("title", quoted(&self.title));
        if !self.about.is_empty() {
            line("about", quoted(&self.about));
        }
        if let Some(hint) = &self.hint {
            line("hint", quoted(hint));
        }
        line("tick_hz", self.tick_hz.to_string());
        line("seconds", number(self.seconds));
        if let Some(method) = self.opening_method {
            line("method", quoted(method.id));
        }
        let are_plain = self.lanes.iter().all(|spec| *spec == LaneSpec::plain(spec.method));
        if are_plain {
            let ids = self.lanes.iter().map(|spec| quoted(spec.method.id));
            line("methods", list(ids));
        }
        if self.equal_cost || self.opens_as_race {
            text += "\n[race]\n";
            text += if self.equal_cost { "equal_cost = true\n" } else { "" };
            text += if self.opens_as_race { "open = true\n" } else { "" };
        }
        if !are_plain {
            self.lanes.iter().for_each(|spec| write_lane(&mut text, spec));
        }
        self.bodies.iter().for_each(|body| write_body(&mut text, body));
        self.script.iter().for_each(|scripted| self.write_command(&mut text, scripted));
        self.checks.iter().for_each(|check| text += &check.to_toml());
        text
    }

    fn write_command(&self, text: &mut String, Scripted { tick, action }: &Scripted) {
        *text += &format!("\n[[command]]\ntick = {tick}\n");
        let mut line = |key: &str, value: String| *text += &format!("{key} = {value}\n");
        let name = |body: usize| quoted(&self.bodies[body].name);
        match action {
            Action::Method(method) => line("method", quoted(method.id)),
            Action::Lane { lane, spec } => {
                line("lane", lane.to_string());
                write_spec(text, spec);
            }
            Action::Substeps { lane, substeps } => {
                line("lane", lane.to_string());
                line("substeps", substeps.to_string());
            }
            Action::Tolerance { lane, tolerance } => {
                line("lane", lane.to_string());
                line("tolerance", number(*tolerance));
            }
            Action::TickHz(tick_hz) => line("tick_hz", tick_hz.to_string()),
            Action::Throttle(part) => line("throttle", number(*part)),
            Action::Rudder(part) => line("rudder", number(*part)),
            Action::Kick(times) => line("kick", number(*times)),
            Action::Set { body, parameter, value } => {
                let parameter = &self.bodies[*body].kind.parameters[*parameter];
                let (name, key) = (name(*body), quoted(&parameter.key));
                let value = parameter_value(parameter.range, *value);
                line("set", format!("{{ body = {name}, key = {key}, value = {value} }}"));
            }
            Action::Place { body, q, v } => {
                let name = name(*body);
                let [q, v] = [q, v].map(|values| list(values.iter().map(|x| number(*x))));
                line("place", format!("{{ body = {name}, q = {q}, v = {v} }}"));
            }
            Action::Solo { lane } => line("solo", lane.to_string()),
        }
    }
}

impl Check {
    /// The check as a table of a scene file, with an empty line before it.
    pub fn to_toml(&self) -> String {
        let Self { tick, lane, hash } = self;
        format!("\n[[check]]\ntick = {tick}\nlane = {lane}\nhash = \"{hash:016x}\"\n")
    }
}

fn write_lane(text: &mut String, spec: &LaneSpec) {
    *text += "\n[[lane]]\n";
    write_spec(text, spec);
}

/// The lines of a lane's method with what is beside it.
fn write_spec(text: &mut String, spec: &LaneSpec) {
    *text += &format!("method = {}\n", quoted(spec.method.id));
    if spec.substeps != spec.method.default_substeps {
        *text += &format!("substeps = {}\n", spec.substeps);
    }
    if let Some(tolerance) = spec.tolerance {
        *text += &format!("tolerance = {}\n", number(tolerance));
    }
    if let Some([hz, damping_ratio]) = spec.joint {
        *text += &format!("joint_hz = {}\n", number(hz));
        *text += &format!("joint_damping_ratio = {}\n", number(damping_ratio));
    }
}

/// The table of a body that moves by a law.
fn write_law(text: &mut String, SceneBody { name, values, .. }: &SceneBody, law: &LawText) {
    *text += &format!("\n[[law]]\nname = {}\n", quoted(name));
    if let Some(plane) = law.plane {
        let names = plane.iter().map(|&place| quoted(&law.coordinates[place].name));
        *text += &format!("plane = {}\n", list(names));
    }
    if law.layout != Layout::default() {
        *text += &format!("draw = {}\n", quoted(law.layout.id()));
    }
    if let Some(energy) = &law.energy {
        *text += &format!("energy = {}\n", quoted(energy));
    }
    let (constants, rest) = values.split_at(law.constants.len());
    if !constants.is_empty() {
        *text += "\n[law.constants]\n";
        for (name, value) in law.constants.iter().zip(constants) {
            *text += &format!("{name} = {}\n", number(*value));
        }
    }
    let n = law.coordinates.len();
    for (i, coordinate) in law.coordinates.iter().enumerate() {
        *text += &format!("\n[law.coordinates.{}]\n", coordinate.name);
        let mut line = |key: &str, value: String| *text += &format!("{key} = {value}\n");
        line("unit", quoted(coordinate.unit));
        line("start", number(rest[i]));
        line("start_velocity", number(rest[n + i]));
        line("kick", number(rest[2 * n + i]));
        line("acceleration", quoted(&coordinate.acceleration));
        if let Some(exact) = &coordinate.exact {
            line("exact", quoted(exact));
        }
        if let Some(at) = &coordinate.at {
            line("at", list(at.iter().map(|text| quoted(text))));
        }
    }
}

/// The nodes and springs of a net.
fn write_plan(text: &mut String, NetPlan { form, kicked }: &NetPlan) {
    let mut line = |key: &str, value: String| *text += &format!("{key} = {value}\n");
    match form {
        Form::Grid(Grid { columns, rows, spacing, shear, pin }) => {
            line("columns", columns.to_string());
            line("rows", rows.to_string());
            line("spacing_m", number(*spacing));
            line("shear", shear.to_string());
            pin.iter().for_each(|pin| line("pin", quoted(pin.id())));
        }
        Form::Lists(Lists { nodes, fixed, springs }) => {
            line("nodes", list(nodes.iter().map(|node| list(node.iter().map(|x| number(*x))))));
            line("fixed", list(fixed.iter().map(usize::to_string)));
            line("springs", format!("[\n{}]", springs.iter().map(spring).collect::<String>()));
        }
    }
    kicked.iter().for_each(|node| line("kicked_node", node.to_string()));
}

/// A spring of a net in a line of its own.
fn spring(PlannedSpring { between: [a, b], stiffness, damping, rest }: &PlannedSpring) -> String {
    let own = [("stiffness_n_per_m", stiffness), ("damping_n_s_per_m", damping), ("rest_m", rest)];
    let own = own.into_iter().filter_map(|(key, value)| Some((key, (*value)?)));
    let own = own.map(|(key, value)| format!(", {key} = {}", number(value)));
    format!("  {{ between = [{a}, {b}]{} }},\n", own.collect::<String>())
}

fn write_body(text: &mut String, body: &SceneBody) {
    let SceneBody { name, kind, values, .. } = body;
    if let Some(law) = kind.law() {
        return write_law(text, body, law.text());
    }
    *text += &format!("\n[[{}]]\nname = {}\n", kind.id, quoted(name));
    if let Some(plan) = kind.net() {
        write_plan(text, plan);
    }
    for (parameter, place) in kind.parameters.iter().zip(0..) {
        let value = match parameter.range {
            // A curve is the last parameter, and takes all remaining values.
            Range::Curve { .. } => {
                let points = values[place..].chunks_exact(2);
                list(points.map(|point| list(point.iter().map(|x| number(*x)))))
            }
            range => parameter_value(range, values[place]),
        };
        *text += &format!("{} = {value}\n", parameter.key);
    }
}

fn parameter_value(range: Range, value: f64) -> String {
    match range {
        Range::Count(_) => format!("{}", value as u64),
        _ => number(value),
    }
}

/// The shortest number that reads back as the same, with a point or an exponent, as TOML wants it.
fn number(value: f64) -> String {
    format!("{value:?}")
}

fn list(items: impl Iterator<Item = String>) -> String {
    format!("[{}]", items.collect::<Vec<_>>().join(", "))
}

/// A string in double quotes. Texts of a scene hold no control characters.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}
