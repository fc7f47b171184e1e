//! Writes a rule as code that moves the same at any frame rate, in the language of `assets/methods`.

use nalgebra::{Matrix2, Vector2};

use super::{Piece, Rule};
use crate::sim::law::{AT_TARGET, Frame, NO_RETURN, Powers, SwitchKind};
use crate::source_code::{CodeForm, RULE_STEP, rule_code, rule_lines, rule_names};

/// If the logarithms of the eigenvalues are this far apart, the code has two exponentials. If they are closer, the
/// difference of the exponentials would be rounding.
const APART: f64 = 1e-3;

/// The reason why a rule has no closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NoClosedForm {
    NotLinear,
    ManyNumbers,
    Flips,
    Drifts,
}

impl NoClosedForm {
    /// Returns the reason as a clause.
    fn reason(self) -> &'static str {
        match self {
            Self::NotLinear => "the rule is not linear, and has no closed form",
            Self::ManyNumbers => "the rule carries more than two numbers",
            Self::Flips => {
                "a part of it is gone, or changes sides, in one frame: between frames that is no motion"
            }
            Self::Drifts => "it has no rest, and the target pushes it",
        }
    }
}

/// The code of a rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RuleCode {
    /// Source code of the function, or its lines.
    pub text: String,
    /// The reason why the function makes fixed steps; `None` for the closed form.
    pub steps_because: Option<&'static str>,
}

impl Rule {
    /// Returns code that moves the same at any frame rate. It is the closed form or, if there is none, fixed steps of
    /// the author's frames with interpolation. The comment above the code quotes `written`, the rule's text.
    ///
    /// # Errors
    /// Fails with a clause that explains why other languages cannot express the rule.
    pub fn code(&self, written: &str, form: impl Into<CodeForm>) -> Result<RuleCode, String> {
        let form = form.into();
        let fps = self.fps;
        let lines = written.lines().map(|line| line.trim().to_owned());
        let mut about = vec![format!("This rule of {fps} frames per second, at any frame rate:")];
        about.extend(lines.filter(|line| !line.is_empty()).map(|line| format!("  {line}")));
        match self.whole().closed_form() {
            Ok(source) => {
                about.push("The closed form: after a frame it is where the rule is, and two half steps are one.".into());
                if self.state.len() > 1 && self.state.contains(&1) && !self.takes_step() {
                    about.push(format!("v is in units per frame of 1/{fps} s, as in the rule."));
                }
                Ok(RuleCode { text: rule_code(&source, &about, form)?, steps_because: None })
            }
            Err(because) => {
                let reason = because.reason();
                let (source, call) = match form {
                    CodeForm::Function(_) => (
                        self.fixed_steps()?,
                        "Draw memory.shown, which lies between the last two steps.",
                    ),
                    CodeForm::Step => {
                        (self.one_step()?, "Call it once a frame, as it was written.")
                    }
                };
                about.push(format!("Fixed steps: {reason}. {call}"));
                let text = rule_code(&source, &about, form)?;
                Ok(RuleCode { text, steps_because: Some(reason) })
            }
        }
    }

    /// Returns the names of the numbers that move.
    fn state_names(&self) -> Vec<String> {
        let names = rule_names(&self.text);
        self.state.iter().map(|index| names[*index].clone()).collect()
    }

    /// Returns the declarations before the first line, which are the target and the carried numbers besides x and v.
    fn head(&self, takes_target: bool, carried: impl Iterator<Item = usize>) -> String {
        let mut head = String::new();
        if takes_target {
            head += "takes target: where it goes\n";
        }
        let names = rule_names(&self.text);
        for index in carried.filter(|index| *index > 1) {
            let name = names[index].trim_start_matches("memory.");
            head += &format!("memory {name} = {:?}\n", self.text.carried()[index].start);
        }
        head + "\n"
    }

    fn closed_form(&self) -> Result<String, NoClosedForm> {
        if !self.is_linear {
            return self.two_rates().ok_or(NoClosedForm::NotLinear);
        }
        let frame = self.frame(self.fps).ok_or(NoClosedForm::ManyNumbers)?;
        let lines = match self.state.len() {
            1 => self.first_order(&frame)?,
            _ if self.stays => self.coasting(&frame)?,
            _ => self.swinging(&frame)?,
        };
        // Compilers warn of unused variables.
        let is_read = |line: &&String| {
            let Some((name, _)) = line.strip_prefix("let ").and_then(|rest| rest.split_once(" ="))
            else {
                return true;
            };
            let mut words = lines.iter().flat_map(|line| line.split([' ', '(', ')']));
            words.by_ref().filter(|word| *word == name).nth(1).is_some()
        };
        let lines: Vec<&str> = lines.iter().filter(is_read).map(String::as_str).collect();
        let takes_target = lines.iter().any(|line| line.contains("target"));
        Ok(self.head(takes_target, self.state.iter().copied()) + &lines.join("\n") + "\n")
    }

