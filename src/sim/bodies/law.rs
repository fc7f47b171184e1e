//! A body whose equation of motion is written in a scene.

use std::cell::RefCell;
use std::sync::Arc;

use super::claims::{Checked, Claimant, FalseClaims};
use super::prelude::*;
use crate::body::{Distances, NO_BOUNDARIES, Piece};
use crate::impact::{SOFT_HZ, Wall};
use crate::law::{At, Equations, Layout, Registers};

mod claims;
mod copies;
mod kind;

pub use claims::check_law;
pub use kind::law_kind;

/// A body that moves by a law of a scene.
#[derive(Clone, Debug)]
pub struct Law {
    equations: Arc<Equations>,
    /// The values of [`law_kind`]'s parameters.
    values: Vec<f64>,
    /// Throttle and rudder, from -1 to 1.
    steering: [f64; 2],
    registers: RefCell<Registers>,
    /// Whether the walls are springs.
    is_soft: bool,
    checked: Checked,
}

impl Law {
    /// Returns a body with full throttle, the rudder amidships, and these values of [`law_kind`]'s parameters.
    ///
    /// # Panics
    /// If the number of values is wrong.
    pub fn new(equations: Arc<Equations>, values: &[f64]) -> Self {
        let text = equations.text();
        let most = text.constants.len() + 3 * text.coordinates.len();
        assert_eq!(values.len(), most, "a law is given a value for each parameter");
        let registers = Registers::new(&equations, known(&equations, values));
        Self {
            equations,
            values: values.into(),
            steering: [1.0, 0.0],
            registers: RefCell::new(registers),
            is_soft: false,
            checked: Checked::default(),
        }
    }

    /// Returns the law.
    pub fn equations(&self) -> &Arc<Equations> {
        &self.equations
    }

    /// Returns the present values of the body's parameters.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Returns the claims of the text that do not hold with the present parameters.
    pub fn false_claims(&self) -> FalseClaims {
        self.checked.false_claims(self, &self.values)
    }

    /// Returns the drawing positions for coordinates `q`, in metres, in the order of the coordinates. Coordinates
    /// without a position are left out.
    pub fn places(&self, q: &[f64]) -> Vec<DVec2> {
        let mut places = Vec::new();
        let registers = &mut self.registers.borrow_mut();
        self.equations.place(registers, q, |place| places.push(DVec2::from(place)));
        places
    }

    /// Sets all parameters.
    fn write(&mut self, values: &[f64]) {
        self.values.copy_from_slice(values);
        self.prepare();
    }

    fn coordinates(&self) -> usize {
        self.equations.text().coordinates.len()
    }

    /// Returns the starts of the coordinates, the starts of the velocities, and the kicks.
    fn starts(&self) -> [&[f64]; 3] {
        let n = self.coordinates();
        let (starts, rest) = self.values[self.equations.text().constants.len()..].split_at(n);
        let (velocities, kicks) = rest.split_at(n);
        [starts, velocities, kicks]
    }

    /// Returns the wall with the restitution that the event has at 1 unit per second.
    fn with_restitution(&self, wall: Wall, index: usize, t: f64) -> Wall {
        let mut state = self.start();
        state.v[wall.coordinate] = wall.velocity - wall.side;
        self.turn(index, t, &mut state);
        Wall { restitution: wall.speed(&state.v), ..wall }
    }

    /// Adds the accelerations by soft walls.
    fn soft_pushes(&self, t: f64, [q, v]: [&[f64]; 2], a: &mut [f64]) {
        for wall in (0..).map_while(|index| self.wall(index, t)) {
            a[wall.coordinate] += wall.soft_push(SOFT_HZ, q, v);
        }
    }

    fn at<'a>(&self, t: f64, q: &'a [f64], v: &'a [f64]) -> At<'a> {
        At { t, steering: self.steering, q, v }
    }
}

/// Returns the values that expressions may use, which are all values but the kicks.
fn known<'v>(equations: &Equations, values: &'v [f64]) -> &'v [f64] {
    &values[..values.len() - equations.text().coordinates.len()]
}

impl System for Law {
    type Vector = Vec<f64>;

    #[inline]
    fn acceleration(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        self.equations.accelerate(&mut self.registers.borrow_mut(), self.at(t, q, v), a);
        if self.is_soft {
            self.soft_pushes(t, [q, v], a);
        }
    }
}

impl Body for Law {
    const HAS_WALLS: bool = true;

    fn with_parameters(mut self, values: &[f64]) -> Self {
        self.write(values);
        // The claims are checked before the first tick, which must not allocate.
        self.false_claims();
        self
    }

    fn set_parameter(&mut self, index: usize, value: f64) -> bool {
        let n = self.coordinates();
        let constants = self.equations.text().constants.len();
        let acts_at_once = index < constants || index >= constants + 2 * n;
        match self.values.get_mut(index) {
            Some(old) if acts_at_once && *old != value => *old = value,
            _ => return false,
        }
        self.prepare();
        true
    }

