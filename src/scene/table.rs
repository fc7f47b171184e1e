//! Reads a table of a scene file key by key, and reports keys that were never read as unknown.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::MAX_LANES;
use super::clip::clip;
use super::errors::SceneError;
use super::fault::{FaultKind, SceneFault};
use super::nearest::{nearest, offer};
use super::wanted::{Field, Place, Wanted};
use crate::sim::integrators::{METHODS, Method};
use crate::sim::{IMPACTS, Impact, TickRate, impact_spellings};

mod lists;
mod named;

pub(super) use named::{Named, TextBlock};

/// A table with the faults found in it so far. Reading a value with a fault gives `None`.
pub(super) struct Table<'t> {
    text: &'t str,
    place: Place,
    /// Returns the key at the top of the file with a given name.
    at_top: fn(&str) -> Option<&'static str>,
    /// The file's own methods.
    own: Vec<&'static Method>,
    /// Ids of the file's own methods with faults.
    faulty: Vec<String>,
    /// Range of the header's bytes; empty at the top of the file.
    pub(super) header: Range<usize>,
    entries: &'t DeTable<'t>,
    keys: Vec<&'static str>,
    arrays: Vec<&'static str>,
    errors: Vec<SceneError>,
    /// Faults of the tables below this one.
    below: Vec<SceneError>,
}

impl<'t> Table<'t> {
    pub(super) fn top(
        text: &'t str,
        at_top: fn(&str) -> Option<&'static str>,
        entries: &'t DeTable<'t>,
    ) -> Self {
        let (place, header) = (Place::Top, 0..0);
        let (keys, arrays, errors, below) = (vec![], vec![], vec![], vec![]);
        Self {
            text,
            place,
            at_top,
            own: vec![],
            faulty: vec![],
            header,
            entries,
            keys,
            arrays,
            errors,
            below,
        }
    }

    /// Creates another table of this file.
    fn subtable(&self, place: Place, header: Range<usize>, entries: &'t DeTable<'t>) -> Self {
        let (own, faulty) = (self.own.clone(), self.faulty.clone());
        Self { place, header, own, faulty, ..Self::top(self.text, self.at_top, entries) }
    }

    pub(super) fn report_fault(
        &mut self,
        span: Range<usize>,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) {
        self.add_fault(span, SceneFault::new(what, remedy));
    }

    pub(super) fn add_fault(&mut self, span: Range<usize>, fault: SceneFault) {
        self.errors.push(SceneError { span, fault });
    }

    /// Whether no fault has been found so far, in this table or below it.
    pub(super) fn is_faultless(&self) -> bool {
        self.errors.is_empty() && self.below.is_empty()
    }

