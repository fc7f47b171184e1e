//! The words of verdicts in the manual and in other tests.

use regatta::manual::chapter;
use regatta::measure::{CRITERIA, Outcome, Severity, Sign, Verdict};
use regatta::studio::{KEYS, Key};

/// The word, the number and the details of a verdict.
pub(crate) fn everything(verdict: &Verdict) -> String {
    [vec![verdict.to_string()], verdict.details()].concat().join("; ")
}

#[test]
fn each_outcome_has_the_sign_and_colour_of_its_criterion() {
    use Severity::{Bad, Doubtful, Fair, Fine, Unknown};
    use Sign::{Cross, Diamond, Disc, Falling, Ring, Rising};
    let wanted = [
        (Disc, Fine),
        (Disc, Fine),
        (Disc, Fair),
        (Ring, Unknown),
        (Ring, Unknown),
        (Diamond, Doubtful),
        (Falling, Bad),
        (Rising, Bad),
        (Cross, Bad),
        (Cross, Bad),
    ];
    let found = Outcome::ALL.map(|outcome| (outcome.sign(), outcome.severity()));
    assert_eq!(found, wanted);
    assert!(Outcome::ALL.is_sorted());
    for outcome in Outcome::ALL {
        assert_eq!(outcome.id(), outcome.text().replace(' ', "-"));
    }
    for criterion in CRITERIA {
        assert_eq!(criterion.outcome().id(), criterion.id());
    }
    let glyphs = [Disc, Diamond, Rising, Falling, Cross, Ring].map(Sign::glyph);
    assert_eq!(glyphs.concat(), "●◆▲▼×○");
}

#[test]
fn the_manual_has_the_table_of_verdicts() {
    let commands = chapter("commands").unwrap().text;
    for outcome in Outcome::ALL.into_iter().skip(1) {
        let row =
            format!("| {} | `{}` | {} |", outcome.sign().glyph(), outcome.id(), outcome.about());
        assert!(commands.contains(&row), "{row}");
    }
}

#[test]
fn the_manual_and_the_list_of_keys_agree_on_escape() {
    let escape = KEYS.iter().find(|binding| binding.shown == "Esc").unwrap();
    let row = format!("| `Esc` | {} |", escape.about);
    assert!(chapter("keys").unwrap().text.contains(&row), "{row}");
}

#[test]
fn the_manual_mentions_every_letter_key() {
    let keys = chapter("keys").unwrap().text;
    let letters = KEYS.iter().flat_map(|binding| binding.keys).filter_map(|(key, _)| match key {
        Key::Sign(sign) if sign.is_alphabetic() => Some(sign.to_ascii_uppercase()),
        _ => None,
    });
    let missing: String = letters.filter(|letter| !keys.contains(&format!("`{letter}`"))).collect();
    assert_eq!(missing, "", "src/manual/keys.md leaves them out");
}
