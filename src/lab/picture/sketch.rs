//! From metres to points: the camera of one cell, and the marks of a body as strokes.

use glam::DVec2;

use super::{Cap, FAR, Mark, Rect, Rgba, Stroke};
use crate::lab::Lens;

/// Looks at one body's world through one cell of the stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Camera {
    /// The cell.
    pub(super) rect: Rect,
    /// The place in the world, in metres, that is seen at `at`.
    pub(super) centre_m: DVec2,
    /// The point of the stage that shows `centre_m`.
    pub(super) at: [f32; 2],
    /// Points for one metre.
    pub(super) points_per_metre: f64,
    /// How long a chart recorder's paper is from the body down, in points.
    pub(super) paper: f64,
}

impl Camera {
    /// The camera through a lens.
    pub(super) fn through(self, lens: Lens) -> Self {
        let (seen, size) = (lens.seen(self.rect.part(self.at)), self.rect.size());
        let point = |axis: usize| {
            let middle = f64::from(self.rect.min[axis] + self.rect.max[axis]) / 2.0;
            demote(middle + seen[axis] * size[axis])
        };
        Self {
            at: [point(0), point(1)],
            points_per_metre: self.points_per_metre * lens.zoom(),
            paper: self.paper * lens.zoom(),
            ..self
        }
    }

    /// The place in the world that a point shows.
    pub(super) fn metres(&self, at: [f32; 2]) -> DVec2 {
        let [x, y] = [0, 1].map(|axis| f64::from(at[axis] - self.at[axis]));
        self.centre_m + DVec2::new(x, -y) / self.points_per_metre
    }

    /// The point that shows a place in the world.
    pub(super) fn points(&self, place_m: DVec2) -> [f32; 2] {
        let offset = (place_m - self.centre_m) * self.points_per_metre;
        [demote(f64::from(self.at[0]) + offset.x), demote(f64::from(self.at[1]) - offset.y)]
    }

    pub(super) fn length(&self, metres: f64) -> f32 {
        demote(metres * self.points_per_metre)
    }

    /// The least and the greatest x in view, in metres.
    pub(super) fn span_m(&self) -> (f64, f64) {
        let metres = |x: f32| self.centre_m.x + f64::from(x - self.at[0]) / self.points_per_metre;
        (metres(self.rect.min[0]), metres(self.rect.max[0]))
    }

    /// A round length of 1, 2 or 5 times a power of ten metres that shows as at least `points`.
    pub(super) fn round_length_m(&self, points: f64) -> f64 {
        let least = points / self.points_per_metre;
        let decade = libm::pow(10.0, libm::floor(libm::log10(least)));
        [1.0, 2.0, 5.0]
            .into_iter()
            .map(|n| n * decade)
            .find(|&m| m >= least)
            .unwrap_or(10.0 * decade)
    }
}

/// The one place where f64 becomes f32.
pub(super) fn demote(x: f64) -> f32 {
    let far = f64::from(FAR);
    if x.is_nan() { FAR } else { x.clamp(-far, far) as f32 }
}

/// How the marks of one outline are painted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paint {
    pub(super) colour: Rgba,
    /// Width of a line of weight 1, in points.
    pub(super) line_width: f32,
    /// By how many points shapes are grown, for a ghost to show round what lies over it.
    pub(super) grow: f32,
}

/// The strokes of an outline.
pub(super) fn strokes<'a>(
    marks: &'a [Mark],
    camera: &'a Camera,
    paint: Paint,
) -> impl Iterator<Item = Stroke> + 'a {
    let Paint { colour, line_width, grow } = paint;
    marks.iter().map(move |mark| {
        let stroke = |from, to, radii: [f32; 2], cap| Stroke {
            from: camera.points(from),
            to: camera.points(to),
            radii: [radii[0] + grow, radii[1] + grow],
            colour,
            cap,
            clip: camera.rect,
        };
        match *mark {
            Mark::Line { from, to, weight } => {
                let radius = line_width * weight as f32 / 2.0 - grow;
                stroke(from, to, [radius, radius], Cap::Round)
            }
            Mark::Taper { from, to, from_radius, to_radius } => {
                let radii = [camera.length(from_radius), camera.length(to_radius)];
                stroke(from, to, radii, Cap::Round)
            }
            Mark::Block { centre, along, half } => {
                let side = along * (half + f64::from(grow) / camera.points_per_metre);
                let radius = camera.length(half);
                stroke(centre - side, centre + side, [radius, radius], Cap::Butt)
            }
        }
    })
}

/// A line with round ends, `width` points wide.
pub(super) fn line(from: [f32; 2], to: [f32; 2], width: f32, colour: Rgba, clip: Rect) -> Stroke {
    let radii = [width / 2.0; 2];
    Stroke { from, to, radii, colour, cap: Cap::Round, clip }
}
