// Optics at one interface: twin of src/optics/reflection.rs, refraction.rs and reflectance.rs. `incident` and `normal` are unit;
// the normal is turned to face the ray. `eta` is n1/n2.

struct Meeting {
    eta: f32,
    cos_incident: f32,
    // cos^2 of the refracted ray; below zero where all light is reflected.
    k: f32,
    cos_refracted: f32,
}

// The numbers of the approximations.
struct Shape {
    exponent: f32,
    bias: f32,
    scale: f32,
    power: f32,
}

fn reflected_dir(incident: vec3f, normal: vec3f) -> vec3f {
    return incident - 2.0 * dot(incident, normal) * normal;
}

// --- More digits than f32 has. A compiler may reorder and contract sums, which breaks the twin's way (double_word.rs). Here
// a number is the sum of three: multiples of 2^-20, multiples of 2^-39, and a rest. Up to 16 such sums of size 16 lose nothing
// in the first two, whatever their order, and 2^-60 in the third.

fn on_grids(x: f32) -> vec3f {
    let high = trunc(x * 0x1p20f) * 0x1p-20f;
    let left = x - high;
    let middle = trunc(left * 0x1p39f) * 0x1p-39f;
    return vec3f(high, middle, left - middle);
}

// The upper 12 of a number's 24 digits: products of halves are exact.
fn upper_half(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) & 0xfffff000u);
}

fn product_on_grids(a: f32, b: f32) -> vec3f {
    let a_high = upper_half(a);
    let b_high = upper_half(b);
    let a_low = a - a_high;
    let b_low = b - b_high;
    return on_grids(a_high * b_high) + on_grids(a_high * b_low) + on_grids(a_low * b_high) + on_grids(a_low * b_low);
}

fn dot_on_grids(a: vec3f, b: vec3f) -> vec3f {
    return product_on_grids(a.x, b.x) + product_on_grids(a.y, b.y) + product_on_grids(a.z, b.z);
}

fn from_grids(x: vec3f) -> f32 {
    return (x.x + x.y) + x.z;
}

// k = 1 - eta^2 + (eta cos)^2 where the terms cancel, given cos = dot_on_grids(incident, normal).
fn k_on_grids(incident: vec3f, normal: vec3f, eta: f32, cos: vec3f) -> f32 {
    // The vectors are unit to 2^-23 only: 1/(|incident| |normal|) - 1.
    let one = vec3f(1.0, 0.0, 0.0);
    let excess = 0.5 * (from_grids(dot_on_grids(incident, incident) - one) + from_grids(dot_on_grids(normal, normal) - one));
    let shrink = excess * (1.5 * excess - 1.0);
    // g = eta cos, as 12 digits, the next 12, and what is left.
    let g = product_on_grids(eta, cos.x) + product_on_grids(eta, cos.y)
        + on_grids(eta * cos.z) + on_grids(eta * from_grids(cos) * shrink);
    let g0 = upper_half(from_grids(g));
    let g1 = upper_half(from_grids(vec3f(g.x - g0, g.y, g.z)));
    let g2 = from_grids(vec3f((g.x - g0) - g1, g.y, g.z));
    let g_squared = on_grids(g0 * g0) + on_grids(2.0 * g0 * g1) + on_grids(g1 * g1) + on_grids(2.0 * (g0 + g1) * g2);
    return from_grids(g_squared + one - product_on_grids(eta, eta));
}

// The cosine with its sign, right to its last digits also where the ray grazes.
fn signed_cosine(incident: vec3f, normal: vec3f) -> f32 {
    let cos = dot(incident, normal);
    if abs(cos) > NEARLY_GRAZING {
        return cos;
    }
    return from_grids(dot_on_grids(incident, normal));
}

// Below this an inner product of unit vectors may lose its sign to rounding, which is below 2^-22.
const NEARLY_GRAZING: f32 = 0x1p-20f;
// Between these k is computed to more digits. The root of k has 1/(2 sqrt k) times its error, which is eta^2 2^-22 at most; below
// them all light is reflected for certain. A ray that enters glass or water stays above them.
const K_CERTAINLY_TOTAL: f32 = -0.001;
const K_EASY: f32 = 0.25;

