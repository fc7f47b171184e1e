//! Which coordinates the plots show, and so which the run records.

use super::deck::Deck;
use super::viewer::Viewer;

/// Shows this coordinate of a body in the plots; where the run so far is too long to be run again for it, from the
/// next restart on.
pub(super) fn plot_coordinate(
    deck: &mut Deck,
    viewer: &mut Viewer,
    body: usize,
    coordinate: usize,
) {
    let Some(of) = deck.race().truth().bodies().get(body) else { return };
    let Some(chosen) = of.coordinates().get(coordinate) else { return };
    let name = chosen.name;
    viewer.view.choose_coordinate(body, coordinate);
    if record_chosen_coordinates(deck, viewer) {
        return deck.run.show_present();
    }
    viewer.set_notice(format!("{name} is plotted from the next restart on: press Home"));
}

/// Records the coordinates that a person has chosen, and of other bodies the usual ones. Returns whether it could.
pub(super) fn record_chosen_coordinates(deck: &mut Deck, viewer: &mut Viewer) -> bool {
    let chosen = &viewer.view.coordinates;
    let coordinate = |(index, usual): (usize, usize)| {
        let count = deck.race().truth().bodies()[index].coordinates().len();
        let chosen = chosen.get(index).copied().flatten();
        chosen.filter(|&index| index < count).unwrap_or(usual)
    };
    let bodies = deck.race().truth().bodies().iter();
    let usual = bodies.map(|body| body.plotted_coordinate()).enumerate();
    let coordinates: Vec<usize> = usual.map(coordinate).collect();
    deck.run.record_coordinates(&coordinates)
}
