//! Settings that were ported, in words and as JSON.

use serde_json::{Map, Value, json};

use super::{Drive, PortedEngine};
use crate::commands::output::table::TableFormat;
use crate::commands::table_args::taken_object;
use crate::sim::number::{round, significant};
use crate::table::Taken;
use crate::tools::identify::Effective;
use crate::tools::port::{
    Approach, Departure, DriveLimits, FirstSecond, FollowerPort, Friction, GainRange, PortOutcome,
    Ported, SETTLED, Setup, UiSpring, UiSpringPort, Wish, settled_s,
};

/// Describes a motion by its frequency, its damping ratio, and how long its energy lasts.
fn sees(seen: &Effective) -> String {
    let ratio = seen.damping_ratio().unwrap_or(0.0);
    let ratio = if ratio.abs() < 5e-7 { 0.0 } else { ratio };
    let undamped = format!("{} Hz undamped", significant(seen.undamped_hz(), 4));
    let swing = match seen.frequency_hz() {
        Some(hz) if (hz / seen.undamped_hz() - 1.0).abs() > 0.01 => {
            format!("{} Hz ({undamped})", significant(hz, 4))
        }
        Some(hz) => format!("{} Hz", significant(hz, 4)),
        None => format!("no swing ({undamped})"),
    };
    let said = format!("{swing}, damping ratio {}", significant(ratio, 3));
    match seen.energy_halves_s().filter(|seconds| seconds.abs() < 1e5) {
        Some(s) if s > 0.0 => said + &format!(", the energy halves in {} s", significant(s, 3)),
        Some(s) => said + &format!(", the energy doubles in {} s", significant(-s, 3)),
        None => said + ", the energy stays",
    }
}

fn seen_object(seen: &Effective) -> Value {
    json!({
        "frequency_hz": seen.undamped_hz(),
        "damping_ratio": seen.damping_ratio(),
        "swings_hz": seen.frequency_hz(),
        "energy_halves_s": seen.energy_halves_s(),
    })
}

fn name(setup: &Setup) -> String {
    format!("{} ×{}, {}", setup.engine_id(), setup.substeps, setup.mode.id)
}

fn wish_line(wish: &Wish, tick_hz: f64) -> String {
    let [hz, ratio] = [wish.frequency_hz, wish.damping_ratio].map(|x| significant(x, 4));
    let tick_hz = round(tick_hz, 6);
    format!("{hz} Hz, damping ratio {ratio}, {} kg, at {tick_hz} ticks per second\n", wish.mass_kg)
}

/// Describes from when on a motion stays near its target.
fn settled_line(wish: &Wish) -> String {
    let of =
        |part: f64| format!("{} % from {} s", 100.0 * part, significant(settled_s(wish, part), 4));
    match wish.damping_ratio > 0.0 {
        true => format!("stays within {}\n", SETTLED.map(of).join(", ")).replacen(
            "%",
            "% of the way",
            1,
        ),
        false => "without damping it never comes to rest\n".to_owned(),
    }
}

/// Returns a table of when these user interfaces end the motion, and of what is left of the way then.
pub(super) fn ends((wish, frame_hz): (&Wish, f64), dialects: &[&UiSpring]) -> String {
    let mut said = wish_line(wish, frame_hz) + &settled_line(wish);
    said += &format!("\n{:24}  {:>8}  left\n", "dialect", "ends");
    for dialect in dialects {
        let port = dialect.port(wish, frame_hz);
        said += &match port.ends {
            Some(end) => {
                let [at_s, left] = [end.at_s, 100.0 * end.left.abs()];
                let at_s = format!("{at_s:.4} s");
                format!("{:24}  {at_s:>8}  {} % of the way\n", dialect.id, significant(left, 2))
            }
            None if port.departure.is_some() || port.code.is_empty() => {
                format!("{:24}  {:>8}\n", dialect.id, "unknown")
            }
            None if dialect.has_end() => format!("{:24}  {:>8}\n", dialect.id, "never"),
            None => format!("{:24}  {:>8}\n", dialect.id, "no rule"),
        };
    }
    said
}

