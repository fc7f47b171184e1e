//! The card of a method, and the base card of each family.
//!
//! A method sets its name, source, orders and evaluations, and inherits the other fields from its family unless they
//! differ.

use super::custom_method::BuildIntegrator;
use super::engine_bounce::EngineBounce;
use super::free_spin::FreeSpin;
use super::integrator::Tolerance;
use super::joint_mode::JointMode;
use super::only::{Needs, Only};
use crate::TickRate;
use crate::system::{BodyClass, Coupling};

/// The families of methods, for menus and tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Family {
    /// Computes each stage from known values.
    Explicit,
    /// Conserves phase-space area on systems without drag.
    Symplectic,
    /// Chooses its own substeps to meet a tolerance.
    Adaptive,
    /// Solves an equation for each step.
    Implicit,
    /// Uses the derivative of the acceleration at the start of each step, without iteration.
    Linearised,
    /// A published listing, with its faults.
    AsPrinted,
    /// Moves a body towards its target by its own rule, without the acceleration.
    Follower,
    /// Reproduces a tick of a physics engine.
    Engine,
    /// Turns a rigid body freely in space, by its moments of inertia.
    Gyro,
    /// Reproduces a frame of the spring of an interface's library.
    Interface,
}

impl Family {
    /// Every family with its id, one lower-case word, in the order of the table.
    pub const ALL: [(&str, Family); 10] = [
        ("explicit", Family::Explicit),
        ("symplectic", Family::Symplectic),
        ("adaptive", Family::Adaptive),
        ("implicit", Family::Implicit),
        ("linearised", Family::Linearised),
        ("as-printed", Family::AsPrinted),
        ("follower", Family::Follower),
        ("engine", Family::Engine),
        ("gyro", Family::Gyro),
        ("interface", Family::Interface),
    ];

    /// Returns the id of the family.
    pub fn id(self) -> &'static str {
        super::id_in(&Self::ALL, self)
    }

    /// Returns the base card of the family. It has no name, source, order and evaluations yet.
    pub const fn card(self) -> Method {
        match self {
            Family::Explicit => EXPLICIT,
            Family::Symplectic => SYMPLECTIC,
            Family::Adaptive => ADAPTIVE,
            Family::Implicit => IMPLICIT,
            Family::Linearised => LINEARISED,
            Family::AsPrinted => AS_PRINTED,
            Family::Follower => FIRST_ORDER_FOLLOWER,
            Family::Engine => ENGINE,
            Family::Gyro => GYRO,
            Family::Interface => INTERFACE,
        }
    }
}

/// The reason why a person's lines of a place step no body that turns in space.
const NO_TURN: &str = "its lines move a place, and a free spin turns";

/// The part of a card that only a physics engine has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Engine {
    /// The engine's default tick rate in hertz; 60 if its caller sets the tick.
    pub tick_hz: u32,
    /// The damping ratio that an undamped spring of 1 Hz shows at that rate and the card's substeps. It is negative if
    /// the spring gains energy. `None` if the engine has no spring.
    pub damping_ratio: Option<f64>,
    /// The meaning of the engine's substeps.
    pub substeps: Substeps,
    /// How the engine bounces a ball on a wall; `None` if its rule is not reproduced.
    pub bounce: Option<EngineBounce>,
    /// How the engine integrates torque-free rotation in space. It is `None` for engines in the plane, for pybullet's
    /// multibody, for PhysX 5.6 and for a held force.
    pub free_spin: Option<FreeSpin>,
    /// The version of the source from which the formula was read; empty for a held force, which belongs to no single
    /// engine.
    pub version: &'static str,
    /// The day, as year-month-day, of the logs of that version against which tests check the formula; `None` if there
    /// are no logs.
    pub logged: Option<&'static str>,
    /// The ways to set a spring in the engine; empty if it has no spring.
    pub modes: &'static [JointMode],
}

/// The meaning of an engine's substeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Substeps {
    /// Substeps that the engine makes in a tick.
    Own,
    /// Position iterations of the engine's solver.
    Iterations,
    /// Whole ticks that the caller makes, by this line of code. In the line, `{n}` is their number per tick, and `{hz}`
    /// is their number per second.
    Ticks(&'static str),
}

