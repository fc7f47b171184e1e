//! Draws a body between two ticks.
//!
//! A line and a cubic lie between two known states, and so the picture is one tick late. Extrapolation is not late, but
//! overshoots at every kick, which it cannot foresee. While time stands still the studio draws the raw state, because a
//! person then looks at a tick.

use super::lane::LaneBody;

/// How to draw a body between two ticks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// The state of the last tick, unchanged.
    Raw,
    /// A straight line between the last two ticks.
    Linear,
    /// A cubic through the coordinates and velocities of the last two ticks.
    Hermite,
    /// The same cubic, but without going back between two ticks that move one way. Explicit Euler changes a velocity
    /// one tick before the position follows, so at a coarse tick the plain cubic starts by moving backwards. A parabola
    /// stays unchanged.
    #[default]
    Monotone,
    /// The state of the last tick, extrapolated by its velocities.
    Extrapolated,
}

impl Interpolation {
    /// All variants, in the order in which the window cycles through them.
    pub const ALL: [Self; 5] =
        [Self::Raw, Self::Extrapolated, Self::Linear, Self::Hermite, Self::Monotone];

    /// Returns the name for people.
    pub fn name(self) -> &'static str {
        match self {
            Interpolation::Raw => "raw",
            Interpolation::Linear => "linear",
            Interpolation::Hermite => "Hermite",
            Interpolation::Monotone => "monotone Hermite",
            Interpolation::Extrapolated => "extrapolated",
        }
    }

    /// Returns the next variant. After the last one comes the first.
    pub fn next(self) -> Self {
        let index = Self::ALL.iter().position(|&way| way == self).expect("all are listed");
        Self::ALL[(index + 1) % Self::ALL.len()]
    }

    /// Returns the displayed moment at the fraction `alpha` of the next tick, in ticks from the last one.
    pub fn shown(self, alpha: f64) -> f64 {
        match self {
            Interpolation::Raw => 0.0,
            Interpolation::Extrapolated => alpha,
            Interpolation::Linear | Interpolation::Hermite | Interpolation::Monotone => alpha - 1.0,
        }
    }

    /// Returns the coordinates of a body at the fraction `alpha` of a tick of `h` seconds.
    pub fn coordinates(self, body: &LaneBody, alpha: f64, h: f64) -> Vec<f64> {
        let (q0, v0) = (&body.previous_q, &body.previous_v);
        let (q1, v1) = (body.stepper.q(), body.stepper.v());
        let each = |f: &dyn Fn(usize) -> f64| (0..q1.len()).map(f).collect();
        match self {
            Interpolation::Raw => q1.to_vec(),
            Interpolation::Linear => each(&|i| q0[i] + (q1[i] - q0[i]) * alpha),
            Interpolation::Hermite => each(&|i| hermite(alpha, h, [q0[i], q1[i]], [v0[i], v1[i]])),
            Interpolation::Monotone => each(&|i| {
                let q = [q0[i], q1[i]];
                hermite(alpha, h, q, monotone(h, q, [v0[i], v1[i]]))
            }),
            Interpolation::Extrapolated => each(&|i| q1[i] + alpha * h * v1[i]),
        }
    }

    /// Returns the velocities of a body at the same moment. They are those of the stepped states or, between two ticks,
    /// on a line through these. They may differ from the slope of the drawing, because some methods' velocities are not
    /// the change of their coordinates.
    pub fn velocities(self, body: &LaneBody, alpha: f64) -> Vec<f64> {
        let (v0, v1) = (&body.previous_v, body.stepper.v());
        match self {
            Interpolation::Raw | Interpolation::Extrapolated => v1.to_vec(),
            Interpolation::Linear | Interpolation::Hermite | Interpolation::Monotone => {
                v0.iter().zip(v1).map(|(v0, v1)| v0 + (v1 - v0) * alpha).collect()
            }
        }
    }
}