    fn prepare(&mut self) {
        let values = known(&self.equations, &self.values);
        self.registers.get_mut().set(&self.equations, values);
        self.checked.reset();
    }

    fn heap_bytes(&self) -> usize {
        size_of_val(&self.values[..]) + self.registers.borrow().heap_bytes()
    }

    fn start(&self) -> State<Vec<f64>> {
        let [q, v, _] = self.starts();
        State { q: q.into(), v: v.into() }
    }

    fn exact_since_start(&self, t: f64, to: &mut State<Vec<f64>>) -> bool {
        !self.false_claims().exact && self.claimed(t, to)
    }

    fn is_linear(&self) -> bool {
        self.equations.is_linear()
    }

    fn is_angle(&self, coordinate: usize) -> bool {
        self.equations.is_angle(coordinate)
    }

    fn acceleration_of(&self, t: f64, State { q, v }: &State<Vec<f64>>, coordinate: usize) -> f64 {
        let registers = &mut self.registers.borrow_mut();
        self.equations.acceleration_of(registers, self.at(t, q, v), coordinate)
    }

    fn wall(&self, index: usize, t: f64) -> Option<Wall> {
        let wall = self.equations.wall(&mut self.registers.borrow_mut(), index, t)?;
        Some(if self.is_soft { self.with_restitution(wall, index, t) } else { wall })
    }

    fn turn(&self, wall: usize, t: f64, State { q, v }: &mut State<Vec<f64>>) -> bool {
        self.equations.turn(&mut self.registers.borrow_mut(), (wall, t), q, v);
        true
    }

    fn soften(&mut self, is_soft: bool) {
        self.is_soft = is_soft && self.equations.events() > 0;
    }

    fn first_wall(&self) -> usize {
        self.equations.switches()
    }

    fn switches(&self) -> usize {
        self.equations.switches() + self.equations.events()
    }

    fn piece(&self, t: f64, state: &State<Vec<f64>>) -> Piece {
        let mut piece = Piece::FIRST;
        let at = self.at(t, &state.q, &state.v);
        self.equations.write_modes(&mut self.registers.borrow_mut(), at, &mut piece.modes);
        piece
    }

    fn distances_to_ends(&self, piece: &Piece, t: f64, state: &State<Vec<f64>>) -> Distances {
        let mut distances = NO_BOUNDARIES;
        let at = self.at(t, &state.q, &state.v);
        let registers = &mut self.registers.borrow_mut();
        self.equations.write_distances(&piece.modes, registers, at, &mut distances);
        distances
    }

    fn neighbour(&self, switch: usize, mode: i64, side: usize) -> i64 {
        self.equations.motion.neighbour(switch, mode, side)
    }

    fn has_jumps(&self) -> bool {
        true
    }

    fn acceleration_on(&self, piece: &Piece, t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        let at = self.at(t, q, v);
        self.equations.accelerate_on(&piece.modes, &mut self.registers.borrow_mut(), at, a);
    }

    fn energy(&self, state: &State<Vec<f64>>) -> Option<f64> {
        if self.false_claims().energy { None } else { self.claimed_energy(state) }
    }

    fn kinetic_energy(&self, state: &State<Vec<f64>>) -> Option<f64> {
        let all = self.energy(state)?;
        let still = self.equations.energy(&mut self.registers.borrow_mut(), &state.q, None)?;
        Some(all - still)
    }

    fn input(&mut self, input: Input, state: &mut State<Vec<f64>>) -> bool {
        let [takes_throttle, takes_rudder] = self.equations.is_steered();
        match input {
            Input::Throttle(part) if takes_throttle => self.steering[0] = part,
            Input::Rudder(part) if takes_rudder => self.steering[1] = part,
            Input::Throttle(_) | Input::Rudder(_) => return false,
            Input::Kick(times) => {
                let [.., kicks] = self.starts();
                state.v.iter_mut().zip(kicks).for_each(|(v, kick)| *v += times * kick);
            }
        }
        true
    }

    /// Returns the first declared position, or else the coordinates of the plane, or else the first coordinate, to the
    /// right or up.
    fn place(&self, q: &Vec<f64>) -> DVec2 {
        let text = self.equations.text();
        if self.equations.has_places() {
            let mut first = None;
            let registers = &mut self.registers.borrow_mut();
            self.equations.place(registers, q, |place| first = first.or(Some(place)));
            return first.unwrap_or_default().into();
        }
        match (text.plane, text.layout) {
            (Some([x, y]), _) => DVec2::new(q[x], q[y]),
            (None, Layout::Beads | Layout::Follower) => DVec2::new(q[0], 0.0),
            (None, Layout::Vertical | Layout::Carriage) => DVec2::new(0.0, q[0]),
        }
    }
}
