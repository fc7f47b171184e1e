// Strokes: a quad around each, its coverage from the distance to the shape.
//
// `along` and `across` are pixels from the stroke's first end, in the stroke's own directions.

// Shorter strokes have no direction: dots.
const DOT_LENGTH_PX = 1e-3;
// Round shapes thinner than a pixel are drawn a pixel wide and paler, so that they do not break up.
const MIN_RADIUS_PX = 0.5;
// Further than any pixel is.
const FAR_PX = 1e9;
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
    // Length, radii, 1 for a butt cap.
    @location(1) @interpolate(flat) shape_px: vec4<f32>,
    @location(2) @interpolate(flat) taper: vec3<f32>,
    @location(3) @interpolate(flat) from_colour: vec4<f32>,
    @location(4) @interpolate(flat) to_colour: vec4<f32>,
    @location(5) @interpolate(flat) clip_px: vec4<f32>,
    @location(6) @interpolate(flat) dash_px: vec3<f32>,
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
    out.shape_px = vec4(length_px, radii_px, stroke.dash_and_cap.w);
    let round_px = max(radii_px, vec2(MIN_RADIUS_PX));
    out.taper = taper_of(length_px, round_px);
    out.from_colour = premultiplied(stroke.from_colour);
    out.to_colour = premultiplied(stroke.to_colour);
    out.dash_px = stroke.dash_and_cap.xyz * stage.px_per_point;
    out.clip_px = vec4(px_from_points(stroke.clip.xy), px_from_points(stroke.clip.zw));
    return out;
}

// Sine and cosine of how far the hull's sides lean, and how far along them the second disc begins. Where
// one disc holds the other one, everything belongs to the larger.
fn taper_of(length_px: f32, radii_px: vec2<f32>) -> vec3<f32> {
    let sine = (radii_px.x - radii_px.y) / max(length_px, DOT_LENGTH_PX);
    if abs(sine) >= 1.0 || length_px <= DOT_LENGTH_PX {
        return vec3(1.0, 0.0, select(-FAR_PX, FAR_PX, radii_px.x >= radii_px.y));
    }
    let cosine = sqrt(1.0 - sine * sine);
    return vec3(sine, cosine, length_px * cosine);
}

// Distance to the hull of two discs (Inigo Quilez, "uneven capsule").
fn hull_distance_px(
    local_px: vec2<f32>,
    length_px: f32,
    radii_px: vec2<f32>,
    taper: vec3<f32>,
) -> f32 {
    let along = local_px.x;
    let across = abs(local_px.y);
    let height = along * taper.y - across * taper.x;
    let at_second = height > taper.z;
    let from_disc = length(vec2(along - select(0.0, length_px, at_second), across))
        - select(radii_px.x, radii_px.y, at_second);
    let from_side = across * taper.y + along * taper.x - radii_px.x;
    return select(from_side, from_disc, at_second || height <= 0.0);
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

fn is_clipped(in: Varying) -> bool {
    return any(in.position.xy < in.clip_px.xy) || any(in.position.xy >= in.clip_px.zw);
}

fn part_of(in: Varying) -> f32 {
    return clamp(in.local_px.x / max(in.shape_px.x, DOT_LENGTH_PX), 0.0, 1.0);
}

fn round_distance_px(in: Varying) -> f32 {
    let radii_px = max(in.shape_px.yz, vec2(MIN_RADIUS_PX));
    return hull_distance_px(in.local_px, in.shape_px.x, radii_px, in.taper);
}

// The colour where shapes of such distance and such extent along the stroke are drawn.
fn painted(in: Varying, part: f32, along: f32, distance_px: f32) -> vec4<f32> {
    let radius_px = mix(in.shape_px.y, in.shape_px.z, part);
    let butt = along * overlap(in.local_px.y, radius_px);
    let rounded = clamp(0.5 - distance_px, 0.0, 1.0) * min(radius_px / MIN_RADIUS_PX, 1.0);
    let coverage = select(rounded, butt, in.shape_px.w > 0.5);
    return mix(in.from_colour, in.to_colour, part) * coverage;
}

fn overlap_of_all(in: Varying) -> f32 {
    let half_px = 0.5 * in.shape_px.x;
    return overlap(in.local_px.x - half_px, half_px);
}

@fragment
fn solid(in: Varying) -> @location(0) vec4<f32> {
    if is_clipped(in) {
        discard;
    }
    return painted(in, part_of(in), overlap_of_all(in), round_distance_px(in));
}

@fragment
fn dashed(in: Varying) -> @location(0) vec4<f32> {
    if is_clipped(in) {
        discard;
    }
    let part = part_of(in);
    let from_middle_px = from_dash_middle_px(in.local_px.x, in.dash_px);
    let along = min(overlap_of_all(in), overlap(from_middle_px, 0.5 * in.dash_px.x));
    // Dashes are as round as the ends, and as long as asked for, ends included.
    let round_px = max(mix(in.shape_px.y, in.shape_px.z, part), MIN_RADIUS_PX);
    let straight_px = max(0.5 * in.dash_px.x - round_px, 0.0);
    let beyond_px = max(abs(from_middle_px) - straight_px, 0.0);
    let dash_distance_px = length(vec2(beyond_px, in.local_px.y)) - round_px;
    return painted(in, part, along, max(round_distance_px(in), dash_distance_px));
}
