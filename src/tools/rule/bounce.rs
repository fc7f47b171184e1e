//! What the lines of a rule do to the bounces of a ball.
//!
//! Under gravity every impact adds (s + κ) g h to the speed of a ball that loses none. The step decides s: -1 for
//! semi-implicit Euler, 0 for an exact fall, 1 for explicit Euler. The line for the impact decides κ. It is 0 where the
//! line keeps the energy, 0.5 where it puts the ball on the floor, and 1 where it mirrors the place.

use super::Rule;
use crate::sim::law::StepRegisters;

/// Duration of the first fall in seconds, which is that from 1 m on Earth.
const FALL_S: f64 = 0.451_523_640_985_730_9;
/// Distance in units from the floor at which a ball falls freely.
const ALOFT: f64 = 1e5;
/// Frames per second at which a single impact shows the limit of short frames.
const FINE_FPS: f64 = 1e6;
/// Number of frames after an impact in which the lines may still know of it.
const FRAMES_AFTER: u32 = 3;
/// Number of starts, whose heights and speeds differ, and the part of the height and of the speed by which they do.
const STARTS: u32 = 64;
const HIGHER: f64 = 0.1;
const FASTER: f64 = 0.07;
/// Numbers of impacts after which the height is compared, and maximum number of frames for them.
const AFTER: [usize; 3] = [1, 5, 10];
const MAX_FRAMES: u32 = 20_000;
/// Largest relative difference of the restitutions at two speeds.
const ALIKE: f64 = 1e-4;
/// Relative rounding error of a free fall.
const ROUNDING: f64 = 1e-6;

/// A ball that falls onto a floor and is turned there, in the units of the rule.
#[derive(Clone, Debug, PartialEq)]
pub struct RuleBounce {
    /// g, the acceleration of the fall.
    pub gravity: f64,
    /// e, the part of the speed that an impact leaves.
    pub restitution: f64,
    /// The place of the floor.
    pub floor: f64,
    /// s, by the step.
    pub s: f64,
    /// κ, by the line for the impact.
    pub kappa: f64,
    /// The heights at each frame rate, with the lowest rate first.
    pub seen: Vec<BouncesSeen>,
}

/// The bounces of a rule at a frame rate.
#[derive(Clone, Debug, PartialEq)]
pub struct BouncesSeen {
    /// Frames per second.
    pub fps: f64,
    /// Heights after 1, 5 and 10 impacts over the true ones, as means of many starts. `None` if not all starts get
    /// there.
    pub heights: [Option<f64>; 3],
}

/// A free fall: its acceleration, the part of `g h²` in the way of a step, and the side of the floor on which it is.
#[derive(Clone, Copy)]
struct Fall {
    acceleration: f64,
    way: f64,
    side: f64,
}

impl Fall {
    /// Returns the place and the velocity after a free step of `h` (s).
    fn step(self, [x, v]: [f64; 2], h: f64) -> [f64; 2] {
        [x + v * h + self.way * self.acceleration * h * h, v + self.acceleration * h]
    }

    /// Returns the place and the velocity before a free step of `h` (s).
    fn back(self, [x, v]: [f64; 2], h: f64) -> [f64; 2] {
        let v = v - self.acceleration * h;
        [x - v * h - self.way * self.acceleration * h * h, v]
    }
}

/// A rule whose places are counted from a floor.
struct OverFloor<'r> {
    rule: &'r Rule,
    floor: f64,
}

impl Rule {
    /// Returns what the rule does to bounces; `None` if it is no fall onto a floor at 0, or at a number in its lines.
    pub fn bounce(&self) -> Option<RuleBounce> {
        let is_of_two = self.text.with_causes(vec![0]).iter().all(|index| *index < 2);
        if !is_of_two || self.is_linear || self.text.carried().len() < 2 {
            return None;
        }
        let numbers = self.text.source().split(|it: char| !it.is_ascii_digit() && it != '.');
        let floors = numbers.filter_map(|it| it.parse::<f64>().ok()).flat_map(|it| [it, -it]);
        let mut floors = std::iter::once(0.0).chain(floors);
        floors.find_map(|floor| OverFloor { rule: self, floor }.bounce())
    }
}

