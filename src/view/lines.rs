//! Lines through points, as few quads as show the same picture.
//!
//! A vertex says how wide its line is there, and how far across and along the line it lies, in pixels, so that
//! a shader can tell how much of a pixel is covered.

use bytemuck::{Pod, Zeroable};
use egui::{Color32, Pos2, Rect, Vec2, vec2};

/// How far a line may be drawn from its points, in points of the screen: less than anybody sees.
const TOLERANCE: f32 = 0.2;
/// How far a channel of its colour may be from theirs, of 255.
const TINT: f32 = 3.0;
/// Corners sharper than this, the cosine of the turn, are not mitred: the tip would stick out.
const SHARPEST_MITRE: f32 = 0.0;

/// A point of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Joint {
    pub(super) at: Pos2,
    /// Half the line's width here, in points.
    pub(super) radius: f32,
    pub(super) colour: Color32,
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

/// What shows of a line within a window, cut off at its edges, with fewer joints.
pub(super) fn shown(joints: impl Iterator<Item = Joint>, window: Rect) -> Vec<Vec<Joint>> {
    visible(joints, window).iter().map(|run| simple(run)).collect()
}

/// The runs of a line within a window, cut off at its edges.
fn visible(joints: impl Iterator<Item = Joint>, window: Rect) -> Vec<Vec<Joint>> {
    let most = joints.size_hint().0.max(2);
    let mut runs: Vec<Vec<Joint>> = Vec::new();
    let mut last: Option<(Joint, bool)> = None;
    for joint in joints {
        let is_inside = window.contains(joint.at);
        if let Some((last, was_inside)) = last {
            let whole = was_inside && is_inside;
            let seen = if whole { Some([last, joint]) } else { cut([last, joint], window) };
            if let Some([from, to]) = seen {
                match runs.last_mut() {
                    Some(run) if run.last() == Some(&from) => run.push(to),
                    _ => {
                        let mut run = Vec::with_capacity(most);
                        run.extend([from, to]);
                        runs.push(run);
                    }
                }
            }
        }
        last = Some((joint, is_inside));
    }
    runs
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
    // The ends themselves where they are within: runs are joined by them.
    let at = |part: f32| match part {
        0.0 => from,
        1.0 => to,
        _ => from.lerp(to, part),
    };
    (first <= last).then(|| [at(first), at(last)])
}

/// The same line with fewer joints, nowhere further than the tolerances from those left out.
fn simple(line: &[Joint]) -> Vec<Joint> {
    let Some(&first) = line.first() else { return Vec::new() };
    let mut kept = vec![first];
    let mut piece = Piece::from(first);
    for ends in line.windows(2) {
        if !piece.reaches(ends[1]) {
            kept.push(ends[0]);
            piece = Piece::from(ends[0]);
            piece.reaches(ends[1]);
        }
    }
    kept.extend(line[1..].last());
    kept
}

/// What changes along a line: how far it lies to the side, its radius and the channels of its colour.
type Values = [f32; 6];

const TOLERANCES: Values = [TOLERANCE, TOLERANCE, TINT, TINT, TINT, TINT];

/// A straight piece that is being made longer. Whatever changes along it runs linearly, and has to pass within the
/// tolerance of every joint that the piece stands for: what is left are ranges of slopes (Sklansky and Gonzalez 1980).
struct Piece {
    from: Joint,
    /// Whether it has no joint beyond its start yet.
    is_new: bool,
    /// Its direction, that of the first joint out of the tolerance round its start.
    axis: Option<Vec2>,
    /// How far along it the last joint lies, in points; the next is no nearer.
    reach: f32,
    least: Values,
    most: Values,
}

impl Piece {
    fn from(from: Joint) -> Self {
        let (least, most) = ([f32::NEG_INFINITY; 6], [f32::INFINITY; 6]);
        Self { from, is_new: true, axis: None, reach: 0.0, least, most }
    }

    /// Has the piece end at a joint, and stand for it from then on, if it can. A new piece reaches any.
    fn reaches(&mut self, joint: Joint) -> bool {
        let is_new = std::mem::take(&mut self.is_new);
        let offset = joint.at - self.from.at;
        let tint = |i: usize| f32::from(joint.colour[i]) - f32::from(self.from.colour[i]);
        let radius = joint.radius - self.from.radius;
        let mut values = [0.0, radius, tint(0), tint(1), tint(2), tint(3)];
        if self.axis.is_none() && offset.length_sq() <= TOLERANCE * TOLERANCE {
            let is_like_start = (1..6).all(|i| values[i].abs() <= TOLERANCES[i] / 2.0);
            // Where the colour leaps without a way for it, nothing beyond is reached.
            let reaches = is_new || self.reach == 0.0 && is_like_start;
            self.reach = if is_like_start { self.reach } else { f32::INFINITY };
            return reaches;
        }
        let axis = *self.axis.get_or_insert_with(|| offset.normalized());
        let along = axis.dot(offset);
        values[0] = axis.x * offset.y - axis.y * offset.x;
        let is_between =
            |i: usize| self.least[i] * along <= values[i] && values[i] <= self.most[i] * along;
        let reaches = is_new || along >= self.reach && (0..6).all(is_between);
        self.reach = along;
        let per_point = 1.0 / along;
        for i in 0..6 {
            self.least[i] = self.least[i].max((values[i] - TOLERANCES[i]) * per_point);
            self.most[i] = self.most[i].min((values[i] + TOLERANCES[i]) * per_point);
        }
        reaches
    }
}

