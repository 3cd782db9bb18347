//! The open panels side by side, without anything around them: a picture that compares mappings.

use egui::{Align2, Color32, Rect, Ui, UiBuilder, pos2, vec2};

use super::map_panel::map_panel_ui;
use super::marks::edged_text;
use super::model::Model;
use super::theme;
use crate::mapping::MappingId;

/// Points between two panels.
const GAP: f32 = 4.0;

/// Cells for `count` panels, row by row: in so many columns that the cells come nearest to squares.
pub fn cells(count: usize, rect: Rect) -> Vec<Rect> {
    let off_square = |columns: usize| {
        let rows = count.div_ceil(columns);
        let shape = (rect.width() / columns as f32) / (rect.height() / rows as f32);
        shape.ln().abs()
    };
    let columns = (1..=count)
        .min_by(|a, b| off_square(*a).total_cmp(&off_square(*b)))
        .unwrap_or(1);
    let rows = count.div_ceil(columns).max(1);
    let size = vec2(rect.width() / columns as f32, rect.height() / rows as f32);
    let cell = |k: usize| {
        let at = vec2((k % columns) as f32, (k / columns) as f32) * size;
        Rect::from_min_size(rect.min + at, size).shrink(0.5 * GAP)
    };
    (0..count).map(cell).collect()
}

/// Shows them in all the space there is.
pub fn panels_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let open: Vec<MappingId> = model.state.open_panels().collect();
    let rect = ui.available_rect_before_wrap();
    if open.is_empty() {
        let (at, words) = (rect.center(), "no panel is open");
        edged_text(
            ui.painter(),
            at,
            Align2::CENTER_CENTER,
            words,
            Color32::WHITE,
        );
    }
    for (mapping, cell) in open.iter().zip(cells(open.len(), rect)) {
        /// Room for the name.
        const HEAD: f32 = 20.0;
        let at = cell.left_top() + vec2(4.0, 2.0);
        let name = mapping.info().name;
        edged_text(ui.painter(), at, Align2::LEFT_TOP, name, theme::PROBE);
        let below = Rect::from_min_max(pos2(cell.left(), cell.top() + HEAD), cell.max);
        map_panel_ui(
            &mut ui.new_child(UiBuilder::new().max_rect(below)),
            model,
            *mapping,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_fill_the_sheet_and_do_not_overlap() {
        let sheet = Rect::from_min_size(pos2(10.0, 20.0), vec2(600.0, 400.0));
        for count in 1..30 {
            let cells = cells(count, sheet);
            assert_eq!(cells.len(), count);
            for (k, cell) in cells.iter().enumerate() {
                assert!(sheet.contains_rect(*cell), "{count}");
                let is_apart = |other: &Rect| !cell.intersects(*other);
                assert!(cells[..k].iter().all(is_apart), "{count}");
            }
            let area: f32 = cells.iter().map(Rect::area).sum();
            assert!(area > 0.5 * sheet.area(), "{count}: {area}");
        }
        assert_eq!(
            cells(2, sheet)[0].height(),
            sheet.height() - GAP,
            "side by side"
        );
        assert!(cells(0, sheet).is_empty());
    }
}
