//! `cloud`: a table of the effect of methods on an area.

use std::fs;

use super::{refusal, run, run_in, stderr, stdout_of};

#[test]
fn each_method_has_the_same_row_for_any_number_of_threads() {
    let run = |threads: u32| {
        let options = "cloud --scene spring --method explicit-euler --method implicit-midpoint";
        let csv = stdout_of(&format!("{options} --points 5000 --seconds 0.5 --threads {threads}"));
        let rows: Vec<Vec<String>> =
            csv.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
        assert_eq!(rows[0].join(","), "method,points,area_ratio,spread,body_steps_per_s,hash");
        assert_eq!(
            (rows[1][0].as_str(), rows[2][0].as_str()),
            ("explicit-euler", "implicit-midpoint")
        );
        assert!(rows[1][2].parse::<f64>().unwrap() > 1.2 && rows.len() == 3);
        rows.into_iter().map(|row| row[5].clone()).collect::<Vec<_>>()
    };
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(7));
}

#[test]
fn rows_written_to_a_file_are_summarised_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let options = "cloud --scene liouville --points 1200 --seconds 0.5 --out";
    let begins = |file: &str| {
        let done = run_in(folder.path(), &format!("{options} {file}"));
        assert!(done.status.success(), "{}", stderr(&done));
        assert!(stderr(&done).contains("explicit-euler grows ×2 in"), "{}", stderr(&done));
        fs::read_to_string(folder.path().join(file)).unwrap()
    };
    assert!(begins("cat.csv").starts_with("method,points,"));
    assert!(begins("cat.json").starts_with("[\n{\"method\":"));
}

#[test]
fn names_of_rows_with_one_method_show_the_difference() {
    let rows = stdout_of("cloud --scene held-force --points 10 --seconds 0.1");
    let methods: Vec<&str> = rows.lines().skip(1).filter_map(|row| row.split(',').next()).collect();
    let mut different = methods.clone();
    different.sort_unstable();
    different.dedup();
    assert!(methods.len() > 2 && methods.len() == different.len(), "{methods:?}");
    assert!(methods.iter().all(|name| name.starts_with("held-force")), "{methods:?}");
}

#[test]
fn an_impossible_cloud_is_refused_in_one_line() {
    for (options, why) in [
        ("--scene orbit", "satellite has 2; give a scene with a body of one coordinate"),
        ("--scene spring --points 1000000000", "1000000000 points do not fit into memory"),
        ("--out cat.png", "`regatta capture --instrument cloud` draws cat.png"),
        ("--out cat.gif", "`regatta capture --instrument cloud` draws cat.gif"),
        ("--out cloud.svg", "cloud.svg would not hold what its name says"),
        ("--shape cow", "cow"),
        ("--reach 1e-300", "give a number from 1e-6 to 1e9"),
        ("--reach NaN", "give a number from 1e-6 to 1e9"),
        ("--points 0", "0 is not in 1..=1000000000"),
    ] {
        let said = refusal(&format!("cloud {options}"), 2);
        assert!(said.contains(why), "{said}");
    }
    let lost = "cloud --scene stiff --method explicit-euler --points 100 --seconds 5";
    let done = run(lost);
    assert!(
        stderr(&done).contains("100 of 100 starts blew up and are left out"),
        "{}",
        stderr(&done)
    );
}

#[test]
fn a_start_that_blows_up_is_excluded_from_the_measure() {
    let folder = tempfile::tempdir().unwrap();
    // Without damping or a well beyond 1: who starts there runs away.
    let law = "title = 'A hill'\ntick_hz = 60\nseconds = 9\n[[law]]\n[law.coordinates.x]\nstart = 0.9\n\
               acceleration = 'x^3 - x'";
    fs::write(folder.path().join("hill.toml"), law).unwrap();
    let done = run_in(
        folder.path(),
        "cloud --scene hill.toml --method rk4 --points 400 --reach 0.4 --seconds 3",
    );
    let (row, said) = (String::from_utf8(done.stdout.clone()).unwrap(), stderr(&done));
    let points: usize = row.lines().nth(1).unwrap().split(',').nth(1).unwrap().parse().unwrap();
    assert!((50..350).contains(&points), "{row}");
    assert!(said.contains(&format!("{} of 400 starts blew up", 400 - points)), "{said}");
    let ratio: f64 = row.lines().nth(1).unwrap().split(',').nth(2).unwrap().parse().unwrap();
    assert!((0.5..2.0).contains(&ratio), "{row}");
}
