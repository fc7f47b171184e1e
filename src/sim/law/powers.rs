//! Powers of a map of two numbers, with exponents that need not be whole.

/// Two eigenvalues whose logarithms are closer than this number count as a double eigenvalue, because the difference is
/// rounding.
const SAME: f64 = 1e-7;

/// Powers of a map of two numbers whose eigenvalues are a complex pair, or real and positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Powers {
    /// The logarithm of the square root of the determinant, by which a step scales.
    pub log_scale: f64,
    /// The eigenvalues are exp(log_scale ± apart), or exp(log_scale ± i apart) if the motion swings.
    pub apart: f64,
    /// Whether the eigenvalues are a complex pair.
    pub swings: bool,
}

impl Powers {
    /// Returns the powers of a map with this trace and determinant; `None` if the map loses a part of the motion in one
    /// step, or changes its sign.
    pub fn of(trace: f64, determinant: f64) -> Option<Self> {
        let half = trace / 2.0;
        let square = half * half - determinant;
        if determinant <= 0.0 || square >= 0.0 && half <= 0.0 {
            return None;
        }
        let root = libm::sqrt(square.abs());
        let swings = square < 0.0;
        let apart = if swings { libm::atan2(root, half) } else { libm::atanh(root / half) };
        Some(Self { log_scale: libm::log(determinant) / 2.0, apart, swings })
    }

    /// Returns the numbers e and o with which the power of the map M is e + o (M - ½ trace M) / √(determinant).
    pub fn at(&self, steps: f64) -> [f64; 2] {
        let &Self { log_scale, apart, swings } = self;
        let of = |log: f64| libm::exp(steps * log);
        match apart {
            apart if apart < SAME => [of(log_scale), of(log_scale) * steps],
            apart if swings => {
                let [even, odd] = [libm::cos(steps * apart), libm::sin(steps * apart)];
                [of(log_scale) * even, of(log_scale) * odd / libm::sin(apart)]
            }
            apart => {
                let [slow, fast] = [of(log_scale + apart), of(log_scale - apart)];
                [(slow + fast) / 2.0, (slow - fast) / 2.0 / libm::sinh(apart)]
            }
        }
    }
}
