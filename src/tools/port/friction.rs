//! A velocity that keeps a fraction of itself in each frame, with its equivalents at other frame rates and as a drag.

use super::follow::FRAME_RATES;

/// The rule `v *= kept`, once a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// Fraction of the velocity that is kept in each frame, between 0 and 1.
    pub kept: f64,
    /// Frames per second.
    pub fps: f64,
}

impl Friction {
    /// Returns the drag C of v′ = -C v, per second.
    pub fn rate(&self) -> f64 {
        -libm::log(self.kept) * self.fps
    }

    /// Returns the time in which the velocity halves, in seconds.
    pub fn half_life_s(&self) -> f64 {
        std::f64::consts::LN_2 / self.rate()
    }

    /// Returns pairs of the frames per second and the fraction kept in a frame, at the usual frame rates and at the
    /// rule's own.
    pub fn kept_at(&self) -> Vec<(f64, f64)> {
        let mut rates: Vec<f64> = FRAME_RATES.into_iter().chain([self.fps]).collect();
        rates.sort_by(f64::total_cmp);
        rates.dedup();
        rates.into_iter().map(|fps| (fps, libm::exp(-self.rate() / fps))).collect()
    }

    /// Returns C of `v -= C * v * dt` and C of `v /= 1 + C * dt` that keep the same fraction in a frame, per second.
    pub fn drags(&self) -> [f64; 2] {
        [(1.0 - self.kept) * self.fps, (1.0 / self.kept - 1.0) * self.fps]
    }

    /// Returns the distance that a body coasts for each m/s of its velocity, in metres. It is given exactly, for frames
    /// that move after the friction, and for frames that move before it.
    pub fn coasts_m(&self) -> [f64; 3] {
        let gone = 1.0 / (1.0 - self.kept) / self.fps;
        [1.0 / self.rate(), self.kept * gone, gone]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_loses_and_coasts_equally_at_every_frame_rate() {
        let friction = Friction { kept: 0.9, fps: 60.0 };
        let in_a_second = libm::pow(0.9, 60.0);
        for (fps, kept) in friction.kept_at() {
            assert!((libm::pow(kept, fps) / in_a_second - 1.0).abs() < 1e-12, "{fps}");
        }
        assert!((friction.half_life_s() - 0.1096).abs() < 1e-4);
        let [explicit, implicit] = friction.drags();
        assert!((1.0 - explicit / 60.0 - 0.9).abs() < 1e-12);
        assert!((1.0 / (1.0 + implicit / 60.0) - 0.9).abs() < 1e-12);
        let (mut v, mut after, mut before) = (1.0, 0.0, 0.0);
        for _ in 0..1000 {
            before += v / 60.0;
            v *= 0.9;
            after += v / 60.0;
        }
        let [exact, of_after, of_before] = friction.coasts_m();
        assert!((of_after - after).abs() < 1e-12 && (of_before - before).abs() < 1e-12);
        assert!(of_after < exact && exact < of_before);
    }
}
