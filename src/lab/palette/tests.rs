use super::*;

/// Relative luminance, as the Web Content Accessibility Guidelines 2.1 define it.
fn luminance(colour: Rgba) -> f64 {
    let linear = |i: usize| {
        let part = f64::from(colour[i]) / 255.0;
        if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
    };
    0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2)
}

fn contrast(a: Rgba, b: Rgba) -> f64 {
    let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
    a.max(b) / a.min(b)
}

#[test]
fn text_stands_out_from_what_it_is_written_on_in_both_themes() {
    for theme in [Theme::Dark, Theme::Light] {
        let palette = theme.palette();
        let surfaces = [
            palette.background,
            palette.panel,
            palette.raised,
            palette.plot,
            palette.sea[0],
            palette.sea[1],
        ];
        let texts =
            [palette.text, palette.dim, palette.accent, palette.bad, palette.warn, palette.good];
        for surface in surfaces {
            for text in texts.iter().chain(&palette.methods) {
                let contrast = contrast(*text, surface);
                assert!(contrast >= 4.5, "{theme:?}: {text:?} on {surface:?}: {contrast:.2}");
            }
        }
        assert!(contrast(palette.on_accent, palette.accent) >= 4.5);
    }
    assert!((contrast(rgb(0xFFFFFF), rgb(0)) - 21.0).abs() < 1e-9);
}

#[test]
fn lanes_of_one_method_differ_in_colour_and_the_first_has_the_methods() {
    let lane = |id, substeps| {
        let method = crate::sim::integrators::method(id).unwrap();
        LaneSpec { substeps, ..LaneSpec::plain(method) }
    };
    for id in ["held-force", "engine-jolt", "rk4", "explicit-euler"] {
        let lanes = [lane(id, 1), lane("engine-box2d", 4), lane(id, 4), lane(id, 8)];
        let styles = lanes.map(|spec| Theme::Dark.lane_style(&lanes, &spec));
        assert_eq!(styles[0], Theme::Dark.style(lanes[0].method), "{id}");
        for i in [2, 3] {
            let is_new = styles[..i].iter().all(|other| other.0 != styles[i].0);
            assert!(is_new, "{id}: {styles:?}");
        }
    }
    // The list of a studio goes on with every other method.
    let mut list = vec![lane("held-force", 1), lane("held-force", 4), lane("held-force", 8)];
    list.extend(METHODS.iter().map(LaneSpec::plain));
    let colours: Vec<Rgba> =
        list[..3].iter().map(|spec| Theme::Dark.lane_style(&list, spec).0).collect();
    assert!(colours[0] != colours[1] && colours[1] != colours[2] && colours[0] != colours[2]);
    // More lanes than colours differ in colour or dash.
    let lanes: Vec<LaneSpec> = (1..20).map(|substeps| lane("held-force", substeps)).collect();
    let styles: Vec<_> = lanes.iter().map(|spec| Theme::Light.lane_style(&lanes, spec)).collect();
    for (i, style) in styles.iter().enumerate() {
        assert!(!styles[..i].contains(style), "{i}: {styles:?}");
    }
    let beside = [lane("engine-box2d", 4), lane("held-force", 4)];
    let alone = Theme::Dark.style(beside[1].method);
    assert_eq!(Theme::Dark.lane_style(&beside, &beside[1]), alone);
}

#[test]
fn methods_differ_in_colour_or_dash_and_neighbours_in_colour() {
    let distance =
        |a: Rgba, b: Rgba| (0..3).map(|i| u32::from(a[i].abs_diff(b[i])).pow(2)).sum::<u32>();
    for (i, style) in STYLES.iter().enumerate() {
        let is_taken = |(other, method): (&(usize, usize), &Method)| {
            other == style && method.is_engine() == METHODS[i].is_engine()
        };
        assert!(!STYLES[..i].iter().zip(METHODS).any(is_taken), "{}", METHODS[i].id);
    }
    for theme in [Theme::Dark, Theme::Light] {
        for pair in METHODS.windows(2) {
            let [a, b] = [&pair[0], &pair[1]].map(|method| theme.style(method).0);
            assert!(distance(a, b) > 40 * 40, "{} and {}: {a:?} {b:?}", pair[0].id, pair[1].id);
        }
        for number in 0..2 * LOOPS.len() {
            let [a, b] = [number, number + 1].map(|number| theme.loop_style(number).0);
            assert!(distance(a, b) > 60 * 60, "{number}: {a:?} {b:?}");
        }
        for lanes in [
            ["explicit-euler", "semi-implicit-euler"],
            ["semi-implicit-euler", "implicit-euler"],
            // The third and the fifth lane of the harbour.
            ["improved-euler", "adaptive-euler"],
        ] {
            let [a, b] =
                lanes.map(|id| theme.style(crate::sim::integrators::method(id).unwrap()).0);
            assert!(distance(a, b) > 60 * 60, "{lanes:?}");
        }
    }
}

#[test]
fn the_wire_of_a_spring_stands_out_from_the_sea_in_both_themes() {
    for theme in [Theme::Dark, Theme::Light] {
        let palette = theme.palette();
        let [edge, _, light, _] = palette.wire;
        for sea in palette.sea {
            let most = contrast(edge, sea).max(contrast(light, sea));
            assert!(most >= 4.5, "{theme:?}: {most:.2}");
        }
        assert!(contrast(edge, light) >= 3.0, "{theme:?}: the turns are told apart");
    }
}
