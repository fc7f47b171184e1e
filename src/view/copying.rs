//! Texts for the clipboard, and the notices about copying them.

use super::panels;
use crate::studio::{Display, DriverRequest, Studio, joint_code};
use crate::tools::source_code::{Precision, source_code};

/// A text for the clipboard.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClipboardText {
    /// The text to copy.
    pub text: String,
    success_notice: String,
    alternative: String,
}

impl ClipboardText {
    /// Notice after the clipboard took the text or refused it for a reason.
    pub fn notice(&self, taken: Result<(), String>) -> String {
        match taken {
            Ok(()) => self.success_notice.clone(),
            Err(reason) => format!("no clipboard: {reason}; {}", self.alternative),
        }
    }
}

/// The text that a request copies; `None` if the request does not copy.
///
/// # Errors
/// The reason why there is nothing to copy.
pub fn clipboard_text(
    studio: &Studio,
    request: DriverRequest,
) -> Option<Result<ClipboardText, String>> {
    let (text, success_notice, alternative) = match request {
        DriverRequest::CopyLink => match studio.deck.link() {
            Ok(run) => {
                let Display { measure, instrument, motion, .. } = studio.display();
                let seen = measure.then(|| format!("&instrument={}", instrument.id()));
                // A tick that the user chose to look at, not one where the run rests by itself.
                let tick = Some(studio.race().tick()).filter(|tick| *tick > 0);
                let tick = tick.filter(|_| !studio.deck.runs_or_rests(*motion));
                let at = tick.map(|tick| format!("&tick={tick}"));
                let link = [Some(run), at, seen].into_iter().flatten().collect::<String>();
                let success_notice =
                    format!("copied the run as a link of {} characters", link.len());
                (link, success_notice, "Ctrl S saves the run, and `regatta link` prints it".into())
            }
            Err(error) => return Some(Err(error.to_string())),
        },
        DriverRequest::CopyInstrument => match panels::csv(studio) {
            Some(lines) => {
                let success_notice = format!("copied {} values as CSV", lines.len() - 1);
                (lines.concat(), success_notice, "Ctrl E saves the values".into())
            }
            None => return Some(Err("this instrument has no values to copy".into())),
        },
        DriverRequest::CopyMethod(entry) => {
            let (language, method) = (studio.viewer.language(), studio.entries()[entry].method);
            match source_code(method, language, Precision::Double) {
                Ok(code) => {
                    let shown = format!("`regatta show {} --as {}`", method.id, language.id());
                    (code, format!("copied {} as {language}", method.name), shown + " prints it")
                }
                Err(refused) => return Some(Err(refused.to_string())),
            }
        }
        DriverRequest::CopyJoint(entry) => {
            let (code, method) = (joint_code(studio, entry)?, studio.entries()[entry].method);
            let success_notice = format!("copied the spring's settings of {}", method.name);
            (code, success_notice, format!("`regatta port --to {}` prints them", method.id))
        }
        _ => return None,
    };
    Some(Ok(ClipboardText { text, success_notice, alternative }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::studio::{StageCommand, ViewCommand};

    #[test]
    fn a_link_has_a_tick_only_if_the_run_is_paused() {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.viewer.preferences.display.measure = false;
        let link = |studio: &Studio| {
            let copied = clipboard_text(studio, DriverRequest::CopyLink).unwrap().unwrap();
            (copied.text.clone(), copied.notice(Ok(())))
        };
        let told = "copied the run as a link of 13 characters".to_owned();
        assert_eq!(link(&studio), ("#scene=spring".to_owned(), told));
        (0..30).for_each(|_| studio.tick());
        assert_eq!(link(&studio).0, "#scene=spring");
        studio.apply(ViewCommand::TogglePause);
        assert_eq!(link(&studio).0, "#scene=spring&tick=30");
        studio.apply(ViewCommand::ToggleMeasure);
        assert_eq!(link(&studio).0, "#scene=spring&tick=30&instrument=motion");
        studio.apply(StageCommand::Pick(1));
        let (changed, _) = link(&studio);
        assert!(changed.starts_with("#v1.") && changed.contains("&tick=30&"), "{changed}");
    }

    #[test]
    fn without_a_clipboard_a_notice_gives_the_reason_and_a_command_instead() {
        let studio = Studio::new(Scene::built_in("spring").unwrap());
        let entry = studio.entries().iter().position(|spec| spec.method.id == "rk4").unwrap();
        let copied = clipboard_text(&studio, DriverRequest::CopyMethod(entry)).unwrap().unwrap();
        assert!(copied.text.contains("fn "), "{}", copied.text);
        let expected = "no clipboard: there is no display; `regatta show rk4 --as rust` prints it";
        assert_eq!(copied.notice(Err("there is no display".into())), expected);
        assert_eq!(copied.notice(Ok(())), "copied Runge-Kutta 4 as Rust");
    }
}
