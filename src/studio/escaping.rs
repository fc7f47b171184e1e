//! The order in which Escape takes away whatever lies over the run, and the question before the program quits.
//!
//! One press takes away one thing, and the last press only asks, so that a person who presses once too often loses
//! nothing. A page asks nothing, because it cannot quit.

use std::mem::take;

use super::Studio;
use super::ahead::shows_futures;
use super::command::{RunCommand, StageCommand};
use super::dispatch::{carry_out_on_run, carry_out_on_stage};
use super::display::DriverRequest;
use super::looping::{close_guide_and_lab, leave_loop_lab};
use crate::run::race::Mode;

/// Something visible over the run.
pub(super) struct Layer {
    /// Name in the help on the key.
    #[cfg_attr(not(test), expect(dead_code, reason = "a test compares the help with it"))]
    name: &'static str,
    /// Takes the layer away. Returns whether it was visible.
    take: fn(&mut Studio) -> bool,
}

/// What Escape takes away, one at a time, the foremost first. After these comes full screen, which only the driver can
/// leave.
pub(super) static LAYERS: [Layer; 11] = [
    Layer { name: "a body or the tick rate in hand", take: let_go },
    Layer { name: "dialog", take: |studio| studio.viewer.dialog.take().is_some() },
    Layer { name: "help", take: |studio| take(&mut studio.viewer.preferences.display.help) },
    Layer { name: "guide", take: close_guide_and_lab },
    Layer {
        name: "Edit",
        take: |studio| {
            let display = &mut studio.viewer.preferences.display;
            display.measure && !display.enlarged && take(&mut display.inspector)
        },
    },
    Layer {
        name: "instrument",
        take: |studio| take(&mut studio.viewer.preferences.display.enlarged),
    },
    Layer {
        name: "fan",
        take: |studio| {
            let is_shown = shows_futures(studio);
            if is_shown {
                studio.viewer.preferences.display.futures = false;
                studio.viewer.futures_left_ns = 0;
            }
            is_shown
        },
    },
    Layer {
        name: "comparison",
        take: |studio| studio.loops.is_none() && studio.deck.compared.take().is_some(),
    },
    Layer {
        name: "run beside",
        take: |studio| studio.loops.is_none() && studio.deck.run_beside.take().is_some(),
    },
    Layer { name: "loop lab", take: leave_loop_lab },
    Layer {
        name: "race",
        take: |studio| {
            let is_race = studio.mode() == Mode::Race;
            if is_race {
                carry_out_on_stage(studio, StageCommand::ToggleRace);
            }
            is_race
        },
    },
];

/// Takes the foremost layer away. If there is none, leaves full screen, or else asks whether to quit.
pub(super) fn escape(studio: &mut Studio) -> Option<DriverRequest> {
    if LAYERS.iter().any(|layer| (layer.take)(studio)) {
        return None;
    }
    let preferences = &studio.viewer.preferences;
    if preferences.is_full_screen {
        return Some(DriverRequest::ToggleFullScreen);
    }
    if !preferences.is_page {
        let is_saved = studio.deck.edits == studio.deck.saved_edits || preferences.is_recorded;
        let unsaved = (!is_saved).then_some("This run is not saved: `F5` saves it.");
        let lines =
            ["Quit Regatta?"].into_iter().chain(unsaved).chain(["`Enter` quits, `Esc` stays."]);
        studio.viewer.quit_question = Some(lines.map(str::to_owned).collect::<Vec<_>>().into());
    }
    None
}