    /// Returns the closed form of a chase that is quicker on one side of its target.
    fn two_rates(&self) -> Option<String> {
        let mut switches = self.text.switches();
        let is_one = matches!(switches.next(), Some((SwitchKind::Condition, _)));
        if !is_one || switches.next().is_some() || self.state != [0] {
            return None;
        }
        let h = self.step_length(self.fps);
        let modes_at = |x: f64| {
            let mut at = vec![0.0; self.text.carried().len()];
            at[0] = x;
            self.text.modes(h, &at, 0.0)
        };
        if [-1.0, 1.0].iter().any(|side| modes_at(side * 1e-9) != modes_at(side * 1e9)) {
            return None;
        }
        let pieces = self.pieces();
        let [first, second] = &pieces[..] else { return None };
        let line = |piece: &Piece| {
            let frame = piece.rule.frame(self.fps)?;
            let rests = frame.by_target.x / (1.0 - frame.map.m11);
            let chases = frame.map.m11 < 1.0 && (rests - 1.0).abs() <= AT_TARGET;
            let lines = piece.rule.first_order(&frame).ok()?;
            (chases && frame.offset.x == 0.0).then(|| lines.concat())
        };
        let lines = rule_lines(&self.text).ok()?;
        let mut lines = lines.iter().filter(|line| !line.starts_with('#'));
        let condition = lines.next()?.strip_prefix("if ").filter(|it| !it.contains(RULE_STEP))?;
        let [first, second] = [line(first)?, line(second)?];
        let head = self.head(true, self.state.iter().copied());
        Some(format!("{head}if {condition}\n    {first}\n}} else {{\n    {second}\n}}\n"))
    }

    fn first_order(&self, frame: &Frame) -> Result<Vec<String>, NoClosedForm> {
        let x = &self.state_names()[0];
        let (kept, by_target, offset) = (frame.map.m11, frame.by_target.x, frame.offset.x);
        if kept <= 0.0 {
            return Err(NoClosedForm::Flips);
        }
        if kept == 1.0 {
            if by_target != 0.0 {
                return Err(NoClosedForm::Drifts);
            }
            return Ok(vec![format!("{x} += {} * h", number(offset * self.fps))]);
        }
        let rest = rest([by_target, offset].map(|part| part / (1.0 - kept)));
        let decay = format!("exp({} * h)", number(libm::log(kept) * self.fps));
        Ok(vec![match rest.as_str() {
            "0.0" => format!("{x} *= {decay}"),
            rest => format!("{x} = {rest} + ({x} - {}) * {decay}", grouped(rest)),
        }])
    }

    /// Returns the closed form if one eigenvalue is 1.
    fn coasting(&self, frame: &Frame) -> Result<Vec<String>, NoClosedForm> {
        let (names, fps) = (self.state_names(), self.fps);
        let kept = frame.map.trace() - 1.0;
        if frame.by_target != Vector2::zeros() {
            return Err(NoClosedForm::Drifts);
        }
        if kept <= 0.0 {
            return Err(NoClosedForm::Flips);
        }
        let change = frame.map - Matrix2::identity();
        let mut lines =
            vec![format!("let first = {}", names[0]), format!("let second = {}", names[1])];
        let is_free = (1.0 - kept).abs() <= NO_RETURN;
        // The offset acts through the change of the map, and directly in every frame.
        let (by_offset, drift) = if is_free {
            lines.push(format!("let gone = {} * h", number(fps)));
            lines.push("let again = gone * (gone - 1.0) / 2.0".into());
            (change * frame.offset, frame.offset)
        } else {
            let lost = 1.0 - kept;
            lines.push(format!("let kept = exp({} * h)", number(libm::log(kept) * fps)));
            lines.push(format!("let gone = (1.0 - kept) / {}", number(lost)));
            let by_offset = -change * frame.offset / lost;
            (by_offset, frame.offset - by_offset)
        };
        for (n, name) in names.iter().enumerate() {
            let change = sum(&[(change[(n, 0)], "first"), (change[(n, 1)], "second")]);
            let offset = if is_free {
                [(by_offset[n], "again"), (drift[n], "gone")]
            } else {
                [(by_offset[n], "gone"), (drift[n] * fps, "h")]
            };
            let [change, offset] = [change, sum(&offset)];
            match (&*change, &*offset) {
                ("0.0", "0.0") => {}
                (_, "0.0") => lines.push(format!("{name} += gone * {}", grouped(&change))),
                ("0.0", _) => lines.push(format!("{name} += {offset}")),
                _ => lines.push(format!("{name} += gone * {} + {offset}", grouped(&change))),
            }
        }
        Ok(lines)
    }