    /// Returns the bytes of the value of `key`, or of the header if the key is absent.
    pub(super) fn span(&self, key: &str) -> Range<usize> {
        self.entries.get(key).map_or(self.header.clone(), Spanned::span)
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    /// Returns the file's own methods.
    pub(super) fn own(&self) -> &[&'static Method] {
        &self.own
    }

    /// Lets keys name a method of the file. For a method with faults, `method` is `None`, and keys that name it are not
    /// reported.
    pub(super) fn add_own_method(&mut self, id: &str, method: Option<&'static Method>) {
        match method {
            Some(method) => self.own.push(method),
            None => self.faulty.push(id.to_owned()),
        }
    }

    /// Whether the value of `key` is a list of tables.
    pub(super) fn has_tables(&self, key: &str) -> bool {
        self.entries.get(key).is_some_and(|value| is_table(value.get_ref()))
    }

    /// Marks a key as allowed here.
    pub(super) fn allow_key(&mut self, key: &'static str) {
        if !self.keys.contains(&key) {
            self.keys.push(key);
        }
    }

    /// Reads a text of at most [`Wanted::max_chars`] characters.
    pub(super) fn text(&mut self, field: &Field) -> Option<String> {
        let value = self.value(field)?;
        let (span, Field { key, wanted, .. }) = (value.span(), field);
        let Some(text) = value.get_ref().as_str() else { return self.wrong_type(field, value) };
        let chars = text.chars().count();
        if text.trim().is_empty() {
            self.report_fault(span, format!("`{key}` is empty"), wanted.remedy());
        } else if chars > wanted.max_chars() {
            self.report_fault(span, format!("`{key}` has {chars} characters"), wanted.remedy());
        } else if let Some(character) = text.chars().find(|c| c.is_control()) {
            let code = character as u32;
            let what = format!("`{key}` holds the control character U+{code:04X}");
            self.report_fault(span, what, "remove it");
        } else {
            return Some(text.into());
        }
        None
    }

    /// Reads a number as [`Wanted::Number`] demands.
    pub(super) fn number(&mut self, field: &Field) -> Option<f64> {
        let value = self.value(field)?;
        let Some(number) = number(value) else { return self.wrong_type(field, value) };
        self.in_range(field, value, field.wanted.accepts_number(number).then_some(number))
    }

    /// Reads a whole number as [`Wanted::Whole`] demands.
    pub(super) fn whole<T: TryFrom<u64>>(&mut self, field: &Field) -> Option<T> {
        let value = self.value(field)?;
        if !value.get_ref().is_integer() {
            return self.wrong_type(field, value);
        }
        let whole = integer(value).and_then(|whole| u64::try_from(whole).ok());
        let whole = whole.filter(|whole| field.wanted.accepts_whole(*whole));
        self.in_range(field, value, whole.and_then(|whole| T::try_from(whole).ok()))
    }

    /// Reads a tick rate, from [`Wanted::TickRate`] or from the length of a [`Wanted::Step`]. A ratio of numbers is
    /// written as a string.
    pub(super) fn tick_rate(&mut self, field: &Field) -> Option<TickRate> {
        let value = self.value(field)?;
        let ratio = value.get_ref().as_str().filter(|text| text.contains('/')).map(str::to_owned);
        // The shortest decimal of a number is the one in the file, because no rate has as many digits as an `f64`.
        let Some(written) = ratio.or_else(|| number(value).map(|number| number.to_string())) else {
            return self.wrong_type(field, value);
        };
        let rate = match field.wanted {
            Wanted::Step => TickRate::of_step(&written),
            _ => written.parse(),
        };
        let is_in_range = number(value).is_some_and(|hz| match field.wanted {
            Wanted::Step => (TickRate::MAX.step_s()..=TickRate::MIN.step_s()).contains(&hz),
            _ => (TickRate::MIN.hz()..=TickRate::MAX.hz()).contains(&hz),
        });
        if rate.is_err() && is_in_range {
            let what = format!("`{}` has more than nine digits after the point", field.key);
            self.report_fault(value.span(), what, field.wanted.remedy());
            return None;
        }
        self.in_range(field, value, rate.ok())
    }

    pub(super) fn method(&mut self, field: &Field) -> Option<&'static Method> {
        let value = self.value(field)?;
        self.method_named(field.key, format!("`{}`", field.key), value)
    }

    /// Reads methods with the bytes of their names. At most [`MAX_LANES`] entries are read.
    pub(super) fn methods(
        &mut self,
        field: &Field,
    ) -> Option<Vec<(Range<usize>, &'static Method)>> {
        let (value, entries) = self.list(field)?;
        if entries.is_empty() {
            let remedy = "name a method, or remove the line and all of them race";
            self.report_fault(value.span(), format!("`{}` is empty", field.key), remedy);
        }
        if let Some(first_too_many) = entries.get(MAX_LANES) {
            let what = format!("the scene has {} lanes", entries.len());
            self.report_fault(first_too_many.span(), what, format!("keep at most {MAX_LANES}"));
        }
        let mut methods = Vec::new();
        for entry in entries.iter().take(MAX_LANES) {
            let subject = format!("an entry of `{}`", field.key);
            let method = self.method_named(field.key, subject, entry);
            methods.extend(method.map(|method| (entry.span(), method)));
        }
        Some(methods)
    }

    /// Returns the tables of the array `name`, in the order of the file.
    pub(super) fn rows(&mut self, name: &'static str) -> Vec<Table<'t>> {
        self.arrays.push(name);
        let Some(value) = self.entries.get(name) else { return vec![] };
        let Some(array) = value.get_ref().as_array() else {
            self.wrong_type_of::<()>(format!("`{name}`"), value, &Wanted::Tables(name));
            return vec![];
        };
        let table = |entry: &'t Spanned<DeValue<'t>>| {
            let entries = entry.get_ref().as_table()?;
            Some(self.subtable(Place::Table(name), entry.span(), entries))
        };
        let rows: Option<Vec<_>> = array.iter().map(table).collect();
        if rows.is_none() {
            self.wrong_type_of::<()>(format!("`{name}`"), value, &Wanted::Tables(name));
        }
        rows.unwrap_or_default()
    }

    /// Reads the table of [`Wanted::Table`], if there is one.
    pub(super) fn table(&mut self, field: &Field) -> Option<Table<'t>> {
        let value = self.value(field)?;
        match value.get_ref().as_table() {
            Some(entries) => Some(self.subtable(Place::Within(field.key), value.span(), entries)),
            None => self.wrong_type(field, value),
        }
    }

