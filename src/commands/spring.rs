//! A custom spring on the command line, in the place of a scene.

use clap::Args;

use super::error::Error;
use super::numbers::{number, positive};
use crate::lab::Scene;
use crate::lab::studio::MySpring;

/// The options that describe a spring.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(super) struct SpringArgs {
    /// In the place of a scene, a spring of this stiffness in N/m; with --c and --mass
    #[arg(long, value_name = "N/M", value_parser = positive, allow_negative_numbers = true)]
    #[arg(group = "spring")]
    k: Option<f64>,

    /// The damping of that spring in N s/m [default: 0]
    #[arg(long, value_name = "N S/M", value_parser = number, allow_negative_numbers = true)]
    #[arg(requires = "k")]
    c: Option<f64>,

    /// In the place of a scene, a spring that swings at this frequency in Hz; with --damping-ratio
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    #[arg(group = "spring")]
    frequency: Option<f64>,

    /// The damping of that spring, 1 where it just swings no more [default: 0]
    #[arg(long, value_name = "RATIO", value_parser = number, allow_negative_numbers = true)]
    #[arg(requires = "frequency")]
    damping_ratio: Option<f64>,

    /// The mass on the spring of --k or --frequency in kg [default: 1]
    #[arg(long, value_name = "KG", value_parser = positive, allow_negative_numbers = true)]
    #[arg(requires = "spring")]
    mass: Option<f64>,
}

/// The tick rate in Hz of a spring for which none is given: the usual one of games.
const USUAL_TICK_HZ: u32 = 60;

impl SpringArgs {
    /// Whether a spring is described.
    pub(super) fn is_given(&self) -> bool {
        self.k.is_some() || self.frequency.is_some()
    }

    /// The spring's scene and its text, if a spring is described.
    ///
    /// # Errors
    /// If a scene may not have its numbers.
    pub(super) fn load(&self) -> Result<Option<(Scene, String)>, Error> {
        let mass_kg = self.mass.unwrap_or(1.0);
        let by_stiffness = self.k.map(|stiffness_n_per_m| MySpring {
            mass_kg,
            stiffness_n_per_m,
            damping_n_s_per_m: self.c.unwrap_or(0.0),
        });
        let by_frequency = || {
            let ratio = self.damping_ratio.unwrap_or(0.0);
            Some(MySpring::of_frequency(mass_kg, self.frequency?, ratio))
        };
        let Some(spring) = by_stiffness.or_else(by_frequency) else { return Ok(None) };
        Ok(Some((spring.scene(USUAL_TICK_HZ)?, spring.scene_text(USUAL_TICK_HZ))))
    }
}
