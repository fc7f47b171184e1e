//! A spring that is described on the command line, in place of a scene.

use clap::Args;

use super::argument::{frequency, number, positive};
use super::error::Error;
use crate::scene::Scene;
use crate::studio::MySpring;

/// The options that describe a spring.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(super) struct SpringArgs {
    /// A spring of this stiffness in place of a scene
    #[arg(long, value_name = "N/m", value_parser = positive, allow_negative_numbers = true)]
    #[arg(group = "spring")]
    k: Option<f64>,

    /// The damping of the spring of --k [default: 0]
    #[arg(long, value_name = "N s/m", value_parser = number, allow_negative_numbers = true)]
    #[arg(requires = "k", conflicts_with_all = ["frequency", "scene"])]
    c: Option<f64>,

    /// A spring of this frequency in place of a scene
    #[arg(long, value_name = "Hz", value_parser = frequency, allow_hyphen_values = true)]
    #[arg(group = "spring")]
    frequency: Option<f64>,

    /// The damping of that spring [default: 0]
    ///
    /// At 1 it is critically damped and no longer swings.
    #[arg(long, value_name = "RATIO", value_parser = number, allow_negative_numbers = true)]
    #[arg(requires = "frequency", conflicts_with_all = ["k", "scene"])]
    damping_ratio: Option<f64>,

    /// The mass on the spring [default: 1]
    #[arg(long, value_name = "kg", value_parser = positive, allow_negative_numbers = true)]
    #[arg(requires = "spring", conflicts_with = "scene")]
    mass: Option<f64>,
}

/// Default tick rate of a spring, in Hz. It is the usual one of games.
const USUAL_TICK_HZ: u32 = 60;

impl SpringArgs {
    /// Whether the options describe a spring.
    pub(super) fn is_given(&self) -> bool {
        self.k.is_some() || self.frequency.is_some()
    }

    /// Returns the scene of the spring and its text, or `None` if the options describe no spring.
    ///
    /// # Errors
    /// If a scene may not have the numbers.
    pub(super) fn load(&self) -> Result<Option<(Scene, String)>, Error> {
        let mass_kg = self.mass.unwrap_or(1.0);
        let by_stiffness = self.k.map(|stiffness_n_per_m| MySpring {
            mass_kg,
            stiffness_n_per_m,
            damping_n_s_per_m: self.c.unwrap_or(0.0),
            ..MySpring::default()
        });
        let by_frequency = || {
            let ratio = self.damping_ratio.unwrap_or(0.0);
            Some(MySpring::of_frequency(mass_kg, self.frequency?, ratio))
        };
        let Some(spring) = by_stiffness.or_else(by_frequency) else { return Ok(None) };
        Ok(Some((spring.scene(USUAL_TICK_HZ)?, spring.scene_text(USUAL_TICK_HZ))))
    }
}