    pub(super) fn boolean(&mut self, field: &Field) -> Option<bool> {
        let value = self.value(field)?;
        value.get_ref().as_bool().or_else(|| self.wrong_type(field, value))
    }

    /// Reads a hash of 16 hexadecimal digits.
    pub(super) fn hash(&mut self, field: &Field) -> Option<u64> {
        let value = self.value(field)?;
        let (span, key) = (value.span(), field.key);
        let Some(text) = value.get_ref().as_str() else {
            return self.wrong_type(field, value);
        };
        let is_hex = text.len() == 16 && text.bytes().all(|digit| digit.is_ascii_hexdigit());
        let hash = is_hex.then(|| u64::from_str_radix(text, 16).ok()).flatten();
        if hash.is_none() {
            let what = format!("`{key}` is {:?}, not a hash", clip(text));
            self.report_fault(span, what, Wanted::Hash.remedy());
        }
        hash
    }

    /// Reads the table below this one at a key, with its faults.
    pub(super) fn read_below<R>(
        &mut self,
        field: &Field,
        read: impl FnOnce(&mut Table<'t>) -> R,
    ) -> Option<R> {
        let mut table = self.table(field)?;
        let found = read(&mut table);
        self.add_faults_of(table);
        Some(found)
    }

    /// Collects the faults of a table below this one.
    pub(super) fn add_faults_of(&mut self, row: Table<'t>) {
        self.below.extend(row.finish());
    }

    /// Returns all faults of the table. Keys that were not read until now are unknown.
    pub(super) fn finish(mut self) -> Vec<SceneError> {
        let mut unknown = Vec::new();
        for (key, value) in self.entries {
            let (span, key) = (key.span(), key.get_ref().as_ref());
            if !self.keys.contains(&key) && !self.arrays.contains(&key) {
                unknown.push(SceneError { span, fault: self.unknown(key, value.get_ref()) });
            }
        }
        // A misspelt or misplaced key is not reported as missing too.
        let misspelt = unknown.iter().filter_map(|error| match &error.fault.kind {
            FaultKind::Unknown(nearest) => nearest.as_deref(),
            _ => None,
        });
        let misplaced = self.below.iter().filter_map(|error| match error.fault.kind {
            FaultKind::Misplaced(key) => Some(key),
            _ => None,
        });
        let meant: Vec<&str> = misspelt.chain(misplaced).collect();
        self.errors.retain(|error| match &error.fault.kind {
            FaultKind::Missing(keys) => !keys.iter().any(|key| meant.contains(key)),
            _ => true,
        });
        self.errors.append(&mut unknown);
        self.errors.append(&mut self.below);
        self.errors
    }

    fn unknown(&self, key: &str, value: &DeValue<'_>) -> SceneFault {
        let place = self.place;
        if let Some(key) = (self.at_top)(key).filter(|_| place != Place::Top) {
            let what = format!("`{key}` does not belong {place}");
            return SceneFault::new(what, "move it above the first table")
                .of(FaultKind::Misplaced(key));
        }
        let is_table = place == Place::Top && is_table(value);
        let known = if is_table { &self.arrays } else { &self.keys };
        let nearest = nearest(key, known.iter().map(|name| (*name, *name)));
        if !is_table {
            return SceneFault::unknown_key(key, place, nearest, known);
        }
        SceneFault::new(format!("unknown table `{}`", clip(key)), offer(nearest, known, '['))
            .of(FaultKind::NoTable)
    }

    fn value(&mut self, field: &Field) -> Option<&'t Spanned<DeValue<'t>>> {
        let Field { key, is_required, about, wanted } = field;
        self.allow_key(key);
        let value = self.entries.get(*key);
        if value.is_none() && *is_required {
            let place = self.place;
            let above = if place == Place::Top { " above the first table" } else { "" };
            let remedy = format!("write `{key} = …`{above}: {about}, {wanted}");
            let fault = SceneFault::new(format!("missing key `{key}` {place}"), remedy);
            self.add_fault(self.header.clone(), fault.of(FaultKind::Missing(vec![key])));
        }
        value
    }

    /// Reads a list, and returns it with its entries.
    fn list(
        &mut self,
        field: &Field,
    ) -> Option<(&'t Spanned<DeValue<'t>>, &'t [Spanned<DeValue<'t>>])> {
        let value = self.value(field)?;
        match value.get_ref().as_array() {
            Some(entries) => Some((value, entries)),
            None => self.wrong_type(field, value),
        }
    }

