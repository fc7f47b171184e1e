//! The curves of a plot.
//!
//! A shape for every piece of a dash between two samples, visible or not, would cost a hundred thousand triangles for a
//! race. Most of these triangles would be smaller than a pixel. Here a straight piece costs two triangles.

use std::sync::Arc;

use egui::epaint::PaintCallback;
use egui::{Color32, Painter, Pos2, Rect, Shape, Vec2, vec2};

use super::PlotArea;
use super::bands::{self, Band};
use crate::lines::{Joint, visible_runs};
use crate::strokes::StrokeMesh;

/// Line and dots of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LineStyle {
    pub(crate) colour: Color32,
    /// Width of the line, in points.
    pub(crate) width: f32,
    /// Length of a dash and of the gap after it, in points. A line with a gap of 0 is solid.
    pub(crate) dash: [f32; 2],
    pub(crate) dots: Dots,
}

impl LineStyle {
    /// Creates a line without gaps or dots.
    pub(crate) fn solid(colour: Color32, width: f32) -> Self {
        Self { colour, width, dash: [1.0, 0.0], dots: Dots::None }
    }
}

/// A curve in a plane.
#[derive(Clone)]
pub(crate) struct Curve {
    pub(crate) style: LineStyle,
    pub(crate) points: Vec<[f64; 2]>,
    /// Lowest and highest value on the way from the previous point to each point. Empty if only the points are known.
    pub(crate) swept: Vec<[f64; 2]>,
}

/// A curve on the screen.
#[derive(Clone, Debug)]
pub(crate) struct ScreenCurve {
    pub(crate) style: LineStyle,
    pub(crate) points: Vec<Pos2>,
    /// Least and greatest y on the way from the previous point to each point. Empty if only the points are known.
    pub(crate) swept: Vec<[f32; 2]>,
}

impl Curve {
    /// Creates a curve of which only the points are known.
    pub(crate) fn new(style: LineStyle, points: Vec<[f64; 2]>) -> Self {
        Self { style, points, swept: Vec::new() }
    }

    /// Maps the curve to the screen.
    pub(super) fn on_screen(&self, area: &PlotArea) -> ScreenCurve {
        ScreenCurve {
            style: self.style,
            points: self.points.iter().map(|at| area.at(*at)).collect(),
            swept: self.swept.iter().map(|ends| ends.map(|y| area.height(y))).collect(),
        }
    }
}

impl ScreenCurve {
    /// Creates a curve of which only the points are known.
    pub(crate) fn new(style: LineStyle, points: Vec<Pos2>) -> Self {
        Self { style, points, swept: Vec::new() }
    }
}

/// The points of a curve that have a dot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Dots {
    None,
    /// Every point has a dot of this radius, in points.
    Each(f32),
    /// A point has a dot if it is further than [`SPARSE`] from a neighbour along the x axis. The straight line between
    /// two such points is not motion.
    SparseAlongX,
    /// A point has a dot if it is further than [`SPARSE`] from a neighbour.
    Sparse,
}

/// Minimum distance at which a viewer can distinguish two points, in screen points.
const SPARSE: f32 = 3.0;
/// Radius of the dots of sparse points, in screen points.
const SAMPLE: f32 = 1.5;

/// A curve that covers more than this share of its bounding box is drawn solid, because its dashes would not be
/// visible.
const CROWDED: f32 = 0.5;
/// Margin around the bounding box, in points, for a curve that has only begun.
const BEGINNING: f32 = 8.0;
/// Radius of an arrow, and distance of the arrow from the edges of the plot, in points.
const ARROW: f32 = 5.0;
const ARROW_INSET: f32 = 9.0;

/// Maximum number of turns per point of a curve, and per screen point, for a crowded curve that is drawn as a line.
/// With more turns the line would beat against the samples or the pixels.
const MAX_TURNS: f32 = 0.25;
const MAX_TURNS_PER_POINT: f32 = 0.5;

