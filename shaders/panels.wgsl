// Panels: egui's triangles, their colours premultiplied and in gamma space, text from an atlas.
//
// A texel is looked up, never filtered: egui sets text on whole pixels, so that every driver finds the
// same texel, and a software adapter has one to fetch and not four. A vertex beyond the atlas is one of a
// line: it says how wide the line is, and how far from its middle the vertex lies.

struct Frame {
    // Padded: GL wants a uniform's size to be a multiple of 16 bytes.
    @size(16) size_points: vec2<f32>,
}
@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var atlas: texture_2d<f32>;

// As `LINE` in `src/view/curves.rs`.
const LINE = 2.0;

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) colour: vec4<f32>,
    @location(1) texel: vec2<f32>,
    // Half the width of a line, and how far from its middle.
    @location(2) line_px: vec2<f32>,
}

@vertex
fn vertex(
    @location(0) at: vec2<f32>,
    @location(1) part_of_atlas: vec2<f32>,
    @location(2) colour: vec4<f32>,
) -> Varying {
    let part = at / frame.size_points;
    var out: Varying;
    out.position = vec4(2.0 * part.x - 1.0, 1.0 - 2.0 * part.y, 0.0, 1.0);
    out.colour = colour;
    out.texel = part_of_atlas * vec2<f32>(textureDimensions(atlas));
    out.line_px = part_of_atlas - vec2(LINE, 0.0);
    return out;
}

@fragment
fn fill(in: Varying) -> @location(0) vec4<f32> {
    return in.colour;
}

@fragment
fn line(in: Varying) -> @location(0) vec4<f32> {
    let half_px = in.line_px.x;
    let across_px = in.line_px.y;
    let covered = min(across_px + 0.5, half_px) - max(across_px - 0.5, -half_px);
    return in.colour * max(covered, 0.0);
}

@fragment
fn textured(in: Varying) -> @location(0) vec4<f32> {
    return in.colour * textureLoad(atlas, vec2<i32>(in.texel), 0);
}
