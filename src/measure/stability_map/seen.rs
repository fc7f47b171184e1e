//! Lines of equal damping of a spring in an engine, as a player sees it.

use super::contour::contour;
use super::{Corners, Meter};
use crate::scene::LaneSpec;
use crate::tools::port::Setup;

/// A line of equal damping ratio on a stability map.
#[derive(Clone, Debug, PartialEq)]
pub struct DampingLine {
    /// The damping ratio that a player sees.
    pub damping_ratio: f64,
    /// Points of the line, in the coordinates of a region's boundary.
    pub points: Vec<[f64; 2]>,
}

/// Damping ratios of the lines.
const RATIOS: [f64; 8] = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0];
/// Largest relative difference between the damping ratio at a point and that of its line. A point that is further off
/// lies where a player sees no swing.
const NEAR: f64 = 0.02;
/// Work of a point, in evaluations of one coordinate.
const WORK_OF_POINT: u64 = 20;

/// Returns the lines of an engine. `joint_at` returns stiffness in 1/s² and damping in 1/s, each per unit of mass, at a
/// value of the mapped parameter.
pub(super) async fn damping_lines(
    spec: &LaneSpec,
    corners: &Corners,
    joint_at: impl Fn(f64) -> Option<[f64; 2]>,
    meter: &Meter,
) -> Vec<DampingLine> {
    let mut modes = spec.method.engine.map_or(&[][..], |engine| engine.modes).iter();
    let Some(mode) = modes.find(|mode| !mode.is_explicit) else { return Vec::new() };
    let seen = |[x, y]: [f64; 2]| {
        let tick_hz = libm::pow(10.0, x);
        let setup = Setup { method: spec.method, mode, tick_hz, substeps: spec.substeps };
        setup.visible_motion(joint_at(libm::pow(10.0, y))?)?.damping_ratio()
    };
    let [columns, rows] = corners.counts();
    let row = |j| (0..columns).map(|i| seen(corners.at([i, j]))).collect();
    let at_corners: Vec<Vec<Option<f64>>> = (0..rows).map(row).collect();
    let mut lines = Vec::new();
    for damping_ratio in RATIOS {
        // A motion that is damped so strongly that it does not swing is above every line.
        let is_above = |seen: Option<f64>| seen.is_none_or(|ratio| ratio >= damping_ratio);
        let is_near = |point: &[f64; 2]| {
            seen(*point).is_some_and(|ratio| (ratio / damping_ratio - 1.0).abs() < NEAR)
        };
        let found = contour(
            corners,
            |[i, j]| is_above(at_corners[j][i]),
            |x, j| is_above(seen([x, corners.at([0, j])[1]])),
            |point| is_above(seen(point)),
            (meter, [WORK_OF_POINT; 2]),
        )
        .await;
        let pieces = |line: &Vec<[f64; 2]>| {
            let pieces = line.split(|point| !is_near(point)).filter(|piece| piece.len() > 1);
            pieces.map(<[_]>::to_vec).collect::<Vec<_>>()
        };
        let of_ratio = found.boundary.iter().flat_map(pieces);
        lines.extend(of_ratio.map(|points| DampingLine { damping_ratio, points }));
    }
    lines
}
