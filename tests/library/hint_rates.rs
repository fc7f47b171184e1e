//! The tick rates that hints name, for any tick rate of a scene.

use regatta::scene::{SCENES, Scene};
use regatta::studio::{Command, StageCommand, Step, Studio, TICK_LADDER};

use crate::hints::{presses, told_keys};

/// The next rate (Hz) of the ladder.
fn beside(step: Step, hz: u32) -> u32 {
    let mut ladder = TICK_LADDER.iter().copied();
    let found = match step {
        Step::Next => ladder.find(|&other| other > hz),
        Step::Previous => ladder.rfind(|&other| other < hz),
    };
    found.unwrap_or(hz)
}

/// Each rate (Hz) in a hint, with the text before it.
fn rates(hint: &str) -> impl Iterator<Item = (&str, u32)> {
    hint.match_indices(" Hz").map(move |(end, _)| {
        let before = hint[..end].rsplit(' ').next().unwrap_or_default();
        let hz = before.parse().unwrap_or_else(|_| panic!("no rate before Hz in {hint}"));
        (&hint[..end - before.len()], hz)
    })
}

#[test]
fn a_rate_named_by_a_hint_is_the_present_one_or_reached_by_its_keys() {
    let mut named = 0;
    for scene in SCENES {
        let own = Scene::built_in(scene.name).unwrap();
        let rates_of_ladder = TICK_LADDER.iter().copied().chain(own.tick_hz.whole_hz());
        for (race, hz) in rates_of_ladder.flat_map(|hz| [(false, hz), (true, hz)]) {
            let mut opened = Studio::new(own.clone().at_tick_hz(hz));
            let mut changed = Studio::new(own.clone());
            changed.apply(StageCommand::TickHz(hz.into()));
            for studio in [&mut opened, &mut changed] {
                if race {
                    studio.apply(StageCommand::ToggleRace);
                }
                studio.viewer.begin_hints();
                assert_eq!(studio.clock().tick_hz(), hz, "{}", scene.name);
                let Some(hint) = studio.hint() else { continue };
                assert!(own.tick_hz == hz || Some(&hint) != own.hint.as_ref(), "{hz} Hz: {hint}");
                for (before, rate) in rates(&hint) {
                    named += 1;
                    let is_reached = before.ends_with("for ") || before.ends_with("at ");
                    assert!(is_reached || before.ends_with("needs "), "{hint}");
                    if !is_reached {
                        continue;
                    }
                    let keys = told_keys(&hint);
                    let after = keys.iter().map(|(command, told)| (command, presses(told.after)));
                    let steps = after.filter_map(|(command, (count, _))| match command {
                        Command::Stage(StageCommand::TickRate(step)) => Some((*step, count)),
                        _ => None,
                    });
                    let mut led =
                        steps.map(|(step, count)| (0..count).fold(hz, |hz, _| beside(step, hz)));
                    let is_there = rate == hz || led.any(|led| led == rate);
                    // Further down than the presses that it counts.
                    let is_far = hint.contains(&format!("Down at {rate} Hz"));
                    assert!(is_there || is_far && rate < hz, "{hint}: {rate} at {hz} Hz");
                }
            }
        }
    }
    assert!(named > 20, "{named}");
}

#[test]
fn the_second_method_of_the_cloth_needs_the_rate_in_its_hint() {
    let scene = Scene::built_in("cloth").unwrap();
    let hint = scene.hint.clone().unwrap();
    let (_, wanted) = rates(&hint).find(|(before, _)| before.ends_with("needs ")).unwrap();
    let below = TICK_LADDER.iter().copied().filter(|hz| *hz < wanted).max().unwrap();
    for (hz, holds) in [(below, false), (wanted, true)] {
        let mut studio = Studio::new(scene.clone().at_tick_hz(hz));
        studio.apply(StageCommand::Pick(1));
        (0..4 * hz).for_each(|_| studio.tick());
        let is_whole = studio.race().entrants()[0].lane.halted().is_none();
        assert_eq!(is_whole, holds, "{hz} Hz");
    }
}
