//! From metres to points: the camera of one cell, and the pen that draws lines and fills in it.

use std::sync::LazyLock;

use glam::DVec2;

use super::{FAR, Fill, Path, PathPoint, Picture, Rect, Shape};
use crate::look::palette::{Palette, Rgba, fade};
use crate::studio::ZoomPan;

/// From the middle of a block to the tip of the pen under it, in blocks.
pub(super) const PEN: f32 = 0.66;
/// Room for digits and a line of words below threads, in points.
const FOOT: f64 = 40.0;

/// Maps one body's world to one cell of the stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Camera {
    pub(super) rect: Rect,
    /// Place in the world (m) that appears at `at`.
    pub(super) centre_m: DVec2,
    /// The point of the stage that shows `centre_m`.
    pub(super) at: [f32; 2],
    /// Points for one metre.
    pub(super) points_per_metre: f64,
    /// Length of a chart recorder's paper from the body down, in points.
    pub(super) paper: f64,
    /// Magnification of bodies. They would vanish on a stage that has zoomed out far.
    pub(super) magnified: f64,
    /// Side of a block on a spring, in points.
    pub(super) block: f32,
    /// Edge of the quay to which springs are moored, in metres.
    pub(super) quay_m: f64,
    /// Unit of the scale, for one metre of the picture.
    pub(super) unit: &'static str,
    /// The zoom and the pan that the camera has, which keep the body in view.
    pub(super) zoom_pan: ZoomPan,
}

impl Camera {
    /// A camera that shows the world's origin in the middle of `rect`, with blocks of this side in points.
    pub(super) fn of(rect: Rect, block: f32) -> Self {
        Self {
            rect,
            centre_m: DVec2::ZERO,
            at: [0, 1].map(|axis| (rect.min[axis] + rect.max[axis]) / 2.0),
            points_per_metre: 1.0,
            paper: 0.0,
            magnified: 1.0,
            block,
            quay_m: 0.0,
            unit: "m",
            zoom_pan: ZoomPan::default(),
        }
    }

    /// The same camera, with this place at its point and this half of a view (m) in its room (points).
    pub(super) fn fitting(self, centre_m: DVec2, half_m: DVec2, [width, height]: [f64; 2]) -> Self {
        let points_per_metre = (width / half_m.x).min(height / half_m.y) / 2.0;
        Self { centre_m, points_per_metre, ..self }
    }

    /// The same camera for a stage that has grown by the factor `times`. Bodies shrink too, but ever more slowly.
    pub(super) fn grown(self, times: f64) -> Self {
        /// Least share of its size that a body keeps.
        const MIN: f64 = 0.4;
        let size = (1.0 / libm::sqrt(times)).max(MIN);
        Self { magnified: times * size, block: self.block * demote(size), ..self }
    }

    /// The same camera, zoomed in and panned.
    pub(super) fn zoomed(self, zoom_pan: ZoomPan) -> Self {
        let (seen, size) = (zoom_pan.place_in_view(self.rect.part(self.at)), self.rect.size());
        let point = |axis: usize| {
            let middle = f64::from(self.rect.min[axis] + self.rect.max[axis]) / 2.0;
            demote(middle + seen[axis] * size[axis])
        };
        Self {
            at: [point(0), point(1)],
            points_per_metre: self.points_per_metre * zoom_pan.zoom(),
            paper: self.paper * zoom_pan.zoom(),
            block: self.block * demote(zoom_pan.zoom()),
            zoom_pan,
            ..self
        }
    }

    /// Place in the world at a point.
    pub(super) fn metres(&self, at: [f32; 2]) -> DVec2 {
        let [x, y] = [0, 1].map(|axis| f64::from(at[axis] - self.at[axis]));
        self.centre_m + DVec2::new(x, -y) / self.points_per_metre
    }

    /// Point of a place in the world.
    pub(super) fn points(&self, place_m: DVec2) -> [f32; 2] {
        let offset = (place_m - self.centre_m) * self.points_per_metre;
        [demote(f64::from(self.at[0]) + offset.x), demote(f64::from(self.at[1]) - offset.y)]
    }

    /// Point on a chart recorder's paper of one second, for a place at `seconds` from now.
    pub(super) fn paper_point(&self, place_m: DVec2, seconds: f64) -> [f32; 2] {
        let ([x, y], pen) = (self.points(place_m), f64::from(PEN * self.block));
        [x, demote(f64::from(y) + pen + seconds * (self.paper - pen - FOOT).max(0.0))]
    }

    pub(super) fn length(&self, metres: f64) -> f32 {
        demote(metres * self.points_per_metre)
    }

    /// Drawn length of a part of a body, in points.
    pub(super) fn size(&self, metres: f64) -> f32 {
        self.length(self.magnified * metres)
    }

    /// Least and greatest x in view, in metres.
    pub(super) fn span_m(&self) -> (f64, f64) {
        let metres = |x: f32| self.centre_m.x + f64::from(x - self.at[0]) / self.points_per_metre;
        (metres(self.rect.min[0]), metres(self.rect.max[0]))
    }

    /// The round length, 1, 2 or 5 times a power of ten metres, that shows as at least `points`.
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

/// Dash pattern of an unbroken line.
pub(super) const SOLID: [f32; 2] = [1.0, 0.0];

/// The style of a lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct LaneStyle {
    pub(super) colour: Rgba,
    /// Drawn length and gap in points; a gap of 0 is solid.
    pub(super) dash: [f32; 2],
    /// Opacity of its fill when behind.
    pub(super) fill: f32,
}

impl LaneStyle {
    /// An unbroken line.
    pub(super) fn solid(colour: Rgba, fill: f32) -> Self {
        Self { colour, dash: SOLID, fill }
    }
}

