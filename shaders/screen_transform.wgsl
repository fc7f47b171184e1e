// Put before the other shaders: where points lie on the target.

struct ScreenTransform {
    target_px: vec2<f32>,
    origin_px: vec2<f32>,
    // Padded: GL wants a uniform's size to be a multiple of 16 bytes.
    @size(16) px_per_point: f32,
}
@group(0) @binding(0) var<uniform> transform: ScreenTransform;

fn px_from_points(points: vec2<f32>) -> vec2<f32> {
    return transform.origin_px + points * transform.px_per_point;
}

fn clip_from_px(px: vec2<f32>) -> vec4<f32> {
    let part = px / transform.target_px;
    return vec4(2.0 * part.x - 1.0, 1.0 - 2.0 * part.y, 0.0, 1.0);
}
