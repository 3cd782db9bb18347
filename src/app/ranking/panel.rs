//! The pane: what is weighed, the table, and a plot below it.

use egui::{Button, Label, RichText, Slider, Ui, vec2};

use super::bump::bump_ui;
use super::compare::compare_ui;
use super::entry::{Entry, entries};
use super::scatter::scatter_ui;
use super::table::table_ui;
use crate::app::action::Action;
use crate::app::command::Command;
use crate::app::lists::list_ui;
use crate::app::model::Model;
use crate::app::narrow::slider_ui;
use crate::app::state::{Claim, MOST_COMPARED, RankingPlot, RankingState};
use crate::app::theme;
use crate::lab::metrics::Metrics;
use crate::lab::ranking::{Basis, order, winners};
use crate::mapping::{Family, MappingId};

/// Below this width the pane scrolls sideways.
const LEAST_WIDTH: f32 = 170.0;
/// Least height of the table and of the plot: below, the pane scrolls.
const LOWEST_TABLE: f32 = 150.0;
const LOWEST_PLOT: f32 = 250.0;
/// Share of the height that the table has.
const TABLE_SHARE: f32 = 0.45;

/// Shows the ranking in all the space there is.
pub fn ranking_ui(ui: &mut Ui, model: &mut Model<'_>) {
    theme::scrolled_pane(ui, LEAST_WIDTH, |ui, height| content_ui(ui, model, height));
}

fn content_ui(ui: &mut Ui, model: &mut Model<'_>, height: f32) {
    let top = ui.cursor().top();
    measuring_ui(ui, model);
    weight_ui(ui, model);
    kinds_ui(ui, model);
    let entries = entries(model, &model.state.ranking.maps());
    winners_ui(ui, model, &entries);
    // A line of buttons, and one of lists, stand above the plot.
    const LINES: f32 = 54.0;
    let left = height - (ui.cursor().top() - top) - LINES;
    let table = (TABLE_SHARE * left).max(LOWEST_TABLE);
    table_ui(ui, model, &entries, table);
    plots_ui(ui, model);
    let size = vec2(ui.available_width(), (left - table).max(LOWEST_PLOT));
    match model.state.ranking.plot {
        RankingPlot::Weights => bump_ui(ui, model, &entries, size),
        RankingPlot::Scatter => scatter_ui(ui, model, &entries, size),
        // The chosen are compared with all, whatever the table shows.
        RankingPlot::Compare => compare_ui(
            ui,
            model,
            &super::entry::entries(model, MappingId::ALL),
            size,
        ),
    }
}

/// How far the measuring is, where it is not done.
fn measuring_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let lab = &model.labs.ranking;
    let all = MappingId::ALL;
    let known = all.iter().filter(|map| lab.of(**map).is_some()).count();
    if known == all.len() {
        return;
    }
    let is_measuring = lab.is_measuring();
    ui.horizontal_wrapped(|ui| {
        ui.label(format!("{known} of {} mappings are measured", all.len()));
        if !is_measuring && ui.button("Measure the others").clicked() {
            model.push(Command::MeasureRanking);
        }
    });
}

/// The weight of shape beside that of area, and of which texels.
fn weight_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let mut ranking = model.state.ranking.clone();
    ui.horizontal_wrapped(|ui| {
        let name = ui.label("area");
        let slider = Slider::new(&mut ranking.weight, 0.0..=1.0).fixed_decimals(2);
        ui.spacing_mut().slider_width = 110.0;
        slider_ui(ui, slider, name.id, "0.00").on_hover_text(
            "How much shape counts: the score is (1 − w) ln(area) + w ln(a/b). Logarithms, because both are ratios: twice and half are equally far from even, and 0 is perfect.",
        );
        ui.label("shape");
        list_ui(ui, "of", &mut ranking.basis, Basis::ALL, |basis| {
            basis.name().to_owned()
        });
    });
    set(model, ranking);
}

/// Which mappings are ranked.
fn kinds_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let mut ranking = model.state.ranking.clone();
    ui.horizontal_wrapped(|ui| {
        let families = std::iter::once(None).chain(Family::ALL.map(Some));
        list_ui(ui, "rank", &mut ranking.family, families, |family| {
            family.map_or("all", Family::title).to_owned()
        });
        let claims = std::iter::once(None).chain(Claim::ALL.map(Some));
        list_ui(ui, "that are", &mut ranking.claim, claims, |claim| {
            claim.map_or("anything", Claim::name).to_owned()
        });
    });
    set(model, ranking);
}

/// Which mapping is best, and from which weight on another.
fn winners_ui(ui: &mut Ui, model: &Model<'_>, entries: &[Entry<'_>]) {
    let measured: Vec<&Metrics> = entries.iter().filter_map(|entry| entry.metrics).collect();
    let basis = model.state.ranking.basis;
    let winners = winners(&measured, basis);
    let mut text = String::new();
    for (k, (weight, map)) in winners.iter().enumerate() {
        let name = map.info().name;
        text += &match k {
            0 => format!("Best for area: {name}{}", ties(&measured, basis)),
            _ => format!("; from {weight:.2} on {name}"),
        };
    }
    if entries.is_empty() {
        text = "No mapping is of this kind and keeps that promise.".to_owned();
    }
    if !text.is_empty() {
        ui.add(Label::new(RichText::new(text).strong()).wrap());
    }
}

/// How many are as good for area alone; the first of them is the one that `order` has first.
fn ties(measured: &[&Metrics], basis: Basis) -> String {
    let first = order(measured, basis, 0.0);
    match first.iter().filter(|placed| placed.place == 1).count() {
        0 | 1 => String::new(),
        many => format!(" (of {many} as good the best with both weighed alike)"),
    }
}

/// Which plot stands below the table.
fn plots_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let mut ranking = model.state.ranking.clone();
    ui.horizontal_wrapped(|ui| {
        for plot in RankingPlot::ALL {
            let button = Button::selectable(ranking.plot == plot, plot.name());
            if ui.add(button).clicked() {
                ranking.plot = plot;
            }
        }
        let count = ranking.compared.len();
        let hint = if count == MOST_COMPARED {
            format!("{count} chosen: untick one to choose another")
        } else {
            format!("{count} of {MOST_COMPARED} chosen to compare")
        };
        ui.label(RichText::new(hint).small());
    });
    set(model, ranking);
}

/// Changes what the pane asks or shows.
pub fn set(model: &mut Model<'_>, ranking: RankingState) {
    if ranking != model.state.ranking {
        model.push(Action::SetRanking(Box::new(ranking)));
    }
}
