// The path through a transparent unit ball: twin of src/optics/ball.rs. Stands behind optics.wgsl. In a loop:
//
//     var ray = ball_enter(incident, normal, eta);
//     for (...) { light += ball_exit_weight(ray) * seen(ball_exit_dir(ray)); ray = ball_bounce(ray); }

// A ray inside the ball, about to meet its surface from within.
struct BallRay {
    // The point that it meets, which is the unit outward normal there.
    normal: vec3f,
    // Unit, perpendicular to the normal, the way the path goes on; zero head-on.
    tangent: vec3f,
    // Cosine and sine of the angle outside, then of the angle inside.
    incident: vec2f,
    refracted: vec2f,
    // Of the s and of the p light: the surface's reflectance, and the part that is in this ray.
    reflectance: vec2f,
    inside: vec2f,
}

// One chord further: the frame turns by pi - 2r.
fn ball_advanced(ray: BallRay) -> BallRay {
    let c = ray.refracted.x;
    let s = ray.refracted.y;
    let turn_cos = (s - c) * (s + c);
    let turn_sin = 2.0 * s * c;
    let normal = ray.normal * turn_cos + ray.tangent * turn_sin;
    let tangent = ray.tangent * turn_cos - ray.normal * turn_sin;
    return BallRay(normal, tangent, ray.incident, ray.refracted, ray.reflectance, ray.inside);
}

// `normal` points outwards; a normal turned away counts as one as far on the other side of grazing.
fn ball_enter(incident: vec3f, normal: vec3f, eta: f32) -> BallRay {
    let m = meet(incident, normal, eta);
    let along = incident - normal * dot(incident, normal);
    let sin_incident = length_of(along);
    // Below the normal numbers a division may do anything; such a ray goes straight through.
    let scale = select(0.0, 1.0 / max(sin_incident, SMALLEST_NORMAL), sin_incident >= SMALLEST_NORMAL);
    let reflectance = vec2f(fresnel_s(m), fresnel_p(m));
    return ball_advanced(BallRay(
        normal,
        along * scale,
        vec2f(m.cos_incident, sin_incident),
        vec2f(m.cos_refracted, min(eta * sin_incident, 1.0)),
        reflectance,
        vec2f(1.0) - reflectance,
    ));
}

// One more inner reflection.
fn ball_bounce(ray: BallRay) -> BallRay {
    var next = ray;
    next.inside = ray.inside * ray.reflectance;
    return ball_advanced(next);
}

// Where the ray itself goes, inside the ball.
fn ball_inside_dir(ray: BallRay) -> vec3f {
    return unit(ray.normal * ray.refracted.x + ray.tangent * ray.refracted.y);
}

// Where that part of it goes which leaves here.
fn ball_exit_dir(ray: BallRay) -> vec3f {
    return unit(ray.normal * ray.incident.x + ray.tangent * ray.incident.y);
}

// What leaves here, as a part of the unpolarised light that came.
fn ball_exit_weight(ray: BallRay) -> f32 {
    let leaving = ray.inside * (vec2f(1.0) - ray.reflectance);
    return 0.5 * (leaving.x + leaving.y);
}

// What stays inside here: lost to whoever follows the ray no further.
fn ball_left_weight(ray: BallRay) -> f32 {
    let staying = ray.inside * ray.reflectance;
    return 0.5 * (staying.x + staying.y);
}
