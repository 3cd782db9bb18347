//! The renderer on whatever adapter is there; none is a failure. Pictures are compared with what the mathematics says, and
//! every comparison is shown to notice a fault.

#![cfg(feature = "explorer")]
#![allow(missing_docs, clippy::unwrap_used)]

use sixfold::gpu::{
    EnvironmentSource, Frame, Gpu, MapPixels, Node, Overlays, PanelFrame, RenderError, Renderer,
    RgbaPixels, ToneCurve, ViewportFrame, kit, map_size, uniforms,
};
use sixfold::mapping::{ChartPoint, Coverage, Domain, MappingId};
use sixfold::math::Vec3;
use sixfold::scene::{Camera, Object};

const BUDGET: u32 = 96 * 1024;

type Light = [f32; 3];

/// A latlong picture of a function of the direction.
fn picture([width, height]: [u32; 2], light: impl Fn([f64; 3]) -> Light) -> Vec<Light> {
    let mut pixels = Vec::new();
    for j in 0..height {
        for i in 0..width {
            let [u, v] = [
                (f64::from(i) + 0.5) / f64::from(width),
                (f64::from(j) + 0.5) / f64::from(height),
            ];
            let dir = MappingId::Latlong
                .inverse(ChartPoint::new(0, u, v))
                .unwrap();
            pixels.push(light(dir.to_f64()));
        }
    }
    pixels
}

fn direction_light(dir: [f64; 3]) -> Light {
    dir.map(|x| (0.5 * x + 0.5) as f32)
}

fn renderer(size: [u32; 2], light: impl Fn([f64; 3]) -> Light) -> Renderer {
    let mut renderer = Renderer::new(Gpu::headless().unwrap());
    set(&mut renderer, size, light);
    renderer
}

fn set(renderer: &mut Renderer, size: [u32; 2], light: impl Fn([f64; 3]) -> Light) {
    let pixels = picture(size, light);
    let [width, height] = size;
    renderer
        .set_environment(EnvironmentSource {
            width,
            height,
            pixels: &pixels,
        })
        .unwrap();
}

fn viewport(left: MappingId) -> ViewportFrame {
    ViewportFrame {
        size_px: [96, 80],
        camera: Camera::default(),
        object: Object::Sphere,
        left,
        right: None,
        divider: 0.5,
        overlays: Overlays::default(),
        probe: [0.0, 0.0, 1.0],
        show_probe: false,
    }
}

fn panel(mapping: MappingId) -> PanelFrame {
    PanelFrame {
        mapping,
        size_px: [120, 90],
        window: [0.0, 0.0, 1.0, 1.0],
        overlays: Overlays::default(),
        background: [10, 20, 30],
    }
}

fn frame(viewport: Option<ViewportFrame>, panels: &[PanelFrame]) -> Frame {
    Frame {
        texel_budget: BUDGET,
        exposure_ev: 0.0,
        tone: ToneCurve::Linear,
        viewport,
        panels: panels.to_vec(),
        complete: true,
    }
}

fn shot(renderer: &mut Renderer, frame: &Frame) -> RgbaPixels {
    renderer.draw(frame).unwrap();
    renderer
        .read_texture(renderer.viewport_texture().unwrap())
        .unwrap()
}

