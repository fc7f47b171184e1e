//! A rule as a scene, which is a race of the rule's lines at three frame rates beside their motion at the author's
//! rate.

use super::Rule;
use crate::scene::{Scene, SceneErrors, own_table, tick_rate_line};
use crate::sim::TickRate;
use crate::sim::law::{ExpressionFault, Remedy, RuleBody};
use crate::sim::number::significant;
use crate::sim::{check_own_id, linear_rule, own_method_id, own_rule};

/// Number of frames of each lane per tick. A tick lasts two frames of the author. So the second lane runs at the
/// author's rate, the first one at half that rate and the last one at twice that rate.
const SUBSTEPS: [u32; 3] = [1, 2, 4];
/// Length of each of three starts, in settling times or, if the rule never settles, in swings.
const SETTLINGS: f64 = 1.5;
const SWINGS: f64 = 6.0;
/// Shortest and longest length of a start, in seconds.
const SHOWN_S: [f64; 2] = [2.0, 20.0];
/// Kick that brings a follower from its target back to its start, in kicks of half a metre.
const KICK_BACK: f64 = -2.0;

/// Returns the scene of the rule in a file of this name, written for this many frames per second. The scene has the
/// body that the rule moves like, and a race of the lines at half, once and twice that rate.
///
/// # Errors
/// Fails with the first fault of the lines, or with the reason why no body of a scene moves like them.
pub fn rule_scene(file: &str, text: &str, fps: TickRate) -> Result<Scene, SceneErrors> {
    let of_text = |fault| SceneErrors::of_step(file, text, fault);
    let stem = file.rsplit(['/', '\\']).next().unwrap_or(file);
    let stem = stem.split_once('.').map_or(stem, |(stem, _)| stem);
    let id = own_method_id(stem);
    let refused = |[what, remedy]: [String; 2]| {
        of_text(ExpressionFault { span: 0..0, what, remedy: Remedy::Words(remedy) })
    };
    check_own_id(&id).map_err(|[what, remedy]| {
        refused([format!("the rule is called by its file, and {what}"), remedy])
    })?;
    let method = own_rule(&id, text, fps).map_err(of_text)?;
    let rule = linear_rule(text, fps).map_err(of_text)?;
    let seen = Rule::read(text, fps.hz()).map_err(of_text)?.motion_at(fps.hz());
    let tick_hz = fps.scaled(1, 2);
    let body = rule.body();
    let grows = match body {
        RuleBody::Follower { rate: decay } | RuleBody::Coasting { drag: decay } => decay <= 0.0,
        RuleBody::Spring { stiffness, damping } => stiffness <= 0.0 || damping < 0.0,
    };
    if grows {
        return Err(refused([
            format!("the rule grows at {fps} frames per second, as no body of a scene does"),
            "`regatta rule` says how; give `--fps` the rate for which it was written".into(),
        ]));
    }
    let shown_s = match (seen.settles_s, seen.hz) {
        (Some(settles_s), _) => SETTLINGS * settles_s,
        (None, Some(hz)) => SWINGS / hz,
        (None, None) => SHOWN_S[1],
    };
    let shown_s = significant(shown_s.clamp(SHOWN_S[0], SHOWN_S[1]), 2);
    let shown_s: f64 = shown_s.parse().unwrap_or(SHOWN_S[1]);
    let seconds = [1.0, 2.0, 3.0].map(|n| significant(n * shown_s, 4));
    let kick = if let RuleBody::Follower { .. } = body { KICK_BACK } else { 1.0 };
    let [again, once_more, end] = seconds;
    let commands =
        [again, once_more].map(|at_s| format!("\n[[command]]\nat_s = {at_s}\nkick = {kick:?}\n"));
    let lanes =
        SUBSTEPS.map(|substeps| format!("\n[[lane]]\nmethod = \"{id}\"\nsubsteps = {substeps}\n"));
    let rates = SUBSTEPS.map(|substeps| tick_hz.scaled(substeps, 1));
    let [slow, own, fast] = rates.map(|rate| format!("{rate:.3}"));
    let text = format!(
        "title = \"A rule at {slow}, {own} and {fast} frames a second\"\n\
         about = \"The lines of {id}, once a frame. They were written for {own} frames a second: their motion at that rate is the exact one here, and each lane runs the same lines at another.\"\n\
         hint = \"Press `[` or `]`: at other tick rates the lanes part from the exact motion, for all run their lines more or less often.\"\n\
         {}seconds = {end}\n\n[race]\nopen = true\n{}{}{}{}",
        tick_rate_line(tick_hz),
        own_table(method),
        lanes.concat(),
        body_table(&id, body, rule.start_velocity(1.0)),
        commands.concat(),
    );
    Scene::parse(&id, &text)
}

/// Writes the body as a table of a scene. The body starts 1 m from its rest with the velocity `v0` (m/s); a coasting
/// body starts at 1 m/s.
fn body_table(id: &str, body: RuleBody, v0: f64) -> String {
    match body {
        RuleBody::Follower { rate } => format!(
            "\n[[follow]]\nname = \"{id}\"\norder = 1\nrate_per_s = {rate:?}\nstep_m = 1.0\n"
        ),
        RuleBody::Spring { stiffness, damping } => format!(
            "\n[[spring]]\nname = \"{id}\"\nmass_kg = 1.0\nstiffness_n_per_m = {stiffness:?}\n\
             damping_n_s_per_m = {damping:?}\nx0_m = 1.0\nv0_m_per_s = {v0:?}\nkick_n_s = {:?}\n",
            stiffness.sqrt()
        ),
        RuleBody::Coasting { drag } => format!(
            "\n[[law]]\nname = \"{id}\"\ndraw = \"follower\"\nconstants = {{ c = {drag:?} }}\n[law.coordinates.x]\nunit = \"m\"\n\
             start_velocity = 1.0\nacceleration = \"-c*vx\"\n"
        ),
    }
}
