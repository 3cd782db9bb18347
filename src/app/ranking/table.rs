//! The table: a line for each mapping, a column for each criterion. Names and heads stay where they are while the rest scrolls.

use std::cmp::Ordering;

use egui::{Align2, Checkbox, Color32, FontId, Rect, Response, Sense, Ui, Vec2, pos2, vec2};
use egui_plot::MarkerShape;

use super::entry::{Entry, NO_COST, NONE, TO_COME, corner};
use super::panel::set;
use crate::app::action::Action;
use crate::app::laboratory::paint_marker;
use crate::app::model::Model;
use crate::app::state::{MOST_COMPARED, RankingColumn};
use crate::app::theme;
use crate::lab::metrics::UNBOUNDED;
use crate::lab::ranking::{Criterion, compare};
use crate::mapping::MappingId;

/// Height of a line, and size of its letters.
const LINE: f32 = 17.0;
const LETTER: f32 = 11.5;
/// Room for the mark of the column that sorts.
const MARK: f32 = 12.0;
/// Room for a checkbox.
const BOX: f32 = 20.0;
/// From this width on mappings are called by their names, below by their short ones.
const NAMED: f32 = 420.0;
/// What is of less interest.
const QUIET: Color32 = Color32::from_gray(150);

/// The columns that scroll.
fn columns() -> impl Iterator<Item = RankingColumn> {
    let criteria = Criterion::ALL.into_iter().map(RankingColumn::By);
    std::iter::once(RankingColumn::Score)
        .chain(criteria)
        .chain([RankingColumn::Claims])
}

fn title(column: RankingColumn) -> &'static str {
    match column {
        RankingColumn::Mapping => "mapping",
        RankingColumn::Score => "score",
        RankingColumn::By(criterion) => criterion.name(),
        RankingColumn::Claims => "promises",
    }
}

fn about(column: RankingColumn) -> String {
    match column {
        RankingColumn::Mapping => "Its name; a click on one opens it.".to_owned(),
        RankingColumn::Score => {
            "Place by area and shape as they are weighed above, and the score: 0 is perfect, ln 2 = 0.693 twice as bad as that; what is unbounded comes last.".to_owned()
        }
        RankingColumn::By(criterion) => match corner(criterion) {
            Some(corner) => format!("{}\n{}", criterion.about(), corner.reason),
            None => criterion.about().to_owned(),
        },
        RankingColumn::Claims => {
            "Equal-area: equal parts of the map are equal solid angles. Conformal: angles are kept. Continuous: both sides divide a seam alike.".to_owned()
        }
    }
}

fn width(column: RankingColumn) -> f32 {
    match column {
        RankingColumn::Mapping => 0.0,
        RankingColumn::Score => 78.0,
        RankingColumn::By(Criterion::Area) => 88.0,
        RankingColumn::By(Criterion::Cost) => 148.0,
        RankingColumn::By(_) => 74.0,
        RankingColumn::Claims => 158.0,
    }
}

fn text(entry: &Entry<'_>, column: RankingColumn) -> String {
    match column {
        RankingColumn::Mapping => entry.map.info().name.to_owned(),
        RankingColumn::Score => match entry.placed {
            Some(placed) if placed.score.is_finite() => {
                format!("{}.  {:.3}", placed.place, placed.score)
            }
            Some(_) => UNBOUNDED.to_owned(),
            None => TO_COME.to_owned(),
        },
        RankingColumn::By(criterion) => entry.text(criterion),
        RankingColumn::Claims => entry.claims(),
    }
}

/// In the order of a column, by what `entries` come in where that does not decide.
fn sort(entries: &mut [Entry<'_>], column: RankingColumn, descending: bool) {
    let turned = |order: Ordering| if descending { order.reverse() } else { order };
    match column {
        RankingColumn::Mapping => {
            entries.sort_by(|a, b| turned(a.map.info().name.cmp(b.map.info().name)));
        }
        RankingColumn::Claims => {
            let claims = |entry: &Entry<'_>| {
                let claims = entry.map.info().claims;
                [!claims.equal_area, !claims.conformal, !claims.continuous]
            };
            entries.sort_by(|a, b| turned(claims(a).cmp(&claims(b))));
        }
        RankingColumn::Score => {
            let place = |entry: &Entry<'_>| {
                let placed = entry.placed?;
                let place = placed.place as f64;
                Some(if placed.score.is_finite() {
                    place
                } else {
                    f64::INFINITY
                })
            };
            entries.sort_by(|a, b| compare(place(a), place(b), descending));
        }
        RankingColumn::By(criterion) => {
            let known = entries.iter().filter_map(|entry| {
                let value = entry.value(criterion)?;
                Some((entry.map, value))
            });
            let (maps, values): (Vec<MappingId>, Vec<f64>) = known.unzip();
            let ranks = criterion.ranks(&values);
            let rank = |entry: &Entry<'_>| {
                let known = maps.iter().position(|map| *map == entry.map);
                known.map(|k| ranks[k])
            };
            entries.sort_by(|a, b| compare(rank(a), rank(b), descending));
        }
    }
}

