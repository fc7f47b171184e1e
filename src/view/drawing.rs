//! A frame as plain data: triangles in painting order. An executor turns it into pixels.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use egui::epaint::{ImageDelta, Vertex, WHITE_UV};
use egui::{Color32, Pos2, Rect, TextureId, pos2, vec2};

use super::screen_transform::ScreenTransform;

/// A frame, ready to be drawn.
///
/// Pass every drawing of a [`FrameRenderer`](super::FrameRenderer) to the same executor, in order: each contains only
/// the changes of textures since the one before.
#[derive(Clone, Default)]
pub struct Drawing {
    pub(super) size_px: [u32; 2],
    pub(super) textures: TextureChanges,
    /// Indexed by [`Place`].
    pub(super) transforms: [ScreenTransform; 2],
    /// Drawn first, on black.
    pub(super) sea: Option<SeaRect>,
    pub(super) backdrop: Option<Backdrop>,
    pub(super) draws: Vec<Draw>,
    pub(super) triangles: Mesh<Vertex>,
    pub(super) strokes: Mesh<StrokeVertex>,
}

impl Drawing {
    /// Whether each pixel, in rows from the top, lies in the rectangle of a letter.
    pub(super) fn has_letters(&self) -> Vec<bool> {
        let [width, height] = self.size_px.map(|side| side as usize);
        let mut has_letters = vec![false; width * height];
        let of_letters = DrawKind::Textured(TextureId::default());
        for draw in self.draws.iter().filter(|draw| draw.kind == of_letters) {
            let transform = &self.transforms[draw.place as usize];
            let [left, top, width_px, height_px] = draw.scissor_px.map(|px| px as f32);
            let scissor = Rect::from_min_size(pos2(left, top), vec2(width_px, height_px));
            let visible_part = |corners: [&Vertex; 3]| {
                let at_px = corners.map(|corner| Pos2::from(transform.px(corner.pos.into())));
                Rect::from_points(&at_px).intersect(scissor)
            };
            let triangles = self.triangles.corners(&draw.indices);
            let letters = triangles.filter(|corners| corners.iter().any(|it| it.uv != WHITE_UV));
            for Rect { min, max } in letters.map(visible_part).filter(Rect::is_positive) {
                for row in min.y as usize..max.y.ceil() as usize {
                    let columns = min.x as usize..max.x.ceil() as usize;
                    has_letters[row * width..][columns].fill(true);
                }
            }
        }
        has_letters
    }
}

/// Changes of textures: new ones and parts of old ones before the draws, removed ones after them.
#[derive(Clone, Default)]
pub(super) struct TextureChanges {
    pub(super) set: Vec<(TextureId, ImageDelta)>,
    pub(super) freed: Vec<TextureId>,
}

/// The static bottom of a frame: the sea and the first draws. An executor may keep its pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Backdrop {
    /// Equal in two drawings of a renderer only if the pixels are equal.
    pub(super) id: u64,
    /// Number of its draws.
    pub(super) draws: usize,
}

/// Triangles of one kind with one scissor.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Draw {
    /// Left, top, width and height on the target; not empty.
    pub(super) scissor_px: [u32; 4],
    pub(super) place: Place,
    pub(super) kind: DrawKind,
    /// Indices of the corners, three per triangle.
    pub(super) indices: Range<u32>,
}

/// The part of the frame whose transform applies to the vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    Stage,
    Panels,
}

/// Work for a pixel of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DrawKind {
    /// Storing only: the triangle is opaque, in one colour, and large.
    OpaqueFill,
    /// Looking up a texel and blending it.
    Textured(TextureId),
    /// Computing the covered part of the pixel, and blending.
    Stroke,
}

/// A picture's sea.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SeaRect {
    /// Left, top, width and height on the target; not empty.
    pub(super) scissor_px: [u32; 4],
    /// Left, top, right and bottom, on whole pixels.
    pub(super) rect_px: [f32; 4],
    /// Colours at the top and at the bottom.
    pub(super) colours: [[u8; 4]; 2],
}

/// A vertex in `shaders/strokes.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(super) struct StrokeVertex {
    /// In points.
    pub(super) at: [f32; 2],
    /// Half the line's width here, and the distance from its middle.
    pub(super) across_px: [f32; 2],
    /// Distance along the line from the middle of its first dash; distance from the middle of a dash to its round
    /// end; and distance between dashes.
    pub(super) along_px: [f32; 3],
    pub(super) colour: Color32,
}

/// Triangles with one type of vertex.
#[derive(Clone, Debug)]
pub(super) struct Mesh<V> {
    pub(super) vertices: Vec<V>,
    pub(super) indices: Vec<u32>,
}

impl<V> Default for Mesh<V> {
    fn default() -> Self {
        Self { vertices: Vec::new(), indices: Vec::new() }
    }
}

impl<V> Mesh<V> {
    /// Corners of the triangles that have these indices.
    pub(super) fn corners(&self, indices: &Range<u32>) -> impl Iterator<Item = [&V; 3]> {
        let indices = &self.indices[indices.start as usize..indices.end as usize];
        let triangles = indices.as_chunks::<3>().0;
        triangles.iter().map(|corners| corners.map(|corner| &self.vertices[corner as usize]))
    }
}

impl<V: Copy> Mesh<V> {
    /// Adds a mesh. Returns the range of its indices.
    pub(super) fn append(&mut self, mesh: &Mesh<V>) -> Range<u32> {
        let first_vertex = self.add_vertices(&mesh.vertices);
        self.add_indices(first_vertex, mesh.indices.iter().copied())
    }

    /// Adds vertices. Returns the index of the first.
    pub(super) fn add_vertices(&mut self, vertices: &[V]) -> u32 {
        let first = self.vertices.len() as u32;
        self.vertices.extend_from_slice(vertices);
        first
    }

    /// Adds the corners of triangles, counted from `first_vertex`. Returns the range of their indices.
    pub(super) fn add_indices(
        &mut self,
        first_vertex: u32,
        indices: impl Iterator<Item = u32>,
    ) -> Range<u32> {
        let first = self.indices.len() as u32;
        self.indices.extend(indices.map(|index| first_vertex + index));
        first..self.indices.len() as u32
    }
}

impl From<egui::TexturesDelta> for TextureChanges {
    fn from(mut delta: egui::TexturesDelta) -> Self {
        let set = delta.set.drain();
        let set = set.flat_map(|(id, deltas)| deltas.into_iter().map(move |delta| (id, delta)));
        Self { set: set.collect(), freed: delta.free.drain().collect() }
    }
}
