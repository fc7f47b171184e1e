//! `regatta show`: a method as a function, to be taken into a game.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

use super::error::{Cause, Error};
use super::experiment::MethodParser;
use super::output::print;
use crate::lab::{Language, NoSourceCode, source_code};
use crate::sim::integrators::Method;

const ABOUT: &str = "\
The function makes one step of h seconds for one coordinate: of its position x, its velocity v and
a function a(x, v) for the acceleration. A method with memory takes its memory too, a follower the
position of its target and a rate, and an engine the settings of its joint and its body. Forces that
depend on time are left out. Above the function stand the method's source, its order, its stability
limit, and how it restarts.

Examples:
  regatta show rk4
  regatta show semi-implicit-euler --as csharp
  regatta show bdf2 --as c > bdf2.h
  regatta show critically-damped-spring --as gdscript > spring.gd";

/// Print a method as a function in Rust, C, C# or GDScript
#[derive(Debug, Args)]
#[command(after_help = ABOUT)]
pub(super) struct ShowArgs {
    /// The method (`regatta list methods`)
    #[arg(value_name = "METHOD", value_parser = MethodParser, hide_possible_values = true)]
    method: &'static Method,

    /// The language
    #[arg(long = "as", value_name = "LANGUAGE", default_value = Language::Rust.id())]
    #[arg(value_parser = language())]
    language: Language,
}

impl Cause for NoSourceCode {
    fn exit_code(&self) -> u8 {
        2
    }
}

/// Takes the id of a language; offers all of them to the shell's completion.
fn language() -> impl TypedValueParser<Value = Language> {
    let known = PossibleValuesParser::new(Language::ALL.map(Language::id));
    known.map(|id| Language::ALL.into_iter().find(|known| known.id() == id).unwrap_or_default())
}

pub(super) fn run(args: &ShowArgs) -> Result<(), Error> {
    Ok(print(&source_code(args.method, args.language)?)?)
}