impl Engine {
    /// Whether the engine itself divides a tick.
    pub fn has_substeps(&self) -> bool {
        !matches!(self.substeps, Substeps::Ticks(_))
    }

    /// Returns lines of code that explain `n` substeps at this rate in hertz; `None` if no explanation is needed.
    pub fn substeps_code(&self, n: u32, tick_hz: f64) -> Option<String> {
        match self.substeps {
            Substeps::Own => None,
            Substeps::Iterations => Some(format!("// {n} position iterations")),
            Substeps::Ticks(_) if n == 1 => None,
            Substeps::Ticks(line) => {
                let hz = f64::from(n) * tick_hz;
                Some(line.replace("{n}", &n.to_string()).replace("{hz}", &hz.to_string()))
            }
        }
    }

    /// Returns the version and the log date that the formula was checked against, in words; `None` for a held force.
    pub fn checked_against(&self) -> Option<String> {
        match (self.version, self.logged) {
            ("", _) => None,
            (version, Some(day)) => Some(format!("held against version {version} on {day}")),
            (version, None) => Some(format!("read from version {version}, held against no log")),
        }
    }
}

/// The part of a card that only a follower has. It is the setting by which a game sets the follower's speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowerSetting {
    /// The name of the setting in the game's code.
    pub name: &'static str,
    /// The quantity of the setting.
    pub quantity: FollowerQuantity,
    /// A line of code, with braces in place of the value.
    pub code: &'static str,
}

/// The quantity of a follower's setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FollowerQuantity {
    /// The rate k or ω of the law, per second.
    Rate,
    /// The fraction of the remaining way covered in each frame.
    Part,
    /// The smoothing time 2/ω, in seconds.
    SmoothTime,
}

impl FollowerSetting {
    /// Returns the setting of a law's rate, with this line of code.
    pub(super) const fn rate(code: &'static str) -> Self {
        Self { name: "rate", quantity: FollowerQuantity::Rate, code }
    }
}

/// The damping ratios of [`Method::damped_limits`].
pub const DAMPING_RATIOS: [f64; 3] = [0.05, 0.2, 1.0];

/// The card of a method, which has its claims. `tests/library/conformance` measures every field.
#[derive(Debug)]
pub struct Method {
    /// Kebab-case name in scenes, on the command line and in the output.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// Alternative ids that people use for the method. An error about such an id names this method's id, and `regatta
    /// show` shows the method.
    pub also: &'static [&'static str],
    /// The behaviour of the method in one line, for people.
    pub about: &'static str,
    /// How the method can hurt a game that takes it, beyond the numbers of this card; empty if in no way.
    pub caveat: &'static str,
    /// The family, which tells how the method works.
    pub family: Family,
    /// The formula, line by line; ′ marks values at the end of the step. `tests/library/formulas` documents the
    /// notation, and evaluates every formula beside the method.
    pub formula: &'static [&'static str],
    /// The weights `w` of the evaluations `k` in `y′ = y + h Σ w k`; empty if the method is no such sum.
    pub weights: &'static [f64],
    /// The source code of the method for other games, in the language of `assets/methods`; empty if there is none.
    pub code: &'static str,
    /// Global order of the error of the whole state if forces depend on position only; 0 if the error does not shrink
    /// with the step. In a listing as printed, `v` may be of higher order than `q`. The order of a follower is that
    /// while its target moves evenly and is not reached.
    pub order: u32,
    /// Global order if forces also depend on velocity.
    pub order_with_drag: u32,
    /// Evaluations of the acceleration per step, averaged over a long run; `None` if the method decides. A follower
    /// evaluates its target instead. A method with a [restart](Method::restart) needs one more evaluation at its first
    /// step, unless it is an engine.
    pub evaluations: Option<u32>,
    /// The cost of one evaluation and its share of the equations to solve, on a damped spring, in evaluations of a
    /// method that solves no equations. The cost is declared rather than measured, so that advice is the same on every
    /// machine.
    pub evaluation_cost: u32,
    /// Whether the method solves a linear system with constant coefficients to rounding, at any step. The orders on the
    /// card are then those on nonlinear systems.
    pub exact_if_linear: bool,
    /// Whether the one-step map conserves phase-space area on a system without drag.
    pub symplectic: bool,
    /// Whether a step of `-h` undoes a step of `h`, up to round-off.
    pub reversible: bool,
    /// The largest `h ω` at which the undamped oscillator stays bounded. It is `None` for implicit methods, and for
    /// methods that choose their own substeps. For a follower, it is the largest product of `h` and the rate at which
    /// the body stays near a still target. It is `None` if the body does so at any step.
    pub stability_limit: Option<f64>,
    /// The largest `h ω` at which the first step of an oscillator, damped by each of [`DAMPING_RATIOS`], does not grow.
    /// It is `None` as for the undamped limit. The memory of a method may lower this limit in a long run.
    pub damped_limits: Option<[f64; 3]>,
    /// The maximum number of derivative matrices that the method keeps for a system of few coordinates. It bounds the
    /// memory of the method.
    pub matrices: u32,
    /// The default tolerance of a substep of an adaptive method.
    pub tolerance: Option<Tolerance>,
    /// How a method with memory starts; `None` if the method has no memory. It starts at the beginning, after a kick, a
    /// switch or a change of step, and if its state is not the one that it returned.
    pub restart: Option<&'static str>,
    /// Whether a step of `h` always advances by `h`. Otherwise [`lost_time`](super::Integrator::lost_time) reports the
    /// time that is left out, or an interface has a clock of its own.
    pub keeps_time: bool,
    /// The bodies that the method steps; `None` if it steps every body.
    pub only: Option<Only>,
    /// Whether a person's own lines of the method turn a body at a floor at 0.
    pub has_own_floor: bool,
    /// The number of substeps of a lane that sets none.
    pub default_substeps: u32,
    /// The engine whose tick the method reproduces; `None` for any other method.
    pub engine: Option<Engine>,
    /// How a game sets the speed of a follower; `None` for any other method.
    pub follower: Option<FollowerSetting>,
    /// The publication of the method. For an engine, it is the version and the files from which the formula was read.
    pub source: &'static str,
    /// Builds a custom method, which is not in [`METHODS`](super::METHODS), by
    /// [`custom_integrator`](super::custom_integrator) of the method's type, or by a person's own lines. `None` for
    /// methods of the table.
    pub custom: Option<&'static dyn BuildIntegrator>,
}

