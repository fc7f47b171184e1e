//! Parses the part of a page's address after its `#`, which names a run, or a scene with methods, and display settings.

use regatta::look::palette::Theme;
use regatta::run::link::{Link, LinkError};
use regatta::run::race::Mode;
use regatta::scene::{OPENING, Scene};
use regatta::studio::{Instrument, Studio, lineup, open_loop_lab_on, show_clouds_of_scene};

/// A parsed address.
#[derive(Debug, Default)]
pub(crate) struct Address {
    link: Link,
    /// The run that the link contains, if any.
    pub(crate) run: Option<Scene>,
    /// Whether another page embeds this one, so that it shows only the stage and the digits of its methods.
    pub(crate) is_embedded: bool,
    /// Whether time runs from the start even if it would normally wait.
    pub(crate) plays: bool,
    pub(crate) theme: Option<Theme>,
    /// The tick at which the run opens.
    pub(crate) tick: Option<u64>,
    pub(crate) instrument: Option<Instrument>,
    /// Trace on which the loop lab opens.
    loop_trace: Option<String>,
}

impl Address {
    /// Reads an address, or finds one in a text.
    ///
    /// # Errors
    /// A sentence about the part of the address that this page does not have.
    pub(crate) fn of(written: &str) -> Result<Self, String> {
        let refused = |error: LinkError| error.to_string();
        let link = Link::read(written).map_err(refused)?;
        let mut address = Self::default();
        for (key, value) in link.settings() {
            let unknown = |known: &[&str]| refused(LinkError::unknown(key, value, known));
            match (key, value) {
                ("panels", "off") => address.is_embedded = true,
                ("panels", "on") => address.is_embedded = false,
                ("panels", _) => return Err(unknown(&["on", "off"])),
                ("theme", "light") => address.theme = Some(Theme::Light),
                ("theme", "dark") => address.theme = Some(Theme::Dark),
                ("theme", _) => return Err(unknown(&["dark", "light"])),
                ("tick", tick) => {
                    let tick = tick.parse().map_err(|_| unknown(&["a whole number"]))?;
                    address.tick = Some(tick);
                }
                ("instrument", id) => {
                    let ids: Vec<String> = Instrument::all().map(Instrument::id).collect();
                    let ids: Vec<&str> = ids.iter().map(String::as_str).collect();
                    address.instrument = Some(Instrument::of_id(id).ok_or_else(|| unknown(&ids))?);
                }
                ("loop", trace) => address.loop_trace = Some(trace.into()),
                // The setting is `play`, the last one that a page has.
                _ => address.plays = true,
            }
        }
        if link.is_packed() {
            let text = link.text().map_err(refused)?;
            address.run = Some(Scene::parse("the link", &text).map_err(|errors| {
                let errors = errors.to_string();
                errors.lines().next().unwrap_or_default().to_owned()
            })?);
        }
        Ok(Self { link, ..address })
    }

    /// Returns a studio at tick 0 of the scene that the link names. If the link contains a run, the studio shows the
    /// first scene instead.
    ///
    /// # Errors
    /// A sentence about the part of the address that this page does not have.
    pub(crate) fn studio(&self) -> Result<Studio, String> {
        let is_bare = !self.link.names_anything() && self.loop_trace.is_none();
        let opens = self.run.is_none() && self.instrument.is_none() && is_bare;
        let opening = opens.then(|| Scene::built_in(OPENING)).flatten();
        let mut named = self.link.named().map_err(|error| error.to_string())?;
        named.scene = opening.unwrap_or(named.scene);
        let asked = if named.races { Mode::Race } else { Mode::Solo };
        let (mode, selected) = lineup(&named.scene, &named.methods, asked);
        let mut studio = Studio::opened(named.scene, selected, mode);
        match &self.loop_trace {
            Some(trace) => {
                open_loop_lab_on(&mut studio, trace);
                let traces = studio.loop_lab().map_or(&[][..], |loops| loops.traces());
                let names: Vec<&str> = traces.iter().map(|known| known.name()).collect();
                if !trace.is_empty() && !names.contains(&&**trace) {
                    return Err(LinkError::unknown("loop", trace, &names).to_string());
                }
            }
            None => show_clouds_of_scene(&mut studio),
        }
        Ok(studio)
    }

