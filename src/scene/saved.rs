//! Saves a scene in the form of the file from which it was read.
//!
//! A person wrote the file, and its comments explain it. So only changed values are written, and the whole text only if
//! the form of the file makes that impossible.

use toml_edit::{ArrayOfTables, DocumentMut, Item, Table, TableLike};

use super::Scene;
use super::document::{LANE, METHOD_LIST};
use super::script::COMMAND;

/// Table arrays in which a changed row is rewritten, because a key that is left out of a row may depend on another one.
const REWRITTEN_ARRAYS: [&str; 2] = [LANE, COMMAND];

impl Scene {
    /// Returns the text of a scene file that [reads](Scene::parse) as this scene. If the scene was read from a file,
    /// the author's comments, order and spelling stay, and only changed values differ. Lines end as on Unix.
    pub fn to_saved_toml(&self) -> String {
        let plain = self.to_toml();
        // The author's text may have a form in which the changes are impossible.
        let is_read = |saved: &String| {
            Scene::parse(&self.name, saved).is_ok_and(|read| read.to_toml() == plain)
        };
        changed_to(self, &plain).filter(is_read).unwrap_or(plain)
    }
}

/// Returns the author's text of a scene and the plain text of the scene as read. `None` if there is no file, or if its
/// text is no longer readable.
fn documents(scene: &Scene) -> Option<[DocumentMut; 2]> {
    let source = scene.source.as_deref()?.replace("\r\n", "\n");
    let scene = Scene::parse("", &source).ok()?;
    Some([parse_document(&source)?, parse_document(&scene.to_toml())?])
}

/// Returns the author's text of a scene, changed where the scene's own plain text differs from `plain`.
fn changed_to(scene: &Scene, plain: &str) -> Option<String> {
    let [mut author, before] = documents(scene)?;
    let after = parse_document(plain)?;
    // Plain lanes may also be written as tables.
    let lanes = METHOD_LIST.key;
    if !is_same(before.get(lanes), after.get(lanes)) {
        author.remove(LANE);
    }
    apply_changes(author.as_table_mut(), before.as_table(), after.as_table());
    Some(author.to_string())
}

fn parse_document(text: &str) -> Option<DocumentMut> {
    text.parse().ok()
}

/// Applies the changes between the tables `before` and `after` to the author's table.
fn apply_changes(author: &mut dyn TableLike, before: &dyn TableLike, after: &dyn TableLike) {
    for (key, _) in before.iter().filter(|(key, _)| !after.contains_key(key)) {
        author.remove(key);
    }
    for (key, new) in after.iter().filter(|(key, new)| !is_same(before.get(key), Some(new))) {
        // A key that becomes a table is removed, because its spaces would otherwise stay.
        if before.get(key).is_some_and(|old| old.is_value() != new.is_value()) {
            author.remove(key);
        }
        match (author.get_mut(key), before.get(key)) {
            (Some(item), Some(old)) => change_item(key, item, old, new),
            _ => _ = author.insert(key, at_the_end(new.clone())),
        }
    }
}

fn change_item(key: &str, author: &mut Item, before: &Item, after: &Item) {
    if let (Some(author), Some(after)) = (author.as_value_mut(), after.as_value()) {
        let decor = author.decor().clone();
        *author = after.clone();
        *author.decor_mut() = decor;
    } else if let (Some(author), Some(before), Some(after)) =
        (author.as_table_like_mut(), before.as_table_like(), after.as_table_like())
    {
        apply_changes(author, before, after);
    } else if let (Some(author), Some(before), Some(after)) =
        (author.as_array_of_tables_mut(), before.as_array_of_tables(), after.as_array_of_tables())
    {
        if before.len() == after.len() && !REWRITTEN_ARRAYS.contains(&key) {
            for (author, (before, after)) in author.iter_mut().zip(before.iter().zip(after)) {
                apply_changes(author, before, after);
            }
        } else {
            *author = with_known_rows(author, before, after);
        }
    } else {
        *author = at_the_end(after.clone());
    }
}

/// Returns the rows `after`, with the author's own text for rows that are also in `before`.
fn with_known_rows(
    author: &ArrayOfTables,
    before: &ArrayOfTables,
    after: &ArrayOfTables,
) -> ArrayOfTables {
    let known: Vec<_> = author.iter().zip(before).collect();
    let mut rest = &known[..];
    let row = |new: &Table| match rest.iter().position(|(_, before)| is_same_table(*before, new)) {
        Some(index) => {
            let (author, _) = rest[index];
            rest = &rest[index + 1..];
            author.clone()
        }
        None => {
            let mut new = new.clone();
            new.set_position(None);
            new
        }
    };
    after.iter().map(row).collect()
}

/// Moves the tables of an item behind all others.
fn at_the_end(mut item: Item) -> Item {
    let rows = item.as_array_of_tables_mut().into_iter().flat_map(ArrayOfTables::iter_mut);
    rows.for_each(|row| row.set_position(Some(isize::MAX)));
    if let Some(table) = item.as_table_mut() {
        table.set_position(Some(isize::MAX));
    }
    item
}

/// Whether two items of plain texts are the same.
fn is_same(a: Option<&Item>, b: Option<&Item>) -> bool {
    let (Some(a), Some(b)) = (a, b) else { return a.is_none() && b.is_none() };
    if let (Some(a), Some(b)) = (a.as_table_like(), b.as_table_like()) {
        return is_same_table(a, b);
    }
    if let (Some(a), Some(b)) = (a.as_array_of_tables(), b.as_array_of_tables()) {
        return a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_same_table(a, b));
    }
    a.as_value().zip(b.as_value()).is_some_and(|(a, b)| a.to_string() == b.to_string())
}

fn is_same_table(a: &dyn TableLike, b: &dyn TableLike) -> bool {
    a.len() == b.len() && a.iter().all(|(key, item)| is_same(Some(item), b.get(key)))
}
