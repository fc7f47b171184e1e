//! A parameter that takes several values in a sweep.

use crate::commands::error::Error;
use crate::scene::{Scene, edited_values, nearest};

/// The key of a parameter, and the values that it takes.
#[derive(Clone, Debug)]
pub(super) struct Varied {
    pub(super) key: String,
    pub(super) values: Vec<f64>,
}

/// Parses an argument of the form `KEY=V,V,...`.
pub(super) fn varied(text: &str) -> Result<Varied, String> {
    let (key, values) =
        text.split_once('=').ok_or("has no `=`; write `stiffness_n_per_m=90,900`")?;
    let number = |text: &str| {
        let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| format!("{text:?} is no number; write `{key}=90,900`"))
    };
    let mut values = values.split(',').map(number).collect::<Result<Vec<f64>, _>>()?;
    values.sort_by(f64::total_cmp);
    values.dedup();
    Ok(Varied { key: key.trim().to_owned(), values })
}

impl Varied {
    /// Checks that some body has the parameter, and that every such body accepts every value.
    pub(super) fn check(&self, scenes: &[(String, Scene)]) -> Result<(), Error> {
        let mut is_known = false;
        for body in scenes.iter().flat_map(|(_, scene)| &scene.bodies) {
            let Some((index, _)) = body.kind.parameter(&self.key) else { continue };
            is_known = true;
            for &value in &self.values {
                edited_values(&body.kind, &body.values, index, value).map_err(|error| {
                    let (key, body) = (&self.key, &body.name);
                    Error::mistake(format!("--vary {key}={value} on {body:?}: {error}"))
                })?;
            }
        }
        if is_known {
            return Ok(());
        }
        let bodies = scenes.iter().flat_map(|(_, scene)| &scene.bodies);
        let keys =
            bodies.flat_map(|body| body.kind.parameters.iter().map(|it| (&*it.key, &*it.key)));
        let remedy = match nearest(&self.key, keys) {
            Some(key) => format!("did you mean {key}?"),
            None => "give one of `regatta list bodies`, or a constant of a law".into(),
        };
        Err(Error::mistake(format!("no body has a parameter {:?}; {remedy}", self.key)))
    }
}
