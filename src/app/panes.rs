//! The arrangement: the viewport and one panel a mapping as tiles that can be moved, hidden and maximised.

use egui_tiles::{
    Behavior, Container, SimplificationOptions, Tile, TileId, Tiles, Tree, UiResponse,
};

use super::action::Action;
use super::arrangement::{Arrangement, Pane};
use super::model::Model;
use super::state::AppState;
use super::{
    budget_panel, curves, fold, laboratory, loss_panel, map_panel, ranking, sampling,
    stability_panel, story, viewport,
};

/// The first arrangement: the viewport above a grid of the open panels.
pub fn first_tree(state: &AppState) -> Tree<Pane> {
    let mut tiles = Tiles::default();
    let viewport = tiles.insert_pane(Pane::Viewport);
    let maps: Vec<TileId> = state
        .open_panels()
        .map(|mapping| tiles.insert_pane(Pane::Map(mapping)))
        .collect();
    let grid = tiles.insert_grid_tile(maps);
    let root = tiles.insert_vertical_tile(vec![viewport, grid]);
    if let Some(Tile::Container(Container::Linear(linear))) = tiles.get_mut(root) {
        linear.shares.set_share(viewport, 1.15);
        linear.shares.set_share(grid, 1.0);
    }
    Tree::new(tree_id(), root, tiles)
}

/// The saved arrangement, or the first one where none was saved.
pub fn tree_of(state: &AppState) -> Tree<Pane> {
    let saved = state
        .arrangement
        .as_ref()
        .and_then(|saved| saved.to_tree(tree_id()));
    let mut tree = saved.unwrap_or_else(|| first_tree(state));
    follow(&mut tree, state);
    tree
}

fn tree_id() -> egui::Id {
    egui::Id::unique("panes")
}

/// Adds the panels that were opened and takes away those that were hidden.
pub fn follow(tree: &mut Tree<Pane>, state: &AppState) {
    if find(tree, Pane::Viewport).is_none() {
        *tree = first_tree(state);
    }
    let maps = state.panels.iter().map(|panel| Pane::Map(panel.mapping));
    for pane in maps.chain(Pane::READ) {
        match (state.is_open(pane), find(tree, pane)) {
            (true, None) => insert(tree, pane),
            (false, Some(id)) => {
                tree.remove_recursively(id);
            }
            _ => {}
        }
    }
}

fn find(tree: &Tree<Pane>, pane: Pane) -> Option<TileId> {
    tree.tiles.find_pane(&pane)
}

/// Puts a map beside the last map, or below everything; what needs height to be read, in a column beside all.
fn insert(tree: &mut Tree<Pane>, pane: Pane) {
    if !matches!(pane, Pane::Map(_))
        && let Some(there) = Arrangement::of_tree(tree)
    {
        let other = Pane::READ.into_iter().find(|other| there.holds(*other));
        let changed = match other {
            Some(other) => there.with_below(other, pane),
            None => there.with_column(pane),
        };
        if let Some(changed) = changed.to_tree(tree_id()) {
            *tree = changed;
            return;
        }
    }
    let id = tree.tiles.insert_pane(pane);
    let grids: Vec<TileId> = tree
        .tiles
        .iter()
        .filter(|(_, tile)| matches!(tile, Tile::Container(Container::Grid(_))))
        .map(|(id, _)| *id)
        .collect();
    let place = grids.first().copied().or(tree.root());
    match place {
        Some(container) => tree.move_tile_to_container(id, container, usize::MAX, true),
        None => tree.root = Some(id),
    }
}

/// Shows the tiles, or one pane alone.
pub fn panes_ui(ui: &mut egui::Ui, model: &mut Model<'_>, tree: &mut Tree<Pane>) {
    if let Some(pane) = model.state.maximised {
        ui.horizontal_wrapped(|ui| {
            ui.strong(pane.name());
            if ui.button("Show all panels").clicked() {
                model.push(Action::SetMaximised(None));
            }
        });
        pane_ui(ui, model, pane);
        return;
    }
    tree.ui(&mut PaneBehavior { model }, ui);
}

/// Shows what a pane holds.
pub(super) fn pane_ui(ui: &mut egui::Ui, model: &mut Model<'_>, pane: Pane) {
    model.seen.push(pane);
    match pane {
        Pane::Viewport => viewport::viewport_ui(ui, model),
        Pane::Map(mapping) => map_panel::map_panel_ui(ui, model, mapping),
        Pane::Curves => curves::curves_ui(ui, model),
        Pane::Story => story::story_ui(ui, model),
        Pane::Loss => loss_panel::loss_ui(ui, model),
        Pane::Stability => stability_panel::stability_ui(ui, model),
        Pane::Budget => budget_panel::budget_ui(ui, model),
        Pane::Laboratory => laboratory::laboratory_ui(ui, model),
        Pane::Fold => fold::fold_ui(ui, model),
        Pane::Ranking => ranking::ranking_ui(ui, model),
        Pane::Sampling => sampling::sampling_ui(ui, model),
    }
}

