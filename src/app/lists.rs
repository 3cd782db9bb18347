//! Lists to choose from, in panes that may be narrow.

use egui::{ComboBox, Ui};

/// A list to choose from, with its name before it.
pub fn list_ui<T: PartialEq + Clone>(
    ui: &mut Ui,
    label: &str,
    now: &mut T,
    options: impl IntoIterator<Item = T>,
    name: impl Fn(&T) -> String,
) {
    /// Width of a short name; longer ones take more where there is room.
    const WIDTH: f32 = 90.0;
    let text = ui.label(label);
    ComboBox::from_id_salt(("list", label))
        .width(WIDTH.min(ui.available_width()))
        .height(420.0)
        .selected_text(name(now))
        .show_ui(ui, |ui| {
            for option in options {
                let title = name(&option);
                ui.selectable_value(now, option, title);
            }
        })
        .response
        .labelled_by(text.id);
}
