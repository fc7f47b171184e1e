//! Frames of every scene against committed pictures.
//!
//! `BLESS=1 cargo test --test program golden` rewrites the pictures; look at them before committing.
#![cfg(feature = "desktop")]

use std::path::{Path, PathBuf};

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{DynamicImage, RgbaImage};
use regatta::scene::{Action, SCENES, Scene};
use regatta::studio::{
    RunCommand, StageCommand, Step, Studio, analyse_bounded, open_loop_lab_on, run_loops,
};
use regatta::view::{OffscreenRenderer, Panels, PixelDifference, PixelLimits, letter_instructions};

const SIZE_PX: [u32; 2] = [400, 225];
/// As in a window of 800 × 450 points, where all panels show.
const SCALE: f32 = 0.5;
/// Instructions by which letters were filled in the golden pictures. With these every byte must be the same.
const LETTERS: &str = "avx2";
/// Slightly more than letters differ with other instructions.
const OF_OTHER_LETTERS: PixelLimits =
    PixelLimits { max_pixels_percent: 0.01, ..PixelLimits::OF_LETTERS };
/// A golden picture that is larger holds more than a frame of ours should.
const MAX_FILE_BYTES: usize = 64 * 1024;

/// Just long enough for explicit Euler to halt on the stiff spring; longer trails make larger files.
const FRAMES: u64 = 130;

/// The studio of a built-in scene, in solo or racing, after [`FRAMES`] at 60 a second.
fn sailed(scene: &str, race: bool, mut each_frame: impl FnMut(&Studio)) -> Studio {
    let mut studio = Studio::new(Scene::built_in(scene).unwrap());
    if race {
        studio.apply(StageCommand::ToggleRace);
    } else {
        studio.apply(StageCommand::Pick(1));
    }
    studio.deck.forget_changes();
    let is_net = studio.scene().bodies.iter().any(|body| body.kind.net().is_some());
    for frame in 0..FRAMES {
        if frame == FRAMES / 2 && !race {
            studio.apply(RunCommand::Act(Action::Kick(1.0)));
            studio.apply(StageCommand::Pick(3));
        }
        studio.advance(16_666_667);
        // Nets are judged once: the rest of the run would take as long as all other scenes together.
        if !is_net || frame + 1 == FRAMES {
            analyse_bounded(&mut studio, |worker| Some(worker.finish()));
        }
        each_frame(&studio);
    }
    studio
}

/// Without alpha, which is full, and as small as may be: pictures in a repository stay for ever.
fn write_small(picture: &RgbaImage, path: &Path) {
    let mut file = Vec::new();
    let encoder =
        PngEncoder::new_with_quality(&mut file, CompressionType::Best, FilterType::Adaptive);
    DynamicImage::from(picture.clone()).into_rgb8().write_with_encoder(encoder).unwrap();
    std::fs::write(path, file).unwrap();
}

/// The picture of a studio from a renderer for `size_px`.
fn drawn(renderer: &mut OffscreenRenderer, size_px: [u32; 2], studio: &Studio) -> RgbaImage {
    let mut rgba = Vec::new();
    renderer.draw(studio, &mut rgba).unwrap();
    RgbaImage::from_raw(size_px[0], size_px[1], rgba).unwrap()
}

/// The difference of a picture from the golden one of this name, or a fault of the golden one; `BLESS=1` replaces it.
fn wrong(name: &str, drawn: &RgbaImage) -> Option<String> {
    let path = PathBuf::from("tests/golden").join(name);
    if std::env::var_os("BLESS").is_some_and(|value| value == "1") {
        write_small(drawn, &path);
    }
    let golden = match image::open(&path) {
        Ok(golden) => golden.into_rgba8(),
        Err(error) => {
            return Some(format!(
                "{name}: {error}; BLESS=1 cargo test --test program golden writes it"
            ));
        }
    };
    let bytes = std::fs::metadata(&path).unwrap().len() as usize;
    assert_eq!(golden.dimensions(), drawn.dimensions(), "{name}");
    let difference = PixelDifference::between(&golden, drawn, |_| true);
    let limits =
        if letter_instructions() == LETTERS { PixelLimits::EXACT } else { OF_OTHER_LETTERS };
    if limits.allow(&difference) && bytes <= MAX_FILE_BYTES {
        return None;
    }
    let (off, worst) = (difference.beyond(0), difference.worst());
    let kept = std::env::temp_dir().join(format!("regatta-{name}"));
    write_small(drawn, &kept);
    Some(format!(
        "{name}: {off} pixels off, the worst by {worst}, {bytes} bytes; drawn now: {}; if intended, \
         BLESS=1 cargo test --test program golden",
        kept.display()
    ))
}