struct PaneBehavior<'a, 'm> {
    model: &'a mut Model<'m>,
}

impl Behavior<Pane> for PaneBehavior<'_, '_> {
    fn pane_ui(&mut self, ui: &mut egui::Ui, _: TileId, pane: &mut Pane) -> UiResponse {
        pane_ui(ui, self.model, *pane);
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> egui::WidgetText {
        pane.name().into()
    }

    fn is_tab_closable(&self, tiles: &Tiles<Pane>, tile: TileId) -> bool {
        matches!(tiles.get(tile), Some(Tile::Pane(pane)) if *pane != Pane::Viewport)
    }

    fn on_tab_close(&mut self, tiles: &mut Tiles<Pane>, tile: TileId) -> bool {
        if let Some(Tile::Pane(pane)) = tiles.get(tile) {
            self.model.push(Action::SetPaneOpen(*pane, false));
        }
        false // the tile goes when the state says so
    }

    fn top_bar_right_ui(
        &mut self,
        tiles: &Tiles<Pane>,
        ui: &mut egui::Ui,
        _: TileId,
        tabs: &egui_tiles::Tabs,
        _: &mut f32,
    ) {
        let Some(Tile::Pane(pane)) = tabs.active.and_then(|id| tiles.get(id)) else {
            return;
        };
        let name = format!("Maximise {}", pane.name());
        let (rect, response) = ui.allocate_exact_size(egui::vec2(16.0, 16.0), egui::Sense::click());
        let color = ui.style().interact(&response).fg_stroke.color;
        let frame = egui::Rect::from_center_size(rect.center(), egui::vec2(9.0, 9.0));
        let stroke = egui::Stroke::new(1.2, color);
        ui.painter()
            .rect_stroke(frame, 1.0, stroke, egui::StrokeKind::Middle);
        ui.painter()
            .line_segment([frame.left_top(), frame.right_top()], (2.4, color));
        let response = response.on_hover_text(&name);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name.as_str()));
        if response.clicked() {
            self.model.push(Action::SetMaximised(Some(*pane)));
        }
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions {
            all_panes_must_have_tabs: true,
            ..Default::default()
        }
    }

    fn tab_bar_height(&self, _: &egui::Style) -> f32 {
        20.0
    }

    fn gap_width(&self, _: &egui::Style) -> f32 {
        3.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::arrangement::Arrangement;
    use crate::mapping::MappingId;

    #[test]
    fn the_tree_follows_the_state_and_survives_its_file() {
        let mut state = AppState::default();
        let mut tree = tree_of(&state);
        let shown = |tree: &Tree<Pane>| {
            MappingId::ALL
                .iter()
                .filter(|m| find(tree, Pane::Map(**m)).is_some())
                .count()
        };
        assert_eq!(shown(&tree), 6);
        state.panel_mut(MappingId::Eac).unwrap().open = true;
        state.panel_mut(MappingId::Latlong).unwrap().open = false;
        state.panel_mut(MappingId::Sphere).unwrap().open = false;
        follow(&mut tree, &state);
        assert_eq!(shown(&tree), 5);
        assert!(find(&tree, Pane::Map(MappingId::Eac)).is_some());
        assert!(find(&tree, Pane::Map(MappingId::Latlong)).is_none());
        state.arrangement = Arrangement::of_tree(&tree);
        assert_eq!(shown(&tree_of(&state)), 5);
        // What is read stands in a column beside all, one below the other.
        state.curves_open = true;
        state.story.open = true;
        follow(&mut tree, &state);
        let above = |id| tree.tiles.parent_of(id);
        let parent = |pane| above(find(&tree, pane).unwrap());
        assert_eq!(parent(Pane::Curves), parent(Pane::Story));
        assert_eq!(above(parent(Pane::Curves).unwrap()), tree.root());
        assert_ne!(parent(Pane::Curves), parent(Pane::Viewport));
        assert_eq!(shown(&tree), 5);
        // An arrangement without the viewport falls back to the first one.
        state.arrangement = Some(Arrangement::Pane(Pane::Map(MappingId::Cube)));
        assert!(find(&tree_of(&state), Pane::Viewport).is_some());
    }
}
