//! Where two runs first differ: every change of a log is named, and nothing else. The seed is printed; `REGATTA_SEED` sets another.

use std::error::Error;

use crate::dice::Dice;
use regatta::run::Session;
use regatta::run::diff::{Chosen, Comparison, Tolerance, diff, table};
use regatta::scene::{Action, Scene};

fn within(a: &str, b: &str, tolerance: Tolerance) -> Result<Comparison, Box<dyn Error>> {
    diff(&mut table(a)?, &mut table(b)?, tolerance, &Chosen::default())
}

fn compared(a: &str, b: &str) -> Comparison {
    within(a, b, Tolerance::default()).unwrap()
}

const HEADER: &str = "tick,t,lane,method,body,coordinate,q,v";

/// A tidy log of a scene's race: this many ticks of all its lanes and bodies.
fn log(scene: &str, ticks: u64) -> Vec<String> {
    let scene = Scene::built_in(scene).unwrap();
    let mut session = Session::racing(scene.clone().into());
    let mut lines = vec![HEADER.to_owned()];
    for tick in 0..ticks {
        for (lane, entrant) in (1..).zip(session.race().entrants()).take(3) {
            for (body, named) in entrant.lane.bodies().iter().zip(&scene.bodies) {
                let states = body.stepper.q().iter().zip(body.stepper.v());
                for (coordinate, (q, v)) in body.coordinates().iter().zip(states) {
                    let (t, method) = (tick as f64 / 60.0, entrant.spec.method.id);
                    let place = format!("{tick},{t},{lane},{method},{}", named.name);
                    lines.push(format!("{place},{},{q:?},{v:?}", coordinate.name));
                }
            }
        }
        session.tick(&mut ());
    }
    lines
}

/// The number `ulps` doubles above `x`.
fn above(x: f64, ulps: u64) -> f64 {
    (0..ulps).fold(x, |x, _| x.next_up())
}

#[test]
fn every_change_of_a_log_is_named() {
    let mut dice = Dice::new(48);
    let logs = ["spring", "orbit", "harbour"].map(|scene| log(scene, 12));
    for n in 0..10_000 {
        let before = &logs[dice.below(logs.len())];
        let text = before.join("\n");
        let mut after = before.clone();
        let line = 1 + dice.below(before.len() - 1);
        let cells: Vec<&str> = before[line].split(',').collect();
        let rows = before.len() as u64 - 1;
        let is_named = |found: &Comparison| {
            let first = found.first.as_ref().unwrap();
            assert_eq!(first.tick.to_string(), cells[0], "change {n}");
            let row = ["lane", "body", "coordinate"].map(|name| first.cell(name).unwrap());
            assert_eq!(row, [cells[2], cells[4], cells[5]], "change {n}");
        };
        match n % 4 {
            0 => {
                let (column, ulps) = (6 + dice.below(2), 1 + dice.below(9) as u64);
                let mut cells = cells.clone();
                let changed = format!("{:?}", above(cells[column].parse().unwrap(), ulps));
                let was = cells[column];
                cells[column] = &changed;
                after[line] = cells.join(",");
                let found = compared(&text, &after.join("\n"));
                is_named(&found);
                let first = found.first.clone().unwrap();
                assert_eq!(first.ulps, Some(ulps), "change {n}");
                assert_eq!(first.column, ["q", "v"][column - 6], "change {n}");
                assert_eq!(first.values, [was, &*changed].map(|it| Some(it.to_owned())));
                assert!(!found.is_same() && found.rows == rows && found.missing == [0, 0]);
                let enough = Tolerance { ulps, relative: 0.0 };
                assert!(within(&text, &after.join("\n"), enough).unwrap().is_same());
                let less = Tolerance { ulps: ulps - 1, relative: 0.0 };
                assert!(!within(&text, &after.join("\n"), less).unwrap().is_same());
            }
            1 => {
                after.remove(line);
                let found = compared(&text, &after.join("\n"));
                assert!(!found.is_same() && found.first.is_none(), "change {n}");
                assert_eq!((found.missing, found.rows), ([0, 1], rows - 1), "change {n}");
                assert_eq!(found.first_missing[1].unwrap().to_string(), cells[0], "change {n}");
                let back = compared(&after.join("\n"), &text);
                assert_eq!((back.missing, back.first_missing[1]), ([1, 0], None), "change {n}");
            }
            2 => {
                let other = 1 + dice.below(before.len() - 1);
                after.swap(line, other);
                let found = compared(&text, &after.join("\n"));
                assert!(found.is_same() && found.rows == rows, "change {n}: {found:?}");
                assert_eq!(found.displaced > 0, line != other, "change {n}");
            }
            _ => {
                let (column, name) = if dice.part() < 0.5 { ("q", "x") } else { ("v", "w") };
                after[0] = HEADER.replace(&format!(",{column}"), &format!(",{name}"));
                let found = compared(&text, &after.join("\n"));
                let first = found.first.clone().unwrap();
                assert_eq!((&*first.column, first.values[1].as_ref()), (column, None));
                assert_eq!(found.alone, [[column.to_owned()], [name.to_owned()]]);
                assert!(!found.is_same() && found.rows == rows, "change {n}");
            }
        }
    }
}

