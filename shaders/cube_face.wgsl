// The six faces: twin of src/mapping/cube_face.rs and face_map.rs; and the octahedron's folding: twin of src/mapping/octahedral.rs.

struct Gnomonic {
    face: u32,
    a: f32,
    b: f32,
}

fn largest_component(dir: vec3f) -> u32 {
    let size = abs(dir);
    if size.z >= size.x && size.z >= size.y {
        return select(4u, 5u, dir.z < 0.0);
    }
    if size.y >= size.x {
        return select(2u, 3u, dir.y < 0.0);
    }
    return select(0u, 1u, dir.x < 0.0);
}

// The paper's table. Comparisons, not products: no rounding, so no direction is left without a face.
fn sign_table(dir: vec3f) -> u32 {
    let a = dir.y > -dir.x;
    let b = dir.y > dir.x;
    let c = dir.y > -dir.z;
    let d = dir.y > dir.z;
    let e = dir.x > -dir.z;
    let f = dir.z > dir.x;
    if a && b && c && d {
        return 2u;
    }
    if !(a || b || c || d) {
        return 3u;
    }
    if c && !d && e && f {
        return 4u;
    }
    if !c && d && !e && !f {
        return 5u;
    }
    return select(1u, 0u, a && !b && e && !f);
}

fn to_frame(face: u32, dir: vec3f) -> vec3f {
    switch face {
        case 0u: { return vec3f(-dir.z, -dir.y, dir.x); }
        case 1u: { return vec3f(dir.z, -dir.y, -dir.x); }
        case 2u: { return vec3f(dir.x, dir.z, dir.y); }
        case 3u: { return vec3f(dir.x, -dir.z, -dir.y); }
        case 4u: { return vec3f(dir.x, -dir.y, dir.z); }
        default: { return vec3f(-dir.x, -dir.y, -dir.z); }
    }
}

fn from_frame(face: u32, sc: f32, tc: f32, ma: f32) -> vec3f {
    switch face {
        case 0u: { return vec3f(ma, -tc, -sc); }
        case 1u: { return vec3f(-ma, -tc, sc); }
        case 2u: { return vec3f(sc, ma, tc); }
        case 3u: { return vec3f(sc, -ma, -tc); }
        case 4u: { return vec3f(sc, -tc, ma); }
        default: { return vec3f(-sc, -tc, -ma); }
    }
}

fn gnomonic(dir: vec3f, face: u32) -> Gnomonic {
    let frame = to_frame(face, scaled_direction(dir));
    // A division may be off by 2.5 ULP and leave the face.
    let plane = clamp(frame.xy / frame.z, vec2f(-1.0), vec2f(1.0));
    return Gnomonic(face, plane.x, plane.y);
}

fn from_gnomonic(face: u32, a: f32, b: f32) -> vec3f {
    return unit(from_frame(face, a, b, 1.0));
}

// The place on a face that is nearest to a chart point, and the one as far inside as the point is outside: twice.
struct MirroredPlace {
    border: vec2f,
    inside: vec2f,
}

fn mirrored_place(p: ChartPoint) -> MirroredPlace {
    let place = 2.0 * vec2f(p.u, p.v) - vec2f(1.0);
    let border = clamp(place, vec2f(-1.0), vec2f(1.0));
    return MirroredPlace(border, 2.0 * border - place);
}

// Beyond the face: on along its plane, by the border's double less what lies as far inside.
fn from_mirrored_place(face: u32, border: vec2f, inside: vec2f) -> vec3f {
    let plane = 2.0 * border - inside;
    return from_gnomonic(face, plane.x, plane.y);
}

// A place in [-1, 1] on an axis that is divided by the solid angle of the strips between lines.
fn strip_of_plane(a: f32) -> f32 {
    return atan_unit(a / sqrt(a * a + 2.0)) * (6.0 * FRAC_1_PI);
}

fn plane_of_strip(p: f32) -> f32 {
    let t = tan_turns(p * (1.0 / 12.0));
    return t * sqrt(2.0 / (1.0 - t * t));
}

fn octahedron_fold(plane: vec2f) -> vec2f {
    return (vec2f(1.0) - abs(plane.yx)) * vec2f(sign_or_one(plane.x), sign_or_one(plane.y));
}

// A point just beyond the square's edge, brought back: each edge is folded onto itself around its middle.
fn octahedron_wrap(plane: vec2f) -> vec2f {
    var p = plane;
    if abs(p.x) > 1.0 {
        p = vec2f(sign_or_one(p.x) * 2.0 - p.x, -p.y);
    }
    if abs(p.y) > 1.0 {
        p = vec2f(-p.x, sign_or_one(p.y) * 2.0 - p.y);
    }
    return p;
}
