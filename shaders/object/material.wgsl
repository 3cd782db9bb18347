// The material's numbers: twin of `Material` in src/gpu/uniforms.rs.

struct Material {
    // n1/n2 of a ray from outside, opacity, above 0 when the opacity is 1 - cos, factor on differences.
    interface_: vec4f,
    // Exponent, bias, scale, power.
    shape: vec4f,
    // Index of the metal for red, green and blue: real and imaginary part.
    metal_n: vec4f,
    metal_k: vec4f,
    // Wavelengths, inner reflections, and layers of traced paths.
    counts: vec4f,
    // To the right and up on the screen, as unit vectors in the world.
    screen_right: vec4f,
    screen_up: vec4f,
    // Weights on red, green and blue; n1/n2.
    wavelengths: array<vec4f, MOST_WAVELENGTHS>,
}

@group(1) @binding(0) var<uniform> material: Material;
@group(1) @binding(1) var ball_picture: texture_2d<f32>;
@group(1) @binding(2) var traced: texture_2d_array<f32>;

fn material_shape() -> Shape {
    return Shape(material.shape.x, material.shape.y, material.shape.z, material.shape.w);
}

// Stripes where there is nothing to be shown, so that it is not taken for darkness.
fn marked(under: vec3f, mark: vec3f, at: vec2f) -> vec3f {
    let stripe = fract((at.x + at.y) / 12.0);
    return mix(under, mark, select(0.25, 0.75, stripe < 0.5));
}

// A reflected and a refracted lookup, mixed as light; each one's overlays show as much as its light.
fn mixed(a: vec3f, b: vec3f, part_of_a: f32) -> vec3f {
    let a_right = dpdx(a);
    let a_down = dpdy(a);
    let b_right = dpdx(b);
    let b_down = dpdy(b);
    let found_a = look_up(a, a_right, a_down);
    let found_b = look_up(b, b_right, b_down);
    // Not mix(): a part above 1 is a fault that is to be seen.
    let light = found_b.light + (found_a.light - found_b.light) * part_of_a;
    let color = display(light);
    let over_a = painted(color, found_a, a, a_right, a_down);
    let over_b = painted(color, found_b, b, b_right, b_down);
    return mix(over_b, over_a, clamp(part_of_a, 0.0, 1.0));
}

// A signed difference: blue below, white at, orange above 0.
fn difference_color(difference: f32) -> vec3f {
    let amount = clamp(difference, -1.0, 1.0);
    let side = select(vec3f(0.0, 0.447, 0.698), vec3f(0.902, 0.624, 0.0), amount > 0.0);
    return mix(vec3f(1.0), side, sqrt(abs(amount)));
}
