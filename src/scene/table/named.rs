//! Reads tables whose keys the file chooses, and expressions.

use std::ops::Range;

use toml::Spanned;
use toml::de::DeValue;

use super::{Table, number};
use crate::clip;
use crate::sim::bodies;
use crate::wanted::{Field, Place, Wanted};

/// An entry whose key the file chooses.
pub(crate) struct Named<'t> {
    pub(crate) key: &'t str,
    /// The bytes of the key.
    pub(crate) span: Range<usize>,
    value: &'t Spanned<DeValue<'t>>,
}

/// An expression with its place in the file.
pub(crate) struct TextBlock {
    pub(crate) text: String,
    /// The bytes of the string, quotes included.
    span: Range<usize>,
    /// Byte at which the text begins verbatim; `None` if the string has escapes.
    start: Option<usize>,
}

impl TextBlock {
    /// Returns the bytes of the file for these bytes of the expression; if the string has escapes, the bytes of the
    /// whole string.
    pub(crate) fn span_in_file(&self, span: &Range<usize>) -> Range<usize> {
        match self.start {
            Some(start) if !span.is_empty() => start + span.start..start + span.end,
            _ => self.span.clone(),
        }
    }
}

impl<'t> Table<'t> {
    /// Reads the entries of the table with this key, in the order of the file.
    pub(crate) fn entries(&mut self, field: &Field) -> Option<Vec<Named<'t>>> {
        let value = self.value(field)?;
        let Some(entries) = value.get_ref().as_table() else {
            return self.wrong_type(field, value);
        };
        let named = |(key, value): (&'t Spanned<_>, &'t Spanned<DeValue<'t>>)| {
            let text: &std::borrow::Cow<'t, str> = key.get_ref();
            Named { key: text, span: key.span(), value }
        };
        let mut entries: Vec<_> = entries.iter().map(named).collect();
        entries.sort_by_key(|entry| entry.span.start);
        Some(entries)
    }

    /// Reads the number of an entry.
    pub(crate) fn number_of(&mut self, entry: &Named<'t>, range: bodies::Range) -> Option<f64> {
        let (wanted, subject) = (Wanted::Number(range), format!("`{}`", clip(entry.key)));
        let Some(number) = number(entry.value) else {
            return self.wrong_type_of(subject, entry.value, &wanted);
        };
        match range.contains(number) {
            true => Some(number),
            false => self.out_of_range(&subject, entry.value, &wanted),
        }
    }

    /// Reads the table of an entry of [`Wanted::Coordinates`] or [`Wanted::Events`].
    pub(crate) fn table_of(&mut self, entry: &Named<'t>, wanted: &Wanted) -> Option<Table<'t>> {
        match (entry.value.get_ref().as_table(), wanted) {
            (Some(entries), Wanted::Coordinates(place) | Wanted::Events(place)) => {
                Some(self.subtable(Place::Within(place), entry.span.clone(), entries))
            }
            _ => self.wrong_type_of(format!("`{}`", clip(entry.key)), entry.value, wanted),
        }
    }

    /// Reads the tables of springs in a list, in the order of the file.
    pub(crate) fn spring_rows(&mut self, field: &Field) -> Option<Vec<Table<'t>>> {
        let (_, entries) = self.list(field)?;
        let mut rows = Vec::new();
        for entry in entries {
            match entry.get_ref().as_table() {
                Some(entries) => {
                    let place = Place::Within(field.key);
                    rows.push(self.subtable(place, entry.span(), entries));
                }
                None => {
                    let subject = format!("an entry of `{}`", field.key);
                    self.wrong_type_of::<()>(subject, entry, &Wanted::Spring);
                }
            }
        }
        (rows.len() == entries.len()).then_some(rows)
    }

    /// Reads an expression, in which a line break counts as a space.
    pub(crate) fn expression(&mut self, field: &Field) -> Option<TextBlock> {
        let written = self.text_block(field)?;
        let text = written.text.replace(['\n', '\r', '\t'], " ");
        Some(TextBlock { text, ..written })
    }

    /// Reads the expressions of a table by name, one or more. Each name comes with its bytes.
    #[expect(clippy::type_complexity, reason = "a named expression is read in one place")]
    pub(crate) fn expressions(
        &mut self,
        field: &Field,
    ) -> Option<Vec<((String, Range<usize>), TextBlock)>> {
        let entries = self.entries(field)?;
        if entries.is_empty() {
            let what = format!("`{}` is empty", field.key);
            self.report_fault(self.span(field.key), what, field.wanted.remedy());
            return None;
        }
        let named = |entry: &Named<'t>| {
            let Some(text) = entry.value.get_ref().as_str() else {
                let subject = format!("`{}`", clip(entry.key));
                return self.wrong_type_of(subject, entry.value, &Wanted::Expression);
            };
            let written = self.block(text, entry.value.span());
            Some(((entry.key.to_owned(), entry.span.clone()), written))
        };
        let read: Vec<_> = entries.iter().map(named).collect();
        read.into_iter().collect()
    }

    /// Returns a text at these bytes of the file.
    fn block(&self, text: &str, span: Range<usize>) -> TextBlock {
        let start = self.text[span.clone()].find(text).map(|at| span.start + at);
        TextBlock { text: text.to_owned(), span, start }
    }

    /// Reads a text of several lines.
    pub(crate) fn text_block(&mut self, field: &Field) -> Option<TextBlock> {
        let value = self.value(field)?;
        let Some(text) = value.get_ref().as_str() else { return self.wrong_type(field, value) };
        Some(self.block(text, value.span()))
    }

    /// Reads the names in a list of strings, with their bytes.
    pub(crate) fn names(&mut self, field: &Field) -> Option<Vec<(Range<usize>, &'t str)>> {
        let value = self.value(field)?;
        let entries = value.get_ref().as_array();
        let name =
            |entry: &'t Spanned<DeValue<'t>>| Some((entry.span(), entry.get_ref().as_str()?));
        let names = entries.and_then(|entries| entries.iter().map(name).collect());
        names.or_else(|| self.wrong_type(field, value))
    }
}
