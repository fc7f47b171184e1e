use super::*;
use crate::compose;
use crate::scene::Scene;
use crate::studio::{HeldBody, RunCommand, StageCommand, ViewCommand};

/// The words beside the body's name. Asserts that they end before the chip.
fn beside_name_of(studio: &Studio, width: f32) -> Option<String> {
    let picture = compose(studio, [width, 460.0]);
    let chip = picture.labels.iter().find(|label| label.text == "▲").expect("a chip");
    let name = picture.labels.iter().find(|label| label.text == "Spring").expect("a name");
    let is_beside = |label: &&Label| label.size == 12.5 && label.at[1] == name.at[1] + 0.5;
    let beside = picture.labels.iter().find(is_beside)?;
    let right = beside.at[0] + LETTER * beside.text.chars().count() as f32;
    assert!(right < chip.at[0] - 11.0, "{} ends at {right} of {width}", beside.text);
    Some(beside.text.clone())
}

#[test]
fn text_beside_a_name_ends_before_the_chip_even_while_a_body_is_held() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.analyse();
    (0..60).for_each(|_| studio.tick());
    let promise = Some("should keep to ±1 m".to_owned());
    assert_eq!(beside_name_of(&studio, 780.0), promise);
    assert_eq!(beside_name_of(&studio, 300.0), None, "no room for both");
    let lane = studio.selected().id;
    let mut in_narrow = 0;
    for power in -20..30 {
        let at = -1.2345 * libm::exp10(f64::from(power));
        let (q, v, hand) = ([at].into(), [0.0].into(), DVec2::new(at, 0.0));
        studio.apply(RunCommand::Hold(HeldBody { lane, body: 0, q, v, hand, handle: hand }));
        let words = beside_name_of(&studio, 780.0).expect("room for both");
        assert!(words.starts_with("x = −") && words.ends_with(" m"), "{power}: {words}");
        in_narrow += usize::from(beside_name_of(&studio, 480.0).is_some());
    }
    assert!((1..49).contains(&in_narrow), "{in_narrow}");
    studio.apply(ViewCommand::LetGo);
    assert_eq!(beside_name_of(&studio, 780.0), promise);
}

#[test]
fn the_chip_of_an_edited_run_is_of_what_follows_the_edit() {
    let words = |studio: &Studio, size| -> Vec<String> {
        let labels = compose(studio, size).labels.into_iter().map(|label| label.text);
        labels.filter(|text| text.contains("blow")).collect()
    };
    for ticks in [0, 20] {
        let mut studio = Studio::new(Scene::built_in("stiff").unwrap());
        (0..ticks).for_each(|_| studio.tick());
        studio.apply(StageCommand::TickHz(49.into()));
        studio.analyse();
        (0..20).for_each(|_| studio.tick());
        let [wide, narrow] = [[960.0, 560.0], [470.0, 330.0]].map(|size| words(&studio, size));
        (0..300).for_each(|_| studio.tick());
        let halt = studio.selected().lane.bodies()[0].halted().expect("it blows up");
        assert!((4.0..5.0).contains(&halt.t), "changed at {ticks}: {}", halt.t);
        let at = significant(halt.t, 3);
        assert_eq!(wide, [format!("blows up · at {at} s")], "changed at {ticks}");
        assert_eq!(narrow, wide, "changed at {ticks}");
    }
}
