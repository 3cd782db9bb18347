//! Which part of an unfolded picture a panel shows: screen points to picture coordinates and back.

use egui::{Pos2, Rect, Vec2, pos2};

use super::state::{PanelState, ZOOM_RANGE};

/// Share of the panel that the whole picture fills at zoom 1; the rest is a margin.
const FIT: f32 = 0.96;

/// A panel's rectangle on the screen and what it shows of a picture of a certain shape.
#[derive(Clone, Copy, Debug)]
pub struct PanelWindow {
    rect: Rect,
    center: [f32; 2],
    /// Size of the whole picture on the screen, in points.
    size: Vec2,
}

impl PanelWindow {
    /// The view of a panel of which the picture is `aspect` times as wide as high.
    pub fn new(rect: Rect, view: &PanelState, aspect: f32) -> Self {
        let width = FIT * rect.width().min(rect.height() * aspect).max(1.0) * view.zoom;
        Self {
            rect,
            center: view.center,
            size: Vec2::new(width, width / aspect),
        }
    }

    /// Picture coordinates x0, y0, x1, y1 of the panel's borders; beyond [0, 1] there is nothing.
    pub fn window(&self) -> [f32; 4] {
        let half = self.rect.size() / (2.0 * self.size);
        let [x, y] = self.center;
        [x - half.x, y - half.y, x + half.x, y + half.y]
    }

    /// The place on the screen of picture coordinates.
    pub fn screen_from_picture(&self, [x, y]: [f64; 2]) -> Pos2 {
        let offset = |c: f64, center: f32, size: f32| ((c - f64::from(center)) as f32) * size;
        self.rect.center()
            + Vec2::new(
                offset(x, self.center[0], self.size.x),
                offset(y, self.center[1], self.size.y),
            )
    }

    /// The picture coordinates of a place on the screen.
    pub fn picture_from_screen(&self, pos: Pos2) -> [f64; 2] {
        let offset = (pos - self.rect.center()) / self.size;
        [
            f64::from(self.center[0]) + f64::from(offset.x),
            f64::from(self.center[1]) + f64::from(offset.y),
        ]
    }

    /// The view moved by a drag on the screen, in points.
    pub fn panned(&self, view: PanelState, by: Vec2) -> PanelState {
        let shift = by / self.size;
        let center = [view.center[0] - shift.x, view.center[1] - shift.y];
        PanelState {
            center: center.map(|c| c.clamp(0.0, 1.0)),
            ..view
        }
    }

    /// The view magnified by a factor around a place on the screen, which stays where it is.
    pub fn zoomed(&self, view: PanelState, factor: f32, around: Pos2) -> PanelState {
        if !(factor.is_finite() && factor > 0.0) {
            return view;
        }
        let zoom = (view.zoom * factor).clamp(ZOOM_RANGE.0, ZOOM_RANGE.1);
        let kept = self.picture_from_screen(around);
        let share = 1.0 - view.zoom / zoom;
        let toward = |center: f32, kept: f64| center + (kept as f32 - center) * share;
        let center = [
            toward(view.center[0], kept[0]),
            toward(view.center[1], kept[1]),
        ];
        PanelState {
            zoom,
            center: center.map(|c| c.clamp(0.0, 1.0)),
            ..view
        }
    }

    /// Where the whole picture lies on the screen.
    pub fn picture_rect(&self) -> Rect {
        let [low, high] = [[0.0; 2], [1.0; 2]].map(|place| self.screen_from_picture(place));
        Rect::from_min_max(low, high)
    }

    /// Size of one picture unit on the screen in points, across.
    pub fn points_across(&self) -> f32 {
        self.size.x
    }
}

/// A rectangle for tests and for drawing without a window.
pub fn rect_of_size(width: f32, height: f32) -> Rect {
    Rect::from_min_max(Pos2::ZERO, pos2(width, height))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mapping::MappingId;

    #[test]
    fn screen_and_picture_are_inverse_and_zoom_keeps_the_place() {
        let mut view = PanelState::new(MappingId::Cube, true);
        for _ in 0..4 {
            let panel = PanelWindow::new(rect_of_size(300.0, 200.0), &view, 4.0 / 3.0);
            let pos = pos2(120.0, 80.0);
            let place = panel.picture_from_screen(pos);
            assert!((panel.screen_from_picture(place) - pos).length() < 1e-3);
            view = panel.zoomed(view, 1.5, pos);
            let nearer = PanelWindow::new(rect_of_size(300.0, 200.0), &view, 4.0 / 3.0);
            assert!((nearer.screen_from_picture(place) - pos).length() < 1e-2);
            assert!(nearer.points_across() > panel.points_across());
        }
    }

    #[test]
    fn the_whole_picture_fits_at_zoom_one() {
        let view = PanelState::new(MappingId::Latlong, true);
        for (width, height) in [(300.0, 200.0), (200.0, 300.0), (1.0, 1.0)] {
            let [x0, y0, x1, y1] =
                PanelWindow::new(rect_of_size(width, height), &view, 2.0).window();
            assert!(x0 <= 0.0 && y0 <= 0.0 && x1 >= 1.0 && y1 >= 1.0);
        }
    }
}
