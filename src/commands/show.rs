//! `regatta show`: prints a method or a game loop as code for a game.

use std::sync::Arc;

use clap::Args;
use serde_json::json;

use super::error::Error;
use super::help::flowing;
use super::id::{CODE_FORM, Id, LOOP, METHOD};
use super::output::table::TableFormat;
use super::output::{print, print_json};
use super::own_file::{FRAMES, STEP, load_loop, load_method};
use super::terminal::print_status;
use crate::loops::PolicyCard;
use crate::sim::integrators::{METHODS, Method};
use crate::sim::{IMPACTS, Impact};
use crate::tools::source_code::{CodeForm, Precision, impact_code, loop_code, source_code};

const ABOUT: &str = "\
A method of your own is a file of the lines of its step: see `regatta help step`. The comment has its
measured card: its order, the change of a spring's energy, and the nearest built-in method.

The function makes one step of h seconds for one coordinate. It takes the position x, the velocity v and
a function a(x, v) for the acceleration. A method with memory takes its memory too, a follower the
position of its target and a rate, and an engine the settings of its joint and its body. The comment
above the function has the details.

A gyroscopic method, such as split-3, takes the angular velocity, the attitude as the four numbers of a
quaternion, the moments and the step.

A loop is a type made for a tick rate, and one function: once a frame it calls your step for each tick,
and returns the moment to draw. The loops of engines (regatta list engine-loops) and of your own have
it too, and without --as you see their lines.

Examples:
  regatta show rk4
  regatta show semi-implicit-euler --as csharp --float
  regatta show bdf2 --as c > bdf2.h
  regatta show my.step --as cpp
  regatta show split-3 --as csharp        a step of a body that turns in space
  regatta show bdf2 --as step > my-bdf2.step
  regatta show fixed-linear --as cpp
  regatta show bevy --as csharp
  regatta show clamp --as csharp          a rule for impacts";

/// Print a method or a game loop as code for your game
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct ShowArgs {
    /// A method, by its id or another name, a game loop, or a rule for impacts
    ///
    /// `regatta list methods` and `regatta list policies` have them. A file that ends in .step is a method of your own,
    /// one that ends in .loop a loop.
    #[arg(value_name = "METHOD|POLICY|FILE", value_parser = SHOWN_ITEM, hide_possible_values = true)]
    asked: ShownItem,

    /// The language: rust, c, cpp, csharp, gdscript, javascript, lua or step
    ///
    /// The default is rust, and step for the loop of an engine or of your own. The code in cpp is that in c. `step` is
    /// the language of a method or a loop of your own, to change and give back.
    #[arg(long = "as", value_name = "LANGUAGE")]
    #[arg(value_parser = CODE_FORM, hide_possible_values = true)]
    form: Option<CodeForm>,

    /// The format: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    format: TableFormat,

    /// Use single precision, as Unity and Godot do
    #[arg(long)]
    float: bool,
}

/// The item to show.
#[derive(Clone, Debug)]
enum ShownItem {
    Method {
        method: &'static Method,
        /// The [other id](Method::also) of the method that the user gave, if it was not the method's own id.
        alias: Option<&'static str>,
    },
    Loop(Arc<PolicyCard>),
    Impact(&'static Impact),
}

/// Parser for the id of a method, one of its other ids, the id of a game loop or of a rule, or a file of a person.
const SHOWN_ITEM: Id<ShownItem> = Id {
    thing: "method, policy or rule",
    lists: &["methods", "policies", "impacts"],
    all: || {
        let own = METHODS.iter().map(|it| (it.id, ShownItem::Method { method: it, alias: None }));
        let others = METHODS.iter().flat_map(|method| {
            let with = |alias| (alias, ShownItem::Method { method, alias: Some(alias) });
            method.also.iter().copied().map(with)
        });
        let methods = own.chain(others).map(|(id, asked)| (id.to_owned(), asked));
        let loops = (LOOP.all)().into_iter().map(|(id, card)| (id, ShownItem::Loop(card)));
        let impacts = IMPACTS.iter().map(|it| (it.id.to_owned(), ShownItem::Impact(it)));
        methods.chain(loops).chain(impacts).collect()
    },
    spellings: || [(METHOD.spellings)(), (LOOP.spellings)()].concat(),
    files: &[
        (STEP, |path| Ok(ShownItem::Method { method: load_method(path)?, alias: None })),
        (FRAMES, |path| load_loop(path).map(ShownItem::Loop)),
    ],
};

pub(super) fn run(args: &ShowArgs) -> Result<(), Error> {
    let code = code(args)?;
    match args.format {
        TableFormat::Text => print(&code),
        TableFormat::Json => {
            let (id, kind) = match &args.asked {
                ShownItem::Method { method, .. } => (method.id, "method"),
                ShownItem::Loop(card) => (&*card.id, "loop"),
                ShownItem::Impact(impact) => (impact.id, "impact"),
            };
            print_json(format!("{:#}\n", json!({"id": id, "kind": kind, "code": code})))
        }
    }
}

/// Returns the code of the item that is asked for.
fn code(args: &ShowArgs) -> Result<String, Error> {
    let (method, alias) = match &args.asked {
        ShownItem::Method { method, alias } => (*method, *alias),
        ShownItem::Loop(_) | ShownItem::Impact(_) if args.float => {
            return Err(Error::mistake(
                "--float is for methods; a loop or a rule has no precision to choose",
            ));
        }
        ShownItem::Loop(card) => return loop_source(card, args.form),
        ShownItem::Impact(impact) => {
            return impact_code(impact, args.form.unwrap_or_default()).map_err(Error::mistake);
        }
    };
    let form = args.form.unwrap_or_default();
    if args.float && form == CodeForm::Step {
        return Err(Error::mistake("--float is for code; the lines of a step are for both"));
    }
    let precision = if args.float { Precision::Single } else { Precision::Double };
    let code = source_code(method, form, precision).map_err(Error::mistake)?;
    if let Some(alias) = alias {
        print_status(&format!("note: {alias} is another name of {}, which is shown", method.id));
    }
    Ok(code)
}

/// Returns the source code of a loop in a language. That of an engine or of a person is its lines, unless they ask for
/// a language.
fn loop_source(card: &PolicyCard, form: Option<CodeForm>) -> Result<String, Error> {
    let lines = card.lines().unwrap_or_default();
    let usual = if card.is_from_outside() { CodeForm::Step } else { CodeForm::default() };
    let CodeForm::Function(language) = form.unwrap_or(usual) else { return Ok(lines.to_owned()) };
    loop_code(&card.id, lines, language).map_err(|reason| {
        Error::mistake(format!("{} has no code in {language}: {reason}; give --as step", card.id))
    })
}
