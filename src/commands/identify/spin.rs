//! The log of a body that spins freely in space.

use glam::DVec3;
use serde_json::Value;

use super::{IdentifyArgs, LogFile, object, refused, spin_text};
use crate::commands::argument::positive;
use crate::commands::error::Error;
use crate::commands::output::table::TableFormat;
use crate::commands::terminal::print_status;
use crate::table::TableOptions;
use crate::tools::identify::{Log, LogError, LogSetting, identify_spin};

/// Part by which a moment may exceed the sum of the others, as logged decimals do.
const ROUNDED: f64 = 1e-3;

/// Reads three moments of inertia.
pub(super) fn moments(written: &str) -> Result<DVec3, String> {
    let all =
        written.split(',').map(|part| positive(part.trim())).collect::<Result<Vec<_>, _>>()?;
    let three = <[f64; 3]>::try_from(all).map_err(|_| "write three moments, such as 1,2,3")?;
    let moments = DVec3::from(three);
    let most = moments.max_element();
    if most > (moments.element_sum() - most) * (1.0 + ROUNDED) {
        return Err(format!("no body has a moment of {most} above the sum of the other two"));
    }
    Ok(moments)
}

/// Reads the column `x` of a spin as a coordinate, with wy as its velocity. Every such log has wy, because a log of one
/// coordinate that does not change is refused.
fn log(args: &IdentifyArgs, file: &LogFile, x: &str) -> Result<Log, LogError> {
    let [x, v] = [x, "wy"].map(|name| Some(name.to_owned()));
    let options = TableOptions { x, v, ..args.read.table.options() };
    file.log(&options, args.tick_hz.or(args.step_hz))
}

/// Whether a log is refused because the column of its coordinate is missing.
fn lacks_x(error: &LogError) -> bool {
    error.mistaken == Some(LogSetting::CoordinateColumn)
}

/// Returns the error about a log of wx, wy and wz without moments, from the error about it as a log of x; `None` for a
/// log of another motion.
pub(super) fn without_moments(
    args: &IdentifyArgs,
    file: &LogFile,
    error: &LogError,
) -> Option<Error> {
    if args.read.table.options().x.is_some() || !lacks_x(error) {
        return None;
    }
    match log(args, file, "wx").and_then(|_| log(args, file, "wz")) {
        Err(error) if lacks_x(&error) => None,
        Err(error) => Some(refused(error)),
        Ok(_) => Some(Error::mistake(format!(
            "{}: wx, wy and wz are the spin of a body in space; give its moments of inertia about these axes, or their \
             ratios, with --moments I1,I2,I3",
            file.name
        ))),
    }
}

/// Returns what is found about a log of wx, wy and wz, for these moments.
pub(super) fn answer(args: &IdentifyArgs, file: &LogFile, moments: DVec3) -> Result<String, Error> {
    let [xy, z] = [log(args, file, "wx"), log(args, file, "wz")];
    let logs = [xy.map_err(refused)?, z.map_err(refused)?];
    let rows = logs[0].rows().iter().zip(logs[1].rows());
    let spin = |v: Option<f64>, x, z| DVec3::new(x, v.unwrap_or(0.0), z);
    let rows: Vec<_> = rows.map(|(xy, z)| (xy.tick, spin(xy.v, xy.x, z.x))).collect();
    let rows = if logs[0].is_uneven() { &[][..] } else { &rows };
    let hz = logs[0].tick_hz();
    print_status(&format!("read {} rows at {hz} a second, columns wx, wy, wz", rows.len()));
    let found = identify_spin(rows, moments, hz);
    let TableFormat::Json = args.format else { return Ok(spin_text(found.as_ref())) };
    let mut object = object(found.as_ref(), &logs[0], args.mass);
    object["rest_m"] = Value::Null;
    if let Some(left_out) = object["read"]["left_out"].as_array_mut() {
        left_out.retain(|name| name != "wz");
    }
    Ok(format!("{object:#}\n"))
}