#[test]
fn every_scene_matches_its_golden_picture_solo_and_racing() {
    let mut renderer = OffscreenRenderer::new(SIZE_PX, SCALE).unwrap();
    let mut all_wrong = Vec::new();
    for scene in SCENES {
        for (mode, race) in [("solo", false), ("race", true)] {
            let name = format!("{}-{mode}.png", scene.name);
            let drawn = drawn(&mut renderer, SIZE_PX, &sailed(scene.name, race, |_| ()));
            all_wrong.extend(wrong(&name, &drawn));
        }
    }
    assert!(all_wrong.is_empty(), "\n{}", all_wrong.join("\n"));
}

#[test]
fn the_inspector_beside_a_rewound_run_matches_its_golden_picture() {
    // 1280 × 720 points.
    let size_px = [512, 288];
    let mut studio = sailed("spring", false, |_| ());
    studio.apply(RunCommand::Act(Action::Set { body: 0, parameter: 1, value: 90.0 }));
    studio.apply(StageCommand::Second(Step::Next));
    studio.apply(RunCommand::Seek(FRAMES - 20));
    studio.apply(RunCommand::ToggleInspector);
    analyse_bounded(&mut studio, |worker| Some(worker.finish()));
    let drawn = drawn(&mut OffscreenRenderer::new(size_px, 0.4).unwrap(), size_px, &studio);
    assert_eq!(wrong("spring-inspector.png", &drawn), None);
}

#[test]
fn the_loop_lab_matches_its_golden_picture() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    open_loop_lab_on(&mut studio, "steady-144");
    run_loops(&mut studio);
    (0..FRAMES).for_each(|_| _ = studio.advance(16_666_667));
    let drawn = drawn(&mut OffscreenRenderer::new(SIZE_PX, SCALE).unwrap(), SIZE_PX, &studio);
    assert_eq!(wrong("spring-loops.png", &drawn), None);
}

#[test]
fn without_panels_the_stage_fills_the_frame() {
    let studio = sailed("harbour", true, |_| ());
    let draw = |panels| {
        let mut rgba = Vec::new();
        let mut renderer = OffscreenRenderer::new(SIZE_PX, SCALE).unwrap().with_panels(panels);
        renderer.draw(&studio, &mut rgba).unwrap();
        RgbaImage::from_raw(SIZE_PX[0], SIZE_PX[1], rgba).unwrap()
    };
    let (shown, off) = (draw(Panels::Shown), draw(Panels::Off));
    assert_eq!(shown, draw(Panels::default()));
    // Where panels are, the stage alone has sea.
    let [right, bottom] = SIZE_PX.map(|side| side - 1);
    let places = (20..bottom).step_by(7).map(|y| (right, y));
    let places = places.chain((20..right).step_by(7).map(|x| (x, bottom)));
    for (x, y) in places {
        let [r, g, b, _] = off.get_pixel(x, y).0;
        assert!(b > g && g > r && b > r + 15, "no sea at ({x}, {y}): {r} {g} {b}");
        assert_ne!(shown.get_pixel(x, y), off.get_pixel(x, y), "no panel at ({x}, {y})");
    }
}

#[test]
fn drawing_changes_no_bit_of_the_physics() {
    let mut renderer = OffscreenRenderer::new([64, 36], 0.1).unwrap();
    let mut rgba = Vec::new();
    for race in [false, true] {
        let drawn = sailed("harbour", race, |studio| renderer.draw(studio, &mut rgba).unwrap());
        let unseen = sailed("harbour", race, |_| ());
        assert_eq!(drawn.race().tick(), FRAMES);
        assert_eq!(drawn.race().state_hash(), unseen.race().state_hash());
    }
}

#[test]
fn frames_of_every_size_from_one_pixel_up_are_drawn() {
    let studio = sailed("harbour", true, |_| ());
    let mut rgba = Vec::new();
    for size_px in [[1, 1], [1, 300], [300, 1], [17, 33], [121, 261], [421, 201], [1001, 501]] {
        for scale in [0.5, 1.0, 2.0] {
            OffscreenRenderer::new(size_px, scale).unwrap().draw(&studio, &mut rgba).unwrap();
            assert_eq!(rgba.len(), 4 * (size_px[0] * size_px[1]) as usize, "{size_px:?}");
            assert!(rgba.chunks_exact(4).all(|pixel| pixel[3] == 255), "{size_px:?} at {scale}");
        }
    }
}