impl OverFloor<'_> {
    fn bounce(&self) -> Option<RuleBounce> {
        let fall = self.fall()?;
        let gravity = fall.acceleration.abs();
        let fast = gravity * FALL_S;
        let kept = |fast: f64| {
            let at = |fps: f64| {
                self.hit(fall, 1e-6, fast, fps).map(|[before, after]| -after[1] / before[1])
            };
            // What an impact adds grows with the frame, and is no part of the speed.
            Some(2.0 * at(2.0 * FINE_FPS)? - at(FINE_FPS)?)
        };
        let restitution = kept(fast)?;
        // A speed that is not a part of the one before is no restitution.
        if (kept(2.0 * fast)? / restitution - 1.0).abs() > ALIKE {
            return None;
        }
        let speed = |[x, v]: [f64; 2], kept: f64| {
            let energy = (v / kept) * (v / kept) + 2.0 * gravity * x * fall.side;
            energy.max(0.0).sqrt()
        };
        let [before, after] = self.hit(fall, 0.5, fast, FINE_FPS)?;
        let kappa = (speed(after, restitution) - speed(before, 1.0)) * FINE_FPS / gravity;
        if !(restitution > 0.0 && restitution < 1.5) || kappa.abs() > 3.0 {
            return None;
        }
        let heights = |fps| self.heights(fall, restitution, fps);
        let rates = self.rule.rates().into_iter();
        let seen = rates.map(|fps| BouncesSeen { fps, heights: heights(fps) }).collect();
        let s = 1.0 - 2.0 * fall.way;
        Some(RuleBounce { gravity, restitution, floor: self.floor, s, kappa, seen })
    }

    /// Returns the states before and after an impact at this speed, both at the end of the frame that crosses the
    /// floor. It ends this part of its way below.
    fn hit(&self, fall: Fall, part: f64, fast: f64, fps: f64) -> Option<[[f64; 2]; 2]> {
        let h = 1.0 / fps;
        let start = [fall.side * fast * h * (1.0 - part), -fall.side * fast];
        let is_turned = |[_, v]: [f64; 2]| v * fall.side > 0.0;
        // The line for the impact may stand before the step, and what it leaves may hold up the fall for a frame.
        let crossed = self.frame_of(start, fps);
        let mut frames = u32::from(!is_turned(crossed));
        let mut after = if frames == 0 { crossed } else { self.frame_of(crossed, fps) };
        let before = if frames == 0 { fall.step(start, h) } else { crossed };
        if !is_turned(after) {
            return None;
        }
        let mut later = after;
        for _ in 0..FRAMES_AFTER {
            later = self.frame_of(later, fps);
        }
        if is_turned(later) {
            (after, frames) = (later, frames + FRAMES_AFTER);
        }
        Some([before, (0..frames).fold(after, |state, _| fall.back(state, h))])
    }

    /// Returns the place and the velocity after a frame.
    fn frame_of(&self, state: [f64; 2], fps: f64) -> [f64; 2] {
        self.next_frame(&mut self.rule.text.registers(), state, fps)
    }

    fn next_frame(&self, registers: &mut StepRegisters, [x, v]: [f64; 2], fps: f64) -> [f64; 2] {
        let text = &self.rule.text;
        text.set(registers, 0, x + self.floor);
        text.set(registers, 1, v);
        text.step(registers, self.rule.step_length(fps), 0.0);
        [text.value(registers, 0) - self.floor, text.value(registers, 1)]
    }

    /// Returns the free fall of the rule, if it has one.
    fn fall(&self) -> Option<Fall> {
        [1.0, -1.0].into_iter().find_map(|side| self.fall_on(side))
    }

    /// Returns the free fall on this side of the floor.
    fn fall_on(&self, side: f64) -> Option<Fall> {
        let gained = |side: f64, fps: f64| self.frame_of([side * ALOFT, 0.0], fps)[1] * fps;
        let own_fps = self.rule.fps;
        let acceleration = gained(side, own_fps);
        let is_alike = |other: f64| (other / acceleration - 1.0).abs() < ROUNDING;
        let falls = acceleration.is_finite() && acceleration * side < 0.0;
        let moving = self.frame_of([2.0 * side * ALOFT, 1.0], own_fps)[1] - 1.0;
        let is_free = is_alike(gained(side, 3.0 * own_fps)) && is_alike(moving * own_fps);
        if !falls || !is_free {
            return None;
        }
        // From 0, where no digits of the way are lost; the floor lies on the other side.
        let near = side * acceleration.abs();
        let moved = self.frame_of([near, 0.0], own_fps)[0] - near;
        let way = moved * own_fps * own_fps / acceleration;
        (-ROUNDING..1.0 + ROUNDING).contains(&way).then_some(Fall { acceleration, way, side })
    }

    /// Returns the mean heights after the impacts over the true ones.
    fn heights(&self, fall: Fall, restitution: f64, fps: f64) -> [Option<f64>; 3] {
        let gravity = fall.acceleration.abs();
        let mut sums = AFTER.map(|_| Some(0.0));
        for start in 0..STARTS {
            let part = f64::from(start) / f64::from(STARTS);
            // The fraction of multiples of an irrational number spreads the speeds evenly over the heights.
            let speed =
                FASTER * gravity * FALL_S * (f64::from(start) * 0.618_033_988_749_894_9).fract();
            let height = 0.5 * gravity * FALL_S * FALL_S * (1.0 + HIGHER * (part - 0.5));
            let found = self.apexes([fall.side * height, fall.side * speed], fall.side, fps);
            let top = height + speed * speed / (2.0 * gravity);
            for ((sum, after), apex) in sums.iter_mut().zip(AFTER).zip(found) {
                let kept = libm::pow(restitution, 2.0 * after as f64);
                *sum = sum.zip(apex).map(|(sum, apex)| sum + apex / (top * kept));
            }
        }
        sums.map(|sum| sum.map(|sum| sum / f64::from(STARTS)))
    }

    /// Returns the heights after the impacts of one run, each by the parabola through the three highest frames.
    fn apexes(&self, start: [f64; 2], side: f64, fps: f64) -> [Option<f64>; 3] {
        let mut found = AFTER.map(|_| None);
        let (mut state, mut flight, mut impacts) = (start, vec![side * start[0]], 0);
        let mut registers = self.rule.text.registers();
        for _ in 0..MAX_FRAMES {
            let next = self.next_frame(&mut registers, state, fps);
            if !next.iter().all(|number| number.is_finite()) {
                break;
            }
            if state[1] * side < 0.0 && next[1] * side > 0.0 {
                if let Some(at) = AFTER.iter().position(|after| *after == impacts) {
                    found[at] = Some(apex(&flight));
                }
                if impacts == AFTER[2] {
                    break;
                }
                impacts += 1;
                flight.clear();
            }
            flight.push(side * next[0]);
            state = next;
        }
        found
    }
}