/// A vertex in `shaders/lines.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(super) struct LineVertex {
    /// In points.
    pub(super) at: [f32; 2],
    /// Half the line's width here, and how far from its middle.
    pub(super) across_px: [f32; 2],
    /// How far along the line, and the drawn length and the gap of its dashes.
    pub(super) along_px: [f32; 3],
    pub(super) colour: Color32,
}

/// Lines of one dash pattern, as triangles.
#[derive(Clone, Debug)]
pub(super) struct LineMesh {
    /// Drawn length and gap in points; a gap of 0 is solid.
    pub(super) dash: [f32; 2],
    pub(super) vertices: Vec<LineVertex>,
    pub(super) indices: Vec<u32>,
}

impl LineMesh {
    pub(super) fn new(dash: [f32; 2]) -> Self {
        Self { dash, vertices: Vec::new(), indices: Vec::new() }
    }

    /// Adds a filled outline that can be seen whole from the mean of its corners, its edge blurred over a pixel.
    pub(super) fn fill(&mut self, corners: &[(Pos2, Color32)], px_per_point: f32) {
        /// Wider than a pixel on both sides: it is all covered.
        const WHOLE_PX: [f32; 2] = [1.0, 0.0];
        let count = corners.len();
        if count < 3 {
            return;
        }
        let first = self.vertices.len() as u32;
        let mut add = |at: Pos2, colour: Color32| {
            let (at, along_px) = (at.into(), [0.0, 1.0, 0.0]);
            self.vertices.push(LineVertex { at, across_px: WHOLE_PX, along_px, colour });
        };
        let mean = |channel: usize| {
            let sum: u32 = corners.iter().map(|(_, colour)| u32::from(colour[channel])).sum();
            (sum / count as u32) as u8
        };
        let middle =
            corners.iter().fold(Vec2::ZERO, |sum, (at, _)| sum + at.to_vec2()) / count as f32;
        let middle = middle.to_pos2();
        add(middle, Color32::from_rgba_premultiplied(mean(0), mean(1), mean(2), mean(3)));
        for (i, &(at, colour)) in corners.iter().enumerate() {
            let [before, after] = [i + count - 1, i + 1].map(|place| corners[place % count].0);
            let along = (after - before).normalized();
            let normal = vec2(along.y, -along.x);
            let out = if normal.dot(at - middle) < 0.0 { -normal } else { normal };
            let half = out * (0.5 / px_per_point);
            add(at - half, colour);
            add(at + half, Color32::TRANSPARENT);
        }
        for i in 0..count as u32 {
            let next = (i + 1) % count as u32;
            let [inner, outer] = [1, 2].map(|side| first + 2 * i + side);
            let [next_inner, next_outer] = [1, 2].map(|side| first + 2 * next + side);
            self.indices.extend([first, inner, next_inner]);
            self.indices.extend([inner, outer, next_inner, next_inner, outer, next_outer]);
        }
    }

