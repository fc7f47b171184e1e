//! The table of ideal loops.

use std::sync::LazyLock;

use super::engines::{card, claim};
use super::policy::{PolicyCard, Snippet};
use crate::sim::law::LoopText;

/// Lists the loops, each with its file in `assets/loops` and its snippets, one per language.
macro_rules! policies {
    ($($id:literal: $($language:literal $ending:literal),+;)+) => {
        [$((
            $id,
            include_str!(concat!("../../assets/loops/", $id, ".loop")),
            &[$(Snippet {
                language: $language,
                source: include_str!(concat!("../../assets/loops/", $id, ".", $ending)),
            }),+] as &[Snippet],
        )),+]
    };
}

/// Every ideal loop, with the simplest first. The ten with a digit key come first.
pub static POLICIES: LazyLock<Vec<PolicyCard>> = LazyLock::new(|| {
    let files = policies![
        "variable": "rust" "rs", "c++" "hpp", "c#" "cs";
        "lockstep": "rust" "rs";
        "clamped-variable": "rust" "rs", "c++" "hpp", "c#" "cs";
        "semi-fixed": "rust" "rs", "c++" "hpp", "c#" "cs";
        "fixed": "rust" "rs", "c++" "hpp", "c#" "cs";
        "fixed-linear": "rust" "rs", "c++" "hpp", "c#" "cs";
        "fixed-hermite": "rust" "rs", "c++" "hpp";
        "fixed-extrapolated": "rust" "rs", "c++" "hpp", "c#" "cs";
        "render-tick": "rust" "rs", "c++" "hpp", "c#" "cs";
        "whole-refresh": "rust" "rs", "c++" "hpp", "c#" "cs";
        "snapped": "rust" "rs";
        "hysteresis": "rust" "rs";
        "median": "rust" "rs";
        "slow-down": "rust" "rs", "c++" "hpp";
    ];
    let ideal = |(id, text, snippets)| PolicyCard {
        constants: claim(text, "constants"),
        engine: None,
        snippets,
        ..card(id, text, LoopText::read(text).expect("a file that the tests read"))
    };
    files.into_iter().map(ideal).collect()
});

/// Returns the policy with this id.
pub fn policy(id: &str) -> Option<&'static PolicyCard> {
    POLICIES.iter().find(|card| card.id == id)
}

#[cfg(test)]
mod tests;
