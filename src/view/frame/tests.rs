use super::*;
use crate::chart::{self, LineStyle, Primitive, ScreenCurve};
use crate::scene::Scene;
use crate::stage::{Fill, Picture, Shape};
use crate::studio::StageCommand;
use crate::tests::testing::{EVERYWHERE, Pixels, executor, paint};

/// Longest side of a texture.
const SIDE_PX: u32 = 4096;

fn red_everywhere() -> Picture {
    let corners = [[-1e3, -1e3], [1e3, -1e3], [1e3, 1e3], [-1e3, 1e3]];
    let corners = corners.map(|at| (at, [255, 0, 0, 255])).into();
    let shapes = vec![Shape::Fill(Fill { corners, clip: EVERYWHERE })];
    Picture { shapes, ..Picture::default() }
}

/// A panel 40 points wide on the left, and the stage in the rest.
fn show(ui: &mut egui::Ui, picture: &Picture) -> Option<Stage> {
    let frame = egui::Frame::NONE.fill(egui::Color32::GREEN);
    egui::Panel::left("panel").exact_size(40.0).frame(frame).show(ui, |_| ());
    Some(Stage { rect: ui.available_rect_before_wrap(), picture: picture.clone() })
}

fn draw(size_px: [u32; 2], scale: f32, picture: &Picture) -> Pixels {
    let mut renderer = FrameRenderer::new(SIDE_PX);
    let input = egui::RawInput::default();
    let layout = renderer.lay_out_with(size_px, scale, input, |ui| show(ui, picture));
    let output = renderer.paint(size_px, layout);
    paint(&mut executor(), &output.drawing)
}

#[test]
fn the_stage_fills_the_room_beside_the_panels() {
    for scale in [1.0, 2.0] {
        let pixels = draw([200, 100], scale, &red_everywhere());
        let edge = (40.0 * scale) as u32;
        assert_eq!(pixels.at(edge / 2, 50), [0, 255, 0, 255]);
        assert_eq!(pixels.at(edge + 2, 50), [255, 0, 0, 255]);
        assert_eq!(pixels.at(199, 99), [255, 0, 0, 255]);
    }
}

#[test]
fn labels_are_written_on_the_stage() {
    let label = |align| Label {
        at: [80.0, 50.0],
        align,
        size: 20.0,
        colour: [255; 4],
        is_strong: false,
        is_code: false,
        halo: [0; 4],
        text: "HHHH".to_owned(),
    };
    let lit = |align| {
        let picture = Picture { labels: vec![label(align)], ..Picture::default() };
        let pixels = draw([200, 100], 1.0, &picture);
        let bright = |x: u32| (0..100).any(|y| pixels.at(x, y)[0] > 200);
        let left = (40..120).filter(|&x| bright(x)).count();
        let right = (120..200).filter(|&x| bright(x)).count();
        (left > 0, right > 0)
    };
    assert_eq!(lit(Align::Left), (false, true));
    assert_eq!(lit(Align::Right), (true, false));
    assert_eq!(lit(Align::Centre), (true, true));
}

#[test]
fn a_curve_is_drawn_dashed_and_clipped() {
    let mut renderer = FrameRenderer::new(SIDE_PX);
    let style = |dash| LineStyle { dash, ..LineStyle::solid(egui::Color32::RED, 4.0) };
    let input = egui::RawInput::default();
    let layout = renderer.lay_out_with([128, 64], 1.0, input, |ui| {
        let clip = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(100.0, 64.0));
        let painter = ui.painter().with_clip_rect(clip);
        for (y, dash) in [(20.0, [8.0, 6.0]), (40.0, [8.0, 0.0])] {
            let ends = vec![egui::pos2(10.0, y), egui::pos2(120.0, y)];
            let curve = ScreenCurve::new(style(dash), ends);
            chart::paint(&painter, &[Primitive::Curves(vec![curve])]);
        }
        None
    });
    let drawing = renderer.paint([128, 64], layout).drawing;
    let pixels = paint(&mut executor(), &drawing);
    for x in 10..128 {
        let [dashed, solid] = [20, 40].map(|y| pixels.at(x, y)[0]);
        assert_eq!(solid > 250, x < 100, "{x}");
        // The ends of a dash are blurred and round.
        let into_pattern = (x as f32 + 0.5 - 10.0) % 14.0;
        if x < 100 && (1.0..7.0).contains(&into_pattern) {
            assert!(dashed > 250, "{x} is in a dash");
        } else if x >= 100 || (9.0..13.0).contains(&into_pattern) {
            assert!(dashed < 10, "{x} is in a gap");
        }
    }
}

#[test]
fn the_same_input_makes_the_same_frame() {
    let frame = || draw([120, 90], 1.5, &red_everywhere()).rows;
    assert_eq!(frame(), frame());
}

#[test]
fn the_first_frame_of_any_size_is_laid_out_like_the_next() {
    let studio = Studio::new(Scene::built_in("spring").unwrap());
    let mut renderer = FrameRenderer::new(SIDE_PX);
    for size_px in [[1280, 720], [1920, 1080], [3840, 2160], [800, 600]] {
        let [first, second] = [0, 1].map(|_| {
            let input = egui::RawInput::default();
            let (_, mut layout) = renderer.lay_out(size_px, 1.0, input, &studio);
            layout.panels.textures_delta.clear();
            layout.stage.expect("a studio has a stage").rect
        });
        assert_eq!(first, second, "{size_px:?}");
        assert!(first.width() > 300.0 && first.right() < 1280.0 * 1.75, "{first}");
    }
}

#[test]
fn a_kept_backdrop_changes_no_pixel_of_a_frame() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    studio.apply(StageCommand::ToggleRace);
    let (mut renderer, mut kept) = (FrameRenderer::new(SIDE_PX), executor());
    for n in 0..30 {
        match n {
            8 => _ = studio.apply(ViewCommand::ToggleTheme),
            14 | 19 => _ = studio.apply(ViewCommand::ToggleHelp),
            22 => _ = studio.apply(StageCommand::ToggleRace),
            _ => {}
        }
        studio.advance(if n % 3 == 0 { 0 } else { 40_000_000 });
        let input = egui::RawInput { time: Some(0.1 * f64::from(n)), ..Default::default() };
        let (_, output) = renderer.draw([640, 400], 1.0, input, &studio);
        let drawn = paint(&mut kept, &output.drawing);
        let mut fresh = executor();
        fresh.textures = kept.textures.clone();
        assert!(drawn.rows == paint(&mut fresh, &output.drawing).rows, "frame {n}");
    }
}
