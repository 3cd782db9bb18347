use super::steps::{StoryStep, dir_of, steps};
use super::walked;
use crate::app::objects::target_of;
use crate::app::state::{AppState, EyeRay, StoryKind, StoryState};
use crate::mapping::MappingId;
use crate::optics::Formula;
use crate::optics::material::{Material, Surface, Surfaces};
use crate::scene::Object;

/// A ray along +z that meets the unit sphere in (0.6, 0, -0.8) after 2.4 units: cos 0.8.
fn state(material: Material) -> AppState {
    AppState {
        object: Object::Sphere,
        eye_ray: Some(EyeRay {
            origin: [0.6, 0.0, -3.2],
            dir: [0.0, 0.0, 1.0],
            is_right: false,
        }),
        material,
        story: StoryState {
            open: true,
            ..StoryState::default()
        },
        ..AppState::default()
    }
}

fn told(state: &AppState) -> Vec<StoryStep> {
    steps(state, &target_of(state.object))
}

fn dielectric(index: f32) -> Material {
    Material {
        surface: Surface::Dielectric,
        index,
        ..Material::default()
    }
}

fn titles(steps: &[StoryStep]) -> Vec<&str> {
    steps.iter().map(|step| step.title.as_str()).collect()
}

/// The numbers in the value of a label, whichever step has it.
fn numbers(steps: &[StoryStep], label: &str) -> Vec<f64> {
    let rows = steps.iter().flat_map(|step| &step.numbers);
    let (_, value) = rows.clone().find(|(l, _)| l == label).unwrap_or_else(|| {
        let labels: Vec<_> = rows.map(|(label, _)| label).collect();
        panic!("no {label} among {labels:?}")
    });
    value
        .split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'))
        .filter_map(|number| number.parse().ok())
        .collect()
}

/// The sphere is of triangles: up to 7.5e-5 inside the ball; the rest is the fourth place of the text.
const NEAR: f64 = 2e-4;

fn is_near(found: &[f64], wanted: &[f64]) -> bool {
    found.len() == wanted.len() && std::iter::zip(found, wanted).all(|(a, b)| (a - b).abs() < NEAR)
}

#[test]
fn a_mirrors_story_has_the_numbers_that_pencil_and_paper_find() {
    let steps = told(&state(Material::default()));
    assert_eq!(
        titles(&steps),
        [
            "The eye ray",
            "The hit",
            "The normal",
            "The reflected ray",
            "Its lookup"
        ]
    );
    let r = "r = d − 2(d · n) n";
    for (label, wanted) in [
        ("point", &[0.6, 0.0, -0.8][..]),
        ("distance", &[2.4]),
        ("n", &[0.6, 0.0, -0.8]),
        ("cos θ = −d · n", &[0.8]),
        ("d · n", &[-0.8]),
        (r, &[0.96, 0.0, -0.28]),
    ] {
        let found = numbers(&steps, label);
        assert!(is_near(&found, wanted), "{label}: {found:?}");
    }
    assert!((numbers(&steps, "θ")[0] - 36.870).abs() < 0.01);
    let lookup = steps[4].lookup.unwrap();
    assert!(is_near(&lookup.to_f64(), &[0.96, 0.0, -0.28]));
    assert_eq!(steps[4].marks[0].dir, lookup);
    let names = steps[4].arrows.iter().map(|arrow| arrow.name.as_str());
    assert!(names.eq(["incident", "normal", "reflected"]));
    // The paper's sign points the other way: the comparison must see that.
    let printed = told(&state(Material {
        printed_reflection: true,
        ..Material::default()
    }));
    let found = numbers(&printed, "r = 2(d · n) n − d");
    assert!(is_near(&found, &[-0.96, 0.0, 0.28]) && !is_near(&found, &[0.96, 0.0, -0.28]));
    let tip = |steps: &[StoryStep]| steps[3].arrows[2].to - steps[3].arrows[2].from;
    assert!((tip(&steps) + tip(&printed)).length() < 1e-6);
}

