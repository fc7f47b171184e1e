//! A laid-out chart as an SVG file.

use egui::{Align, Color32, Pos2, Rect, Stroke};

use super::curves::{CurveDrawing, Dots, ScreenCurve, choose_drawing, dots};
use super::primitive::{BEFORE_TAIL, Text};
use super::{Primitive, SCATTERED, text_width};
use crate::lines::Joint;

/// Height of a line of text, relative to its font size.
const LINE: f32 = 1.25;
/// Distance from the top, the middle and the bottom of a line of text down to its baseline, relative to the font
/// size.
const BASELINE: [f32; 3] = [0.95, 0.35, -0.25];

/// Writes a chart as an SVG file of this size in pixels of its own.
pub(crate) fn file([width, height]: [f32; 2], primitives: &[Primitive]) -> String {
    let mut svg = Svg { text: String::new(), clips: 0 };
    svg.line(&format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="Inter, sans-serif">"#
    ));
    svg.add(primitives, Rect::from_min_size(Pos2::ZERO, [width, height].into()));
    svg.line("</svg>");
    svg.text
}

struct Svg {
    text: String,
    clips: usize,
}

impl Svg {
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Adds the part of a chart that lies within `seen`.
    fn add(&mut self, primitives: &[Primitive], seen: Rect) {
        for primitive in primitives {
            match primitive {
                Primitive::Area(rect, fill) => self.rect(rect, &paint("fill", *fill)),
                Primitive::Edge(rect, stroke) => {
                    self.rect(&rect.expand(stroke.width / 2.0), &outline(*stroke));
                }
                Primitive::Line(ends, stroke) => self.line_through(ends, *stroke, ""),
                Primitive::Ring(at, radius, stroke) => self.circle(*at, *radius, &outline(*stroke)),
                Primitive::Dot(at, radius, fill) => {
                    self.circle(*at, *radius, &paint("fill", *fill))
                }
                Primitive::Polygon(corners, fill) => self.polygon(corners, *fill),
                Primitive::Text(text) => self.words(text),
                Primitive::Curves(curves) => {
                    let kinds: Vec<Dots> =
                        curves.iter().map(|curve| self.curve(curve, seen)).collect();
                    for (ScreenCurve { style, points, .. }, kind) in curves.iter().zip(kinds) {
                        for (at, radius) in dots(points, kind) {
                            self.circle(at, radius, &paint("fill", style.colour));
                        }
                    }
                }
                Primitive::Clip(rect, inside) => {
                    let clip = self.clips;
                    self.clips += 1;
                    self.line(&format!(r#"<clipPath id="plot{clip}">"#));
                    self.rect(rect, "");
                    self.line("</clipPath>");
                    self.line(&format!(
                        r#"<g clip-path="url(#plot{clip})" stroke-linejoin="round">"#
                    ));
                    self.add(inside, *rect);
                    self.line("</g>");
                }
            }
        }
    }

    fn rect(&mut self, rect: &Rect, attributes: &str) {
        let (Pos2 { x, y }, size) = (rect.min, rect.size());
        let [width, height] = size.into();
        self.line(&format!(
            r#"<rect x="{x}" y="{y}" width="{width}" height="{height}" {attributes}/>"#
        ));
    }

    fn circle(&mut self, Pos2 { x, y }: Pos2, radius: f32, attributes: &str) {
        self.line(&format!(r#"<circle cx="{x:.2}" cy="{y:.2}" r="{radius}" {attributes}/>"#));
    }

    fn words(&mut self, text: &Text) {
        let Text { at, anchor, size, colour, right, .. } = text;
        let place = |align: Align| align as usize;
        let (side, height) = (place(anchor.x()), place(anchor.y()));
        let (anchor, attributes) = (["start", "middle", "end"][side], paint("fill", *colour));
        let weight = if text.is_strong { r#" font-weight="600""# } else { "" };
        let lines = wrapped(text);
        let (tail, behind) = match &text.tail {
            Some((words, colour)) => {
                let (words, colour) = (escaped(words), paint("fill", *colour));
                let tail = format!(r#"<tspan dx="{BEFORE_TAIL}" {colour}>{words}</tspan>"#);
                (tail, BEFORE_TAIL + text_width(&words, *size))
            }
            None => Default::default(),
        };
        let above = height as f32 / 2.0 * (lines.len() - 1) as f32;
        for (i, line) in lines.iter().enumerate() {
            let end = at.x + (1.0 - side as f32 / 2.0) * (text_width(line, *size) + behind);
            let x = at.x - (end - right).max(0.0);
            let y = at.y + size * (BASELINE[height] + LINE * (i as f32 - above));
            let (line, tail) = (escaped(line), if i + 1 == lines.len() { &*tail } else { "" });
            self.line(&format!(
                r#"<text x="{x:.1}" y="{y:.1}" text-anchor="{anchor}" font-size="{size}"{weight} {attributes}>{line}{tail}</text>"#
            ));
        }
    }

    /// Adds the line or the bands of a curve. Returns which of the curve's points have a dot.
    fn curve(&mut self, curve: &ScreenCurve, seen: Rect) -> Dots {
        let style = curve.style;
        match choose_drawing(curve, (seen, 1.0)) {
            CurveDrawing::Line(runs, [_, 0.0]) => self.runs(&runs, ""),
            CurveDrawing::Line(runs, [drawn, gap]) => {
                self.runs(&runs, &format!(r#" stroke-dasharray="{drawn} {gap}""#));
            }
            CurveDrawing::Bands(bands) => {
                for band in bands {
                    let (corners, fill) = band.outline(style.colour);
                    self.polygon(&corners, fill);
                    self.runs(&band.edges(style.colour, seen), "");
                }
            }
            CurveDrawing::Scattered => return Dots::Each(SCATTERED),
        }
        style.dots
    }

    fn runs(&mut self, runs: &[Vec<Joint>], dash: &str) {
        for run in runs {
            let points: Vec<Pos2> = run.iter().map(|joint| joint.at).collect();
            self.line_through(&points, Stroke::new(2.0 * run[0].radius, run[0].colour), dash);
        }
    }

    fn polygon(&mut self, corners: &[Pos2], fill: Color32) {
        let (corners, fill) = (listed(corners), paint("fill", fill));
        self.line(&format!(r#"<polygon points="{corners}" {fill}/>"#));
    }

    fn line_through(&mut self, points: &[Pos2], stroke: Stroke, dash: &str) {
        let (points, stroke) = (listed(points), outline(stroke));
        self.line(&format!(r#"<polyline points="{points}" {stroke}{dash}/>"#));
    }
}

/// Formats points in the syntax of an SVG attribute.
fn listed(points: &[Pos2]) -> String {
    let points: Vec<_> = points.iter().map(|at| format!("{:.2},{:.2}", at.x, at.y)).collect();
    points.join(" ")
}

fn escaped(words: &str) -> String {
    words.replace('&', "&amp;").replace('<', "&lt;")
}

/// Breaks a text into lines of about its maximum width.
fn wrapped(Text { words, size, wrap, .. }: &Text) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in words.split(' ') {
        let line = lines.last_mut().expect("there is a line");
        if line.is_empty() {
            line.push_str(word);
        } else if text_width(&format!("{line} {word}"), *size) <= *wrap {
            line.extend([" ", word]);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

/// Returns the SVG attributes of a line without fill.
fn outline(stroke: Stroke) -> String {
    format!(r#"fill="none" stroke-width="{}" {}"#, stroke.width, paint("stroke", stroke.color))
}

/// Returns the SVG attributes that set `attribute` to a colour with its opacity.
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
    use egui::{Align2, pos2, vec2};

    use super::*;
    use crate::chart::LineStyle;

    #[test]
    fn a_crowded_curve_becomes_a_band_and_long_text_is_wrapped() {
        let plot = Rect::from_min_size(Pos2::ZERO, vec2(200.0, 100.0));
        let curve = |count: u16| {
            let x = |i: u16| 200.0 * f32::from(i) / f32::from(count);
            let at = |i: u16| pos2(x(i), 50.0 + 40.0 * libm::sinf(f32::from(i)));
            let points = (0..count).map(at).collect();
            let style = LineStyle::solid(Color32::WHITE, 1.5);
            Primitive::Clip(plot, vec![Primitive::Curves(vec![ScreenCurve::new(style, points)])])
        };
        let counted = |primitive: Primitive, what: &str| {
            file([200.0, 100.0], &[primitive]).matches(what).count()
        };
        assert_eq!([20, 2000].map(|count| counted(curve(count), "<polygon")), [0, 1]);
        let words = |wrap: f32| {
            let words = "three words here & now";
            let text = Text::new(plot.center(), Align2::CENTER_CENTER, words, 10.0, Color32::WHITE);
            counted(Text { wrap, ..text }.into(), "<text ")
        };
        assert_eq!([f32::INFINITY, 70.0].map(words), [1, 2]);
    }
}
