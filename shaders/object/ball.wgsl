// A picture of a lit ball, looked up by the normal as the viewer sees it: the simple sphere map of the cubemap article.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    // To the right and up as seen along this very ray, so that every silhouette falls on the picture's rim.
    let screen_right = material.screen_right.xyz;
    let right = unit(screen_right - incident * dot(screen_right, incident));
    let screen_up = material.screen_up.xyz;
    let up = unit(screen_up - incident * dot(screen_up, incident) - right * dot(screen_up, right));
    let place = vec2f(dot(normal, right), -dot(normal, up));
    // A hair inside the rim, beyond which the picture says nothing.
    return textureSampleLevel(ball_picture, map_sampler, 0.5 + 0.498 * place, 0.0).rgb;
}
