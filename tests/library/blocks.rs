//! Several bodies that are stepped together, a number of each in every vector: a method that treats each number by itself
//! gives each body the bits that it has alone, and no other method compiles for them.

use std::marker::PhantomData;

use regatta::sim::integrators::*;
use regatta::sim::{Elementwise, State, System};

const W: usize = 4;

/// A coordinate of each of several bodies.
#[derive(Clone, Debug, PartialEq)]
struct Block([f64; W]);

impl Elementwise for Block {
    fn assign(&mut self, from: &Self) {
        self.0 = from.0;
    }
    fn add_scaled(&mut self, h: f64, x: &Self) {
        for (number, x) in self.0.iter_mut().zip(x.0) {
            *number += h * x;
        }
    }
    fn scale(&mut self, h: f64) {
        self.0 = self.0.map(|number| number * h);
    }
}

/// A swing with drag, of its own frequency.
#[derive(Clone, Copy)]
struct Swing {
    omega_squared: f64,
}

impl System for Swing {
    type Vector = f64;

    fn acceleration(&self, t: f64, q: &f64, v: &f64, a: &mut f64) {
        *a = libm::sin(3.0 * t) - self.omega_squared * libm::sin(*q) - 0.1 * v * v.abs();
    }
}

/// Swings stepped together.
struct Swings([Swing; W]);

impl System for Swings {
    type Vector = Block;

    fn acceleration(&self, t: f64, q: &Block, v: &Block, a: &mut Block) {
        for (i, swing) in self.0.iter().enumerate() {
            swing.acceleration(t, &q.0[i], &v.0[i], &mut a.0[i]);
        }
    }
}

/// The bits of the state after steps of two lengths.
fn course<S: System, I: Integrator<S>>(system: &S, from: [S::Vector; 2]) -> State<S::Vector> {
    let [q, v] = from;
    let (mut method, mut state, mut t) = (I::new(&q), State { q, v }, 0.0);
    for (h, steps) in [(1.0 / 32.0, 20), (1.0 / 64.0, 20)] {
        for _ in 0..steps {
            method.step(system, t, h, &mut state).unwrap();
            t += h;
        }
    }
    state
}

const SWINGS: [Swing; W] = [
    Swing { omega_squared: 1.0 },
    Swing { omega_squared: 40.0 },
    Swing { omega_squared: 9.0 },
    Swing { omega_squared: 0.1 },
];
const STARTS: [[f64; W]; 2] = [[1.0, -0.5, 3.0, 0.0], [0.0, 10.0, -2.0, 0.3]];

fn has_the_bits_of_one<B: Integrator<Swings>, I: Integrator<Swing>>(name: &str) {
    let together = course::<_, B>(&Swings(SWINGS), STARTS.map(Block));
    for (i, swing) in SWINGS.iter().enumerate() {
        let alone = course::<_, I>(swing, STARTS.map(|start| start[i]));
        let bits = |q: f64, v: f64| [q.to_bits(), v.to_bits()];
        assert_eq!(
            bits(together.q.0[i], together.v.0[i]),
            bits(alone.q, alone.v),
            "{name}, body {i}"
        );
        assert!(alone.q.is_finite() && alone.q != STARTS[0][i], "{name}, body {i}");
    }
}

macro_rules! with_each {
    ($check:ident: $($Type:ident),+ $(,)?) => { $($check!($Type);)+ };
}

#[test]
fn bodies_stepped_together_match_lone_bodies_to_the_bit() {
    macro_rules! check {
        ($Type:ident) => {
            has_the_bits_of_one::<$Type<Block>, $Type<f64>>(stringify!($Type));
        };
    }
    with_each! { check:
        ExplicitEuler, Midpoint, ImprovedEuler, SspRk3, Rk4, AdamsBashforth2,
        SemiImplicitEuler, VelocityVerlet, PositionVerlet, StormerVerlet, Yoshida4, Pefrl,
        ImprovedEulerAsPrinted, Rk4AsPrinted, JakobsenVerlet,
    }
}

/// Whether a method steps bodies together: the answer of a type that does hides that of the trait.
struct Steps<I>(PhantomData<I>);

impl<I: Integrator<Swings>> Steps<I> {
    fn together() -> bool {
        true
    }
}

trait OneByOne {
    fn together() -> bool {
        false
    }
}

impl<I> OneByOne for Steps<I> {}

#[test]
fn a_method_that_couples_components_steps_no_bodies_together() {
    macro_rules! check {
        ($Type:ident) => {
            assert!(!Steps::<$Type<Block>>::together(), stringify!($Type));
        };
    }
    // The norm of an error, or of a difference.
    with_each! { check: AdaptiveEuler, BogackiShampine32, DormandPrince54, AdaptiveEulerAsPrinted }
    // Equations of all components.
    with_each! { check:
        ImplicitEuler, ImplicitMidpoint, Newmark, Bdf2, GaussLegendre4, TrBdf2, LinearlyImplicitEuler,
        SemiImplicitEulerImplicitDrag, VerletExactDrag, ExponentialRosenbrockEuler,
    }
    macro_rules! check_rule {
        ($Rule:ident) => {
            assert!(!Steps::<Follower<Block, $Rule>>::together(), stringify!($Rule));
            assert!(!Steps::<EngineMethod<Block, $Rule>>::together(), stringify!($Rule));
        };
    }
    // The rate of a body, and its speed limit.
    with_each! { check_rule: LerpDt, SmoothDamp, Box2d, Rapier, Jolt, Pybullet, Mujoco, HeldForce }
    assert!(Steps::<Rk4<Block>>::together());
}
