// The environment behind the object.

@fragment
fn sky_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let target_size = vec2f(view.right.w, view.up.w);
    let ndc = vec2f(2.0, -2.0) * at.xy / target_size + vec2f(-1.0, 1.0);
    let ray = view.forward.xyz + ndc.x * view.right.xyz + ndc.y * view.up.xyz;
    let scale = 1.0 / length_of(ray);
    let dir = ray * scale;
    // The derivative of ray/|ray| in closed form.
    let right = view.right.xyz * (2.0 / target_size.x);
    let down = view.up.xyz * (-2.0 / target_size.y);
    let color = seen(
        dir,
        (right - dir * dot(dir, right)) * scale,
        (down - dir * dot(dir, down)) * scale,
    );
    return vec4f(color, 1.0);
}
