//! Visible parts of lines through points, with as few points as the same picture needs.

use egui::{Color32, Pos2, Rect, Vec2};

/// Maximum distance of a drawn line from its points, in screen points: too small to see.
const TOLERANCE: f32 = 0.2;
/// Maximum error of a colour channel, of 255.
const TINT: f32 = 3.0;

/// A point of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Joint {
    pub(super) at: Pos2,
    /// Half the line's width here, in points.
    pub(super) radius: f32,
    pub(super) colour: Color32,
}

/// Length of a vector. Unlike egui's it is the same on every machine: `hypot` is the system's.
pub(super) fn length(vector: Vec2) -> f32 {
    vector.length_sq().sqrt()
}

/// A vector of this direction and of length 1; zero for zero.
pub(super) fn unit(vector: Vec2) -> Vec2 {
    match length(vector) {
        0.0 => Vec2::ZERO,
        length => vector / length,
    }
}

impl Joint {
    fn lerp(self, to: Joint, part: f32) -> Joint {
        Joint {
            at: self.at.lerp(to.at, part),
            radius: self.radius + part * (to.radius - self.radius),
            colour: self.colour.lerp_to_gamma(to.colour, part),
        }
    }
}

/// Visible parts of a line within a window, in runs cut off at its edges. Drops as many joints as possible, as long
/// as the line passes the dropped ones within the tolerances.
pub(super) fn visible_runs(joints: impl Iterator<Item = Joint>, window: Rect) -> Vec<Vec<Joint>> {
    let mut runs: Vec<Run> = Vec::new();
    let mut last: Option<(Joint, bool)> = None;
    for joint in joints {
        let is_inside = window.contains(joint.at);
        if let Some((last, was_inside)) = last {
            let whole = was_inside && is_inside;
            let seen = if whole { Some([last, joint]) } else { cut([last, joint], window) };
            if let Some([from, to]) = seen {
                match runs.last_mut() {
                    Some(run) if run.end == from => run.extend_to(to),
                    _ => runs.push(Run::from_segment(from, to)),
                }
            }
        }
        last = Some((joint, is_inside));
    }
    runs.into_iter().map(Run::into_joints).collect()
}

/// The part of a line within a window (Liang and Barsky).
fn cut([from, to]: [Joint; 2], window: Rect) -> Option<[Joint; 2]> {
    let along = to.at - from.at;
    let (mut first, mut last) = (0.0_f32, 1.0_f32);
    for axis in 0..2 {
        let (low, high) = (window.min[axis] - from.at[axis], window.max[axis] - from.at[axis]);
        if along[axis] == 0.0 {
            if low > 0.0 || high < 0.0 {
                return None;
            }
        } else {
            let (a, b) = (low / along[axis], high / along[axis]);
            first = first.max(a.min(b));
            last = last.min(a.max(b));
        }
    }
    // Ends within the window stay exact, because runs are joined at them.
    let at = |part: f32| match part {
        0.0 => from,
        1.0 => to,
        _ => from.lerp(to, part),
    };
    (first <= last).then(|| [at(first), at(last)])
}

/// A run under construction.
struct Run {
    /// All joints but the end.
    kept: Vec<Joint>,
    /// The piece from the last kept joint to the end.
    piece: Piece,
    end: Joint,
}

impl Run {
    fn from_segment(from: Joint, to: Joint) -> Self {
        let mut run = Self { kept: vec![from], piece: Piece::from(from), end: from };
        run.extend_to(to);
        run
    }

    fn extend_to(&mut self, to: Joint) {
        if !self.piece.try_extend(to) {
            self.kept.push(self.end);
            self.piece = Piece::from(self.end);
            self.piece.try_extend(to);
        }
        self.end = to;
    }

    fn into_joints(mut self) -> Vec<Joint> {
        self.kept.push(self.end);
        self.kept
    }
}

/// Values that change along a line: the offset to the side, the radius and the channels of the colour.
type Values = [f32; 6];

const TOLERANCES: Values = [TOLERANCE, TOLERANCE, TINT, TINT, TINT, TINT];

