//! Bands for curves that are too crowded to draw as a line. Like an oscilloscope, a band fills each column of pixels
//! from the curve's least to its greatest value. A line through few samples of a fast swing would beat against pixels
//! and samples.

use std::ops::Range;

use egui::epaint::Mesh;
use egui::{Color32, Pos2, Rect, pos2};

use crate::lines::{Joint, visible_runs};

/// Opacity of a band between its edges.
const FILL: f32 = 0.35;
/// Width of the edges of a band, in points.
const EDGE: f32 = 1.0;

/// Number of the curve's points on either side of a column that the column also spans. Among twice this number, some
/// points lie near the peaks of a swing, at any phase of the samples.
const NEIGHBOURS: f32 = 8.0;

/// Least and greatest y of a curve in a column, or `None` if the curve does not pass through the column.
type Span = Option<(f32, f32)>;

/// A band without a gap. It has columns of equal width, and the y of both edges in each column.
pub(super) struct Band {
    left: f32,
    step: f32,
    heights: Vec<[f32; 2]>,
}

/// Returns the bands of a curve of this width. The x of `points` never decreases. The bands cover the `seen` rectangle
/// in columns `step` points wide. `swept` holds the heights that the curve reaches on the way to each point, or nothing
/// if they are unknown.
pub(super) fn of(
    points: &[Pos2],
    swept: &[[f32; 2]],
    width: f32,
    (seen, step): (Rect, f32),
) -> Vec<Band> {
    let columns = Columns { left: seen.left(), step, count: (seen.width() / step) as usize + 1 };
    let spans = widened(&columns.spans(points, swept), columns.columns_between_points(points));
    let half = width / 2.0;
    let band = |stretch: Range<usize>| Band {
        left: columns.left + step * stretch.start as f32,
        step,
        heights: spans[stretch]
            .iter()
            .flatten()
            .map(|(low, high)| [low - half, high + half])
            .collect(),
    };
    stretches(&spans).into_iter().map(band).collect()
}

impl Band {
    /// Returns the left edge of each column, and the y of both edges of the band there.
    fn columns(&self) -> impl DoubleEndedIterator<Item = (f32, [f32; 2])> {
        (0..self.heights.len()).map(|i| (self.left + self.step * i as f32, self.heights[i]))
    }

    /// Returns the filled area between the edges.
    pub(super) fn fill(&self, colour: Color32) -> Mesh {
        let mut fill = Mesh::default();
        for (x, heights) in self.columns() {
            let first = fill.vertices.len() as u32;
            for y in heights {
                fill.colored_vertex(pos2(x, y), colour.gamma_multiply(FILL));
                fill.colored_vertex(pos2(x + self.step, y), colour.gamma_multiply(FILL));
            }
            fill.add_triangle(first, first + 1, first + 2);
            fill.add_triangle(first + 1, first + 2, first + 3);
        }
        fill
    }

    /// Returns the points of the upper (0) or the lower (1) edge.
    fn edge(&self, i: usize) -> impl DoubleEndedIterator<Item = Pos2> {
        self.columns().map(move |(x, heights)| pos2(x + self.step / 2.0, heights[i]))
    }

    /// Returns the corners of the area between the edges, and the colour of the area.
    pub(super) fn outline(&self, colour: Color32) -> (Vec<Pos2>, Color32) {
        (self.edge(0).chain(self.edge(1).rev()).collect(), colour.gamma_multiply(FILL))
    }

    /// Returns the parts of both edges that are visible in a window.
    pub(super) fn edges(&self, colour: Color32, window: Rect) -> Vec<Vec<Joint>> {
        let joint = |at: Pos2| Joint { at, radius: EDGE / 2.0, colour };
        let edge = |i: usize| visible_runs(self.edge(i).map(joint), window.expand(EDGE));
        [0, 1].into_iter().flat_map(edge).collect()
    }
}

/// Columns of equal width next to each other.
struct Columns {
    left: f32,
    step: f32,
    count: usize,
}

