//! Rules whose steps are rounded, which no map describes.

use super::{MAX_WATCHED, Rule, WATCHED_S};
use crate::sim::law::StepText;

/// Words of functions that turn a number around.
const TURNS: [&str; 6] = ["mod", "%", "wrap", "repeat", "angle", "rotate"];

/// Distance from the target at which a run with rounded steps starts.
pub const ROUNDED_START: f64 = 100.0;

/// The target of runs with rounded steps.
pub const ROUNDED_TARGET: f64 = 1000.0;

/// Numbers at which a rule is tried for turns.
const TRIED: [f64; 6] = [0.37, -1.9, 7.3, -23.1, 61.7, -3.3];
/// The rounding error of a frame from there, relative to the turn.
const ROUNDING: f64 = 1e-9;

/// Returns the source of a rounding that makes the steps of these carried numbers, in place of turning them.
pub(super) fn rounding<'t>(text: &'t StepText, state: &[usize], h: f64) -> Option<&'t str> {
    let all = text.roundings(h, state).into_iter();
    let mut all = all.filter(|(source, slopes)| !turns(source) && !is_turn(text, state, h, slopes));
    all.next().map(|(source, _)| source)
}

/// Whether a frame from another turn of an operand with these slopes ends in the same place, or a turn apart.
fn is_turn(text: &StepText, state: &[usize], h: f64, slopes: &[f64]) -> bool {
    let mut registers = text.registers();
    let mut frame = |at: &[f64]| {
        state.iter().zip(at).for_each(|(index, value)| text.set(&mut registers, *index, *value));
        text.step(&mut registers, h, 0.0);
        state.iter().map(|index| text.value(&registers, *index)).collect::<Vec<f64>>()
    };
    (0..TRIED.len()).all(|shift| {
        let at: Vec<f64> = (0..state.len()).map(|n| TRIED[(shift + n) % TRIED.len()]).collect();
        let here = frame(&at);
        let turned = slopes.iter().enumerate().filter(|(_, slope)| **slope != 0.0);
        turned.into_iter().all(|(row, slope)| {
            let turn = 1.0 / slope;
            let [near, far] = [1e-6, turn].map(|way| {
                let mut at = at.clone();
                at[row] += way;
                frame(&at)
            });
            // A number that stays while another moves is rounded.
            let moves = near[row] != here[row];
            let is = |index: usize, way: f64| {
                (far[index] - here[index] - way).abs() <= ROUNDING * (turn.abs() + at[row].abs())
            };
            let is_same = (0..state.len()).all(|index| is(index, 0.0));
            let is_next =
                (0..state.len()).all(|index| is(index, if index == row { turn } else { 0.0 }));
            moves && (is_same || is_next)
        })
    })
}

/// Whether the function turns a number around, in place of rounding.
pub(super) fn turns(source: &str) -> bool {
    TURNS.iter().any(|word| source.to_ascii_lowercase().contains(word))
}

impl Rule {
    /// Returns where a run ends that starts at rest [`ROUNDED_START`] above the target (`side` 1) or below it (-1), as
    /// its distance above the target, and when, in seconds. The target is [`ROUNDED_TARGET`]. `None` if the run does
    /// not end, or the rule has no target.
    pub fn run_ends(&self, side: f64) -> Option<[f64; 2]> {
        self.run_to(ROUNDED_TARGET, side)
    }

    /// Whether the target decides how far from it such runs end.
    pub fn ends_by_target(&self) -> bool {
        [1.0, -1.0].iter().any(|side| {
            let first = self.run_ends(*side);
            [0.0, -ROUNDED_TARGET].iter().any(|target| self.run_to(*target, *side) != first)
        })
    }