    /// Returns the link in the form in which it ends a page's address.
    pub(crate) fn fragment(&self) -> String {
        self.link.to_string()
    }

    /// Whether the address asks for panels that a person may have closed.
    pub(crate) fn opens_at_work(&self) -> bool {
        self.instrument.is_some() || self.link.asks_to_race() || self.loop_trace.is_some()
    }

    /// Whether time runs at the start. On an embedded stage, or at a requested tick, time waits for a person.
    pub(crate) fn runs_at_first(&self) -> bool {
        self.plays || !self.is_embedded && self.tick.is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use regatta::run::link;

    #[test]
    fn a_link_opens_with_the_settings_after_it() {
        let link = link::link_to_run(&Scene::built_in("spring").unwrap()).unwrap();
        let address = Address::of(&format!("{link}&panels=off&theme=light&tick=90")).unwrap();
        assert_eq!(address.run.as_ref().unwrap().title, "A spring at 1 Hz");
        assert_eq!((address.is_embedded, address.theme), (true, Some(Theme::Light)));
        assert_eq!((address.tick, address.runs_at_first()), (Some(90), false));
        assert!(Address::of(&format!("{link}&tick=90&play")).unwrap().runs_at_first());
        let behind = link.trim_start_matches('#');
        assert!(Address::of(&format!("#panels=off&{behind}")).unwrap().run.is_some());
        for id in Instrument::all().map(Instrument::id) {
            let address = Address::of(&format!("#instrument={id}")).unwrap();
            assert!(address.run.is_none() && address.runs_at_first());
            assert_eq!(address.instrument.unwrap().id(), id);
        }
    }

    #[test]
    fn an_address_opens_a_scene_like_the_options_of_the_program() {
        let opened = |written: &str| Address::of(written).unwrap().studio().unwrap();
        let studio = opened("#scene=spring&method=rk4&tick-hz=30");
        assert_eq!((studio.scene().name.as_str(), studio.race().tick_hz()), ("spring", 30.into()));
        assert_eq!((studio.mode(), studio.race().entrants().len()), (Mode::Solo, 1));
        assert_eq!(studio.entries()[studio.active()].method.id, "rk4");
        let studio = opened("#scene=spring&method=rk4,midpoint");
        let racing: Vec<&str> = studio.scene().lanes.iter().map(|lane| lane.method.id).collect();
        assert_eq!((studio.mode(), &racing[..]), (Mode::Race, &["rk4", "midpoint"][..]));
        assert_eq!(opened("#scene=spring&race").mode(), Mode::Race);
        assert_eq!(opened("#scene=engines").mode(), Mode::Race);
        let studio = opened("#scene=spring&loop=steady-144");
        let loops = studio.loop_lab().unwrap();
        assert_eq!(loops.chosen_trace().name(), "steady-144");
        let studio = opened("#theme=light");
        assert_eq!((studio.scene().name.as_str(), studio.bands()), ("two-springs", vec![0, 1]));
        assert_eq!(opened("#instrument=energy").scene().name, "harbour");
        assert_eq!(opened("#scene=engines&method=engine-jolt").mode(), Mode::Solo);
    }

    #[test]
    fn an_invalid_setting_of_an_address_is_refused_by_name() {
        for (written, word) in [
            ("#scene=tub", "\"tub\""),
            ("#method=rk5", "\"rk5\""),
            ("#method=lerp-per-frame", "lerp-per-frame does not step"),
            ("#tick-hz=0", "tick-hz \"0\""),
            ("#scene=spring&loop=x", "loop \"x\""),
            ("#theme=pink", "write dark, light"),
            ("#panels=of", "\"of\""),
            ("#tick=soon", "tick \"soon\""),
            ("#instrument=energi", "did you mean \"energy\"?"),
            ("#view", "setting \"view\""),
            ("#vsync=1&play", "setting \"vsync\""),
            ("#v1", "broken; copy it whole"),
            ("#v1.", "broken; copy it whole"),
            ("#v1.AAAA&play", "broken; copy it whole"),
            ("#v2.AAAA", "format 2"),
        ] {
            let refused = Address::of(written).and_then(|address| address.studio());
            let refused = refused.err().unwrap();
            assert!(refused.contains(word) && !refused.contains('\n'), "{written}: {refused}");
            assert!(refused.starts_with("the link "), "{refused}");
        }
    }
}
