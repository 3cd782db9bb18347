//! Distortion over the panels: heat maps that are made where they are shown, and the legend. Tissot's ellipses are in `ellipses.rs`.

use std::collections::HashMap;

use egui::{Align2, Color32, ColorImage, Context, Painter, Pos2, Rect, TextureOptions, pos2, vec2};

use super::follower::Follower;
use super::labs::Lab;
use super::marks::{colour_bar, edged_text};
use super::model::{JobLine, Model};
use super::numbers::significant;
use super::object::Jobs;
use super::panel_view::PanelWindow;
use super::theme;
use crate::imaging::Progress;
use crate::imaging::resample::texels_of;
use crate::lab::metrics::heat::heat;
use crate::lab::metrics::{Quantity, Yardstick};
use crate::mapping::MappingId;
use crate::math::Vec3;

/// A heat map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HeatWanted {
    /// Of which mapping.
    pub mapping: MappingId,
    /// Of what.
    pub quantity: Quantity,
    /// Columns and rows of the picture.
    pub size: [usize; 2],
    /// Where it is shown.
    pub seen: Seen,
}

/// Where a heat map is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Seen {
    /// In the mapping's panel.
    Panel,
    /// On the folded surface.
    Surface,
}

impl HeatWanted {
    fn key(&self) -> (MappingId, Seen) {
        (self.mapping, self.seen)
    }

    fn make(&self, ctx: &Context, progress: &Progress) -> Option<egui::TextureHandle> {
        let places = heat(self.mapping, self.quantity, self.size, progress)?;
        let color = |place: &f32| {
            if place.is_nan() {
                Color32::TRANSPARENT
            } else {
                theme::scale(*place)
            }
        };
        let image = ColorImage::new(self.size, places.iter().map(color).collect());
        Some(ctx.load_texture("heat", image, TextureOptions::LINEAR))
    }
}

/// The heat maps that were made last, one a mapping and place.
#[derive(Default)]
pub struct HeatMaps {
    maps: HashMap<(MappingId, Seen), Follower<HeatWanted, egui::TextureHandle>>,
}

impl HeatMaps {
    /// Starts what is wanted and not there; forgets the mappings that nobody looks at.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn follow(&mut self, wanted: &[HeatWanted], jobs: &mut Jobs<'_>) -> Result<(), String> {
        self.maps
            .retain(|key, _| wanted.iter().any(|wanted| wanted.key() == *key));
        for wanted in wanted {
            let follower = self.maps.entry(wanted.key()).or_default();
            let painter = jobs.ctx.clone();
            let title = format!("distortion of {}", wanted.mapping.info().name);
            follower.follow(Some(*wanted), title, jobs, move |wanted, progress| {
                wanted.make(&painter, progress)
            })?;
        }
        Ok(())
    }

    /// Makes what is wanted at once: for pictures.
    pub fn complete(&mut self, wanted: &[HeatWanted], ctx: &Context) {
        for wanted in wanted {
            let follower = self.maps.entry(wanted.key()).or_default();
            follower.complete(Some(*wanted), |wanted, progress| wanted.make(ctx, progress));
        }
    }

    /// The last picture of a mapping's quantity; while a finer one is made, the coarser stands in.
    pub fn picture(
        &self,
        mapping: MappingId,
        seen: Seen,
        quantity: Quantity,
    ) -> Option<egui::TextureId> {
        let (of, picture) = self.maps.get(&(mapping, seen))?.shown()?;
        (of.quantity == quantity).then(|| picture.id())
    }
}

impl Lab for HeatMaps {
    fn poll(&mut self, _: &Context) {
        self.maps.values_mut().for_each(Follower::poll);
    }

    fn jobs(&self) -> Vec<JobLine> {
        self.maps.values().filter_map(Follower::job).collect()
    }

    fn cancel(&mut self, id: u64) {
        self.maps.values_mut().for_each(|map| map.cancel(id));
    }
}

/// What of the distortion is switched on, over a mapping's panel.
pub fn paint_distortion(
    model: &mut Model<'_>,
    painter: &Painter,
    mapping: MappingId,
    window: &PanelWindow,
) {
    let overlays = model.state.overlays;
    if let Some(quantity) = overlays.heat {
        paint_heat(model, painter, mapping, quantity, window);
    }
    if overlays.ellipses {
        model.ellipses_wanted.push(mapping);
        model.labs.ellipses.paint(painter, mapping, window);
    }
}

