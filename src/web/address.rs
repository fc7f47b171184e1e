//! What the address of a page asks for after its `#`: a run, or a scene with methods, and how it is shown.

use regatta::look::palette::Theme;
use regatta::run::link;
use regatta::run::race::Mode;
use regatta::scene::Scene;
use regatta::sim::Clock;
use regatta::sim::integrators::{Method, method};
use regatta::studio::{Instrument, Studio, lineup, open_loop_lab_on, show_clouds_of_scene};

/// What was asked for.
#[derive(Debug, Default)]
pub(crate) struct Address {
    /// The run of a link, or why the link leads to none.
    pub(crate) run: Option<Result<Scene, String>>,
    opening: Opening,
    /// Whether the stage and the digits of its methods are to stand on another's page.
    pub(crate) is_embedded: bool,
    /// Whether time runs from the start where it would not by itself.
    pub(crate) plays: bool,
    pub(crate) theme: Option<Theme>,
    /// The tick to go to.
    pub(crate) tick: Option<u64>,
    pub(crate) instrument: Option<Instrument>,
}

/// What is opened where no link is: the options of `regatta play`, by their names.
#[derive(Debug, Default)]
struct Opening {
    scene: Option<String>,
    methods: Vec<String>,
    tick_hz: Option<String>,
    races: bool,
    /// The trace on which the loop lab opens.
    loop_trace: Option<String>,
}

impl Address {
    /// Reads a fragment, with its `#`. A setting that is not known is of a newer page, and is ignored.
    pub(crate) fn of(fragment: &str) -> Self {
        let mut address = Self::default();
        let settings = fragment.trim_start_matches('#').split('&');
        // With its version: a setting of a newer page may have that letter too.
        let is_run = |setting: &&str| {
            let version = setting.strip_prefix('v');
            version.is_some_and(|version| version.starts_with(|first: char| first.is_ascii_digit()))
        };
        for setting in settings.clone() {
            match setting.split_once('=').unwrap_or((setting, "")) {
                ("panels", "off") => address.is_embedded = true,
                ("play", _) => address.plays = true,
                ("theme", "light") => address.theme = Some(Theme::Light),
                ("theme", "dark") => address.theme = Some(Theme::Dark),
                ("tick", tick) => address.tick = tick.parse().ok(),
                ("instrument", id) => address.instrument = Instrument::of_id(id),
                ("scene", name) => address.opening.scene = Some(name.into()),
                ("method", ids) => address.opening.methods.extend(ids.split(',').map(Into::into)),
                ("tick-hz", hz) => address.opening.tick_hz = Some(hz.into()),
                ("race", _) => address.opening.races = true,
                ("loop", trace) => address.opening.loop_trace = Some(trace.into()),
                _ => {}
            }
        }
        address.run = settings.clone().find(is_run).map(|run| scene_of(&format!("#{run}")));
        address
    }

    /// The studio at tick 0 of the scene that is asked for.
    ///
    /// # Errors
    /// What of it this page does not have, in a sentence.
    pub(crate) fn studio(&self) -> Result<Studio, String> {
        let Opening { scene, methods, tick_hz, races, loop_trace } = &self.opening;
        let name = scene.as_deref().unwrap_or(HARBOUR);
        let mut scene =
            Scene::built_in(name).ok_or_else(|| format!("this page has no scene {name:?}"))?;
        let known =
            |id: &String| method(id).ok_or_else(|| format!("this page has no method {id:?}"));
        let methods: Vec<&'static Method> = methods.iter().map(known).collect::<Result<_, _>>()?;
        if let Some(refusal) = methods.iter().find_map(|method| scene.refusal(method)) {
            return Err(refusal.to_string());
        }
        if let Some(hz) = tick_hz {
            let is_one = |hz: &u32| Clock::TICK_HZ.contains(hz);
            let hz = hz.parse().ok().filter(is_one).ok_or("tick-hz is 1 to 10000")?;
            scene = scene.at_tick_hz(hz);
        }
        let asked = if *races { Mode::Race } else { Mode::Solo };
        let (mode, selected) = lineup(&scene, &methods, asked);
        let mut studio = Studio::opened(scene.with_methods(&methods), selected, mode);
        match loop_trace {
            Some(trace) => {
                open_loop_lab_on(&mut studio, trace);
                let traces = studio.loop_lab().map_or(&[][..], |loops| loops.traces());
                if !trace.is_empty() && !traces.iter().any(|known| known.name() == trace) {
                    return Err(format!("this page has no frames {trace:?} for this scene"));
                }
            }
            None => show_clouds_of_scene(&mut studio.deck, &mut studio.viewer),
        }
        Ok(studio)
    }