/// Maximum distance in screen points between a stretch of a curve and the line through the curve's points. A stretch
/// further away counts as hidden. Then the maximum share of hidden stretches for a curve that is drawn as a line. With
/// more of them, the line would show a false swing.
const HIDDEN: f32 = 2.0;
const MAX_HIDDEN: f32 = 1.0 / 16.0;

/// Shapes that draw a curve.
pub(super) enum CurveDrawing {
    /// The visible parts of the line, and the line's dash.
    Line(Vec<Vec<Joint>>, [f32; 2]),
    /// Bands in place of swings that are too narrow to resolve.
    Bands(Vec<Band>),
    /// Only dots. A crowded curve that goes back and forth has no band.
    Scattered,
}

/// Chooses how to draw a curve within the `seen` rectangle. The columns of a band are `column` points wide.
pub(super) fn choose_drawing(
    ScreenCurve { style, points, swept }: &ScreenCurve,
    (seen, column): (Rect, f32),
) -> CurveDrawing {
    let LineStyle { colour, width, dash: [drawn, gap], .. } = *style;
    let joints = points.iter().map(|&at| Joint { at, radius: width / 2.0, colour });
    let runs = visible_runs(joints, seen.expand(width));
    let is_crowded = is_crowded(&runs, width);
    if hides_motion(points, swept) || is_crowded && is_too_dense(points) {
        return match points.is_sorted_by(|a, b| a.x <= b.x) {
            true => CurveDrawing::Bands(bands::of(points, swept, width, (seen, column))),
            false => CurveDrawing::Scattered,
        };
    }
    CurveDrawing::Line(runs, [drawn, if is_crowded { 0.0 } else { gap }])
}

/// Draws a curve within the painter's clip, as [`choose_drawing`] chooses. A line reaches the painter as a
/// [`StrokeMesh`] for [`MeshRenderer`](crate::meshes::MeshRenderer). Returns `false` if the curve consists only
/// of dots.
pub(super) fn paint(painter: &Painter, curve: &ScreenCurve) -> bool {
    let colour = curve.style.colour;
    let (seen, px_per_point) = (painter.clip_rect(), painter.pixels_per_point());
    let stroke = |runs: Vec<Vec<Joint>>, dash: [f32; 2]| {
        let mut mesh = StrokeMesh::default();
        runs.into_iter().for_each(|run| mesh.add(run, dash, px_per_point));
        painter.add(PaintCallback { rect: seen, callback: Arc::new(mesh) });
    };
    match choose_drawing(curve, (seen, 1.0 / px_per_point)) {
        CurveDrawing::Line(runs, dash) => stroke(runs, dash),
        CurveDrawing::Bands(all) => {
            for band in all {
                painter.add(Shape::mesh(band.fill(colour)));
                stroke(band.edges(colour, seen), [1.0, 0.0]);
            }
        }
        CurveDrawing::Scattered => return false,
    }
    true
}

/// Whether a curve's swings are too narrow for its samples or for the screen.
fn is_too_dense(points: &[Pos2]) -> bool {
    let turns = turn_share(points);
    let wide = points.first().zip(points.last()).map_or(0.0, |(from, to)| (to.x - from.x).abs());
    turns > MAX_TURNS || turns * points.len() as f32 > MAX_TURNS_PER_POINT * wide.max(BEGINNING)
}

/// Whether the line through `points` would hide much of the curve's motion between them.
fn hides_motion(points: &[Pos2], swept: &[[f32; 2]]) -> bool {
    let hides = |(ends, swept): &(&[Pos2], &[f32; 2])| {
        let (high, low) = (ends[0].y.min(ends[1].y), ends[0].y.max(ends[1].y));
        swept.iter().any(|&y| y < high - HIDDEN || y > low + HIDDEN)
    };
    let hidden = points.windows(2).zip(swept.iter().skip(1)).filter(hides).count();
    hidden as f32 > MAX_HIDDEN * points.len() as f32
}

/// Returns the share of a curve's points at which it turns up or down.
fn turn_share(points: &[Pos2]) -> f32 {
    let is_turn = |at: &&[Pos2]| (at[1].y - at[0].y) * (at[2].y - at[1].y) < 0.0;
    points.windows(3).filter(is_turn).count() as f32 / points.len().max(1) as f32
}

