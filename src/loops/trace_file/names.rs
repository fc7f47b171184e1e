//! Names the streams of a log.

use std::collections::{HashMap, HashSet};

use super::stream::Stream;

/// Returns a unique name for each stream.
pub(super) fn names(name: &str, streams: &[Stream]) -> Vec<String> {
    if streams.len() == 1 {
        return vec![name.into()];
    }
    let mut programs = HashMap::<&str, usize>::new();
    for stream in streams {
        *programs.entry(stream.application()).or_default() += 1;
    }
    let mut taken = HashSet::new();
    let mut labels = HashMap::<String, usize>::new();
    let unique = |stream: &Stream| {
        let (program, process) = (stream.application(), stream.process());
        let known: Vec<&str> = [program, process].into_iter().filter(|s| !s.is_empty()).collect();
        let alone = programs[program] == 1 && !program.is_empty();
        let label = match known[..] {
            [] => "stream".to_owned(),
            _ if alone => program.to_owned(),
            _ => known.join("-"),
        };
        let count = labels.entry(label.clone()).or_default();
        loop {
            *count += 1;
            let numbered = match *count {
                1 => format!("{name}:{label}"),
                n => format!("{name}:{label}-{n}"),
            };
            if taken.insert(numbered.clone()) {
                return numbered;
            }
        }
    };
    streams.iter().map(unique).collect()
}