#[test]
fn motionless_or_disjoint_logs_are_never_called_the_same() {
    let still: String = (0..5400).map(|tick| format!("{tick},1.5,0\n")).collect();
    let still = format!("tick,x,v\n{still}");
    let found = compared(&still, &still);
    assert!(!found.is_comparable() && !found.is_same() && found.rows == 5400);
    let one = compared("tick,x\n0,1\n1,2\n", "tick,x\n1,2\n2,3\n");
    assert!(!one.is_comparable() && !one.is_same() && one.rows == 1 && one.missing == [1, 1]);
    let two = compared("tick,x\n0,1\n1,2\n", "tick,x\n0,1\n1,2\n");
    assert!(two.is_same() && two.moved == 1.0);
}

#[test]
fn nan_equals_nan_and_zero_equals_minus_zero_with_a_count() {
    let found = compared("t,x,v\n0,0,NaN\n1,5,nan\n2,1,1", "t,x,v\n0,-0.0,-nan\n1,5,NaN\n2,1,1");
    assert!(found.is_same(), "{found:?}");
    assert_eq!((found.nans, found.zeros_of_two_signs), (2, 1));
    let both = compared("t,x,v\n0,0,NaN\n1,5,0", "t,x,v\n0,0,NaN\n1,5,0");
    assert!(both.is_same() && both.nans == 1, "{both:?}");
    let found = compared("t,x\n0,0\n1,5\n2,7", "t,x\n0,0\n1,NaN\n2,7");
    let first = found.first.clone().unwrap();
    assert_eq!((first.tick, first.ulps, first.relative), (1, None, None));
    assert!(!found.is_same() && found.worst.unwrap().1.is_infinite());
}

#[test]
fn numbers_are_compared_by_value_and_not_by_spelling() {
    let found = compared("t,x\n0,1\n1,2.50\n", "x, t\n1.0,0\n25e-1,1\n");
    assert!(found.is_same() && found.rows == 2, "{found:?}");
}

#[test]
fn tables_with_other_rows_or_without_a_common_column_are_refused() {
    let refused = |a: &str, b: &str| within(a, b, Tolerance::default()).unwrap_err().to_string();
    let told = refused("tick,lane,q\n0,1,2", "tick,q\n0,2");
    assert!(told.contains("a has a column \"lane\" and b has none"), "{told}");
    let told = refused("tick,x\n0,2", "tick,y\n0,2");
    assert!(told.contains("no column of values is in both"), "{told}");
    for tick in ["-2", "0.25", "inf", "1e300"] {
        let told = refused(&format!("tick,x\n{tick},1\n0,3"), "tick,x\n0,3");
        assert!(told.contains("write a whole number of 0 or more"), "{tick}: {told}");
    }
    let told = refused("tick,x\nzero,2", "tick,x\n0,2");
    assert!(told.contains("row 1 of a") && told.contains("zero"), "{told}");
}

#[test]
fn only_an_exponential_growth_has_a_rate() {
    let log = |off: &dyn Fn(f64) -> f64| -> String {
        let rows = (0..3000).map(|tick| {
            let t = f64::from(tick) / 60.0;
            format!("{tick},{t},{}\n", (0.7 * t).cos() + off(t))
        });
        format!("tick,t,x\n{}", rows.collect::<String>())
    };
    let found = compared(&log(&|_| 0.0), &log(&|t| 1e-13 * (0.9 * t).exp()));
    let rate = found.per_second.unwrap();
    assert!((rate - 0.9).abs() < 0.02, "{rate}");
    // e^(0.9 t) has grown from 1e-13 to each level.
    for (level, reached) in [1e-12, 1e-9, 1e-6, 1e-3, 1.0_f64].into_iter().zip(found.reaches) {
        let due = 60.0 * (level / 1e-13).ln() / 0.9;
        assert!((reached.unwrap() as f64 - due).abs() < 6.0, "{level}: {reached:?}, not {due}");
    }
    assert_eq!(compared(&log(&|_| 0.0), &log(&|t| 1e-9 * t * t)).per_second, None);
    assert_eq!(compared(&log(&|_| 0.0), &log(&|_| 1e-9)).per_second, None);
}