    fn run_to(&self, target: f64, side: f64) -> Option<[f64; 2]> {
        let text = &self.text;
        if !text.takes_target() {
            return None;
        }
        let mut registers = text.registers();
        text.set(&mut registers, self.state[0], target + side * ROUNDED_START);
        let frames = (WATCHED_S * self.fps).min(MAX_WATCHED) as u32;
        let mut before = Vec::new();
        for frame in 0..frames {
            let at: Vec<f64> =
                self.state.iter().map(|index| text.value(&registers, *index)).collect();
            if before == at {
                return Some([at[0] - target, f64::from(frame - 1) / self.fps]);
            }
            text.step(&mut registers, self.step_length(self.fps), target);
            before = at;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::Rule;

    #[test]
    fn rounded_steps_have_no_rate_and_end_where_a_run_ends() {
        for (lines, ends) in [
            ("x += floor((target - x)/8)", [0.0, -7.0]),
            ("x += ceil((target - x)/8)", [7.0, 0.0]),
            ("x += trunc((target - x)/8)", [7.0, -7.0]),
            ("x += int((target - x)/8)", [7.0, -7.0]),
            ("x += round((target - x)/8)", [3.0, -3.0]),
            ("x += Math.round((target - x) * 0.1)", [5.0, -4.0]),
            ("x += Mathf.Round((target - x) * 0.1)", [5.0, -5.0]),
            ("x = round(x + (target - x) * 0.1)", [5.0, -4.0]),
            ("x = int(x + (target - x) * 0.1)", [0.0, -9.0]),
            ("x = (x + (target - x) * 0.1) | 0", [0.0, -9.0]),
            ("x += (target - x) * 0.1; x = floor(x)", [0.0, -9.0]),
            ("let step = round((target - x)/8); x += clamp(step, -2, 2)", [3.0, -3.0]),
            ("x += floor(abs(target - x)/8) * sign(target - x)", [7.0, -7.0]),
        ] {
            let rule = Rule::read(lines, 60.0).unwrap();
            let pieces = rule.pieces();
            let [piece] = &pieces[..] else { panic!("{lines}: {pieces:?}") };
            assert!(piece.rule.is_rounded, "{lines}");
            let found = [1.0, -1.0].map(|side| piece.rule.run_ends(side).map(|[above, _]| above));
            assert_eq!(found, ends.map(Some), "{lines}");
            // Halves go away from 0, and a fraction is dropped towards it.
            let is_absolute =
                ["x = round", "x = int", "x = (x"].iter().any(|it| lines.starts_with(it));
            assert_eq!(piece.rule.ends_by_target(), is_absolute, "{lines}");
            for seen in [rule.motions(), piece.motions()].concat() {
                let rates = [seen.hz, seen.halves_s, seen.settles_s, seen.top_speed];
                assert_eq!(rates, [None; 4], "{lines}: {seen:?}");
            }
        }
        let fall = Rule::read("v = round(v - 800 * dt); x += v * dt", 60.0).unwrap().pieces();
        assert!(fall[0].rule.is_rounded && fall[0].rule.run_ends(1.0).is_none());
    }

    #[test]
    fn a_rounding_that_turns_a_number_or_rounds_no_moving_one_leaves_the_rate() {
        for lines in [
            "let d = target - x; x += (d - 2*pi*round(d/(2*pi))) * 0.1",
            "let d = target - x; x += (d - 2*pi*floor((d + pi)/(2*pi))) * 0.1",
            "x += (mod(target - x + pi, 2*pi) - pi) * 0.1",
            "x += (floor(target) - x) * 0.1",
            "x += (target - x) * 0.1; v = round(v)",
            "x += (target - x) * 0.1 * round(dt * 60)",
        ] {
            let rule = Rule::read(lines, 60.0).unwrap();
            let pieces = rule.pieces();
            let halves = rule.motion_at(60.0).halves_s;
            let halves = halves.or(pieces.first().and_then(|it| it.rule.motion_at(60.0).halves_s));
            assert!(halves.is_some_and(|s| (s - 0.1096).abs() < 1e-3), "{lines}: {pieces:?}");
        }
    }
}
