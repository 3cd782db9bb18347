//! What the renderer draws and what it leaves out, and what it refuses.

#![cfg(feature = "explorer")]
#![allow(
    missing_docs,
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

mod render;

use render::*;
use sixfold::gpu::{
    EnvironmentSource, Frame, Gpu, Node, PanelFrame, RenderError, Renderer, ViewportFrame, map_size,
};
use sixfold::mapping::MappingId;
use sixfold::scene::Object;

#[test]
fn nothing_runs_that_is_not_needed() {
    use MappingId::{Ccm, Cube, Latlong};
    let mut renderer = renderer([64, 32], direction_light);
    let view = viewport(Ccm);
    let both = [panel(Ccm), panel(Cube)];
    let mut seen = Frame {
        complete: false,
        ..frame(Some(view.clone()), &both)
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
    let mut changed = view.clone();
    changed.camera.orbit(0.3, 0.1);
    let orbited = changed.clone();
    changed.probe = [0.6, 0.0, 0.8];
    changed.show_probe = true;
    let probed = changed.clone();
    changed.body = render::body(Object::Torus);
    for view in [orbited, probed, changed.clone()] {
        seen.viewport = Some(view);
        assert_eq!(renderer.draw(&seen).unwrap().ran, [Node::Viewport]);
    }
    // A probe that is not shown changes nothing.
    seen.viewport = Some(ViewportFrame {
        show_probe: false,
        ..changed.clone()
    });
    renderer.draw(&seen).unwrap();
    seen.viewport = Some(ViewportFrame {
        show_probe: false,
        probe: [1.0, 0.0, 0.0],
        ..changed.clone()
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
    for bad in [frame(Some(huge_view), &[]), frame(None, &[huge_panel])] {
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

#[test]
fn shaders_compiled_aside_give_the_same_picture_and_keep_nobody_waiting() {
    let mut here = renderer([64, 32], direction_light);
    let seen = frame(Some(viewport(MappingId::Ccm)), &[panel(MappingId::Cube)]);
    here.draw(&seen).unwrap();
    let picture = |renderer: &Renderer| {
        let view = renderer
            .read_texture(renderer.viewport_texture().unwrap())
            .unwrap();
        let panel = renderer.panel_texture(MappingId::Cube).unwrap();
        (view, renderer.read_texture(panel).unwrap())
    };
    let mut aside = renderer([64, 32], direction_light);
    let patient = Frame {
        compile_aside: true,
        ..seen.clone()
    };
    // On GL a device belongs to one thread at a time, so there nothing is compiled aside.
    let on_gl = aside.gpu().adapter_info.backend == wgpu::Backend::Gl;
    let first = aside.draw(&patient).unwrap();
    assert_eq!(first.is_pending(), !on_gl, "{first}");
    let mut settle = |frame: &Frame| {
        for _ in 0..2000 {
            if !aside.draw(frame).unwrap().is_pending() {
                return picture(&aside);
            }
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        panic!("still pending: {:?}", aside.report());
    };
    assert!(settle(&patient) == picture(&here));
    // Another shader: until it is there the old picture stays, then both are alike again.
    let with = |frame: &Frame| {
        let mut frame = frame.clone();
        frame.viewport.as_mut().unwrap().overlays.grid = true;
        frame
    };
    let before = picture(&here);
    here.draw(&with(&seen)).unwrap();
    assert!(picture(&here).0 != before.0);
    assert!(settle(&with(&patient)) == picture(&here));
}