impl Columns {
    /// Returns the extent in each column of the line through `points`, and of the heights `swept` between the points.
    /// The line breaks off at a point that is not finite.
    fn spans(&self, points: &[Pos2], swept: &[[f32; 2]]) -> Vec<Span> {
        let mut spans = vec![None; self.count];
        for (i, &to) in points.iter().enumerate() {
            let from = i.checked_sub(1).map(|before| points[before]);
            let from = from.filter(|from| from.is_finite()).unwrap_or(to);
            if to.is_finite() {
                self.extend_spans([from, to], &mut spans);
                let between = from.y.min(to.y)..=from.y.max(to.y);
                let beyond = swept.get(i).into_iter().flatten().filter(|y| !between.contains(y));
                for &y in beyond {
                    self.extend_spans([pos2(from.x, y), pos2(to.x, y)], &mut spans);
                }
            }
        }
        spans
    }

    fn extend_spans(&self, [from, to]: [Pos2; 2], spans: &mut [Span]) {
        let (first, last) = (from.x.min(to.x), from.x.max(to.x));
        let place = |x: f32| ((x - self.left) / self.step).floor();
        if last < self.left || place(first) >= self.count as f32 {
            return;
        }
        let end = (place(last) as usize).min(self.count - 1);
        for (column, span) in spans.iter_mut().enumerate().take(end + 1).skip(place(first) as usize)
        {
            let left = self.left + self.step * column as f32;
            let height = |x: f32| {
                let part = (x.clamp(first, last) - from.x) / (to.x - from.x);
                if part.is_finite() { from.y + part * (to.y - from.y) } else { to.y }
            };
            let ends = match first == last {
                true => [from.y, to.y],
                false => [height(left), height(left + self.step)],
            };
            for y in ends {
                let (low, high) = span.unwrap_or((y, y));
                *span = Some((low.min(y), high.max(y)));
            }
        }
    }

    /// Returns the average number of columns between neighbouring points.
    fn columns_between_points(&self, points: &[Pos2]) -> f32 {
        let mut finite = points.iter().filter(|point| point.is_finite());
        let Some((first, last)) = finite.next().zip(finite.next_back()) else { return 0.0 };
        (last.x - first.x) / self.step / points.len() as f32
    }
}

/// Widens each span to include the spans within [`NEIGHBOURS`] points of the curve, which lie `apart` columns from each
/// other. A gap stays a gap, and no span widens across it.
fn widened(spans: &[Span], apart: f32) -> Vec<Span> {
    let reach = (NEIGHBOURS * apart).ceil() as usize;
    let mut widened = spans.to_vec();
    for stretch in stretches(spans) {
        for column in stretch.clone() {
            let beside = column.saturating_sub(reach).max(stretch.start)
                ..(column + reach + 1).min(stretch.end);
            widened[column] = spans[beside]
                .iter()
                .flatten()
                .copied()
                .reduce(|(low, high), (l, h)| (low.min(l), high.max(h)));
        }
    }
    widened
}

