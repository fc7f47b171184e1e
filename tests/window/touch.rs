//! Bodies grabbed with the mouse, and the stage zoomed and panned.

use image::RgbaImage;
use regatta::look::palette::{Theme, mix};
use regatta::scene::Scene;
use regatta::sim::integrators::method;
use regatta::studio::Studio;

use crate::desk::{Desk, until};
use crate::twin::Twin;

/// Half the side of a square that fits into a mass, and into nothing else of its colour.
const INSIDE: u32 = 8;
/// The colour of the hatches of a ship, and half the side of a square that fits into one.
const HATCH: ([u8; 4], u32) = ([138, 160, 112, 255], 4);

/// The middle of the mass under RK4, in pixels, and how many of its pixels lie inside.
pub(crate) fn body(sight: &RgbaImage) -> Option<([u32; 2], usize)> {
    let (colour, _) = Theme::Dark.style(method("rk4").unwrap());
    // The face of a block is a little darker than its method's colour.
    patch(sight, mix(colour, [0, 0, 0, 255], 0.12), INSIDE)
}

/// The middle of the ship's hatches, in pixels.
fn ship(sight: &RgbaImage) -> Option<[u32; 2]> {
    Some(patch(sight, HATCH.0, HATCH.1)?.0)
}

/// The middle of the pixels of this colour in a square of this half side, and the number of such pixels.
fn patch(sight: &RgbaImage, colour: [u8; 4], half: u32) -> Option<([u32; 2], usize)> {
    let is_own = |x, y| {
        let pixel = sight.get_pixel(x, y);
        (0..3).all(|i| pixel[i].abs_diff(colour[i]) <= 1)
    };
    let reach = |x: u32| x - half..=x + half;
    let is_inside = |x, y| {
        is_own(x, y)
            && [[x - half, y], [x + half, y], [x, y - half], [x, y + half]]
                .iter()
                .all(|&[x, y]| is_own(x, y))
            && reach(x).all(|x| is_own(x, y))
            && reach(y).all(|y| is_own(x, y))
    };
    // The stage, at the size at which a window opens.
    let places = (40..500).flat_map(|y| (20..780).map(move |x| (x, y)));
    let inside: Vec<(u32, u32)> = places.filter(|&(x, y)| is_inside(x, y)).collect();
    // The digit on a mass takes away from one side more than from the other.
    let middle = |along: fn(&(u32, u32)) -> u32| {
        let ends = [inside.iter().map(along).min()?, inside.iter().map(along).max()?];
        Some((ends[0] + ends[1]) / 2)
    };
    Some(([middle(|at| at.0)?, middle(|at| at.1)?], inside.len()))
}

/// Waits for the body to be here, apart from the line that joins it to the hand.
#[track_caller]
fn body_at(desk: &Desk, [x, y]: [u32; 2]) {
    until("the body", || {
        let ([now_x, now_y], _) = body(&desk.sight())?;
        (now_x.abs_diff(x) <= 2 && now_y.abs_diff(y) <= 8).then_some(())
    });
}

/// A paused window on the spring under RK4, and where its mass is.
fn paused() -> (Desk, [u32; 2]) {
    let desk = Desk::open("--scene spring --method rk4");
    desk.press("space");
    until("a pause", || desk.title().contains("(paused").then_some(()));
    // Away from the start, and in motion.
    desk.press(&["period"; 20].join(" "));
    desk.still();
    let (at, _) = body(&desk.sight()).expect("a mass");
    (desk, at)
}

fn drag(desk: &Desk, [x, y]: [u32; 2], to: [u32; 2]) {
    desk.xdotool(&format!("mousemove --window WINDOW {x} {y} mousedown 1"));
    let middle = [0, 1].map(|i| ([x, y][i] + to[i]) / 2);
    for [x, y] in [middle, to] {
        desk.xdotool(&format!("mousemove --window WINDOW {x} {y}"));
    }
}

pub(crate) fn a_dragged_mass_is_placed_with_shift_and_escape_cancels() {
    let (desk, [x, y]) = paused();
    let title = desk.title();
    let to = [if x > 400 { x - 90 } else { x + 90 }, y];
    drag(&desk, [x, y], [to[0], to[1] + 30]);
    body_at(&desk, to);
    desk.press("Escape");
    body_at(&desk, [x, y]);
    desk.xdotool("mouseup 1");
    desk.still();
    body_at(&desk, [x, y]);
    drag(&desk, [x, y], to);
    desk.xdotool("keydown shift mouseup 1 keyup shift");
    body_at(&desk, to);
    assert_eq!(desk.title(), title, "no time went by");
    // The placement belongs to this tick: after going back, the tick shows its outcome and continues from the placed
    // mass.
    desk.press("comma period");
    body_at(&desk, [x, y]);
    desk.press("period");
    body_at(&desk, to);
    desk.press("space");
    until("a run", || (!desk.title().contains("(paused")).then_some(()));
    desk.quit();
}