fn paint_heat(
    model: &mut Model<'_>,
    painter: &Painter,
    mapping: MappingId,
    quantity: Quantity,
    window: &PanelWindow,
) {
    /// A magnified panel shows more of the same: finer than this nobody sees a difference.
    const MOST: f32 = 1024.0;
    let rect = window.picture_rect();
    let pixels = rect.size() * painter.ctx().pixels_per_point();
    let shrink = (MOST / pixels.max_elem()).min(1.0);
    let side = |length: f32| (length * shrink).round().max(1.0) as usize;
    model.heat_wanted.push(HeatWanted {
        mapping,
        quantity,
        size: [side(pixels.x), side(pixels.y)],
        seen: Seen::Panel,
    });
    if let Some(picture) = model.labs.heat.picture(mapping, Seen::Panel, quantity) {
        let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
        painter.image(picture, rect, whole, Color32::WHITE);
    }
}

/// The scale of the heat map with its numbers, and where the probe stands on it: one line, and its name above it where there is room.
pub fn paint_legend(painter: &Painter, model: &Model<'_>, mapping: MappingId, rect: Rect) {
    /// Least and most length of the bar.
    const BAR: [f32; 2] = [16.0, 64.0];
    const BAR_HEIGHT: f32 = 8.0;
    const MARGIN: f32 = 4.0;
    /// Room for a number beside the bar, and for that of the probe.
    const NUMBER: f32 = 33.0;
    const HERE: f32 = 74.0;
    const LINE: f32 = 16.0;
    /// Below these heights the panel is the picture's, and the name can be read in the controls.
    const LEAST_HEIGHT: f32 = 60.0;
    const NAMED_HEIGHT: f32 = 220.0;
    let Some(quantity) = model.state.overlays.heat else {
        return;
    };
    if rect.height() < LEAST_HEIGHT {
        return;
    }
    let texels = texels_of(mapping, model.map_size(mapping)) as f64;
    let place = rect.left_bottom() + vec2(MARGIN, -MARGIN);
    let lines = if rect.height() < NAMED_HEIGHT {
        1.0
    } else {
        2.0
    };
    let here = value_at(mapping, quantity, model.state.probe_f64(), texels);
    let room = rect.width() - 2.0 * MARGIN;
    let bar_size = vec2(
        (room - 2.0 * NUMBER - HERE).clamp(BAR[0], BAR[1]),
        BAR_HEIGHT,
    );
    let ground = Rect::from_min_max(
        place - vec2(0.0, lines * LINE),
        place + vec2((2.0 * NUMBER + bar_size.x + HERE).min(room), 0.0),
    );
    painter.rect_filled(ground, 3.0, Color32::from_black_alpha(170));
    let middle = place.y - 0.5 * LINE;
    let words = |at: f32, anchor: Align2, text: &str, color: Color32| {
        edged_text(painter, pos2(at, middle), anchor, text, color);
    };
    let bar = Rect::from_min_size(pos2(place.x + NUMBER, middle - 0.5 * BAR_HEIGHT), bar_size);
    colour_bar(painter, bar, theme::scale);
    let end = |place: f64| significant(quantity.value(place, texels));
    words(
        bar.left() - 3.0,
        Align2::RIGHT_CENTER,
        &end(0.0),
        theme::PROBE,
    );
    words(
        bar.right() + 3.0,
        Align2::LEFT_CENTER,
        &end(1.0),
        theme::PROBE,
    );
    if lines > 1.0 {
        let name = format!("{} {}", quantity.name(), quantity.unit());
        let at = ground.left_top() + vec2(4.0, 1.0);
        edged_text(painter, at, Align2::LEFT_TOP, name.trim_end(), theme::PROBE);
    }
    let Some(value) = here else { return };
    let at = bar.left() + bar.width() * quantity.place(value, texels) as f32;
    for (pen, color) in [(4.0, theme::PROBE_EDGE), (2.0, theme::PROBE)] {
        let ends = [bar.top() - 2.0, bar.bottom() + 2.0].map(|y| pos2(at, y));
        painter.line_segment(ends, (pen, color));
    }
    let text = format!("here {}", significant(value));
    words(
        ground.right() - 3.0,
        Align2::RIGHT_CENTER,
        &text,
        theme::TEXEL,
    );
}

/// The quantity in a direction; `None` where the mapping has no place of its own for it.
fn value_at(mapping: MappingId, quantity: Quantity, dir: Vec3<f64>, texels: f64) -> Option<f64> {
    let yardstick = Yardstick::new(mapping);
    let local = yardstick.at(mapping.own_point(dir)?)?;
    Some(quantity.of(&local, &yardstick, texels))
}