#[test]
fn rows_missing_on_one_side_use_no_memory() {
    let all: String = (0..200_000).map(|tick| format!("{tick},{}\n", tick % 7)).collect();
    let some: String =
        (0..200_000).step_by(7).map(|tick| format!("{tick},{}\n", tick % 7)).collect();
    let last = "200000,3\n";
    let found = compared(&format!("tick,x\n{all}{last}"), &format!("tick,x\n{some}{last}"));
    let common = 200_000_u64.div_ceil(7) + 1;
    assert_eq!((found.rows, found.missing), (common, [0, 200_001 - common]));
    assert!(found.first.is_none() && !found.is_same());
}

#[test]
fn a_run_and_its_copy_are_the_same_and_a_kick_is_found_in_its_tick() {
    let run = |kick: Option<u64>| {
        let mut session = Session::racing(Scene::built_in("spring").unwrap().into());
        let mut text = "tick,x,v\n".to_owned();
        for tick in 0..200 {
            let body = &session.race().entrants()[0].lane.bodies()[0];
            text += &format!("{tick},{:?},{:?}\n", body.stepper.q()[0], body.stepper.v()[0]);
            if kick == Some(tick) {
                session.act(Action::Kick(1e-9));
            }
            session.tick(&mut ());
        }
        text
    };
    assert!(compared(&run(None), &run(None)).is_same());
    let found = compared(&run(None), &run(Some(77)));
    assert_eq!(found.first.unwrap().tick, 78);
}

#[test]
fn a_column_starting_with_nan_moves_from_its_first_number_on() {
    let log = |last: u32| format!("tick,x,y\n0,NaN,0\n1,1,0\n2,{last},0\n");
    let found = compared(&log(2), &log(7));
    assert_eq!((found.moved, found.first.unwrap().tick), (6.0, 2));
    let found = compared(&log(2), &log(2));
    assert!(found.is_same() && found.moved == 1.0 && found.nans == 1, "{found:?}");
    let none = compared("tick,x\n0,NaN\n1,NaN\n2,inf\n", "tick,x\n0,NaN\n1,NaN\n2,inf\n");
    assert!(!none.is_comparable() && none.moved == 0.0, "{none:?}");
}

#[test]
fn a_clock_column_of_any_name_is_no_motion() {
    let log = |column: &str, cell: &dyn Fn(u32) -> String| -> String {
        let rows = (0..40).map(|row| format!("{row},{},5\n", cell(row)));
        format!("tick,{column},hp\n{}", rows.collect::<String>())
    };
    let even = |row: u32| format!("{:.6}", f64::from(row) / 60.0);
    let uneven = |row: u32| (row * row + 16 * row).to_string();
    let milliseconds = |row: u32| format!("{:.0}", f64::from(row) * 1e3 / 60.0);
    for name in ["sim_time", "gameTimeMs", "uptime", "T", "game.clock", "n"] {
        for text in [log(name, &even), log(name, &milliseconds)] {
            assert!(!compared(&text, &text).is_comparable(), "{name}");
        }
    }
    assert!(!compared(&log("wall_ms", &uneven), &log("wall_ms", &uneven)).is_comparable());
    // A column named like a coordinate may grow evenly, and an uneven column is no clock.
    for (name, text) in [("x", log("pos_x", &even)), ("energy", log("energy", &uneven))] {
        assert!(compared(&text, &text).is_same(), "{name}");
    }
    // A clock that goes back, or is uneven on one side, is compared.
    let back = log("sim_time", &even).replace("0.200000", "9");
    assert!(compared(&back, &back).is_same());
    let kicked = log("T", &even).replace("0.200000", "0.21");
    let found = compared(&log("T", &even), &kicked);
    assert_eq!(found.first.unwrap().tick, 12);
    // The only column with values, and two rows, are no clock.
    for text in ["tick,T\n0,1\n1,2\n2,3\n", "tick,T,hp\n0,1,5\n1,2,5\n"] {
        assert!(compared(text, text).is_same(), "{text}");
    }
}

#[test]
fn too_many_row_names_for_the_memory_are_refused() {
    let rows: String = (0..1_500_000).map(|i| format!("0,{i},1\n")).collect();
    let text = format!("tick,body,q\n{rows}");
    let told = within(&text, &text, Tolerance::default()).unwrap_err().to_string();
    assert!(told.contains("names by lane, body and coordinate"), "{told}");
    assert!(told.contains("compare fewer bodies or columns at a time"), "{told}");
    // As many rows with few names take no memory.
    let rows: String = (0..300_000).map(|i| format!("{},{},{}\n", i / 3, i % 3, i % 7)).collect();
    let text = format!("tick,body,q\n{rows}");
    assert!(compared(&text, &text).is_same());
}

/// Two tables, with these columns chosen.
fn choosing(a: &str, b: &str, chosen: Chosen) -> Result<Comparison, Box<dyn Error>> {
    diff(&mut table(a)?, &mut table(b)?, Tolerance::default(), &chosen)
}