#[test]
fn a_dielectrics_story_refracts_and_mixes() {
    let steps = told(&state(dielectric(1.25)));
    assert_eq!(
        titles(&steps)[4..],
        [
            "Its lookup",
            "Does light get through?",
            "The refracted ray",
            "Its lookup",
            "The mix"
        ]
    );
    // 1 - 0.8^2 (1 - 0.8^2), and the rest by Snell and Fresnel from its root 0.877268.
    let k: f64 = 0.7696;
    let root = k.sqrt();
    let s = ((0.64 - root) / (0.64 + root)).powi(2);
    let p = ((0.8 - 0.8 * root) / (0.8 + 0.8 * root)).powi(2);
    let bend = 0.64 - root;
    let refracted = [bend * 0.6, 0.0, 0.8 - bend * 0.8];
    let k_text = &steps[5].numbers[1].1;
    let k_told: f64 = k_text.rsplit(' ').next().unwrap().parse().unwrap();
    assert!((k_told - k).abs() < NEAR, "{k_text}");
    assert!(is_near(&numbers(&steps, "t"), &refracted));
    assert!(is_near(&numbers(&steps, Formula::FresnelS.name()), &[s]));
    assert!(is_near(&numbers(&steps, Formula::FresnelP.name()), &[p]));
    let mix = numbers(&steps, "seen");
    assert!(
        is_near(&mix, &[0.5 * (s + p), 1.0 - 0.5 * (s + p)]),
        "{mix:?}"
    );
    assert!(is_near(&steps[7].lookup.unwrap().to_f64(), &refracted));
    // Another index is another story.
    let other = told(&state(dielectric(1.3)));
    assert!(!is_near(&numbers(&other, "t"), &refracted));
    assert!(!is_near(&numbers(&other, "seen"), &mix));
}

#[test]
fn total_reflection_is_said_and_nothing_is_looked_up_below() {
    // n1/n2 = 2: critical at 30 degrees, and the ray comes at 37.
    let steps = told(&state(dielectric(0.5)));
    let at = titles(&steps)
        .iter()
        .position(|title| *title == "Total internal reflection")
        .unwrap();
    assert!((numbers(&steps[at..], "critical angle")[0] - 30.0).abs() < 1e-3);
    assert!(steps[5].text.contains("below 0"));
    assert_eq!(steps.iter().filter(|step| step.lookup.is_some()).count(), 1);
    let last = steps.last().unwrap();
    assert_eq!(last.marks.len(), 1, "the reflected ray alone");
    assert_eq!(numbers(&steps, "seen"), [1.0, 0.0]);
    assert!(!titles(&told(&state(dielectric(1.25)))).contains(&"Total internal reflection"));
}

#[test]
fn glass_parts_the_colours_and_shows_eight_of_them() {
    let mut state = state(Material {
        surface: Surface::Glass,
        wavelengths: 16,
        ..Material::default()
    });
    let all = told(&state);
    let lookups = &all[7];
    assert_eq!(lookups.marks.len(), 8);
    let distinct: std::collections::HashSet<_> = lookups.marks.iter().map(|m| m.color).collect();
    assert_eq!(distinct.len(), 8);
    // Short waves come first and are bent most: farthest from the ray's own direction, +z.
    let along: Vec<f64> = lookups.marks.iter().map(|mark| mark.dir.z).collect();
    assert!(along.windows(2).all(|w| w[0] < w[1]), "{along:?}");
    state.material.wavelengths = 3;
    assert_eq!(told(&state)[7].marks.len(), 3);
    state.material.surface = Surface::Mirror;
    assert_eq!(told(&state).len(), 5);
}

#[test]
fn through_both_surfaces_the_parts_sum_to_one() {
    for (object, x) in [
        (Object::Sphere, 0.6),
        (Object::Torus, 0.6),
        (Object::Teapot, 0.1),
    ] {
        let mut state = state(Material {
            surfaces: Surfaces::Both,
            bounces: 3,
            ..dielectric(1.5)
        });
        state.object = object;
        state.eye_ray = Some(EyeRay {
            origin: [x, 0.0, -3.2],
            dir: [0.0, 0.0, 1.0],
            is_right: false,
        });
        let steps = told(&state);
        let last = steps.last().unwrap();
        assert_eq!(last.title, "The ways out", "{object}");
        let parts: f64 = last
            .numbers
            .iter()
            .map(|(_, value)| value.parse::<f64>().unwrap())
            .sum();
        // Six numbers of four places.
        assert!((parts - 1.0).abs() < 4e-4, "{object}: {parts}");
        let without_last = parts - last.numbers[1].1.parse::<f64>().unwrap();
        assert!((without_last - 1.0).abs() > 0.5, "{object}: {without_last}");
        assert!(last.lookup.is_some() && !last.marks.is_empty());
    }
}

#[test]
fn every_surface_tells_a_story_that_ends_in_what_is_seen() {
    for (surface, end) in [
        (Surface::Mirror, "Its lookup"),
        (Surface::Dielectric, "The mix"),
        (Surface::Metal, "The metal's tint"),
        (Surface::Glass, "The mix"),
        (Surface::Veil, "The blend"),
        (Surface::Ball, "The picture of the ball"),
    ] {
        let steps = told(&state(Material {
            surface,
            ..Material::default()
        }));
        assert_eq!(steps.last().unwrap().title, end);
        for step in &steps {
            assert!(
                !step.text.is_empty() && !step.numbers.is_empty(),
                "{}",
                step.title
            );
            assert!(!step.text.contains("NaN"));
            assert!(step.numbers.iter().all(|(_, value)| !value.contains("NaN")));
        }
    }
}

