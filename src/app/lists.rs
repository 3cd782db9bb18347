//! Lists to choose from, in panes that may be narrow. Mappings stand in them under the headings of their families.

use egui::{Align, ComboBox, RichText, ScrollArea, TextStyle, Ui};

use super::narrow::{next_line_unless, text_width};
use crate::mapping::{Family, MappingId};

/// Height of a list that is open, in points: more is scrolled.
pub const HEIGHT: f32 = 420.0;

/// A list to choose from, with its name before it, on one line; a choice that is longer wraps.
pub fn list_ui<T: PartialEq + Clone>(
    ui: &mut Ui,
    label: &str,
    now: &mut T,
    options: impl IntoIterator<Item = T>,
    name: impl Fn(&T) -> String,
) {
    grouped_list_ui(ui, label, now, options, name, |_| None);
}

/// The same of what belongs to mappings' families.
pub fn grouped_list_ui<T: PartialEq + Clone>(
    ui: &mut Ui,
    label: &str,
    now: &mut T,
    options: impl IntoIterator<Item = T>,
    name: impl Fn(&T) -> String,
    family: impl Fn(&T) -> Option<Family>,
) {
    /// Width of a short name; longer ones take more where there is room.
    const WIDTH: f32 = 90.0;
    let chosen = name(now);
    let spacing = ui.spacing();
    let around = 2.0 * spacing.button_padding.x + spacing.icon_spacing + spacing.icon_width;
    let gap = spacing.item_spacing.x;
    let button = (text_width(ui, &chosen, TextStyle::Button) + around).max(WIDTH);
    let whole = text_width(ui, label, TextStyle::Body) + gap + button;
    next_line_unless(ui, whole);
    // In a layout that does not wrap the list stays with its name.
    ui.horizontal(|ui| {
        let text = ui.label(label);
        ComboBox::from_id_salt(("list", label))
            .width(WIDTH.min(ui.available_width()))
            .wrap()
            .height(HEIGHT)
            .selected_text(&chosen)
            .show_ui(ui, |ui| entries_ui(ui, now, options, name, family))
            .response
            .labelled_by(text.id)
    });
}

/// The entries of an open list: first those of no family, then each family's under its heading. When the list opens, what is chosen is in
/// sight and has the focus, so that the arrow keys start there.
pub fn entries_ui<T: PartialEq + Clone>(
    ui: &mut Ui,
    now: &mut T,
    options: impl IntoIterator<Item = T>,
    name: impl Fn(&T) -> String,
    family: impl Fn(&T) -> Option<Family>,
) {
    let opens = has_just_opened(ui);
    grouped_ui(ui, options, family, |ui, option| {
        let is_chosen = option == *now;
        let title = name(&option);
        let entry = ui.selectable_value(now, option, title);
        if opens && is_chosen {
            entry.scroll_to_me(Some(Align::Center));
            entry.request_focus();
        } else if entry.gained_focus() {
            entry.scroll_to_me(None);
        }
    });
}

/// All mappings as the entries of an open list.
pub fn mapping_entries_ui(ui: &mut Ui, now: &mut MappingId) {
    let all = MappingId::ALL.iter().copied();
    let name = |map: &MappingId| map.info().name.to_owned();
    entries_ui(ui, now, all, name, |map| Some(map.info().family));
}

/// Things under the headings of their families, which are left out where there is nothing; in front of them what has none.
pub fn grouped_ui<T>(
    ui: &mut Ui,
    options: impl IntoIterator<Item = T>,
    family: impl Fn(&T) -> Option<Family>,
    mut entry_ui: impl FnMut(&mut Ui, T),
) {
    let mut options: Vec<T> = options.into_iter().collect();
    for group in std::iter::once(None).chain(Family::ALL.map(Some)) {
        let own: Vec<T> = options
            .extract_if(.., |option| family(option) == group)
            .collect();
        if let Some(family) = group.filter(|_| !own.is_empty()) {
            heading_ui(ui, family);
        }
        own.into_iter().for_each(|option| entry_ui(ui, option));
    }
}

fn heading_ui(ui: &mut Ui, family: Family) {
    ui.add_space(4.0);
    ui.label(RichText::new(family.title()).small().strong());
}

/// What may be too high for the window, in a menu.
pub fn scrolled_ui(ui: &mut Ui, content: impl FnOnce(&mut Ui)) {
    // What lies above the menu and a margin below it.
    let room = ui.ctx().content_rect().bottom() - ui.cursor().top() - 12.0;
    let area = ScrollArea::vertical().max_height(room.clamp(60.0, HEIGHT));
    area.show(ui, content);
}

/// Whether this part of the window was not drawn in the pass before.
fn has_just_opened(ui: &Ui) -> bool {
    let (id, pass) = (ui.scope_id().with("opened"), ui.ctx().cumulative_pass_nr());
    let before = ui.data_mut(|data| data.get_temp::<u64>(id));
    ui.data_mut(|data| data.insert_temp(id, pass));
    before.is_none_or(|before| before + 1 < pass)
}