fn object((wish, tick_hz, read): (&Wish, f64, Option<&Taken>), rows: Value) -> String {
    let mut object = json!({
        "want": {
            "frequency_hz": wish.frequency_hz,
            "damping_ratio": wish.damping_ratio,
            "mass_kg": wish.mass_kg,
            "settles_s": SETTLED.map(|part| settled_s(wish, part)),
        },
        "tick_hz": tick_hz,
    });
    let Value::Object(rows) = rows else { unreachable!("rows have names") };
    let read = read.map(|taken| ("read".to_owned(), taken_object(taken)));
    object.as_object_mut().expect("it is one").extend(rows.into_iter().chain(read));
    format!("{object:#}\n")
}

/// Returns the settings of every engine, and those of these user interfaces. `read` is what was read of a log.
pub(super) fn springs(
    (wish, tick_hz, read): (&Wish, f64, Option<&Taken>),
    all: &[PortedEngine],
    dialects: &[(&UiSpring, UiSpringPort)],
    format: TableFormat,
) -> String {
    let dialects = dialects.iter();
    match format {
        TableFormat::Json => {
            let engines: Vec<Value> = all.iter().map(row).collect();
            let dialects: Vec<Value> = dialects.map(|(it, port)| ui_spring_row(it, port)).collect();
            object((wish, tick_hz, read), json!({ "engines": engines, "dialects": dialects }))
        }
        TableFormat::Text => {
            let engines = all.iter().map(|engine| engine_text(wish, engine));
            let dialects = dialects.map(|(it, port)| ui_spring_text(it, port, tick_hz));
            let settled = if dialects.len() > 0 { settled_line(wish) } else { String::new() };
            wish_line(wish, tick_hz) + &settled + &engines.chain(dialects).collect::<String>()
        }
    }
}

fn ui_spring_row(dialect: &UiSpring, port: &UiSpringPort) -> Value {
    let settings: Map<String, Value> = dialect
        .keys
        .iter()
        .zip(&port.values)
        .map(|(key, value)| match key.switch {
            Some(_) => (key.name.to_owned(), Value::from(*value == 1.0)),
            None => (key.name.to_owned(), Value::from(*value)),
        })
        .collect();
    let departs = |it: Departure| json!({ "at_s": it.at_s, "left": it.left, "damping_ratio": it.damping_ratio });
    let seen = |seen: &Effective| json!({ "hz": seen.undamped_hz(), "damping_ratio": seen.damping_ratio() });
    json!({
        "id": dialect.id,
        "settings": settings,
        "word": port.outcome.id(),
        "steps": dialect.steps(),
        "explodes_below_hz": port.explodes_below_hz,
        "seen": port.seen.as_ref().map(seen),
        "departs": port.departure.map(departs),
        "error": port.error,
        "delay_s": port.delay_s,
        "ends": port.ends.map(|end| json!({ "at_s": end.at_s, "left": end.left })),
        "code": port.code,
        "source": dialect.source,
        "version": dialect.version,
        "evidence": dialect.evidence,
    })
}

fn ui_spring_text(dialect: &UiSpring, port: &UiSpringPort, frame_hz: f64) -> String {
    let pairs = dialect.keys.iter().zip(&port.values);
    let set = pairs.map(|(key, value)| match key.switch {
        Some(_) => format!("{} = {}", key.name, *value == 1.0),
        None => format!("{} = {}", key.name, round(*value, 6)),
    });
    let set: Vec<String> = set.collect();
    let mut lines = vec![format!("\n{}: {}", dialect.id, port.outcome.id())];
    lines.push(format!("  {}", set.join(", ")));
    lines.push(format!("  {}", dialect.at_frame_rates(port, frame_hz)));
    lines.extend(port.ends.map(|end| {
        let [at_s, left] = [(end.at_s, 4), (100.0 * end.left.abs(), 2)];
        let [at_s, left] = [at_s, left].map(|(number, digits)| significant(number, digits));
        format!("  ends at {at_s} s by its rule of rest, with {left} % of the way left")
    }));
    if port.outcome != PortOutcome::Reached {
        lines.extend(port.seen.as_ref().map(|seen| format!("  a player sees: {}", sees(seen))));
    }
    lines.extend(dialect.switched_on(&port.values).map(|switch| format!("  {}", switch.note)));
    lines.extend(port.code.lines().map(|line| format!("    {line}")));
    lines.extend(dialect.checked_against().map(|held| format!("  {held}")));
    lines.join("\n") + "\n"
}

