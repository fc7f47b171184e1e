//! A camera whose lines follow a body that moves evenly, as a loop draws it.

use std::sync::Arc;

use super::metrics::FrameRecord;
use crate::sim::law::{ExpressionFault, Remedy, StepRegisters, StepText};

/// Remedy for lines that follow nothing.
const FOLLOW: &str = "follow the body: `x += (target - x) * 8 * dt`";

/// A camera at a place `x`, which its lines move once a frame. Their `target` is the place of the body in the picture,
/// raw or between two ticks, and `dt` is the duration of the frame in seconds.
#[derive(Clone)]
pub struct Camera {
    rule: Arc<StepText>,
    /// Speed of the body, in units a second.
    speed: f64,
    drawn: StepRegisters,
    /// The same camera, if every picture shows the moment of its display.
    ideal: StepRegisters,
    /// Times when the last frame began and when the last one was displayed, in nanoseconds.
    before_ns: [Option<i64>; 2],
    /// Places of the body and of the camera in the last picture, and where both would ideally be.
    seen: Option<[[f64; 2]; 2]>,
    pictures: f64,
    lag: f64,
    changes: f64,
    /// Squares of the errors of the body in the picture, and of the camera.
    squares: [f64; 2],
    largest: f64,
}

/// A metric of a camera: its name in output, and its value in milliseconds of the body's motion.
pub type CameraMetric = (&'static str, fn(&Camera) -> Option<f64>);

/// Every metric of a camera.
pub const CAMERA_METRICS: [CameraMetric; 4] = [
    ("seen_error_rms_ms", Camera::seen_error_rms_ms),
    ("seen_error_max_ms", |camera| camera.of_changes(camera.largest * camera.changes)),
    ("camera_error_rms_ms", |camera| camera.of_changes(camera.squares[1]).map(f64::sqrt)),
    ("camera_lag_ms", |camera| (camera.pictures > 0.0).then_some(camera.lag / camera.pictures)),
];

impl Camera {
    /// Reads the lines of a camera, for a body with this speed in units a second. The camera starts at the body.
    ///
    /// # Errors
    /// The first fault of the lines, which have to move `x` and to read `target`.
    pub fn read(text: &str, speed: f64) -> Result<Self, ExpressionFault> {
        let rule = StepText::read_rule(text, FOLLOW)?;
        let what = match (rule.leaves_unchanged(0), rule.takes_target()) {
            (true, _) => "the lines leave `x` where it is",
            (false, false) => "no line reads `target`, the place of the body",
            (false, true) => {
                let registers = rule.registers();
                return Ok(Self {
                    rule: rule.into(),
                    speed,
                    drawn: registers.clone(),
                    ideal: registers,
                    before_ns: [None; 2],
                    seen: None,
                    pictures: 0.0,
                    lag: 0.0,
                    changes: 0.0,
                    squares: [0.0; 2],
                    largest: 0.0,
                });
            }
        };
        let remedy = Remedy::Words(FOLLOW.into());
        Err(ExpressionFault { span: 0..text.len(), what: what.into(), remedy })
    }

    /// Moves the camera in a frame of a loop.
    pub fn frame(&mut self, record: &FrameRecord) {
        let body = self.speed * record.shown_ms / 1e3;
        let [began, displayed] = &mut self.before_ns;
        follow(&self.rule, &mut self.drawn, began, record.frame.began_ns, body);
        let Some(displayed_ns) = record.frame.displayed_ns else { return };
        let due = self.speed * displayed_ns as f64 / 1e9;
        follow(&self.rule, &mut self.ideal, displayed, displayed_ns, due);
        let now = [[body, self.place()], [due, self.rule.value(&self.ideal, 0)]];
        let ms = |units: f64| 1e3 * units / self.speed;
        self.pictures += 1.0;
        self.lag += ms(body - self.place());
        let Some(before) = self.seen.replace(now) else { return };
        let moved = |thing: usize, of: usize| now[of][thing] - before[of][thing];
        let [of_body, of_camera] = [0, 1].map(|thing| ms(moved(thing, 0) - moved(thing, 1)));
        self.changes += 1.0;
        self.largest = self.largest.max((of_body - of_camera).abs());
        for (squares, error) in self.squares.iter_mut().zip([of_body - of_camera, of_camera]) {
            *squares += error * error;
        }
    }

    /// Returns the place of the camera, in the units of the body's speed.
    pub fn place(&self) -> f64 {
        self.rule.value(&self.drawn, 0)
    }

    /// Returns the RMS animation error of the body in the picture of the camera, in milliseconds: the change of its
    /// distance from the camera minus the change if every picture showed the moment of its display.
    pub fn seen_error_rms_ms(&self) -> Option<f64> {
        self.of_changes(self.squares[0]).map(f64::sqrt)
    }

    fn of_changes(&self, sum: f64) -> Option<f64> {
        (self.changes > 0.0).then_some(sum / self.changes)
    }
}

/// Moves a camera on to a time, with the body at `target`. A camera without an earlier time starts there.
fn follow(
    rule: &StepText,
    registers: &mut StepRegisters,
    before_ns: &mut Option<i64>,
    now_ns: i64,
    target: f64,
) {
    match before_ns.replace(now_ns) {
        Some(before_ns) => rule.step(registers, (now_ns - before_ns) as f64 / 1e9, target),
        None => rule.set(registers, 0, target),
    }
}
