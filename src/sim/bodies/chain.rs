//! Equal masses in a row, joined to each other and to a wall at each end by equal springs with dash-pots.
//!
//! Each dash-pot is parallel to a spring. The damping matrix is then proportional to the stiffness matrix, so that the
//! normal modes stay uncoupled and the motion has a closed form. The damping of a mode grows with the square of its
//! frequency, so that one chain can have modes that oscillate and modes that are overdamped.

use std::f64::consts::PI;

use super::oscillator;
use super::prelude::*;

/// The maximum number of masses. More could not be distinguished on a wide stage. The closed form needs about the
/// square of this number of multiplications per tick.
const MAX_MASSES: u32 = 256;

pub(super) fn kind() -> Kind {
    Kind {
    id: "chain",
    about: "m xᵢ″ = Σ k (xⱼ - xᵢ) + c (xⱼ - xᵢ)′, j = i ± 1: masses joined by springs between two walls".into(),
    all_coordinates: (1..=MAX_MASSES)
        .map(|n| Coordinate::new(format!("x{n}"), format!("v{n}"), "m"))
        .collect::<Vec<_>>()
        .into(),
    is_counted: true,
    leading: "stiffness_n_per_m".into(),
    check: Box::new(|values| match values {
        [masses, .., plucked, _, _] if plucked > masses => Err(Fault {
            key: "plucked_mass".into(),
            what: format!("`plucked_mass` is {plucked}, of {masses} masses"),
            remedy: format!("write a whole number from 1 to {masses}, or more `masses`"),
        }),
        _ => Ok(()),
    }),
        ..Kind::of(Chain::default())
    }
}

type Of = ParameterOf<Chain>;

const PARAMETERS: [Of; 7] = [
    Of::count("masses", MAX_MASSES, |chain| &mut chain.masses)
        .or(8.0)
        .about("the number of masses"),
    Of::number("mass_kg", Range::POSITIVE, |chain| &mut chain.mass).symbol("m").about("each mass"),
    Of::number("stiffness_n_per_m", Range::POSITIVE, |chain| &mut chain.stiffness)
        .symbol("k")
        .about("the stiffness of each spring: force per metre of stretch"),
    Of::number("damping_n_s_per_m", Range::NON_NEGATIVE, |chain| &mut chain.damping)
        .or(0.0)
        .symbol("c")
        .about("the damping coefficient of each spring: force per metre per second of stretching"),
    Of::count("plucked_mass", MAX_MASSES, |chain| &mut chain.plucked)
        .or(1.0)
        .about("the mass that is held aside at the start, and that a kick hits"),
    Of::start("x0_m", 1.0, |chain| &mut chain.x0)
        .named("pull at start")
        .about("how far aside it is held; the others are in line between it and the walls"),
    Of::number("kick_n_s", Range::ANY, |chain| &mut chain.kick)
        .or(3.0)
        .about("the impulse of one kick"),
];

/// A chain of masses. Its coordinates are the displacements of the masses, in metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chain {
    /// Number of masses.
    masses: usize,
    /// m, each mass, in kilograms.
    mass: f64,
    /// k, the stiffness of each spring, in newtons per metre.
    stiffness: f64,
    /// c, the damping of each dash-pot, in N·s/m.
    damping: f64,
    /// The number of the mass that is plucked and kicked, counted from 1.
    plucked: usize,
    /// Displacement of the plucked mass at the start, in metres.
    x0: f64,
    /// The impulse of one kick, in newton seconds.
    kick: f64,
    /// `sin(π i / (N + 1))` for i from 0 to 2 N + 1. The displacement of mass j in mode n is the entry with index j n,
    /// modulo the number of entries.
    sines: Vec<f64>,
}

/// Half the distance between the walls, in units of the amplitude.
const HALF_LENGTH: f64 = 2.4;

impl Chain {
    /// Returns the undamped angular frequency of mode `n`, counted from 1, in radians per second.
    pub fn angular_frequency(&self, n: usize) -> f64 {
        let half = PI * n as f64 / (2 * (self.masses + 1)) as f64;
        2.0 * (self.stiffness / self.mass).sqrt() * libm::sin(half)
    }

    /// Returns the displacement of each mass in mode `n`, counted from 1, at amplitude 1.
    fn shape(&self, n: usize) -> impl Iterator<Item = f64> {
        let mut i = 0;
        (0..self.masses).map(move |_| {
            i += n;
            if i >= self.sines.len() {
                i -= self.sines.len();
            }
            self.sines[i]
        })
    }

    /// Returns the magnitude of the initial displacement of the plucked mass, in metres; 1 if the displacement is 0.
    pub fn amplitude(&self) -> f64 {
        if self.x0 == 0.0 { 1.0 } else { self.x0.abs() }
    }

    /// Returns the position in metres of mass `j`, counted from 1, if its displacement is `x`. The chain lies along the
    /// x axis, and displacements are across the chain. `j` = 0 and `j` = masses + 1 are the walls.
    pub fn place_of(&self, j: usize, x: f64) -> DVec2 {
        let part = j as f64 / (self.masses + 1) as f64;
        DVec2::new((2.0 * part - 1.0) * HALF_LENGTH * self.amplitude(), x)
    }
}