fn row(PortedEngine { setup, ported }: &PortedEngine) -> Value {
    let engine = setup.engine();
    let settings = |ported: &Ported| -> Map<String, Value> {
        let names = setup.mode.settings().map(|setting| setting.name.to_owned());
        names.into_iter().zip(ported.values.map(Value::from)).collect()
    };
    let word = ported.as_ref().map_or(PortOutcome::Nearest, |ported| ported.outcome).id();
    let off = |FirstSecond { end, rms }| json!({ "end": end, "rms": rms });
    let force = |[k, c]: [f64; 2]| json!({"stiffness_n_per_m": k, "damping_n_s_per_m": c});
    json!({
        "method": setup.engine_id(),
        "mode": setup.mode.id,
        "substeps": setup.substeps,
        "version": engine.map(|engine| engine.version),
        "logged": engine.and_then(|engine| engine.logged),
        "word": word,
        "settings": ported.as_ref().map(settings),
        "sees": ported.as_ref().map(|ported| seen_object(&ported.sees)),
        "first_second": ported.as_ref().and_then(|ported| ported.first_second).map(off),
        "floor": ported.as_ref().and_then(|p| p.floor).map(|ratio| json!({"damping_ratio": ratio})),
        "own_force": ported.as_ref().and_then(|ported| ported.own_force).map(force),
        "code": ported.as_ref().map(Ported::code),
    })
}

fn engine_text(wish: &Wish, PortedEngine { setup, ported }: &PortedEngine) -> String {
    let Some(ported) = ported else {
        return format!("\n{}: nothing near\n", name(setup));
    };
    let mut lines = vec![format!("\n{}: {}", name(setup), ported.outcome.id())];
    let set = setup.mode.settings().into_iter().zip(ported.values).map(|(setting, value)| {
        let unit = setting.quantity.unit();
        format!("{} = {} {unit}", setting.name, round(value, 6)).trim_end().to_owned()
    });
    lines.push(format!("  {}", set.collect::<Vec<_>>().join(", ")));
    lines.push(format!("  a player sees: {}", sees(&ported.sees)));
    lines.extend(miss_note(wish, ported).map(|said| format!("  {said}")));
    lines.extend(ported.own_force.map(|[k, c]| {
        let [k, c] = [k, c].map(|x| round(x, 6));
        format!("  a force of your own reaches it: stiffness {k} N/m, damping {c} N s/m")
    }));
    lines.extend(ported.code().lines().map(|line| format!("    {line}")));
    let held = setup.engine().and_then(|engine| engine.checked_against());
    lines.extend(held.map(|said| format!("  {said}")));
    lines.join("\n") + "\n"
}

