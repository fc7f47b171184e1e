//! Mapping between a plane and a rectangle of the screen.

use egui::{Pos2, Rect, pos2};

use super::axis::{AxisMark, AxisScale};

/// Lowest and highest value along each axis of a plane.
pub(crate) type Bounds = [[f64; 2]; 2];

/// Distance outside the plot at which a point may still be drawn, in widths or heights of the plot.
const FAR_OUTSIDE: f64 = 10.0;

/// A rectangle of the screen that shows a rectangle of a plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlotArea {
    pub(crate) rect: Rect,
    pub(crate) bounds: Bounds,
}

impl PlotArea {
    /// Returns the screen position of a point of the plane. A point far outside moves nearer, so that the painter's f32
    /// can represent it. It stays far enough out for a line to leave the plot at its own slope.
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> Pos2 {
        pos2(self.rect.left() + self.part(0, x) * self.rect.width(), self.height(y))
    }

    /// Returns the screen y of a value on the vertical axis.
    pub(crate) fn height(&self, y: f64) -> f32 {
        self.rect.bottom() - self.part(1, y) * self.rect.height()
    }

    fn part(&self, axis: usize, value: f64) -> f32 {
        let [low, high] = self.bounds[axis];
        ((value - low) * (1.0 / (high - low))).clamp(-FAR_OUTSIDE, 1.0 + FAR_OUTSIDE) as f32
    }

    /// Returns the screen lengths, to the right and up, of a difference between two points of the plane.
    pub(crate) fn lengths(&self, difference: [f64; 2]) -> [f64; 2] {
        let size = [self.rect.width(), self.rect.height()].map(f64::from);
        std::array::from_fn(|axis| {
            let [low, high] = self.bounds[axis];
            difference[axis] / (high - low) * size[axis]
        })
    }

    /// Returns the point of the plane at a screen position, after moving that position into the rectangle.
    pub(crate) fn point(&self, at: Pos2) -> [f64; 2] {
        let at = self.rect.clamp(at);
        let parts = [
            (at.x - self.rect.left()) / self.rect.width(),
            (self.rect.bottom() - at.y) / self.rect.height(),
        ];
        std::array::from_fn(|axis| {
            let [low, high] = self.bounds[axis];
            low + (high - low) * f64::from(parts[axis])
        })
    }

    /// Returns the round marks along an axis of this scale. They lie at least `apart` points from each other, unless
    /// fewer than three would then fit.
    pub(crate) fn marks(&self, axis: usize, scale: AxisScale, apart: f64) -> Vec<AxisMark> {
        let room = [self.rect.width(), self.rect.height()][axis];
        scale.marks(self.bounds[axis], room, apart)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plane_and_screen_points_convert_back_and_forth() {
        let rect = Rect::from_min_max(pos2(100.0, 50.0), pos2(300.0, 250.0));
        let area = PlotArea { rect, bounds: [[-1.0, 3.0], [0.0, 5.0]] };
        assert_eq!(area.at([-1.0, 0.0]), rect.left_bottom());
        assert_eq!(area.at([3.0, 5.0]), rect.right_top());
        let [x, y] = area.point(area.at([0.5, 4.0]));
        assert!((x - 0.5).abs() < 1e-6 && (y - 4.0).abs() < 1e-6, "{x}, {y}");
        assert_eq!(area.point(pos2(0.0, 999.0)), [-1.0, 0.0]);
    }
}
