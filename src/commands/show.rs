//! `regatta show`: a method as a function, to be taken into a game.

use clap::Args;

use super::error::Error;
use super::help::flowing;
use super::id::{Id, LANGUAGE, METHOD};
use super::output::print;
use super::terminal::print_status;
use crate::lab::source_code::{Language, Precision, source_code};
use crate::sim::integrators::{METHODS, Method};

const ABOUT: &str = "\
The function makes one step of h seconds for one coordinate: of its position x, its velocity v and
a function a(x, v) for the acceleration. A method with memory takes its memory too, a follower the
position of its target and a rate, and an engine the settings of its joint and its body. Above the
function stand the method's source, its order, its stability limit, how it restarts, and what to do
with forces that depend on time.

Examples:
  regatta show rk4
  regatta show semi-implicit-euler --as csharp --float
  regatta show bdf2 --as c > bdf2.h
  regatta show critically-damped-spring --as gdscript > spring.gd";

/// Print a method as a function in Rust, C, C# or GDScript
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct ShowArgs {
    /// The method, by its id or another name of it
    ///
    /// `regatta list methods` has both.
    #[arg(value_name = "METHOD", value_parser = ASKED, hide_possible_values = true)]
    asked: Asked,

    /// The language
    #[arg(long = "as", value_name = "LANGUAGE", default_value = Language::Rust.id())]
    #[arg(value_parser = LANGUAGE)]
    language: Language,

    /// Numbers of single precision, as Unity and Godot have them
    #[arg(long)]
    float: bool,
}

/// A method that was asked for.
#[derive(Clone, Copy, Debug)]
struct Asked {
    method: &'static Method,
    /// The one of its [other ids](Method::also) that was given, if it was not its own.
    alias: Option<&'static str>,
}

/// Takes the id of a method or one of its other ids.
const ASKED: Id<Asked> = Id {
    thing: METHOD.thing,
    list: METHOD.list,
    all: || {
        let own = METHODS.iter().map(|method| (method.id.into(), Asked { method, alias: None }));
        let others = METHODS.iter().flat_map(|method| {
            method
                .also
                .iter()
                .map(move |alias| ((*alias).into(), Asked { method, alias: Some(alias) }))
        });
        own.chain(others).collect()
    },
    spellings: METHOD.spellings,
};

pub(super) fn run(args: &ShowArgs) -> Result<(), Error> {
    let Asked { method, alias } = args.asked;
    let precision = if args.float { Precision::Single } else { Precision::Double };
    let code = source_code(method, args.language, precision).map_err(Error::mistake)?;
    if let Some(alias) = alias {
        print_status(&format!("note: {alias} is another name of {}, which is shown", method.id));
    }
    print(&code)
}
