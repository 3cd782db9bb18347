//! Every material as the device draws it, held pixel by pixel against double precision; and what a material does without.

#![cfg(feature = "explorer")]
#![expect(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

mod render;

use render::{body, bytes, direction_light, distance, frame, ray, renderer, rgb, shot, viewport};
use sixfold::gpu::{Frame, ObjectFrame, Program, Renderer, RgbaPixels, Shared, ViewportFrame};
use sixfold::imaging::ball::Style;
use sixfold::mapping::MappingId;
use sixfold::math::Vec3;
use sixfold::optics::ball::ball_paths;
use sixfold::optics::material::{Dispersion, Material, Shading, Surface, Surfaces, View};
use sixfold::optics::reflectance::{Shape, metal_reflectance};
use sixfold::optics::wavelengths::wavelengths;
use sixfold::optics::{Formula, meet, reflect, refract};
use sixfold::scene::trace::Traced;
use sixfold::scene::{Object, Ray, Target};

type Dir = Vec3<f64>;

fn dielectric(index: f32) -> Material {
    Material {
        surface: Surface::Dielectric,
        index,
        ..Material::default()
    }
}

/// Materials of every kind, each with a name.
fn materials() -> Vec<(String, Material)> {
    let mut all = vec![
        ("mirror".to_owned(), Material::default()),
        (
            "mirror, printed".to_owned(),
            Material {
                printed_reflection: true,
                ..Material::default()
            },
        ),
    ];
    for metal in sixfold::optics::metal::Metal::ALL {
        for view in [View::Whole, View::Reflectance] {
            let material = Material {
                surface: Surface::Metal,
                metal,
                view,
                ..Material::default()
            };
            all.push((format!("{} {view:?}", metal.name()), material));
        }
    }
    for formula in Formula::ALL {
        for view in [View::Whole, View::Reflectance, View::Difference] {
            let material = Material {
                formula,
                view,
                // Against itself nothing would be seen.
                other_formula: if formula == Formula::Cg {
                    Formula::Fresnel
                } else {
                    Formula::Cg
                },
                magnification: 1.5,
                ..dielectric(1.5)
            };
            all.push((format!("{formula:?} {view:?}"), material));
        }
    }
    for index in [0.7, 1.0 / 0.66, 2.4] {
        for view in [View::Whole, View::Refraction, View::Discriminant] {
            let material = Material {
                view,
                ..dielectric(index)
            };
            all.push((format!("index {index} {view:?}"), material));
        }
    }
    for dispersion in Dispersion::ALL {
        for view in [View::Whole, View::Refraction] {
            let glass = Material {
                surface: Surface::Glass,
                dispersion,
                view,
                wavelengths: 5,
                ..dielectric(1.6)
            };
            all.push((format!("{dispersion:?} {view:?}"), glass));
        }
    }
    for (opacity, opacity_by_angle) in [(0.3, false), (0.8, false), (0.5, true)] {
        for view in [View::Whole, View::Opacity] {
            let veil = Material {
                surface: Surface::Veil,
                opacity,
                opacity_by_angle,
                view,
                ..Material::default()
            };
            all.push((format!("veil {opacity} {opacity_by_angle} {view:?}"), veil));
        }
    }
    for bounces in [0, 1, 3] {
        let both = Material {
            surfaces: Surfaces::Both,
            bounces,
            ..dielectric(1.5)
        };
        all.push((format!("both surfaces, {bounces}"), both.clone()));
        let difference = Material {
            view: View::SurfaceDifference,
            magnification: 2.0,
            ..both.clone()
        };
        all.push((format!("difference of surfaces, {bounces}"), difference));
        let glass = Material {
            surface: Surface::Glass,
            wavelengths: 3,
            ..both
        };
        all.push((format!("both surfaces of glass, {bounces}"), glass));
    }
    all
}

fn light(dir: Dir) -> [f64; 3] {
    direction_light(dir.to_f64()).map(f64::from)
}

fn sum(a: [f64; 3], b: [f64; 3], part_of_b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] + b[i] * part_of_b[i])
}

fn mixed(b: [f64; 3], a: [f64; 3], part_of_a: f64) -> [f64; 3] {
    std::array::from_fn(|i| b[i] + (a[i] - b[i]) * part_of_a)
}

