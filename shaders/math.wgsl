// Numbers: twin of src/math. The constants in capitals are written in front of this file by src/gpu/shader.rs, and its angles
// come from shaders/angles, one text for each form.
//
// There is no test for NaN or infinity, because an implementation may assume that neither occurs; such a vector is refused by
// its size.

struct ChartPoint {
    chart: u32,
    u: f32,
    v: f32,
}

fn chart_point(chart: u32, u: f32, v: f32) -> ChartPoint {
    return ChartPoint(chart, clamp(u, 0.0, 1.0), clamp(v, 0.0, 1.0));
}

fn no_chart() -> ChartPoint {
    return ChartPoint(NO_CHART, 0.0, 0.0);
}

fn max_abs(v: vec3f) -> f32 {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// True for a vector that is neither zero nor beyond the normal numbers.
fn is_direction(dir: vec3f) -> bool {
    let largest = max_abs(dir);
    return largest >= SMALLEST_NORMAL && largest <= LARGEST_FINITE;
}

// The same direction at a size at which squares neither overflow nor underflow. One step of 2^66 is enough in both
// directions: 2^128 becomes 2^62, and 2^-126 becomes 2^-60.
fn scaled_direction(dir: vec3f) -> vec3f {
    let largest = max_abs(dir);
    if largest > 0x1p60f {
        return dir * 0x1p-66f;
    }
    if largest < 0x1p-60f {
        return dir * 0x1p66f;
    }
    return dir;
}

fn length_of(v: vec3f) -> f32 {
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

fn unit(v: vec3f) -> vec3f {
    return v / length_of(v);
}

fn sign_or_one(x: f32) -> f32 {
    return select(1.0, -1.0, x < 0.0);
}

// x < 0, asked of the bits: right below the normal numbers too, where a comparison may see zero.
fn is_below_zero(x: f32) -> bool {
    return bitcast<u32>(x) > 0x80000000u;
}

// Squared height of the unit ball over a point of the disc, 1 - (2u - 1)^2 - (2v - 1)^2: near the rim the larger product
// is at least 1/2, so that taking it from 1 is exact.
fn height_squared(u: f32, v: f32) -> f32 {
    let a = 4.0 * u * (1.0 - u);
    let b = 4.0 * v * (1.0 - v);
    return (max(a, b) - 1.0) + min(a, b);
}

fn hypotenuse(a: f32, b: f32) -> f32 {
    let large = max(abs(a), abs(b));
    // Below the normal numbers a division may do anything, and an error of that size does not show.
    if large < SMALLEST_NORMAL {
        return large;
    }
    let ratio = min(abs(a), abs(b)) / large;
    return large * sqrt(1.0 + ratio * ratio);
}

// p at length 1, or (1, 0) for the origin and below the normal numbers, where a division may do anything.
fn unit_in_plane(p: vec2f) -> vec2f {
    let large = max(abs(p.x), abs(p.y));
    if large < SMALLEST_NORMAL {
        return vec2f(1.0, 0.0);
    }
    let q = p / large;
    return q / sqrt(q.x * q.x + q.y * q.y);
}

// A point of one of two discs that share their rim, from the middle over the radius and y upwards.
struct DiscPoint {
    chart: u32,
    place: vec2f,
}

// Beyond the rim it is the point of the other disc that lies as far within.
fn over_rim(p: ChartPoint) -> DiscPoint {
    let place = vec2f(2.0 * p.u - 1.0, 1.0 - 2.0 * p.v);
    let radius = hypotenuse(place.x, place.y);
    if radius <= 1.0 {
        return DiscPoint(p.chart, place);
    }
    return DiscPoint(p.chart ^ 1u, vec2f(-place.x, place.y) * ((2.0 - radius) / radius));
}

// ln(1 + t) for t >= 0: the power of two nearest to 1 + t, and 2 artanh(s) of the rest. The language's own is off by 2^-21 around 1.
fn ln_1p(t: f32) -> f32 {
    var k = 0.0;
    var power = 1.0;
    while 1.0 + t > 1.4142135 * power && power < 1e30 {
        k += 1.0;
        power *= 2.0;
    }
    let s = (t - (power - 1.0)) / (t + (1.0 + power));
    let q = s * s;
    let series = q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * (1.0 / 7.0 + q * (1.0 / 9.0))));
    return k * LN_2_HIGH + (k * LN_2_LOW + 2.0 * (s + s * series));
}

// e^x - 1 for |x| <= 40.
fn exp_m1(x: f32) -> f32 {
    let k = round(x * 1.442695);
    let f = (x - k * LN_2_HIGH) - k * LN_2_LOW;
    let series = 1.0 / 2.0
        + f * (1.0 / 6.0 + f * (1.0 / 24.0 + f * (1.0 / 120.0 + f * (1.0 / 720.0 + f * (1.0 / 5040.0)))));
    let rest = f + f * f * series;
    let power = ldexp(1.0, i32(k));
    return (power - 1.0) + power * rest;
}
