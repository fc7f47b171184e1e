// Strokes: a quad around each, its coverage from the distance to the shape.
//
// `along` and `across` are pixels from the stroke's first end, in the stroke's own directions.

// Shorter strokes have no direction: dots.
const DOT_LENGTH_PX = 1e-3;
// Round shapes thinner than a pixel are drawn a pixel wide and paler, so that they do not break up.
const MIN_RADIUS_PX = 0.5;
// The edge's blur reaches half a pixel, its corners a little further.
const MARGIN_PX = 1.0;

struct Instance {
    @location(0) ends: vec4<f32>,
    @location(1) radii: vec2<f32>,
    @location(2) from_colour: vec4<f32>,
    @location(3) to_colour: vec4<f32>,
    // Drawn length, gap length, phase; 1 for a butt cap.
    @location(4) dash_and_cap: vec4<f32>,
    @location(5) clip: vec4<f32>,
}

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) local_px: vec2<f32>,
    // Length, radii.
    @location(1) @interpolate(flat) shape_px: vec3<f32>,
    @location(2) @interpolate(flat) from_colour: vec4<f32>,
    @location(3) @interpolate(flat) to_colour: vec4<f32>,
    @location(4) @interpolate(flat) dash_px_and_cap: vec4<f32>,
    @location(5) @interpolate(flat) clip_px: vec4<f32>,
}

fn premultiplied(colour: vec4<f32>) -> vec4<f32> {
    return vec4(colour.rgb * colour.a, colour.a);
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, stroke: Instance) -> Varying {
    let from_px = px_from_points(stroke.ends.xy);
    let reach_px = px_from_points(stroke.ends.zw) - from_px;
    let length_px = length(reach_px);
    let has_direction = length_px > DOT_LENGTH_PX;
    let direction = select(vec2(1.0, 0.0), reach_px / max(length_px, DOT_LENGTH_PX), has_direction);
    let normal = vec2(-direction.y, direction.x);
    let radii_px = max(stroke.radii, vec2(0.0)) * stage.px_per_point;

    // The larger disc may hold the other one and reach beyond it.
    let round_reach_px = max(radii_px, radii_px.yx - length_px);
    let cap_px = select(round_reach_px, vec2(0.0), stroke.dash_and_cap.w > 0.5);
    let half_width_px = max(radii_px.x, radii_px.y) + MARGIN_PX;
    let low_px = vec2(-cap_px.x - MARGIN_PX, -half_width_px);
    let high_px = vec2(length_px + cap_px.y + MARGIN_PX, half_width_px);
    let local_px = mix(low_px, high_px, corner_of(index));

    var out: Varying;
    out.position = clip_from_px(from_px + direction * local_px.x + normal * local_px.y);
    out.local_px = local_px;
    out.shape_px = vec3(length_px, radii_px);
    out.from_colour = premultiplied(stroke.from_colour);
    out.to_colour = premultiplied(stroke.to_colour);
    out.dash_px_and_cap = vec4(stroke.dash_and_cap.xyz * stage.px_per_point, stroke.dash_and_cap.w);
    out.clip_px = vec4(px_from_points(stroke.clip.xy), px_from_points(stroke.clip.zw));
    return out;
}

// Distance to the hull of two discs (Inigo Quilez, "uneven capsule").
fn taper_distance_px(local_px: vec2<f32>, length_px: f32, radii_px: vec2<f32>) -> f32 {
    let along = local_px.x;
    let across = abs(local_px.y);
    let from_distance = length(vec2(along, across)) - radii_px.x;
    let to_distance = length(vec2(along - length_px, across)) - radii_px.y;
    if length_px <= max(abs(radii_px.x - radii_px.y), DOT_LENGTH_PX) {
        return select(to_distance, from_distance, radii_px.x >= radii_px.y);
    }
    let sine = (radii_px.x - radii_px.y) / length_px;
    let cosine = sqrt(1.0 - sine * sine);
    let height = along * cosine - across * sine;
    if height < 0.0 {
        return from_distance;
    }
    if height > length_px * cosine {
        return to_distance;
    }
    return across * cosine + along * sine - radii_px.x;
}

// How much of the pixel at `x` lies within `half_width` of 0, in one dimension.
fn overlap(x: f32, half_width: f32) -> f32 {
    return clamp(min(x + 0.5, half_width) - max(x - 0.5, -half_width), 0.0, 1.0);
}

// How far `along` is from the middle of the nearest dash.
fn from_dash_middle_px(along: f32, dash_px: vec3<f32>) -> f32 {
    let period = dash_px.x + dash_px.y;
    let turns = (along + dash_px.z - 0.5 * dash_px.x) / period;
    return (turns - round(turns)) * period;
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let inside = all(in.position.xy >= in.clip_px.xy) && all(in.position.xy < in.clip_px.zw);
    if !inside {
        discard;
    }
    let length_px = in.shape_px.x;
    let along = in.local_px.x;
    let part = clamp(along / max(length_px, DOT_LENGTH_PX), 0.0, 1.0);
    let radius_px = mix(in.shape_px.y, in.shape_px.z, part);
    let dash_px = in.dash_px_and_cap.xyz;
    let dashed = dash_px.y > 0.0;

    var coverage: f32;
    if in.dash_px_and_cap.w > 0.5 {
        coverage = overlap(along - 0.5 * length_px, 0.5 * length_px);
        if dashed {
            coverage = min(coverage, overlap(from_dash_middle_px(along, dash_px), 0.5 * dash_px.x));
        }
        coverage *= overlap(in.local_px.y, radius_px);
    } else {
        let radii_px = max(in.shape_px.yz, vec2(MIN_RADIUS_PX));
        var distance_px = taper_distance_px(in.local_px, length_px, radii_px);
        if dashed {
            // Dashes are as round as the ends, and as long as asked for, ends included.
            let round_px = max(radius_px, MIN_RADIUS_PX);
            let straight_px = max(0.5 * dash_px.x - round_px, 0.0);
            let beyond_px = max(abs(from_dash_middle_px(along, dash_px)) - straight_px, 0.0);
            distance_px = max(distance_px, length(vec2(beyond_px, in.local_px.y)) - round_px);
        }
        coverage = clamp(0.5 - distance_px, 0.0, 1.0) * min(radius_px / MIN_RADIUS_PX, 1.0);
    }
    return mix(in.from_colour, in.to_colour, part) * coverage;
}
