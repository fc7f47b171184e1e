//! Mapping of points to the pixels of a target.

use crate::stage::Rect;

/// Place on the target of some part of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct ScreenTransform {
    pub(super) size_px: [u32; 2],
    /// Origin of the part.
    pub(super) origin_px: [f32; 2],
    pub(super) px_per_point: f32,
    /// Left, top, right and bottom of its visible area.
    pub(super) edges_px: [f32; 4],
}

impl ScreenTransform {
    /// Place of a point, in pixels of the target.
    pub(super) fn px(&self, point: [f32; 2]) -> [f32; 2] {
        [0, 1].map(|axis| self.origin_px[axis] + point[axis] * self.px_per_point)
    }

    /// Left, top, width and height of the visible pixels whose middle is within `clip`; `None` if there are none.
    pub(super) fn scissor_px(&self, clip: Rect) -> Option<[u32; 4]> {
        let [left, top, right, bottom] = self.edges_px;
        let [low, high] = [clip.min, clip.max].map(|corner| {
            let [x, y] = self.px(corner).map(|at| (at - 0.5).ceil());
            [x.clamp(left, right) as u32, y.clamp(top, bottom) as u32]
        });
        let [width, height] = [0, 1].map(|axis| high[axis].saturating_sub(low[axis]));
        (width > 0 && height > 0).then_some([low[0], low[1], width, height])
    }
}
