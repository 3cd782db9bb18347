//! The seam score: 1 where a map is whole, much more where it is not.

use sixfold::imaging::seams::seams;
use sixfold::mapping::{Arrangement, Layout, MappingId};

use crate::scenes::{Laid, Scene, constant, photograph, smooth};

fn score(laid: &Laid, scene: Scene) -> Option<f64> {
    let shape = laid.shape();
    seams(&shape, &laid.draw(&shape, scene))?.score()
}

#[test]
fn whole_maps_score_about_one() {
    for (mapping, layout, most) in [
        (MappingId::Latlong, Layout::Single, 1.5),
        (MappingId::Cube, Layout::Cross, 1.5),
        (MappingId::Ccm, Layout::Row, 1.5),
        (MappingId::Eac, Layout::ThreeByTwoTurned, 1.5),
        (MappingId::Octahedral, Layout::Single, 1.5),
        (MappingId::OctahedralEqualArea, Layout::Single, 1.5),
        (MappingId::Paraboloid, Layout::Pair, 2.0),
        (MappingId::CylindricalEqualArea, Layout::Single, 1.5),
        (MappingId::Angular, Layout::Single, 2.5),
        // The texels next to the rim are 20 degrees apart already.
        (MappingId::Sphere, Layout::Single, 5.0),
    ] {
        for scene in [smooth as Scene, photograph] {
            for height in [32, 128] {
                let score = score(&Laid::new(mapping, layout, height), scene).unwrap();
                assert!((0.3..most).contains(&score), "{mapping} {height}: {score}");
            }
        }
    }
    assert_eq!(
        score(
            &Laid::new(MappingId::Matcap, Layout::Single, 32),
            photograph
        ),
        None
    );
    assert_eq!(
        score(&Laid::new(MappingId::Cube, Layout::Cross, 32), constant),
        None
    );
}

#[test]
fn small_maps_have_a_score_too() {
    for size in [2, 3, 4] {
        let score = score(&Laid::new(MappingId::Cube, Layout::Faces, size), smooth).unwrap();
        assert!((0.3..1.6).contains(&score), "{size}: {score}");
    }
    assert_eq!(
        score(&Laid::new(MappingId::Cube, Layout::Faces, 1), smooth),
        None
    );
}

#[test]
fn one_turned_face_is_much_worse() {
    let laid = Laid::new(MappingId::Cube, Layout::Faces, 64);
    for scene in [smooth as Scene, photograph] {
        let right = score(&laid, scene).unwrap();
        for text in [
            "+x,-x,+y,-y,+z:180,-z",
            "+x:mirrored,-x,+y,-y,+z,-z",
            "+x,-x,+y,-y:90,+z,-z",
        ] {
            let turned: Arrangement = text.parse().unwrap();
            let (shape, pictures) = laid.arranged(scene, &turned);
            let wrong = seams(&shape, &pictures).unwrap().score().unwrap();
            assert!(wrong > 2.0 * right, "{text}: {right} {wrong}");
        }
    }
}
