//! Ids on the command line. They are parsed, offered for shell completion, or refused with a suggestion.

use std::ffi::OsStr;
use std::path::Path;
use std::sync::Arc;

use annotate_snippets::Renderer;
use clap::builder::{PossibleValue, TypedValueParser};
use clap::error::ErrorKind;

use super::error::Error;

use crate::look::palette::Theme;
use crate::loops::{ENGINES, POLICIES, PolicyCard, TRACES, TraceCard};
use crate::measure::cloud::CloudShape;
use crate::scene::nearest;
use crate::sim::integrators::{Family, METHODS, Method};
use crate::sim::{IMPACTS, Impact, impact_spellings};
use crate::studio::Instrument;
use crate::tools::source_code::{CodeForm, Language};
use crate::view::RendererChoice;

/// The ids of one kind, with the value of each.
#[derive(Clone, Copy)]
pub(super) struct Id<T: 'static> {
    /// Noun for the kind of id in messages, such as "method".
    pub(super) thing: &'static str,
    /// Names of the lists of `regatta list` that have all the ids. If there are none, the message itself names the ids.
    pub(super) lists: &'static [&'static str],
    pub(super) all: fn() -> Vec<(String, T)>,
    /// Other spellings, each with its id, from which suggestions are made.
    pub(super) spellings: fn() -> Vec<(&'static str, &'static str)>,
    /// Endings of the files that a person may write in place of an item, each with the function that loads one.
    pub(super) files: &'static [Loader<T>],
}

/// An ending of files, and the function that loads a value from such a file.
type Loader<T> = (&'static str, fn(&Path) -> Result<T, Error>);

impl<T: Clone> Id<T> {
    pub(super) const fn new(thing: &'static str, all: fn() -> Vec<(String, T)>) -> Self {
        Self { thing, lists: &[], all, spellings: Vec::new, files: &[] }
    }

    /// Returns the value of the item with this `id`.
    ///
    /// # Errors
    /// The message for an unknown id, with a suggestion.
    pub(super) fn find(&self, id: &str) -> Result<T, String> {
        let all = (self.all)();
        if let Some((_, found)) = all.iter().find(|(known, _)| known == id) {
            return Ok(found.clone());
        }
        let ids: Vec<&str> = all.iter().map(|(id, _)| &**id).collect();
        let spellings = ids.iter().map(|id| (*id, *id)).chain((self.spellings)());
        let written = id.to_lowercase();
        let parts = |known: &&str| id.len() > 1 && known.contains(&*written);
        let meant = match nearest(id, spellings) {
            Some(meant) => vec![meant],
            None => ids.iter().copied().filter(parts).collect(),
        };
        let meant = (!meant.is_empty()).then(|| format!("; did you mean {}?", meant.join(", ")));
        let see = match self.lists {
            [] => format!("There are {}", ids.join(", ")),
            [list] => format!("`regatta list {list}` names all"),
            lists => {
                let lists: Vec<_> =
                    lists.iter().map(|list| format!("`regatta list {list}`")).collect();
                let (last, others) = lists.split_last().expect("it has two lists at least");
                format!("{} and {last} name all", others.join(", "))
            }
        };
        Err(format!("no such {}{} {see}", self.thing, meant.unwrap_or(".".into())))
    }
}

impl<T: Clone + Send + Sync + 'static> TypedValueParser for Id<T> {
    type Value = T;

    fn parse_ref(
        &self,
        command: &clap::Command,
        arg: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<T, clap::Error> {
        let (ids, path) = (self.clone(), Path::new(value));
        if let Some((_, load)) = self.files.iter().find(|(ending, _)| ends_in(path, ending)) {
            return load(path).map_err(refusal);
        }
        (move |id: &str| ids.find(id)).parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((self.all)().into_iter().map(|(id, _)| PossibleValue::new(id))))
    }
}

/// Whether a file ends so, in letters of any case.
pub(super) fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

/// Returns the refusal of an argument for an error in its file.
fn refusal(error: Error) -> clap::Error {
    let report = error.report(&Renderer::plain());
    let report = report.strip_prefix("error: ").unwrap_or(&report);
    clap::Error::raw(ErrorKind::ValueValidation, format!("{report}\n"))
}

pub(super) const METHOD: Id<&Method> = Id {
    lists: &["methods"],
    spellings: || METHODS.iter().flat_map(Method::spellings).collect(),
    ..Id::new("method", || METHODS.iter().map(|method| (method.id.into(), method)).collect())
};

pub(super) const IMPACT: Id<&Impact> = Id {
    lists: &["impacts"],
    spellings: || impact_spellings().collect(),
    ..Id::new("rule", || IMPACTS.iter().map(|impact| (impact.id.into(), impact)).collect())
};

/// The ideal loops, and those of engines and libraries.
pub(super) const LOOP: Id<Arc<PolicyCard>> = Id {
    lists: &["policies", "engine-loops"],
    spellings: || loops().map(|card| (&*card.name, &*card.id)).collect(),
    ..Id::new("policy", || loops().map(|card| (card.id.clone(), card.clone())).collect())
};

pub(super) const ENGINE: Id<Arc<PolicyCard>> = Id {
    lists: &["engine-loops"],
    spellings: || ENGINES.iter().map(|card| (&*card.name, &*card.id)).collect(),
    ..Id::new("engine", || ENGINES.iter().map(|card| (card.id.clone(), card.clone())).collect())
};

fn loops() -> impl Iterator<Item = &'static Arc<PolicyCard>> {
    POLICIES.iter().chain(ENGINES.iter())
}

pub(super) const TRACE: Id<&TraceCard> = Id {
    lists: &["traces"],
    ..Id::new("trace", || TRACES.iter().map(|card| (card.id.into(), card)).collect())
};

pub(super) const INSTRUMENT: Id<Instrument> =
    Id::new("instrument", || Instrument::all().map(|it| (it.id(), it)).collect());

pub(super) const SHAPE: Id<CloudShape> =
    Id::new("shape", || CloudShape::ALL.map(|shape| (shape.id().into(), shape)).into());

pub(super) const THEME: Id<Theme> =
    Id::new("theme", || vec![("dark".into(), Theme::Dark), ("light".into(), Theme::Light)]);

pub(super) const RENDERER: Id<RendererChoice> = Id::new("renderer", || {
    use RendererChoice::{Auto, Cpu, Gpu};
    [("auto", Auto), ("gpu", Gpu), ("cpu", Cpu)].map(|(id, choice)| (id.into(), choice)).into()
});

pub(super) const FAMILY: Id<Family> =
    Id::new("family", || Family::ALL.map(|(id, family)| (id.into(), family)).into());

/// The forms of code: the languages, C++, whose compilers accept the C code, and the lines of a step.
pub(super) const CODE_FORM: Id<CodeForm> = Id {
    spellings: languages_by_other_names,
    ..Id::new("language", || {
        let others = [("cpp", Language::C.into()), ("step", CodeForm::Step)];
        let languages = Language::ALL.map(|language| (language.id(), language.into()));
        languages.into_iter().chain(others).map(|(id, form)| (id.to_owned(), form)).collect()
    })
};

/// Other names of languages, each with its id.
fn languages_by_other_names() -> Vec<(&'static str, &'static str)> {
    vec![("c++", "cpp"), ("c#", "csharp"), ("js", "javascript"), ("luau", "lua")]
}