pub(crate) fn a_released_mass_keeps_the_velocity_of_the_drag_except_with_shift() {
    let (desk, [x, y]) = paused();
    let away = if x > 400 { -1 } else { 1 };
    let to = [x.strict_add_signed(90 * away), y];
    // Slow enough for the program to see it move.
    let moves = (1..=15).map(|n| {
        format!(" sleep 0.03 mousemove --window WINDOW {} {y}", x.strict_add_signed(6 * n * away))
    });
    let moves: String = moves.collect();
    let reached = |held: &str| {
        body_at(&desk, [x, y]);
        let press = format!("{held}mousemove --window WINDOW {x} {y} mousedown 1");
        desk.xdotool(&format!("{press}{moves} mouseup 1"));
        if !held.is_empty() {
            desk.xdotool("keyup shift");
        }
        body_at(&desk, to);
        desk.press("period period period");
        desk.still();
        let ([reached, _], _) = body(&desk.sight()).expect("a mass");
        desk.press("comma comma comma");
        desk.still();
        // It is shown as it was before the hand took it.
        desk.press("comma period");
        i64::from(reached) * i64::from(away)
    };
    let at_rest = reached("keydown shift ");
    // On a busy machine the hand itself may stop on its way.
    assert!((0..5).any(|_| reached("") > at_rest + 4), "{at_rest} as at rest");
    desk.quit();
}

pub(crate) fn time_stops_while_a_body_is_held() {
    let desk = Desk::open("--scene ship --method rk4 --tick-hz 60");
    // The camera follows it: it stays in its place.
    let at = until("a ship", || ship(&desk.sight()));
    drag(&desk, at, [at[0] + 60, at[1]]);
    until("the ship in hand", || {
        let x = ship(&desk.sight())?[0];
        // The line that joins it to the hand may cover a hatch.
        (x.abs_diff(at[0] + 60) <= 12).then_some(())
    });
    let (tick, _) = desk.screenshot();
    std::thread::sleep(std::time::Duration::from_millis(300));
    assert_eq!(desk.screenshot().0, tick);
    desk.xdotool("mouseup 1");
    until("time", || (desk.screenshot().0 > tick).then_some(()));
    desk.quit();
}

pub(crate) fn the_wheel_zooms_a_drag_pans_and_a_double_click_fits() {
    let (desk, at) = paused();
    let (_, size) = body(&desk.sight()).unwrap();
    let sea = [at[0], 420];
    desk.xdotool(&format!("mousemove --window WINDOW {} {} click 4 click 4", at[0], at[1]));
    until("a larger mass", || (body(&desk.sight())?.1 > size * 3 / 2).then_some(()));
    desk.still();
    body_at(&desk, at);
    drag(&desk, sea, [sea[0] + 40, sea[1] - 20]);
    desk.xdotool("mouseup 1");
    body_at(&desk, [at[0] + 40, at[1] - 20]);
    let fit = format!("mousemove --window WINDOW {} {} click --repeat 2 1", sea[0], sea[1]);
    desk.xdotool(&fit);
    body_at(&desk, at);
    // On the empty stage the wheel zooms about the pointer too: the mass moves away from it.
    let pointer = [if at[0] > 400 { at[0] - 60 } else { at[0] + 60 }, at[1] + 60];
    desk.xdotool(&format!("mousemove --window WINDOW {} {} click 4", pointer[0], pointer[1]));
    until("a larger mass", || (body(&desk.sight())?.1 > size * 6 / 5).then_some(()));
    desk.still();
    let (zoomed, _) = body(&desk.sight()).expect("a mass");
    for i in 0..2 {
        let [before, after] = [at[i], zoomed[i]].map(|place| place.abs_diff(pointer[i]));
        assert!(after > before + 3, "{at:?} {zoomed:?} about {pointer:?}");
    }
    desk.quit();
}

pub(crate) fn dragging_the_tick_rate_holds_time_and_is_undone_in_one_step() {
    // A first start has the stage alone.
    let config = tempfile::tempdir().unwrap();
    let variables = [("XDG_CONFIG_HOME", config.path().to_str().unwrap())];
    let desk = Desk::open_with("--scene spring", &variables);
    let mut twin = Twin::new(Studio::new(Scene::built_in("spring").unwrap()));
    twin.studio.viewer.preferences.display.measure = false;
    let scale = twin.slider("tick rate 60 Hz");
    // There is room beside the ends, and for numbers below the line.
    let line = scale.shrink2(egui::vec2(46.0, 0.0));
    let x = |hz: f32| line.left() + line.width() * (hz / 5.0).ln() / 200_f32.ln();
    let y = (line.bottom() - 30.0).round();
    let slowly = |hz: f32, then: &str| {
        let at = x(hz).round();
        let aside = at + 9.0;
        desk.xdotool(&format!("mousemove --window WINDOW {aside} {y} sleep 0.3"));
        let words = format!("mousemove --window WINDOW {at} {y} sleep 0.4 {then}");
        desk.xdotool(words.trim_end());
    };
    until("a run", || (desk.screenshot().0 > 30).then_some(()));
    slowly(60.0, "mousedown 1");
    let (tick, _) = desk.screenshot();
    for hz in [10, 120, 10] {
        slowly(hz as f32, "");
        desk.titled(&format!("Regatta - spring - Explicit Euler - {hz} Hz"));
    }
    let (held, fan) = desk.screenshot();
    assert_eq!(held, tick, "time went by");
    let threads = ["explicit-euler", "semi-implicit-euler", "rk4"].map(|id| {
        let (colour, _) = Theme::Dark.style(method(id).unwrap());
        let is_own = |pixel: &&image::Rgba<u8>| (0..3).all(|i| pixel.0[i].abs_diff(colour[i]) <= 2);
        fan.pixels().filter(is_own).count()
    });
    assert!(threads.iter().all(|&pixels| pixels > 100), "{threads:?}");
    desk.xdotool("mouseup 1");
    until("time", || (desk.screenshot().0 > tick).then_some(()));
    desk.press("ctrl+z");
    desk.titled("Regatta - spring - Explicit Euler - 60 Hz");
    desk.quit();
}
