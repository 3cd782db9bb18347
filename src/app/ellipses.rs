//! Tissot's ellipses over the panels: traced once a mapping and distance, off the window's thread, and drawn as finely as they are large.

use std::collections::HashMap;

use egui::{Context, Painter, Pos2, Rect};

use super::follower::Follower;
use super::labs::Lab;
use super::marks::edged_line;
use super::model::JobLine;
use super::object::Jobs;
use super::panel_view::PanelWindow;
use super::theme;
use crate::imaging::Progress;
use crate::lab::metrics::tissot::{Ellipse, OUTLINE, indicatrices};
use crate::mapping::{ChartPoint, MappingId};

/// Over which mappings, and how far from each other.
#[derive(Clone, Debug, PartialEq)]
pub struct EllipsesWanted {
    mappings: Vec<MappingId>,
    spacing_deg: f32,
}

impl EllipsesWanted {
    /// `None` where there are no mappings.
    pub fn new(mappings: Vec<MappingId>, spacing_deg: f32) -> Option<Self> {
        (!mappings.is_empty()).then_some(Self {
            mappings,
            spacing_deg,
        })
    }

    fn make(&self, progress: &Progress) -> Option<Ellipses> {
        let trace = |map: &MappingId| {
            let found = indicatrices(*map, f64::from(self.spacing_deg));
            let outlines = found
                .iter()
                .filter_map(|ellipse| Outline::new(*map, ellipse));
            (!progress.is_cancelled()).then(|| (*map, outlines.collect()))
        };
        self.mappings.iter().map(trace).collect()
    }
}

type Ellipses = HashMap<MappingId, Vec<Outline>>;

/// An ellipse in a mapping's unfolded picture, in picture coordinates.
struct Outline {
    /// Two corners of the chart that it is for: beyond lies another one, for which it does not stand.
    chart: [[f64; 2]; 2],
    /// Points around it.
    points: Vec<[f64; 2]>,
}

impl Outline {
    fn new(map: MappingId, ellipse: &Ellipse) -> Option<Self> {
        let place = |point| map.info().layout.picture_from_chart(point);
        let corner = |c: f64| place(ChartPoint::new(ellipse.middle.chart, c, c));
        Some(Self {
            chart: [corner(0.0)?, corner(1.0)?],
            points: ellipse.outline(OUTLINE).filter_map(place).collect(),
        })
    }
}

/// The ellipses that were traced last.
#[derive(Default)]
pub struct EllipsesLab {
    ellipses: Follower<EllipsesWanted, Ellipses>,
}

impl EllipsesLab {
    /// Traces what is wanted and not there; forgets them when nobody looks.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn follow(
        &mut self,
        wanted: Option<EllipsesWanted>,
        jobs: &mut Jobs<'_>,
    ) -> Result<(), String> {
        self.ellipses.forget(|_| wanted.is_none());
        let title = "Tissot's ellipses";
        self.ellipses
            .follow(wanted, title, jobs, EllipsesWanted::make)
    }

    /// Traces what is wanted at once: for pictures.
    pub fn complete(&mut self, wanted: Option<EllipsesWanted>) {
        self.ellipses.complete(wanted, EllipsesWanted::make);
    }

    /// Paints what a mapping makes of equal circles of the sphere; while other ellipses are traced, the last ones stand in.
    pub fn paint(&self, painter: &Painter, mapping: MappingId, window: &PanelWindow) {
        let shown = self.ellipses.shown();
        let outlines = shown.and_then(|(_, ellipses)| ellipses.get(&mapping));
        for outline in outlines.into_iter().flatten() {
            let on_screen = |place: &[f64; 2]| window.screen_from_picture(*place);
            let [a, b] = outline.chart.each_ref().map(on_screen);
            let clip = painter.clip_rect().intersect(Rect::from_two_pos(a, b));
            let mut points: Vec<Pos2> = outline.points.iter().map(on_screen).collect();
            if points.iter().any(|at| clip.contains(*at)) {
                let size = Rect::from_points(&points).size() * painter.ctx().pixels_per_point();
                let stride = stride(0.5 * size.length());
                points = points.into_iter().step_by(stride).collect();
                // Not filled: near a rim it may be thinner than a fill's soft edge.
                points.extend(points.first().copied());
                edged_line(&painter.with_clip_rect(clip), points, 1.2, theme::PROBE);
            }
        }
    }
}

/// Which share of an outline's points is drawn: one in so many, where nobody sees a difference. `reach`: the larger half axis in pixels, or more.
fn stride(reach: f32) -> usize {
    /// Share of a pixel by which the line may be off between two points.
    const OFF: f32 = 0.1;
    // An ellipse is a circle that is pressed together, and so are its chords.
    let off = |stride: usize| {
        reach * (1.0 - (std::f32::consts::PI * stride as f32 / OUTLINE as f32).cos())
    };
    [4, 2]
        .into_iter()
        .find(|stride| off(*stride) < OFF)
        .unwrap_or(1)
}

impl Lab for EllipsesLab {
    fn poll(&mut self, _: &Context) {
        self.ellipses.poll();
    }

    fn jobs(&self) -> Vec<JobLine> {
        self.ellipses.job().into_iter().collect()
    }

    fn cancel(&mut self, id: u64) {
        self.ellipses.cancel(id);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_ellipses_have_fewer_points_and_nobody_sees_it() {
        assert_eq!([0.5, 4.0, 20.0].map(stride), [4, 2, 1]);
        for stride in [1, 2, 4] {
            assert_eq!(
                OUTLINE % stride,
                0,
                "the last step is as long as the others"
            );
        }
    }

    #[test]
    fn outlines_lie_in_the_picture_and_are_made_for_each_mapping() {
        let wanted = EllipsesWanted::new(vec![MappingId::Ccm, MappingId::Latlong], 20.0).unwrap();
        let made = wanted.make(&Progress::new()).unwrap();
        assert_eq!(made.len(), 2);
        for outlines in made.values() {
            assert!(outlines.len() > 50);
            assert!(
                outlines
                    .iter()
                    .all(|outline| outline.points.len() == OUTLINE)
            );
        }
        let cancelled = Progress::new();
        cancelled.cancel();
        assert!(wanted.make(&cancelled).is_none(), "control");
        assert!(EllipsesWanted::new(Vec::new(), 20.0).is_none());
    }
}
