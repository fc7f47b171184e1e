//! A ship from above: a hull with a deck, hatches and a house.

use std::f32::consts::FRAC_PI_2;
use std::sync::LazyLock;

use super::breakpoints;
use super::sketch::{Camera, Pen, rounded};
use crate::look::palette::{BLACK, Palette, Rgba, WHITE, fade, mix};
use crate::scene::{Mark, Outline};

/// Planks of the deck, in the light and in the shade.
const DECK: [Rgba; 2] = [[236, 220, 184, 255], [206, 186, 146, 255]];
const HATCH: Rgba = [138, 160, 112, 255];
/// Beam of a ship relative to its length.
pub(super) const BEAM: f32 = 0.26;

/// Place and direction of a ship, in points.
#[derive(Clone, Copy)]
pub(super) struct ShipPose {
    pub(super) at: [f32; 2],
    /// Unit vector towards the bow, y down.
    pub(super) bow: [f32; 2],
    pub(super) length: f32,
}

/// Places along a hull from its stern, and half its width there, in lengths of the ship.
static WIDTHS: LazyLock<[[f32; 2]; 23]> = LazyLock::new(|| {
    std::array::from_fn(|i| {
        let part = i as f32 / 22.0;
        let stern = (part / 0.1).min(1.0);
        let bow = ((part - 0.5) / 0.5).max(0.0);
        let fullness = libm::powf(libm::sinf(stern * FRAC_PI_2), 0.5);
        let stern = BEAM / 2.0 * (0.55 + 0.45 * fullness) * fullness.max(0.4);
        [part, stern * (1.0 - libm::powf(bow, 2.1))]
    })
});

/// Half the height of a ship in points; 0 for a body without a hull.
pub(super) fn half_height(outline: &Outline, camera: &Camera) -> f32 {
    let of_hull = |mark: &Mark| match *mark {
        Mark::Hull { bow, length } => {
            let height = bow.y.abs() + f64::from(BEAM) * bow.x.abs();
            Some(camera.size(length * height / 2.0))
        }
        _ => None,
    };
    outline.marks.iter().find_map(of_hull).unwrap_or(0.0)
}

impl ShipPose {
    /// A place on the ship, ahead of its middle and to starboard, in lengths.
    fn place(self, ahead: f32, aside: f32) -> [f32; 2] {
        let [bx, by] = self.bow;
        let (ahead, aside) = (ahead * self.length, aside * self.length);
        [self.at[0] + ahead * bx - aside * by, self.at[1] + ahead * by + aside * bx]
    }

    /// Corners of the hull, inset by this many points.
    pub(super) fn hull(self, inset: f32) -> Vec<[f32; 2]> {
        let inset = inset / self.length;
        let side = |sign: f32| {
            WIDTHS.iter().map(move |[part, width]| {
                let ahead = (part - 0.5) * (1.0 - 2.0 * inset);
                (ahead, sign * (width - inset).max(0.0))
            })
        };
        let corners = side(-1.0).chain(side(1.0).rev());
        corners.map(|(ahead, aside)| self.place(ahead, aside)).collect()
    }

    fn block(self, (from, to): (f32, f32), half: f32, radius: f32) -> Vec<[f32; 2]> {
        let corners = rounded([from, -half], [to, half], radius);
        corners.into_iter().map(|[ahead, aside]| self.place(ahead, aside)).collect()
    }
}

/// Draws the ship.
pub(super) fn ship(pen: &mut Pen<'_>, pose: ShipPose, colour: Rgba, palette: &Palette) {
    let part = (pose.length / 150.0).clamp(0.2, 2.0);
    // Water that the bow throws aside.
    for (out, alpha) in [(7.0, 0.16), (3.5, 0.28)] {
        let crest: Vec<[f32; 2]> = pose.hull(-out * part);
        let bow = crest.len() / 2;
        let reach = crest.len() / 5;
        pen.path(
            crest[bow - reach..bow + reach].iter().copied(),
            3.0 * part,
            fade(palette.chart, 2.0 * alpha),
        );
    }
    let shadow = ShipPose { at: [pose.at[0] + 2.0 * part, pose.at[1] + 4.0 * part], ..pose };
    pen.fill(&shadow.hull(-2.0 * part), fade(BLACK, 0.22));
    let hull = pose.hull(0.0);
    pen.fill(&hull, mix(colour, BLACK, 0.08));
    pen.ring(&hull, (1.6 * part).max(0.8), mix(colour, BLACK, 0.5));
    if pose.length < breakpoints::DECK {
        return;
    }
    let deck = pose.hull(5.5 * part);
    let plank = |[_, y]: [f32; 2]| {
        let low = (y - pose.at[1]) / (BEAM * pose.length) + 0.5;
        mix(DECK[0], DECK[1], low)
    };
    pen.shaded(&deck, plank);
    if pose.length >= breakpoints::PLANKS {
        planks(pen, pose, &deck);
    }
    let house = pose.block((-0.36, -0.1), 0.078, 0.02);
    pen.fill(&pose.block((-0.35, -0.075), 0.085, 0.02), fade(BLACK, 0.25));
    pen.fill(&house, [222, 230, 236, 255]);
    pen.ring(&house, 1.2 * part, [70, 84, 98, 255]);
    let bridge = pose.block((-0.13, -0.085), 0.092, 0.012);
    pen.fill(&bridge, [96, 122, 144, 255]);
    pen.ring(&bridge, 1.0 * part, [40, 52, 64, 255]);
    let funnel = pose.place(-0.26, 0.0);
    pen.disc(funnel, 0.045 * pose.length, [36, 44, 54, 255]);
    pen.disc(funnel, 0.034 * pose.length, colour);
    pen.disc(funnel, 0.015 * pose.length, [20, 24, 30, 255]);
    let stem = [pose.place(0.33, 0.0), pose.place(0.45, 0.0)];
    pen.line(stem[0], stem[1], 1.2 * part, fade(WHITE, 0.6));
}

/// Draws the seams of the deck, its rail and its hatches.
fn planks(pen: &mut Pen<'_>, pose: ShipPose, deck: &[[f32; 2]]) {
    let part = (pose.length / 150.0).clamp(0.2, 2.0);
    for seam in -4..=4_i8 {
        let aside = f32::from(seam) * 0.022;
        let ends = 0.42 - 0.06 * libm::fabsf(f32::from(seam)) - 0.02;
        let ends = (-0.43, ends.max(0.1));
        let seam = [pose.place(ends.0, aside), pose.place(ends.1, aside)];
        pen.line(seam[0], seam[1], 0.6 * part, fade(BLACK, 0.16));
    }
    pen.ring(deck, 1.0 * part, fade(BLACK, 0.35));
    for from in [0.03, 0.135] {
        let hatch = pose.block((from, from + 0.085), 0.05, 0.008);
        pen.fill(&hatch, HATCH);
        pen.ring(&hatch, 1.0 * part, mix(HATCH, BLACK, 0.5));
    }
}
