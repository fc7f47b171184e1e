//! The table of ideal loops.

use std::sync::{Arc, LazyLock};

use super::engines::card;
use super::policy::PolicyCard;
use crate::sim::law::LoopText;

/// Lists the loops, each with its file in `assets/loops`.
macro_rules! policies {
    ($($id:literal),+ $(,)?) => {
        [$(($id, include_str!(concat!("../../assets/loops/", $id, ".loop")))),+]
    };
}

/// Every ideal loop, with the simplest first. The ten with a digit key come first.
pub static POLICIES: LazyLock<Vec<Arc<PolicyCard>>> = LazyLock::new(|| {
    let files = policies![
        "variable",
        "lockstep",
        "clamped-variable",
        "semi-fixed",
        "fixed",
        "fixed-linear",
        "fixed-hermite",
        "fixed-extrapolated",
        "render-tick",
        "whole-refresh",
        "snapped",
        "hysteresis",
        "median",
        "slow-down",
    ];
    let ideal = |(id, text)| {
        Arc::new(PolicyCard {
            constants: LoopText::claim(text, "constants").to_owned(),
            engine: None,
            ..card(id, text, LoopText::read(text).expect("a file that the tests read"))
        })
    };
    files.into_iter().map(ideal).collect()
});

/// Returns the policy with this id.
pub fn policy(id: &str) -> Option<&'static Arc<PolicyCard>> {
    POLICIES.iter().find(|card| card.id == id)
}

#[cfg(test)]
mod tests;
