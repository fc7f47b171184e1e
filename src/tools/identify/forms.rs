//! Steps that people write by hand and that no method of the table takes, as candidates for the origin of a log.

use std::sync::LazyLock;

use crate::sim::integrators::Method;
use crate::sim::own_method;

/// The numbers of the body that each form takes.
const TAKES: &str = "takes stiffness\ntakes damping\ntakes drag\ntakes force\n";

/// Id and lines of each form.
const FORMS: [(&str, &str); 9] = [
    (
        "uniform-acceleration",
        "let a = force - stiffness * x - (damping + drag) * v
        x += h * v + h * h / 2.0 * a
        v += h * a",
    ),
    (
        "verlet-old-velocity",
        "let c = damping + drag
        let old = v
        let a = force - stiffness * x - c * old
        x += h * old + h * h / 2.0 * a
        v += h / 2.0 * (a + force - stiffness * x - c * old)",
    ),
    (
        "verlet-half-velocity",
        "let c = damping + drag
        v += h / 2.0 * (force - stiffness * x - c * v)
        x += h * v
        v += h / 2.0 * (force - stiffness * x - c * v)",
    ),
    (
        "verlet-carried-force",
        "memory last_h = nan
        memory a = 0.0
        let c = damping + drag
        var a = memory.a
        if memory.last_h != h {
            a = force - stiffness * x - c * v
        }
        v += h / 2.0 * a
        x += h * v
        a = force - stiffness * x - c * v
        v += h / 2.0 * a
        memory.a = a
        memory.last_h = h",
    ),
    (
        "verlet-carried-old-velocity",
        "memory last_h = nan
        memory a = 0.0
        let c = damping + drag
        var a = memory.a
        if memory.last_h != h {
            a = force - stiffness * x - c * v
        }
        x += h * v + h * h / 2.0 * a
        let after = force - stiffness * x - c * v
        v += h / 2.0 * (a + after)
        memory.a = after
        memory.last_h = h",
    ),
    // As semi-implicit Euler whose x is logged a tick before its v.
    (
        "drift-first",
        "x += h * v
        v += h * (force - stiffness * x - (damping + drag) * v)",
    ),
    (
        "damped-before",
        "v *= exp(-h * (damping + drag))
        v += h * (force - stiffness * x)
        x += h * v",
    ),
    (
        "damped-between",
        "v += h * (force - stiffness * x)
        v *= exp(-h * (damping + drag))
        x += h * v",
    ),
    (
        "damped-after",
        "v += h * (force - stiffness * x)
        x += h * v
        v *= exp(-h * (damping + drag))",
    ),
];

/// Returns the forms as methods, which need a spring or a drag.
pub(super) fn forms() -> &'static [&'static Method] {
    static METHODS: LazyLock<Vec<&'static Method>> = LazyLock::new(|| {
        let read = |(id, lines): &(&str, &str)| own_method(id, &format!("{TAKES}{lines}"));
        FORMS.iter().filter_map(|form| read(form).ok()).collect()
    });
    &METHODS
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_form_is_read() {
        let ids: Vec<&str> = forms().iter().map(|method| method.id).collect();
        assert_eq!(ids, FORMS.map(|(id, _)| id));
    }
}
