//! The options that every run has in common.

use std::path::{Path, PathBuf};

use clap::Args;

use super::error::Error;
use super::experiment::{Experiment, PathOrName, scene_names, seconds};
use super::id::IMPACT;
use super::output::Input;
use super::own_file::{NAMED_METHOD, NamedMethod, load_method};
use super::scene_file;
use super::spring::SpringArgs;
use super::tick_rate::TickRateArgs;
use crate::run::race::{Mode, lanes_that_race};
use crate::scene::{LaneSpec, MAX_LANES, SCENES, Scene, SceneGroup};
use crate::sim::Impact;
use crate::sim::integrators::Method;
use crate::studio::lineup;

/// The options that choose a scene, its methods and its tick rate.
#[derive(Clone, Debug, Args)]
pub(super) struct ExperimentArgs {
    /// A scene or the file of one [default: harbour]
    #[arg(long, value_name = "NAME|FILE")]
    #[arg(value_parser = PathOrName(scene_names), hide_possible_values = true)]
    #[arg(conflicts_with = "spring", long_help = scene_help())]
    scene: Option<PathBuf>,

    #[command(flatten)]
    spring: SpringArgs,

    /// A method (`regatta list methods`), or several
    ///
    /// Give the option again for each, to race them. A file that ends in .step is a method of your own: `regatta help
    /// step`.
    #[arg(long = "method", value_name = "ID|FILE", value_parser = NAMED_METHOD)]
    #[arg(hide_possible_values = true)]
    methods: Vec<NamedMethod>,

    /// A rule for impacts of a ball, or several
    ///
    /// `regatta list impacts` has them. Give the option again for each, to race every method under every rule.
    #[arg(long = "impact", value_name = "ID", value_parser = IMPACT, hide_possible_values = true)]
    #[arg(hide_short_help = true)]
    impacts: Vec<&'static Impact>,

    #[command(flatten)]
    tick_rate: TickRateArgs,
}

impl ExperimentArgs {
    /// Reads the scene and applies the other options. The mode is `asked`, unless the methods or the scene decide it.
    pub(super) fn load(&self, asked: Mode) -> Result<Experiment, Error> {
        let (scene, text) = match self.spring.load()? {
            Some((scene, text)) => (self.applied_to(scene)?, text),
            None => self.read(self.scene())?,
        };
        let (mode, selected) = lineup(&scene, &self.methods(), asked);
        let mode = if self.impacts.len() > 1 { Mode::Race } else { mode };
        Ok(Experiment { scene, text, selected, mode, loop_trace: None })
    }

    /// Reads a scene. The other options are applied only if `--scene` names the same scene.
    pub(super) fn read(&self, path: &Path) -> Result<(Scene, String), Error> {
        let (mut scene, text) = scene_file::load(path)?;
        if path == self.scene() && !self.spring.is_given() {
            scene = self.applied_to(scene)?;
        }
        scene.lanes = lanes_that_race(&scene);
        scene.equal_cost = false;
        Ok((scene, text))
    }

    /// Applies the tick rate and the methods to a scene.
    fn applied_to(&self, scene: Scene) -> Result<Scene, Error> {
        let tick_hz = self.tick_rate.tick_rate().unwrap_or(scene.tick_hz);
        let scene = scene.at_tick_hz(tick_hz);
        let methods = self.methods();
        methods.iter().try_for_each(|method| scene_file::check_method(&scene, method))?;
        let scene = scene.with_methods(&methods);
        if self.impacts.is_empty() {
            return Ok(scene);
        }
        if !scene.bodies.iter().any(|body| body.kind.has_walls) {
            return Err(Error::mistake(
                "--impact is for scenes with a ball or a law with events, such as --scene ball",
            ));
        }
        let scene = scene.with_impacts(&methods, &self.impacts);
        let mut lanes = scene.lanes.iter();
        let of_law = |impact| scene.bodies.iter().find_map(|it| it.kind.impact_refusal(impact));
        let refused =
            |lane: &LaneSpec| lane.impact.refusal(lane.method).or_else(|| of_law(lane.impact));
        if let Some(refusal) = lanes.find_map(refused) {
            return Err(Error::mistake(format!(
                "--impact: {refusal}; give another, or leave the option out"
            )));
        }
        match scene.lanes.len() {
            0..=MAX_LANES => Ok(scene),
            many => Err(Error::mistake(format!(
                "{many} lanes of methods and rules; name at most {MAX_LANES}"
            ))),
        }
    }

    /// Returns the `--scene` argument, which is a name or a path. Without the argument, returns the name of the first
    /// built-in scene.
    pub(super) fn scene(&self) -> &Path {
        self.scene.as_deref().unwrap_or(Path::new(SCENES[0].name))
    }

