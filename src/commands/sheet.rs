//! A contact sheet, which is one picture of a race. It has a column for each moment and a row for each lane.

use std::io::Write;

use super::drawing::{check_pixels, interrupted_after};
use super::error::Error;
use super::experiment::Experiment;
use super::interrupt::watch_for_interrupt;
use super::output::Output;
use super::pipeline::complete_analysis;
use super::settings::CaptureSettings;
use super::terminal::{print_status, progress};
use crate::measure::cloud::CloudWorker;
use crate::run::race::Mode;
use crate::scene::LaneSpec;
use crate::studio::Studio;
use crate::view::png;

/// Maximum number of pixels of a sheet. They take a gigabyte of memory.
const MAX_SHEET_PIXELS: u64 = 1 << 28;

/// Draws each lane of the experiment by itself, at the moments of the capture, into one picture.
pub(super) fn draw(
    experiment: &Experiment,
    studio: &Studio,
    capture: CaptureSettings,
    mut output: Output,
) -> Result<(), Error> {
    let [width, height] = capture.size_px;
    let columns = capture.schedule.frames;
    let lanes = studio.race().entrants().iter().map(|entrant| entrant.spec);
    let lanes: Vec<LaneSpec> = lanes.collect();
    let methods: Vec<&str> = lanes.iter().map(|lane| lane.method.id).collect();
    let rows = lanes.len() as u32;
    let cells = rows * columns;
    check_pixels(cells, capture.size_px, MAX_SHEET_PIXELS)?;
    let mut renderer = capture.renderer()?;
    let interrupted = watch_for_interrupt();
    let progress = progress(cells, "frames");
    let row_bytes = 4 * width as usize;
    let sheet_row_bytes = row_bytes * columns as usize;
    let mut sheet = vec![0; sheet_row_bytes * (rows * height) as usize];
    let mut cell = renderer.buffer()?;
    for (row, lane) in lanes.into_iter().enumerate() {
        let mut scene = experiment.scene.clone();
        scene.lanes = vec![lane];
        let text = experiment.text.clone();
        let alone = Experiment {
            scene,
            text,
            selected: Some(lane.method),
            mode: Mode::Solo,
            loop_trace: None,
        };
        let (mut studio, mut clouds) =
            (capture.prepare_studio(alone.studio()), CloudWorker::default());
        for column in 0..columns {
            capture.schedule.advance(&mut studio, column, &mut ());
            if !complete_analysis(&mut studio, &renderer, &mut clouds, &interrupted) {
                progress.finish_and_clear();
                let done = row as u32 * columns + column;
                return Err(interrupted_after(done, cells, "none, a sheet is one"));
            }
            renderer.draw(&studio, &mut cell)?;
            let top = row * height as usize;
            for (y, line) in cell.chunks_exact(row_bytes).enumerate() {
                let at = (top + y) * sheet_row_bytes + column as usize * row_bytes;
                sheet[at..at + row_bytes].copy_from_slice(line);
            }
            progress.inc(1);
        }
    }
    progress.finish_and_clear();
    let size_px = [columns * width, rows * height];
    output.write_all(&png::encode(size_px, &sheet))?;
    let name = output.close()?;
    print_status(&format!(
        "wrote a sheet of {}x{}: {name}; {columns} moments across; down: {}",
        size_px[0],
        size_px[1],
        methods.join(", ")
    ));
    Ok(())
}