/// A straight piece under construction. Its values change linearly and must pass each joint that the piece replaces
/// within the tolerance. This leaves a range of slopes for each value (Sklansky and Gonzalez 1980).
struct Piece {
    from: Joint,
    /// Whether the piece has no joint beyond its start yet.
    is_new: bool,
    /// Whether the piece has kept the width and colour of its start.
    is_even: bool,
    /// Direction of the piece: that of the first joint outside the tolerance around its start.
    axis: Option<Vec2>,
    /// Distance of the last joint from the start of the piece along the axis, in points. The next joint must not be
    /// nearer to the start.
    reach: f32,
    least: Values,
    most: Values,
}

impl Piece {
    fn from(from: Joint) -> Self {
        let (least, most) = ([f32::NEG_INFINITY; 6], [f32::INFINITY; 6]);
        Self { from, is_new: true, is_even: true, axis: None, reach: 0.0, least, most }
    }

    /// Extends the piece to a joint if the piece can replace all joints up to it. Returns whether it can; a new piece
    /// reaches any joint.
    fn try_extend(&mut self, joint: Joint) -> bool {
        let is_new = std::mem::take(&mut self.is_new);
        let offset = joint.at - self.from.at;
        let tint = |i: usize| f32::from(joint.colour[i]) - f32::from(self.from.colour[i]);
        let radius = joint.radius - self.from.radius;
        let is_like_all = self.is_even && radius == 0.0 && joint.colour == self.from.colour;
        let mut values = match is_like_all {
            true => [0.0; 6],
            false => [0.0, radius, tint(0), tint(1), tint(2), tint(3)],
        };
        if self.axis.is_none() && offset.length_sq() <= TOLERANCE * TOLERANCE {
            let is_like_start = (1..6).all(|i| values[i].abs() <= TOLERANCES[i] / 2.0);
            // A colour that leaps without any distance ends the piece.
            let reaches = is_new || self.reach == 0.0 && is_like_start;
            self.reach = if is_like_start { self.reach } else { f32::INFINITY };
            return reaches;
        }
        let axis = *self.axis.get_or_insert_with(|| unit(offset));
        let along = axis.dot(offset);
        values[0] = axis.x * offset.y - axis.y * offset.x;
        if self.is_even && !is_like_all {
            // Unchanged values had to stay within the tolerance up to the last joint.
            let per_point = 1.0 / self.reach;
            for (i, tolerance) in TOLERANCES.iter().enumerate().skip(1) {
                self.least[i] = -tolerance * per_point;
                self.most[i] = tolerance * per_point;
            }
            self.is_even = false;
        }
        let changing = if self.is_even { 1 } else { values.len() };
        let is_between =
            |i: usize| self.least[i] * along <= values[i] && values[i] <= self.most[i] * along;
        let reaches = is_new || along >= self.reach && (0..changing).all(is_between);
        self.reach = along;
        let per_point = 1.0 / along;
        for i in 0..changing {
            self.least[i] = self.least[i].max((values[i] - TOLERANCES[i]) * per_point);
            self.most[i] = self.most[i].min((values[i] + TOLERANCES[i]) * per_point);
        }
        reaches
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    fn joint(at: [f32; 2]) -> Joint {
        Joint { at: at.into(), radius: 1.0, colour: Color32::WHITE }
    }

    fn line<const N: usize>(points: [[f32; 2]; N]) -> [Joint; N] {
        points.map(joint)
    }

    #[test]
    fn a_line_is_clipped_at_the_window_and_resumes_where_it_returns() {
        let window = Rect::from_min_max(pos2(0.0, 0.0), pos2(10.0, 10.0));
        let there_and_back =
            line([[1.0, 5.0], [2.0, 5.0], [2.0, 25.0], [4.0, 25.0], [4.0, 5.0], [20.0, 5.0]]);
        let expected = [
            line([[1.0, 5.0], [2.0, 5.0], [2.0, 10.0]]),
            line([[4.0, 10.0], [4.0, 5.0], [10.0, 5.0]]),
        ];
        assert_eq!(visible_runs(there_and_back.into_iter(), window), expected);
        let outside = line([[-5.0, -5.0], [-1.0, 20.0], [20.0, 40.0]]);
        assert!(visible_runs(outside.into_iter(), window).is_empty());
    }

    #[test]
    fn clipping_keeps_width_and_brightness_at_the_cut() {
        let window = Rect::from_min_max(pos2(0.0, 0.0), pos2(10.0, 10.0));
        let from = Joint { radius: 1.0, colour: Color32::from_gray(200), ..joint([5.0, 5.0]) };
        let to = Joint { radius: 3.0, colour: Color32::from_gray(100), ..joint([15.0, 5.0]) };
        let half = Joint { radius: 2.0, colour: Color32::from_gray(150), ..joint([10.0, 5.0]) };
        assert_eq!(visible_runs([from, to].into_iter(), window), [[from, half]]);
    }

    fn simple(line: &[Joint]) -> Vec<Joint> {
        visible_runs(line.iter().copied(), Rect::EVERYTHING).concat()
    }

    /// Whether a straight piece looks the same without the joint between its ends.
    fn stands_for([from, to]: [Joint; 2], between: Joint) -> bool {
        let along = to.at - from.at;
        let part = (between.at - from.at).dot(along) / along.length_sq().max(f32::MIN_POSITIVE);
        let there = from.lerp(to, part.clamp(0.0, 1.0));
        let is_near = |a: f32, b: f32, tolerance: f32| (a - b).abs() <= tolerance;
        let tint = |i: usize| is_near(between.colour[i].into(), there.colour[i].into(), TINT + 1.0);
        is_near(between.at.distance(there.at), 0.0, TOLERANCE + 1e-4)
            && is_near(between.radius, there.radius, TOLERANCE + 1e-4)
            && (0..4).all(tint)
    }

    #[test]
    fn simplifying_keeps_a_line_within_the_tolerance_with_its_ends_and_spikes() {
        let mut wave: Vec<Joint> =
            (0..400).map(|i| i as f32 / 8.0).map(|x| joint([x, 20.0 * (x / 5.0).sin()])).collect();
        wave[200].at.y += 30.0;
        let mut fading = wave.clone();
        for (i, joint) in fading.iter_mut().enumerate() {
            joint.radius = 1.0 + (i as f32 / 90.0).cos();
            joint.colour = Color32::from_rgb(100 + (i / 3) as u8, 200 - (i / 40) as u8, 0);
        }
        // It nearly comes to rest, changes its colour there, and returns the way it came.
        let mut resting: Vec<Joint> =
            (0..150).map(|i| joint([100.0 * 0.9_f32.powi(i), (i as f32).sin() / 30.0])).collect();
        resting[120..].iter_mut().for_each(|joint| joint.colour = Color32::RED);
        resting.extend((0..50).map(|i| joint([2.0 * i as f32, 0.0])));
        for line in [&wave, &fading, &resting] {
            let kept = simple(line);
            assert!(kept.len() < line.len() / 3, "{} of {}", kept.len(), line.len());
            assert_eq!((kept.first(), kept.last()), (line.first(), line.last()));
            for &joint in line {
                assert!(
                    kept.windows(2).any(|ends| stands_for([ends[0], ends[1]], joint)),
                    "{joint:?}"
                );
            }
        }
        assert!(simple(&wave).contains(&wave[200]));
        let still = [joint([5.0, 5.0]); 9];
        assert_eq!([9, 1, 0].map(|count| simple(&still[..count]).len()), [2, 0, 0]);
    }

    #[test]
    fn simplifying_keeps_joints_where_width_or_colour_changes() {
        let straight: Vec<Joint> = (0..30).map(|i| joint([i as f32, 0.0])).collect();
        assert_eq!(simple(&straight).len(), 2);
        let mut wider = straight.clone();
        wider[10..].iter_mut().for_each(|joint| joint.radius = 5.0);
        assert_eq!(simple(&wider), [wider[0], wider[9], wider[10], wider[29]]);
        let mut red = straight;
        red[10..].iter_mut().for_each(|joint| joint.colour = Color32::RED);
        assert_eq!(simple(&red), [red[0], red[9], red[10], red[29]]);
    }
}