    fn swinging(&self, frame: &Frame) -> Result<Vec<String>, NoClosedForm> {
        let (names, fps, map) = (self.state_names(), self.fps, frame.map);
        let (half, determinant) = (map.trace() / 2.0, map.determinant());
        let powers = Powers::of(map.trace(), determinant).ok_or(NoClosedForm::Flips)?;
        let Powers { log_scale, apart, swings } = powers;
        let [by_target, offset] = frame.rests().ok_or(NoClosedForm::Drifts)?;
        let rest: Vec<String> = (0..2).map(|n| rest([by_target[n], offset[n]])).collect();
        let away = |n: usize| match &*rest[n] {
            "0.0" => names[n].clone(),
            rest => format!("{} - {}", names[n], grouped(rest)),
        };
        let mut lines =
            vec![format!("let first = {}", away(0)), format!("let second = {}", away(1))];
        let root = libm::sqrt((half * half - determinant).abs());
        let exp = |log: f64| format!("exp({} * h)", number(log * fps));
        if !swings && apart > APART {
            lines.extend([
                format!("let slow = {}", exp(log_scale + apart)),
                format!("let fast = {}", exp(log_scale - apart)),
                "let even = (slow + fast) / 2.0".into(),
                format!("let odd = (slow - fast) * {}", number(0.5 / root)),
            ]);
        } else if apart == 0.0 {
            lines.extend([
                format!("let even = {}", exp(log_scale)),
                format!("let odd = even * h * {}", number(fps / half)),
            ]);
        } else {
            let [even, odd] = if swings { ["cos", "sin"] } else { ["cosh", "sinh"] };
            lines.extend([
                format!("let decay = {}", exp(log_scale)),
                format!("let angle = {} * h", number(apart * fps)),
                format!("let even = decay * {even}(angle)"),
                format!("let odd = decay * {odd}(angle) * {}", number(1.0 / root)),
            ]);
        }
        let beside = map - Matrix2::identity() * half;
        for (n, (name, own)) in names.iter().zip(["first", "second"]).enumerate() {
            let mixed = sum(&[(beside[(n, 0)], "first"), (beside[(n, 1)], "second")]);
            let rest = if rest[n] == "0.0" { String::new() } else { format!("{} + ", rest[n]) };
            lines.push(format!("{name} = {rest}even * {own} + odd * {}", grouped(&mixed)));
        }
        Ok(lines)
    }

    /// Returns the rule itself as the lines of a step.
    fn one_step(&self) -> Result<String, String> {
        let carried = 0..self.text.carried().len();
        let lines = self.lines_of_step("h")?.join("\n");
        Ok(self.head(self.text.takes_target(), carried) + &lines + "\n")
    }

    /// Returns the lines of the rule for a step of this length in seconds.
    fn lines_of_step(&self, length: &str) -> Result<Vec<String>, String> {
        let units = match self.units {
            1.0 => String::new(),
            units => format!(" * {units:?}"),
        };
        let step = self.text.reads_step().then(|| format!("let {RULE_STEP} = {length}{units}"));
        Ok(step.into_iter().chain(rule_lines(&self.text)?).collect())
    }

    fn fixed_steps(&self) -> Result<String, String> {
        let shown = &self.state_names()[0];
        let mut source =
            "memory unspent = 0.0\nmemory before = nan\nmemory shown = nan\n".to_owned();
        source += &self.head(self.text.takes_target(), 0..self.text.carried().len());
        let lines = self.lines_of_step("FRAME_S")?.into_iter();
        let lines: Vec<String> = lines.map(|line| format!("    {line}")).collect();
        Ok(source
            + &format!(
                "const FRAME_S = {:?}
if is_nan(memory.before) {{
    memory.before = {shown}
}}
memory.unspent += h
while memory.unspent >= FRAME_S {{
    memory.unspent -= FRAME_S
    memory.before = {shown}
{}
}}
memory.shown = memory.before + ({shown} - memory.before) * (memory.unspent / FRAME_S)
",
                1.0 / self.fps,
                lines.join("\n")
            ))
    }
}

/// Writes a number in a source, in brackets if it has a sign.
fn number(value: f64) -> String {
    // Adding 0 turns a negative zero into 0.
    let value = value + 0.0;
    if value < 0.0 { format!("({value:?})") } else { format!("{value:?}") }
}

/// Writes the rest, from its coefficient of the target and its constant part.
fn rest([by_target, offset]: [f64; 2]) -> String {
    let is_target = (by_target - 1.0).abs() <= AT_TARGET;
    let by_target = if by_target.abs() <= AT_TARGET { 0.0 } else { by_target };
    let target = match is_target {
        true => "target".into(),
        false => sum(&[(by_target, "target")]),
    };
    match (&*target, offset) {
        (_, 0.0) => target,
        ("0.0", _) => number(offset),
        _ => format!("{target} + {}", number(offset)),
    }
}

/// Writes the sum of these names, each multiplied by its factor.
fn sum(terms: &[(f64, &str)]) -> String {
    let mut written = String::new();
    for (factor, name) in terms.iter().filter(|(factor, _)| *factor != 0.0) {
        let sign = match (written.is_empty(), *factor < 0.0) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        written += &format!("{sign}{:?} * {name}", factor.abs());
    }
    if written.is_empty() { "0.0".into() } else { written }
}

/// Writes the expression, in brackets if it is a sum or negative.
fn grouped(sum: &str) -> String {
    if sum.contains(' ') || sum.starts_with('-') { format!("({sum})") } else { sum.to_owned() }
}
