//! Tests of the cards that run no method.

use std::collections::HashSet;

use regatta::sim::integrators::{Family, GENERAL_METHODS, METHODS, Method, method};

#[test]
fn ids_and_names_are_unique_and_found() {
    let ids: HashSet<_> = METHODS.iter().map(|card| card.id).collect();
    let names: HashSet<_> = METHODS.iter().map(|card| card.name).collect();
    let spellings: Vec<_> = METHODS.iter().flat_map(Method::spellings).collect();
    let distinct: HashSet<_> = spellings.iter().map(|(spelling, _)| spelling).collect();
    assert_eq!(distinct.len(), spellings.len(), "{spellings:?}");
    assert_eq!((ids.len(), names.len()), (METHODS.len(), METHODS.len()));
    for card in METHODS {
        assert!(std::ptr::eq(method(card.id).unwrap(), card), "{}", card.id);
    }
    assert!(method("rk5").is_none());
}

#[test]
fn every_card_has_a_description_and_a_source() {
    for card in METHODS {
        assert!(card.about.len() > 20, "{}", card.id);
        if card.is_of_library() {
            // A version dates a library.
            assert!(card.source.contains(|c: char| c.is_ascii_digit()), "{}", card.id);
            continue;
        }
        let year = card.source.as_bytes().windows(4).any(|w| w.iter().all(u8::is_ascii_digit));
        assert!(year || card.source.contains("Bourg & Bywalec"), "{}: {}", card.id, card.source);
    }
}

#[test]
fn families_agree_with_the_other_fields() {
    for card in METHODS {
        let is_special = [Family::Follower, Family::Engine, Family::Gyro, Family::Interface]
            .contains(&card.family);
        assert_eq!(is_special, card.only.is_some(), "{}", card.id);
        assert_eq!(card.family == Family::Engine, card.engine.is_some(), "{}", card.id);
        let is_implicit = card.family == Family::Implicit;
        let is_linearised = card.family == Family::Linearised;
        let asks_at_will = card.tolerance.is_some() || is_implicit || is_linearised;
        assert_eq!(asks_at_will, card.evaluations.is_none(), "{}", card.id);
        if !card.is_as_printed() && !is_special && !is_linearised {
            let adaptive = card.family == Family::Adaptive;
            assert_eq!(adaptive, card.tolerance.is_some(), "{}", card.id);
            assert_eq!(adaptive || is_implicit, card.stability_limit.is_none(), "{}", card.id);
        }
        if !card.is_as_printed() && !is_implicit && !is_linearised && !is_special {
            assert_eq!(card.family == Family::Symplectic, card.symplectic, "{}", card.id);
        }
    }
}

#[test]
fn the_method_table_is_grouped_by_family_with_engines_last() {
    let mut families: Vec<Family> = METHODS.iter().map(|card| card.family).collect();
    families.dedup();
    let distinct: HashSet<_> = families.iter().map(|family| family.id()).collect();
    assert_eq!(families.len(), distinct.len(), "{families:?}");
    let last =
        [Family::AsPrinted, Family::Follower, Family::Engine, Family::Gyro, Family::Interface];
    assert_eq!(families[families.len() - 5..], last);
    let general = METHODS.iter().filter(|card| card.only.is_none());
    assert!(GENERAL_METHODS.iter().eq(general), "those for every body come first");
}
