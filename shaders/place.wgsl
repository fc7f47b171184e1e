// Put before the other shaders: where points lie on the target.

struct Place {
    target_px: vec2<f32>,
    origin_px: vec2<f32>,
    // Padded: GL wants a uniform's size to be a multiple of 16 bytes.
    @size(16) px_per_point: f32,
}
@group(0) @binding(0) var<uniform> place: Place;

fn px_from_points(points: vec2<f32>) -> vec2<f32> {
    return place.origin_px + points * place.px_per_point;
}

fn clip_from_px(px: vec2<f32>) -> vec4<f32> {
    let part = px / place.target_px;
    return vec4(2.0 * part.x - 1.0, 1.0 - 2.0 * part.y, 0.0, 1.0);
}