/// Draws shapes over those of a picture, clipped to a rectangle. Widths and radii are in points.
pub(super) struct Pen<'a> {
    shapes: &'a mut Vec<Shape>,
    clip: Rect,
}

impl Picture {
    /// A pen that draws within `clip`.
    pub(super) fn pen(&mut self, clip: Rect) -> Pen<'_> {
        Pen { shapes: &mut self.shapes, clip }
    }
}

impl Pen<'_> {
    /// Draws a straight line.
    pub(super) fn line(&mut self, from: [f32; 2], to: [f32; 2], width: f32, colour: Rgba) {
        self.path([from, to], width, colour);
    }

    /// Draws a disc.
    pub(super) fn disc(&mut self, at: [f32; 2], radius: f32, colour: Rgba) {
        self.line(at, at, 2.0 * radius, colour);
    }

    /// Draws a line through points.
    pub(super) fn path(
        &mut self,
        points: impl IntoIterator<Item = [f32; 2]>,
        width: f32,
        colour: Rgba,
    ) {
        self.dashed(points, width, colour, SOLID);
    }

    /// Draws a dashed line through points.
    pub(super) fn dashed(
        &mut self,
        points: impl IntoIterator<Item = [f32; 2]>,
        width: f32,
        colour: Rgba,
        dash: [f32; 2],
    ) {
        let point = |at| PathPoint { at, radius: width / 2.0, colour };
        self.course(points.into_iter().map(point), dash);
    }

    /// Draws a line of one colour through points, with half its width at each.
    pub(super) fn taper(
        &mut self,
        points: impl IntoIterator<Item = ([f32; 2], f32)>,
        colour: Rgba,
    ) {
        let point = |(at, radius)| PathPoint { at, radius, colour };
        self.course(points.into_iter().map(point), SOLID);
    }

    /// Draws a dashed line through points with a width and a colour each.
    pub(super) fn course(&mut self, points: impl Iterator<Item = PathPoint>, dash: [f32; 2]) {
        let path = Path { points: points.collect(), dash, clip: self.clip };
        self.shapes.push(Shape::Path(path));
    }

    /// Draws a line around the outline through these corners.
    pub(super) fn ring(&mut self, corners: &[[f32; 2]], width: f32, colour: Rgba) {
        self.dashed_ring(corners, width, colour, SOLID);
    }

    /// Draws a dashed line around the outline through these corners.
    pub(super) fn dashed_ring(
        &mut self,
        corners: &[[f32; 2]],
        width: f32,
        colour: Rgba,
        dash: [f32; 2],
    ) {
        self.dashed(corners.iter().chain(corners.first()).copied(), width, colour, dash);
    }

    /// Fills an outline with one colour.
    pub(super) fn fill(&mut self, corners: &[[f32; 2]], colour: Rgba) {
        self.shaded(corners, |_| colour);
    }

    /// Fills an outline with a colour for each place.
    pub(super) fn shaded(&mut self, corners: &[[f32; 2]], colour: impl Fn([f32; 2]) -> Rgba) {
        let corners = corners.iter().map(|&at| (at, colour(at))).collect();
        self.shapes.push(Shape::Fill(Fill { corners, clip: self.clip }));
    }

    /// Draws the outline of a body in a lane behind.
    pub(super) fn hollow(&mut self, outline: &[[f32; 2]], width: f32, style: LaneStyle) {
        self.fill(outline, fade(style.colour, style.fill));
        self.dashed_ring(outline, width, style.colour, style.dash);
    }

    /// Draws the outline of a body of the exact solution.
    pub(super) fn ghost(&mut self, outline: &[[f32; 2]], palette: &Palette) {
        self.fill(outline, fade(palette.exact, 0.12));
        self.ghost_rim(outline, palette);
    }

    /// Draws the line around a body of the exact solution.
    pub(super) fn ghost_rim(&mut self, outline: &[[f32; 2]], palette: &Palette) {
        self.ring(outline, 4.0, fade(palette.sea[1], 0.6));
        self.ring(outline, 1.8, fade(palette.exact, 0.95));
    }
}

/// Evenly spaced corners on a circle.
pub(super) fn circle([x, y]: [f32; 2], radius: f32, corners: u8) -> Vec<[f32; 2]> {
    let corner = |i: u8| {
        let angle = std::f32::consts::TAU * f32::from(i) / f32::from(corners);
        [x + radius * libm::cosf(angle), y + radius * libm::sinf(angle)]
    };
    (0..corners).map(corner).collect()
}

/// Cosines and sines of the ends of four pieces, for each quarter of a turn.
static QUARTERS: LazyLock<[[[f32; 2]; 5]; 4]> = LazyLock::new(|| {
    std::array::from_fn(|turn| {
        std::array::from_fn(|piece| {
            let quarters = turn as f32 - 1.0 + piece as f32 / 4.0;
            let angle = quarters * std::f32::consts::FRAC_PI_2;
            [libm::cosf(angle), libm::sinf(angle)]
        })
    })
});

/// Outline of an upright rectangle with round corners.
pub(super) fn rounded(min: [f32; 2], max: [f32; 2], radius: f32) -> Vec<[f32; 2]> {
    let radius = radius.min((max[0] - min[0]) / 2.0).min((max[1] - min[1]) / 2.0).max(0.0);
    let centres = [
        [max[0] - radius, min[1] + radius],
        [max[0] - radius, max[1] - radius],
        [min[0] + radius, max[1] - radius],
        [min[0] + radius, min[1] + radius],
    ];
    let corners = centres.iter().zip(&*QUARTERS).flat_map(|([x, y], quarter)| {
        quarter.iter().map(move |[cos, sin]| [x + radius * cos, y + radius * sin])
    });
    corners.collect()
}