impl Method {
    /// Returns the reason why the method steps no body of this class; `None` if it may step one. The order of a law is
    /// checked elsewhere.
    pub const fn incompatibility(&self, class: BodyClass) -> Option<&'static str> {
        match (&self.only, class, &self.engine) {
            (None, ..)
            | (_, BodyClass::Spin, Some(Engine { free_spin: Some(_), .. }))
            | (_, BodyClass::Ball(_), Some(Engine { bounce: Some(_), .. })) => None,
            (
                Some(Only {
                    needs: Needs::Force | Needs::Engine | Needs::EngineWithoutJoint, ..
                }),
                BodyClass::Spin,
                None,
            ) => Some(NO_TURN),
            (Some(only), ..) => only.incompatibility(class),
        }
    }

    /// Returns the engine's own rule for the bounces of a ball; `None` if it has none that is known.
    pub fn bounce(&self) -> Option<EngineBounce> {
        self.engine?.bounce
    }

    /// Whether the method steps a free rotation in space and nothing else.
    pub fn is_for_spin(&self) -> bool {
        self.family == Family::Gyro
    }

    /// Returns the accepted spellings of the method, each with the id. They are the id, the name and the
    /// [others](Method::also).
    pub fn spellings(&'static self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let spellings = [self.id, self.name].into_iter().chain(self.also.iter().copied());
        spellings.map(|spelling| (spelling, self.id))
    }

    /// Whether the method is [custom](Method::custom), and not in the table.
    pub fn is_from_outside(&self) -> bool {
        self.custom.is_some()
    }

    /// Returns the text of a method or a rule made of a person's own lines; `None` for any other.
    pub fn own_text(&self) -> Option<&'static str> {
        self.custom?.text()
    }

    /// Returns the frame rate for which a rule was written; `None` for a method.
    pub fn rule_fps(&self) -> Option<TickRate> {
        self.custom?.fps()
    }

    /// Whether this is a published listing with its faults, which advice never recommends.
    pub fn is_as_printed(&self) -> bool {
        self.family == Family::AsPrinted
    }

    /// Whether a game could implement the method. Methods of libraries, listings as printed and rules run only where a
    /// scene or a command names them.
    pub fn is_for_games(&self) -> bool {
        !self.is_of_library() && !self.is_as_printed() && self.rule_fps().is_none()
    }

    /// Returns an upper bound on how many numbers the method keeps on the heap besides its own vectors, for `n`
    /// coordinates with this coupling.
    pub(crate) fn numbers_kept(&self, n: usize, coupling: Coupling) -> usize {
        if let Some(custom) = self.custom {
            return custom.numbers_kept(n);
        }
        let matrices = self.matrices as usize;
        match coupling.reach(n) {
            // The exponential of a small matrix is a full matrix.
            Some(_) if self.family == Family::Linearised && n <= 32 => matrices * (n + 2) * (n + 2),
            // The band of the factored matrix is one and a half times as wide as the band of the matrix.
            Some(reach) => matrices * (n + 2) * (n + 2).min(3 * reach + 2),
            // These are the vectors of an iteration, for at most two stages.
            None => 12 * (n + 3) * matrices.min(2),
        }
    }

    /// Returns the number of evaluations of the acceleration per tick of `substeps` substeps, averaged over a long run;
    /// `None` if the method decides. An engine that makes its own substeps reads the force once a tick.
    pub fn evaluations_per_tick(&self, substeps: u32) -> Option<u32> {
        let reads_once = self.engine.is_some_and(|engine| engine.has_substeps());
        Some(self.evaluations? * if reads_once { 1 } else { substeps })
    }

    /// Returns the order of the law by which a body must follow its target; `None` if the method is no follower.
    pub fn law_order(&self) -> Option<u32> {
        match self.only?.needs {
            Needs::Law { order } => Some(order),
            _ => None,
        }
    }

    /// Whether the method reproduces a physics engine.
    pub fn is_engine(&self) -> bool {
        self.family == Family::Engine
    }

    /// Whether the method reproduces a library, which is an engine or an interface. Such a method runs only on request.
    pub fn is_of_library(&self) -> bool {
        self.is_engine() || self.family == Family::Interface
    }

    /// Whether the method holds the whole force of any body for a tick, as user code in an engine does. A spring is
    /// then no joint.
    pub fn holds_force(&self) -> bool {
        self.only.is_some_and(|only| only.needs == Needs::Force)
    }

    /// Whether the method is an engine in which springs are joints, rather than forces of user code.
    pub fn has_joint(&self) -> bool {
        !self.holds_force() && self.engine.is_some_and(|engine| !engine.modes.is_empty())
    }
}

