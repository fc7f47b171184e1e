//! `chapter`: every printed number, and the figures.

use std::fs;

use serde_json::Value;

use super::{names, refusal, run_in, stderr, stdout_of};

#[test]
fn every_printed_number_has_its_tick() {
    let text = stdout_of("chapter");
    let (table, rest) = text.split_once("\nMean error").unwrap();
    let rows: Vec<&str> = table.lines().skip(3).filter(|line| !line.is_empty()).collect();
    assert_eq!(rows.len(), 5, "{table}");
    for row in rows {
        assert_eq!(row.matches('✓').count(), 3, "{row}");
    }
    let (means, rest) = rest.split_once("\nDistance run").unwrap();
    assert_eq!(means.matches('✓').count(), 3, "{means}");
    assert!(!text.contains("printed: "), "{text}");
    assert!(text.lines().all(|line| line.trim_end() == line), "{text}");

    // Values that the chapter does not print, from our own oracles.
    for cells in [
        ["Explicit Euler", "53.624067", "−1.859"],
        ["Semi-implicit Euler", "59.442864", "3.960"],
        ["Improved Euler (as printed)", "58.303177", "2.820"],
        ["Runge-Kutta 4 (as printed)", "58.322053", "2.839"],
        ["Improved Euler", "55.514425", "0.03144"],
        ["Runge-Kutta 4", "55.482990", "3.946·10⁻⁶"],
        ["0.01", "8.3447 s", "11.50002"],
        ["0.001", "2.5524 s", "4.53532"],
        ["0.0001", "0.7742 s", "1.49330"],
        ["0.01", "11.44911643", "27"],
        ["0.001", "11.45142237", "62"],
        ["0.0001", "11.45167142", "182"],
    ] {
        let row = |line: &&str| {
            line.trim_start().starts_with(&format!("{}  ", cells[0])) && line.contains(cells[1])
        };
        let row = rest.lines().find(row).unwrap_or_else(|| panic!("{cells:?} in {rest}"));
        assert!(row.contains(cells[2]), "{row}");
    }
}

#[test]
fn figures_are_drawn_with_their_data() {
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(folder.path(), "chapter --out figures");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(
        stderr(&output).ends_with("wrote 7 figures and their data: figures/figure-7-2.png …\n")
    );
    let figures = folder.path().join("figures");
    let expected: Vec<String> =
        (2..=8).flat_map(|n| ["csv", "png"].map(|end| format!("figure-7-{n}.{end}"))).collect();
    assert_eq!(names(&figures), expected);
    for n in 2..=8 {
        let picture = image::open(figures.join(format!("figure-7-{n}.png"))).unwrap().into_rgb8();
        assert_eq!(picture.dimensions(), (1600, 1000));
        let bright = picture.pixels().filter(|pixel| pixel.0.iter().any(|&c| c > 150)).count();
        assert!((5_000..200_000).contains(&bright), "figure 7-{n}: {bright} bright pixels");

        let csv = fs::read_to_string(figures.join(format!("figure-7-{n}.csv"))).unwrap();
        let unit = if [5, 8].contains(&n) { "displacement_m" } else { "speed_m_per_s" };
        assert_eq!(csv.lines().next(), Some(&*format!("curve,time_s,{unit}")));
        let curves: Vec<&str> =
            csv.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
        let of = |name: &str| curves.iter().filter(|curve| **curve == name).count();
        assert!(of("exact") > 500, "figure 7-{n}");
        assert_eq!(of("Explicit Euler") > 0, n != 8, "figure 7-{n}");
        assert_eq!(of("Improved Euler") > 0, n >= 6, "figure 7-{n}");
        assert_eq!(of("Runge-Kutta 4") > 0, n >= 6, "figure 7-{n}");
    }
    let of_table = fs::read_to_string(figures.join("figure-7-3.csv")).unwrap();
    assert!(of_table.contains("\nExplicit Euler,8.5,11.63759329"), "{of_table}");
}

#[test]
fn figures_replace_only_figures_and_only_when_forced() {
    let folder = tempfile::tempdir().unwrap();
    let figures = folder.path().join("figures");
    fs::create_dir(&figures).unwrap();
    for name in ["figure-7-3.png", "figure-7-9.png", "notes.txt"] {
        fs::write(figures.join(name), "old").unwrap();
    }
    let refused = run_in(folder.path(), "chapter --out figures");
    assert_eq!(refused.status.code(), Some(2));
    assert!(refused.stdout.is_empty());
    assert!(stderr(&refused).contains("--force to replace the figures in it"));
    assert_eq!(fs::read(figures.join("figure-7-3.png")).unwrap(), b"old");

    let forced = run_in(folder.path(), "chapter --out figures --force");
    assert_eq!(forced.status.code(), Some(0), "{}", stderr(&forced));
    assert!(stderr(&forced).contains("left alone in figures: figure-7-9.png, notes.txt"));
    assert_eq!(names(&figures).len(), 16);
    assert_ne!(fs::read(figures.join("figure-7-3.png")).unwrap(), b"old");
}

#[test]
fn a_figure_needs_a_directory() {
    assert!(refusal("chapter --out Cargo.toml", 2).contains("Cargo.toml is not a directory"));
    assert!(refusal("chapter --force", 2).contains("--out <DIR>"));
}

#[test]
fn the_chapter_a_link_a_cloud_and_a_fixture_are_also_written_as_json() {
    let json = |arguments: &str| -> Value {
        serde_json::from_str(&stdout_of(&format!("{arguments} --format json"))).unwrap()
    };
    let chapter = json("chapter");
    let rows = chapter["table_7_1"].as_array().unwrap();
    assert_eq!(rows.len(), 5);
    for row in rows {
        let cell = &row["exact_m_per_s"];
        let printed: f64 = cell["printed"].as_str().unwrap().parse().unwrap();
        assert_eq!(cell["shown"], cell["printed"]);
        assert!((cell["value"].as_f64().unwrap() - printed).abs() < 1e-5, "{row}");
    }
    let rk4 = &chapter["distances"][5];
    assert_eq!(rk4["method"], "rk4");
    assert!((rk4["distance_m"].as_f64().unwrap() - 55.482990).abs() < 1e-6, "{rk4}");
    assert_eq!(chapter["adaptive_euler"][2]["substeps"], 182);

    let link = stdout_of("link spring");
    assert_eq!(json("link spring")["link"], link.trim_end());
    let clouds = json("cloud --scene liouville --points 100 --seconds 1");
    assert_eq!(clouds[3]["method"], "rk4");
    let fixture = "fixture --scene spring --seconds 1";
    assert_eq!(json(fixture).to_string(), {
        let states: Value =
            serde_json::from_str(&stdout_of(&format!("{fixture} --as json"))).unwrap();
        states.to_string()
    });
}
