use super::*;
use crate::loops::loop_lab::LoopWorker;
use crate::scene::{Action, SCENES, Scene};
use crate::{Command, RunCommand, StageCommand};

#[test]
fn the_loop_lab_refuses_a_net_with_the_reason() {
    let mut studio = Studio::new(Scene::built_in("rope").unwrap());
    studio.apply(Command::Loop(LoopCommand::ToggleLab));
    assert!(studio.loop_lab().is_none());
    assert!(studio.viewer.notice.as_ref().is_some_and(|told| told.starts_with("rope is a net")));
}

#[test]
fn opening_a_net_leaves_the_loop_lab_with_the_reason() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.apply(Command::Loop(LoopCommand::ToggleLab));
    assert!(studio.loop_lab().is_some());
    let rope = SCENES.iter().position(|scene| scene.name == "rope").unwrap();
    studio.apply(StageCommand::Scene(rope));
    assert!(studio.loop_lab().is_none());
    assert_eq!(studio.deck.scene_name(), "rope");
    let notice = studio.viewer.notice.as_deref().unwrap_or_default();
    assert!(notice.contains("is a net, which the loop lab does not take"), "{notice}");
}

#[test]
fn opening_and_choosing_run_nothing_and_loops_appear_when_finished() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.apply(Command::Loop(LoopCommand::ToggleLab));
    let shown =
        |studio: &Studio| studio.loop_lab().unwrap().lanes().iter().filter(|l| l.was_run()).count();
    assert_eq!(shown(&studio), 0);
    let request = loop_request(&studio);
    let mut worker = LoopWorker::default();
    worker.set_request(request.clone());
    studio.advance(1_000_000_000);
    accept_loop(&mut studio, worker.work(&|| false).unwrap());
    let loops = studio.loop_lab().unwrap();
    assert!(loops.lanes()[loops.on_stage()[0]].was_run(), "what is on the stage comes first");
    assert_eq!((loops.now_ns(), loops.is_stage_complete()), (0, false), "time waits for the stage");
    let late = worker.work(&|| false).unwrap();
    studio.apply(StageCommand::TickRate(Step::Next));
    assert_eq!(shown(&studio), 0, "all of them are of the old rate");
    accept_loop(&mut studio, late);
    assert_eq!(shown(&studio), 0, "and so is one that comes late");
    run_loops(&mut studio);
    assert!(loop_request(&studio).is_none(), "it has all");
}

#[test]
fn the_loop_lab_shields_the_run_behind_it_from_every_command() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    (0..40).for_each(|_| studio.tick());
    studio.apply(Command::Loop(LoopCommand::ToggleLab));
    let before =
        (studio.race().state_hash(), studio.clock().speed_percent(), studio.scene().seconds);
    for command in [
        Command::Run(RunCommand::Act(Action::Kick(1.0))),
        Command::Run(RunCommand::Seek(3)),
        Command::Run(RunCommand::Undo),
        Command::Run(RunCommand::SpeedPercent(400)),
        Command::Run(RunCommand::Seconds(7.0)),
        Command::Run(RunCommand::MapParameter(1)),
        Command::Run(RunCommand::ToggleEqualCost),
    ] {
        assert_eq!(studio.apply(command.clone()), None);
        let now =
            (studio.race().state_hash(), studio.clock().speed_percent(), studio.scene().seconds);
        assert_eq!(now, before, "{command:?}");
        assert_eq!(studio.view().mapped_parameter, None);
        let notice = studio.viewer.notice.as_deref().unwrap_or_default();
        assert_eq!(notice, "not in the loop lab: L leaves it", "{command:?}");
    }
}
