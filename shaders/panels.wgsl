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
// Half the width of what is no line, in pixels: wider than any target.
const EVERYWHERE_PX = 1e6;

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) colour: vec4<f32>,
    // On the atlas; then half the width of a line and how far from its middle, in pixels.
    @location(1) texel_and_line: vec4<f32>,
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
    let texel = part_of_atlas * vec2<f32>(textureDimensions(atlas));
    let line_px = vec2(part_of_atlas.x - LINE, part_of_atlas.y);
    let is_line = part_of_atlas.x >= LINE;
    out.texel_and_line =
        select(vec4(texel, EVERYWHERE_PX, 0.0), vec4(0.0, 0.0, line_px), is_line);
    return out;
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let half_px = in.texel_and_line.z;
    let across_px = in.texel_and_line.w;
    let covered = min(across_px + 0.5, half_px) - max(across_px - 0.5, -half_px);
    return in.colour * max(covered, 0.0) * textureLoad(atlas, vec2<i32>(in.texel_and_line.xy), 0);
}
