//! A custom body: which method should step it, and at what rate?

use regatta::glam::DVec2;
use regatta::prelude::*;

/// A hover craft, held over a place on the water by a spring.
#[derive(Clone)]
struct HoverCraft {
    mass_kg: f64,
    spring_n_per_m: f64,
    drag_kg_per_m: f64,
}

impl System for HoverCraft {
    type Vector = DVec2;
    fn acceleration(&self, _t: f64, q: &DVec2, v: &DVec2, a: &mut DVec2) {
        let drag = -self.drag_kg_per_m * v.length() * *v;
        *a = (drag - self.spring_n_per_m * *q) / self.mass_kg;
    }
}

fn sliders() -> Vec<ParameterOf<HoverCraft>> {
    vec![
        ParameterOf::number("spring_n_per_m", Range::POSITIVE, |craft| &mut craft.spring_n_per_m),
        ParameterOf::number("mass_kg", Range::POSITIVE, |craft| &mut craft.mass_kg),
    ]
}

fn main() {
    let craft = HoverCraft { mass_kg: 400.0, spring_n_per_m: 25_000.0, drag_kg_per_m: 20.0 };
    let start = State { q: DVec2::new(3.0, 0.0), v: DVec2::new(0.0, 12.0) };
    let methods = ["explicit-euler", "semi-implicit-euler", "velocity-verlet", "rk4"];
    let options = || Options {
        name: "hover craft",
        tick_hz: 60.into(),
        seconds: 5.0,
        methods: methods.map(|id| method(id).expect("a built-in method")).into(),
        // All that follows is optional: here two sliders in the window.
        extras: Extras { parameters: sliders(), ..Extras::default() },
        ..Options::default()
    };

    let report = regatta::advise(&craft, start, options());
    println!("{report}");
    let accurate = report.recommended.accurate.expect("one of them is accurate");
    assert_eq!(accurate.method, "velocity-verlet");

    // What a test in continuous integration would compare with the hashes of yesterday.
    let mut race = Race::of(&craft, start, options());
    race.run(600);
    for (method, hash) in race.hashes_by_method() {
        println!("{method} {hash:016x}");
    }
}