fn screen(light: [f64; 3]) -> [f64; 3] {
    bytes(light.map(|c| c as f32))
}

/// Bytes of a display value.
fn plain(display: [f64; 3]) -> [f64; 3] {
    display.map(|c| 255.0 * c.clamp(0.0, 1.0))
}

/// Weights and directions of the refracted light; the reflected direction where there is none.
fn refracted(material: &Material, incident: Dir, normal: Dir) -> Vec<([f64; 3], Dir, f64)> {
    let line = |line: sixfold::optics::wavelengths::Wavelength| {
        let eta = f64::from(line.eta);
        let dir = refract(incident, normal, eta).unwrap_or(reflect(incident, normal));
        (line.rgb.map(f64::from), dir, eta)
    };
    wavelengths(material).into_iter().map(line).collect()
}

/// What the pixel must hold in bytes, `None` where it is marked by stripes.
fn expected(material: &Material, incident: Dir, normal: Dir) -> Option<[f64; 3]> {
    let shape = Shape {
        exponent: f64::from(material.shape.exponent),
        bias: f64::from(material.shape.bias),
        scale: f64::from(material.shape.scale),
        power: f64::from(material.shape.power),
    };
    let eta = f64::from(material.eta());
    let mut mirrored = reflect(incident, normal);
    if material.printed_reflection {
        mirrored = -mirrored;
    }
    let lines = refracted(material, incident, normal);
    let through = lines
        .iter()
        .fold([0.0; 3], |all, (rgb, dir, _)| sum(all, light(*dir), *rgb))
        .map(|c| c.max(0.0));
    let middle_eta = lines[lines.len() / 2].2;
    let meeting = meet(incident, normal, eta);
    let part =
        |formula: Formula, eta: f64| formula.reflectance(&meet(incident, normal, eta), &shape);
    let metal = material.metal.index_rgb().map(|[n, k]| {
        // As the device gets them.
        let [n, k] = [n, k].map(|x| f64::from(x as f32));
        metal_reflectance(meeting.cos_incident, n, k)
    });
    let opacity = if material.opacity_by_angle {
        1.0 - meeting.cos_incident
    } else {
        f64::from(material.opacity)
    };
    let both = || {
        lines.iter().fold([0.0; 3], |all, (rgb, _, eta)| {
            let ways = ball_paths(incident, normal, *eta, material.bounces);
            ways.into_iter().fold(all, |all, way| {
                sum(all, light(way.dir), rgb.map(|c| c * way.weight))
            })
        })
    };
    let is_through = material.surfaces == Surfaces::Both;
    Some(match (material.view, material.surface) {
        (View::SurfaceDifference, _) => {
            let one = mixed(through, light(mirrored), part(material.formula, eta));
            let [both, one] = [both(), one].map(|light| screen(light).map(|c| c / 255.0));
            let factor = f64::from(material.magnification);
            plain(std::array::from_fn(|i| factor * (both[i] - one[i]).abs()))
        }
        (View::Whole, Surface::Dielectric | Surface::Glass) if is_through => screen(both()),
        (View::Whole, Surface::Dielectric | Surface::Glass) => screen(mixed(
            through,
            light(mirrored),
            part(material.formula, middle_eta),
        )),
        (View::Whole, Surface::Metal) => screen(sum([0.0; 3], light(mirrored), metal)),
        (View::Whole, Surface::Veil) => screen(mixed(light(incident), light(mirrored), opacity)),
        (View::Whole | View::Reflection, _) => screen(light(mirrored)),
        (View::Refraction, _) if meet(incident, normal, middle_eta).is_total() => return None,
        (View::Refraction, _) => screen(through),
        (View::Discriminant, _) if meeting.is_total() => return None,
        (View::Discriminant, _) => plain([meeting.k; 3]),
        (View::Reflectance, Surface::Metal) => plain(metal),
        (View::Reflectance, _) => {
            let part = part(material.formula, eta);
            if part > 1.0 {
                return None;
            }
            plain([part; 3])
        }
        (View::Difference, _) => {
            let difference = (part(material.formula, eta) - part(material.other_formula, eta))
                * f64::from(material.magnification);
            let difference = difference.clamp(-1.0, 1.0);
            let side = if difference > 0.0 {
                [0.902, 0.624, 0.0]
            } else {
                [0.0, 0.447, 0.698]
            };
            plain(mixed([1.0; 3], side, difference.abs().sqrt()))
        }
        (View::Opacity, _) => plain([opacity; 3]),
    })
}

