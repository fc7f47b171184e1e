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

struct Quad {
    @location(0) ends: vec4<f32>,
    @location(1) radii: vec2<f32>,
    @location(2) colour: vec4<f32>,
    // 1 for a butt cap.
    @location(3) butt: f32,
}

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) local_px: vec2<f32>,
    @location(1) @interpolate(flat) colour: vec4<f32>,
    // Length, radii, 1 for a butt cap.
    @location(2) @interpolate(flat) shape_px: vec4<f32>,
    @location(3) @interpolate(flat) taper: vec3<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, stroke: Quad) -> Varying {
    let from_px = px_from_points(stroke.ends.xy);
    let reach_px = px_from_points(stroke.ends.zw) - from_px;
    let length_px = length(reach_px);
    let has_direction = length_px > DOT_LENGTH_PX;
    let direction = select(vec2(1.0, 0.0), reach_px / max(length_px, DOT_LENGTH_PX), has_direction);
    let normal = vec2(-direction.y, direction.x);
    let radii_px = max(stroke.radii, vec2(0.0)) * place.px_per_point;

    // The larger disc may hold the other one and reach beyond it.
    let round_reach_px = max(radii_px, radii_px.yx - length_px);
    let cap_px = select(round_reach_px, vec2(0.0), stroke.butt > 0.5);
    let half_width_px = max(radii_px.x, radii_px.y) + MARGIN_PX;
    let low_px = vec2(-cap_px.x - MARGIN_PX, -half_width_px);
    let high_px = vec2(length_px + cap_px.y + MARGIN_PX, half_width_px);
    let local_px = mix(low_px, high_px, corner_of(index));

    var out: Varying;
    out.position = clip_from_px(from_px + direction * local_px.x + normal * local_px.y);
    out.local_px = local_px;
    out.colour = vec4(stroke.colour.rgb, 1.0) * stroke.colour.a;
    out.shape_px = vec4(length_px, radii_px, stroke.butt);
    out.taper = taper_of(length_px, max(radii_px, vec2(MIN_RADIUS_PX)));
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
    return clamp(half_width + 0.5 - abs(x), 0.0, min(2.0 * half_width, 1.0));
}

// Both radii are the first one.
@fragment
fn line(in: Varying) -> @location(0) vec4<f32> {
    let half_px = 0.5 * in.shape_px.x;
    let radius_px = in.shape_px.y;
    let from_middle_px = abs(in.local_px.x - half_px);
    let beyond_px = max(from_middle_px - half_px, 0.0);
    let from_end_px = length(vec2(beyond_px, in.local_px.y));
    let rounded = clamp(max(radius_px, MIN_RADIUS_PX) + 0.5 - from_end_px, 0.0, 1.0)
        * min(radius_px / MIN_RADIUS_PX, 1.0);
    let butt = overlap(from_middle_px, half_px) * overlap(in.local_px.y, radius_px);
    return in.colour * select(rounded, butt, in.shape_px.w > 0.5);
}

@fragment
fn hull(in: Varying) -> @location(0) vec4<f32> {
    let part = clamp(in.local_px.x / max(in.shape_px.x, DOT_LENGTH_PX), 0.0, 1.0);
    let radius_px = mix(in.shape_px.y, in.shape_px.z, part);
    let radii_px = max(in.shape_px.yz, vec2(MIN_RADIUS_PX));
    let distance_px = hull_distance_px(in.local_px, in.shape_px.x, radii_px, in.taper);
    let coverage = clamp(0.5 - distance_px, 0.0, 1.0) * min(radius_px / MIN_RADIUS_PX, 1.0);
    return in.colour * coverage;
}
