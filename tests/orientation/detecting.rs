//! What a picture is, from its shape and its texels.

use sixfold::imaging::detect::{Detection, Known, detect};
use sixfold::imaging::{EnvmapKind, Raster, Siting};
use sixfold::mapping::{Arrangement, Frame, Layout, MappingId};
use sixfold::math::Vec3;

use crate::scenes::{Laid, Scene, constant, in_8_bits, photograph, smooth};

fn detected(laid: &Laid, scene: Scene) -> Detection {
    let pictures = laid.draw(&laid.shape(), scene);
    detect(&pictures, Known::default())
}

fn first(detection: &Detection) -> (MappingId, Layout) {
    let first = &detection.proposals[0];
    (first.mapping, first.layout)
}

fn told(detection: &Detection) -> String {
    let lines: Vec<String> = detection.proposals.iter().map(|p| p.sentence()).collect();
    lines.join("\n")
}

#[test]
fn every_layout_of_the_cube_is_told_for_certain() {
    let six = Layout::ALL.into_iter().filter(|layout| layout.holds(6));
    for layout in six.filter(|layout| *layout != Layout::ThreeByTwoTurned) {
        for scene in [smooth as Scene, photograph] {
            for mapping in [MappingId::Cube, MappingId::Eac] {
                let detection = detected(&Laid::new(mapping, layout, 48), scene);
                assert_eq!(
                    first(&detection),
                    (MappingId::Cube, layout),
                    "{}",
                    told(&detection)
                );
                assert!(detection.is_certain, "{}", told(&detection));
                // The seams of all three are the same.
                assert!(
                    detection
                        .proposals
                        .iter()
                        .any(|p| p.mapping == mapping && p.layout == layout)
                );
            }
        }
    }
    let turned = Laid::new(MappingId::Eac, Layout::ThreeByTwoTurned, 48);
    for scene in [smooth as Scene, photograph] {
        let detection = detected(&turned, scene);
        assert_eq!(
            first(&detection),
            (MappingId::Eac, Layout::ThreeByTwoTurned)
        );
        assert!(detection.is_certain, "{}", told(&detection));
    }
}

#[test]
fn single_charts_are_told_as_far_as_can_be() {
    use MappingId::{
        Angular, CylindricalEqualArea, Latlong, Matcap, Octahedral, OctahedralEqualArea,
        Paraboloid, Sphere,
    };
    for scene in [smooth as Scene, photograph] {
        for (mapping, layout, alike, is_certain) in [
            (Latlong, Layout::Single, vec![Latlong], true),
            (
                CylindricalEqualArea,
                Layout::Single,
                vec![CylindricalEqualArea],
                true,
            ),
            (Paraboloid, Layout::Pair, vec![Paraboloid], true),
            (Paraboloid, Layout::PairColumn, vec![Paraboloid], true),
            (
                Octahedral,
                Layout::Single,
                vec![Octahedral, OctahedralEqualArea],
                false,
            ),
            (
                OctahedralEqualArea,
                Layout::Single,
                vec![Octahedral, OctahedralEqualArea],
                false,
            ),
            (Sphere, Layout::Single, vec![Sphere, Angular, Matcap], false),
            (
                Angular,
                Layout::Single,
                vec![Sphere, Angular, Matcap],
                false,
            ),
            (Matcap, Layout::Single, vec![Sphere, Angular, Matcap], false),
        ] {
            let detection = detected(&Laid::new(mapping, layout, 96), scene);
            let (found, lies) = first(&detection);
            assert!(alike.contains(&found), "{mapping}: {}", told(&detection));
            assert_eq!(lies, layout, "{mapping}: {}", told(&detection));
            assert_eq!(
                detection.is_certain,
                is_certain,
                "{mapping}: {}",
                told(&detection)
            );
        }
    }
}

#[test]
fn eight_bits_and_constants_are_told_by_shape() {
    let latlong = Laid::new(MappingId::Latlong, Layout::Single, 64);
    let pictures: Vec<Raster> = latlong
        .draw(&latlong.shape(), photograph)
        .iter()
        .map(in_8_bits)
        .collect();
    let detection = detect(&pictures, Known::default());
    assert!(detection.is_certain && first(&detection).0 == MappingId::Latlong);
    let detection = detected(&latlong, constant);
    assert!(detection.is_certain && first(&detection).0 == MappingId::Latlong);
    assert_eq!(detection.proposals[0].score, None);
}

#[test]
fn what_is_no_map_is_not_certain() {
    // A picture twice as wide as high that is no panorama: a piece of one.
    let laid = Laid::new(MappingId::Latlong, Layout::Single, 64);
    let piece = laid.draw(&laid.shape(), |d| {
        photograph(sixfold::math::Vec3::new(d.x.atan2(d.z), d.y, 1.0))
    });
    let detection = detect(&piece, Known::default());
    assert!(!detection.is_certain, "{}", told(&detection));
    // A cross whose faces are exchanged.
    let cross = Laid::new(MappingId::Cube, Layout::Cross, 48);
    let exchanged: Arrangement = "+y,-x,+x,-y,+z,-z".parse().unwrap();
    let (_, pictures) = cross.arranged(photograph, &exchanged);
    let detection = detect(&pictures, Known::default());
    assert!(!detection.is_certain, "{}", told(&detection));
    // No known shape.
    let odd = Laid {
        size: [70, 50],
        ..laid
    };
    assert!(detected(&odd, photograph).proposals.is_empty());
}

#[test]
fn openexr_columns_are_told_from_ours() {
    let laid = Laid {
        siting: Siting::Edge,
        ..Laid::new(MappingId::Cube, Layout::Column, 49)
    };
    let exr = Frame::from_id("openexr").unwrap();
    let mut shape = laid.shape();
    shape.apply_frame(exr, Layout::Column).unwrap();
    let pictures = laid.draw(&shape, photograph);
    for known in [
        Known::default(),
        Known {
            envmap: Some(EnvmapKind::Cube),
            is_cube: false,
        },
    ] {
        let detection = detect(&pictures, known);
        let first = &detection.proposals[0];
        assert_eq!(
            first.frame.map(|frame| frame.id),
            Some("openexr"),
            "{}",
            told(&detection)
        );
        assert_eq!(first.siting, Siting::Edge, "{}", told(&detection));
        assert!(detection.is_certain, "{}", told(&detection));
        assert_eq!(first.shape(&pictures), Some(shape.clone()));
    }
}

/// A colour that is nought on the date line and grows alike on both sides of it: the outermost columns are the same, and yet no
/// samples lie on the border.
fn symmetric(d: Vec3<f64>) -> [f32; 3] {
    d.to_f64().map(|c| ((c + 1.0) / 2.0) as f32)
}

#[test]
fn only_poles_that_are_points_tell_samples_on_a_latlongs_border() {
    for scene in [symmetric as Scene, smooth] {
        for height in [32, 128] {
            for siting in [Siting::Centre, Siting::Edge] {
                let laid = Laid {
                    siting,
                    ..Laid::new(MappingId::Latlong, Layout::Single, height)
                };
                let detection = detected(&laid, scene);
                let found = detection
                    .proposals
                    .iter()
                    .find(|p| p.mapping == MappingId::Latlong);
                assert_eq!(
                    found.unwrap().siting,
                    siting,
                    "{height}: {}",
                    told(&detection)
                );
            }
        }
    }
}
