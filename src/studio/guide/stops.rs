//! The stops of the guide, in the order of the chapter.

use super::{Goal, Stop};
use crate::instrument::Instrument;
use crate::key::Key;
use crate::run::past::Quantity;
use crate::run::race::{Interpolation, Mode};

/// Values that the stops about a ship share.
const SHIP: Stop = Stop {
    title: "",
    scene: "ship",
    method: "explicit-euler",
    tick_hz: 2,
    mode: Mode::Solo,
    instrument: Instrument::Error,
    quantity: Quantity::Velocity,
    question: "",
    choices: &[],
    right: 0,
    task: "",
    keys: &[],
    goal: Goal::Paused,
    answer: "",
};

/// Values that the stops about a spring share.
const SPRING: Stop = Stop {
    scene: "spring",
    tick_hz: 60,
    instrument: Instrument::Motion,
    quantity: Quantity::Position,
    ..SHIP
};

/// Every stop of the guide, in order.
pub static STOPS: &[Stop] = &[
    Stop {
        title: "An equation of motion",
        method: "rk4",
        tick_hz: 10,
        instrument: Instrument::Motion,
        question: "The propeller pushes with 20 kN. The water holds back with 1 kN for each m/s. What speed does the ship reach?",
        choices: &["ever more", "20 m/s", "10 m/s"],
        right: 1,
        task: "Press `=` to let time run faster.",
        keys: &[Key::Sign('=')],
        goal: Goal::SpeedFrom(200),
        answer: "At 20 m/s thrust and drag are in balance. The exact speed is 20 m/s less a part that shrinks by a factor e every 10 s: that is the white ghost.",
        ..SHIP
    },
    Stop {
        title: "Euler's method",
        instrument: Instrument::Motion,
        question: "Euler's method takes the force at the start of each step for the whole step. The drag grows during the step. Will this ship be too fast or too slow?",
        choices: &["too fast", "too slow", "exact"],
        right: 0,
        task: "Let it run for some seconds, then press `Space` to pause.",
        keys: &[Key::Space],
        goal: Goal::Paused,
        answer: "Too fast: it misses the drag that builds up within a step. After 8.5 s it makes 11.64 m/s instead of 11.45, an error of 1.6 %: the chapter's Table 7-1. It is still behind the ghost, because it stands still in its first step.",
        ..SHIP
    },
    Stop {
        title: "What a step does",
        tick_hz: 10,
        instrument: Instrument::OneStep,
        question: "Position across, velocity up: a spring is a point in this plane, and its exact motion is the white curve. Euler's method follows the slope at the start for a whole tick. Where does it land?",
        choices: &["on the curve", "outside it", "inside it"],
        right: 1,
        task: "Press `.` for one tick, and twice more. The plot shows the next one.",
        keys: &[Key::Sign('.'); 3],
        goal: Goal::SteppedTo(3),
        answer: "Outside, every time: the slope is a tangent, and a tangent leaves the curve on its outer side. The next tick starts from there, so that at 10 Hz each makes the swing 18 % wider.",
        ..SPRING
    },
    Stop {
        title: "Step size and truncation error",
        question: "Now with 5 ticks per second instead of 2: steps that are 2.5 times shorter. How much smaller does the error of the speed get?",
        choices: &["not at all", "about 2.5 times", "about 6 times"],
        right: 1,
        task: "Press `]` for the next tick rate, and `Home` to start again.",
        keys: &[Key::Sign(']'), Key::Home],
        goal: Goal::TickHzFrom(5),
        answer: "About 2.5 times. Each step drops terms of size h², but there are more steps to add up: over a given time the error is proportional to h. Euler's method has order 1.",
        ..SHIP
    },
    Stop {
        title: "Two kinds of instability",
        scene: "surge",
        tick_hz: 1,
        instrument: Instrument::Motion,
        question: "Three lighter ships at 1 tick per second. Each step overshoots 20 m/s. Under two of them the speed never settles. Is the method wrong, or the step?",
        choices: &["the method", "the step"],
        right: 1,
        task: "Press `]` for 2 ticks per second.",
        keys: &[Key::Sign(']')],
        goal: Goal::TickHzFrom(2),
        answer: "The step. At h C/m = 2 the speed swings for ever, and above it swings wider and wider. At half the step all three ships settle at 20 m/s.",
        ..SHIP
    },
    Stop {
        title: "Adaptive step size",
        instrument: Instrument::Cost,
        question: "Take a step once whole and once in two halves: the difference estimates the error, and the step follows from it. What does that do to the cost?",
        choices: &["it saves work", "it costs more, and is more accurate"],
        right: 1,
        task: "Press `5` for adaptive Euler, and `Home`. Watch error and cost in the table.",
        keys: &[Key::Digit(5), Key::Home],
        goal: Goal::Method("adaptive-euler"),
        answer: "Here it costs more than plain Euler, and keeps the error that was asked for. It is a guard for accuracy. It does not cure a method that is unstable at every step.",
        ..SHIP
    },
    Stop {
        title: "Improved Euler",
        question: "Take the force at the start and at the end of the step, and go with the average. That is two evaluations. How much smaller does the error get?",
        choices: &["2 times", "about 60 times"],
        right: 1,
        task: "Press `3` for improved Euler, and `Home` to start again.",
        keys: &[Key::Digit(3), Key::Home],
        goal: Goal::Method("improved-euler"),
        answer: "About 60 times: 0.03 % of the speed instead of 1.6 %, for twice the work. The error is now proportional to h²: order 2.",
        ..SHIP
    },
    Stop {
        title: "Runge-Kutta",
        method: "improved-euler",
        question: "Four evaluations, weighted 1 2 2 1. The error was 0.03 %. What is it now?",
        choices: &["0.01 %", "0.0003 %", "less than 0.00001 %"],
        right: 2,
        task: "Press `4` for Runge-Kutta, and `Home` to start again.",
        keys: &[Key::Digit(4), Key::Home],
        goal: Goal::Method("rk4"),
        answer: "About 0.000004 %: thousands of times less than improved Euler, for twice its work. The error is proportional to h⁴. The usual first choice.",
        ..SHIP
    },
    Stop {
        title: "Which one is good enough?",
        method: "rk4",
        question: "All methods on the same ship. Which is the cheapest that stays within 1 %?",
        choices: &["Runge-Kutta", "improved Euler", "explicit Euler"],
        right: 1,
        task: "Press `C` to race them, and click the head of the verdict to sort the table.",
        keys: &[Key::Sign('c')],
        goal: Goal::Race,
        answer: "Improved Euler, for two evaluations per tick. The chapter's advice: where two methods agree, take the cheaper one.",
        ..SHIP
    },
    Stop {
        title: "The spring that Euler blows up",
        question: "An undamped spring should swing for ever between its marks. Explicit Euler adds energy in every step. Does a higher tick rate cure it?",
        choices: &["yes", "no, it only takes longer"],
        right: 1,
        task: "Press `]` for 100 ticks per second, and `Home` to start again.",
        keys: &[Key::Sign(']'), Key::Home],
        goal: Goal::TickHzFrom(100),
        answer: "It only takes longer. Explicit Euler multiplies the amplitude by √(1 + h²ω²) in every step, which is above 1 for every h. This is the chapter's Figure 7-5.",
        ..SPRING
    },
    Stop {
        title: "The same lines in another order",
        question: "Update the velocity first, then move with the new velocity. The cost is the same. What happens to the swing?",
        choices: &["it still grows", "it dies away", "it stays bounded"],
        right: 2,
        task: "Press `2` for semi-implicit Euler, and `Home` to start again.",
        keys: &[Key::Digit(2), Key::Home],
        goal: Goal::Method("semi-implicit-euler"),
        answer: "It stays bounded, at the price of one evaluation per tick. The chapter prints these very lines as Euler's method. Its order is still 1: the swing is a little too fast.",
        ..SPRING
    },
    Stop {
        title: "Energy",
        method: "semi-implicit-euler",
        question: "Semi-implicit Euler keeps the swing within bounds. Does it also keep the energy?",
        choices: &["yes, exactly", "no, it drains away", "no, but it stays near it"],
        right: 2,
        task: "Press `D` twice, for the instrument Energy.",
        keys: &[Key::Sign('d'), Key::Sign('d')],
        goal: Goal::Instrument(Instrument::Energy),
        answer: "It stays near it: the total goes 5 % up and down twice in a swing, and never away. Such a method keeps another energy exactly, one that is close to the true one. Explicit Euler's climbs without end.",
        ..SPRING
    },
    Stop {
        title: "Phase portrait",
        scene: "pendulum",
        tick_hz: 500,
        instrument: Instrument::Phase,
        question: "Velocity against angle: a pendulum that swings draws a closed loop. This one is let go 20° from upright. What does explicit Euler draw?",
        choices: &[
            "the same loop for ever",
            "a loop that winds out and breaks open",
            "a loop that winds in",
        ],
        right: 1,
        task: "Look at it for some seconds. Then press `2` for semi-implicit Euler, and `Home`.",
        keys: &[Key::Digit(2), Key::Home],
        goal: Goal::Method("semi-implicit-euler"),
        answer: "It winds out: each half swing ends higher, and in the fourth, after 9.5 s, the pendulum goes over the top. A gain of energy turns a swing into a spin. At 60 ticks per second that happens in the first. Semi-implicit Euler's loop stays closed.",
        ..SPRING
    },
    Stop {
        title: "A cloud of starts",
        scene: "liouville",
        tick_hz: 12,
        instrument: Instrument::Cloud,
        question: "100 000 pendulums start from every point of a cat's head: angle across, velocity up. The true motion, in outline, bends the cat and keeps its area. What does explicit Euler do to the area?",
        choices: &["it keeps it", "it swells it", "it shrinks it"],
        right: 1,
        task: "Look at it for some seconds. Then press `3` for semi-implicit Euler, and `Home`.",
        keys: &[Key::Digit(3), Key::Home],
        goal: Goal::Method("semi-implicit-euler"),
        answer: "It swells it: by half in a good second, later to twice the area. Only what goes over the top shrinks again. Semi-implicit Euler bends the cat a little wrongly and keeps its area: so it neither gains energy nor loses any for long. Press `2`: implicit Euler shrinks it. `C` shows all four.",
        ..SPRING
    },
    Stop {
        title: "A stiff spring",
        scene: "stiff",
        method: "semi-implicit-euler",
        question: "This spring swings 16 times per second, and semi-implicit Euler is bounded at 60 ticks per second. Is it at 49?",
        choices: &["yes", "no"],
        right: 1,
        task: "Press `[` twice, for 49 ticks per second, and `Home` to start again.",
        keys: &[Key::Sign('['), Key::Sign('['), Key::Home],
        goal: Goal::TickHzTo(49),
        answer: "No: its limit is h ω = 2, between 50 and 49 ticks per second. Every explicit method has such a limit. Stiff springs and long frames are what makes games explode.",
        ..SPRING
    },
    Stop {
        title: "The stability map",
        scene: "stiff",
        method: "semi-implicit-euler",
        tick_hz: 30,
        instrument: Instrument::StabilityMap,
        question: "Tick rates across, stiffness up: a line is the limit of a method, which is bounded to the right of it. The cross is this spring. If it were 4 times as stiff, how many times the tick rate would it need?",
        choices: &["the same", "2 times", "4 times"],
        right: 1,
        task: "Press `]` twice, for 50 ticks per second, or drag the cross over the line, and `Home` to start again.",
        keys: &[Key::Sign(']'), Key::Sign(']'), Key::Home],
        goal: Goal::TickHzFrom(50),
        answer: "2 times: the limit is h ω = 2, and ω is proportional to the root of the stiffness. Explicit Euler has no line for a spring without damping: it is bounded nowhere.",
        ..SPRING
    },
    Stop {
        title: "Implicit methods",
        scene: "stiff",
        method: "implicit-euler",
        question: "Implicit Euler takes the force at the end of the step, and has to solve for it. What does it do to the stiff spring at 30 ticks per second, where semi-implicit Euler is lost?",
        choices: &["it blows up too", "it dies away", "it stays exact"],
        right: 1,
        task: "Press `[` three times, for 30 ticks per second, and `Home` to start again.",
        keys: &[Key::Sign('['), Key::Sign('['), Key::Sign('['), Key::Home],
        goal: Goal::TickHzTo(30),
        answer: "It never blows up, at any step. But it takes energy out, and the swing is gone within a second. Bounded is not accurate.",
        ..SPRING
    },
    Stop {
        title: "Round-off",
        method: "rk4",
        question: "A smaller step has a smaller truncation error. Does that go on for ever?",
        choices: &["yes", "no, rounding takes over"],
        right: 1,
        task: "Press `]` until there are 30 ticks per second, then `Home`, and look at the verdict.",
        keys: &[
            Key::Sign(']'),
            Key::Sign(']'),
            Key::Sign(']'),
            Key::Sign(']'),
            Key::Sign(']'),
            Key::Home,
        ],
        goal: Goal::TickHzFrom(30),
        answer: "The verdict says: within rounding. Every step rounds its sums: from 240 ticks per second on, more ticks take no error away. With 32-bit numbers that begins at far longer steps: the command regatta sweep draws it.",
        ..SHIP
    },
    Stop {
        title: "Ticks and frames",
        method: "rk4",
        tick_hz: 10,
        question: "The simulation makes 10 ticks per second, the screen more frames. What is drawn between two ticks is interpolated. How does it look without?",
        choices: &["the same", "it stutters"],
        right: 1,
        task: "Press `I` to draw the ticks as they are.",
        keys: &[Key::Sign('i')],
        goal: Goal::Interpolation(Interpolation::Raw),
        answer: "It stutters, though the numbers are the same. A game keeps a fixed tick, counts it in whole numbers, and interpolates. Press `I` twice for the smooth drawing.",
        ..SPRING
    },
    Stop {
        title: "The game loop",
        method: "rk4",
        question: "Now 60 ticks per second on a display of 60 Hz, under a method whose error nobody sees. But frames begin half a millisecond early or late. Is what the player sees smooth?",
        choices: &["yes", "no, it judders"],
        right: 1,
        task: "Press `L` for the loop lab: the same motion in several game loops, 8 times slower.",
        keys: &[Key::Sign('l')],
        goal: Goal::LoopLab,
        answer: "It judders: the fixed loop makes no tick in one frame and two in the next, and is off by 12 ms. The loop below it counts whole refreshes, and each frame shows its own moment.",
        ..SPRING
    },
    Stop {
        title: "Your engine",
        scene: "engines",
        method: "engine-box2d",
        question: "A spring of 1 Hz without damping, as a joint of Box2D, at 60 ticks per second and its own 4 substeps. Does it swing for ever?",
        choices: &["yes", "no, it dies away"],
        right: 1,
        task: "Press `C` to race nine engines.",
        keys: &[Key::Sign('c')],
        goal: Goal::Race,
        answer: "It dies away: the swing is halved in 4.2 s. A soft joint is an implicit spring and loses energy, fastest in Jolt and in the default solver of PhysX. Bullet, Chipmunk and MuJoCo keep it, and each treats the ship in a way of its own.",
        ..SPRING
    },
    Stop {
        title: "The same swing in every engine",
        scene: "alike",
        method: "engine-jolt",
        question: "A spring that should lose half its swing in 0.74 s. Jolt, Box2D and MuJoCo each add a different damping. How can all three be made to swing alike?",
        choices: &["with the same numbers", "with more substeps", "with other numbers in each"],
        right: 2,
        task: "Press `C` to race them, each set up twice: with the spring's own numbers, and with those of the command regatta port.",
        keys: &[Key::Sign('c')],
        goal: Goal::Race,
        answer: "Lanes 4 to 6 stay within 8 % of the white ghost. Jolt is set to a fifth of the damping, Box2D to three fifths and MuJoCo to all of it, and each adds the rest. Press `E` for a spring's numbers as in any engine, and copy a lane as lines of code.",
        ..SPRING
    },
    Stop {
        title: "Your own force in an engine",
        scene: "held-force",
        method: "held-force",
        question: "Now the game applies the force of the spring itself, once a tick, and the engine divides the tick into substeps. What do more substeps do?",
        choices: &["they make it more accurate", "nothing", "they add energy"],
        right: 2,
        task: "Press `C` to race 1, 4 and 8 substeps.",
        keys: &[Key::Sign('c')],
        goal: Goal::Race,
        answer: "They add energy: with 4 substeps the swing doubles in 6 s, with 8 sooner, and with 1 it stays. The force is held while the body moves on under it. Make the spring a joint, or apply the force in every substep.",
        ..SPRING
    },
    Stop {
        title: "A spinning coin",
        scene: "coin",
        method: "gyro-rescaled",
        instrument: Instrument::Polhode,
        question: "Bodies turn in space, too. A coin spins upright, tilted by 1.9°, under the step of Rapier and Avian. In truth it wobbles for ever. What does it do here?",
        choices: &["it wobbles for ever", "it comes to rest", "it tips over"],
        right: 2,
        task: "Press `C` to race it beside other steps.",
        keys: &[Key::Sign('c')],
        goal: Goal::Race,
        answer: "It tips over at 0.6 s, and has gained 96 % energy after 5 s: this step keeps the length of L, but L leaves its white curve, away from the axis of the spin. Bullet's step does not tip over; the step by rotation and split-3 stay on the curve.",
        ..SPRING
    },
];