impl System for Chain {
    type Vector = Vec<f64>;

    fn coupling(&self) -> Coupling {
        Coupling::Band(1)
    }

    #[inline]
    fn acceleration(&self, _t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        let (k, c) = (self.stiffness / self.mass, self.damping / self.mass);
        // These are k q + c v of the mass to the left, of this mass and of the mass to the right. The walls are at
        // rest.
        let mut left = 0.0;
        let mut here = k * q[0] + c * v[0];
        let last = q.len() - 1;
        for ((a, q), v) in a.iter_mut().zip(&q[1..]).zip(&v[1..]) {
            let right = k * q + c * v;
            *a = left - 2.0 * here + right;
            left = here;
            here = right;
        }
        a[last] = left - 2.0 * here;
    }
}

impl Body for Chain {
    const CLASS: BodyClass = BodyClass::NoEngine(
        "an engine solves a chain joint by joint in sweeps, and its formula here models one joint alone",
    );
    const HAS_EXACT: bool = true;
    const PARAMETERS: &'static [Of] = &PARAMETERS;

    fn prepare(&mut self) {
        let (masses, plucked) = (self.masses, self.plucked);
        assert!((1..=masses).contains(&plucked), "mass {plucked} of {masses}");
        let sine = |i: usize| libm::sin(PI * i as f64 / (masses + 1) as f64);
        // The sines are mirrored, so that sines equal by symmetry are equal to the bit.
        let quarter = |i: usize| sine(i.min(masses + 1 - i));
        let half = (0..=masses).map(quarter);
        self.sines = half.clone().chain(half.map(|sine| -sine)).collect();
    }

    fn start(&self) -> State<Vec<f64>> {
        let (held, walls) = (self.plucked as f64, (self.masses + 1) as f64);
        let aside = |j: usize| {
            let j = j as f64;
            self.x0 * if j <= held { j / held } else { (walls - j) / (walls - held) }
        };
        State { q: (1..=self.masses).map(aside).collect(), v: vec![0.0; self.masses] }
    }

    fn exact_into(&self, _t: f64, dt: f64, from: &State<Vec<f64>>, to: &mut State<Vec<f64>>) {
        to.q.fill(0.0);
        to.v.fill(0.0);
        let norm = 2.0 / (self.masses + 1) as f64;
        for n in 1..=self.masses {
            let mut mode = State { q: 0.0, v: 0.0 };
            for ((q, v), shape) in from.q.iter().zip(&from.v).zip(self.shape(n)) {
                mode.q += norm * shape * q;
                mode.v += norm * shape * v;
            }
            let omega = self.angular_frequency(n);
            let alpha = self.damping / self.stiffness * omega * omega / 2.0;
            let mode = oscillator::flow(omega * omega, alpha, dt, &mode);
            for ((q, v), shape) in to.q.iter_mut().zip(&mut to.v).zip(self.shape(n)) {
                *q += shape * mode.q;
                *v += shape * mode.v;
            }
        }
    }

    fn exact_error(
        &self,
        _t: f64,
        dt: f64,
        from: &State<Vec<f64>>,
        _to: &State<Vec<f64>>,
    ) -> [f64; 2] {
        let norm = 2.0 / (self.masses + 1) as f64;
        let mut sum = [0.0; 2];
        for n in 1..=self.masses {
            // The sums are of magnitudes, which bound the rounding even if the terms cancel.
            let mut mode = State { q: 0.0, v: 0.0 };
            for ((q, v), shape) in from.q.iter().zip(&from.v).zip(self.shape(n)) {
                mode.q += norm * (shape * q).abs();
                mode.v += norm * (shape * v).abs();
            }
            let omega = self.angular_frequency(n);
            let alpha = self.damping / self.stiffness * omega * omega / 2.0;
            let [q, v] = oscillator::flow_error(omega * omega, alpha, dt, &mode);
            sum = [sum[0] + q, sum[1] + v];
        }
        sum
    }

    fn is_linear(&self) -> bool {
        true
    }

    fn energy(&self, state: &State<Vec<f64>>) -> Option<f64> {
        let kinetic = self.kinetic_energy(state)?;
        let mut last = 0.0;
        let mut potential = 0.0;
        for &q in state.q.iter().chain([&0.0]) {
            potential += self.stiffness * (q - last) * (q - last);
            last = q;
        }
        Some(kinetic + potential / 2.0)
    }

    fn kinetic_energy(&self, state: &State<Vec<f64>>) -> Option<f64> {
        let twice: f64 = state.v.iter().map(|v| self.mass * v * v).sum();
        (self.damping == 0.0).then_some(twice / 2.0)
    }

    fn input(&mut self, input: Input, state: &mut State<Vec<f64>>) -> bool {
        let Input::Kick(times) = input else { return false };
        state.v[self.plucked - 1] += times * self.kick / self.mass;
        true
    }

    fn place(&self, q: &Vec<f64>) -> DVec2 {
        self.place_of(self.plucked, q[self.plucked - 1])
    }
}
