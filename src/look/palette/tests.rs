use super::*;

/// Returns the relative luminance, as the Web Content Accessibility Guidelines 2.1 define it.
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
fn text_contrasts_with_its_background_in_both_themes() {
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
            for text in texts.iter().chain(&palette.methods).chain(&palette.loops) {
                let contrast = contrast(*text, surface);
                assert!(contrast >= 4.5, "{theme:?}: {text:?} on {surface:?}: {contrast:.2}");
            }
        }
        assert!(contrast(palette.on_accent, palette.accent) >= 4.5);
    }
    assert!((contrast(rgb(0xFFFFFF), rgb(0)) - 21.0).abs() < 1e-9);
}

/// Matrices from linear sRGB to the colours that a deuteranope sees, by Machado, Oliveira and Fernandes (2009), and to
/// the colours that most people see.
const DEUTERANOPE: [[f64; 3]; 3] = [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.011820, 0.042940, 0.968881],
];
const MOST_PEOPLE: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Returns the distance of two colours in CIE L*a*b*, as they look to these eyes.
fn distance_seen(a: Rgba, b: Rgba, eyes: [[f64; 3]; 3]) -> f64 {
    let (a, b) = (seen_by(a, eyes), seen_by(b, eyes));
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// Returns the colour in CIE L*a*b*, as it looks to these eyes.
fn seen_by(colour: Rgba, eyes: [[f64; 3]; 3]) -> [f64; 3] {
    let linear = |i: usize| {
        let part = f64::from(colour[i]) / 255.0;
        if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
    };
    let through = |rows: [[f64; 3]; 3], of: [f64; 3]| {
        rows.map(|row| row.iter().zip(of).map(|(part, of)| part * of).sum::<f64>())
    };
    let seen = through(eyes, [0, 1, 2].map(linear));
    let xyz = through(
        [
            [0.433953, 0.376219, 0.189828],
            [0.212673, 0.715152, 0.072175],
            [0.017757, 0.109477, 0.872765],
        ],
        seen.map(|part| part.clamp(0.0, 1.0)),
    );
    let [x, y, z] =
        xyz.map(|part| if part > 0.008856 { part.cbrt() } else { 7.787 * part + 16.0 / 116.0 });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

#[test]
fn a_deuteranope_can_distinguish_the_first_nine_lanes_by_hue_or_dash() {
    /// Distance below which a person who looks from curve to legend confuses two colours.
    const ALIKE: f64 = 25.5;
    let distance = |a: Rgba, b: Rgba| distance_seen(a, b, DEUTERANOPE);
    let white = seen_by([255; 4], DEUTERANOPE);
    assert!((white[0] - 100.0).abs() < 0.1 && white[1].hypot(white[2]) < 1.0, "{white:?}");
    let engines = METHODS.iter().filter(|method| method.is_engine());
    let mut lists: Vec<(String, Vec<LaneSpec>)> = vec![
        ("methods".into(), METHODS.iter().map(LaneSpec::plain).collect()),
        ("engines".into(), engines.map(LaneSpec::plain).collect()),
    ];
    for scene in crate::scene::SCENES {
        let lanes = crate::scene::Scene::built_in(scene.name).unwrap().lanes;
        lists.push((scene.name.into(), lanes));
    }
    for theme in [Theme::Dark, Theme::Light] {
        for (name, lanes) in &lists {
            let styles = lanes.iter().take(9).map(|lane| theme.lane_style(lanes, lane));
            let styles: Vec<_> = styles.collect();
            for (i, a) in styles.iter().enumerate() {
                for (k, b) in styles[..i].iter().enumerate() {
                    let is_told = a.1 != b.1 || distance(a.0, b.0) > ALIKE;
                    assert!(is_told, "{name}, {theme:?}: lanes {} and {}: {a:?}", k + 1, i + 1);
                }
            }
        }
    }
}

#[test]
fn lanes_of_one_method_differ_in_colour_and_the_first_has_the_methods_own() {
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
    // A studio's list also contains every other method.
    let mut list = vec![lane("held-force", 1), lane("held-force", 4), lane("held-force", 8)];
    list.extend(METHODS.iter().map(LaneSpec::plain));
    let colours: Vec<Rgba> =
        list[..3].iter().map(|spec| Theme::Dark.lane_style(&list, spec).0).collect();
    assert!(colours[0] != colours[1] && colours[1] != colours[2] && colours[0] != colours[2]);
    // If there are more lanes than colours, they differ in colour or dash.
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
            let group = |it: &Method| (it.is_engine(), it.is_for_spin(), it.is_of_library());
            other == style && group(method) == group(&METHODS[i])
        };
        assert!(!STYLES[..i].iter().zip(METHODS).any(is_taken), "{}", METHODS[i].id);
    }
    for theme in [Theme::Dark, Theme::Light] {
        for pair in METHODS.windows(2) {
            let [a, b] = [&pair[0], &pair[1]].map(|method| theme.style(method).0);
            assert!(distance(a, b) > 40 * 40, "{} and {}: {a:?} {b:?}", pair[0].id, pair[1].id);
        }
        for number in 0..2 * theme.palette().loops.len() {
            let [a, b] = [number, number + 1].map(|number| theme.loop_style(number).0);
            assert!(distance(a, b) > 60 * 60, "{number}: {a:?} {b:?}");
        }
        for lanes in [
            ["explicit-euler", "semi-implicit-euler"],
            ["semi-implicit-euler", "implicit-euler"],
            // The third and fifth lanes of the harbour scene.
            ["improved-euler", "adaptive-euler"],
        ] {
            let [a, b] =
                lanes.map(|id| theme.style(crate::sim::integrators::method(id).unwrap()).0);
            assert!(distance(a, b) > 60 * 60, "{lanes:?}");
        }
    }
}

