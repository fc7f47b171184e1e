//! Thousands of random keys, clicks, drags and wheel turns: the program goes on, in silence, and keeps to its memory.

use crate::desk::Desk;
use crate::dice::Dice;

/// Keys of the table, but for those that write files or leave the window, and some that are bound to nothing.
const KEYS: [&str; 44] = [
    "1",
    "2",
    "3",
    "5",
    "7",
    "9",
    "0",
    "m",
    "shift+m",
    "c",
    "space",
    "period",
    "comma",
    "shift+period",
    "shift+comma",
    "ctrl+z",
    "Home",
    "bracketleft",
    "bracketright",
    "minus",
    "equal",
    "Up",
    "Down",
    "Left",
    "Right",
    "k",
    "n",
    "b",
    "g",
    "i",
    "v",
    "t",
    "shift+t",
    "e",
    "x",
    "h",
    "F2",
    "F3",
    "Return",
    "Tab",
    "shift+Tab",
    "y",
    "z",
    "ctrl+c",
];
const EVENTS: usize = 3000;
/// Events that one call of xdotool makes.
const BATCH: usize = 25;
/// How much more memory the program may use in the second half of the events than in the first, in MB.
const MOST_GROWTH_MB: f64 = 5.0;

fn event(dice: &mut Dice) -> String {
    let mut place = || (dice.between(0.0, 1280.0) as u32, dice.between(0.0, 720.0) as u32);
    let ((x, y), (to_x, to_y)) = (place(), place());
    match (20.0 * dice.part()) as u32 {
        0..=1 => format!("mousemove --window WINDOW {x} {y}"),
        2..=4 => format!("mousemove --window WINDOW {x} {y} click 1"),
        5..=6 => format!(
            "mousemove --window WINDOW {x} {y} mousedown 1 mousemove --window WINDOW {to_x} {to_y} mouseup 1"
        ),
        7 => format!("mousemove --window WINDOW {x} {y} click {}", 4 + x % 2),
        8 => format!("mousemove --window WINDOW {x} {y} click 3"),
        _ => format!("key --delay 2 {}", KEYS[(dice.part() * KEYS.len() as f64) as usize]),
    }
}

#[test]
fn thousands_of_random_events_leave_the_program_running_in_silence_and_within_its_memory() {
    let test =
        "thousands_of_random_events_leave_the_program_running_in_silence_and_within_its_memory";
    let Some(desk) = Desk::open(test, "--scene harbour") else { return };
    let mut dice = Dice::new(11);
    let mut batch = |count: usize| {
        let events: Vec<String> = (0..count).map(|_| event(&mut dice)).collect();
        desk.xdotool(&events.join(" "));
    };
    // What is shown decides how much it takes; over many events, all of it has been shown.
    let [first, second] = [(); 2].map(|()| {
        let used = (0..EVENTS / BATCH / 2).map(|_| {
            batch(BATCH);
            desk.program.memory_mb()
        });
        used.fold(0.0, f64::max)
    });
    println!("at most {first:.1} MB over the first half, {second:.1} MB over the second");
    assert!(second > 10.0 && second < first + MOST_GROWTH_MB, "{first:.1} MB, then {second:.1} MB");
    desk.close();
    desk.ends();
}