impl PartialEq for Method {
    /// Compares ids, which are unique except for methods made of a person's own lines.
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
            && self.own_text() == other.own_text()
            && self.rule_fps() == other.rule_fps()
    }
}

/// A step rule with a card.
pub trait Carded {
    /// The card of the method.
    const CARD: &'static Method;
}

/// The common defaults of a method that conserves nothing, has no memory and does not control its step size.
const PLAIN: Method = Method {
    id: "",
    name: "",
    also: &[],
    about: "",
    caveat: "",
    family: Family::Explicit,
    formula: &[],
    weights: &[],
    code: "",
    order: 0,
    order_with_drag: 0,
    evaluations: None,
    evaluation_cost: 1,
    exact_if_linear: false,
    symplectic: false,
    reversible: false,
    stability_limit: None,
    damped_limits: None,
    matrices: 0,
    tolerance: None,
    restart: None,
    keeps_time: true,
    only: None,
    has_own_floor: false,
    default_substeps: 1,
    engine: None,
    follower: None,
    source: "",
    custom: None,
};

/// The [caveat](Method::caveat) of explicit methods of order 2. With one step, a swing grows by `|1 + i z - z²/2|`.
pub(super) const SLOW_GROWTH: &str = "a stiff spring and a long run show the growth: without damping the energy rises by \
                                      (h ω)⁴ / 4 a step or more";

/// The [caveat](Method::caveat) of implicit methods that damp by their error.
pub(super) const DAMPS_BY_RATE: &str = "the damping that it adds is its error and depends on the step, so that another \
                                        tick rate is another feel";

/// The [caveat](Method::caveat) of implicit methods that keep the energy of springs.
pub(super) const RINGS_ON: &str = "a jolt on a spring that is stiff for the step rings on for long, even if damped; tr-bdf2 \
                                   and bdf2 take it out";

