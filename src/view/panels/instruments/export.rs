//! An instrument as text: its values as a table, and its plots as a drawing.

use std::fmt::Write;

use egui::{Color32, Pos2, Rect, pos2, vec2};
use egui_plot::PlotBounds;

use super::super::roster::Roster;
use super::super::tracks::Detail;
use super::super::{ink_of, loops};
use super::layout::{Cell, MARKS_APART, NUMBER, NUMBERS, TITLE, WORDS, cells};
use super::sheet::Sheet;
use super::{by_loop, sheet_of};
use crate::lab::{Instrument, Lab};
use crate::view::curves::{Curve, arrow_corners};
use crate::view::plot::{Arrow, Switch, SwitchMark, on_screen};
use crate::view::theme::Ink;

/// The size of a drawing, in its own pixels, and the room round its plots.
const SIZE: [f32; 2] = [960.0, 600.0];
const MARGIN: f32 = 20.0;
const HEAD: f32 = 62.0;
const LEFT: f32 = 64.0;
/// Points of a curve closer than this, in pixels, are one.
const SAME: f32 = 0.2;
/// The radius of the ring round a switch.
const RING: f32 = 4.0;

/// The values of the chosen instrument as comma-separated text, a line for each sample of each curve; `None` if it has no
/// plots.
pub(in crate::view) fn csv(lab: &Lab) -> Option<Vec<String>> {
    if lab.display().instrument == Instrument::Loop {
        return Some(loops::csv(lab));
    }
    let mut lines = vec!["plot,quantity,unit,curve,t_s,value\n".to_owned()];
    let sheet = sheet_of(lab, Detail::Samples)?;
    for plot in &sheet.plots {
        let mut add = |curve: &str, t: f64, at: [f64; 2]| {
            let values = plot.axes.iter().zip(at).skip(usize::from(plot.is_over_time()));
            for (axis, place) in values {
                let [title, quantity] = [&plot.title, &axis.quantity].map(|text| quoted(text));
                let value = axis.scale.value(place);
                let unit = &axis.unit;
                lines.push(format!("{title},{quantity},{unit},{curve},{t},{value}\n"));
            }
        };
        for track in &plot.tracks {
            for (t, entry, at) in track.places() {
                let id = &sheet.roster.runners[entry].id;
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

fn quoted(text: &str) -> String {
    if text.contains([',', '"']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into()
    }
}

/// The plots of the chosen instrument as an SVG file; `None` if it has none.
pub(in crate::view) fn svg(lab: &Lab) -> Option<String> {
    let sheet = match (lab.loop_lab(), lab.display().instrument) {
        (Some(loops), Instrument::Loop) => by_loop::moments(lab, loops),
        _ => sheet_of(lab, Detail::Samples)?,
    };
    let mut drawing = Svg { text: String::new(), ink: ink_of(lab.display().theme) };
    let [width, height] = SIZE;
    let ink = drawing.ink;
    drawing.line(format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="Inter, sans-serif">"#
    ));
    let all = Rect::from_min_size(Pos2::ZERO, SIZE.into());
    drawing.rect(all, ink.background);
    let head = pos2(MARGIN, MARGIN + 8.0);
    drawing.words(head, "start", 17.0, ink.text, &format!("{}: {}", lab.scene_name(), sheet.title));
    drawing.legend(&sheet);
    let room = Rect::from_min_max(pos2(MARGIN, HEAD), all.max - vec2(MARGIN, MARGIN / 2.0));
    for (place, cell) in cells(&sheet, room, LEFT, lab.view().body).iter().enumerate() {
        drawing.plot(lab, &sheet.roster, cell, place);
    }
    drawing.line("</svg>".into());
    Some(drawing.text)
}

struct Svg {
    text: String,
    ink: &'static Ink,
}

impl Svg {
    fn line(&mut self, line: String) {
        self.text.push_str(&line);
        self.text.push('\n');
    }

    fn rect(&mut self, rect: Rect, fill: Color32) {
        let (at, size) = (rect.min, rect.size());
        self.line(format!(
            r#"<rect x="{}" y="{}" width="{}" height="{}" {}/>"#,
            at.x,
            at.y,
            size.x,
            size.y,
            paint("fill", fill)
        ));
    }

    fn words(&mut self, at: Pos2, anchor: &str, size: f32, colour: Color32, words: &str) {
        let words = words.replace('&', "&amp;").replace('<', "&lt;");
        self.line(format!(
            r#"<text x="{:.1}" y="{:.1}" text-anchor="{anchor}" font-size="{size}" {}>{words}</text>"#,
            at.x,
            at.y,
            paint("fill", colour)
        ));
    }

    fn stroke(&mut self, points: &[Pos2], (colour, width): (Color32, f32), [drawn, gap]: [f32; 2]) {
        let mut through = String::new();
        let mut last: Option<Pos2> = None;
        for (i, at) in points.iter().enumerate() {
            let is_end = i + 1 == points.len();
            if is_end || last.is_none_or(|last| last.distance(*at) >= SAME) {
                write!(through, "{:.2},{:.2} ", at.x, at.y).expect("a text takes any line");
                last = Some(*at);
            }
        }
        let dash = match gap > 0.0 {
            true => format!(r#" stroke-dasharray="{drawn} {gap}""#),
            false => String::new(),
        };
        self.line(format!(
            r#"<polyline points="{}" fill="none" stroke-width="{width}" {}{dash}/>"#,
            through.trim_end(),
            paint("stroke", colour),
        ));
    }

    fn legend(&mut self, sheet: &Sheet) {
        let runners =
            sheet.shown().map(|(_, runner)| (&*runner.name, (runner.colour, runner.dash)));
        let has_exact = sheet.plots.iter().any(|plot| !plot.exact.is_empty());
        let exact = (&*sheet.roster.exact, (sheet.roster.exact_colour, [1.0, 0.0]));
        let lines: Vec<_> = runners.chain(has_exact.then_some(exact)).collect();
        let (mut x, y) = (MARGIN, MARGIN + 30.0);
        for (name, (colour, dash)) in lines {
            self.stroke(&[pos2(x, y - 4.0), pos2(x + 30.0, y - 4.0)], (colour, 2.4), dash);
            self.words(pos2(x + 36.0, y), "start", WORDS, self.ink.text, name);
            x += 36.0 + 7.2 * name.chars().count() as f32 + 16.0;
        }
    }

    fn plot(&mut self, lab: &Lab, roster: &Roster, cell: &Cell<'_>, place: usize) {
        let (frame, plot, ink) = (cell.frame, cell.plot, self.ink);
        let bounds = plot.in_view(&lab.view().plot_ranges);
        self.rect(frame, ink.plot);
        let title = pos2(frame.center().x, frame.top() - TITLE / 2.0 + 4.0);
        self.words(title, "middle", WORDS, ink.text, &plot.title);
        if let Some(why) = &plot.nothing {
            return self.words(frame.center(), "middle", WORDS, ink.dim, why);
        }
        self.axes(cell, &bounds);
        let drawing = plot.drawing(lab, roster, &bounds, frame.width());
        self.line(format!(r#"<clipPath id="plot{place}">"#));
        self.rect(frame, ink.plot);
        self.line("</clipPath>".into());
        self.line(format!(r#"<g clip-path="url(#plot{place})" stroke-linejoin="round">"#));
        for Switch { at, colour } in &drawing.switches {
            let at = on_screen(frame, &bounds, *at);
            match drawing.switch_mark {
                SwitchMark::Line => {
                    let ends = [pos2(at.x, frame.top()), pos2(at.x, frame.bottom())];
                    self.stroke(&ends, (*colour, 1.0), [1.0, 0.0]);
                }
                SwitchMark::Ring => {
                    let ring = paint("stroke", *colour);
                    let (x, y) = (at.x, at.y);
                    self.line(format!(
                        r#"<circle cx="{x}" cy="{y}" r="{RING}" fill="none" {ring}/>"#
                    ));
                }
            }
        }
        for Curve { points, colour, width, dash, .. } in drawing.curves.iter().chain(&drawing.truth)
        {
            let points: Vec<Pos2> =
                points.iter().map(|at| on_screen(frame, &bounds, *at)).collect();
            self.stroke(&points, (*colour, *width), *dash);
        }
        for Arrow { from, to, colour } in &drawing.arrows {
            let ends = [from, to].map(|at| on_screen(frame, &bounds, *at));
            if let Some(corners) = arrow_corners(frame, ends) {
                let corners = corners.map(|at| format!("{:.1},{:.1}", at.x, at.y)).join(" ");
                self.line(format!(r#"<polygon points="{corners}" {}/>"#, paint("fill", *colour)));
            }
        }
        self.line("</g>".into());
    }

    fn axes(&mut self, cell: &Cell<'_>, bounds: &PlotBounds) {
        let (frame, plot, ink) = (cell.frame, cell.plot, self.ink);
        let (low, high) = (bounds.min(), bounds.max());
        let grid = (ink.grid, 1.0);
        let [along, up] = &plot.axes;
        let room = f64::from(frame.width());
        for (place, text) in along.scale.marks((low[0], high[0]), room, MARKS_APART[0]) {
            let at = on_screen(frame, bounds, [place, low[1]]);
            self.stroke(&[pos2(at.x, frame.top()), at], grid, [1.0, 0.0]);
            if cell.is_lowest {
                self.words(at + vec2(0.0, 14.0), "middle", NUMBER, ink.dim, &text);
            }
        }
        let room = f64::from(frame.height());
        for (place, text) in up.scale.marks((low[1], high[1]), room, MARKS_APART[1]) {
            let at = on_screen(frame, bounds, [low[0], place]);
            self.stroke(&[at, pos2(frame.right(), at.y)], grid, [1.0, 0.0]);
            self.words(at + vec2(-6.0, 4.0), "end", NUMBER, ink.dim, &text);
        }
        let corner = pos2(frame.left() - LEFT, frame.top() - TITLE / 2.0 + 4.0);
        self.words(corner, "start", WORDS, ink.dim, &up.name());
        if cell.is_lowest {
            let at = pos2(frame.center().x, frame.bottom() + NUMBERS + 12.0);
            self.words(at, "middle", WORDS, ink.dim, &along.name());
        }
    }
}

/// A colour of `attribute`, with its opacity.
fn paint(attribute: &str, colour: Color32) -> String {
    let [r, g, b, a] = colour.to_srgba_unmultiplied();
    let opacity = match a {
        255 => String::new(),
        _ => format!(r#" {attribute}-opacity="{:.2}""#, f32::from(a) / 255.0),
    };
    format!(r##"{attribute}="#{r:02x}{g:02x}{b:02x}"{opacity}"##)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{Command, Instrument, Scene};

    fn race() -> Lab {
        let mut lab = Lab::new(Scene::built_in("harbour").unwrap());
        lab.apply(Command::ToggleRace);
        (0..300).for_each(|_| lab.tick());
        lab
    }

    #[test]
    fn every_value_of_every_curve_is_in_the_table() {
        let mut lab = race();
        for instrument in [Instrument::Motion, Instrument::Error, Instrument::Phase] {
            lab.apply(Command::Instrument(instrument));
            let text = csv(&lab).unwrap().concat();
            let sheet = sheet_of(&lab, Detail::Samples).unwrap();
            let rows = |plot: &super::super::sheet::PlotModel| {
                let lanes: usize = plot.tracks.iter().map(|track| track.places().count()).sum();
                let exact: usize = plot.exact.iter().map(|line| line.times.len()).sum();
                (lanes + exact) * if plot.is_over_time() { 1 } else { 2 }
            };
            assert_eq!(text.lines().count(), 1 + sheet.plots.iter().map(rows).sum::<usize>());
            assert!(text.lines().all(|line| line.split(',').count() == 6), "{instrument:?}");
        }
        lab.apply(Command::Instrument(Instrument::Advice));
        assert!(csv(&lab).is_none() && svg(&lab).is_none());
    }

    #[test]
    fn a_drawing_has_every_curve_and_its_tags_are_closed() {
        let mut lab = race();
        for instrument in Instrument::all() {
            lab.apply(Command::Instrument(instrument));
            let Some(text) = svg(&lab) else { continue };
            let count = |what: &str| text.matches(what).count();
            assert!(count("<polyline") > 10 && !text.contains("NaN"), "{instrument:?}");
            for tag in ["svg", "g", "text", "clipPath"] {
                assert_eq!(count(&format!("<{tag} ")), count(&format!("</{tag}>")), "{tag}");
            }
        }
    }

    #[test]
    fn names_are_quoted_where_they_have_to_be() {
        assert_eq!(quoted("free spring"), "free spring");
        assert_eq!(quoted("a, \"b\""), "\"a, \"\"b\"\"\"");
    }
}