    /// Returns the scene file that the command reads, if any.
    pub(super) fn input(&self) -> Option<Input<'_>> {
        scene_file::input(self.scene()).filter(|_| !self.is_a_spring())
    }

    fn methods(&self) -> Vec<&'static Method> {
        self.methods.iter().map(|(method, _)| *method).collect()
    }

    /// Returns the files of a person's own methods.
    pub(super) fn method_files(&self) -> impl Iterator<Item = &Path> {
        self.methods.iter().filter_map(|(_, file)| file.as_deref())
    }

    /// Reads a scene as [`Self::read`] does, under the methods that the files hold by now.
    pub(super) fn read_anew(&self, path: &Path) -> Result<(Scene, String), Error> {
        let mut now = self.clone();
        for (method, file) in &mut now.methods {
            *method = file.as_deref().map_or(Ok(*method), load_method)?;
        }
        now.read(path)
    }

    /// Returns the same options with `scene`. If the options already choose a scene, methods or a tick rate, they stay
    /// unchanged.
    pub(super) fn or_scene(&self, scene: &Path) -> Self {
        let is_chosen = self.names_a_scene()
            || !self.methods.is_empty()
            || !self.impacts.is_empty()
            || self.tick_rate.tick_rate().is_some();
        let scene = if is_chosen { self.scene.clone() } else { Some(scene.to_owned()) };
        Self { scene, ..self.clone() }
    }

    /// Whether the options name a scene or a spring.
    pub(super) fn names_a_scene(&self) -> bool {
        self.scene.is_some() || self.is_a_spring()
    }

    /// Whether a spring replaces the scene.
    pub(super) fn is_a_spring(&self) -> bool {
        self.spring.is_given()
    }

    /// Returns the lanes of the methods that the options name, set up as in `scene`.
    pub(super) fn lanes_named(&self, scene: &Scene) -> Vec<LaneSpec> {
        scene.lanes_of(&self.methods())
    }

    pub(super) fn names_no_method(&self) -> bool {
        self.methods.is_empty()
    }
}

/// The options that choose ticks of a run.
#[derive(Clone, Copy, Debug, Args)]
pub(super) struct TickArgs {
    /// Simulated seconds [default: the scene's]
    ///
    /// To the nearest tick.
    #[arg(long, value_name = "s", value_parser = seconds)]
    #[arg(allow_negative_numbers = true)]
    pub(super) seconds: Option<f64>,

    /// Write only the ticks that are multiples of N
    #[arg(long, value_name = "N", default_value_t = 1)]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    pub(super) every: u64,
}

/// Returns the long help of `--scene`: the scenes to start with, and the command that lists the others.
fn scene_help() -> String {
    let first = SCENES.iter().filter(|scene| scene.group == SceneGroup::StartHere);
    let names: Vec<&str> = first.map(|scene| scene.name).collect();
    format!(
        "A scene or the file of one [default: {}]\n\nStart with {}; `regatta list scenes` has all. Anything else is read as a \
         file or a link.",
        names[0],
        names.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::integrators::METHODS;
    use crate::studio::MANY_LANES;

    #[derive(clap::Parser)]
    struct Line {
        #[command(flatten)]
        experiment: ExperimentArgs,
    }

    #[test]
    fn a_race_of_many_methods_selects_the_best_and_a_race_of_few_the_first_named() {
        let ids: Vec<&str> = METHODS.iter().map(|method| method.id).take(MANY_LANES).collect();
        for (count, is_best) in [(MANY_LANES, true), (MANY_LANES - 1, false)] {
            let named = ids[..count].iter().flat_map(|id| ["--method", id]);
            let words = ["", "--scene", "spring"].into_iter().chain(named);
            let line = <Line as clap::Parser>::parse_from(words);
            let mut studio = line.experiment.load(Mode::Solo).unwrap().studio();
            assert_eq!(studio.entries()[studio.active()].method.id, ids[0]);
            studio.analyse();
            let outcome = |entry: usize| studio.viewer.verdict(entry).unwrap().outcome();
            let best = (0..count).map(outcome).min().unwrap();
            assert_ne!(outcome(0), best);
            assert_eq!(outcome(studio.active()) == best, is_best, "{count}");
        }
    }

    #[test]
    fn a_scenes_race_selects_the_lane_with_the_best_verdict() {
        let line = <Line as clap::Parser>::parse_from(["", "--scene", "spring"]);
        let mut studio = line.experiment.load(Mode::Race).unwrap().studio();
        studio.analyse();
        let outcome = |entry: usize| studio.viewer.verdict(entry).unwrap().outcome();
        let best = (0..studio.race().entrants().len()).map(outcome).min().unwrap();
        assert!(outcome(studio.active()) == best && outcome(0) != best);
    }
}