fn meet(incident: vec3f, normal: vec3f, eta: f32) -> Meeting {
    var cos_incident = min(abs(dot(incident, normal)), 1.0);
    let sine = cross(incident, normal);
    var k = 1.0 - eta * eta * dot(sine, sine);
    if k > K_CERTAINLY_TOTAL && k < K_EASY {
        let cos = dot_on_grids(incident, normal);
        cos_incident = min(abs(from_grids(cos)), 1.0);
        k = k_on_grids(incident, normal, eta, cos);
    }
    return Meeting(eta, cos_incident, k, sqrt(max(k, 0.0)));
}

// The refracted ray; the reflected one where all light is reflected, so that no lookup ever gets the zero vector.
fn refracted_dir(incident: vec3f, normal: vec3f, m: Meeting) -> vec3f {
    if m.k < 0.0 {
        return reflected_dir(incident, normal);
    }
    let facing = normal * select(1.0, -1.0, signed_cosine(incident, normal) > 0.0);
    return unit(incident * m.eta + facing * (m.eta * m.cos_incident - m.cos_refracted));
}

// --- How much is reflected

fn head_on(eta: f32) -> f32 {
    let ratio = (1.0 - eta) / (1.0 + eta);
    return ratio * ratio;
}

fn reflectance_ratio(a: f32, b: f32, m: Meeting) -> f32 {
    if m.k < 0.0 {
        return 1.0;
    }
    let sum = a + b;
    if sum < SMALLEST_NORMAL {
        return 0.0;
    }
    let ratio = (a - b) / sum;
    return ratio * ratio;
}

fn fresnel_s(m: Meeting) -> f32 {
    return reflectance_ratio(m.eta * m.cos_incident, m.cos_refracted, m);
}

fn fresnel_p(m: Meeting) -> f32 {
    return reflectance_ratio(m.cos_incident, m.eta * m.cos_refracted, m);
}

// x^y for y > 0; the built-in says nothing of x = 0, and Mesa, Direct3D and Metal work with the logarithm.
fn power_of(x: f32, y: f32) -> f32 {
    if x < SMALLEST_NORMAL {
        return 0.0;
    }
    return pow(x, y);
}

fn schlick(eta: f32, change: f32, power: f32) -> f32 {
    let f = head_on(eta);
    return f + (1.0 - f) * power_of(change, power);
}

// `formula` is one of the FORMULA_ constants, written from Rust.
fn reflectance(formula: u32, m: Meeting, shape: Shape) -> f32 {
    let cos = m.cos_incident;
    switch formula {
        case FORMULA_FRESNEL_S: { return fresnel_s(m); }
        case FORMULA_FRESNEL_P: { return fresnel_p(m); }
        case FORMULA_SCHLICK: { return clamp(schlick(m.eta, 1.0 - cos, shape.exponent), 0.0, 1.0); }
        case FORMULA_CG: { return clamp(shape.bias + shape.scale * power_of(1.0 - cos, shape.power), 0.0, 1.0); }
        case FORMULA_SIMPLE: { return clamp(1.0 - power_of(cos, shape.power), 0.0, 1.0); }
        case FORMULA_PRINTED_SIGN: { return schlick(m.eta, 1.0 + cos, shape.power); }
        case FORMULA_PRINTED_MIX: { return head_on(m.eta); }
        default: { return 0.5 * (fresnel_s(m) + fresnel_p(m)); }
    }
}

fn squares(a: f32, b: f32) -> f32 {
    return a * a + b * b;
}

// A metal of index n + i k.
fn metal_reflectance(cos_incident: f32, n: f32, k: f32) -> f32 {
    let cos = cos_incident;
    let sin2 = (1.0 - cos) * (1.0 + cos);
    let d = n * n - k * k - sin2;
    let large = sqrt(0.5 * (hypotenuse(d, 2.0 * n * k) + abs(d)));
    if large < SMALLEST_NORMAL && cos < SMALLEST_NORMAL {
        return 0.0;
    }
    let small = n * k / max(large, SMALLEST_NORMAL);
    let a = select(large, small, d < 0.0);
    let b = select(small, large, d < 0.0);
    let s = squares(a - cos, b) / squares(a + cos, b);
    let p = s * squares(a * cos - sin2, b * cos) / squares(a * cos + sin2, b * cos);
    return clamp(0.5 * (s + p), 0.0, 1.0);
}
