//! egui's meshes and the curves of plots, as draws of the panels.
//!
//! `egui_wgpu` could draw the meshes. But its version 0.37 looks up one texel for each pixel, and blends every pixel
//! of a panel. Here large opaque triangles are stored without blending or lookup.

use egui::ClippedPrimitive;
use egui::epaint::{Mesh, Primitive, WHITE_UV};

use super::drawing::{Draw, DrawKind, Drawing, Place};
use super::screen_transform::ScreenTransform;
use super::strokes::StrokeMesh;

/// Smaller fills, in square pixels, do not merit a separate draw.
const MIN_FILL_PX: f32 = 4096.0;

/// Adds the panels over everything in the drawing.
pub(super) fn draw_panels(
    drawing: &mut Drawing,
    primitives: &[ClippedPrimitive],
    px_per_point: f32,
) {
    let size_px = drawing.size_px;
    let [width, height] = size_px.map(|side| side as f32);
    let edges_px = [0.0, 0.0, width, height];
    let transform = ScreenTransform { size_px, origin_px: [0.0; 2], px_per_point, edges_px };
    drawing.transforms[Place::Panels as usize] = transform;
    for ClippedPrimitive { clip_rect, primitive } in primitives {
        let scissor_px = scissor(*clip_rect, size_px, px_per_point);
        if scissor_px[2] > 0 && scissor_px[3] > 0 {
            add(drawing, primitive, scissor_px, px_per_point);
        }
    }
}

/// Adds the draws of a visible primitive.
fn add(drawing: &mut Drawing, primitive: &Primitive, scissor_px: [u32; 4], px_per_point: f32) {
    let place = Place::Panels;
    match primitive {
        Primitive::Mesh(mesh) => {
            let first_vertex = drawing.triangles.add_vertices(&mesh.vertices);
            let triangles = mesh.indices.as_chunks().0;
            let kinds = triangles.iter().map(|it: &[u32; 3]| (it, kind(mesh, it, px_per_point)));
            let kinds: Vec<_> = kinds.collect();
            for run in kinds.chunk_by(|a, b| a.1 == b.1) {
                let corners = run.iter().flat_map(|(corners, _)| **corners);
                let indices = drawing.triangles.add_indices(first_vertex, corners);
                drawing.draws.push(Draw { scissor_px, place, kind: run[0].1, indices });
            }
        }
        // Only the curves of plots are callbacks of ours.
        Primitive::Callback(callback) => {
            if let Some(mesh) = callback.callback.downcast_ref::<StrokeMesh>() {
                let indices = drawing.strokes.append(mesh);
                let kind = DrawKind::Stroke;
                drawing.draws.push(Draw { scissor_px, place, kind, indices });
            }
        }
    }
}

fn kind(mesh: &Mesh, corners: &[u32; 3], px_per_point: f32) -> DrawKind {
    let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize]);
    let (ab, ac) = (px_per_point * (b.pos - a.pos), px_per_point * (c.pos - a.pos));
    let is_large = (ab.x * ac.y - ab.y * ac.x).abs() / 2.0 >= MIN_FILL_PX;
    let is_plain = [a, b, c].iter().all(|v| v.uv == WHITE_UV && v.color == a.color);
    if is_large && is_plain && a.color.is_opaque() {
        DrawKind::OpaqueFill
    } else {
        DrawKind::Textured(mesh.texture_id)
    }
}

/// The pixels of a rectangle in points, within the target: left, top, width and height.
fn scissor(clip: egui::Rect, size_px: [u32; 2], px_per_point: f32) -> [u32; 4] {
    let px = |points: f32, side: usize| ((points * px_per_point).round() as u32).min(size_px[side]);
    let [left, right] = [clip.min.x, clip.max.x].map(|x| px(x, 0));
    let [top, bottom] = [clip.min.y, clip.max.y].map(|y| px(y, 1));
    [left, top, right.saturating_sub(left), bottom.saturating_sub(top)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Color32, Rect, TextureId, pos2, vec2};

    #[test]
    fn only_large_opaque_triangles_of_one_colour_are_fills() {
        let kinds = |size: f32, colour: Color32, change: fn(&mut Mesh)| {
            let mut mesh = Mesh::default();
            mesh.add_colored_rect(Rect::from_min_size(pos2(3.0, 4.0), vec2(size, size)), colour);
            change(&mut mesh);
            let kinds = mesh.indices.as_chunks::<3>().0.iter().map(|tri| kind(&mesh, tri, 2.0));
            kinds.collect::<Vec<_>>()
        };
        let textured = [DrawKind::Textured(TextureId::default()); 2];
        let grey = Color32::from_gray(40);
        assert_eq!(kinds(50.0, grey, |_| ()), [DrawKind::OpaqueFill; 2]);
        assert_eq!(kinds(40.0, grey, |_| ()), textured);
        assert_eq!(kinds(50.0, grey.gamma_multiply(0.9), |_| ()), textured);
        let one_white = |mesh: &mut Mesh| mesh.vertices[1].color = Color32::WHITE;
        assert_eq!(kinds(50.0, grey, one_white), textured);
        let text = |mesh: &mut Mesh| mesh.vertices[1].uv = pos2(0.5, 0.5);
        assert_eq!(kinds(50.0, grey, text), textured);
    }
}
