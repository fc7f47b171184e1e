// Ribbons: quads along lines, their coverage from the distance to the line's middle.

struct Varying {
    @builtin(position) position: vec4<f32>,
    // Half the line's width, and how far from its middle.
    @location(0) line_px: vec2<f32>,
    @location(1) colour: vec4<f32>,
}

@vertex
fn vertex(
    @location(0) at: vec2<f32>,
    @location(1) line_px: vec2<f32>,
    @location(2) colour: vec4<f32>,
) -> Varying {
    var out: Varying;
    out.position = clip_from_px(px_from_points(at));
    out.line_px = line_px;
    out.colour = colour;
    return out;
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let half_px = in.line_px.x;
    let across_px = in.line_px.y;
    let covered = min(across_px + 0.5, half_px) - max(across_px - 0.5, -half_px);
    return in.colour * max(covered, 0.0);
}