#[test]
fn no_loop_has_the_colour_of_a_method() {
    for theme in [Theme::Dark, Theme::Light] {
        let Palette { methods, loops, .. } = theme.palette();
        for (method, of_loop) in methods.iter().flat_map(|a| loops.iter().map(move |b| (a, b))) {
            let away = distance_seen(*method, *of_loop, MOST_PEOPLE);
            assert!(away > 20.0, "{theme:?}: {method:?} and {of_loop:?} are {away} apart");
        }
    }
}

#[test]
fn the_wire_of_a_spring_contrasts_with_the_sea_in_both_themes() {
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

#[test]
fn only_explicit_euler_has_the_colour_of_explicit_euler() {
    let (euler, is_euler) = (EULER, |method: &Method| method.id == "explicit-euler");
    for method in METHODS {
        assert_eq!(indices(method).0 == euler, is_euler(method), "{}", method.id);
    }
    for scene in crate::scene::SCENES {
        let list = crate::scene::Scene::built_in(scene.name).unwrap().method_list();
        for theme in [Theme::Dark, Theme::Light] {
            let orange = theme.palette().methods[euler];
            for lane in &list {
                let is_orange = theme.lane_style(&list, lane).0 == orange;
                assert_eq!(is_orange, is_euler(lane.method), "{}: {}", scene.name, lane.method.id);
            }
        }
    }
    assert!((0..300).all(|i| own_style(&format!("method-{i}")).0 != euler));
}

#[test]
fn euler_and_adaptive_euler_have_distant_colours_in_both_themes() {
    for (theme, least) in [(Theme::Dark, 30.0), (Theme::Light, 40.0)] {
        let [euler, adaptive] = ["explicit-euler", "adaptive-euler"]
            .map(|id| theme.style(crate::sim::integrators::method(id).unwrap()).0);
        let apart = distance_seen(euler, adaptive, MOST_PEOPLE);
        assert!(apart > least && apart < 100.0, "{theme:?}: {apart}");
    }
}
