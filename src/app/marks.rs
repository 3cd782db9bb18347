//! Lines and arrows with an edge, readable on every picture.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Vec2};

use super::theme::{PROBE_EDGE, TEXEL};

/// A line with a dark edge.
pub fn edged_line(painter: &Painter, points: Vec<Pos2>, width: f32, color: Color32) {
    painter.extend(edged(points, width, color));
}

/// The shapes of a line with a dark edge.
pub fn edged(points: Vec<Pos2>, width: f32, color: Color32) -> [Shape; 2] {
    let edge = PROBE_EDGE.gamma_multiply(0.7);
    [
        Shape::line(points.clone(), Stroke::new(width + 2.0, edge)),
        Shape::line(points, Stroke::new(width, color)),
    ]
}

/// The colours of a scale, from share 0 at the left to 1 at the right.
pub fn colour_bar(painter: &Painter, rect: Rect, colour: impl Fn(f32) -> Color32) {
    const STEPS: usize = 64;
    let at = |step: usize| rect.left() + rect.width() * step as f32 / STEPS as f32;
    for step in 0..STEPS {
        let piece = Rect::from_x_y_ranges(at(step)..=at(step + 1), rect.y_range());
        painter.rect_filled(piece, 0.0, colour((step as f32 + 0.5) / STEPS as f32));
    }
}

/// A circle with a cross in it.
pub fn cross_mark(painter: &Painter, at: Pos2, color: Color32) {
    const RADIUS: f32 = 6.0;
    painter.circle_stroke(at, RADIUS, Stroke::new(3.5, PROBE_EDGE.gamma_multiply(0.8)));
    painter.circle_stroke(at, RADIUS, Stroke::new(1.5, color));
    for dir in [Vec2::X, Vec2::Y] {
        for side in [-1.0, 1.0] {
            let (from, to) = (at + dir * side * RADIUS, at + dir * side * (RADIUS + 5.0));
            edged_line(painter, vec![from, to], 1.5, color);
        }
    }
}

/// A dot with a dark edge.
pub fn dot(painter: &Painter, at: Pos2, color: Color32) {
    const RADIUS: f32 = 3.5;
    painter.circle_filled(at, RADIUS + 1.0, PROBE_EDGE.gamma_multiply(0.8));
    painter.circle_filled(at, RADIUS, color);
}

/// A ring with a dark edge, wide enough to stand around the probe's mark.
pub fn ring(painter: &Painter, at: Pos2, color: Color32) {
    const RADIUS: f32 = 14.0;
    painter.circle_stroke(at, RADIUS, Stroke::new(3.5, PROBE_EDGE.gamma_multiply(0.8)));
    painter.circle_stroke(at, RADIUS, Stroke::new(1.5, color));
}

/// An arrow with its name at the tip.
pub fn arrow(painter: &Painter, from: Pos2, to: Pos2, color: Color32, name: &str) {
    const HEAD: f32 = 9.0;
    edged_line(painter, vec![from, to], 2.0, color);
    let along = to - from;
    if along.length() > 2.0 {
        let dir = along.normalized();
        let side = Vec2::new(-dir.y, dir.x);
        let barbs = [
            to - dir * HEAD + side * HEAD * 0.45,
            to,
            to - dir * HEAD - side * HEAD * 0.45,
        ];
        edged_line(painter, barbs.to_vec(), 2.0, color);
    }
    edged_text(
        painter,
        beyond(to, along, name),
        Align2::CENTER_CENTER,
        name,
        color,
    );
}

/// Where text has its middle so that it stands clear of the end of a line that runs `along`.
pub fn beyond(end: Pos2, along: Vec2, text: &str) -> Pos2 {
    // A letter of the marks' font is about 7 points wide.
    let half_width = 3.5 * text.len() as f32;
    let away = if along.length() > 0.0 {
        along.normalized()
    } else {
        Vec2::X
    };
    end + away * (9.0 + half_width * away.x.abs())
}

/// Text with a dark edge.
pub fn edged_text(painter: &Painter, at: Pos2, anchor: Align2, text: &str, color: Color32) {
    let font = FontId::proportional(13.0);
    for offset in [Vec2::X, -Vec2::X, Vec2::Y, -Vec2::Y] {
        painter.text(
            at + offset,
            anchor,
            text,
            font.clone(),
            PROBE_EDGE.gamma_multiply(0.8),
        );
    }
    painter.text(at, anchor, text, font, color);
}

/// The outline of a texel; a dot of its colour where it would be smaller than one.
pub fn footprint(painter: &Painter, outline: Vec<Vec<Pos2>>) {
    const SMALLEST: f32 = 3.0;
    let mut bounds = egui::Rect::NOTHING;
    outline
        .iter()
        .flatten()
        .for_each(|p| bounds.extend_with(*p));
    if outline.is_empty() {
        return;
    }
    if bounds.width().max(bounds.height()) < SMALLEST {
        painter.circle_filled(bounds.center(), 0.5 * SMALLEST + 1.0, PROBE_EDGE);
        painter.circle_filled(bounds.center(), 0.5 * SMALLEST, TEXEL);
        return;
    }
    for line in outline {
        edged_line(painter, line, 1.5, TEXEL);
    }
}
