// Strokes: quads along lines through points, covered as far as they reach from the middle of the nearest dash, which
// ends in half a disc. A line without gaps is one dash.

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) colour: vec4<f32>,
    // Half the line's width, and how far from its middle.
    @location(1) across_px: vec2<f32>,
    // How far along the line from the middle of its first dash, in dashes with their gaps.
    @location(2) turns: f32,
    // From the middle of a dash to the middle of the disc at its end, from one dash to the next.
    @location(3) @interpolate(flat) dash_px: vec2<f32>,
}

@vertex
fn vertex(
    @location(0) at: vec2<f32>,
    @location(1) across_px: vec2<f32>,
    // How far along the line from the middle of its first dash, and the two lengths of dashes.
    @location(2) along_px: vec3<f32>,
    @location(3) colour: vec4<f32>,
) -> Varying {
    var out: Varying;
    out.position = clip_from_px(px_from_points(at));
    out.colour = colour;
    out.across_px = across_px;
    out.turns = along_px.x / along_px.z;
    out.dash_px = along_px.yz;
    return out;
}

@fragment
fn stroke(in: Varying) -> @location(0) vec4<f32> {
    let half_px = in.across_px.x;
    let from_dash_px = abs(in.turns - round(in.turns)) * in.dash_px.y;
    let beyond_px = max(from_dash_px - in.dash_px.x, 0.0);
    let from_line_px = length(vec2(beyond_px, in.across_px.y));
    return in.colour * clamp(half_px + 0.5 - from_line_px, 0.0, min(2.0 * half_px, 1.0));
}