/// Describes how far the settings miss the wish, and why, if they do.
fn miss_note(wish: &Wish, ported: &Ported) -> Option<String> {
    let Setup { method, substeps, tick_hz, .. } = ported.setup;
    let three = |ratio: f64| significant(ratio, 3);
    let [hz, tick_hz] = [round(wish.frequency_hz, 4), round(tick_hz, 6)];
    match (ported.outcome, ported.floor) {
        (PortOutcome::Reached, _) => None,
        (PortOutcome::Unreachable, Some(floor)) => {
            let mut said = format!(
                "{} ×{substeps} at {tick_hz} Hz cannot go below a damping ratio of {} at {hz} Hz",
                method.name,
                three(floor)
            );
            if let Some(relief) = ported.relief {
                let way = match relief.setup.substeps == substeps {
                    true => format!("at {} Hz", round(relief.setup.tick_hz, 6)),
                    false => format!("×{}", relief.setup.substeps),
                };
                said += &format!("; {way} can go to {}", three(relief.damping_ratio));
                let more = relief.enough.filter(|enough| *enough != relief.setup.substeps);
                said += &more.map_or(String::new(), |n| format!(", and ×{n} reaches it"));
            }
            Some(said)
        }
        _ => {
            let off = 100.0 * (ported.sees.undamped_hz() / wish.frequency_hz - 1.0);
            let ratio = ported.sees.damping_ratio().unwrap_or(0.0) - wish.damping_ratio;
            let mean = ported.first_second.map_or(String::new(), |FirstSecond { end, rms }| {
                let [end, rms] = [end.abs(), rms].map(|part| significant(100.0 * part, 2));
                format!(
                    " in the mean of the first turns, for its damping is not linear; after a release {end} % of it off at 1 s, {rms} % in the mean till then"
                )
            });
            Some(format!("missed: frequency by {off:+.3} %, damping ratio by {ratio:+.4}{mean}"))
        }
    }
}

pub(super) fn drives(
    (wish, tick_hz, read): (&Wish, f64, Option<&Taken>),
    all: &[Drive],
    format: TableFormat,
) -> String {
    let mass = wish.mass_kg;
    let [kp, kv] = wish.joint().map(|gain| gain * mass);
    match format {
        TableFormat::Json => {
            let row = |drive: &Drive, limits: &DriveLimits| {
                json!({
                    "method": drive.setup.engine_id(),
                    "mode": limits.held_ticks.map_or(drive.setup.mode.id, |_| "own-force"),
                    "substeps": drive.setup.substeps,
                    "decimation": limits.held_ticks,
                    "gains": { "kp_n_per_m": kp, "kv_n_s_per_m": kv },
                    "min_kp_n_per_m": limits.stiffness.least * mass,
                    "max_kp_n_per_m": limits.stiffness.most.map(|k| k * mass),
                    "min_kv_n_s_per_m": limits.damping.least * mass,
                    "max_kv_n_s_per_m": limits.damping.most.map(|c| c * mass),
                    "spectral_radius": limits.spectral_radius,
                    "fewest_substeps": limits.fewest_substeps,
                    "sees": limits.sees.as_ref().map(seen_object),
                })
            };
            let rows = all.iter().flat_map(|d| d.limits.iter().map(move |limits| row(d, limits)));
            object((wish, tick_hz, read), json!({ "drives": rows.collect::<Vec<_>>() }))
        }
        TableFormat::Text => {
            let gains = format!("kp {} N/m, kv {} N s/m\n", round(kp, 6), round(kv, 6));
            let said = |drive: &Drive, limits: &DriveLimits| {
                let gain = |range: GainRange, unit: &str| {
                    let [least, most] = [Some(range.least), range.most]
                        .map(|gain| gain.map(|gain| round(gain * mass, 4)));
                    match (range.least > 0.0, most, least) {
                        (_, Some(_), _) if range.most == Some(0.0) => "none".into(),
                        (true, Some(most), Some(least)) => format!("{least} to {most} {unit}"),
                        (true, None, Some(least)) => format!("from {least} {unit}"),
                        (_, Some(most), _) => format!("up to {most} {unit}"),
                        _ => "any".into(),
                    }
                };
                let kept = limits.spectral_radius.map_or("unstable".into(), |radius| {
                    let word = if radius <= 1.0 + 1e-9 { "stable" } else { "unstable" };
                    // The difference from 1 counts if the radius is near 1.
                    let digits = if (radius - 1.0).abs() < 0.01 { 6 } else { 3 };
                    format!("{word}, a tick leaves {}", significant(radius, digits))
                });
                let substeps = match limits.fewest_substeps {
                    Some(n) => format!("stable from ×{n}"),
                    None => "stable with no number of substeps up to 64".into(),
                };
                let who = match limits.held_ticks {
                    None => "the engine's drive".into(),
                    Some(1) => "a force of your own, held 1 tick".into(),
                    Some(n) => format!("a force of your own, held {n} ticks"),
                };
                let seen = limits.sees.as_ref().map_or("no swing".into(), sees);
                format!(
                    "\n{}: {who}\n  {kept}; kp {} with this kv, kv {} with this kp, {substeps}\n  a player sees: {seen}\n",
                    name(&drive.setup),
                    gain(limits.stiffness, "N/m"),
                    gain(limits.damping, "N s/m"),
                )
            };
            let blocks =
                all.iter().flat_map(|d| d.limits.iter().map(move |limits| said(d, limits)));
            wish_line(wish, tick_hz) + &gains + &blocks.collect::<String>()
        }
    }
}

