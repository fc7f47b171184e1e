//! Finds a method by a word of a file or of a person.

use std::fmt;

use super::{METHODS, Method};

/// Returns a word without the differences that do not matter in a name: case, blanks around it, and the kind of hyphen.
pub fn plain(word: &str) -> String {
    word.trim().to_lowercase().replace(['_', ' '], "-")
}

/// The error about a word that names no method.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownMethod {
    /// The word.
    pub word: String,
    /// The ids of the methods that have the word in a spelling.
    pub near: Vec<&'static str>,
}

impl fmt::Display for UnknownMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no method is called {:?}; ", self.word)?;
        match &*self.near {
            [] => write!(f, "METHODS lists all"),
            near => write!(f, "did you mean {}?", near.join(" or ")),
        }
    }
}

impl std::error::Error for UnknownMethod {}

/// Returns the method with this [spelling](Method::spellings), from a file or a person. Case, `_` and blanks do not
/// matter.
///
/// # Errors
/// If no method has the spelling. The error names the methods that are near.
pub fn method_or_nearest(word: &str) -> Result<&'static Method, UnknownMethod> {
    let written = plain(word);
    let is_near = |method: &&'static Method, is_near: fn(&str, &str) -> bool| {
        method.spellings().any(|(spelling, _)| is_near(&plain(spelling), &written))
    };
    let found =
        METHODS.iter().find(|method| is_near(method, |spelling, written| spelling == written));
    found.ok_or_else(|| {
        let near = METHODS.iter().filter(|method| {
            !written.is_empty() && is_near(method, |spelling, written| spelling.contains(written))
        });
        UnknownMethod { word: word.to_owned(), near: near.map(|method| method.id).collect() }
    })
}
