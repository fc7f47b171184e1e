//! A laid-out chart as an SVG file.

use std::fmt::Write;

use egui::{Align, Color32, Pos2, Rect, Stroke};

use super::Primitive;
use super::curves::{LineStyle, ScreenCurve, dots};
use super::primitive::Text;

/// Points of a curve closer than this, in pixels, are one.
const SAME: f32 = 0.2;
/// How far below the top and the middle of a line of text its letters stand, in parts of their size.
const BASELINE: [f32; 3] = [0.95, 0.35, -0.25];

/// The file, of this size in its own pixels.
pub(in crate::view) fn file([width, height]: [f32; 2], primitives: &[Primitive]) -> String {
    let mut svg = Svg { text: String::new(), clips: 0 };
    svg.line(&format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="Inter, sans-serif">"#
    ));
    svg.add(primitives);
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

    fn add(&mut self, primitives: &[Primitive]) {
        for primitive in primitives {
            match primitive {
                Primitive::Area(rect, fill) => self.rect(rect, &paint("fill", *fill)),
                Primitive::Edge(rect, stroke) => {
                    self.rect(&rect.expand(stroke.width / 2.0), &outline(*stroke));
                }
                Primitive::Line(ends, Stroke { width, color }) => {
                    self.curve(ends, LineStyle::solid(*color, *width));
                }
                Primitive::Ring(at, radius, stroke) => self.circle(*at, *radius, &outline(*stroke)),
                Primitive::Polygon(corners, fill) => {
                    let corners: Vec<_> =
                        corners.iter().map(|at| format!("{:.1},{:.1}", at.x, at.y)).collect();
                    let corners = corners.join(" ");
                    self.line(&format!(
                        r#"<polygon points="{corners}" {}/>"#,
                        paint("fill", *fill)
                    ));
                }
                Primitive::Text(text) => self.words(text),
                Primitive::Curves(curves) => {
                    for ScreenCurve { style, points, .. } in curves {
                        self.curve(points, *style);
                    }
                    for ScreenCurve { style, points, .. } in curves {
                        for (at, radius) in dots(points, style.dots) {
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
                    self.add(inside);
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

    fn words(&mut self, Text { at, anchor, words, size, colour, .. }: &Text) {
        let words = words.replace('&', "&amp;").replace('<', "&lt;");
        let place = |align: Align| align as usize;
        let side = ["start", "middle", "end"][place(anchor.x())];
        let y = at.y + size * BASELINE[place(anchor.y())];
        self.line(&format!(
            r#"<text x="{:.1}" y="{y:.1}" text-anchor="{side}" font-size="{size}" {}>{words}</text>"#,
            at.x,
            paint("fill", *colour)
        ));
    }

    fn curve(&mut self, points: &[Pos2], style: LineStyle) {
        let mut through = String::new();
        let mut last: Option<Pos2> = None;
        for (i, at) in points.iter().enumerate() {
            let is_end = i + 1 == points.len();
            if is_end || last.is_none_or(|last| last.distance(*at) >= SAME) {
                write!(through, "{:.2},{:.2} ", at.x, at.y).expect("a text takes any line");
                last = Some(*at);
            }
        }
        let LineStyle { colour, width, dash: [drawn, gap], .. } = style;
        let dash = match gap > 0.0 {
            true => format!(r#" stroke-dasharray="{drawn} {gap}""#),
            false => String::new(),
        };
        let stroke = outline(Stroke::new(width, colour));
        self.line(&format!(r#"<polyline points="{}" {stroke}{dash}/>"#, through.trim_end()));
    }
}

/// The attributes of a line that fills nothing.
fn outline(stroke: Stroke) -> String {
    format!(r#"fill="none" stroke-width="{}" {}"#, stroke.width, paint("stroke", stroke.color))
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
