//! Things of familiar size, from a person to the observable universe. They mark the way of a body that runs away.

use SilhouetteShape::{Disc, Outline, Ring};

/// A thing of familiar size.
pub struct Landmark {
    /// Name in the singular with its article, and name in the plural.
    pub names: [&'static str; 2],
    /// Length in metres, and the same length as text.
    pub length_m: f64,
    /// The length as text.
    pub length: &'static str,
    /// Shapes of the silhouette.
    pub silhouette: &'static [SilhouetteShape],
}

/// A part of a silhouette. The unit is the length of the whole thing; x counts from its left end, and y upwards from
/// its middle.
pub enum SilhouetteShape {
    /// A filled circle with this centre and radius.
    Disc([f32; 2], f32),
    /// An ellipse's line with this centre, and these radii across and up.
    Ring([f32; 2], [f32; 2]),
    /// A filled polygon with these corners, all of which are visible from their mean.
    Outline(&'static [[f32; 2]]),
}

impl Landmark {
    /// Returns the largest extent of the silhouette up or down from its middle, relative to the thing's length.
    pub fn half_height(&self) -> f32 {
        let highest = |part: &SilhouetteShape| match part {
            Disc([_, y], radius) | Ring([_, y], [_, radius]) => y.abs() + radius,
            Outline(corners) => corners.iter().fold(0.0, |most, [_, y]| y.abs().max(most)),
        };
        self.silhouette.iter().map(highest).fold(0.0, f32::max)
    }
}

const fn known(
    names: [&'static str; 2],
    length_m: f64,
    length: &'static str,
    silhouette: &'static [SilhouetteShape],
) -> Landmark {
    Landmark { names, length_m, length, silhouette }
}

/// All landmarks, from small to large. The court has the size that the rules demand, and the jet is a Boeing 747-400.
/// The tower has its height since 2022, the ship is among the longest of its kind, the island is measured along its
/// longest street, and Chile from north to south. The way to the Moon is its mean distance; the sizes of the Sun, of
/// the way to it (1 au) and of the light year are those of the IAU. The orbit is twice 30.07 au wide, the Galaxy
/// 100 000 light years and the observable universe 93 billion.
#[rustfmt::skip]
pub static LANDMARKS: [Landmark; 16] = [
    known(["a person", "people"], 1.75, "1.75 m", &[
        Disc([0.07, 0.0], 0.065),
        Outline(&[[0.15, 0.11], [0.3, 0.12], [0.55, 0.08], [0.55, -0.08], [0.3, -0.12],
            [0.15, -0.11]]),
        Outline(&[[0.53, 0.09], [1.0, 0.07], [1.0, 0.015], [0.53, 0.005]]),
        Outline(&[[0.53, -0.09], [1.0, -0.07], [1.0, -0.015], [0.53, -0.005]]),
    ]),
    known(["our ship", "of our ships"], 9.0, "9 m", &[
        Outline(&[[0.0, 0.09], [0.1, 0.145], [0.55, 0.145], [0.8, 0.09], [1.0, 0.0], [0.8, -0.09],
            [0.55, -0.145], [0.1, -0.145], [0.0, -0.09]]),
        Outline(&[[0.05, 0.06], [0.11, 0.1], [0.55, 0.1], [0.78, 0.055], [0.88, 0.0],
            [0.78, -0.055], [0.55, -0.1], [0.11, -0.1], [0.05, -0.06]]),
        Outline(&[[0.14, 0.08], [0.38, 0.08], [0.38, -0.08], [0.14, -0.08]]),
        Outline(&[[0.36, 0.085], [0.41, 0.085], [0.41, -0.085], [0.36, -0.085]]),
        Outline(&[[0.5, 0.045], [0.59, 0.045], [0.59, -0.045], [0.5, -0.045]]),
        Outline(&[[0.62, 0.045], [0.71, 0.045], [0.71, -0.045], [0.62, -0.045]]),
    ]),
    known(["a tennis court", "tennis courts"], 23.77, "23.8 m", &[
        Outline(&[[0.0, 0.23], [1.0, 0.23], [1.0, -0.23], [0.0, -0.23]]),
        Outline(&[[0.0, 0.18], [1.0, 0.18], [1.0, 0.165], [0.0, 0.165]]),
        Outline(&[[0.0, -0.18], [1.0, -0.18], [1.0, -0.165], [0.0, -0.165]]),
        Outline(&[[0.495, 0.26], [0.505, 0.26], [0.505, -0.26], [0.495, -0.26]]),
        Outline(&[[0.23, 0.165], [0.24, 0.165], [0.24, -0.165], [0.23, -0.165]]),
        Outline(&[[0.76, 0.165], [0.77, 0.165], [0.77, -0.165], [0.76, -0.165]]),
    ]),
    known(["a jumbo jet", "jumbo jets"], 70.7, "70.7 m", &[
        Outline(&[[0.0, 0.015], [0.15, 0.045], [0.9, 0.045], [0.97, 0.025], [1.0, 0.0],
            [0.97, -0.025], [0.9, -0.045], [0.15, -0.045], [0.0, -0.015]]),
        Outline(&[[0.66, 0.04], [0.5, 0.04], [0.28, 0.45], [0.33, 0.45]]),
        Outline(&[[0.66, -0.04], [0.5, -0.04], [0.28, -0.45], [0.33, -0.45]]),
        Outline(&[[0.16, 0.03], [0.05, 0.03], [0.0, 0.15], [0.05, 0.15]]),
        Outline(&[[0.16, -0.03], [0.05, -0.03], [0.0, -0.15], [0.05, -0.15]]),
    ]),
    known(["the Eiffel Tower", "Eiffel Towers"], 330.0, "330 m", &[
        Outline(&[[0.0, 0.004], [0.5, 0.035], [0.8, 0.075], [0.8, -0.075], [0.5, -0.035],
            [0.0, -0.004]]),
        Outline(&[[0.8, 0.075], [1.0, 0.17], [1.0, 0.11], [0.8, 0.03]]),
        Outline(&[[0.8, -0.075], [1.0, -0.17], [1.0, -0.11], [0.8, -0.03]]),
    ]),
    known(["a container ship", "container ships"], 400.0, "400 m", &[
        Outline(&[[0.0, 0.01], [1.0, 0.025], [0.95, -0.065], [0.03, -0.065]]),
        Outline(&[[0.07, 0.01], [0.12, 0.01], [0.12, 0.12], [0.07, 0.12]]),
        Outline(&[[0.15, 0.01], [0.36, 0.01], [0.36, 0.06], [0.15, 0.06]]),
        Outline(&[[0.37, 0.01], [0.58, 0.01], [0.58, 0.075], [0.37, 0.075]]),
        Outline(&[[0.59, 0.015], [0.88, 0.015], [0.88, 0.06], [0.59, 0.06]]),
    ]),
    known(["Manhattan", "Manhattans"], 21.6e3, "21.6 km", &[
        Outline(&[[0.0, 0.0], [0.05, 0.04], [0.3, 0.08], [0.55, 0.075], [0.75, 0.045],
            [1.0, 0.015], [1.0, -0.015], [0.8, -0.03], [0.6, -0.065], [0.3, -0.075], [0.06, -0.05]]),
    ]),
    known(["Chile", "Chiles"], 4.27e6, "4270 km", &[
        Outline(&[[0.0, 0.02], [0.2, 0.012], [0.5, 0.018], [0.8, 0.022], [0.93, 0.035], [1.0, 0.0],
            [0.93, -0.04], [0.8, -0.025], [0.5, -0.02], [0.2, -0.015]]),
    ]),
    known(["the Earth", "Earths"], 1.2742e7, "12 742 km", &[Disc([0.5, 0.0], 0.5)]),
    known(["the way to the Moon", "ways to the Moon"], 3.844e8, "384 000 km", &[
        Disc([0.02, 0.0], 0.02), Disc([0.9945, 0.0], 0.0055),
        Outline(&[[0.04, 0.002], [0.989, 0.002], [0.989, -0.002], [0.04, -0.002]]),
    ]),
    known(["the Sun", "Suns"], 1.3914e9, "1.39 million km", &[
        Disc([0.5, 0.0], 0.46), Ring([0.5, 0.0], [0.5, 0.5]),
    ]),
    known(["the way to the Sun", "ways to the Sun"], 1.495_978_707e11, "150 million km", &[
        Disc([0.004, 0.0], 0.004), Disc([0.98, 0.0], 0.02),
        Outline(&[[0.008, 0.002], [0.96, 0.002], [0.96, -0.002], [0.008, -0.002]]),
    ]),
    known(["Neptune's orbit", "orbits of Neptune"], 9e12, "9 billion km", &[
        Ring([0.5, 0.0], [0.5, 0.11]), Disc([0.5, 0.0], 0.012),
    ]),
    known(["a light year", "light years"], 9.4607e15, "9.46·10¹⁵ m", &[
        Outline(&[[0.0, 0.006], [0.9, 0.006], [0.9, -0.006], [0.0, -0.006]]),
        Outline(&[[0.9, 0.03], [1.0, 0.0], [0.9, -0.03]]),
    ]),
    known(["the Galaxy", "Galaxies"], 9.5e20, "100 000 light years", &[
        Outline(&[[0.0, 0.0], [0.25, 0.022], [0.5, 0.028], [0.75, 0.022], [1.0, 0.0],
            [0.75, -0.022], [0.5, -0.028], [0.25, -0.022]]),
        Disc([0.5, 0.0], 0.065),
    ]),
    known(["the observable universe", "observable universes"], 8.8e26, "93 billion light years", &[
        Ring([0.5, 0.0], [0.5, 0.11]), Ring([0.5, 0.0], [0.33, 0.07]), Ring([0.5, 0.0], [0.16, 0.035]),
        Disc([0.5, 0.0], 0.01),
    ]),
];

/// Two landmarks count as one if they are fewer powers of ten apart than this.
const LEAST_DECADES: f64 = 0.3;

/// Returns the powers of ten between the last landmark below this width in metres and the next one; infinity beyond the
/// last landmark.
pub fn decades_to_next(width_m: f64) -> f64 {
    let next = LANDMARKS.iter().position(|landmark| landmark.length_m > width_m);
    let Some(next) = next else { return f64::INFINITY };
    let [from, to] = [next.max(1) - 1, next.max(1)].map(|index| LANDMARKS[index].length_m);
    libm::log10(to / from).max(LEAST_DECADES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn landmarks_fit_their_length_and_are_sorted_by_it() {
        assert!(LANDMARKS.is_sorted_by_key(|landmark| landmark.length_m));
        for landmark in &LANDMARKS {
            let is_within = landmark.silhouette.iter().all(|part| match part {
                Disc([x, _], radius) | Ring([x, _], [radius, _]) => {
                    x - radius >= 0.0 && x + radius <= 1.0
                }
                Outline(at) => at.len() > 2 && at.iter().all(|[x, _]| (0.0..=1.0).contains(x)),
            });
            assert!(is_within && landmark.half_height() <= 0.5, "{}", landmark.names[0]);
        }
    }
}
