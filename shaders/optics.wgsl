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

fn meet(incident: vec3f, normal: vec3f, eta: f32) -> Meeting {
    let cos_incident = min(abs(dot(incident, normal)), 1.0);
    let k = 1.0 - eta * eta * (1.0 - cos_incident) * (1.0 + cos_incident);
    return Meeting(eta, cos_incident, k, sqrt(max(k, 0.0)));
}

// The refracted ray; the reflected one where all light is reflected, so that no lookup ever gets the zero vector.
fn refracted_dir(incident: vec3f, normal: vec3f, m: Meeting) -> vec3f {
    if m.k < 0.0 {
        return reflected_dir(incident, normal);
    }
    let facing = normal * select(1.0, -1.0, dot(incident, normal) > 0.0);
    return unit(incident * m.eta + facing * (m.eta * m.cos_incident - m.cos_refracted));
}

fn head_on(eta: f32) -> f32 {
    let ratio = (1.0 - eta) / (1.0 + eta);
    return ratio * ratio;
}

fn reflectance_ratio(a: f32, b: f32, m: Meeting) -> f32 {
    let sum = a + b;
    if m.k < 0.0 || sum <= 0.0 {
        return 1.0;
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

// `formula` is one of the FORMULA_ constants, written from Rust.
fn reflectance(formula: u32, m: Meeting, shape: Shape) -> f32 {
    let f = head_on(m.eta);
    switch formula {
        case FORMULA_FRESNEL_S: { return fresnel_s(m); }
        case FORMULA_FRESNEL_P: { return fresnel_p(m); }
        case FORMULA_SCHLICK: { return f + (1.0 - f) * pow(1.0 - m.cos_incident, shape.exponent); }
        case FORMULA_CG: {
            return clamp(shape.bias + shape.scale * pow(1.0 - m.cos_incident, shape.power), 0.0, 1.0);
        }
        case FORMULA_SIMPLE: { return 1.0 - pow(m.cos_incident, shape.power); }
        case FORMULA_PRINTED_SIGN: { return f + (1.0 - f) * pow(1.0 + m.cos_incident, shape.power); }
        case FORMULA_PRINTED_MIX: { return f; }
        default: { return 0.5 * (fresnel_s(m) + fresnel_p(m)); }
    }
}

// A metal of index n + i k.
fn metal_reflectance(cos_incident: f32, n: f32, k: f32) -> f32 {
    let cos2 = cos_incident * cos_incident;
    let sin2 = (1.0 - cos_incident) * (1.0 + cos_incident);
    let d = n * n - k * k - sin2;
    let size = hypotenuse(d, 2.0 * n * k);
    let a = sqrt(0.5 * max(size + d, 0.0));
    let two_a_cos = 2.0 * a * cos_incident;
    let s = (size + cos2 - two_a_cos) / (size + cos2 + two_a_cos);
    let t = size * cos2 + sin2 * sin2;
    let u = two_a_cos * sin2;
    return 0.5 * s * (1.0 + (t - u) / (t + u));
}
