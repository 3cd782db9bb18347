//! Six pictures in the wrong places, turned and mirrored: the solver finds what they are.

use sixfold::imaging::solver::{Solution, solve};
use sixfold::imaging::{MapShape, Raster};
use sixfold::mapping::{Arrangement, Axes, Held, Layout, MappingId, Turn};

use crate::scenes::{Laid, Scene, constant, in_8_bits, photograph, smooth};

const CUBE: MappingId = MappingId::Cube;

/// All that seams cannot tell from an arrangement.
fn fits_like(found: &Arrangement, truth: &Arrangement) -> bool {
    Axes::all().any(|axes| found.then(&Arrangement::from_axes(axes)) == *truth)
}

fn solved((shape, pictures): &(MapShape, Vec<Raster>)) -> Solution {
    solve(shape, pictures).unwrap()
}

/// Small numbers that look random, always the same.
pub struct Dice(pub u64);

impl Dice {
    fn below(&mut self, count: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % count
    }

    pub fn arrangement(&mut self) -> Arrangement {
        let mut charts = [0, 1, 2, 3, 4, 5];
        for i in (1..6).rev() {
            charts.swap(i, self.below(i as u64 + 1) as usize);
        }
        let turns: Vec<Turn> = Turn::all().collect();
        let held = charts.map(|chart| Held {
            chart,
            turn: turns[self.below(8) as usize],
        });
        Arrangement::new(held).unwrap()
    }
}

fn laid(size: u32) -> Laid {
    Laid::new(CUBE, Layout::Faces, size)
}

#[test]
fn every_relabeling_is_found() {
    for scene in [smooth as Scene, photograph] {
        let laid = laid(24);
        for axes in Axes::all() {
            // The faces' names exchanged as the axes are, each picture upright: what a program does that has other names.
            let faces = Arrangement::from_axes(axes);
            let held = faces.held().map(|held| Held {
                turn: Turn::UPRIGHT,
                ..held
            });
            let truth = Arrangement::new(held).unwrap();
            let found = solved(&laid.arranged(scene, &truth));
            assert!(
                found.is_certain,
                "{axes:?}: {} {:?}",
                found.margin, found.score
            );
            assert!(
                fits_like(&found.arrangement, &truth),
                "{truth}: {}",
                found.arrangement
            );
            assert!(fits_like(&found.mirrored, &truth));
            assert!(
                found.arrangement.changed() <= truth.changed(),
                "{truth}: {}",
                found.arrangement
            );
        }
    }
}

#[test]
fn any_turns_of_any_faces_are_found() {
    let mut dice = Dice(7);
    for scene in [smooth as Scene, photograph] {
        for size in [16, 64] {
            for _ in 0..12 {
                let truth = dice.arrangement();
                let mut files = laid(size).arranged(scene, &truth);
                if size == 64 {
                    files.1 = files.1.iter().map(in_8_bits).collect();
                    files.0.samples = sixfold::imaging::SampleKind::U8;
                    files.0.transfer = sixfold::imaging::Transfer::Srgb;
                }
                let found = solved(&files);
                assert!(
                    fits_like(&found.arrangement, &truth),
                    "{truth}: {}",
                    found.arrangement
                );
                assert!(
                    found.is_certain,
                    "{truth}: {} {:?}",
                    found.margin, found.score
                );
            }
        }
    }
}

#[test]
fn openexr_faces_are_two_exchanged_pictures() {
    let truth: Arrangement = "+x,-x,+y,-y,-z,+z".parse().unwrap();
    let found = solved(&laid(32).arranged(photograph, &truth));
    assert_eq!(found.arrangement, truth);
    let sentence = found.sentence();
    assert!(
        sentence.starts_with("faces +z and -z exchanged, nothing flipped"),
        "{sentence}"
    );
    assert_eq!(found.option(), "--arrange \"+x,-x,+y,-y,-z,+z\"");
    let mirrored = found.mirrored_sentence();
    assert!(mirrored.contains("all flipped"), "{mirrored}");
    assert!(found.as_labelled.unwrap() > 2.0 * found.score.unwrap());

    // In the table of renamings those that only turn the cube fit as well, and of all 48 none fits better.
    assert_eq!(found.relabelings.len(), 48);
    let best = found.score.unwrap();
    let fitting = found
        .relabelings
        .iter()
        .filter(|r| r.upright.unwrap() < 1.1 * best)
        .count();
    assert!(
        found
            .relabelings
            .iter()
            .all(|r| r.upright.unwrap() > 0.99 * best)
    );
    assert!((1..48).contains(&fitting), "{fitting}");
}

#[test]
fn a_right_map_is_called_right() {
    let found = solved(&laid(32).arranged(photograph, &Arrangement::IDENTITY));
    assert_eq!(found.arrangement, Arrangement::IDENTITY);
    assert!(
        found
            .sentence()
            .starts_with("every face is where its name says, nothing flipped")
    );
    assert!(found.is_certain);
}

#[test]
fn what_cannot_be_told_is_not_told() {
    let even = solved(&laid(32).arranged(constant, &Arrangement::IDENTITY));
    assert!(!even.is_certain);
    assert!(
        even.sentence().starts_with("cannot tell"),
        "{}",
        even.sentence()
    );

    // Six pictures of six places do not belong together.
    let mut strangers = laid(32).arranged(photograph, &Arrangement::IDENTITY);
    for (i, picture) in strangers.1.iter_mut().enumerate() {
        let shift = 3.0 * i as f64;
        let other = Laid::new(MappingId::Octahedral, Layout::Single, 32);
        let drawn = other.draw(&other.shape(), |d| photograph(d * (1.0 + shift)));
        *picture = drawn.into_iter().next().unwrap();
    }
    let strangers = solved(&strangers);
    assert!(!strangers.is_certain, "{}", strangers.sentence());

    // One face that is even could lie in any turn, the others fit.
    let mut sky = laid(32).arranged(photograph, &Arrangement::IDENTITY);
    sky.1[2] = laid(32).map(constant).into_parts().1.remove(2);
    let sky = solved(&sky);
    assert!(!sky.is_certain, "{}", sky.sentence());
}