/// The [caveat](Method::caveat) of compositions with negative pieces.
pub(super) const STEPS_BACK: &str = "pieces of a step run backwards: look for contacts and events between steps alone; and \
                                     keep the step fixed, or the energy has no bound";

/// An explicit method, with which an undamped oscillator grows at every step.
pub(super) const EXPLICIT: Method =
    Method { family: Family::Explicit, stability_limit: Some(0.0), ..PLAIN };

/// A symplectic method. The limit is that of one kick and one drift per step.
pub(super) const SYMPLECTIC: Method = Method {
    family: Family::Symplectic,
    caveat: "keep the step fixed: steps of changing length leave the energy without a bound",
    symplectic: true,
    reversible: true,
    stability_limit: Some(2.0),
    ..PLAIN
};

/// An adaptive method, whose card sets a tolerance.
pub(super) const ADAPTIVE: Method = Method {
    family: Family::Adaptive,
    caveat: "the work of a tick depends on the motion, so leave room for a hard one; the length of the next substep is \
             state, so save it and roll it back with x and v",
    restart: Some("by trying the whole tick as one step"),
    ..PLAIN
};

/// An implicit method.
pub(super) const IMPLICIT: Method =
    Method { family: Family::Implicit, evaluation_cost: 4, matrices: 1, ..PLAIN };

/// A method that differentiates the acceleration, by one or two evaluations per coordinate.
pub(super) const LINEARISED: Method = Method {
    family: Family::Linearised,
    caveat: "the slopes of the force are those at the start of the step, which is blind to a contact or a corner within \
             it",
    evaluation_cost: 2,
    matrices: 1,
    ..PLAIN
};

/// A listing of the chapter. If forces depend on position only, every listing is semi-implicit Euler.
pub(super) const AS_PRINTED: Method = Method {
    family: Family::AsPrinted,
    caveat: "a listing with its faults, here to be recognised and not to be copied",
    symplectic: true,
    stability_limit: Some(2.0),
    ..PLAIN
};

/// A first-order follower, whose distance from a still target only shrinks.
pub(super) const FIRST_ORDER_FOLLOWER: Method = Method {
    family: Family::Follower,
    order: 1,
    order_with_drag: 1,
    evaluations: Some(1),
    only: Some(Only {
        needs: Needs::Law { order: 1 },
        reason: "it moves straight towards a target, so it steps only a body of order 1 with a target, such as \
                 `follow`",
    }),
    ..PLAIN
};

/// A second-order follower, whose distance from a still target only shrinks.
pub(super) const SECOND_ORDER_FOLLOWER: Method = Method {
    only: Some(Only {
        needs: Needs::Law { order: 2 },
        reason: "it moves towards a target with its own velocity, so it steps only a body of order 2 with a target, \
                 such as `follow`",
    }),
    ..FIRST_ORDER_FOLLOWER
};

/// A tick of an engine, which reads the force once.
pub(super) const ENGINE: Method = Method {
    family: Family::Engine,
    order: 1,
    order_with_drag: 1,
    evaluations: Some(1),
    only: Some(Only {
        needs: Needs::Engine,
        reason: "an engine takes one body's spring, its drag and the force on it, and nothing else",
    }),
    ..PLAIN
};

/// An engine at 60 Hz that has no spring, and whose bounces and free rotations are not reproduced.
pub(super) const BARE: Engine = Engine {
    tick_hz: 60,
    damping_ratio: None,
    substeps: Substeps::Own,
    bounce: None,
    free_spin: None,
    version: "",
    logged: None,
    modes: &[],
};

/// A step of a free rotation in space, which reads the moments once.
pub(super) const GYRO: Method = Method {
    family: Family::Gyro,
    evaluations: Some(1),
    only: Some(Only {
        needs: Needs::Spin,
        reason: "it turns a rigid body, so it steps only one that turns in space, such as `tumble`",
    }),
    ..PLAIN
};

/// A frame of an interface's spring, which reads the force once. The target is where the spring balances the force.
pub(super) const INTERFACE: Method = Method {
    family: Family::Interface,
    keeps_time: false,
    only: Some(Only {
        needs: Needs::Joint,
        reason: "an interface's spring steps only a spring with a stiffness",
    }),
    ..ENGINE
};
