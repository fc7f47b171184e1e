use egui::epaint::ImageDelta;
use egui::{Pos2, TextureOptions, pos2};

use super::*;
use crate::drawing::{Draw, Mesh, Place};
use crate::scene::Scene;
use crate::studio::{StageCommand, Studio};
use crate::tests::testing::{Pixels, executor, paint};
use crate::{FrameRenderer, PixelDifference};

fn one_place(size_px: [u32; 2]) -> ScreenTransform {
    let [width, height] = size_px.map(|side| side as f32);
    let edges_px = [0.0, 0.0, width, height];
    ScreenTransform { size_px, origin_px: [0.0; 2], px_per_point: 1.0, edges_px }
}

/// A drawing of these triangles at one pixel per point.
fn triangles(size_px: [u32; 2], kind: DrawKind, vertices: Vec<Vertex>) -> Drawing {
    let indices: Vec<u32> = (0..vertices.len() as u32).collect();
    let draw = Draw {
        scissor_px: [0, 0, size_px[0], size_px[1]],
        place: Place::Panels,
        kind,
        indices: 0..indices.len() as u32,
    };
    let triangles = Mesh { vertices, indices };
    let transforms = [one_place(size_px); 2];
    Drawing { size_px, transforms, draws: vec![draw], triangles, ..Drawing::default() }
}

fn plain(at: [f32; 2], color: Color32) -> Vertex {
    Vertex { pos: at.into(), uv: WHITE_UV, color }
}

fn with_texture(mut drawing: Drawing, size: [usize; 2], pixels: Vec<Color32>) -> Drawing {
    let image = ColorImage::new(size, pixels);
    let delta = ImageDelta::full(image, TextureOptions::NEAREST);
    drawing.textures.set.push((TextureId::default(), delta));
    drawing
}

fn drawn(drawing: &Drawing) -> Pixels {
    paint(&mut executor(), drawing)
}

/// Whether each pixel of a row is lit, as a text.
fn lit(pixels: &Pixels, y: u32) -> String {
    let of = |x| if pixels.at(x, y)[0] > 0 { '#' } else { '.' };
    (0..pixels.size_px[0]).map(of).collect()
}

#[test]
fn a_pixel_is_covered_if_its_middle_is_inside_or_on_the_top_or_left_edge() {
    let filled = |corners: [[f32; 2]; 3]| {
        let corners = corners.map(|at| plain(at, Color32::WHITE));
        let pixels = drawn(&triangles([5, 5], DrawKind::OpaqueFill, corners.into()));
        (0..5).map(|y| lit(&pixels, y)).collect::<Vec<_>>()
    };
    // The corners are middles of pixels: those on the top and on the left edge count, those on the slope do not.
    let whole = [".....", ".##..", ".#...", ".....", "....."];
    assert_eq!(filled([[1.5, 1.5], [3.5, 1.5], [1.5, 3.5]]), whole);
    assert_eq!(filled([[1.5, 3.5], [3.5, 1.5], [1.5, 1.5]]), whole);
    // The opposite half: it has the pixels on the slope, and none on its right and bottom edges.
    let opposite = [".....", ".....", "..#..", ".....", "....."];
    assert_eq!(filled([[3.5, 1.5], [3.5, 3.5], [1.5, 3.5]]), opposite);
    assert_eq!(filled([[1.0, 1.0], [1.4, 1.0], [1.0, 1.4]]), ["....."; 5]);
    assert_eq!(filled([[-1e6, 2.0], [1e6, 2.0], [0.0, 3.0]])[2], "#####");
}

#[test]
fn neighbouring_triangles_cover_each_pixel_once() {
    // A fan round a point that is on no grid line, in a colour that shows how often a pixel is drawn.
    let once = Color32::from_rgba_premultiplied(10, 10, 10, 0);
    let around =
        [[-3.0, -4.0], [41.0, -2.0], [38.3, 17.7], [37.0, 44.0], [3.0, 39.0], [-5.0, 11.0]];
    let middle = [17.31, 15.87];
    let corners = (0..6).flat_map(|n| [middle, around[n], around[(n + 1) % 6]]);
    let vertices = corners.map(|at| plain(at, once)).collect();
    let drawing = triangles([30, 30], DrawKind::Textured(TextureId::default()), vertices);
    let pixels = drawn(&with_texture(drawing, [1, 1], vec![Color32::WHITE]));
    assert!(pixels.rows.chunks_exact(4).all(|pixel| pixel[0] == 10));
}

