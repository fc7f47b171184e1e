//! The jitter in which a rule ends that passes its rest by a step of fixed size.

use super::{MAX_WATCHED, Rule, WATCHED_S};

/// Number of frames in which a jitter is looked for, in two halves.
const FRAMES: usize = 240;
/// A jitter turns around in at least one of this many frames.
const TURNS: usize = 4;
/// The largest difference between the jitters of the halves, relative to them.
const SAME: f64 = 0.02;
/// The width below which a jitter is rounding, for runs from 1.
const ROUNDING: f64 = 1e-9;
/// States at which a run starts: the first number and the second.
const STARTS: [[f64; 2]; 6] =
    [[1.0, 0.0], [-0.37, 0.0], [0.37, 1.0], [2.7, 0.0], [-11.3, 0.0], [23.0, 0.0]];

/// The end of a run.
enum End {
    Rests,
    /// It turns around every few frames, over this width.
    Jitters(f64),
    Else,
}

impl Rule {
    /// Returns the width of the jitter in which runs of a rule end that is not linear, at this many frames per second.
    /// `None` if they come to rest, or move on, or if the start decides the width.
    pub fn jitter(&self, fps: f64) -> Option<f64> {
        if self.is_linear {
            return None;
        }
        let mut widest: Option<f64> = None;
        for start in STARTS {
            match (self.end_of_run(start, fps), widest) {
                (End::Else, _) => return None,
                (End::Jitters(width), Some(other)) if (width - other).abs() > SAME * other => {
                    return None;
                }
                (End::Jitters(width), _) => widest = Some(width),
                (End::Rests, _) => {}
            }
        }
        widest
    }

    fn end_of_run(&self, start: [f64; 2], fps: f64) -> End {
        let mut registers = self.text.registers();
        for (index, value) in self.state.iter().zip(start) {
            self.text.set(&mut registers, *index, value);
        }
        let h = self.step_length(fps);
        let frames = (WATCHED_S * fps).min(MAX_WATCHED) as usize;
        let places = (0..frames.max(2 * FRAMES)).map(|_| {
            self.text.step(&mut registers, h, 0.0);
            self.text.value(&registers, self.state[0])
        });
        let places: Vec<f64> = places.collect();
        let last = &places[places.len() - FRAMES..];
        let width = |places: &[f64]| {
            let least = places.iter().copied().fold(f64::INFINITY, f64::min);
            places.iter().copied().fold(f64::NEG_INFINITY, f64::max) - least
        };
        let halves = [0, FRAMES / 2].map(|from| &last[from..from + FRAMES / 2]);
        let [first, second] = halves.map(width);
        let moved = halves.map(|half| half.iter().sum::<f64>() / half.len() as f64);
        let steps = last.windows(2).map(|pair| pair[1] - pair[0]);
        let steps: Vec<f64> = steps.filter(|step| step.abs() > ROUNDING).collect();
        let turns = steps.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
        let is_steady =
            [first - second, moved[0] - moved[1]].iter().all(|apart| apart.abs() <= SAME * second);
        match second > ROUNDING {
            false if second.is_finite() => End::Rests,
            true if is_steady && turns * TURNS >= FRAMES => End::Jitters(second),
            _ => End::Else,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_of_fixed_size_ends_in_a_jitter_and_one_that_stops_does_not() {
        for (lines, wanted) in [
            ("if x < target { x += 3*dt } else { x -= 3*dt }", Some(0.05)),
            ("if x < target { x += 0.5 } if x > target { x -= 0.25 }", Some(0.25)),
            ("x += sign(target - x)*0.5", Some(0.5)),
            ("v -= sign(v)*0.3; x += v", None),
            ("x = round(x + (target - x)*2.2)", None),
            ("if x < target { v += 1 } else { v -= 1 } x += v", None),
            ("v += 0.2*sign(target - x); v *= 0.9; x += v", None),
            ("x += (target - x)*0.1; if x > 0 { x -= 0.02 }", None),
            ("x = move_toward(x, target, 3*dt)", None),
            ("v -= 10*dt; x += v*dt; if x < 0 { x = 0; v = 10 }", None),
            ("if x > 0 { v -= 9*dt } else { v += 9*dt } x += v*dt", None),
            ("v += 60*dt; v = min(v, 5); x += v*dt", None),
            ("x += (target - x)*0.1", None),
        ] {
            let found = Rule::read(lines, 60.0).unwrap().jitter(60.0);
            assert_eq!(found.is_some(), wanted.is_some(), "{lines}: {found:?}");
            let apart = found.zip(wanted).map(|(found, wanted)| (found - wanted).abs());
            assert!(apart.is_none_or(|apart| apart < 1e-9), "{lines}: {found:?}");
        }
    }
}
