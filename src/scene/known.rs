//! Lists every key of a scene file, for commands and the manual.

use super::described::{NAME, field_of};
use super::document::{LANE, RACE, RACE_TABLE, TOP};
use super::keys::{Key, SPEC};
use super::law::{COORDINATE_KEYS, EVENT_KEYS, LAW, LAW_KEYS};
use super::net::{GRID_KEYS, KICKED, LIST_KEYS, NET, SPRING_KEYS};
use super::own::{OWN, OWN_KEYS};
use super::script::{
    AT_S, CHECK, CHECKS, COMMAND, COMMAND_KEYS, LANE as LANE_NUMBER, OF_A_BODY, TICK,
};
use super::wanted::Field;
use crate::sim::bodies::{Net, by_key};

/// A key of a scene file.
#[derive(Clone, Debug)]
pub struct SceneKey {
    /// Name of the key.
    pub key: &'static str,
    /// Whether the key is required, at least in one way of writing the table.
    pub is_required: bool,
    /// Description of the key for people.
    pub about: &'static str,
    /// Valid values of the key, in words.
    pub value: String,
}

/// Returns the tables of a scene file, named as in the file, each with its keys in order. Bodies of the table
/// [`BODIES`](crate::sim::bodies::BODIES) have a `name` and their parameters.
pub fn scene_tables() -> Vec<(String, Vec<SceneKey>)> {
    let array = |name: &str| format!("[[{name}]]");
    let [set, place, push] = OF_A_BODY.map(|(name, keys)| (format!("`{name}`"), keys.to_vec()));
    let of_commands = COMMAND_KEYS.iter().map(|command| command.field.clone());
    let of_nets = by_key(Net::descriptions()).map(field_of).collect();
    let of_nets =
        [vec![NAME], fields(&GRID_KEYS), fields(&LIST_KEYS), vec![KICKED], of_nets].concat();
    let tables = [
        ("the top of the file".to_owned(), [fields(&TOP), vec![RACE_TABLE]].concat()),
        ("[race]".to_owned(), fields(&RACE)),
        (array(LANE), fields(&SPEC)),
        (array(OWN), fields(&OWN_KEYS)),
        (array(LAW), [vec![NAME], fields(&LAW_KEYS)].concat()),
        (format!("[{LAW}.coordinates.x]"), fields(&COORDINATE_KEYS)),
        (format!("[{LAW}.events.floor]"), fields(&EVENT_KEYS)),
        (array(NET), of_nets),
        ("a spring of `springs`".to_owned(), fields(&SPRING_KEYS)),
        (array(COMMAND), [AT_S, TICK, LANE_NUMBER].into_iter().chain(of_commands).collect()),
        set,
        place,
        push,
        (array(CHECKS), fields(&CHECK)),
    ];
    let described = |Field { key, is_required, about, wanted }: Field| {
        let value = wanted.to_string();
        SceneKey { key, is_required, about, value }
    };
    tables.map(|(table, keys)| (table, keys.into_iter().map(described).collect())).into()
}

fn fields<D, T>(keys: &[Key<D, T>]) -> Vec<Field> {
    keys.iter().map(|key| key.field.clone()).collect()
}
