// Panels: egui's triangles, their colours premultiplied and in gamma space, text from an atlas.
//
// A texel is looked up, never filtered: egui sets text on whole pixels, so that every driver finds the
// same texel, and a software adapter has one to fetch and not four.

@group(1) @binding(0) var atlas: texture_2d<f32>;

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) colour: vec4<f32>,
    @location(1) texel: vec2<f32>,
}

@vertex
fn vertex(
    @location(0) at: vec2<f32>,
    @location(1) part_of_atlas: vec2<f32>,
    @location(2) colour: vec4<f32>,
) -> Varying {
    var out: Varying;
    out.position = clip_from_px(px_from_points(at));
    out.colour = colour;
    out.texel = part_of_atlas * vec2<f32>(textureDimensions(atlas));
    return out;
}

@fragment
fn fill(in: Varying) -> @location(0) vec4<f32> {
    return in.colour;
}

@fragment
fn textured(in: Varying) -> @location(0) vec4<f32> {
    return in.colour * textureLoad(atlas, vec2<i32>(in.texel), 0);
}