fn object(material: Material) -> ObjectFrame {
    ObjectFrame {
        material,
        ..ObjectFrame::default()
    }
}

fn seen(material: Material) -> ViewportFrame {
    ViewportFrame {
        size_px: [160, 120],
        object: object(material),
        ..viewport(MappingId::Octahedral)
    }
}

/// Pixels well inside the body, as (place, incident, normal).
fn inside(view: &ViewportFrame, target: &Target) -> Vec<([u32; 2], Dir, Dir)> {
    let mut found = Vec::new();
    let [width, height] = view.size_px;
    for y in (1..height).step_by(3) {
        for x in (1..width).step_by(3) {
            let dir = ray(&view.camera, [x, y], view.size_px);
            let hit = target.cast(Ray {
                origin: view.camera.eye(),
                dir: glam::DVec3::from(dir.to_f64()).as_vec3(),
            });
            let Some(hit) = hit else { continue };
            let normal = Vec3::from(hit.normal.as_dvec3().to_array());
            // Towards the silhouette one pixel covers too many directions.
            if dir.dot(normal) < -0.25 {
                found.push(([x, y], dir, normal));
            }
        }
    }
    found
}

/// Largest difference in bytes between a picture and what a material must show.
fn worst(picture: &RgbaPixels, pixels: &[([u32; 2], Dir, Dir)], material: &Material) -> f64 {
    pixels
        .iter()
        .filter_map(|(at, incident, normal)| {
            let expected = expected(material, *incident, *normal)?;
            Some(distance(
                rgb(picture.pixel(at[0], at[1]).unwrap()),
                expected,
            ))
        })
        .fold(0.0, f64::max)
}

#[test]
fn every_material_is_drawn_as_computed() {
    // In bytes of 255. The map's own texels are off by up to 1.2e-3, which a dark value magnifies.
    const BUDGET: f64 = 3.0;
    let mut renderer = renderer([256, 128], direction_light);
    let first = seen(Material::default());
    let pixels = inside(&first, &first.body.target);
    assert!(pixels.len() > 500, "{}", pixels.len());
    let materials = materials();
    let mut largest = 0.0_f64;
    for (i, (name, material)) in materials.iter().enumerate() {
        let picture = shot(&mut renderer, &frame(Some(seen(material.clone())), &[]));
        let observed = worst(&picture, &pixels, material);
        // What a fault extrapolates and what is magnified comes with its error.
        let factor = match (material.view, material.formula) {
            (View::Whole, Formula::PrintedSign) => 3.0,
            (View::SurfaceDifference, _) => f64::from(material.magnification),
            _ => 1.0,
        };
        let observed = observed / factor;
        assert!(observed <= BUDGET, "{name}: {observed:.2} of {BUDGET}");
        largest = largest.max(observed);
        // Control: some other material's numbers do not fit this picture.
        let (other_name, other) = materials
            .iter()
            .cycle()
            .skip(i + 1)
            .find(|(_, other)| expected(other, pixels[0].1, pixels[0].2).is_some())
            .unwrap();
        let control = worst(&picture, &pixels, other);
        assert!(
            control > 2.0 * BUDGET,
            "{name} passes for {other_name}: {control:.2}"
        );
    }
    println!(
        "{} materials, worst {largest:.2} of {BUDGET} bytes",
        materials.len()
    );
    assert!(
        largest > BUDGET / 4.0,
        "the budget is too wide: {largest:.2}"
    );
}

