//! Lists of mappings: under the headings of their families, with what is chosen in sight, by pointer and by keys.
#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "tests say what they expect by unwrapping"
)]

mod window_kit;

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use sixfold::mapping::{Family, MappingId};
use window_kit::{Ui, open_sized, settle, small};

/// The list of mappings that object and sky look up, opened at 800 x 600.
fn opened() -> Ui {
    let mut ui = open_sized(small(), 800.0, 600.0);
    ui.get_by_role_and_label(Role::ComboBox, "looked up by object and sky")
        .click();
    settle(&mut ui);
    ui
}

/// Left upper corners of what has a label, without the panels' tabs and the checkboxes of the panels.
fn corners(ui: &Ui, role: Role, label: &str) -> Vec<egui::Pos2> {
    let all = ui.query_all_by_label(label);
    let own = all.filter(|node| node.accesskit_node().role() == role);
    own.map(|node| node.rect().left_top()).collect()
}

#[test]
fn mappings_stand_under_the_headings_of_their_families() {
    let ui = opened();
    // The entries of the open list, from above.
    let mut entries: Vec<(f32, &str)> = Vec::new();
    let list = corners(&ui, Role::Button, "HEALPix")[0].x;
    for family in Family::ALL {
        let heading = corners(&ui, Role::Label, family.title());
        let near = heading.iter().filter(|at| (at.x - list).abs() < 20.0);
        // The panels' checkboxes stand below the same headings, farther down.
        let top = near.map(|at| at.y).fold(f32::INFINITY, f32::min);
        entries.push((top, family.title()));
        for map in family.mappings() {
            let name = map.info().name;
            let own = corners(&ui, Role::Button, name);
            let own = own.iter().find(|at| at.x == list).unwrap();
            entries.push((own.y, name));
        }
    }
    assert_eq!(entries.len(), Family::ALL.len() + MappingId::ALL.len());
    assert!(
        entries.windows(2).all(|pair| pair[0].0 < pair[1].0),
        "{entries:?}"
    );
    // Control: in the registry's order the families are mixed.
    let place = |map: &MappingId| {
        entries
            .iter()
            .position(|(_, name)| *name == map.info().name)
    };
    assert!(!MappingId::ALL.iter().map(place).is_sorted());
}

#[test]
fn what_is_chosen_is_in_sight_and_arrow_keys_start_there() {
    let mut ui = opened();
    let mapping = |ui: &Ui| ui.state().explorer().state().mapping;
    let before = mapping(&ui);
    assert_eq!(before, MappingId::Ccm);
    let list = corners(&ui, Role::Button, "HEALPix")[0].x;
    let place = |name: &str| {
        let all = corners(&ui, Role::Button, name);
        all.into_iter().find(|at| at.x == list).unwrap().y
    };
    let own = place(before.info().name);
    assert!((120.0..500.0).contains(&own), "{own}");
    // Control: the list is longer than what is in sight.
    assert!(place("Latlong") < 120.0 && place("HEALPix") > 500.0);

    let probe = ui.state().explorer().state().probe;
    for _ in 0..2 {
        ui.key_press(egui::Key::ArrowDown);
        settle(&mut ui);
    }
    assert_eq!(mapping(&ui), before, "nothing is chosen yet");
    ui.key_press(egui::Key::Enter);
    settle(&mut ui);
    assert_eq!(mapping(&ui), MappingId::Tangent);
    assert_eq!(ui.state().explorer().state().probe, probe);
}