/// Describes a friction at other frame rates, and as a drag.
pub(super) fn friction(friction: &Friction, format: TableFormat) -> String {
    let [half_life_s, rate] = [friction.half_life_s(), friction.rate()];
    let ([explicit, implicit], [exact, after, before]) = (friction.drags(), friction.coasts_m());
    match format {
        TableFormat::Json => {
            let kept = friction.kept_at().into_iter();
            let kept = kept.map(|(fps, kept)| json!({ "fps": fps, "kept": kept }));
            let object = json!({
                "want": { "kept": friction.kept, "fps": friction.fps },
                "half_life_s": half_life_s,
                "rate_per_s": rate,
                "factors": kept.collect::<Vec<_>>(),
                "drag_explicit_per_s": explicit,
                "drag_implicit_per_s": implicit,
                "coasts_m_per_m_s": exact,
                "coasts_after_m_per_m_s": after,
                "coasts_before_m_per_m_s": before,
            });
            format!("{object:#}\n")
        }
        TableFormat::Text => {
            let [half, rate, explicit, implicit] =
                [half_life_s, rate, explicit, implicit].map(|x| significant(x, 5));
            let [exact, after, before] = [exact, after, before].map(|x| significant(x, 4));
            let fps = friction.fps;
            let factor = |(fps, kept)| format!("  {fps:>4} fps  v *= {}\n", significant(kept, 6));
            let factors: String = friction.kept_at().into_iter().map(factor).collect();
            format!(
                "halves in {half} s: v *= exp(-{rate} * dt) moves the same at every rate\n\n{factors}\n\
                 as drag: {rate} 1/s where it is exact; at {fps} fps {explicit} 1/s in v -= C * v * dt, and {implicit} 1/s in v /= 1 + C * dt\n\
                 a body of 1 m/s coasts {exact} m; at {fps} fps {after} m if it moves after the friction, {before} m if before\n"
            )
        }
    }
}

/// Returns the settings of every follower.
pub(super) fn followers(approach: Approach, all: &[FollowerPort], format: TableFormat) -> String {
    match format {
        TableFormat::Json => {
            let row = |port: &FollowerPort| {
                json!({
                    "method": port.method.id,
                    "fps": port.fps,
                    "settings": { port.setting: port.value },
                    "code": port.code,
                })
            };
            let object = json!({
                "want": { "half_life_s": approach.half_life_s, "rate_per_s": approach.rate() },
                "followers": all.iter().map(row).collect::<Vec<_>>(),
            });
            format!("{object:#}\n")
        }
        TableFormat::Text => {
            let [half, rate] = [approach.half_life_s, approach.rate()].map(|x| significant(x, 4));
            let mut said = format!("halves in {half} s: 1 - exp(-{rate} dt)\n");
            for of_method in all.chunk_by(|a, b| a.method == b.method) {
                let first = &of_method[0];
                said += &format!("\n{}, {}\n", first.method.id, first.setting);
                for port in of_method {
                    let value = significant(port.value, 5);
                    said += &format!("  {:>4} fps  {value:10}  {}\n", port.fps, port.code);
                }
            }
            said
        }
    }
}