#[test]
fn a_translucent_colour_is_blended_and_rounded_to_the_nearest_level() {
    let layers = [[200, 100, 0, 255], [60, 30, 10, 128]];
    let quad = |[r, g, b, a]: [u8; 4]| {
        let colour = Color32::from_rgba_premultiplied(r, g, b, a);
        [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]
            .map(|at| plain(at, colour))
    };
    let vertices = layers.into_iter().flat_map(quad).collect();
    let drawing = triangles([4, 4], DrawKind::Textured(TextureId::default()), vertices);
    let pixels = drawn(&with_texture(drawing, [1, 1], vec![Color32::WHITE]));
    // 200 · 127 / 255 = 99.6, 100 · 127 / 255 = 49.8.
    assert!(pixels.rows.chunks_exact(4).all(|pixel| pixel == [160, 80, 10, 255]));
}

#[test]
fn a_texel_is_looked_up_and_never_filtered() {
    let [red, green] = [Color32::RED, Color32::GREEN];
    let vertex = |at: [f32; 2]| {
        let uv: Pos2 = pos2(at[0] / 4.0, at[1] / 4.0);
        Vertex { uv, ..plain(at, Color32::from_rgba_premultiplied(128, 128, 128, 128)) }
    };
    let corners = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let vertices = corners.map(vertex).into();
    let drawing = triangles([4, 4], DrawKind::Textured(TextureId::default()), vertices);
    let texels = vec![red, Color32::TRANSPARENT, Color32::TRANSPARENT, green];
    let pixels = drawn(&with_texture(drawing, [2, 2], texels));
    for (x, y, expected) in
        [(1, 1, [128, 0, 0, 255]), (2, 1, [0, 0, 0, 255]), (2, 2, [0, 128, 0, 255])]
    {
        assert_eq!(pixels.at(x, y), expected, "({x}, {y})");
    }
}

#[test]
fn a_changed_part_of_a_texture_leaves_earlier_drawings_as_they_were() {
    let mut textures = Textures::default();
    let whole = with_texture(Drawing::default(), [2, 1], vec![Color32::RED; 2]);
    let before = textures.update(&whole, Textures::clone);
    let mut part = Drawing::default();
    let image = ColorImage::new([1, 1], vec![Color32::GREEN]);
    let delta = ImageDelta::partial([1, 0], image, TextureOptions::NEAREST);
    part.textures.set.push((TextureId::default(), delta));
    part.textures.freed.push(TextureId::default());
    let after = textures.update(&part, Textures::clone);
    let texels = |textures: &Textures| textures.present[&TextureId::default()].image.pixels.clone();
    assert_eq!(texels(&before), [Color32::RED; 2]);
    assert_eq!(texels(&after), [Color32::RED, Color32::GREEN]);
    assert!(textures.present.is_empty());
}

#[test]
fn a_stroke_is_covered_by_its_distance_from_the_line() {
    let vertex = |at: [f32; 2], across: f32| StrokeVertex {
        at,
        across_px: [1.25, across],
        along_px: [0.0, 0.0, 1e9],
        colour: Color32::WHITE,
    };
    // A horizontal line in the middle of row 3, 2.5 pixels wide.
    let vertices = vec![
        vertex([0.0, 0.5], -3.0),
        vertex([6.0, 0.5], -3.0),
        vertex([0.0, 6.5], 3.0),
        vertex([6.0, 6.5], 3.0),
    ];
    let strokes = Mesh { vertices, indices: vec![0, 1, 2, 2, 1, 3] };
    let draw = Draw {
        scissor_px: [1, 0, 4, 7],
        place: Place::Stage,
        kind: DrawKind::Stroke,
        indices: 0..6,
    };
    let size_px = [6, 7];
    let transforms = [one_place(size_px); 2];
    let drawing = Drawing { size_px, transforms, draws: vec![draw], strokes, ..Drawing::default() };
    let pixels = drawn(&drawing);
    // At a distance of 1 a pixel is covered by 1.25 + 0.5 - 1 = 0.75.
    let column = [0, 0, 191, 255, 191, 0, 0];
    assert_eq!([0, 1, 2, 3, 4, 5, 6].map(|y| pixels.at(2, y)[0]), column);
    assert_eq!([0, 5].map(|x| pixels.at(x, 3)[0]), [0; 2]);
}