    /// Adds a line as quads from joint to joint, mitred where they meet.
    pub(super) fn add(&mut self, line: &[Joint], px_per_point: f32) {
        let [drawn_px, gap_px] = self.dash.map(|points| points * px_per_point);
        self.vertices.reserve(2 * line.len());
        self.indices.reserve(6 * line.len());
        let vertices = &mut self.vertices;
        let mut add = |joint: Joint, normal: Vec2, along: f32| {
            let half_px = joint.radius * px_per_point;
            // Half a pixel of blur, and a little for the corners of pixels.
            let reach_px = half_px + 1.0;
            for across_px in [reach_px, -reach_px] {
                vertices.push(LineVertex {
                    at: (joint.at + normal * (across_px / px_per_point)).into(),
                    across_px: [half_px, across_px],
                    along_px: [along * px_per_point, drawn_px, gap_px],
                    colour: joint.colour,
                });
            }
            vertices.len() as u32 - 2
        };
        // The pair of vertices that the next quad shares with this one.
        let mut shared = None;
        let mut done = 0.0;
        for (index, ends) in line.windows(2).enumerate() {
            let along = (ends[1].at - ends[0].at).normalized();
            let from = shared.unwrap_or_else(|| add(ends[0], along.rot90(), done));
            done += ends[0].at.distance(ends[1].at);
            let next = line.get(index + 2).map(|next| (next.at - ends[1].at).normalized());
            let mitre = next.filter(|&next| along.dot(next) > SHARPEST_MITRE);
            let normal = mitre.map_or(along, |next| (along + next) / (1.0 + along.dot(next)));
            let to = add(ends[1], normal.rot90(), done);
            shared = mitre.map(|_| to);
            self.indices.extend([from, from + 1, to, to, from + 1, to + 1]);
        }
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
    fn a_line_is_cut_off_at_the_window_and_taken_up_again_where_it_returns() {
        let window = Rect::from_min_max(pos2(0.0, 0.0), pos2(10.0, 10.0));
        let there_and_back =
            line([[1.0, 5.0], [2.0, 5.0], [2.0, 25.0], [4.0, 25.0], [4.0, 5.0], [20.0, 5.0]]);
        let expected = [
            line([[1.0, 5.0], [2.0, 5.0], [2.0, 10.0]]),
            line([[4.0, 10.0], [4.0, 5.0], [10.0, 5.0]]),
        ];
        assert_eq!(visible(there_and_back.into_iter(), window), expected);
        let outside = line([[-5.0, -5.0], [-1.0, 20.0], [20.0, 40.0]]);
        assert!(visible(outside.into_iter(), window).is_empty());
    }

    #[test]
    fn a_line_is_as_wide_and_as_bright_at_the_cut_as_it_was_there() {
        let window = Rect::from_min_max(pos2(0.0, 0.0), pos2(10.0, 10.0));
        let from = Joint { radius: 1.0, colour: Color32::from_gray(200), ..joint([5.0, 5.0]) };
        let to = Joint { radius: 3.0, colour: Color32::from_gray(100), ..joint([15.0, 5.0]) };
        let half = Joint { radius: 2.0, colour: Color32::from_gray(150), ..joint([10.0, 5.0]) };
        assert_eq!(visible([from, to].into_iter(), window), [[from, half]]);
    }

    /// Whether a straight piece shows what it would with one more joint.
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
    fn a_simpler_line_keeps_its_ends_its_spikes_and_within_the_tolerance_all_else() {
        let mut wave: Vec<Joint> =
            (0..400).map(|i| i as f32 / 8.0).map(|x| joint([x, 20.0 * (x / 5.0).sin()])).collect();
        wave[200].at.y += 30.0;
        let mut fading = wave.clone();
        for (i, joint) in fading.iter_mut().enumerate() {
            joint.radius = 1.0 + (i as f32 / 90.0).cos();
            joint.colour = Color32::from_rgb(100 + (i / 3) as u8, 200 - (i / 40) as u8, 0);
        }
        // It comes to rest, nearly, changes its colour there, and goes back the way it came.
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
        assert_eq!(simple(&still).len(), 2);
        assert_eq!((simple(&still[..1]).len(), simple(&[]).len()), (1, 0));
    }

    #[test]
    fn a_straight_line_keeps_the_joints_where_it_changes_its_width_or_its_colour() {
        let straight: Vec<Joint> = (0..30).map(|i| joint([i as f32, 0.0])).collect();
        assert_eq!(simple(&straight).len(), 2);
        let mut wider = straight.clone();
        wider[10..].iter_mut().for_each(|joint| joint.radius = 5.0);
        assert_eq!(simple(&wider), [wider[0], wider[9], wider[10], wider[29]]);
        let mut red = straight;
        red[10..].iter_mut().for_each(|joint| joint.colour = Color32::RED);
        assert_eq!(simple(&red), [red[0], red[9], red[10], red[29]]);
    }

    #[test]
    fn quads_are_joined_at_the_corners_of_a_line_and_not_at_its_spikes() {
        let strip_of = |line: &[Joint]| {
            let mut mesh = LineMesh::new([6.0, 4.0]);
            mesh.add(line, 1.0);
            mesh
        };
        let bend = strip_of(&line([[0.0, 0.0], [10.0, 0.0], [20.0, 5.0]]));
        assert_eq!((bend.vertices.len(), bend.indices.len()), (6, 12));
        let spike = strip_of(&line([[0.0, 0.0], [10.0, 0.0], [0.0, 1.0]]));
        assert_eq!((spike.vertices.len(), spike.indices.len()), (8, 12));
        for vertex in &bend.vertices {
            assert_eq!((vertex.across_px[0], vertex.across_px[1].abs()), (1.0, 2.0));
            assert_eq!(vertex.along_px[1..], [6.0, 4.0]);
        }
        let length = 10.0 + 125.0_f32.sqrt();
        assert_eq!([0, 2, 4].map(|i| bend.vertices[i].along_px[0]), [0.0, 10.0, length]);
        assert_eq!(bend.vertices[0].at, [0.0, -2.0]);
    }
}
