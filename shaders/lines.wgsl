// Lines: quads along them, their coverage from the distance to the line's middle and, of a dashed one, to the
// middle of the nearest dash.

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) colour: vec4<f32>,
    // Half the line's width, and how far from its middle.
    @location(1) across_px: vec2<f32>,
    // How far along the line from the middle of its first dash.
    @location(2) along_px: f32,
    // Half a dash, from one dash to the next.
    @location(3) @interpolate(flat) dash_px: vec2<f32>,
}

@vertex
fn vertex(
    @location(0) at: vec2<f32>,
    @location(1) across_px: vec2<f32>,
    // How far along the line, length of a dash, of a gap.
    @location(2) along_px: vec3<f32>,
    @location(3) colour: vec4<f32>,
) -> Varying {
    var out: Varying;
    out.position = clip_from_px(px_from_points(at));
    out.colour = colour;
    out.across_px = across_px;
    out.dash_px = vec2(0.5 * along_px.y, along_px.y + along_px.z);
    out.along_px = along_px.x - out.dash_px.x;
    return out;
}

// How much of a pixel in the line's direction is covered.
fn covered(in: Varying) -> f32 {
    let half_px = in.across_px.x;
    let from_middle_px = in.across_px.y;
    return max(min(from_middle_px + 0.5, half_px) - max(from_middle_px - 0.5, -half_px), 0.0);
}

@fragment
fn solid(in: Varying) -> @location(0) vec4<f32> {
    return in.colour * covered(in);
}

@fragment
fn dashed(in: Varying) -> @location(0) vec4<f32> {
    let turns = in.along_px / in.dash_px.y;
    let from_dash_px = abs(turns - round(turns)) * in.dash_px.y;
    let along = clamp(in.dash_px.x + 0.5 - from_dash_px, 0.0, 1.0);
    return in.colour * (covered(in) * along);
}
