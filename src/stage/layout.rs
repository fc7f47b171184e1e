//! Divides the stage into cells.

use glam::DVec2;

use super::Rect;

/// Space around the stage and between its cells, in points, and its largest share of a cell's room.
const MARGIN: f32 = 6.0;
const MAX_MARGIN: f32 = 0.15;

/// Divides the stage into bands, one below the other, with heights in these proportions.
pub(super) fn bands(stage: Rect, heights: &[f32]) -> Vec<Rect> {
    let (room, all) = ((stage.max[1] - stage.min[1]).max(0.0), heights.iter().sum::<f32>());
    let mut top = stage.min[1];
    let band = heights.iter().map(|height| {
        let min = [stage.min[0], top];
        top += room * height / all;
        // Rounding must not exceed the stage.
        Rect { min, max: [stage.max[0], top.min(stage.min[1] + room)] }
    });
    band.collect()
}

/// The cells of a grid, row by row.
pub(super) fn grid(stage: Rect, rows: usize, columns: usize) -> Vec<Rect> {
    let sides = |axis: usize, count: usize| {
        let room = (stage.max[axis] - stage.min[axis]).max(0.0);
        let margin = MARGIN.min(MAX_MARGIN * room / count as f32);
        let side = (room - margin * (count as f32 + 1.0)) / count as f32;
        move |place: usize| {
            let least = stage.min[axis] + margin + place as f32 * (side + margin);
            (least, least + side)
        }
    };
    let (across, down) = (sides(0, columns), sides(1, rows));
    let cell = |row: usize, column: usize| {
        let (x, y) = (across(column), down(row));
        Rect { min: [x.0, y.0], max: [x.1, y.1] }
    };
    (0..rows).flat_map(|row| (0..columns).map(move |column| cell(row, column))).collect()
}

/// `count` cells in rows, divided so that a picture of this `shape` is as large as possible in each.
pub(super) fn mosaic(stage: Rect, count: usize, shape: DVec2) -> Vec<Rect> {
    let scale = |cells: &Vec<Rect>| {
        let Rect { min, max } = cells[0];
        (f64::from(max[0] - min[0]) / shape.x).min(f64::from(max[1] - min[1]) / shape.y)
    };
    let grids = (1..=count).map(|columns| grid(stage, count.div_ceil(columns), columns));
    let mut cells = grids.max_by(|a, b| scale(a).total_cmp(&scale(b))).unwrap_or_default();
    cells.truncate(count);
    cells
}
