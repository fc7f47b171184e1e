//! What the address of a page asks for after its `#`: a run, and how it is shown.

use regatta::lab::palette::Theme;
use regatta::lab::studio::Instrument;
use regatta::lab::{Scene, link};

/// What was asked for.
#[derive(Debug, Default)]
pub(crate) struct Address {
    /// The run of a link, or why the link leads to none.
    pub(crate) run: Option<Result<Scene, String>>,
    /// Whether the stage and the digits of its methods are to stand on another's page.
    pub(crate) is_embedded: bool,
    /// Whether time runs from the start where it would not by itself.
    pub(crate) plays: bool,
    pub(crate) theme: Option<Theme>,
    /// The tick to go to.
    pub(crate) tick: Option<u64>,
    pub(crate) instrument: Option<Instrument>,
}

impl Address {
    /// Reads a fragment, with its `#`. A setting that is not known is of a newer page, and is ignored.
    pub(crate) fn of(fragment: &str) -> Self {
        let mut address = Self::default();
        let mut settings = fragment.trim_start_matches('#').split('&');
        for setting in settings.clone() {
            match setting.split_once('=').unwrap_or((setting, "")) {
                ("panels", "off") => address.is_embedded = true,
                ("play", _) => address.plays = true,
                ("theme", "light") => address.theme = Some(Theme::Light),
                ("theme", "dark") => address.theme = Some(Theme::Dark),
                ("tick", tick) => address.tick = tick.parse().ok(),
                ("instrument", id) => address.instrument = Instrument::of_id(id),
                _ => {}
            }
        }
        let run = settings.next().filter(|first| first.starts_with('v') && !first.contains('='));
        address.run = run.map(|run| scene_of(&format!("#{run}")));
        address
    }

    /// Whether time runs at the start: a stage on another's page, and a tick that was asked for, wait until they are told.
    pub(crate) fn runs_at_first(&self) -> bool {
        self.plays || !self.is_embedded && self.tick.is_none()
    }
}

/// The recording that a link holds.
///
/// # Errors
/// Why it holds none, in a sentence.
pub(crate) fn scene_of(written: &str) -> Result<Scene, String> {
    let text = link::text(written).map_err(|error| error.to_string())?;
    Scene::parse("the link", &text).map_err(|errors| {
        let errors = errors.to_string();
        errors.lines().next().unwrap_or_default().to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_link_is_opened_with_the_settings_behind_it() {
        let link = link::to(&Scene::built_in("spring").unwrap()).unwrap();
        let address = Address::of(&format!("{link}&panels=off&theme=light&tick=90&new=1"));
        assert_eq!(address.run.as_ref().unwrap().as_ref().unwrap().name, "spring");
        assert_eq!((address.is_embedded, address.theme), (true, Some(Theme::Light)));
        assert_eq!((address.tick, address.runs_at_first()), (Some(90), false));
        assert!(Address::of(&format!("{link}&tick=90&play")).runs_at_first());
        let id = Instrument::all().next().unwrap().id();
        let address = Address::of(&format!("#instrument={id}&theme=pink"));
        assert!(address.run.is_none() && address.theme.is_none() && address.runs_at_first());
        assert_eq!(address.instrument.unwrap().id(), id);
    }

    #[test]
    fn a_link_that_leads_to_no_run_is_refused_in_a_sentence() {
        for broken in ["#v1", "#v1.", "#v1.AAAA&play", "#v2.AAAA"] {
            let refused = Address::of(broken).run.unwrap().unwrap_err();
            assert!(refused.starts_with("the link ") && !refused.contains('\n'), "{refused}");
        }
        assert!(Address::of("").run.is_none() && Address::of("#").run.is_none());
    }
}
