//! The diagrams that `sweep --plot` draws.

use std::fs;
use std::path::Path;
use std::process::Stdio;

use regatta::look::palette::Theme;
use regatta::sim::integrators::method;

use super::sweep::HEADER;
use super::{dimensions, names, refusal, regatta, run_in, stderr};

/// How many pixels of the picture have each of these colours, or one close to it.
fn lit(picture: &Path, colours: &[[u8; 3]]) -> Vec<usize> {
    let picture = image::open(picture).unwrap().into_rgb8();
    let near = |pixel: &[u8; 3], colour: &[u8; 3]| {
        pixel.iter().zip(colour).all(|(a, b)| a.abs_diff(*b) < 12)
    };
    let count = |colour| picture.pixels().filter(|pixel| near(&pixel.0, colour)).count();
    colours.iter().map(count).collect()
}

#[test]
fn the_plot_shows_every_method_in_addition_to_the_rows() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = "sweep --scene spring --method explicit-euler --method midpoint --method rk4 \
                 --plot sweep.png";
    let output = run_in(folder.path(), sweep);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stderr(&output), "wrote a picture of 920x900: sweep.png\n");
    assert!(output.stdout.starts_with(HEADER.as_bytes()));
    assert_eq!(names(folder.path()), ["sweep.png"]);
    let picture = folder.path().join("sweep.png");
    assert_eq!(dimensions(&picture), (920, 900));
    let colour = |id: &str| {
        let (rgba, _) = Theme::Dark.style(method(id).unwrap());
        [rgba[0], rgba[1], rgba[2]]
    };
    let colours = ["explicit-euler", "midpoint", "rk4", "semi-implicit-euler"].map(colour);
    let [euler, midpoint, rk4, none] = lit(&picture, &colours)[..] else { panic!("four counts") };
    assert!((100..20_000).contains(&euler), "{euler} pixels of explicit Euler");
    assert!((300..20_000).contains(&midpoint), "{midpoint} pixels of midpoint");
    assert!((1_000..40_000).contains(&rk4), "{rk4} pixels of Runge-Kutta 4");
    assert_eq!(none, 0, "pixels of a method that was not swept");

    let refused = run_in(folder.path(), sweep);
    assert_eq!(refused.status.code(), Some(2), "{}", stderr(&refused));
    let again = run_in(folder.path(), &format!("{sweep} --force --out -"));
    assert_eq!(again.status.code(), Some(0));
}

#[test]
fn a_picture_goes_to_standard_output_if_the_rows_do_not() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = "sweep --scene ship --scene surge --scene orbit --method rk4 --out rows.json \
                 --format json --plot -";
    let output = run_in(folder.path(), sweep);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stderr(&output), "wrote 23 rows: rows.json\n");
    let picture = image::load_from_memory(&output.stdout).unwrap().into_rgb8();
    assert_eq!(picture.dimensions(), (1840, 1560));
}

#[test]
fn round_off_is_drawn_on_request_for_the_chapters_ship_only() {
    for arguments in ["--round-off", "--plot x.png --scene ship --vary x=1 --round-off"] {
        refusal(&format!("sweep {arguments}"), 2);
    }
    for arguments in ["--scene spring --method rk4", "--scene ship --method midpoint"] {
        let refused = refusal(&format!("sweep {arguments} --plot x.png --round-off"), 2);
        assert!(refused.contains("give --scene ship --method rk4"), "{refused}");
    }
    let folder = tempfile::tempdir().unwrap();
    let sweep = "sweep --scene ship --method rk4 --tick-hz 2,4 --plot";
    for (file, options, size) in
        [("one.png", "", (920, 900)), ("two.png", "--round-off", (1840, 900))]
    {
        let command = format!("{sweep} {file} {options}");
        let output = run_in(folder.path(), command.trim());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        assert_eq!(dimensions(&folder.path().join(file)), size);
    }
}

#[test]
fn a_pipe_that_closes_early_does_not_lose_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let sweep = "sweep --scene ship --method rk4 --plot sweep.png --force";
    run_in(folder.path(), sweep);
    fs::remove_file(folder.path().join("sweep.png")).unwrap();
    let mut child = regatta();
    child.current_dir(folder.path()).args(sweep.split(' ')).stderr(Stdio::piped());
    let mut child = child.stdout(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(stderr(&output), "wrote a picture of 920x900: sweep.png\n");
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(names(folder.path()), ["sweep.png"]);
}
