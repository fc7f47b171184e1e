//! Exports an instrument: its values as a table, and its plots as a drawing.

use egui::{Align2, Pos2, Rect, pos2, vec2};

use super::super::loops;
use super::super::tracks::Detail;
use super::layout::cells;
use super::plot_set::{PlotAxis, PlotSet};
use super::{chart, plot_set_of};
use crate::chart::{ABOVE, NAME, Primitive, Text, legend, svg};
use crate::run::csv_row;
use crate::studio::{Instrument, Studio};
use crate::theme::{PanelPalette, palette_of};

/// Size of a drawing in its own pixels, and size of the margins around its plots.
const SIZE: [f32; 2] = [960.0, 600.0];
const MARGIN: f32 = 20.0;
const HEAD: f32 = 62.0;
const LEFT: f32 = 64.0;
/// Returns the values of the selected instrument as comma-separated text, with a line for each sample of each curve, or
/// `None` if the instrument has no plots.
pub(crate) fn csv(studio: &Studio) -> Option<Vec<String>> {
    if studio.display().instrument == Instrument::Loop {
        return Some(loops::csv(studio));
    }
    let mut lines = vec!["plot,quantity,unit,curve,t_s,value\n".to_owned()];
    let set = plot_set_of(studio, Detail::Samples)?;
    for plot in &set.plots {
        let mut add = |curve: &str, t: f64, at: [f64; 2]| {
            let values = plot.axes.iter().zip(at).skip(usize::from(plot.is_over_time()));
            for (axis, place) in values {
                let value = axis.scale.value(place);
                let PlotAxis { quantity, unit, .. } = axis;
                lines.push(csv_row(&[&plot.title, quantity, unit, &curve, &t, &value]));
            }
        };
        for track in &plot.tracks {
            for (t, entry, at) in track.places() {
                let id = &set.styles.series[entry].id;
                add(format!("{id} {}", track.part).trim_end(), t, at);
            }
        }
        for line in &plot.exact {
            for (&t, &at) in line.times.iter().zip(&line.curve.points) {
                add(format!("exact {}", line.part).trim_end(), t, at);
            }
        }
    }
    Some(lines)
}

/// Returns the plots of the selected instrument as an SVG file, or `None` if the instrument has no plots.
pub(crate) fn svg(studio: &Studio) -> Option<String> {
    let palette = palette_of(studio.display().theme);
    let all = Rect::from_min_size(Pos2::ZERO, SIZE.into());
    let room = Rect::from_min_max(pos2(MARGIN, HEAD), all.max - vec2(MARGIN, MARGIN / 2.0));
    let (title, entries, plots) = if studio.display().instrument == Instrument::Loop {
        let (title, entries, plots) = loops::layout(studio, room, palette)?;
        (title.to_owned(), entries, plots)
    } else {
        let set = plot_set_of(studio, Detail::Samples)?;
        let plots = layout(studio, &set, room, all.right(), palette);
        (set.title.clone(), super::legend_entries(&set), plots)
    };
    let head = format!("{}: {title}", studio.deck.scene_name());
    let head = Text::new(pos2(MARGIN, MARGIN + 2.0), Align2::LEFT_CENTER, head, 17.0, palette.text);
    let mut drawing = vec![Primitive::Area(all, palette.background), head.into()];
    drawing.extend(legend::layout(&entries, pos2(MARGIN, MARGIN + 26.0), palette));
    drawing.extend(plots);
    Some(svg::file(SIZE, &drawing))
}

/// Lays out the plots of a set with their titles.
fn layout(
    studio: &Studio,
    set: &PlotSet,
    room: Rect,
    right: f32,
    palette: &PanelPalette,
) -> Vec<Primitive> {
    let mut all = Vec::new();
    for cell in &cells(set, room, LEFT, studio.view().body) {
        let area = cell.area(&studio.view().plot_ranges);
        let room = (area.rect.width(), right);
        all.extend(chart::layout(studio, &set.styles, (cell, &area), palette, room));
        let title = pos2(area.rect.center().x, area.rect.top() - ABOVE / 2.0);
        let title = Text::new(title, Align2::CENTER_CENTER, &*cell.plot.title, NAME, palette.text);
        all.push(title.into());
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::studio::{Instrument, StageCommand};

    fn race() -> Studio {
        let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
        studio.apply(StageCommand::ToggleRace);
        (0..300).for_each(|_| studio.tick());
        studio
    }

    #[test]
    fn every_value_of_every_curve_is_in_the_table() {
        let mut studio = race();
        for instrument in [Instrument::Motion, Instrument::Error, Instrument::Phase] {
            studio.apply(StageCommand::Instrument(instrument));
            let text = csv(&studio).unwrap().concat();
            let set = plot_set_of(&studio, Detail::Samples).unwrap();
            let rows = |plot: &super::super::plot_set::PlotModel| {
                let lanes: usize = plot.tracks.iter().map(|track| track.places().count()).sum();
                let exact: usize = plot.exact.iter().map(|line| line.times.len()).sum();
                (lanes + exact) * if plot.is_over_time() { 1 } else { 2 }
            };
            assert_eq!(text.lines().count(), 1 + set.plots.iter().map(rows).sum::<usize>());
            assert!(text.lines().all(|line| line.split(',').count() == 6), "{instrument:?}");
        }
        studio.apply(StageCommand::Instrument(Instrument::Advice));
        assert!(csv(&studio).is_none() && svg(&studio).is_none());
    }

    #[test]
    fn a_drawing_has_every_curve_and_its_tags_are_closed() {
        let mut studio = race();
        studio.apply(StageCommand::Instrument(Instrument::Loop));
        assert!(svg(&studio).is_none(), "the window has made no frame");
        (0..30).for_each(|_| _ = studio.advance(16_666_667));
        assert!(svg(&studio).is_some_and(|text| text.contains("frame time, ms")));
        for instrument in Instrument::all().filter(|it| it.is_of(race().scene())) {
            studio.apply(StageCommand::Instrument(instrument));
            let Some(text) = svg(&studio) else { continue };
            let count = |what: &str| text.matches(what).count();
            assert!(count("<polyline") > 10 && !text.contains("NaN"), "{instrument:?}");
            for tag in ["svg", "g", "text", "clipPath"] {
                assert_eq!(count(&format!("<{tag} ")), count(&format!("</{tag}>")), "{tag}");
            }
        }
    }
}