#[test]
fn water_is_a_gradient_with_a_light_in_steps_of_two_levels() {
    let sea = SeaRect {
        scissor_px: [0, 0, 20, 10],
        rect_px: [0.0, 0.0, 20.0, 10.0],
        colours: [[100, 0, 255, 255], [200, 0, 255, 255]],
    };
    let size_px = [20, 10];
    let drawing = Drawing { size_px, sea: Some(sea), ..Drawing::default() };
    let pixels = drawn(&drawing);
    // In the middle of the light: at 21/40 of the width and 1/4 of the height of this sea.
    let lit = 100.0 + 25.0 + 0.4 * 100.0 * (1.0 - 100.0 / 255.0);
    assert!((f32::from(pixels.at(12, 2)[0]) - lit).abs() <= 2.0, "{:?}", pixels.at(12, 2));
    // Beyond its reach.
    assert_eq!(pixels.at(0, 9)[0], 196);
    assert!(
        pixels.rows.chunks_exact(4).all(|pixel| pixel[0] % 2 == 0 && pixel[1..] == [0, 255, 255])
    );
}

/// Drawings of the first frames of a scene's race, with panels.
fn race(scene: &str, size_px: [u32; 2], scale: f32, frames: usize) -> Vec<Drawing> {
    let mut studio = Studio::new(Scene::built_in(scene).unwrap());
    studio.apply(StageCommand::ToggleRace);
    let mut renderer = FrameRenderer::new(4096);
    let mut frame = |_| {
        studio.advance(100_000_000);
        let input = egui::RawInput { time: Some(studio.race().t()), ..egui::RawInput::default() };
        renderer.draw(size_px, scale, input, &studio).1.drawing
    };
    (0..frames).map(&mut frame).collect()
}

#[test]
fn any_number_of_threads_draws_the_same_bytes() {
    let drawings = race("harbour", [301, 173], 0.4, 6);
    let frames = |threads| {
        let mut executor = CpuExecutor::new(NonZero::new(threads).unwrap());
        drawings.iter().map(|drawing| paint(&mut executor, drawing).rows).collect::<Vec<_>>()
    };
    let alone = frames(1);
    assert!(alone[0].chunks_exact(4).all(|pixel| pixel[3] == 255));
    assert!([2, 5, 1000].iter().all(|&threads| frames(threads) == alone));
}

#[test]
fn other_letters_change_only_the_pixels_that_are_known_to_have_letters() {
    let drawing = race("spring", [320, 180], 0.7, 1).remove(0);
    let mut other = drawing.clone();
    for (_, delta) in &mut other.textures.set {
        let ImageData::Color(image) = &mut delta.image;
        // The first row has the white texel.
        let below = image.width();
        for texel in &mut Arc::make_mut(image).pixels[below..] {
            *texel = Color32::from_rgba_premultiplied(0, 0, 0, 255 - texel.a());
        }
    }
    let [one, other] = [drawn(&drawing), drawn(&other)];
    let has_letters = drawing.has_letters();
    let outside = PixelDifference::between(&one.rows, &other.rows, |pixel| !has_letters[pixel]);
    assert_eq!(outside.beyond(0), 0);
    let within = PixelDifference::between(&one.rows, &other.rows, |pixel| has_letters[pixel]);
    let letters = has_letters.iter().filter(|&&has| has).count();
    assert!((1_000..20_000).contains(&letters), "{letters}");
    assert!(within.beyond(0) > letters / 2, "{} of {letters}", within.beyond(0));
}

