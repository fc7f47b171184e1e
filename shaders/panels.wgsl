// Panels: egui's triangles, their colours premultiplied and in gamma space, text from an atlas.
//
// A texel is looked up, never filtered: egui sets text on whole pixels, so that every driver finds the
// same texel, and a software adapter has one to fetch and not four.

struct Frame {
    // Padded: GL wants a uniform's size to be a multiple of 16 bytes.
    @size(16) size_points: vec2<f32>,
}
@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var atlas: texture_2d<f32>;

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) texel: vec2<f32>,
    @location(1) colour: vec4<f32>,
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
    out.texel = part_of_atlas * vec2<f32>(textureDimensions(atlas));
    out.colour = colour;
    return out;
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    return in.colour * textureLoad(atlas, vec2<i32>(in.texel), 0);
}