/// Releases a body, which moves on from where it was taken, or the tick rate, which returns to its value before the
/// drag. Returns whether there was either.
fn let_go(studio: &mut Studio) -> bool {
    if !take(&mut studio.deck.tick_rate_is_held) {
        return studio.deck.let_go();
    }
    if studio.viewer.hz_at_press.is_some_and(|hz| hz != studio.race().tick_hz()) {
        carry_out_on_run(studio, RunCommand::Undo);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loops::loop_lab::LoopCommand;
    use crate::run::diff::{Chosen, NotComparable, Tolerance, diff};
    use crate::run::trace::Made;
    use crate::scene::{Action, Scene};
    use crate::{HeldBody, Key, RunBeside, ViewCommand, command_for, show_comparison};

    fn studio(is_race: bool, is_full_screen: bool) -> Studio {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        if is_race {
            studio.apply(StageCommand::ToggleRace);
        }
        (0..30).for_each(|_| studio.tick());
        studio.viewer.preferences.is_full_screen = is_full_screen;
        studio
    }

    fn open(studio: &mut Studio, layer: &str) {
        match layer {
            "a body or the tick rate in hand" => {
                let lane = studio.selected();
                let stepper = &lane.lane.bodies()[0].stepper;
                let (q, v, hand) = (stepper.q().into(), stepper.v().into(), stepper.place());
                let held = HeldBody { lane: lane.id, body: 0, q, v, hand, handle: hand };
                studio.apply(RunCommand::Hold(held));
            }
            "dialog" => _ = studio.apply(ViewCommand::AskForSpring),
            "help" => _ = studio.apply(ViewCommand::ToggleHelp),
            "guide" => _ = studio.apply(ViewCommand::ToggleGuide),
            "Edit" => _ = studio.apply(RunCommand::ToggleInspector),
            "instrument" => _ = studio.apply(ViewCommand::ToggleEnlarged),
            "fan" => _ = studio.apply(ViewCommand::ToggleFutures),
            "comparison" => {
                let kicked = "\n[[command]]\nat_s = 0.2\nkick = 1.0\n";
                let text = studio.deck.recording().unwrap() + kicked;
                let other = Scene::parse("other.toml", &text).unwrap();
                let runs = [other.clone(), studio.run().recording()];
                let [mut a, mut b] = runs.map(|scene| Made::of_scene(scene, 30));
                let (tolerance, chosen) = (Tolerance::default(), Chosen::default());
                let found = diff::<_, _, NotComparable>(&mut a, &mut b, tolerance, &chosen);
                show_comparison(studio, "other.toml", &found.unwrap(), other);
            }
            "run beside" => {
                let race = studio.race().clone();
                studio.deck.run_beside = Some(RunBeside::new(race).into());
            }
            "loop lab" => _ = studio.apply(LoopCommand::ToggleLab),
            "race" => _ = studio.apply(StageCommand::ToggleRace),
            other => panic!("{other}"),
        }
    }

    fn is_open(studio: &Studio, layer: &str) -> bool {
        let (display, viewer) = (studio.display(), &studio.viewer);
        match layer {
            "a body or the tick rate in hand" => studio.deck.held().is_some(),
            "dialog" => viewer.dialog.is_some(),
            "help" => display.help,
            "guide" => viewer.tour.is_some(),
            "Edit" => display.inspector,
            "instrument" => display.enlarged,
            "fan" => shows_futures(studio),
            "comparison" => studio.deck.compared.is_some(),
            "run beside" => studio.deck.run_beside.is_some(),
            "loop lab" => studio.loops.is_some(),
            "race" => studio.mode() == Mode::Race,
            other => panic!("{other}"),
        }
    }

    fn press(studio: &mut Studio, key: Key) -> Option<DriverRequest> {
        studio.apply(command_for(key).unwrap().0)
    }

    fn open_layers(studio: &Studio) -> Vec<&'static str> {
        LAYERS.iter().map(|layer| layer.name).filter(|layer| is_open(studio, layer)).collect()
    }

    #[test]
    fn escape_takes_one_layer_at_a_time_then_full_screen_and_then_asks() {
        for (is_race, is_full_screen) in
            [(false, false), (false, true), (true, false), (true, true)]
        {
            for layer in LAYERS.iter().map(|layer| layer.name) {
                let mut studio = studio(is_race, is_full_screen);
                if !is_open(&studio, layer) {
                    open(&mut studio, layer);
                }
                assert!(is_open(&studio, layer), "{layer}");
                assert_eq!(press(&mut studio, Key::Escape), None, "{layer}");
                if is_race && layer != "race" {
                    assert_eq!(open_layers(&studio), ["race"], "{layer}");
                    assert_eq!(press(&mut studio, Key::Escape), None);
                }
                assert_eq!(open_layers(&studio), Vec::<&str>::new(), "{layer}");
                assert!(studio.viewer.quit_question().is_none(), "{layer}");
                if is_full_screen {
                    let asked = press(&mut studio, Key::Escape);
                    assert_eq!(asked, Some(DriverRequest::ToggleFullScreen), "{layer}");
                    studio.viewer.preferences.is_full_screen = false;
                }
                assert_eq!(press(&mut studio, Key::Escape), None, "{layer}");
                assert!(studio.viewer.quit_question().is_some(), "{layer}");
            }
        }
    }

    #[test]
    fn escape_takes_everything_that_is_open_from_the_front_to_the_back() {
        // The guide and the loop lab have runs of their own, and the others their order over one run.
        let open_together = [
            "race",
            "comparison",
            "fan",
            "instrument",
            "help",
            "dialog",
            "a body or the tick rate in hand",
        ];
        let mut studio = studio(false, true);
        for (count, layer) in open_together.iter().enumerate() {
            if *layer == "comparison" {
                (0..30).for_each(|_| studio.tick());
            }
            open(&mut studio, layer);
            assert_eq!(open_layers(&studio).len(), count + 1, "{layer}");
        }
        for count in (0..open_together.len()).rev() {
            let front = open_layers(&studio)[0];
            assert_eq!(press(&mut studio, Key::Escape), None);
            assert!(!is_open(&studio, front), "{front}");
            assert_eq!(open_layers(&studio).len(), count, "{front}");
        }
        assert_eq!(press(&mut studio, Key::Escape), Some(DriverRequest::ToggleFullScreen));
    }

    #[test]
    fn only_enter_quits_once_asked_and_any_other_deed_or_time_stays() {
        let quits = Some(DriverRequest::Quit);
        let mut studio = studio(false, false);
        for _ in 0..9 {
            assert_ne!(press(&mut studio, Key::Escape), quits, "a hand that hammers Escape stays");
        }
        assert!(studio.viewer.quit_question().is_some());
        assert_eq!(press(&mut studio, Key::Enter), quits);
        for deed in [Key::Space, Key::Digit(2), Key::Sign('k'), Key::Sign('t')] {
            press(&mut studio, Key::Escape);
            assert!(studio.viewer.quit_question().is_some(), "{deed}");
            press(&mut studio, deed);
            assert!(studio.viewer.quit_question().is_none(), "{deed}");
            assert_eq!(press(&mut studio, Key::Enter), None, "{deed}");
            assert!(studio.display().enlarged, "{deed}: Enter enlarges again");
            press(&mut studio, Key::Escape);
        }
        press(&mut studio, Key::Escape);
        studio.apply(ViewCommand::PointAt(Some(0)));
        assert!(studio.viewer.quit_question().is_some(), "a moving pointer is no deed");
        // The first frame shows it.
        (0..2).for_each(|_| studio.viewer.pass_time(60_000_000_000));
        assert!(studio.viewer.quit_question().is_none(), "it leaves");
        studio.viewer.preferences.is_page = true;
        assert_eq!(
            (press(&mut studio, Key::Escape), press(&mut studio, Key::Escape)),
            (None, None)
        );
        assert!(studio.viewer.quit_question().is_none(), "a page cannot quit");
    }

    #[test]
    fn the_question_says_whether_the_run_is_saved() {
        let asks = |studio: &mut Studio| {
            studio.viewer.quit_question = None;
            press(studio, Key::Escape);
            studio.viewer.quit_question().unwrap().to_string()
        };
        let mut studio = studio(false, false);
        assert!(!asks(&mut studio).contains("F5"), "nobody has done anything");
        studio.apply(RunCommand::Act(Action::Kick(1.0)));
        assert!(asks(&mut studio).contains("not saved: `F5`"));
        studio.deck.note_saved();
        assert!(!asks(&mut studio).contains("F5"));
        studio.apply(RunCommand::Act(Action::Kick(2.0)));
        assert!(asks(&mut studio).contains("F5"), "it has changed since");
        studio.viewer.preferences.is_recorded = true;
        assert!(!asks(&mut studio).contains("F5"));
    }

    #[test]
    fn escape_returns_a_dragged_tick_rate_to_its_value_before_the_drag() {
        let mut studio = studio(false, false);
        studio.apply(ViewCommand::PointerDown(true));
        studio.apply(ViewCommand::HoldTickRate);
        press(&mut studio, Key::Escape);
        assert!(!studio.deck.is_tick_rate_held() && studio.race().tick_hz() == 60);
        studio.apply(ViewCommand::HoldTickRate);
        for hz in [30, 10, 20] {
            studio.apply(StageCommand::TickHz(hz.into()));
        }
        press(&mut studio, Key::Escape);
        assert!(!studio.deck.is_tick_rate_held() && studio.race().tick_hz() == 60);
        assert_eq!(studio.race().tick(), 30);
    }

    #[test]
    fn the_help_on_escape_names_its_layers_in_their_order() {
        let binding = command_for(Key::Escape).unwrap().1;
        for about in [binding.about, binding.about_on_page.unwrap()] {
            let at: Vec<_> = LAYERS.iter().map(|layer| about.find(layer.name)).collect();
            assert!(at.iter().all(Option::is_some) && at.is_sorted(), "{about}: {at:?}");
        }
    }
}
