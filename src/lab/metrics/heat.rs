//! A mapping's distortion as a picture of its charts.

use super::local::{Quantity, Yardstick};
use crate::imaging::Progress;
use crate::mapping::MappingId;

/// Where each pixel stands on the quantity's scale, 0 to 1, row by row, in the layout of the mapping's panel; not a number beside the charts
/// and the domain, and where there is no derivative. `None` when cancelled.
pub fn heat(
    map: MappingId,
    quantity: Quantity,
    size: [usize; 2],
    progress: &Progress,
) -> Option<Vec<f32>> {
    let yardstick = Yardstick::new(map);
    let layout = map.info().layout;
    let [width, height] = size;
    let mut places = Vec::with_capacity(width * height);
    for row in 0..height {
        if progress.is_cancelled() {
            return None;
        }
        progress.step(row, height);
        for column in 0..width {
            let pixel = [column as f64 / width as f64, row as f64 / height as f64];
            let middle = [0.5 / width as f64, 0.5 / height as f64];
            let point = layout.chart_from_picture([pixel[0] + middle[0], pixel[1] + middle[1]]);
            let local = point.and_then(|point| yardstick.at(point));
            places.push(local.map_or(f32::NAN, |local| {
                // The number of texels moves the value and the scale alike.
                quantity.place(quantity.of(&local, &yardstick, 1.0), 1.0) as f32
            }));
        }
    }
    Some(places)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_shows_where_a_map_is_distorted() {
        let size = [80, 60];
        let shape = heat(MappingId::Cube, Quantity::Shape, size, &Progress::new()).unwrap();
        let at = |x: usize, y: usize| shape[y * size[0] + x];
        // The middle of +z is round, its corner is not, and the cross leaves a corner of the picture empty.
        assert!(
            at(30, 30) < 0.01 && at(20, 20) > 0.35,
            "{} {}",
            at(30, 30),
            at(20, 20)
        );
        assert!(at(2, 2).is_nan());
        let even = heat(MappingId::Arvo, Quantity::Area, size, &Progress::new()).unwrap();
        let even = even.into_iter().filter(|place| !place.is_nan());
        assert!(even.clone().count() == 80 * 60 / 2);
        assert!(even.into_iter().all(|place| (place - 0.5).abs() < 1e-6));
        let progress = Progress::new();
        progress.cancel();
        assert_eq!(heat(MappingId::Cube, Quantity::Area, size, &progress), None);
    }
}
