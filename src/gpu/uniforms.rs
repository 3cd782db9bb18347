//! Blocks that both languages know: twins of the structs in the shaders, of 16-byte vectors only, so that no rule of
//! alignment can tell them apart. A test compares every offset.

use bytemuck::{Pod, Zeroable};

use crate::optics::material::WAVELENGTHS_RANGE;

/// Twin of `Bake` in `shaders/bake.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct Bake {
    /// Width and height of the chart, gutter (texels, at this level), chart.
    pub chart: [f32; 4],
    /// Texels of the environment in a radian, its last level.
    pub environment: [f32; 4],
    /// Columns: from a direction of the world to the one in the environment's picture; the fourth number is unused.
    pub environment_from_world: [[f32; 4]; 3],
}

/// Twin of `View` in `shaders/viewport.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct View {
    /// Columns; from a point relative to the eye, in world axes.
    pub clip_from_relative: [[f32; 4]; 4],
    /// The eye, exposure.
    pub eye: [f32; 4],
    /// Ahead, tone curve.
    pub forward: [f32; 4],
    /// To the right border, width in pixels.
    pub right: [f32; 4],
    /// To the upper border, height in pixels.
    pub up: [f32; 4],
    /// Unit direction, by what differences of forms are multiplied.
    pub probe: [f32; 4],
}

/// Most wavelengths in [`Material`].
pub const MOST_WAVELENGTHS: usize = WAVELENGTHS_RANGE.1 as usize;

/// Twin of `Material` in `shaders/object/material.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Material {
    /// n1/n2, opacity, above 0 when the opacity is 1 - cos, factor on differences.
    pub interface_: [f32; 4],
    /// Exponent, bias, scale, power.
    pub shape: [f32; 4],
    /// Real part of the metal's index for red, green and blue.
    pub metal_n: [f32; 4],
    /// Its imaginary part.
    pub metal_k: [f32; 4],
    /// Wavelengths, inner reflections, layers of traced paths.
    pub counts: [f32; 4],
    /// To the right on the screen, unit, in the world.
    pub screen_right: [f32; 4],
    /// Up on the screen.
    pub screen_up: [f32; 4],
    /// Weights on red, green and blue; n1/n2.
    pub wavelengths: [[f32; 4]; MOST_WAVELENGTHS],
}

/// Twin of `Panel` in `shaders/panel.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct Panel {
    /// Left, top, right, bottom in the picture.
    pub window: [f32; 4],
    /// Display values, exposure.
    pub background: [f32; 4],
    /// Width and height in pixels, tone curve.
    pub screen: [f32; 4],
    /// Above 0 when painted: great circles, face tint, grid.
    pub overlays: [f32; 4],
}

/// Name and offset of each member of a block.
type Members = Vec<(&'static str, usize)>;

/// Each block's name in WGSL, size in bytes, and members, for the test.
#[must_use]
pub fn blocks() -> Vec<(&'static str, usize, Members)> {
    macro_rules! block {
        ($block:ident: $($member:ident),+) => {
            (
                stringify!($block),
                size_of::<$block>(),
                vec![$((stringify!($member), std::mem::offset_of!($block, $member))),+],
            )
        };
    }
    vec![
        block!(Bake: chart, environment, environment_from_world),
        block!(View: clip_from_relative, eye, forward, right, up, probe),
        block!(Material: interface_, shape, metal_n, metal_k, counts, screen_right, screen_up, wavelengths),
        block!(Panel: window, background, screen, overlays),
    ]
}

/// Three numbers and a fourth.
pub(super) const fn vec4([x, y, z]: [f32; 3], w: f32) -> [f32; 4] {
    [x, y, z, w]
}
