//! Thousands of random keys, clicks, drags and wheel turns: the program keeps running, quietly, within its memory.

use std::path::Path;
use std::time::{Duration, Instant};

use crate::desk::{Desk, until};
use crate::dice::Dice;
use crate::dropped::drop_file;

/// Keys of the table except those that write files or leave the window, and some unbound ones.
const KEYS: [&str; 46] = [
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
    "d",
    "shift+d",
    "l",
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
/// How often the program comes to rest, and the events before each rest: 1200 in all.
const RESTS: usize = 6;
const EVENTS: usize = 200;
/// Events that one call of xdotool makes.
const BATCH: usize = 25;
/// The allowed growth of the program's memory at rest from the first half of the events to the second, in MB.
/// `tests/program/memory.rs` shows that the program itself holds no more. Its process grows by up to 7, until some
/// 4000 events, since freed memory returns in pieces. A leak of 20 KB per event adds 30.
const MAX_GROWTH_MB: f64 = 20.0;
/// How long the program's memory is read at a rest.
const REST: Duration = Duration::from_secs(1);

/// The keys of a session. In a swarm, which `REGATTA_SWARM` asks for, a session has some of them only, so that the
/// others do not end each state that these reach.
fn keys_of(dice: &mut Dice) -> Vec<&'static str> {
    let (is_swarm, part) = (std::env::var_os("REGATTA_SWARM").is_some(), dice.between(0.1, 1.0));
    let keys = KEYS.iter().copied().filter(|_| !is_swarm || dice.part() < part);
    keys.chain(["space"]).collect()
}

fn event(dice: &mut Dice, keys: &[&str]) -> String {
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
        _ => format!("key --delay 2 {}", keys[dice.below(keys.len())]),
    }
}

/// Drops a scene of one body on the window, so that everything from earlier runs can be freed, and returns the
/// program's memory, in MB. Earlier scenes and the speed of the events hardly affect it.
fn at_rest(desk: &Desk, scene: &Path) -> f64 {
    drop_file(desk, scene);
    until("the scene", || desk.title().contains(" - rest.toml - ").then_some(()));
    let start = Instant::now();
    let mut least = f64::INFINITY;
    while start.elapsed() < REST {
        least = least.min(desk.program.memory_mb());
        std::thread::sleep(REST / 50);
    }
    least
}

pub(crate) fn random_events_leave_the_program_running_quietly_within_its_memory() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("rest.toml");
    let text =
        include_str!("../../assets/scenes/spring.toml").replace("seconds = 20", "seconds = 2");
    std::fs::write(&scene, text).unwrap();
    // Freed memory returns to the system at once, rather than to a reserve that depends on the order of events.
    let variables = [("MALLOC_MMAP_THRESHOLD_", "65536"), ("MALLOC_TRIM_THRESHOLD_", "65536")];
    let desk = Desk::open_with("--scene harbour", &variables);
    let mut dice = Dice::new(11);
    let keys = keys_of(&mut dice);
    let used = [(); RESTS].map(|()| {
        // From another scene than that of the rest.
        desk.press("n");
        for _ in 0..EVENTS / BATCH {
            let events: Vec<String> = (0..BATCH).map(|_| event(&mut dice, &keys)).collect();
            desk.xdotool(&events.join(" "));
        }
        at_rest(&desk, &scene)
    });
    let [first, second] = [&used[..RESTS / 2], &used[RESTS / 2..]]
        .map(|half| half.iter().copied().fold(f64::INFINITY, f64::min));
    println!("at rest it uses {used:.1?} MB");
    assert!(first > 10.0 && second < first + MAX_GROWTH_MB, "{used:.1?} MB");
    // At the end of the scene nothing is drawn and no processor is used.
    desk.still();
    let load = desk.load_over(REST);
    assert!(load < 0.1, "{load} of a core");
    desk.close();
    desk.ends();
}
