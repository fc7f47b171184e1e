//! Whether the run of a link is here what it was where it was made.

use regatta::run::Replay;
use regatta::scene::Check;

/// The ticks of a slice of the race: a moment's work, even of many lanes.
const TICKS: u64 = 50;

/// Goes on with the replay for a slice. Returns what to say of the run once that is known.
pub(crate) fn told_after_slice(replay: &mut Replay) -> Option<String> {
    let last = replay.scene().checks.iter().map(|check| check.tick).max()?;
    let reached = replay.go_on(TICKS, &mut ());
    if let Some(reached) = reached {
        let Check { tick, hash, .. } = replay.scene().checks[reached.row];
        if reached.hash != Some(hash) {
            return Some(format!("not the run that was made: they differ from tick {tick} on"));
        }
    }
    replay.is_over().then(|| format!("the same to the bit as where it was made, to tick {last}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use regatta::run::Session;
    use regatta::scene::Scene;

    #[test]
    fn the_run_is_the_same_or_parts_at_a_tick() {
        let mut session = Session::racing(Scene::built_in("ship").unwrap().into());
        session.run(200);
        let mut recording = session.recording(200);
        let told = |scene: &Scene| {
            let mut replay = Replay::new(scene.clone().into());
            std::iter::from_fn(|| Some(told_after_slice(&mut replay))).find_map(|told| told)
        };
        assert!(told(&recording).unwrap().ends_with("where it was made, to tick 200"));
        recording.checks.last_mut().unwrap().hash ^= 1;
        assert!(told(&recording).unwrap().ends_with("from tick 200 on"));
    }
}