/// Returns the height of the parabola through the highest place and its neighbours.
fn apex(flight: &[f64]) -> f64 {
    let highest = (0..flight.len()).max_by(|a, b| flight[*a].total_cmp(&flight[*b]));
    let highest = highest.unwrap_or_default();
    let middle = highest.clamp(1, flight.len().saturating_sub(2).max(1));
    let [Some(before), Some(at), Some(after)] =
        [middle - 1, middle, middle + 1].map(|index| flight.get(index))
    else {
        return flight.get(highest).copied().unwrap_or_default();
    };
    let (slope, bend) = ((after - before) / 2.0, after - 2.0 * at + before);
    if bend < 0.0 { at - slope * slope / (2.0 * bend) } else { flight[highest] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounce(lines: &str) -> RuleBounce {
        Rule::read(lines, 60.0).unwrap().bounce().unwrap_or_else(|| panic!("{lines}"))
    }

    #[test]
    fn the_step_and_the_line_at_the_floor_have_the_numbers_of_the_formula() {
        let steps = [
            (-1.0, "v -= 9.81*dt; x += v*dt; "),
            (0.0, "x += v*dt - 4.905*dt*dt; v -= 9.81*dt; "),
            (1.0, "x += v*dt; v -= 9.81*dt; "),
        ];
        let floors = [
            (0.0, "if x < 0 && v < 0 { v = -E*v }"),
            (0.5, "if x < 0 { x = 0; v = -E*v }"),
            (1.0, "if x < 0 { x = -x; v = -E*v }"),
            (0.0, "if x < 0 { v = E*sqrt(v*v + 2*9.81*x); x = 0 }"),
        ];
        for (s, step) in steps {
            for (kappa, floor) in floors {
                for e in [1.0, 0.8] {
                    let floor = floor.replace('E', &e.to_string());
                    for lines in [format!("{step}{floor}"), format!("{floor}\n{step}")] {
                        let found = bounce(&lines);
                        assert!((found.gravity - 9.81).abs() < 1e-6, "{lines}: {found:?}");
                        assert!((found.restitution - e).abs() < 1e-5, "{lines}: {found:?}");
                        assert!((found.s - s).abs() < 1e-5, "{lines}: {found:?}");
                        assert!((found.kappa - kappa).abs() < 1e-3, "{lines}: {found:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_floor_amid_the_lines_or_elsewhere_has_the_numbers_of_the_formula() {
        for (gain, lines) in [
            (0.0, "if x < 0 && v < 0 { v = -v } else { v -= 9.81*dt } x += v*dt"),
            (-0.5, "x += v*dt; if x < 0 { x = 0; v = -v } v -= 9.81*dt"),
            (0.0, "x += v*dt; if x < 0 { x = -x; v = -v } v -= 9.81*dt"),
            (1.5, "v -= 9.81*dt; if x < 0 { x = 0; v = -v } x += v*dt"),
            (1.0, "v -= 9.81*dt; if x < 0 && v < 0 { v = -v } x += v*dt"),
            (0.5, "v -= 9.81*dt; if x < 0 { x = 0; v = -v } else { x += v*dt }"),
            (0.5, "if x > 0 { v -= 9.81*dt } x += v*dt; if x < 0 { x = 0; v = -v }"),
            (-2.0, "old = v; v -= 9.81*dt; x += v*dt; if x < 0 && v < 0 { v = -old }"),
            (-0.5, "v -= 4.905*dt; x += v*dt; if x < 0 { x = 0; v = -v } v -= 4.905*dt"),
            (-0.5, "v -= 9.81*dt; x += v*dt; if x < 1.5 { x = 1.5; v = -v }"),
            (0.0, "v += 980*dt; x += v*dt; if x > 600 { x = 1200 - x; v = -v }"),
        ] {
            let found = bounce(lines);
            assert!((found.s + found.kappa - gain).abs() < 1e-3, "{lines}: {found:?}");
            // An impact that adds to the speed is seen as one too high, after ten of them.
            let height = found.seen[2].heights[2].unwrap();
            let is_seen = if gain == 0.0 {
                (0.98..1.1).contains(&height)
            } else {
                (height > 1.0) == (gain > 0.0)
            };
            assert!(is_seen, "{lines}: {height}");
        }
    }

    #[test]
    fn heights_over_the_true_ones_are_those_of_independent_runs() {
        let semi_implicit = "v -= 9.81*dt; x += v*dt; ";
        let verlet = "x += v*dt - 4.905*dt*dt; v -= 9.81*dt; ";
        // Means of 200 other starts.
        for (step, e, at, wanted) in [
            (semi_implicit, 1.0, 2, [0.394, 0.662, 0.852]),
            (verlet, 1.0, 2, [1.867, 1.403, 1.159]),
            (semi_implicit, 0.8, 1, [0.463, 0.646, 0.845]),
            (verlet, 0.8, 1, [1.72, 1.339, 1.127]),
        ] {
            let found = bounce(&format!("{step}if x < 0 {{ x = 0; v = -{e}*v }}"));
            for (fps, wanted) in [30.0, 60.0, 144.0].into_iter().zip(wanted) {
                let seen = found.seen.iter().find(|seen| seen.fps == fps).unwrap();
                let height = seen.heights[at].unwrap();
                assert!((height / wanted - 1.0).abs() < 0.03, "{step} {e} {fps}: {height}");
            }
        }
    }

    #[test]
    fn a_floor_below_the_screen_is_one_too_and_other_rules_have_no_bounces() {
        let down = bounce("v += 980*dt; x += v*dt; if x > 0 { x = 0; v = -0.5*v }");
        assert!((down.gravity - 980.0).abs() < 1e-3 && (down.kappa - 0.5).abs() < 1e-3);
        for lines in [
            "x += (target - x)*8*dt",
            "v -= 9.81*dt; x += v*dt",
            "v = (v + (target - x)*0.2)*0.85; x += v",
            "v -= 9.81*dt; x += v*dt; if x < 0 { x = 0; v = 0 }",
            "v -= 9.81*dt; x += v*dt; if x < 0 { x = 0; v = 5 }",
            "v -= 9.81*dt; x += v*dt; if x < 0 { x = 0; v = -v - 0.1 }",
        ] {
            assert_eq!(Rule::read(lines, 60.0).unwrap().bounce(), None, "{lines}");
        }
    }
}