fn is_crowded(runs: &[Vec<Joint>], width: f32) -> bool {
    let (mut length, mut room) = (0.0, Rect::NOTHING);
    for run in runs {
        run.iter().for_each(|joint| room.extend_with(joint.at));
        length += run.windows(2).map(|ends| ends[0].at.distance(ends[1].at)).sum::<f32>();
    }
    length * width > CROWDED * room.expand(BEGINNING).area()
}

/// Returns the dots of a curve through these screen points, each with its radius.
pub(super) fn dots(points: &[Pos2], dots: Dots) -> impl Iterator<Item = (Pos2, f32)> {
    let are_apart = move |a: Pos2, b: Pos2| match dots {
        Dots::SparseAlongX => (a.x - b.x).abs() >= SPARSE,
        _ => a.distance(b) >= SPARSE,
    };
    let has_dot = move |i: usize| {
        let before = i.checked_sub(1).map(|before| points[before]);
        let mut beside = before.into_iter().chain(points.get(i + 1).copied());
        beside.any(|other| are_apart(points[i], other))
    };
    (0..points.len()).filter_map(move |i| match dots {
        Dots::None => None,
        Dots::Each(radius) => Some((points[i], radius)),
        Dots::SparseAlongX | Dots::Sparse => has_dot(i).then_some((points[i], SAMPLE)),
    })
}

/// Arrows that mark where curves leave a plot. No two arrows overlap.
pub(super) struct Arrows {
    frame: Rect,
    placed: Vec<Pos2>,
}

impl Arrows {
    pub(super) fn new(frame: Rect) -> Self {
        Self { frame, placed: Vec::new() }
    }

    /// Returns the corners of an arrow for a curve that leaves the plot between two screen points, or `None` if the
    /// curve stays inside.
    pub(super) fn place(&mut self, ends: [Pos2; 2]) -> Option<[Pos2; 3]> {
        let (mut at, towards) = exit_arrow(self.frame, ends)?;
        while self.placed.iter().any(|other| other.distance(at) < 2.0 * ARROW) {
            at += 2.0 * ARROW * towards.abs().yx();
        }
        self.placed.push(at);
        let across = towards.rot90();
        let corner = |ahead: f32, aside: f32| at + ARROW * (ahead * towards + aside * across);
        Some([corner(1.0, 0.0), corner(-0.5, 0.866), corner(-0.5, -0.866)])
    }
}