/// The table, `height` high: a click on a head sorts, one on a name opens the mapping, a box chooses it to be compared.
pub fn table_ui(ui: &mut Ui, model: &mut Model<'_>, entries: &[Entry<'_>], height: f32) {
    let ranking = &model.state.ranking;
    let mut sorted = entries.to_vec();
    // Equal scores in the order of what breaks their tie.
    sorted.sort_by(|a, b| {
        let tie = |entry: &Entry<'_>| {
            entry
                .metrics
                .map(|metrics| ranking.basis.score(metrics, 0.5))
        };
        match ranking.sort {
            RankingColumn::Score => compare(tie(a), tie(b), false),
            _ => Ordering::Equal,
        }
    });
    sort(&mut sorted, ranking.sort, ranking.descending);
    let is_named = ui.available_width() >= NAMED;
    let name = |entry: &Entry<'_>| {
        if is_named {
            entry.map.info().name
        } else {
            entry.map.info().id
        }
    };
    let font = FontId::proportional(LETTER);
    let widths = entries.iter().map(|entry| {
        let galley = ui
            .painter()
            .layout_no_wrap(name(entry).to_owned(), font.clone(), QUIET);
        galley.size().x
    });
    let names = BOX + widths.fold(0.0, f32::max) + 10.0;
    let total = vec2(
        names + columns().map(width).sum::<f32>() + 8.0,
        LINE * (sorted.len() + 1) as f32,
    );
    let scroll = egui::ScrollArea::both()
        .id_salt("ranking")
        .auto_shrink([false, false])
        .max_height(height);
    scroll.show(ui, |ui| {
        ui.set_min_size(total);
        let (seen, origin) = (ui.clip_rect(), ui.max_rect().min);
        let left = seen.left().max(origin.x);
        let top = seen.top().max(origin.y);
        let body = Rect::from_min_max(pos2(left + names, top + LINE), seen.max);
        let line = |k: usize| origin.y + LINE * (k + 1) as f32;
        let clipped = |ui: &mut Ui, clip: Rect, with: &mut dyn FnMut(&mut Ui)| {
            let mut child = ui.new_child(egui::UiBuilder::new().max_rect(clip));
            child.set_clip_rect(clip.intersect(seen));
            with(&mut child);
        };
        clipped(ui, body, &mut |ui| {
            for (k, entry) in sorted.iter().enumerate() {
                cells_ui(ui, entry, pos2(origin.x + names, line(k)));
            }
        });
        let side = Rect::from_min_max(pos2(left, top + LINE), pos2(left + names, seen.bottom()));
        clipped(ui, side, &mut |ui| {
            for (k, entry) in sorted.iter().enumerate() {
                let rect = Rect::from_min_size(pos2(left, line(k)), vec2(names, LINE));
                name_ui(ui, model, entry, name(entry), rect);
            }
        });
        let heads = Rect::from_min_max(pos2(left + names, top), pos2(seen.right(), top + LINE));
        clipped(ui, heads, &mut |ui| {
            let mut x = origin.x + names;
            for column in columns() {
                let rect = Rect::from_min_size(pos2(x, top), vec2(width(column), LINE));
                head_ui(ui, model, column, rect);
                x += width(column);
            }
        });
        let corner = Rect::from_min_size(pos2(left, top), vec2(names, LINE));
        clipped(ui, corner, &mut |ui| {
            head_ui(
                ui,
                model,
                RankingColumn::Mapping,
                corner.with_min_x(left + BOX),
            );
        });
    });
}

/// The numbers of a mapping.
fn cells_ui(ui: &mut Ui, entry: &Entry<'_>, at: egui::Pos2) {
    let mut x = at.x;
    for column in columns() {
        let rect = Rect::from_min_size(pos2(x, at.y), vec2(width(column), LINE));
        x += width(column);
        let seen = rect.intersect(ui.clip_rect());
        if !seen.is_positive() {
            continue;
        }
        let text = text(entry, column);
        let is_quiet = [UNBOUNDED, TO_COME, NONE].contains(&text.as_str());
        let color = if is_quiet {
            QUIET
        } else {
            ui.visuals().text_color()
        };
        paint_text(ui, rect, column, &text, color);
        let id = ui.scope_id().with((entry.map, title(column)));
        let response = ui.interact(seen, id, Sense::hover());
        let label = format!("{}, {}: {text}", entry.map.info().id, title(column));
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &label));
        let hint = match column {
            RankingColumn::By(Criterion::ShapeMax) => entry.corner_text(),
            RankingColumn::By(Criterion::Cost) if entry.cost.is_none() => Some(NO_COST),
            _ => None,
        };
        if let Some(hint) = hint {
            response.on_hover_text(hint);
        }
    }
}