#[test]
fn a_row_drawn_in_blocks_has_the_bytes_of_its_pixels_drawn_one_by_one() {
    use super::spans::{Line, Ramp, blend_ramped, stroke, stroke_ramped};
    const WIDTH: usize = 21;
    let ramp = |start: f32, end: f32| Ramp { start, step: (end - start) / WIDTH as f32 };
    let at = |ramp: Ramp, x: usize| Ramp { start: ramp.start + ramp.step * x as f32, step: 0.0 };
    let colour = [ramp(250.0, 10.0), ramp(3.0, 90.0), ramp(0.0, 0.0), ramp(255.0, 60.0)];
    let below: Vec<Pixel> = (0..WIDTH as u8).map(|x| [12 * x, 255 - 9 * x, 77, 255]).collect();
    let (half, across) = (ramp(2.5, 0.2), ramp(-3.0, 3.0));
    for turns in [ramp(-0.1, 0.2), ramp(-0.3, 2.9)] {
        let line = Line { half, across, turns, reach: 1.5, period: 5.0 };
        let mut rows = [below.clone(), below.clone(), below.clone()];
        stroke(&mut rows[0], 0, &line, [200, 100, 7, 220]);
        stroke_ramped(&mut rows[1], 0, &line, colour);
        blend_ramped(&mut rows[2], 0, colour);
        let mut alone = [below.clone(), below.clone(), below.clone()];
        for x in 0..WIDTH {
            let [half, across] = [half, across].map(|ramp| at(ramp, x));
            let of_pixel = Line { half, across, turns: at(turns, x), ..line };
            let colour = colour.map(|channel| at(channel, x));
            stroke(&mut alone[0][x..=x], 0, &of_pixel, [200, 100, 7, 220]);
            stroke_ramped(&mut alone[1][x..=x], 0, &of_pixel, colour);
            blend_ramped(&mut alone[2][x..=x], 0, colour);
        }
        assert_eq!(rows, alone, "{turns:?}");
        assert!(rows.iter().all(|row| *row != below));
    }
}

/// Draws the drawing in a kept frame, which must have the pixels of a whole one. Returns the part of it that was drawn.
fn keep(kept: &mut KeptFrame, whole: &mut CpuExecutor, drawing: &Drawing) -> f64 {
    let before = kept.pixels().to_vec();
    kept.draw(drawing);
    let pixels = kept.pixels();
    assert!(pixels.as_flattened() == paint(whole, drawing).rows, "other pixels");
    let [width, height] = drawing.size_px.map(|side| side as usize);
    let mut is_changed = vec![false; width * height];
    for [left, top, columns, rows] in kept.changed().map(|rect| rect.map(|px| px as usize)) {
        for y in top..top + rows {
            is_changed[y * width + left..][..columns].fill(true);
        }
    }
    if before.len() == pixels.len() {
        let stale = (0..pixels.len()).find(|&n| !is_changed[n] && pixels[n] != before[n]);
        assert_eq!(stale, None, "changed beyond what is said to be");
    }
    is_changed.iter().filter(|&&it| it).count() as f64 / is_changed.len() as f64
}

#[test]
fn a_kept_frame_has_the_pixels_of_one_drawn_whole() {
    for (scene, size_px, scale, threads) in [
        ("harbour", [2100, 173], 0.6, 3),
        ("spring", [640, 360], 1.0, 1),
        ("chain", [333, 555], 0.5, 2),
    ] {
        let mut kept = KeptFrame::new(NonZero::new(threads).unwrap());
        let mut whole = executor();
        let mut drawings = race(scene, size_px, scale, 12);
        let parts: Vec<f64> =
            drawings.iter().map(|drawing| keep(&mut kept, &mut whole, drawing)).collect();
        assert_eq!(parts[0], 1.0, "{scene}");
        assert!((0.01..0.7).contains(&parts[11]), "{scene}: {parts:?}");
        // Another size and other letters, without anything else that is new.
        let mut last = drawings.pop().expect("twelve drawings");
        last.size_px[1] += 1;
        last.backdrop = None;
        assert_eq!(keep(&mut kept, &mut whole, &last), 1.0, "{scene}");
        assert_eq!(keep(&mut kept, &mut whole, &last), 0.0, "{scene}");
        let lit = Color32::from_rgba_premultiplied(1, 2, 3, 4);
        let image = ColorImage::new([9, 9], vec![lit; 81]);
        let delta = ImageDelta::partial([40, 0], image, TextureOptions::NEAREST);
        last.textures.set.push((TextureId::default(), delta));
        assert!((0.01..0.9).contains(&keep(&mut kept, &mut whole, &last)), "{scene}");
    }
}

#[test]
fn a_frame_that_stands_still_is_not_drawn_again() {
    let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
    studio.apply(StageCommand::ToggleRace);
    studio.advance(2_000_000_000);
    let mut renderer = FrameRenderer::new(4096);
    let (mut kept, mut whole) = (KeptFrame::new(NonZero::<usize>::MIN), executor());
    let mut part = |_| {
        let input = egui::RawInput { time: Some(studio.race().t()), ..egui::RawInput::default() };
        let drawing = renderer.draw([800, 450], 1.0, input, &studio).1.drawing;
        keep(&mut kept, &mut whole, &drawing)
    };
    let parts: Vec<f64> = (0..30).map(&mut part).collect();
    assert_eq!(parts[20..], [0.0; 10], "{parts:?}");
}
