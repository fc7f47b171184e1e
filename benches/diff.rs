//! What it takes to compare two logs, beside reading the same bytes with `csv` alone, which is the floor.
//!
//! `cargo bench --no-default-features --features lab --bench diff` prints millions of rows a second, those of both logs counted.

use std::error::Error;
use std::fmt::Write;
use std::time::Instant;

use csv::ByteRecord;
use regatta::run::diff::{Chosen, Tolerance, diff, table};

/// The rows of each log.
const ROWS: u32 = 1_000_000;
const TIMES: usize = 5;

/// Four lanes that swing; with `off`, each number differs in its last digits.
fn log(off: f64) -> String {
    let mut text = "tick,t,lane,method,body,coordinate,q,v\n".to_owned();
    for n in 0..ROWS {
        let (tick, lane) = (n / 4, n % 4);
        let t = f64::from(tick) / 60.0;
        let (v, q) = (t + f64::from(lane)).sin_cos();
        let row = writeln!(text, "{tick},{t},{lane},rk4,spring,x,{},{}", q + off, v + off);
        row.expect("text takes all");
    }
    text
}

/// The rate at which rows are done, the best of some runs.
fn rate(mut work: impl FnMut()) -> f64 {
    let time = || {
        let start = Instant::now();
        work();
        f64::from(2 * ROWS) / start.elapsed().as_secs_f64()
    };
    std::iter::repeat_with(time).take(TIMES).fold(0.0, f64::max)
}

fn main() {
    let [before, after] = [0.0, 1e-13].map(log);
    let floor = rate(|| {
        let mut row = ByteRecord::new();
        for text in [&before, &before] {
            let mut rows = table(text).expect("a header");
            while rows.next(&mut row).expect("a row").is_some() {}
        }
    });
    println!("csv alone: {:.2} M rows/s", floor / 1e6);
    for (what, other) in [("the same", &before), ("each row another", &after)] {
        let table = |text| table(text).expect("a header");
        let of_both = rate(|| {
            let found = diff(
                &mut table(&before),
                &mut table(other),
                Tolerance::default(),
                &Chosen::default(),
            );
            let found: Result<_, Box<dyn Error>> = found;
            assert_eq!(found.expect("two tables").rows, u64::from(ROWS));
        });
        println!("{what}: {:.2} M rows/s, {:.2} of csv alone", of_both / 1e6, of_both / floor);
    }
}