/// Words at the left, numbers at the right; where they were painted.
fn paint_text(ui: &Ui, rect: Rect, column: RankingColumn, text: &str, color: Color32) -> Rect {
    let font = FontId::proportional(LETTER);
    let (anchor, at) = match column {
        RankingColumn::Mapping => (Align2::LEFT_CENTER, rect.left_center() + vec2(3.0, 0.0)),
        RankingColumn::Claims => (Align2::LEFT_CENTER, rect.left_center() + vec2(14.0, 0.0)),
        _ => (Align2::RIGHT_CENTER, rect.right_center()),
    };
    ui.painter().text(at, anchor, text, font, color)
}

/// A head: a click sorts by it, another turns the order.
fn head_ui(ui: &mut Ui, model: &mut Model<'_>, column: RankingColumn, rect: Rect) {
    let mut ranking = model.state.ranking.clone();
    let is_sorted = ranking.sort == column;
    let color = if is_sorted {
        theme::TEXEL
    } else {
        Color32::WHITE
    };
    let label = format!("Sort by {}", title(column));
    let response = press(ui, rect, &label, false);
    // Numbers stand at the right of their columns, so there the mark has a place of its own.
    let room = if is_sorted { MARK } else { 0.0 };
    let place = rect.with_max_x(rect.right() - room);
    let drawn = paint_text(ui, place, column, title(column), color);
    if is_sorted {
        let at = pos2(drawn.right() + 0.5 * MARK, drawn.center().y);
        let shape = if ranking.descending {
            MarkerShape::Down
        } else {
            MarkerShape::Up
        };
        paint_marker(ui.painter(), at, shape, color);
    }
    if response.clicked() {
        ranking.descending = is_sorted && !ranking.descending;
        ranking.sort = column;
        set(model, ranking);
    }
    response.on_hover_text(about(column));
}

/// A mapping's box and name.
fn name_ui(ui: &mut Ui, model: &mut Model<'_>, entry: &Entry<'_>, name: &str, rect: Rect) {
    let mut ranking = model.state.ranking.clone();
    let info = entry.map.info();
    let mut is_compared = ranking.compared.contains(&entry.map);
    let is_full = !is_compared && ranking.compared.len() == MOST_COMPARED;
    let place = Rect::from_min_size(rect.min, vec2(BOX, LINE));
    let checkbox = ui
        .push_id((info.id, "box"), |ui| {
            ui.spacing_mut().icon_width = 13.0;
            ui.add_enabled_ui(!is_full, |ui| {
                ui.put(place, Checkbox::without_text(&mut is_compared))
            })
            .inner
        })
        .inner;
    let label = format!("Compare {}", info.name);
    checkbox.widget_info(|| {
        egui::WidgetInfo::selected(egui::Role::CheckBox, !is_full, is_compared, &label)
    });
    if checkbox.changed() {
        ranking.compared.retain(|map| *map != entry.map);
        if is_compared {
            ranking.compared.push(entry.map);
        }
        set(model, ranking);
    }
    checkbox
        .on_hover_text("Compare it with others")
        .on_disabled_hover_text(format!(
            "{MOST_COMPARED} are compared already: untick one first"
        ));
    let rect = rect.with_min_x(rect.left() + BOX);
    let label = format!("Open {}", info.name);
    let response = press(ui, rect, &label, model.state.mapping == entry.map);
    paint_text(
        ui,
        rect,
        RankingColumn::Mapping,
        name,
        ui.visuals().text_color(),
    );
    if response.clicked() {
        model.push(Action::OpenMapping(entry.map));
    }
    response.on_hover_text(info.about);
}

/// A place that can be clicked, also by keys, and comes into view with the keys' focus.
fn press(ui: &mut Ui, rect: Rect, label: &str, is_selected: bool) -> Response {
    let response = ui.interact(rect, ui.scope_id().with(label), Sense::click());
    let visuals = ui.style().interact_selectable(&response, is_selected);
    if is_selected || response.hovered() || response.has_focus() {
        let ground = rect.shrink2(Vec2::new(0.0, 0.5));
        ui.painter().rect_filled(ground, 2.0, visuals.weak_bg_fill);
    }
    if response.gained_focus() {
        response.scroll_to_me(None);
    }
    response
        .widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, is_selected, label));
    response
}
