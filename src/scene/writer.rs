//! Writes a scene as the text of a file that reads back as the same scene, to the bit.

use toml::de::DeTable;

use super::described::NAME;
use super::document::{LANE, RACE, TOP};
use super::keys::{Key, SPEC, list, numbers, quoted};
use super::law::{LAW, LAW_KEYS, coordinate_tables};
use super::net::{GRID_KEYS, KICKED, LIST_KEYS};
use super::own::own_table;
use super::script::{CHECK, CHECKS, command_tables, parameter_value};
use super::{Check, Scene, SceneBody};
use crate::LaneSpec;
use crate::sim::bodies::{NetLayout, NetPlan, Parameter, Range, by_key};

impl Scene {
    /// Replaces the hashes in the checks of a scene file's `text`, in the order of the file. The rest of the text
    /// stays the same. If there are fewer hashes than checks, the last checks keep theirs.
    pub fn with_hashes(text: &str, hashes: &[u64]) -> String {
        let Ok(document) = DeTable::parse(text) else { return text.into() };
        let rows = document.get_ref().get(CHECKS).and_then(|checks| checks.get_ref().as_array());
        let rows = rows.into_iter().flatten().filter_map(|row| row.get_ref().as_table());
        let spans: Vec<_> = rows.filter_map(|row| Some(row.get("hash")?.span())).collect();
        let mut text = text.to_owned();
        // The replacements go from the end to the beginning, so that the earlier spans stay valid.
        for (span, hash) in spans.into_iter().zip(hashes).rev() {
            text.replace_range(span, &format!("\"{hash:016x}\""));
        }
        text
    }

    /// Returns the text of a scene file that [reads](Scene::parse) as this scene.
    ///
    /// No text can describe a body or a method [in Rust](Scene::in_rust), so the text of such a scene cannot be read
    /// again.
    ///
    /// ```
    /// use regatta_scene::Scene;
    ///
    /// let scene = Scene::built_in("helm").expect("a built-in scene");
    /// let again = Scene::parse("helm.toml", &scene.to_toml()).expect("a scene");
    /// assert_eq!(again.to_toml(), scene.to_toml());
    /// ```
    pub fn to_toml(&self) -> String {
        let mut text = Key::lines(&TOP, self);
        let race = Key::lines(&RACE, self);
        if !race.is_empty() {
            text += &format!("\n[race]\n{race}");
        }
        text.extend(self.own_methods.iter().copied().map(own_table));
        if !self.has_plain_lanes() {
            let row = |spec| format!("\n[[{LANE}]]\n{}", Key::lines(&SPEC, spec));
            text.extend(self.lanes.iter().map(row));
        }
        text.extend(self.bodies.iter().map(body_table));
        text.extend(command_tables(self));
        text.extend(self.checks.iter().map(Check::to_toml));
        text
    }

    /// Whether each lane has the settings of its method's card.
    pub(super) fn has_plain_lanes(&self) -> bool {
        self.lanes.iter().all(|spec| *spec == LaneSpec::plain(spec.method))
    }
}

impl Check {
    /// Returns the check as a table of a scene file, after an empty line.
    pub fn to_toml(&self) -> String {
        format!("\n[[{CHECKS}]]\n{}", Key::lines(&CHECK, self))
    }
}

/// Returns the table of a body.
fn body_table(body: &SceneBody) -> String {
    let SceneBody { name, kind, values, .. } = body;
    let id = if kind.law().is_some() { LAW } else { kind.id };
    let head = format!("\n[[{id}]]\n{} = {}\n", NAME.key, quoted(name));
    if let Some(law) = kind.law() {
        return head + &Key::lines(&LAW_KEYS, body) + &coordinate_tables(body, law.text());
    }
    let mut text = head;
    text.extend(kind.net().map(|plan| net_lines(plan)));
    let mut rest = &values[..];
    for group in by_key(&kind.parameters) {
        let Parameter { key, range, list: list_key, .. } = &group[0];
        let value = match range {
            // A curve is the last parameter, and has all remaining values.
            Range::Curve { .. } => list(rest.chunks_exact(2).map(numbers)),
            _ if list_key.is_some() => numbers(&rest[..group.len()]),
            range => parameter_value(*range, rest[0]),
        };
        rest = &rest[group.len()..];
        text += &format!("{} = {value}\n", list_key.unwrap_or(key));
    }
    text
}

/// Returns the nodes and springs of a net.
fn net_lines(NetPlan { form, kicked }: &NetPlan) -> String {
    let lines = match form {
        NetLayout::Grid(grid) => Key::lines(&GRID_KEYS, grid),
        NetLayout::Lists(lists) => Key::lines(&LIST_KEYS, lists),
    };
    let kicked = kicked.map(|node| format!("{} = {node}\n", KICKED.key));
    lines + &kicked.unwrap_or_default()
}
