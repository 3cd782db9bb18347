// A picture of a lit ball, looked up by the normal as the viewer sees it: the simple sphere map of the cubemap article.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let place = vec2f(dot(normal, material.screen_right.xyz), -dot(normal, material.screen_up.xyz));
    // A hair inside the rim, beyond which the picture says nothing.
    return textureSampleLevel(ball_picture, map_sampler, 0.5 + 0.498 * place, 0.0).rgb;
}
