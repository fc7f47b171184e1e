// The sea: one colour at its top, another at its bottom, and a light high on the right.

// How far the light reaches, as a part of the sea's height, and how much lighter it makes the water at its middle.
const REACH = 1.25;
const LIGHT = 0.40;
// Steps of two levels of a byte, which nobody sees: neighbours that are alike make a frame's file smaller and sooner
// written.
const LEVELS = 127.5;

struct Part {
    // Left, top, right and bottom.
    @location(0) rect_px: vec4<f32>,
    @location(1) top: vec4<f32>,
    @location(2) bottom: vec4<f32>,
}

struct Varying {
    @builtin(position) position: vec4<f32>,
    // The colour in a pixel's row.
    @location(0) colour: vec3<f32>,
    // From the light, in its reach.
    @location(1) from_light: vec2<f32>,
    @location(2) @interpolate(flat) light: vec3<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, part: Part) -> Varying {
    // Each coordinate 0 or 1.
    let corner = vec2(f32(index & 1u), f32((index >> 1u) & 1u));
    let size_px = part.rect_px.zw - part.rect_px.xy;
    let at_px = part.rect_px.xy + corner * size_px;
    let middle_px = part.rect_px.xy + size_px * vec2(0.62, 0.22);
    var out: Varying;
    out.position = clip_from_px(at_px);
    out.colour = mix(part.top.rgb, part.bottom.rgb, corner.y);
    out.from_light = (at_px - middle_px) / (REACH * max(size_px.y, 1.0));
    out.light = LIGHT * part.top.rgb * (1.0 - part.top.rgb);
    return out;
}

@fragment
fn water(in: Varying) -> @location(0) vec4<f32> {
    let near = max(1.0 - dot(in.from_light, in.from_light), 0.0);
    let colour = in.colour + in.light * (near * near);
    return vec4(round(min(colour, vec3(1.0)) * LEVELS) / LEVELS, 1.0);
}
