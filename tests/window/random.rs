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
/// How much more memory the program may use in the last quarter of the events than in the second, in MB.
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
    // The memory for rewinding is full within the first quarter.
    let Some(desk) = Desk::open(test, "--scene harbour --rewind-mb 1") else { return };
    let mut dice = Dice::new(11);
    let used = (0..EVENTS / BATCH).map(|_| {
        let events: Vec<String> = (0..BATCH).map(|_| event(&mut dice)).collect();
        desk.xdotool(&events.join(" "));
        desk.program.memory_mb()
    });
    let used: Vec<f64> = used.collect();
    // What is shown decides how much is used at a time: a median does not depend on when the most is shown.
    let quarter = used.len() / 4;
    let medians = [1, 3].map(|i| {
        let mut used = used[i * quarter..(i + 1) * quarter].to_vec();
        used.sort_by(f64::total_cmp);
        used[quarter / 2]
    });
    let [second, last] = medians;
    println!("the second quarter uses {second:.1} MB, the last {last:.1} MB: {used:.0?}");
    assert!(second > 10.0 && last < second + MOST_GROWTH_MB, "{second:.1} MB, then {last:.1} MB");
    desk.close();
    desk.ends();
}
