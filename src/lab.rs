//! Former paths of the rooms between `sim` and the pixels, kept for one release. Use [`scene`], [`run`](crate::run),
//! [`tools`](crate::tools), [`measure`](crate::measure), [`loops`](crate::loops), [`look`](crate::look), [`studio`]
//! or [`stage`](crate::stage) instead.

pub use crate::look::palette;
pub use crate::loops::{self as pacing, loop_lab};
pub use crate::measure::{
    Adviser, CRITERIA, Criterion, Judge, Report, Verdict, advise, cloud, try_advise,
};
pub use crate::run::{
    Journal, Lane, METRICS, Metric, Race, Run as Timeline, Session, Ticker, diff, link, race, trace,
};
pub use crate::scene::{
    self, Action, LaneId, LaneSpec, Options, SCENES, Scene, SceneBody, SceneErrors, Swing, custom,
};
pub use crate::studio::{self, Studio};
pub use crate::tools::{identify, port, source_code};

/// Former path of the drawn past and of the menu.
pub mod past {
    pub use crate::run::Menu;
    pub use crate::run::past::*;
}

/// Former path of a run's parts.
pub mod session {
    pub use crate::run::{
        Event, EventKind, Reached, RecordingError, Replay, Run as Timeline, SNAPSHOT_BYTES,
        Session, recording_text,
    };
}

/// Former path of [`stage`](crate::stage).
pub mod picture {
    pub use crate::look::palette::{self, Rgba};
    pub use crate::look::{Framing, Handle, Look, Pull};
    pub use crate::scene::{Mark, Outline};
    pub use crate::stage::*;
}

/// Former path of [`measure`](crate::measure).
pub mod analysis {
    pub use crate::measure::*;
    pub use crate::run::{METRICS, Metric, Scale, Unit, energy_gained_percent};
}