/// Returns the position and direction of the arrow for a curve that leaves `frame` between two points.
fn exit_arrow(frame: Rect, [from, to]: [Pos2; 2]) -> Option<(Pos2, Vec2)> {
    // The frame has no room for an arrow.
    if frame.size().min_elem() < 2.0 * ARROW_INSET {
        return None;
    }
    let outwards = [
        (to.y - frame.top(), vec2(0.0, -1.0)),
        (frame.bottom() - to.y, vec2(0.0, 1.0)),
        (to.x - frame.left(), vec2(-1.0, 0.0)),
        (frame.right() - to.x, vec2(1.0, 0.0)),
    ];
    let furthest = outwards.into_iter().min_by(|(a, _), (b, _)| a.total_cmp(b));
    let (_, towards) = furthest.filter(|&(inside, _)| inside < 0.0)?;
    // Computes where the line crosses the edge.
    let axis = usize::from(towards.x == 0.0);
    let edge = if towards[axis] < 0.0 { frame.min[axis] } else { frame.max[axis] };
    let part = (edge - from[axis]) / (to[axis] - from[axis]);
    let crossing = from.lerp(to, if part.is_finite() { part.clamp(0.0, 1.0) } else { 1.0 });
    Some((frame.shrink(ARROW_INSET).clamp(crossing), towards))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_crowded_where_its_dashes_would_touch_each_other_sideways() {
        let run = |points: Vec<[f32; 2]>| -> Vec<Joint> {
            let joint = |at: [f32; 2]| Joint { at: at.into(), radius: 0.8, colour: Color32::WHITE };
            points.into_iter().map(joint).collect()
        };
        let waves = |count: usize| {
            let x = |i: usize| 400.0 * i as f32 / count as f32;
            run((0..=count).map(|i| [x(i), if i % 2 == 0 { 0.0 } else { 200.0 }]).collect())
        };
        assert!(!is_crowded(&[waves(40)], 1.6));
        assert!(is_crowded(&[waves(400)], 1.6));
        assert!(!is_crowded(&[run(vec![[0.0, 0.0], [1.0, 60.0]])], 1.6), "it has only begun");
        assert!(!is_crowded(&[], 1.6));
    }

    #[test]
    fn a_swing_of_eight_points_turns_half_as_often_as_one_of_four() {
        let swings = |samples: usize| -> Vec<Pos2> {
            let phase = |i: usize| std::f32::consts::TAU * (i as f32 + 0.2) / samples as f32;
            (0..40 * samples).map(|i| Pos2::new(i as f32, phase(i).sin())).collect()
        };
        assert!((turn_share(&swings(4)) - 0.5).abs() < 0.02);
        assert!((turn_share(&swings(8)) - 0.25).abs() < 0.02);
        assert!(turn_share(&swings(9)) < MAX_TURNS && turn_share(&swings(7)) > MAX_TURNS);
        assert_eq!(turn_share(&[]), 0.0);
    }

    #[test]
    fn a_swing_beats_with_few_samples_or_few_pixels_to_a_turn() {
        let beats = |samples: usize, points_wide: f32| {
            let at = |i: usize| {
                let turns = (i as f32 + 0.2) / samples as f32;
                Pos2::new(points_wide * turns, (std::f32::consts::TAU * turns).sin())
            };
            is_too_dense(&(0..40 * samples).map(at).collect::<Vec<_>>())
        };
        assert!(!beats(20, 12.0));
        assert!(beats(5, 12.0), "the peaks fall between the samples");
        assert!(beats(20, 3.0), "a turn is three points wide");
        assert!(!beats(20, 5.0));
        assert!(!is_too_dense(&[]));
    }

    #[test]
    fn a_line_hides_a_swing_as_fast_as_its_samples() {
        let points: Vec<Pos2> = (0..100).map(|i| Pos2::new(i as f32, 50.0)).collect();
        let swept = |wide: f32, every: usize| -> Vec<[f32; 2]> {
            let reach = |i: usize| if i.is_multiple_of(every) { wide } else { 0.0 };
            (0..100).map(|i| [50.0 + reach(i), 50.0 - reach(i)]).collect()
        };
        assert!(hides_motion(&points, &swept(40.0, 1)) && hides_motion(&points, &swept(40.0, 10)));
        assert!(!hides_motion(&points, &swept(40.0, 50)), "a rare peak");
        assert!(
            !hides_motion(&points, &swept(1.0, 1)),
            "peaks between points that are close enough"
        );
        assert!(!hides_motion(&points, &[]) && !hides_motion(&[], &[]));
    }

    #[test]
    fn an_arrow_marks_where_and_how_a_curve_leaves() {
        let frame = Rect::from_min_max(Pos2::ZERO, Pos2::new(200.0, 100.0));
        let inside = Pos2::new(60.0, 50.0);
        for (to, at, towards) in [
            ([60.0, -50.0], [60.0, ARROW_INSET], [0.0, -1.0]),
            ([100.0, 150.0], [80.0, 100.0 - ARROW_INSET], [0.0, 1.0]),
            ([-60.0, 50.0], [ARROW_INSET, 50.0], [-1.0, 0.0]),
            ([340.0, 60.0], [200.0 - ARROW_INSET, 55.0], [1.0, 0.0]),
        ] {
            assert_eq!(exit_arrow(frame, [inside, to.into()]), Some((at.into(), towards.into())));
        }
        let above = Pos2::new(60.0, -50.0);
        let at = Pos2::new(60.0, ARROW_INSET);
        assert_eq!(exit_arrow(frame, [above, above]), Some((at, vec2(0.0, -1.0))));
        assert_eq!(exit_arrow(frame, [inside, inside]), None);
    }
}