fn bytes(light: Light) -> [f64; 3] {
    ToneCurve::Linear
        .display(light, 0.0)
        .map(|x| f64::from(x) * 255.0)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

fn rgb(pixel: [u8; 4]) -> [f64; 3] {
    [pixel[0], pixel[1], pixel[2]].map(f64::from)
}

/// Longest side in radians of a texel around a chart point; infinite off the chart.
fn texel_rad(id: MappingId, point: ChartPoint<f64>, size: [u32; 2]) -> f64 {
    id.jacobian(point).map_or(f64::INFINITY, |(_, j)| {
        let [w, h] = size.map(f64::from);
        (j.du.length() / w).max(j.dv.length() / h)
    })
}

/// The direction whose light the texel of `dir` holds: itself, but for mappings of a hemisphere.
fn stored(id: MappingId, dir: Vec3<f64>) -> Vec3<f64> {
    match id.info().coverage {
        Coverage::Hemisphere(_) => id.inverse(id.forward(dir).unwrap()).unwrap(),
        _ => dir,
    }
}

fn ray(camera: &Camera, [x, y]: [u32; 2], [width, height]: [u32; 2]) -> Vec3<f64> {
    let [u, v] = [
        (x as f32 + 0.5) / width as f32,
        (y as f32 + 0.5) / height as f32,
    ];
    let dir = camera.ray((u, v), width as f32 / height as f32).dir;
    Vec3::from_f64(dir.to_array().map(f64::from))
}

#[test]
fn constant_light_stays_constant() {
    let mut renderer = renderer([37, 19], |_| [0.5, 0.25, 2.0]);
    for &id in MappingId::ALL {
        let shown = shot(&mut renderer, &frame(Some(viewport(id)), &[]));
        // Means of odd sizes may be off by one step of a half float.
        let wanted = [0.5, 0.25, 2.0];
        let is_near = |t: &Light| {
            t.iter()
                .zip(wanted)
                .all(|(x, c)| (x - c).abs() <= c / 1024.0)
        };
        for chart in 0..id.info().chart_count() {
            for level in 0..5 {
                let map = renderer.read_map(id, chart, level).unwrap();
                assert!(map.rgb.iter().all(is_near), "{id} {chart} {level}");
                assert!(!is_near(&[0.501, 0.25, 2.0]), "control");
            }
        }
        assert!(
            shown.rgba.chunks(4).all(|p| p == [188, 137, 255, 255]),
            "{id}"
        );
    }
}

/// Worst distance between texels and the light of their directions, over texels that are not drawn out.
fn worst_texel(id: MappingId, chart: u32, map: &MapPixels, turn: [f64; 3]) -> f64 {
    let size = [map.width, map.height].map(|n| n - 2 * map.gutter);
    let mut worst = 0.0f64;
    for j in 0..size[1] {
        for i in 0..size[0] {
            let [u, v] = [
                (f64::from(i) + 0.5) / f64::from(size[0]),
                (f64::from(j) + 0.5) / f64::from(size[1]),
            ];
            let point = ChartPoint::new(chart, u, v);
            if texel_rad(id, point, size) > 0.04 {
                continue;
            }
            let dir = id.inverse(point).unwrap().to_f64();
            let wanted = direction_light([dir[0] * turn[0], dir[1] * turn[1], dir[2] * turn[2]]);
            let at = (j + map.gutter) * map.width + i + map.gutter;
            let light = map.rgb[at as usize];
            worst = worst.max(distance(light.map(f64::from), wanted.map(f64::from)));
        }
    }
    worst
}

#[test]
fn every_texel_holds_the_light_of_its_direction() {
    let mut renderer = renderer([1024, 512], direction_light);
    for &id in MappingId::ALL {
        renderer.draw(&frame(None, &[panel(id)])).unwrap();
        let (mut worst, mut mirrored) = (0.0f64, f64::INFINITY);
        for chart in 0..id.info().chart_count() {
            let map = renderer.read_map(id, chart, 0).unwrap();
            worst = worst.max(worst_texel(id, chart, &map, [1.0; 3]));
            for turn in [[-1.0, 1.0, 1.0], [1.0, -1.0, 1.0]] {
                mirrored = mirrored.min(worst_texel(id, chart, &map, turn));
            }
        }
        // A half float below 1 is off by 2.4e-4 at most; the mean over a texel 0.02 wide by a tenth of that.
        println!("{id}: texels off by {worst:.2e}, mirrored {mirrored:.2}");
        assert!((1e-4..1.2e-3).contains(&worst), "{id}: {worst:e}");
        assert!(mirrored > 0.3, "{id}: control {mirrored}");
    }
}

#[test]
fn gutters_hold_the_true_neighbours() {
    let mut renderer = renderer([1024, 512], direction_light);
    let panels = [panel(MappingId::Latlong), panel(MappingId::Cube)];
    renderer.draw(&frame(None, &panels)).unwrap();
    for level in 0..5 {
        // Over the date line the first and the last columns go on.
        let map = renderer.read_map(MappingId::Latlong, 0, level).unwrap();
        let (gutter, width) = (map.gutter, map.width - 2 * map.gutter);
        let texel = |i: u32, j: u32| map.rgb[(j * map.width + i) as usize].map(f64::from);
        let mut worst = 0.0f64;
        for j in gutter..map.height - gutter {
            for k in 0..gutter {
                worst = worst.max(distance(texel(k, j), texel(k + width, j)));
            }
        }
        assert!(worst < 2e-3, "level {level}: {worst:e}");
        let j = map.height / 2;
        assert!(
            distance(texel(gutter, j), texel(gutter + width / 2, j)) > 0.5,
            "control"
        );

        // A face goes on along its own plane.
        let map = renderer.read_map(MappingId::Cube, 4, level).unwrap();
        let side = f64::from(map.width - 2 * map.gutter);
        let (mut worst, mut clamped) = (0.0f64, 0.0f64);
        for j in 0..map.height {
            for i in 0..map.width {
                let [a, b] =
                    [i, j].map(|n| (f64::from(n) + 0.5 - f64::from(map.gutter)) / side * 2.0 - 1.0);
                let light = map.rgb[(j * map.width + i) as usize].map(f64::from);
                let wanted = |a: f64, b: f64| {
                    direction_light(Vec3::new(a, -b, 1.0).normalized().to_f64()).map(f64::from)
                };
                worst = worst.max(distance(light, wanted(a, b)));
                clamped = clamped.max(distance(
                    light,
                    wanted(a.clamp(-1.0, 1.0), b.clamp(-1.0, 1.0)),
                ));
            }
        }
        println!("cube level {level}: off by {worst:.2e}, against a clamped gutter {clamped:.2e}");
        // The mean over a texel of side t is off by t^2/24; t doubles with each level, and half floats set the floor.
        let budget = 9e-4 + 6e-3 * 0.25f64.powi(4 - level as i32);
        assert!(
            (0.1 * budget..budget).contains(&worst),
            "level {level}: {worst:e}"
        );
        assert!(clamped > 3.0 * worst, "control: {clamped:e}");
    }
}

#[test]
fn the_sky_shows_each_direction_through_every_mapping() {
    let mut renderer = renderer([512, 256], direction_light);
    for &id in MappingId::ALL {
        let (mut worst, mut mirrored, mut count) = (0.0f64, 0.0f64, 0);
        for turn in 0..6 {
            let mut view = viewport(id);
            view.camera.yaw_rad = f32::from(turn as u8);
            view.camera.pitch_rad = [-1.2, 0.0, 0.7][turn % 3];
            let shown = shot(&mut renderer, &frame(Some(view), &[]));
            let [w, h] = view.size_px;
            for at in [
                [1, 1],
                [w - 2, 2],
                [2, h - 3],
                [w - 3, h - 2],
                [1, h / 2],
                [w - 1, h / 3],
            ] {
                let dir = ray(&view.camera, at, view.size_px);
                let size = renderer.map_size(id).unwrap();
                if texel_rad(id, id.forward(dir).unwrap(), size) > 0.1 {
                    continue;
                }
                count += 1;
                let color = rgb(shown.pixel(at[0], at[1]).unwrap());
                let d = stored(id, dir).to_f64();
                worst = worst.max(distance(color, bytes(direction_light(d))));
                mirrored =
                    mirrored.max(distance(color, bytes(direction_light([-d[0], d[1], d[2]]))));
            }
        }
        println!("{id}: {count} pixels off by {worst:.2} of 255, mirrored {mirrored:.1}");
        assert!(count > 20, "{id}");
        assert!((0.1..2.5).contains(&worst), "{id}: {worst}");
        assert!(mirrored > 50.0, "{id}: control {mirrored}");
    }
}

#[test]
fn the_middle_of_the_sphere_mirrors_what_lies_behind_the_viewer() {
    let mut renderer = renderer([256, 128], direction_light);
    for &id in MappingId::ALL {
        let mut view = viewport(id);
        view.size_px = [97, 81];
        let shown = shot(&mut renderer, &frame(Some(view), &[]));
        let color = rgb(shown.pixel(48, 40).unwrap());
        let (behind, ahead) = ([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]);
        let off = distance(color, bytes(direction_light(behind)));
        // The last bits of dark colours are steep in sRGB: 3.3 of 255 for a thousandth of light.
        println!("{id}: off by {off:.2} of 255");
        assert!(off < 6.0, "{id}: {color:?}");
        assert!(
            distance(color, bytes(direction_light(ahead))) > 150.0,
            "{id}: control"
        );
    }
}

/// Light that changes quickly, so that a wrong filter shows: a period of a tenth of the sphere.
fn ripples(dir: [f64; 3]) -> Light {
    let wave = |x: f64| (0.5 + 0.4 * (20.0 * x).sin()) as f32;
    [wave(dir[0]), wave(dir[1]), wave(dir[2])]
}

/// The largest errors at seams and elsewhere, `fault` added to pixels at seams.
fn seam_errors(renderer: &mut Renderer, id: MappingId, fault: f64) -> [f64; 2] {
    let [mut seam, mut elsewhere] = [0.0f64; 2];
    for (yaw, pitch) in [
        (0.0, 0.0),
        (1.6, 0.0),
        (3.1, 0.0),
        (-1.5, 0.0),
        (0.1, 1.5),
        (0.2, -1.5),
    ] {
        let mut view = viewport(id);
        view.size_px = [160, 160];
        view.camera = Camera {
            yaw_rad: yaw,
            pitch_rad: pitch,
            distance: 50.0,
            fov_y_rad: 1.6,
        };
        let shown = shot(renderer, &frame(Some(view), &[]));
        let at = |x: u32, y: u32| id.forward(ray(&view.camera, [x, y], view.size_px)).unwrap();
        for y in 1..159 {
            for x in 1..159 {
                let from_middle = (x as f64 - 79.5).hypot(y as f64 - 79.5);
                if from_middle < 6.0 {
                    continue; // the object, far away
                }
                let here = at(x, y);
                let jumps = |p: ChartPoint<f64>| {
                    p.chart != here.chart
                        || (p.u - here.u).abs() > 0.2
                        || (p.v - here.v).abs() > 0.2
                };
                let is_seam = [at(x - 1, y), at(x + 1, y), at(x, y - 1), at(x, y + 1)]
                    .into_iter()
                    .any(jumps);
                let dir = ray(&view.camera, [x, y], view.size_px).to_f64();
                let mut off = distance(rgb(shown.pixel(x, y).unwrap()), bytes(ripples(dir)));
                if is_seam {
                    off += fault;
                }
                let list = if is_seam { &mut seam } else { &mut elsewhere };
                *list = list.max(off);
            }
        }
    }
    [seam, elsewhere]
}

#[test]
fn seams_do_not_show() {
    let mut renderer = renderer([1024, 512], ripples);
    for &id in MappingId::ALL {
        // The rim of these three is one direction or mirrors the other half: there is no line to be seen.
        if matches!(
            id,
            MappingId::Sphere | MappingId::Matcap | MappingId::Angular
        ) {
            continue;
        }
        let [seam, elsewhere] = seam_errors(&mut renderer, id, 0.0);
        println!("{id}: off by {seam:.1} of 255 at seams, {elsewhere:.1} elsewhere");
        assert!(
            seam <= 1.5 * elsewhere,
            "{id}: {seam} at seams, {elsewhere} elsewhere"
        );
        // The rows of the equal-area cylinder are far apart at its poles: that is the mapping's own fault.
        let is_cylinder = id == MappingId::CylindricalEqualArea;
        let budget = if is_cylinder { 90.0 } else { 15.0 };
        assert!(
            (0.1 * budget..budget).contains(&elsewhere),
            "{id}: {elsewhere}"
        );
        let [seam, elsewhere] = seam_errors(&mut renderer, id, 2.0 * elsewhere);
        assert!(seam > 1.5 * elsewhere, "{id}: control");
    }
}

#[test]
fn panels_show_charts_where_the_layout_puts_them() {
    let mut renderer = renderer([512, 256], direction_light);
    for &id in MappingId::ALL {
        let panel = PanelFrame {
            size_px: [240, 180],
            window: [-0.1, -0.1, 1.1, 1.2],
            ..panel(id)
        };
        renderer.draw(&frame(None, &[panel])).unwrap();
        let shown = renderer
            .read_texture(renderer.panel_texture(id).unwrap())
            .unwrap();
        let [left, top, right, bottom] = panel.window.map(f64::from);
        let (mut worst, mut mirrored, mut charted, mut beside) = (0.0f64, 0.0f64, 0, 0);
        for y in (0..180).step_by(7) {
            for x in (0..240).step_by(7) {
                let place = [
                    left + (right - left) * (f64::from(x) + 0.5) / 240.0,
                    top + (bottom - top) * (f64::from(y) + 0.5) / 180.0,
                ];
                let color = shown.pixel(x, y).unwrap();
                let Some(point) = id.info().layout.chart_from_picture(place) else {
                    assert_eq!(color, [10, 20, 30, 255], "{id} at {place:?}");
                    beside += 1;
                    continue;
                };
                let Some(dir) = id.inverse(point) else {
                    continue; // beside a disc
                };
                let from_centre = (point.u - 0.5).hypot(point.v - 0.5);
                if id.info().domain == Domain::Disc && from_centre > 0.47 {
                    continue; // its border is smoothed
                }
                if texel_rad(id, point, renderer.map_size(id).unwrap()) > 0.04 {
                    continue;
                }
                let d = dir.to_f64();
                charted += 1;
                worst = worst.max(distance(rgb(color), bytes(direction_light(d))));
                mirrored = mirrored.max(distance(
                    rgb(color),
                    bytes(direction_light([-d[0], d[1], d[2]])),
                ));
            }
        }
        println!(
            "{id}: panel off by {worst:.2} of 255 in {charted} pixels, mirrored {mirrored:.0}"
        );
        assert!(charted > 100 && beside > 100, "{id}: {charted} {beside}");
        assert!(worst < 12.0, "{id}: {worst}");
        assert!(mirrored > 60.0, "{id}: control");
    }
}

#[test]
fn magnified_texels_are_crisp() {
    let mut renderer = renderer([512, 256], direction_light);
    let id = MappingId::Octahedral;
    let [width, height] = map_size(id, BUDGET).map(|n| n as f32);
    // Eight texels of 15 pixels each.
    let window = [0.5, 0.25, 0.5 + 8.0 / width, 0.25 + 6.0 / height];
    let close = PanelFrame {
        window,
        ..panel(id)
    };
    renderer.draw(&frame(None, &[close])).unwrap();
    let shown = renderer
        .read_texture(renderer.panel_texture(id).unwrap())
        .unwrap();
    for (i, j) in [(0, 0), (3, 2), (7, 5)] {
        let texel = [width as u32 / 2 + i, height as u32 / 4 + j];
        let light = renderer.read_texel(id, 0, texel).unwrap();
        for (dx, dy) in [(2, 2), (7, 7), (12, 12)] {
            let color = rgb(shown.pixel(15 * i + dx, 15 * j + dy).unwrap());
            assert!(distance(color, bytes(light)) < 1.0, "{color:?} {light:?}");
        }
    }
    let read = renderer.begin_read_texel(id, 0, [5, 6]).unwrap();
    let light = loop {
        if let Some(light) = read.poll() {
            break light.unwrap();
        }
    };
    assert_eq!(light, renderer.read_texel(id, 0, [5, 6]).unwrap());
    assert_ne!(
        light,
        renderer.read_texel(id, 0, [6, 5]).unwrap(),
        "control"
    );
    assert!(matches!(
        renderer.read_texel(id, 0, [width as u32, 0]),
        Err(RenderError::NotShown(_))
    ));
    assert!(matches!(
        renderer.read_texel(MappingId::Ccm, 0, [0, 0]),
        Err(RenderError::NotShown(_))
    ));
}

#[test]
fn tone_curves_are_the_same_on_both_sides() {
    let light = [0.02, 0.6, 7.0];
    let mut renderer = renderer([16, 8], |_| light);
    let half = light.map(|x| half::f16::from_f32(x).to_f32());
    for tone in ToneCurve::ALL {
        for exposure_ev in [-3.0, 0.0, 1.5] {
            let base = frame(Some(viewport(MappingId::Cube)), &[]);
            let shown = shot(
                &mut renderer,
                &Frame {
                    tone,
                    exposure_ev,
                    ..base
                },
            );
            let color = rgb(shown.pixel(3, 3).unwrap());
            let wanted = |ev| tone.display(half, ev).map(|x| f64::from(x) * 255.0);
            assert!(
                distance(color, wanted(exposure_ev)) < 0.6,
                "{tone:?}: {color:?}"
            );
            assert!(
                distance(color, wanted(exposure_ev + 0.3)) > 2.0,
                "{tone:?}: control"
            );
        }
    }
}

#[test]
fn the_divider_shows_one_mapping_on_each_side() {
    let mut renderer = renderer([128, 64], ripples);
    let (a, b) = (MappingId::Paraboloid, MappingId::Latlong);
    let alone = [a, b].map(|id| shot(&mut renderer, &frame(Some(viewport(id)), &[])));
    let both = ViewportFrame {
        right: Some(b),
        divider: 0.4,
        ..viewport(a)
    };
    let shown = shot(&mut renderer, &frame(Some(both), &[]));
    let column =
        |x: u32, of: &RgbaPixels| (0..80).map(|y| of.pixel(x, y).unwrap()).collect::<Vec<_>>();
    for x in 0..96 {
        let side = usize::from(x >= 38);
        assert_eq!(column(x, &shown), column(x, &alone[side]), "column {x}");
    }
    assert_ne!(alone[0], alone[1], "control");
}

#[test]
fn the_probe_is_marked_in_the_sky() {
    let mut renderer = renderer([64, 32], |_| [0.1; 3]);
    let mut view = viewport(MappingId::Eac);
    let dir = ray(&view.camera, [10, 12], view.size_px).to_f64();
    view.probe = dir.map(|x| x as f32);
    let without = shot(&mut renderer, &frame(Some(view), &[]));
    view.show_probe = true;
    let with = shot(&mut renderer, &frame(Some(view), &[]));
    let changed = |x, y| with.pixel(x, y) != without.pixel(x, y);
    assert!(with.pixel(10, 12).unwrap()[0] > 200, "the dot");
    assert!(with.pixel(17, 12).unwrap()[0] > 200, "the ring");
    assert!(changed(10, 5) && !changed(10, 16) && !changed(40, 2));
}

#[test]
fn overlays_change_the_picture_each_in_its_own_way() {
    let mut renderer = renderer([64, 32], |_| [0.2; 3]);
    let id = MappingId::Ccm;
    let with = |overlays| {
        let view = ViewportFrame {
            overlays,
            ..viewport(id)
        };
        frame(
            Some(view),
            &[PanelFrame {
                overlays,
                size_px: [480, 360],
                ..panel(id)
            }],
        )
    };
    let off = Overlays::default();
    let pictures: Vec<[RgbaPixels; 2]> = [
        off,
        Overlays {
            great_circles: true,
            ..off
        },
        Overlays {
            face_tint: true,
            ..off
        },
        Overlays { grid: true, ..off },
    ]
    .into_iter()
    .map(|overlays| {
        let view = shot(&mut renderer, &with(overlays));
        let panel = renderer
            .read_texture(renderer.panel_texture(id).unwrap())
            .unwrap();
        [view, panel]
    })
    .collect();
    for (i, a) in pictures.iter().enumerate() {
        for b in &pictures[..i] {
            assert!(a[0] != b[0], "viewport {i}");
            assert!(a[1] != b[1], "panel {i}");
        }
    }
    // The axes are the front end's.
    let report = renderer
        .draw(&with(Overlays {
            grid: true,
            axes: true,
            ..off
        }))
        .unwrap();
    assert!(report.ran.is_empty());
}

#[test]
fn nothing_runs_that_is_not_needed() {
    use MappingId::{Ccm, Cube, Latlong};
    let mut renderer = renderer([64, 32], direction_light);
    let view = viewport(Ccm);
    let both = [panel(Ccm), panel(Cube)];
    let mut seen = Frame {
        complete: false,
        ..frame(Some(view), &both)
    };

    // One map a call.
    let first = renderer.draw(&seen).unwrap();
    assert_eq!(
        first.ran,
        [Node::Map(Ccm), Node::Viewport, Node::Panel(Ccm)]
    );
    assert!(first.is_pending());
    let second = renderer.draw(&seen).unwrap();
    assert_eq!(second.ran, [Node::Map(Cube), Node::Panel(Cube)]);
    assert!(!second.is_pending());

    // A still picture.
    let still = renderer.draw(&seen).unwrap().clone();
    assert!(still.ran.is_empty() && still.skipped.len() == 5);
    assert_eq!(still.totals.submissions, 2);
    assert_eq!(renderer.draw(&seen).unwrap().totals.submissions, 2);

    // Orbit, probe, object and divider: the viewport alone.
    let mut changed = view;
    changed.camera.orbit(0.3, 0.1);
    let orbited = changed;
    changed.probe = [0.6, 0.0, 0.8];
    changed.show_probe = true;
    let probed = changed;
    changed.object = Object::Torus;
    for view in [orbited, probed, changed] {
        seen.viewport = Some(view);
        assert_eq!(renderer.draw(&seen).unwrap().ran, [Node::Viewport]);
    }
    // A probe that is not shown changes nothing.
    seen.viewport = Some(ViewportFrame {
        show_probe: false,
        ..changed
    });
    renderer.draw(&seen).unwrap();
    seen.viewport = Some(ViewportFrame {
        show_probe: false,
        probe: [1.0, 0.0, 0.0],
        ..changed
    });
    assert!(renderer.draw(&seen).unwrap().ran.is_empty());

    // A panel's window: that panel alone. Exposure: all pictures, no map.
    seen.panels[1].window = [0.2, 0.2, 0.4, 0.5];
    assert_eq!(renderer.draw(&seen).unwrap().ran, [Node::Panel(Cube)]);
    seen.exposure_ev = 1.0;
    let exposed = renderer.draw(&seen).unwrap();
    assert_eq!(
        exposed.ran,
        [Node::Viewport, Node::Panel(Ccm), Node::Panel(Cube)]
    );
    assert_eq!(exposed.totals.map_bakes, 2, "no map since the first two");

    // A view keeps its number until its size changes.
    let (id, panel_id) = (renderer.viewport_id(), renderer.panel_id(Cube));
    seen.panels[1].size_px = [50, 60];
    renderer.draw(&seen).unwrap();
    assert_eq!(renderer.viewport_id(), id);
    assert_ne!(renderer.panel_id(Cube), panel_id);

    // What is hidden is gone: panel, map, pipelines.
    let before = renderer.report().clone();
    seen.panels.truncate(1);
    let after = renderer.draw(&seen).unwrap().clone();
    assert!(after.ran.is_empty());
    assert_eq!(before.pipelines - after.pipelines, 2, "bake and panel");
    assert_eq!(before.textures - after.textures, 2, "map and panel");
    assert!(after.texture_bytes < before.texture_bytes);
    assert!(renderer.panel(Cube).is_none() && renderer.map_size(Cube).is_none());
    assert!(renderer.panel(Ccm).is_some(), "control");

    // Another mapping in the viewport: the old one keeps only what its panel needs.
    seen.viewport = Some(viewport(Latlong));
    let report = renderer.draw(&seen).unwrap();
    assert_eq!(report.ran, [Node::Map(Latlong), Node::Viewport]);
    assert_eq!(report.pipelines, 2 + 1 + 2, "bakes, panel, sky and object");
    seen.panels.clear();
    seen.viewport = None;
    let report = renderer.draw(&seen).unwrap();
    assert_eq!(
        (report.pipelines, report.textures),
        (0, 1),
        "only the environment is left"
    );
    assert!(renderer.viewport().is_none());
}

#[test]
fn a_new_environment_or_budget_bakes_anew_one_map_a_call() {
    use MappingId::{Ccm, Cube};
    let mut renderer = renderer([64, 32], direction_light);
    let mut seen = frame(None, &[panel(Ccm), panel(Cube)]);
    renderer.draw(&seen).unwrap();
    seen.complete = false;
    set(&mut renderer, [32, 16], |_| [0.25; 3]);
    let report = renderer.draw(&seen).unwrap();
    assert_eq!(report.ran, [Node::Map(Ccm), Node::Panel(Ccm)]);
    assert_eq!(
        report.pending,
        [Node::Map(Cube)],
        "its panel still shows the old one"
    );
    assert_eq!(
        renderer.draw(&seen).unwrap().ran,
        [Node::Map(Cube), Node::Panel(Cube)]
    );
    assert_eq!(renderer.read_texel(Cube, 2, [3, 4]).unwrap(), [0.25; 3]);
    seen.texel_budget *= 2;
    seen.complete = true;
    assert_eq!(renderer.draw(&seen).unwrap().ran.len(), 4);
    assert_eq!(renderer.map_size(Cube), Some(map_size(Cube, 2 * BUDGET)));
}

#[test]
fn what_is_too_large_or_wrong_is_refused() {
    let mut renderer = renderer([64, 32], direction_light);
    let good = frame(Some(viewport(MappingId::Cube)), &[]);
    let huge_view = ViewportFrame {
        size_px: [1 << 20, 4],
        ..viewport(MappingId::Cube)
    };
    let huge_panel = PanelFrame {
        size_px: [4, 1 << 20],
        ..panel(MappingId::Cube)
    };
    for bad in [
        Frame {
            texel_budget: u32::MAX,
            ..frame(Some(viewport(MappingId::Latlong)), &[])
        },
        frame(Some(huge_view), &[]),
        frame(None, &[huge_panel]),
    ] {
        let error = renderer.draw(&bad).unwrap_err();
        assert!(matches!(error, RenderError::TooLarge { .. }), "{error}");
        assert!(!error.to_string().contains('\n'));
        renderer.draw(&good).unwrap();
    }
    let pixels = [[0.0; 3]; 5];
    for (width, height) in [(2, 2), (0, 0), (5, 0), (u32::MAX, u32::MAX)] {
        let source = EnvironmentSource {
            width,
            height,
            pixels: &pixels,
        };
        assert!(matches!(
            renderer.set_environment(source),
            Err(RenderError::BadEnvironment { .. })
        ));
    }
    assert!(
        renderer.draw(&good).unwrap().ran.is_empty(),
        "the old environment stays"
    );

    // Numbers that make no sense, and sizes of 0.
    let mut strange = good.clone();
    let view = strange.viewport.as_mut().unwrap();
    view.camera.yaw_rad = f32::NAN;
    view.probe = [f32::NAN; 3];
    view.show_probe = true;
    strange.exposure_ev = f32::INFINITY;
    strange.panels.push(PanelFrame {
        window: [f32::NAN; 4],
        ..panel(MappingId::Cube)
    });
    strange.panels.push(PanelFrame {
        size_px: [0, 7],
        ..panel(MappingId::Ccm)
    });
    renderer.draw(&strange).unwrap();
    assert!(
        renderer.draw(&strange).unwrap().ran.is_empty(),
        "not even NaN redraws"
    );
    assert!(renderer.panel(MappingId::Ccm).is_none());
}

#[test]
fn a_lost_device_is_an_error() {
    let mut renderer = renderer([64, 32], direction_light);
    let mut seen = frame(Some(viewport(MappingId::Cube)), &[]);
    renderer.draw(&seen).unwrap();
    renderer.gpu().device.destroy();
    let _ = renderer
        .gpu()
        .device
        .poll(wgpu::PollType::wait_indefinitely());
    seen.exposure_ev = 1.0;
    let error = renderer.draw(&seen).unwrap_err();
    assert!(matches!(error, RenderError::DeviceLost(_)), "{error}");
    assert!(renderer.read_texel(MappingId::Cube, 0, [0, 0]).is_err());
}

#[test]
fn without_an_environment_nothing_is_drawn() {
    let mut renderer = Renderer::new(Gpu::headless().unwrap());
    let seen = frame(Some(viewport(MappingId::Cube)), &[panel(MappingId::Cube)]);
    let report = renderer.draw(&seen).unwrap();
    assert!(report.ran.is_empty() && !report.is_pending());
    assert_eq!((report.textures, report.pipelines), (0, 0));
}

/// The module of a text, checked by naga.
fn module(source: &str) -> naga::Module {
    let module = naga::front::wgsl::parse_str(source)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    let capabilities = naga::valid::Capabilities::empty();
    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), capabilities)
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    module
}

