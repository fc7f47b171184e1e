//! The stage: a picture's sea, then its shapes, at their place on the target.

use super::backdrop::BackdropFinder;
use super::drawing::{Backdrop, Drawing, Place, SeaRect};
use super::screen_transform::ScreenTransform;
use super::shapes::draw_shapes;
use crate::stage::{FAR, Picture, Rect, Sea};

/// A rectangle that clips nothing.
const EVERYWHERE: Rect = Rect { min: [-FAR; 2], max: [FAR; 2] };

/// A larger frame has no backdrop, because an executor would need as much memory again.
const MAX_BACKDROP_PIXELS: u64 = 4096 * 4096;

/// The part of the frame that panels leave free, and its picture.
#[derive(Clone, Debug)]
pub(super) struct Stage {
    /// Place, in points of the frame.
    pub(super) rect: egui::Rect,
    /// Contents, in points of the stage.
    pub(super) picture: Picture,
}

/// Adds everything of a picture but its text to a drawing without draws.
pub(super) fn draw_stage(
    drawing: &mut Drawing,
    backdrops: &mut BackdropFinder,
    Stage { rect, picture }: Stage,
    scale: f32,
) {
    let size_px = drawing.size_px;
    // On whole pixels, so that shapes on whole points stay sharp.
    let low_px = (rect.min.to_vec2() * scale).round();
    let high_px = (rect.max.to_vec2() * scale).round();
    let [left, right] = [low_px.x, high_px.x].map(|x| x.clamp(0.0, size_px[0] as f32));
    let [top, bottom] = [low_px.y, high_px.y].map(|y| y.clamp(0.0, size_px[1] as f32));
    let transform = ScreenTransform {
        size_px,
        origin_px: low_px.into(),
        px_per_point: scale,
        edges_px: [left, top, right.max(left), bottom.max(top)],
    };
    drawing.transforms[Place::Stage as usize] = transform;
    drawing.sea = picture.sea.and_then(|sea| sea_rect(sea, &transform));
    let cover = backdrops.choose_cover(&transform, &picture);
    let (below, above) = picture.shapes.split_at(cover.map_or(0, |cover| cover.shapes));
    draw_shapes(drawing, below, &transform);
    let is_small = size_px.map(u64::from).iter().product::<u64>() <= MAX_BACKDROP_PIXELS;
    let backdrop = cover.filter(|_| is_small);
    drawing.backdrop = backdrop.map(|cover| Backdrop { id: cover.id, draws: drawing.draws.len() });
    draw_shapes(drawing, above, &transform);
    backdrops.keep_picture(transform, picture);
}

fn sea_rect(sea: Sea, transform: &ScreenTransform) -> Option<SeaRect> {
    let [[left, top], [right, bottom]] = [sea.rect.min, sea.rect.max].map(|at| transform.px(at));
    let rect_px = [left, top, right, bottom].map(f32::round);
    let scissor_px = transform.scissor_px(EVERYWHERE)?;
    Some(SeaRect { scissor_px, rect_px, colours: sea.colours })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::testing::draw_picture;

    #[test]
    fn a_sea_fills_exactly_its_rectangle_and_is_lighter_above() {
        let rect = Rect { min: [8.0, 8.0], max: [56.0, 56.0] };
        let sea = Sea { rect, colours: [[40, 60, 90, 255], [10, 20, 30, 255]] };
        let pixels = draw_picture([64, 64], 1.0, &Picture { sea: Some(sea), ..Picture::default() });
        for (x, y) in [(7, 30), (56, 30), (30, 7), (30, 56)] {
            assert_eq!(pixels.at(x, y)[..3], [0, 0, 0], "({x}, {y}) is outside");
        }
        assert_eq!(pixels.count_lit(), 48 * 48);
        let [above, below] = [9, 54].map(|y| pixels.at(9, y)[2]);
        assert!(above > below + 30, "{above} and {below}");
        let [lit, shaded] = [[38, 18], [9, 18]].map(|[x, y]| pixels.at(x, y)[2]);
        assert!(lit > shaded, "{lit} under the light, {shaded} away from it");
    }
}
