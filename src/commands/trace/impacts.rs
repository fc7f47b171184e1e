//! The rows of `trace --impacts`: one for each impact of each lane, in the order of their next impacts.

use std::io;

use serde_json::{Value, json};

use crate::commands::output::Output;
use crate::commands::output::table::{RowFormat, RowWriter};
use crate::run::Race;
use crate::run::trace::method_id;
use crate::sim::Bounces;
use crate::studio::Studio;

const COLUMNS: [&str; 9] =
    ["n", "lane", "method", "impact", "t", "speed_before", "speed_after", "apex_after", "body"];

/// The impacts seen so far.
pub(super) struct Impacts {
    rows: RowWriter<Output>,
    /// For each body of each lane, the record at the last tick, and whether its last impact is still to be written.
    seen: Vec<(Bounces, bool)>,
    /// For each body of each lane, the number of impacts before the last input, edit or placement, where counts begin.
    earlier: Vec<u64>,
    /// For each body, the time (s) at which the count of its true impacts began, and the numbers of impacts written
    /// before and since.
    written: Vec<(f64, [u64; 2])>,
}

impl Impacts {
    pub(super) fn begin(format: RowFormat, studio: &Studio) -> io::Result<Self> {
        let rows = RowWriter::begin(Output::stdout(), format, COLUMNS)?;
        let bodies = studio.scene().bodies.len();
        let lanes = studio.race().entrants().len();
        let (seen, earlier) = (vec![Default::default(); lanes * bodies], vec![0; lanes * bodies]);
        Ok(Self { rows, seen, earlier, written: vec![Default::default(); bodies] })
    }

    /// Writes the true impacts of the last tick, and those of lanes whose next impact has come, or all at the end.
    pub(super) fn tick(&mut self, studio: &Studio, is_end: bool) -> io::Result<()> {
        let (race, scene) = (studio.race(), studio.scene());
        let Self { rows, seen, earlier, written } = self;
        let bodies = scene.bodies.len();
        // After an input all count on from the same number, for none knows every impact before a rest.
        let mut anew = vec![None; bodies];
        for (body, (since_s, [before, n])) in written.iter_mut().enumerate() {
            let [begun_s, _] =
                race.truth().bodies()[body].stepper.true_bounce(0).unwrap_or([*since_s; 2]);
            if std::mem::replace(since_s, begun_s) != begun_s {
                let of_lanes = seen.iter().zip(&*earlier).skip(body).step_by(bodies);
                let counts = of_lanes.map(|((last, _), earlier)| earlier + last.impacts);
                (*before, *n) = (counts.fold(*before + *n, u64::max), 0);
                anew[body] = Some(*before);
            }
            while let Some([t, apex]) = true_impact(race, body, *n + 1) {
                *n += 1;
                let method = method_id(race.truth().solver(), &race.truth().bodies()[body]);
                let name = &scene.bodies[body].name;
                let apex = if apex.is_finite() { json!(apex) } else { Value::Null };
                let start = [json!(*before + *n), json!(0), json!(method), Value::Null, json!(t)];
                let rest = [Value::Null, Value::Null, apex, json!(name)];
                rows.row(&[&start[..], &rest].concat())?;
            }
        }
        for (lane, entrant) in race.entrants().iter().enumerate() {
            for (body, of_body) in entrant.lane.bodies().iter().enumerate() {
                let Some(&now) = of_body.stepper.bounces() else { continue };
                let cell = lane * bodies + body;
                let (before, is_open) = &mut seen[cell];
                let is_anew = anew[body].is_some() || now.impacts < before.impacts;
                let is_next = is_anew || now.impacts != before.impacts;
                if *is_open && (is_next || is_end) {
                    let last = if is_next { *before } else { now };
                    let apex = last.apex.filter(|_| last.apex_after == last.impacts);
                    let after = Some(last.speeds[1]).filter(|speed| speed.is_finite());
                    rows.row(&[
                        json!(earlier[cell] + last.impacts),
                        json!(lane + 1),
                        json!(method_id(entrant.lane.solver(), of_body)),
                        json!(entrant.spec.impact.id),
                        json!(last.landed_at_s),
                        json!(last.speeds[0]),
                        json!(after),
                        json!(apex),
                        json!(scene.bodies[body].name),
                    ])?;
                    *is_open = false;
                }
                if is_anew {
                    earlier[cell] = anew[body].unwrap_or(earlier[cell] + before.impacts);
                }
                *is_open |= now.impacts > if is_anew { 0 } else { before.impacts };
                *before = now;
            }
        }
        Ok(())
    }

    pub(super) fn end(self) -> io::Result<Output> {
        self.rows.end()
    }
}

/// Returns the true impact of this number if it has come. Flights shorter than a tick are left out.
fn true_impact(race: &Race, body: usize, n: u64) -> Option<[f64; 2]> {
    let truth = &race.truth().bodies()[body].stepper;
    let [from_s, _] = truth.true_bounce(n - 1)?;
    let [at_s, apex] = truth.true_bounce(n)?;
    let is_long = n == 1 || at_s - from_s >= race.last_step_s();
    (is_long && at_s <= race.t()).then_some([at_s, apex])
}