fn names(list: &str) -> Vec<String> {
    list.split(',').map(str::to_owned).collect()
}

#[test]
fn rows_are_matched_by_key_in_any_order_and_frames_count_as_ticks() {
    let a = "frame,object,crc\n1,10,A1\n1,11,00\n2,10,A2\n2,11,01\n3,10,1234\n3,11,02\n";
    let b = "frame,object,crc\n1,10,A1\n1,11,00\n2,11,01\n2,10,A2\n3,11,02\n3,10,1235\n";
    let chosen = Chosen { key: names("frame,object"), ..Chosen::default() };
    let found = choosing(a, b, chosen.clone()).unwrap();
    let first = found.first.unwrap();
    let words = "at frame 3, object 10: crc is 1234 in a and 1235 in b";
    assert_eq!(first.to_string(), words);
    assert_eq!((found.rows, found.missing), (6, [0, 0]));
    // Two logs of the same numbers are the same, and one that lacks a frame lacks that alone.
    assert!(choosing(a, a, chosen.clone()).unwrap().is_same());
    let without = b.replace("2,11,01\n2,10,A2\n", "").replace("1235", "1234");
    let found = choosing(a, &without, chosen).unwrap();
    assert_eq!((found.first, found.missing, found.first_missing), (None, [0, 2], [None, Some(2)]));
    // Without a frame rows have no order, and nothing has to move.
    let chosen = Chosen { key: names("name"), ..Chosen::default() };
    let found = choosing("name,x\nl,1\nr,2\n", "name,x\nr,2\nl,3\n", chosen).unwrap();
    assert_eq!(found.first.unwrap().place(str::to_owned), "name l");
}

#[test]
fn a_column_is_text_or_numbers_from_its_first_row_on() {
    // Both begin with cells that are the same number, 0.
    let [a, b] = ["0000E012", "0000E013"].map(|hash| format!("tick,h\n0,{hash}\n1,FF\n2,AB\n"));
    assert_eq!(compared(&a, &b).first.unwrap().tick, 0);
    let [a, b] = ["0e1", "0e2"].map(|hash| format!("tick,h,x\n0,{hash},1\n1,1,2\n2,AB,3\n"));
    let found = compared(&a, &b);
    assert_eq!(found.first.unwrap().values, [Some("0e1".into()), Some("0e2".into())]);
    assert_eq!((found.columns[0].first_tick, found.columns[0].rows), (0, 1));
    assert!(compared(&a, &a).is_same());
    // A number that is missing makes no text of the others.
    let [a, b] = ["1.50", "1.5"].map(|x| format!("tick,x\n0,{x}\n1,NA\n2,\n3,2\n"));
    assert!(compared(&a, &b).is_same());
    // A hash that changes is a motion, and one that stays or a date is none.
    assert!(compared("tick,h\n0,A\n1,B\n", "tick,h\n0,A\n1,B\n").is_same());
    for still in ["tick,h\n0,A\n1,A\n", "tick,time\n0,12:30\n1,12:31\n"] {
        assert!(!compared(still, still).is_comparable(), "{still}");
    }
}

#[test]
fn each_column_reports_its_first_difference_and_can_be_excluded() {
    let a = "tick,x,v,wall_ms,src_ms\n0,1,0,2362,8300\n1,0.9,-0.6,2378,8316\n2,0.7,-1,2395,8333\n";
    let b = "tick,x,v,wall_ms,src_ms\n0,1,0,2380,8290\n1,0.9,-0.6,2397,8316\n2,0.7,-1,2414,8333\n";
    let found = compared(a, b);
    let columns: Vec<_> =
        found.columns.iter().map(|it| (&*it.column, it.first_tick, it.rows)).collect();
    assert_eq!(columns, [("wall_ms", 0, 3), ("src_ms", 0, 1)]);
    assert_eq!(found.equal, ["x", "v"]);
    for chosen in [
        Chosen { columns: names("x,v"), ..Chosen::default() },
        Chosen { ignored: names("wall_ms,src_ms"), ..Chosen::default() },
    ] {
        assert!(choosing(a, b, chosen).unwrap().is_same());
    }
    let ticks = Chosen { tick: Some("wall_ms".into()), ..Chosen::default() };
    assert!(choosing(a, a, ticks).unwrap().is_same());
    for wrong in [
        Chosen { columns: names("x,w"), ..Chosen::default() },
        Chosen { ignored: names("w"), ..Chosen::default() },
        Chosen { key: names("w"), ..Chosen::default() },
        Chosen { tick: Some("w".into()), ..Chosen::default() },
    ] {
        let error = choosing(a, b, wrong).unwrap_err().to_string();
        assert_eq!(error, "a has no column \"w\"; it has tick, x, v, wall_ms, src_ms");
    }
}
