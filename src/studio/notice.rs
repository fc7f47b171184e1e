//! A message to the person that disappears by itself.

use std::ops::Deref;

/// Minimum time for which a message is shown, and additional time per letter, in nanoseconds. People need the time to
/// find and to read it.
const MIN_NS: i64 = 3_000_000_000;
const LETTER_NS: i64 = 60_000_000;

/// A message to the person, for example with the name of a screenshot's file. It is shown for some seconds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    text: String,
    parts: Vec<String>,
    left_ns: i64,
    /// Whether no time has passed since the deed. The time before the deed does not count.
    is_new: bool,
    /// Whether the message belongs only to the present tick.
    is_of_tick: bool,
}

impl Notice {
    /// Creates a notice that also disappears at the next tick.
    pub(super) fn of_tick(parts: Vec<String>) -> Self {
        Self { is_of_tick: true, ..parts.into() }
    }

    /// Whether the notice also disappears at the next tick.
    pub(super) fn is_of_tick(&self) -> bool {
        self.is_of_tick
    }

    /// Returns the parts of the notice's text, the most important first.
    pub fn parts(&self) -> &[String] {
        &self.parts
    }

    /// Returns the remaining time for which the notice is shown, in nanoseconds.
    pub fn left_ns(&self) -> i64 {
        self.left_ns
    }

    /// Reduces the remaining time by `ns` nanoseconds, except at the first call.
    pub(super) fn pass_time(&mut self, ns: i64) {
        if !std::mem::take(&mut self.is_new) {
            self.left_ns = self.left_ns.saturating_sub(ns.max(0)).max(0);
        }
    }
}

impl From<Vec<String>> for Notice {
    fn from(parts: Vec<String>) -> Self {
        let text = parts.join("; ");
        let left_ns = MIN_NS + LETTER_NS * text.chars().count() as i64;
        Self { text, parts, left_ns, is_new: true, is_of_tick: false }
    }
}

impl From<String> for Notice {
    fn from(text: String) -> Self {
        vec![text].into()
    }
}

impl From<&str> for Notice {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

impl Deref for Notice {
    type Target = str;

    fn deref(&self) -> &str {
        &self.text
    }
}

#[cfg(test)]
mod tests {
    use super::Notice;
    use crate::Studio;
    use crate::scene::Scene;

    #[test]
    fn a_notice_leaves_after_seconds_and_a_long_one_later_even_when_paused() {
        for is_running in [true, false] {
            let shown_s = |words: &str| {
                let mut studio = Studio::new(Scene::built_in("spring").unwrap());
                studio.deck.running = is_running;
                studio.viewer.set_notice(words);
                let mut frames = 0;
                while studio.viewer.notice.is_some() {
                    studio.advance(70_000_000);
                    studio.viewer.pass_time(if is_running { 0 } else { 70_000_000 });
                    frames += 1;
                }
                assert_eq!(studio.viewer.notice.as_ref().map(Notice::left_ns), None);
                f64::from(frames) * 0.07
            };
            let [short, long] = [shown_s("saved"), shown_s(&"word ".repeat(20))];
            assert!((3.0..4.0).contains(&short) && (8.0..10.0).contains(&long), "{short} {long}");
        }
    }
}