#[test]
fn what_cannot_be_shown_is_marked() {
    let mut renderer = renderer([64, 32], direction_light);
    let [total, fault] = sixfold::gpu::kit::MARK_COLORS.map(|color| color.map(f64::from));
    let printed = Material {
        formula: Formula::PrintedSign,
        view: View::Reflectance,
        ..dielectric(1.5)
    };
    // From within glass half of the sphere reflects all light.
    let inside_out = |view| Material {
        view,
        ..dielectric(0.5)
    };
    for (material, mark, is_marked) in [
        (printed.clone(), fault, true),
        (inside_out(View::Refraction), total, true),
        (inside_out(View::Discriminant), total, true),
        (
            Material {
                formula: Formula::Schlick,
                ..printed
            },
            fault,
            false,
        ),
    ] {
        let picture = shot(&mut renderer, &frame(Some(seen(material.clone())), &[]));
        let view = seen(material.clone());
        let marked = inside(&view, &view.body.target)
            .into_iter()
            .filter(|(_, incident, normal)| expected(&material, *incident, *normal).is_none());
        // Three quarters of the mark over whatever lies below, or one quarter.
        let stripes = marked.filter(|(at, ..)| {
            let pixel = rgb(picture.pixel(at[0], at[1]).unwrap());
            (0..3).all(|i| pixel[i] > 0.15 * 255.0 * mark[i])
        });
        assert_eq!(stripes.count() > 100, is_marked, "{material:?}");
    }
}

#[test]
fn a_vertex_knows_less_than_a_pixel() {
    let mut renderer = renderer([256, 128], direction_light);
    let mirror = Material::default();
    let per_vertex = |shading| Material {
        shading,
        ..Material::default()
    };
    let mut error = |density: u32, shading: Shading| {
        let mut view = seen(per_vertex(shading));
        view.body.target = Shared::new(Target::new(Object::Sphere.mesh_at(density)));
        let fine = seen(mirror.clone());
        let pixels = inside(&fine, &fine.body.target);
        let picture = shot(&mut renderer, &frame(Some(view), &[]));
        worst(&picture, &pixels, &mirror)
    };
    let vector = [2, 8, 32].map(|density| error(density, Shading::VectorPerVertex));
    println!("vector per vertex, densities 2, 8, 32: {vector:.1?} bytes");
    assert!(
        vector[0] > 2.0 * vector[1] && vector[1] > vector[2],
        "{vector:?}"
    );
    assert!(vector[2] < 4.0, "{vector:?}");
    // Where a triangle spans faces the coordinates are wrong however fine the mesh is, and are marked.
    let coordinates = error(32, Shading::CoordinatesPerVertex);
    assert!(coordinates > 40.0, "{coordinates}");
}

#[test]
fn a_ball_picture_is_looked_up_by_the_normal() {
    let mut renderer = renderer([64, 32], direction_light);
    let material = Material {
        surface: Surface::Ball,
        ..Material::default()
    };
    let mut view = seen(material);
    let pixels = inside(&view, &view.body.target);
    let mut show = |style: Style| {
        let picture = style.pixels();
        view.object.ball = Some(Shared::new(picture.clone()));
        let drawn = shot(&mut renderer, &frame(Some(view.clone()), &[]));
        let place = |x: f64, y: f64| {
            let texel = |c: f64| ((0.5 + 0.498 * c) * 512.0) as usize;
            let index = (texel(-y) * 512 + texel(x)) * 4;
            [0, 1, 2].map(|i| f64::from(picture.rgba[index + i]))
        };
        // From the default eye the ray through the middle sees the normal -z in the picture's middle.
        let middle = rgb(drawn.pixel(80, 60).unwrap());
        (distance(middle, place(0.0, 0.0)), drawn)
    };
    let (toon, drawn) = show(Style::Toon);
    assert!(toon < 4.0, "{toon}");
    let (studio, other) = show(Style::Studio);
    assert!(studio < 4.0, "{studio}");
    let differs = pixels.iter().map(|(at, ..)| {
        let at = [at[0], at[1]];
        distance(
            rgb(drawn.pixel(at[0], at[1]).unwrap()),
            rgb(other.pixel(at[0], at[1]).unwrap()),
        )
    });
    assert!(differs.fold(0.0, f64::max) > 50.0);
}

/// What the renderer says a pixel of the object costs.
fn cost(renderer: &mut Renderer, frame: &Frame) -> (u32, u32) {
    let report = renderer.draw(frame).unwrap();
    (report.object[0].reflected, report.object[0].refracted)
}

