//! The shapes of clouds of starts.

use std::f64::consts::TAU;

/// The shape of a cloud at its start, in the square from -1 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CloudShape {
    /// The head of a cat, as Arnold drew it to show the effect of a map.
    #[default]
    Cat,
    /// A disc.
    Disc,
    /// A ring whose width is a fifth of its radius.
    Ring,
}

/// The inner radius of the ring. The outer radius is 1.
const RING: f64 = 0.8;
/// The head of the cat, by the height of its middle, which is below the centre, and its radius.
const HEAD: (f64, f64) = (-0.2, 0.8);
/// The corners of the right ear, two of which lie within the head.
const EAR: [[f64; 2]; 3] = [[0.1, 0.5], [0.75, 1.0], [0.78, -0.1]];
/// The middle and the radius of the right eye.
const EYE: ([f64; 2], f64) = ([0.3, 0.05], 0.13);

/// Steps of a point's coordinates, as fractions of 1. They are powers of the reciprocal of the plastic number, which
/// fill a square evenly (M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018).
const EVENLY: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_3];

impl CloudShape {
    /// All shapes, with the usual one first.
    pub const ALL: [Self; 3] = [Self::Cat, Self::Disc, Self::Ring];

    /// Returns the name of the shape in scenes and on the command line.
    pub fn id(self) -> &'static str {
        match self {
            Self::Disc => "disc",
            Self::Ring => "ring",
            Self::Cat => "cat",
        }
    }

    /// Returns the first `count` points of a sequence that covers the shape evenly. The sequence is the same in every
    /// run.
    pub fn points(self, count: usize) -> impl Iterator<Item = [f64; 2]> {
        let square = (1_u64..).map(|n| EVENLY.map(|part| (n as f64 * part).fract() * 2.0 - 1.0));
        square.filter(move |&point| self.contains(point)).take(count)
    }

    fn contains(self, [x, y]: [f64; 2]) -> bool {
        let within = |[cx, cy]: [f64; 2], radius: f64| {
            (x - cx) * (x - cx) + (y - cy) * (y - cy) <= radius * radius
        };
        match self {
            Self::Disc => within([0.0, 0.0], 1.0),
            Self::Ring => within([0.0, 0.0], 1.0) && !within([0.0, 0.0], RING),
            Self::Cat => {
                let side = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| {
                    (bx - ax) * (y - ay) - (by - ay) * (x.abs() - ax) <= 0.0
                };
                let is_ear = side(EAR[0], EAR[1]) && side(EAR[1], EAR[2]) && side(EAR[2], EAR[0]);
                let ([ex, ey], eye) = EYE;
                (within([0.0, HEAD.0], HEAD.1) || is_ear)
                    && !within([ex, ey], eye)
                    && !within([-ex, ey], eye)
            }
        }
    }

    /// Returns the shape's borders as closed lines with about `count` points in all.
    pub fn borders(self, count: usize) -> Vec<Vec<[f64; 2]>> {
        let arc = |[x, y]: [f64; 2], radius: f64, from: f64, to: f64, count: usize| {
            let angle = move |n| from + (to - from) * n as f64 / count as f64;
            let point = move |a: f64| [x + radius * libm::cos(a), y + radius * libm::sin(a)];
            (0..=count).map(move |n| point(angle(n))).collect::<Vec<_>>()
        };
        let circle = |centre, radius, count| arc(centre, radius, 0.0, TAU, count);
        match self {
            Self::Disc => vec![circle([0.0, 0.0], 1.0, count)],
            Self::Ring => [1.0, RING].map(|radius| circle([0.0, 0.0], radius, count / 2)).into(),
            Self::Cat => {
                // The line runs counter-clockwise from the inner foot of the right ear: over the head, over the left
                // ear, below the head to the right ear's outer foot, and over that ear.
                let (middle, radius) = ([0.0, HEAD.0], HEAD.1);
                let meets = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| {
                    let (dx, dy, fy) = (bx - ax, by - ay, ay - HEAD.0);
                    let (a, b, c) =
                        (dx * dx + dy * dy, ax * dx + fy * dy, ax * ax + fy * fy - HEAD.1 * HEAD.1);
                    let s = (-b - (b * b - a * c).sqrt()) / a;
                    [ax + s * dx, ay + s * dy]
                };
                let feet = [meets(EAR[1], EAR[0]), meets(EAR[1], EAR[2])];
                let angles = feet.map(|[x, y]| libm::atan2(y - HEAD.0, x));
                let left = |[x, y]: [f64; 2]| [-x, y];
                let straight = |from: [f64; 2], to: [f64; 2]| {
                    let point = move |n: usize| {
                        let part = n as f64 / (count / 10) as f64;
                        [0, 1].map(|i| from[i] + part * (to[i] - from[i]))
                    };
                    (0..count / 10).map(point).collect::<Vec<_>>()
                };
                let pi = std::f64::consts::PI;
                let mut head = arc(middle, radius, angles[0], pi - angles[0], count / 10);
                head.extend(straight(left(feet[0]), left(EAR[1])));
                head.extend(straight(left(EAR[1]), left(feet[1])));
                head.extend(arc(middle, radius, pi - angles[1], TAU + angles[1], count / 3));
                head.extend(straight(feet[1], EAR[1]));
                head.extend(straight(EAR[1], feet[0]));
                head.push(feet[0]);
                let eyes = [EYE.0, left(EYE.0)].map(|eye| circle(eye, EYE.1, count / 12));
                std::iter::once(head).chain(eyes).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lie_inside_the_shape_and_its_border_separates_the_outside() {
        for shape in CloudShape::ALL {
            assert_eq!(shape.points(1000).count(), 1000);
            assert!(shape.points(1000).all(|point| shape.contains(point)));
            for [x, y] in shape.borders(400).concat() {
                let around = (0..64).map(|n| f64::from(n) / 64.0 * TAU);
                let around = around.map(|a| [x + 0.02 * libm::cos(a), y + 0.02 * libm::sin(a)]);
                let within = around.filter(|&point| shape.contains(point)).count();
                assert!((1..64).contains(&within), "{shape:?} at {x}, {y}: {within}");
            }
        }
    }
}
