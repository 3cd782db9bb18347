// How large an angle a texel or a pixel covers, and what that says about the mip level.

// Side in radians of the square as large as the parallelogram of two tangent vectors. Where it is drawn out more than
// four times, half of its longer side: at the poles of a latlong map neighbouring texels of a row are alike, because
// the bake measures them by this same rule, so that a narrow texel needs no coarser level.
fn footprint_rad(a: vec3f, b: vec3f) -> f32 {
    let longest = max(dot(a, a), dot(b, b));
    return sqrt(max(length(cross(a, b)), 0.25 * longest));
}

// x and y such that x a + y b comes nearest to the tangent vector t; 0 where a and b are parallel.
fn coordinates_in(a: vec3f, b: vec3f, t: vec3f) -> vec2f {
    let aa = dot(a, a);
    let ab = dot(a, b);
    let bb = dot(b, b);
    let determinant = aa * bb - ab * ab;
    if determinant <= 1e-6 * aa * bb {
        return vec2f(0.0);
    }
    let at = dot(a, t);
    let bt = dot(b, t);
    return vec2f(at * bb - bt * ab, bt * aa - at * ab) / determinant;
}