#[test]
fn every_pass_is_valid_and_blocks_agree() {
    let all = kit::Variant {
        great_circles: true,
        face_tint: true,
        grid: true,
        probe: true,
        level: true,
    };
    let mut modules = vec![module(kit::HALVE)];
    for &id in MappingId::ALL {
        modules.push(module(&kit::bake_source(id)));
        modules.push(module(&kit::panel_source(id)));
        for variant in [kit::Variant::default(), all] {
            modules.push(module(&kit::viewport_source(id, variant)));
        }
    }
    for (name, size, members) in uniforms::blocks() {
        let found: Vec<_> = modules
            .iter()
            .flat_map(|m| m.types.iter().map(|(_, t)| t))
            .filter(|t| t.name.as_deref() == Some(name))
            .collect();
        assert!(!found.is_empty(), "no pass has a block {name}");
        for block in found {
            let naga::TypeInner::Struct {
                members: theirs,
                span,
            } = &block.inner
            else {
                panic!("{name} is no struct");
            };
            assert_eq!(*span as usize, size, "{name}");
            let theirs: Vec<_> = theirs
                .iter()
                .map(|m| (m.name.clone().unwrap(), m.offset as usize))
                .collect();
            let ours: Vec<_> = members
                .iter()
                .map(|(n, at)| ((*n).to_owned(), *at))
                .collect();
            assert_eq!(theirs, ours, "{name}");
        }
    }
}