#[test]
fn without_a_ray_or_a_hit_there_is_no_story() {
    let mut state = state(Material::default());
    state.eye_ray = None;
    assert!(told(&state).is_empty());
    state.eye_ray = Some(EyeRay {
        origin: [0.0, 0.0, -3.0],
        dir: [0.0, 1.0, 0.0],
        is_right: false,
    });
    assert!(told(&state).is_empty());
}

fn sphere_map(probe: [f32; 3]) -> Vec<StoryStep> {
    told(&AppState {
        probe,
        story: StoryState {
            open: true,
            kind: StoryKind::SphereMap,
            step: 0,
        },
        ..AppState::default()
    })
}

#[test]
fn hoffs_derivation_ends_in_hoffs_numbers() {
    let steps = sphere_map([0.48, 0.6, 0.64]);
    assert_eq!(
        titles(&steps),
        [
            "The viewer and the ball",
            "The reflected vector",
            "The half vector",
            "The normal",
            "The point on the ball",
            "m",
            "s and t",
            "The singular direction"
        ]
    );
    // r = (0.48, 0.6, -0.64) and r + (0, 0, 1) = (0.48, 0.6, 0.36) of length sqrt 0.72.
    let length = 0.72_f64.sqrt();
    for (label, wanted) in [
        ("r", &[0.48, 0.6, -0.64][..]),
        ("r + (0, 0, 1)", &[0.48, 0.6, 0.36]),
        ("its length", &[length]),
        ("n", &[0.48 / length, 0.6 / length, 0.36 / length]),
        ("u − 2(u · n) n", &[0.48, 0.6, -0.64]),
        ("x", &[0.48 / length]),
    ] {
        assert!(is_near(&numbers(&steps, label), wanted), "{label}");
    }
    let last = |label: &str| *numbers(&steps, label).last().unwrap();
    let (s, t) = (0.24 / length + 0.5, 0.3 / length + 0.5);
    assert!((last("s = rx/m + 1/2") - s).abs() < NEAR);
    assert!((last("t = ry/m + 1/2") - t).abs() < NEAR);
    // The world's own z, put in without turning it, would give other numbers.
    let wrong = 0.24 / (0.48_f64.powi(2) + 0.36 + 1.64_f64.powi(2)).sqrt() + 0.5;
    assert!((last("s = rx/m + 1/2") - wrong).abs() > 0.05);
}

#[test]
fn the_singular_direction_is_the_whole_rim() {
    let steps = sphere_map(super::sphere_map::SINGULAR);
    for label in ["n", "x", "s = rx/m + 1/2"] {
        let rows = steps.iter().flat_map(|step| &step.numbers);
        let (_, value) = rows.clone().find(|(l, _)| l == label).unwrap();
        assert!(value.contains("undefined"), "{label}: {value}");
    }
    assert!(
        steps
            .iter()
            .flat_map(|s| &s.arrows)
            .all(|a| a.to.is_finite())
    );
    let rim = &steps.last().unwrap().marks;
    let around: Vec<[f64; 2]> = rim
        .iter()
        .map(|mark| {
            let point = MappingId::Sphere.forward(mark.dir).unwrap();
            [point.u - 0.5, point.v - 0.5]
        })
        .collect();
    assert!(around.iter().all(|[x, y]| x.hypot(*y) > 0.499));
    for quarter in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
        let here = |[x, y]: &&[f64; 2]| x * quarter[0] > 0.0 && y * quarter[1] > 0.0;
        assert!(around.iter().filter(here).count() >= 8);
    }
    // On the cube the same directions lie together.
    let place = |m: &super::steps::Mark| MappingId::Cube.forward(m.dir).unwrap();
    assert!(
        rim.iter()
            .all(|m| (place(m).u - 0.5).hypot(place(m).v - 0.5) < 0.01)
    );
}

#[test]
fn walking_stops_at_both_ends() {
    let state = state(Material::default());
    let steps = told(&state);
    let at = |step| StoryState {
        step,
        ..state.story
    };
    assert_eq!(walked(at(0), &steps, false), None);
    assert_eq!(walked(at(4), &steps, true), None);
    assert_eq!(walked(at(99), &steps, true), None);
    assert_eq!(walked(at(0), &[], true), None);
    let to = |step| Some(crate::app::action::Action::SetStory(at(step)));
    assert_eq!(walked(at(1), &steps, true), to(2));
    assert_eq!(walked(at(99), &steps, false), to(3));
}

#[test]
fn the_story_starts_from_the_viewports_own_vectors() {
    let state = state(Material::default());
    let target = target_of(state.object);
    let ray = state.eye_ray.unwrap().ray();
    let hit = target.cast(ray).unwrap();
    let vectors = super::vectors(ray, &hit);
    assert_eq!(told(&state)[4].arrows, vectors);
    assert!((dir_of(vectors[2].to - vectors[2].from).length() - 0.6).abs() < 1e-6);
}