    /// Whether it asks for panels that a person may not have open.
    pub(crate) fn opens_at_work(&self) -> bool {
        self.instrument.is_some() || self.opening.races || self.opening.loop_trace.is_some()
    }

    /// Whether time runs at the start: a stage on another's page, and a tick that was asked for, wait until they are told.
    pub(crate) fn runs_at_first(&self) -> bool {
        self.plays || !self.is_embedded && self.tick.is_none()
    }
}

/// The scene of an address that names none.
const HARBOUR: &str = "harbour";

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
        assert_eq!(address.run.as_ref().unwrap().as_ref().unwrap().title, "A spring at 1 Hz");
        assert_eq!((address.is_embedded, address.theme), (true, Some(Theme::Light)));
        assert_eq!((address.tick, address.runs_at_first()), (Some(90), false));
        assert!(Address::of(&format!("{link}&tick=90&play")).runs_at_first());
        let behind = link.trim_start_matches('#');
        assert!(Address::of(&format!("#panels=off&{behind}")).run.unwrap().is_ok());
        let id = Instrument::all().next().unwrap().id();
        let address = Address::of(&format!("#instrument={id}&theme=pink"));
        assert!(address.run.is_none() && address.theme.is_none() && address.runs_at_first());
        assert_eq!(address.instrument.unwrap().id(), id);
    }

    #[test]
    fn an_address_opens_a_scene_as_the_options_of_the_program_do() {
        let studio = Address::of("#scene=spring&method=rk4&tick-hz=30").studio().unwrap();
        assert_eq!((studio.scene().name.as_str(), studio.race().tick_hz()), ("spring", 30));
        assert_eq!((studio.mode(), studio.race().entrants().len()), (Mode::Solo, 1));
        assert_eq!(studio.entries()[studio.active()].method.id, "rk4");
        let studio = Address::of("#scene=spring&method=rk4,midpoint").studio().unwrap();
        let racing: Vec<&str> = studio.scene().lanes.iter().map(|lane| lane.method.id).collect();
        assert_eq!((studio.mode(), &racing[..]), (Mode::Race, &["rk4", "midpoint"][..]));
        assert_eq!(Address::of("#scene=spring&race").studio().unwrap().mode(), Mode::Race);
        assert_eq!(Address::of("#scene=engines").studio().unwrap().mode(), Mode::Race);
        let studio = Address::of("#scene=spring&loop=steady-144").studio().unwrap();
        let loops = studio.loop_lab().unwrap();
        assert_eq!(loops.traces()[loops.trace()].name(), "steady-144");
        assert_eq!(Address::of("").studio().unwrap().scene().name, HARBOUR);
        for broken in
            ["#scene=tub", "#method=rk5", "#method=lerp-per-frame", "#tick-hz=0", "#loop=x"]
        {
            let refused = Address::of(broken).studio().err().unwrap();
            assert!(!refused.is_empty() && !refused.contains('\n'), "{refused}");
        }
    }

    #[test]
    fn a_link_that_leads_to_no_run_is_refused_in_a_sentence() {
        for broken in ["#v1", "#v1.", "#v1.AAAA&play", "#v2.AAAA"] {
            let refused = Address::of(broken).run.unwrap().unwrap_err();
            assert!(refused.starts_with("the link ") && !refused.contains('\n'), "{refused}");
        }
        for other in ["", "#", "#view", "#vsync=1&play"] {
            assert!(Address::of(other).run.is_none(), "{other}");
        }
    }
}