    /// Reads the id of a rule for impacts.
    pub(super) fn impact(&mut self, field: &Field) -> Option<&'static Impact> {
        let all: Vec<_> = IMPACTS.iter().map(|impact| (impact.id, impact)).collect();
        let what = |id: &str| format!("unknown rule {:?} in `{}`", clip(id), field.key);
        self.named(field, what, &all, impact_spellings())
    }

    /// Reads the name of one of `all`. `unknown` is the message about another name, and `spellings` are those of which
    /// one may be meant, each with its name.
    pub(super) fn named<T: Copy>(
        &mut self,
        field: &Field,
        unknown: impl Fn(&str) -> String,
        all: &[(&'static str, T)],
        spellings: impl Iterator<Item = (&'static str, &'static str)>,
    ) -> Option<T> {
        let name = self.text(field)?;
        let found = all.iter().find(|(known, _)| *known == name);
        if found.is_none() {
            let known: Vec<&str> = all.iter().map(|(known, _)| *known).collect();
            let nearest = nearest(&name, spellings);
            self.report_fault(self.span(field.key), unknown(&name), offer(nearest, &known, '"'));
        }
        found.map(|(_, value)| *value)
    }

    fn method_named(
        &mut self,
        key: &'static str,
        subject: String,
        value: &Spanned<DeValue<'_>>,
    ) -> Option<&'static Method> {
        let Some(id) = value.get_ref().as_str() else {
            return self.wrong_type_of(subject, value, &Wanted::Method);
        };
        let all = || METHODS.iter().chain(self.own.iter().copied());
        let method = all().find(|method| method.id == id);
        if method.is_none() && !self.faulty.iter().any(|faulty| faulty == id) {
            let spellings = all().flat_map(Method::spellings);
            let nearest = nearest(id, spellings);
            let known: Vec<_> = all().map(|method| method.id).collect();
            let what = format!("unknown method {:?} in `{key}`", clip(id));
            self.report_fault(value.span(), what, offer(nearest, &known, '"'));
        }
        method
    }

    fn in_range<T>(
        &mut self,
        field: &Field,
        value: &Spanned<DeValue<'_>>,
        number: Option<T>,
    ) -> Option<T> {
        let subject = format!("`{}`", field.key);
        number.or_else(|| self.out_of_range(&subject, value, &field.wanted))
    }

    fn out_of_range<T>(
        &mut self,
        subject: &str,
        value: &Spanned<DeValue<'_>>,
        wanted: &Wanted,
    ) -> Option<T> {
        let written = clip(&self.text[value.span()]);
        self.add_fault(value.span(), SceneFault::out_of_range(subject, &written, wanted));
        None
    }

    fn wrong_type<T>(&mut self, field: &Field, value: &Spanned<DeValue<'_>>) -> Option<T> {
        self.wrong_type_of(format!("`{}`", field.key), value, &field.wanted)
    }

    fn wrong_type_of<T>(
        &mut self,
        subject: String,
        value: &Spanned<DeValue<'_>>,
        wanted: &Wanted,
    ) -> Option<T> {
        let written = clip(&self.text[value.span()]);
        let found = match value.get_ref() {
            DeValue::String(_) => format!("the string {written}"),
            DeValue::Integer(_) => format!("the integer {written}"),
            DeValue::Float(_) => format!("the float {written}"),
            DeValue::Boolean(_) => format!("the boolean {written}"),
            DeValue::Datetime(_) => format!("the date {written}"),
            DeValue::Array(_) if is_table(value.get_ref()) => "an array of tables".into(),
            DeValue::Array(_) => "a list".into(),
            DeValue::Table(_) => "a table".into(),
        };
        self.add_fault(value.span(), SceneFault::wrong_type(&subject, &found, wanted));
        None
    }
}

fn is_table(value: &DeValue<'_>) -> bool {
    let first = value.as_array().and_then(|array| array.first());
    value.is_table() || first.is_some_and(|first| first.get_ref().is_table())
}

/// Reads a number, whole or not. A number too large for its type is out of every range.
fn number(value: &Spanned<DeValue<'_>>) -> Option<f64> {
    match value.get_ref() {
        DeValue::Integer(_) => Some(integer(value).map_or(f64::INFINITY, |whole| whole as f64)),
        DeValue::Float(float) => Some(float.as_str().parse().unwrap_or(f64::NAN)),
        _ => None,
    }
}

fn integer(value: &Spanned<DeValue<'_>>) -> Option<i128> {
    let integer = value.get_ref().as_integer()?;
    i128::from_str_radix(integer.as_str(), integer.radix()).ok()
}