/// Returns the ranges of columns without a gap.
fn stretches(spans: &[Span]) -> Vec<Range<usize>> {
    let mut stretches: Vec<Range<usize>> = Vec::new();
    for (column, _) in spans.iter().enumerate().filter(|(_, span)| span.is_some()) {
        match stretches.last_mut() {
            Some(last) if last.end == column => last.end += 1,
            _ => stretches.push(column..column + 1),
        }
    }
    stretches
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: Columns = Columns { left: 10.0, step: 0.5, count: 8 };

    fn spans(points: &[[f32; 2]]) -> Vec<Span> {
        COLUMNS.spans(&points.iter().map(|&at| at.into()).collect::<Vec<_>>(), &[])
    }

    #[test]
    fn a_column_spans_the_part_of_the_line_in_it() {
        // The curve goes up and down within one column, then along a slope over two more.
        let found = spans(&[[10.1, 0.0], [10.2, 4.0], [10.3, -2.0], [10.5, 0.0], [11.5, 2.0]]);
        assert_eq!(found[0], Some((-2.0, 4.0)));
        assert_eq!(found[1], Some((0.0, 1.0)));
        assert_eq!(found[2], Some((1.0, 2.0)));
        assert_eq!(found[3], Some((2.0, 2.0)));
        assert_eq!(found[4..], [None; 4]);
        let upright = spans(&[[10.1, 3.0], [10.1, -3.0]]);
        assert_eq!(upright[0], Some((-3.0, 3.0)));
    }

    #[test]
    fn a_column_includes_the_range_swept_before_a_point() {
        let points = [pos2(10.2, 1.0), pos2(11.2, 1.0), pos2(12.2, 1.0)];
        let found = COLUMNS.spans(&points, &[[1.0; 2], [-5.0, 7.0], [1.0; 2]]);
        assert_eq!(found[..3], [Some((-5.0, 7.0)); 3]);
        assert_eq!(found[3..5], [Some((1.0, 1.0)); 2]);
    }

    #[test]
    fn lines_are_clipped_to_the_columns() {
        let through = spans(&[[8.0, 0.0], [16.0, 8.0]]);
        assert_eq!((through[0], through[7]), (Some((2.0, 2.5)), Some((5.5, 6.0))));
        assert_eq!(spans(&[[2.0, 1.0], [9.9, 1.0]]), [None; 8]);
        assert_eq!(spans(&[[14.1, 1.0], [1e9, 1.0]]), [None; 8]);
    }

    #[test]
    fn a_single_sample_is_a_span_of_zero_height() {
        assert_eq!(spans(&[]), [None; 8]);
        let one = spans(&[[11.2, 5.0]]);
        assert_eq!(one[2], Some((5.0, 5.0)));
        assert_eq!(one.iter().flatten().count(), 1);
        assert_eq!(COLUMNS.columns_between_points(&[pos2(11.2, 5.0)]), 0.0);
        assert_eq!(widened(&one, 0.0), one);
    }

    #[test]
    fn a_line_breaks_at_non_finite_values() {
        let found = spans(&[[10.2, 1.0], [11.2, f32::NAN], [12.2, 3.0], [12.7, f32::INFINITY]]);
        assert_eq!(found[0], Some((1.0, 1.0)));
        assert_eq!(found[1..4], [None; 3]);
        assert_eq!(found[4], Some((3.0, 3.0)));
        assert_eq!(found[5..], [None; 3]);
        assert_eq!(stretches(&found), [0..1, 4..5]);
    }

    #[test]
    fn a_band_is_widened_by_its_neighbours_up_to_its_gaps() {
        let at = |y: f32| Some((y, y));
        let row = [at(1.0), at(5.0), at(2.0), None, at(9.0), at(3.0)];
        // A span widens by one column on either side if points lie an eighth of a column apart.
        let first = [Some((1.0, 5.0)), Some((1.0, 5.0)), Some((2.0, 5.0))];
        let second = [Some((3.0, 9.0)); 2];
        assert_eq!(widened(&row, 0.125), [&first[..], &[None], &second].concat());
        assert_eq!(widened(&row, 0.0), row);
    }

    #[test]
    fn the_band_of_a_swing_is_as_wide_as_the_swing_for_any_samples() {
        for turns_per_sample in [0.32, 0.41, 0.618, 4.77] {
            let swing = |i: usize| libm::sinf(std::f32::consts::TAU * turns_per_sample * i as f32);
            let points: Vec<Pos2> = (0..2000).map(|i| pos2(0.2 * i as f32, swing(i))).collect();
            let columns = Columns { left: 0.0, step: 1.0, count: 400 };
            let band =
                widened(&columns.spans(&points, &[]), columns.columns_between_points(&points));
            for (low, high) in band.into_iter().map(|span| span.unwrap()) {
                assert!(low < -0.95 && high > 0.95, "{turns_per_sample}: {low} to {high}");
            }
        }
    }
}
