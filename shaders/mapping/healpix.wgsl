// HEALPix: twin of src/mapping/healpix.rs.

// The quarter of longitude from +z, +x, -z or -x on; 0 at a pole. Asked of the bits, as signs decide the chart.
fn healpix_quarter(d: vec3f) -> u32 {
    let is_on_axis = (bitcast<u32>(d.x) << 1u) == 0u;
    let is_behind = is_below_zero(d.z);
    if is_below_zero(d.x) || (is_on_axis && is_behind) {
        return select(3u, 2u, is_behind);
    }
    let is_ahead = !is_behind && (bitcast<u32>(d.z) << 1u) != 0u;
    return select(1u, 0u, is_ahead || is_on_axis);
}

// Distances along the beginning of a quarter and along its end.
fn healpix_from_quarter(d: vec3f, quarter: u32) -> vec2f {
    switch quarter {
        case 0u: { return d.zx; }
        case 1u: { return vec2f(d.x, -d.z); }
        case 2u: { return -d.zx; }
        default: { return vec2f(-d.x, d.z); }
    }
}

fn healpix_in_quarter(quarter: u32, p: vec2f, height: f32) -> vec3f {
    switch quarter {
        case 0u: { return vec3f(p.y, height, p.x); }
        case 1u: { return vec3f(p.x, height, -p.y); }
        case 2u: { return vec3f(-p.y, height, -p.x); }
        default: { return vec3f(-p.x, height, p.y); }
    }
}

fn healpix_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let quarter = healpix_quarter(dir);
    let d = scaled_direction(dir);
    let n = length_of(d);
    let ends = healpix_from_quarter(d, quarter);
    let share = angle_of(ends.y, ends.x) * (2.0 * FRAC_1_PI);
    if abs(d.y) > n * (2.0 / 3.0) {
        let radius = 1.7320508 * hypotenuse(d.x, d.z) / sqrt(n * (n + abs(d.y)));
        let along = radius * share;
        let rest = 1.0 - radius * (1.0 - share);
        if d.y > 0.0 {
            return chart_point(quarter, rest, along);
        }
        return chart_point(8u + quarter, along, rest);
    }
    let height = d.y / n * 0.75;
    let middle = share - 0.5;
    let right = middle + height;
    let down = middle - height;
    var chart = quarter;
    if right >= 0.0 && down >= 0.0 {
        chart = 4u + ((quarter + 1u) & 3u);
    } else if down >= 0.0 {
        chart = 8u + quarter;
    } else if right < 0.0 {
        chart = 4u + quarter;
    }
    return chart_point(
        chart,
        select(1.0 + right, right, right >= 0.0),
        select(1.0 + down, down, down >= 0.0),
    );
}

// A point beyond a side on the chart across it; any other as it is.
fn healpix_step_over(p: ChartPoint) -> ChartPoint {
    let ring = p.chart / 4u;
    let here = p.chart & 3u;
    let east = (here + 1u) & 3u;
    let west = (here + 3u) & 3u;
    let aside = max(-p.u, p.u - 1.0);
    let above = max(-p.v, p.v - 1.0);
    if max(aside, above) <= 0.0 {
        return p;
    }
    if aside >= above {
        if p.u < 0.0 {
            switch ring {
                case 0u: { return ChartPoint(4u + here, 1.0 + p.u, p.v); }
                case 1u: { return ChartPoint(8u + west, 1.0 + p.u, p.v); }
                default: { return ChartPoint(8u + west, 1.0 - p.v, 1.0 + p.u); }
            }
        }
        switch ring {
            case 0u: { return ChartPoint(east, 1.0 - p.v, p.u - 1.0); }
            case 1u: { return ChartPoint(here, p.u - 1.0, p.v); }
            default: { return ChartPoint(4u + east, p.u - 1.0, p.v); }
        }
    }
    if p.v < 0.0 {
        switch ring {
            case 0u: { return ChartPoint(west, 1.0 + p.v, 1.0 - p.u); }
            case 1u: { return ChartPoint(west, p.u, 1.0 + p.v); }
            default: { return ChartPoint(4u + here, p.u, 1.0 + p.v); }
        }
    }
    switch ring {
        case 0u: { return ChartPoint(4u + east, p.u, p.v - 1.0); }
        case 1u: { return ChartPoint(8u + here, p.u, p.v - 1.0); }
        default: { return ChartPoint(8u + east, p.v - 1.0, 1.0 - p.u); }
    }
}

// Beyond a side: on the chart across it, as far within; beyond two, over the side that is farther off first.
fn healpix_inverse(p: ChartPoint) -> vec3f {
    let q = healpix_step_over(healpix_step_over(p));
    let ring = q.chart / 4u;
    let is_north = ring == 0u;
    if (is_north && q.u > q.v) || (ring == 2u && q.v > q.u) {
        let along = select(q.u, q.v, is_north);
        let radius = along + (1.0 - select(q.v, q.u, is_north));
        var share = 0.0;
        if radius > 0.0 {
            share = along / radius;
        }
        let square = radius * radius * (1.0 / 3.0);
        let across = radius * sqrt((2.0 - square) * (1.0 / 3.0));
        let height = select(square - 1.0, 1.0 - square, is_north);
        return healpix_in_quarter(q.chart & 3u, across * sin_cos_turns(0.25 * share).yx, height);
    }
    let height = ((q.u - q.v) + (1.0 - f32(ring))) * (2.0 / 3.0);
    let begin = select(0.0, 1.0, ring == 1u);
    let across = sqrt(max((1.0 - height) * (1.0 + height), 0.0));
    return healpix_in_quarter(q.chart & 3u, across * sin_cos_turns(0.125 * (q.u + q.v - begin)).yx, height);
}