/// Returns the cubic at the fraction `alpha` of a tick of `h` seconds, through `q` with the velocities `v` at both
/// ends.
pub fn hermite(alpha: f64, h: f64, q: [f64; 2], v: [f64; 2]) -> f64 {
    let (a, b) = (alpha, 1.0 - alpha);
    let ends = b * b * (1.0 + 2.0 * a) * q[0] + a * a * (1.0 + 2.0 * b) * q[1];
    ends + h * a * b * (b * v[0] - a * v[1])
}

/// Returns the slope of [`hermite`].
pub fn slope(alpha: f64, h: f64, q: [f64; 2], v: [f64; 2]) -> f64 {
    let (a, b) = (alpha, 1.0 - alpha);
    6.0 * a * b * (q[1] - q[0]) / h + b * (b - 2.0 * a) * v[0] + a * (a - 2.0 * b) * v[1]
}

/// Returns the velocities `v` at both ends of a tick of `h` seconds, limited to three times that of a straight line (de
/// Boor and Swartz 1977). With these limits, the cubic through `q` goes one way. Velocities that disagree in direction
/// with each other or with the line stay unchanged.
fn monotone(h: f64, q: [f64; 2], v: [f64; 2]) -> [f64; 2] {
    let most = 3.0 * (q[1] - q[0]) / h;
    let goes_on = v[0] * v[1] >= 0.0 && v.iter().all(|v| v * most >= 0.0);
    if goes_on { v.map(|v| v.clamp(most.min(0.0), most.max(0.0))) } else { v }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hermite_cubic_matches_ends_and_slopes_and_reproduces_parabolas() {
        let (q, v) = (|t: f64| 3.0 + 2.0 * t - t * t, |t: f64| 2.0 - 2.0 * t);
        for alpha in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let h = 0.5;
            let shown = hermite(alpha, h, [q(1.0), q(1.5)], [v(1.0), v(1.5)]);
            assert!((shown - q(1.0 + alpha * h)).abs() < 1e-15, "at {alpha}: {shown}");
            let slope = slope(alpha, h, [q(1.0), q(1.5)], [v(1.0), v(1.5)]);
            assert!((slope - v(1.0 + alpha * h)).abs() < 1e-14, "at {alpha}: {slope}");
        }
    }

    #[test]
    fn a_monotone_cubic_never_overshoots_and_keeps_turns_and_parabolas() {
        let path = |h: f64, q: [f64; 2], v: [f64; 2]| -> Vec<f64> {
            let v = monotone(h, q, v);
            (0..=100).map(|part| hermite(f64::from(part) / 100.0, h, q, v)).collect()
        };
        // The harbour's ship under explicit Euler at 1 Hz moves one tick after its speed changes.
        let (mut q, mut v) = (0.0, 0.0);
        for _ in 0..10 {
            let (then, was) = (q, v);
            q += v;
            v += 2.0 - 0.1 * v;
            let drawn = path(1.0, [then, q], [was, v]);
            assert!(drawn.is_sorted() && drawn[0] == then && drawn[100] == q, "{drawn:?}");
            let back = path(1.0, [-then, -q], [-was, -v]);
            assert!(back.iter().zip(&drawn).all(|(a, b)| *a == -b));
        }
        for (q, v) in [
            ([0.0, 0.0], [1.0, -1.0]),
            ([1.0, 0.9], [0.5, -1.0]),
            ([0.0, 4.0], [0.0, 8.0]),
            ([0.0, 4.0], [8.0, 0.0]),
        ] {
            assert_eq!(monotone(1.0, q, v), v, "a turn or a parabola: {q:?} {v:?}");
        }
    }

    #[test]
    fn the_interpolations_cycle() {
        let mut way = Interpolation::Raw;
        for expected in Interpolation::ALL.iter().skip(1).chain([&Interpolation::Raw]) {
            way = way.next();
            assert_eq!(way, *expected);
        }
    }
}
