//! The faults that a scene file can have: a variant for each, with its values and its remedy.

use std::fmt;
use std::ops::RangeInclusive;

use super::MAX_FILE_BYTES;
use super::clip::clip;
use super::refusal::Refusal;
use crate::lab::lane_spec::LaneSpec;
use crate::sim::bodies::{self, BODIES, Fault, Pin, Text};
use crate::sim::integrators::{METHODS, Method};
use crate::sim::law::Layout;

/// A fault of a scene file. Its display says what is wrong, and [`SceneFault::remedy`] what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(super) enum SceneFault {
    #[error("the file holds more than {MAX_FILE_BYTES} bytes")]
    TooLarge,
    #[error("the file is not text: byte {byte} is not UTF-8")]
    NotUtf8 { byte: usize },
    #[error("the file holds no scene")]
    Empty,
    #[error("{what}")]
    Syntax { what: String, remedy: String },
    #[error("`{}` is given twice", clip(key))]
    DuplicateKey { key: String, is_table: bool },
    #[error("missing key `{key}` {place}")]
    MissingKey { key: &'static str, place: Place, about: &'static str, wanted: Wanted },
    #[error("unknown key `{}` {place}", clip(key))]
    UnknownKey { key: String, place: Place, nearest: Option<Text>, known: Vec<Text> },
    #[error("`{key}` does not belong {place}")]
    Misplaced { key: &'static str, place: Place },
    #[error("unknown table `{}`", clip(key))]
    UnknownTable { key: String, nearest: Option<&'static str>, known: Vec<&'static str> },
    #[error("unknown method {:?} in `{key}`", clip(id))]
    UnknownMethod {
        id: String,
        key: &'static str,
        nearest: Option<&'static str>,
        known: Vec<&'static str>,
    },
    #[error("{subject} is {found}, not {}", wanted.noun())]
    WrongType { subject: String, found: String, wanted: Wanted },
    #[error("`{key}` is {value}, out of range")]
    OutOfRange { key: Text, value: String, wanted: Wanted },
    #[error("{subject} is {value}, out of range")]
    ItemOutOfRange { subject: String, value: String, wanted: Wanted },
    #[error("`{key}` has {found} point{}", if *found == 1 { "" } else { "s" })]
    PointCount { key: &'static str, found: usize, wanted: Wanted },
    #[error("`{key}` has {found} number{}", if *found == 1 { "" } else { "s" })]
    NumberCount { key: &'static str, found: usize, wanted: Wanted },
    #[error("`{key}` goes from {before} to {value}")]
    NotRising { key: &'static str, value: f64, before: f64 },
    #[error("{}", .0.what)]
    Fault(Fault),
    #[error("`{key}` is empty")]
    EmptyText { key: &'static str, wanted: Wanted },
    #[error("`{key}` has {chars} characters")]
    LongText { key: &'static str, chars: usize, wanted: Wanted },
    #[error("`{key}` holds the control character U+{:04X}", *character as u32)]
    ControlCharacter { key: &'static str, character: char },
    #[error("the scene has no body")]
    NoBody,
    #[error("the scene has {found} bodies")]
    TooManyBodies { found: usize, most: usize },
    #[error("the name {name:?} is taken by the body on line {line}")]
    DuplicateName { name: String, line: usize },
    #[error("`methods` is empty")]
    NoLanes,
    #[error("the scene has {found} lanes")]
    TooManyLanes { found: usize, most: usize },
    #[error("a lane {} is on line {line} already", describe(lane))]
    DuplicateLane { lane: LaneSpec, line: usize },
    #[error("lanes are given twice, as `methods` and as `[[lane]]`")]
    TwoLaneLists,
    #[error("`{key}` is {method:?}, which no lane of this scene has")]
    NotALane { key: &'static str, method: &'static str, known: Vec<&'static str> },
    #[error("`{key}`: {refusal}")]
    Refused { key: &'static str, refusal: Refusal },
    #[error("`{key}` does not apply to the method {method:?}")]
    NoTolerance { key: &'static str, method: &'static str },
    #[error("`{key}` does not apply to the method {method:?}, which is told no spring")]
    NoJoint { key: &'static str, method: &'static str },
    #[error("`{key}` stands alone")]
    Alone { key: &'static str, needed: &'static str },
    #[error("`tolerance` does not apply to lane {lane}: at tick {tick} its method is {method:?}")]
    NoToleranceInLane { lane: usize, method: &'static str, tick: u64 },
    #[error("the command does nothing")]
    NoAction { known: Vec<&'static str> },
    #[error("the command does {} things: {}", found.len(), list(found, '`', " and "))]
    ManyActions { found: Vec<&'static str> },
    #[error("no body of this scene takes `{input}`")]
    NoTaker { input: &'static str },
    #[error("`lane` does not apply to this command")]
    LaneAlone { known: [&'static str; 3] },
    #[error("the command does not say of which lane")]
    NoLane { lanes: usize },
    #[error("no body of this scene is called {:?}", clip(name))]
    UnknownBody { name: String, known: Vec<String> },
    #[error("{:?} is no parameter of this body", clip(key))]
    UnknownParameter { key: String, nearest: Option<Text>, known: Vec<Text> },
    #[error("`{key}` acts at the start only, and a command comes later")]
    ActsAtStart { key: Text, settable: Vec<Text> },
    #[error("{what}")]
    Law { what: String, remedy: String },
    #[error("{what}")]
    Net { what: String, remedy: String },
    #[error("`{key}` is {text:?}, not a hash")]
    NoHash { key: &'static str, text: String },
}

/// Where a key stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Before the first table.
    Top,
    /// In a table array of this name.
    Table(&'static str),
    /// In a table of this name.
    Within(&'static str),
}

/// The kind of value that a key takes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Wanted {
    /// A string of at most this many characters.
    Text(usize),
    /// A number, whole or not.
    Number(bodies::Range),
    /// A whole number.
    Whole(RangeInclusive<u64>),
    /// A list of points.
    Curve(bodies::Range),
    /// A point of a curve.
    Point,
    /// The id of a method.
    Method,
    /// A list of methods' ids.
    Methods,
    /// A table array of this name.
    Tables(&'static str),
    /// A table of this name.
    Table(&'static str),
    /// A table of the numbers that expressions know by name.
    Constants,
    /// A table of this name for each coordinate.
    Coordinates(&'static str),
    /// An expression.
    Expression,
    /// The names of two coordinates.
    Plane,
    /// Two expressions.
    At,
    /// The name of a [`Layout`].
    Layout,
    /// The places of nodes.
    Places,
    /// The numbers of nodes.
    Nodes,
    /// The number of a node.
    Node,
    /// The numbers of two nodes.
    Ends,
    /// A list of springs.
    Springs,
    /// A spring in such a list.
    Spring,
    /// The name of a [`Pin`].
    Pin,
    /// `true` or `false`.
    Boolean,
    /// A list of this many numbers.
    Numbers(usize),
    /// The state of a lane, as 16 hexadecimal digits.
    Hash,
}

impl SceneFault {
    /// How to mend it.
    pub(super) fn remedy(&self) -> String {
        match self {
            SceneFault::TooLarge => "give a scene file, with a shorter script".into(),
            SceneFault::NotUtf8 { .. } => "give a scene file, saved as UTF-8".into(),
            SceneFault::Empty => {
                "write `title`, `tick_hz`, `seconds` and a table such as `[[ship]]`".into()
            }
            SceneFault::Syntax { remedy, .. }
            | SceneFault::Law { remedy, .. }
            | SceneFault::Net { remedy, .. } => remedy.clone(),
            SceneFault::DuplicateKey { key, is_table: true } => {
                format!("write `[[{}]]` each time", clip(key))
            }
            SceneFault::DuplicateKey { .. } => "keep one of them".into(),
            SceneFault::MissingKey { key, place: Place::Top, about, wanted } => {
                format!("write `{key} = …` above the first table: {about}, {wanted}")
            }
            SceneFault::MissingKey { key, about, wanted, .. } => {
                format!("write `{key} = …`: {about}, {wanted}")
            }
            SceneFault::UnknownKey { nearest, known, .. } => offer(nearest.as_deref(), known, '`'),
            SceneFault::Misplaced { .. } => "move it above the first table".into(),
            SceneFault::UnknownTable { nearest, known, .. } => offer(*nearest, known, '['),
            SceneFault::UnknownMethod { nearest, known, .. } => offer(*nearest, known, '"'),
            SceneFault::WrongType { wanted, .. }
            | SceneFault::OutOfRange { wanted, .. }
            | SceneFault::ItemOutOfRange { wanted, .. }
            | SceneFault::PointCount { wanted, .. }
            | SceneFault::NumberCount { wanted, .. }
            | SceneFault::EmptyText { wanted, .. }
            | SceneFault::LongText { wanted, .. } => format!("write {wanted}"),
            SceneFault::NotRising { .. } => {
                "order the points by their first numbers, each greater than the one before".into()
            }
            SceneFault::Fault(fault) => fault.remedy.clone(),
            SceneFault::ControlCharacter { .. } => "remove it".into(),
            SceneFault::NoBody => {
                let kinds: Vec<_> = BODIES.iter().map(|kind| kind.id).collect();
                format!("add a table {}", list(&kinds, '[', " or "))
            }
            SceneFault::TooManyBodies { most, .. } => format!("keep at most {most}"),
            SceneFault::DuplicateName { .. } => "give it another".into(),
            SceneFault::NoLanes => "name a method, or remove the line and all of them race".into(),
            SceneFault::TooManyLanes { most, .. } => format!("keep at most {most}"),
            SceneFault::DuplicateLane { lane, .. } => {
                let or =
                    if lane.method.tolerance.is_some() { " or another `tolerance`" } else { "" };
                format!("remove one, or give it other `substeps`{or} in a `[[lane]]`")
            }
            SceneFault::TwoLaneLists => "keep one of them".into(),
            SceneFault::NotALane { known, .. } => {
                format!("write one of {}, or give it a lane", list(known, '"', ", "))
            }
            SceneFault::Refused { .. } => {
                "name another method, or change the body; `regatta list methods` has what each is for".into()
            }
            SceneFault::NoTolerance { .. } => {
                format!("remove it, or choose an adaptive method: {}", adaptive_methods())
            }
            SceneFault::NoJoint { .. } => format!("remove it, or choose an engine: {}", engines()),
            SceneFault::Alone { needed, .. } => format!("remove it, or write `{needed}` too"),
            SceneFault::NoToleranceInLane { .. } => {
                format!("remove it, or give it with an adaptive `method`: {}", adaptive_methods())
            }
            SceneFault::NoAction { known } => format!("write one of {}", list(known, '`', ", ")),
            SceneFault::ManyActions { .. } => {
                "write a `[[command]]` with the same `tick` for each".into()
            }
            SceneFault::LaneAlone { known } => {
                format!("remove it, or give one of {}", list(known, '`', ", "))
            }
            SceneFault::NoLane { lanes } => format!("write `lane = …`: its number, from 1 to {lanes}"),
            SceneFault::UnknownBody { known, .. } => {
                let known: Vec<&str> = known.iter().map(String::as_str).collect();
                format!("write one of {}", list(&known, '"', ", "))
            }
            SceneFault::UnknownParameter { nearest, known, .. } => offer(nearest.as_deref(), known, '"'),
            SceneFault::ActsAtStart { settable, .. } => format!(
                "write it in the body's table, move the body by `place`, or set one of {}",
                list(settable, '"', ", ")
            ),
            SceneFault::NoHash { .. } => format!("write {}", Wanted::Hash),
            SceneFault::NoTaker { input } => {
                let takers = BODIES.iter().filter(|kind| kind.inputs.contains(input));
                let takers: Vec<_> = takers.map(|kind| kind.id).collect();
                format!("remove the command, or add a table {}", list(&takers, '[', " or "))
            }
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Top => f.write_str("at the top of the file"),
            Place::Table(name) => write!(f, "in `[[{name}]]`"),
            Place::Within(name) => write!(f, "in `{name}`"),
        }
    }
}

impl Wanted {
    /// The kind of value that a parameter of this range takes.
    pub(super) fn of(range: bodies::Range) -> Self {
        match range {
            bodies::Range::Count(most) => Wanted::Whole(1..=most.into()),
            bodies::Range::Curve { .. } => Wanted::Curve(range),
            _ => Wanted::Number(range),
        }
    }

    fn noun(&self) -> &'static str {
        match self {
            Wanted::Text(_)
            | Wanted::Method
            | Wanted::Hash
            | Wanted::Expression
            | Wanted::Pin
            | Wanted::Layout => "a string",
            Wanted::Number(_) => "a number",
            Wanted::Whole(_) => "an integer",
            Wanted::Methods | Wanted::Curve(_) | Wanted::Plane | Wanted::At => "a list",
            Wanted::Places => "a list of pairs",
            Wanted::Nodes | Wanted::Ends => "a list of whole numbers from 0",
            Wanted::Node => "a whole number from 0",
            Wanted::Springs => "a list of tables",
            Wanted::Spring => "a table",
            Wanted::Numbers(_) => "a list of numbers",
            Wanted::Boolean => "a boolean",
            Wanted::Table(_) | Wanted::Constants | Wanted::Coordinates(_) => "a table",
            Wanted::Point => "a pair of numbers",
            Wanted::Tables(_) => "an array of tables",
        }
    }
}

impl fmt::Display for Wanted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Wanted::Text(most) => write!(f, "1 to {most} characters in double quotes"),
            Wanted::Number(range) => write!(f, "a number {range}"),
            Wanted::Whole(range) => {
                write!(f, "a whole number from {} to {}", range.start(), range.end())
            }
            Wanted::Curve(range) => write!(f, "a list of {range}"),
            Wanted::Point => write!(f, "two numbers in brackets, such as [0.0, 1.0]"),
            Wanted::Method => write!(f, "a method's name in double quotes, such as \"rk4\""),
            Wanted::Methods => write!(f, "a list of methods' names, such as [\"rk4\"]"),
            Wanted::Hash => write!(
                f,
                "16 digits from 0 to 9 and a to f in double quotes, as a recording has them"
            ),
            Wanted::Boolean => write!(f, "true or false"),
            Wanted::Numbers(1) => write!(f, "one number in brackets, such as [0.5]"),
            Wanted::Numbers(count) => write!(f, "{count} numbers in brackets, with commas between"),
            Wanted::Table(name) => write!(f, "`[{name}]` in brackets and its keys below"),
            Wanted::Constants => {
                write!(f, "names and numbers, such as {{ k = 18000.0, m = 250.0 }}")
            }
            Wanted::Coordinates(name) => {
                write!(f, "`[{name}.x]` for a coordinate x, and its keys below")
            }
            Wanted::Expression => write!(f, "an expression in double quotes, such as \"-k*x/m\""),
            Wanted::Plane => write!(f, "the names of two coordinates, such as [\"x\", \"y\"]"),
            Wanted::At => {
                write!(f, "two expressions for x and y, such as [\"l*sin(a)\", \"-l*cos(a)\"]")
            }
            Wanted::Places => {
                write!(f, "the places of the nodes in metres, such as [[0.0, 0.0], [1.0, 0.0]]")
            }
            Wanted::Nodes => write!(f, "the numbers of nodes, such as [0, 3]"),
            Wanted::Node => write!(f, "the number of a node, such as 3"),
            Wanted::Ends => write!(f, "the numbers of two nodes, such as [0, 1]"),
            Wanted::Springs => write!(f, "a list such as [{{ between = [0, 1] }}]"),
            Wanted::Spring => write!(f, "a spring in braces, such as {{ between = [0, 1] }}"),
            Wanted::Layout => {
                write!(f, "{}", list(&Layout::ALL.map(|(id, _)| id), '"', " or "))
            }
            Wanted::Pin => write!(f, "{}", list(&Pin::ALL.map(Pin::id), '"', " or ")),
            Wanted::Tables(name) => write!(f, "`[[{name}]]` in double brackets and its keys below"),
        }
    }
}

fn adaptive_methods() -> String {
    methods(|method| method.tolerance.is_some())
}

/// The engines that are told a spring.
fn engines() -> String {
    methods(Method::has_joint)
}

fn methods(fits: fn(&Method) -> bool) -> String {
    let fitting = METHODS.iter().filter(|method| fits(method));
    list(&fitting.map(|method| method.id).collect::<Vec<_>>(), '"', ", ")
}

fn describe(lane: &LaneSpec) -> String {
    let LaneSpec { method, substeps, tolerance, joint } = lane;
    let within = tolerance.map(|tolerance| format!(" and `tolerance = {tolerance:e}`"));
    let told = joint.map(|[hz, _]| format!(" and `joint_hz = {hz}`"));
    let beside = [within, told].into_iter().flatten().collect::<String>();
    format!("{:?} with `substeps = {substeps}`{beside}", method.id)
}

fn offer(nearest: Option<&str>, known: &[impl AsRef<str>], quote: char) -> String {
    match nearest {
        Some(name) => format!("did you mean {}?", list(&[name], quote, "")),
        None => format!("write one of {}", list(known, quote, ", ")),
    }
}

fn list(names: &[impl AsRef<str>], quote: char, between: &str) -> String {
    let quoted = names.iter().map(AsRef::as_ref).map(|name| match quote {
        '[' => format!("`[[{name}]]`"),
        _ => format!("{quote}{name}{quote}"),
    });
    quoted.collect::<Vec<_>>().join(between)
}
