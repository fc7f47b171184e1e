//! The manual of the program and the library, in chapters with examples. `regatta help` prints the same text.

/// A chapter of the manual.
#[derive(Clone, Copy, Debug)]
pub struct Chapter {
    /// The chapter's name in `regatta help`.
    pub id: &'static str,
    /// A summary in one line.
    pub about: &'static str,
    /// The text in Markdown.
    pub text: &'static str,
}

macro_rules! chapters {
    ($($id:ident: $about:literal)*) => {
        /// All chapters, in reading order.
        pub const CHAPTERS: &[Chapter] = &[$(Chapter {
            id: stringify!($id),
            about: $about,
            text: include_str!(concat!("manual/", stringify!($id), ".md")),
        }),*];
        $(
            #[doc = concat!("The manual: ", $about, ".\n\n")]
            // Tests run the examples in these chapters. Those in Rust run in a separate package.
            #[cfg_attr(all(doc, not(doctest)), doc = include_str!(concat!("manual/", stringify!($id), ".md")))]
            pub mod $id {}
        )*
    };
}

chapters! {
    keys: "every key, and what the mouse does"
    scenes: "the built-in scenes, and how to write one: bodies, scripts, equations, nets"
    commands: "the command line by examples: advise, sweep, trace, capture, verify"
    loops: "what a game's loop and display add to a motion"
    logs: "which engine or method made a log"
    questions: "why a spring dies, a camera lags, a jump is lower: each with a command and a number"
    code: "a method as source code for a game"
    step: "your own lines: what they do at every frame rate"
    library: "custom bodies and methods, in a game or its tests"
    ci: "frames and hashes in continuous integration"
    methods: "every method: order, cost, stability limit"
    engines: "what the physics engines do to one body"
    speed: "what a step of each method costs"
    stable: "what stays as it is from release to release"
}

/// The chapter with this id.
pub fn chapter(id: &str) -> Option<&'static Chapter> {
    CHAPTERS.iter().find(|chapter| chapter.id == id)
}