#[test]
fn what_a_material_does_not_need_is_not_looked_up_and_not_in_its_shader() {
    let mut renderer = renderer([64, 32], direction_light);
    let glass = |wavelengths| Material {
        surface: Surface::Glass,
        wavelengths,
        ..Material::default()
    };
    for (material, lookups) in [
        (Material::default(), (1, 0)),
        (dielectric(1.5), (1, 1)),
        (glass(3), (1, 3)),
        (glass(16), (1, 16)),
        (
            Material {
                view: View::Discriminant,
                ..dielectric(1.5)
            },
            (0, 0),
        ),
    ] {
        let frame = frame(Some(seen(material.clone())), &[]);
        assert_eq!(cost(&mut renderer, &frame), lookups, "{material:?}");
    }
    let mirror = Program::Mirror { printed: false }.source();
    assert!(!mirror.contains("refracted_dir(") && !mirror.contains("for ("));
    let dielectric = Program::Dielectric(Formula::Fresnel).source();
    assert!(dielectric.contains("refracted_dir(") && !dielectric.contains("for ("));
    assert!(Program::Glass(Formula::Fresnel).source().contains("for ("));
}

#[test]
fn two_materials_stand_side_by_side() {
    let mut renderer = renderer([256, 128], direction_light);
    let [left, right] = [Material::default(), dielectric(1.5)];
    let view = ViewportFrame {
        right_object: Some(object(right.clone())),
        ..seen(left.clone())
    };
    let picture = shot(&mut renderer, &frame(Some(view.clone()), &[]));
    let pixels = inside(&view, &body(Object::Sphere).target);
    let (lefts, rights): (Vec<_>, Vec<_>) = pixels.into_iter().partition(|(at, ..)| at[0] < 80);
    assert!(worst(&picture, &lefts, &left) < 3.0);
    assert!(worst(&picture, &rights, &right) < 3.0);
    assert!(worst(&picture, &lefts, &right) > 20.0);
}

#[test]
fn traced_paths_are_summed_whatever_their_number_and_shape() {
    let mut renderer = renderer([256, 128], direction_light);
    let dirs: [Dir; 6] = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.6, 0.0, 0.8],
        [0.0, -0.6, 0.8],
        [-0.8, 0.0, 0.6],
    ]
    .map(Vec3::from_f64);
    let weights = [0.3, 0.05, 0.2, 0.1, 0.25, 0.1];
    // As many layers as a cube has faces, square and not: an interface that takes such a texture for a cube shows black.
    for (size, layers) in [([96, 96], 6), ([96, 80], 6), ([96, 96], 2)] {
        let pixels = (size[0] * size[1]) as usize;
        let traced = |weights: &[f64]| {
            let layer = |i: usize| {
                let [x, y, z] = dirs[i].to_f64().map(|c| c as f32);
                std::iter::repeat_n([x, y, z, weights[i] as f32], pixels)
            };
            Traced {
                size,
                layers,
                dirs: (0..layers as usize).flat_map(layer).collect(),
            }
        };
        let material = Material {
            surfaces: Surfaces::Both,
            bounces: layers - 2,
            ..dielectric(1.5)
        };
        let mut view = ViewportFrame {
            size_px: size,
            body: body(Object::RoundedCube),
            ..seen(material)
        };
        view.object.traced = Some(Shared::new(traced(&weights)));
        let picture = shot(&mut renderer, &frame(Some(view.clone()), &[]));
        let expected = |weights: &[f64]| {
            let ways = weights.iter().zip(&dirs).take(layers as usize);
            screen(ways.fold([0.0; 3], |all, (w, dir)| sum(all, light(*dir), [*w; 3])))
        };
        let middle = rgb(picture.pixel(size[0] / 2, size[1] / 2).unwrap());
        let observed = distance(middle, expected(&weights));
        assert!(
            observed < 3.0,
            "{size:?} x {layers}: {observed:.2} of 3 bytes"
        );
        // Control: without the last layer it would be another colour.
        let mut fewer = weights;
        fewer[layers as usize - 1] = 0.0;
        assert!(distance(middle, expected(&fewer)) > 6.0);
        // Paths of another size say nothing of this view: one surface is shown.
        view.size_px = [80, 64];
        let other = frame(Some(view), &[]);
        assert_eq!(cost(&mut renderer, &other), (1, 1));
    }
}
