//! The parts of a frame that are drawn otherwise than in the frame before.
//!
//! All that is drawn over a tile, in its order, has a hash. A tile that keeps its hash keeps its pixels.

use std::ops::Range;
use std::{iter, mem};

use bytemuck::{Pod, bytes_of};
use egui::epaint::Vertex;
use xxhash_rust::xxh3::xxh3_64;

use super::triangle::Triangle;
use super::{Placement, Textures, window};
use crate::drawing::{Backdrop, Draw, DrawKind, Drawing, Mesh, SeaRect, StrokeVertex};
use crate::screen_transform::ScreenTransform;

/// Pixels of a tile from top to bottom.
const HEIGHT: usize = 16;
/// Least pixels of a tile from left to right. A row of tiles has at most as many as a mask has bits.
const MIN_WIDTH: usize = 32;

/// The tiles of the frames of one renderer.
#[derive(Debug, Default)]
pub(super) struct Tiles {
    pub(super) size_px: [u32; 2],
    /// By rows of tiles.
    hashes: Vec<u64>,
    /// Those of the frame before.
    before: Vec<u64>,
    /// For each row of tiles, a bit for each that has changed.
    changed: Vec<u64>,
    /// For each triangle, the tiles that it may cover.
    covers: Vec<Cover>,
    /// Those of the vertices of a mesh.
    vertices: Vec<u64>,
}

/// Rows of tiles, and a bit for each column.
#[derive(Clone, Debug, Default)]
struct Cover {
    rows: Range<u16>,
    columns: u64,
}

impl Tiles {
    /// Finds the tiles that a drawing changes. It is drawn over this backdrop.
    pub(super) fn compare(
        &mut self,
        drawing: &Drawing,
        textures: &Textures,
        backdrop: Option<Backdrop>,
    ) {
        mem::swap(&mut self.hashes, &mut self.before);
        if mem::replace(&mut self.size_px, drawing.size_px) != drawing.size_px {
            self.before.clear();
        }
        let (columns, rows) = (self.columns(), (self.size_px[1] as usize).div_ceil(HEIGHT));
        let below = match (backdrop, drawing.sea) {
            (Some(Backdrop { id, .. }), _) => xxh3_64(bytes_of(&[id])),
            (None, Some(SeaRect { scissor_px, rect_px, colours })) => {
                let rects = [scissor_px, rect_px.map(f32::to_bits)];
                xxh3_64(bytes_of(&[xxh3_64(bytes_of(&rects)), xxh3_64(bytes_of(&colours))]))
            }
            (None, None) => 0,
        };
        self.hashes.clear();
        self.hashes.resize(columns * rows, below);
        self.covers.clear();
        for draw in drawing.draws.iter().skip(backdrop.map_or(0, |backdrop| backdrop.draws)) {
            match draw.kind {
                DrawKind::Stroke => self.add(drawing, draw, &drawing.strokes, textures),
                _ => self.add(drawing, draw, &drawing.triangles, textures),
            }
        }
        self.changed.clear();
        for (row, hashes) in self.hashes.chunks_exact(columns.max(1)).enumerate() {
            let before = self.before.get(row * columns..).unwrap_or_default();
            let bit = |n| u64::from(before.get(n) != Some(&hashes[n])) << n;
            self.changed.push((0..columns).map(bit).sum());
        }
    }

    /// Adds the triangles of a draw to the hashes of the tiles that they may cover.
    fn add<V: Corner>(
        &mut self,
        drawing: &Drawing,
        draw: &Draw,
        mesh: &Mesh<V>,
        textures: &Textures,
    ) {
        let indices = &mesh.indices[draw.indices.start as usize..draw.indices.end as usize];
        let (Some(&least), Some(&most)) = (indices.iter().min(), indices.iter().max()) else {
            return;
        };
        let triangles = indices.as_chunks::<3>().0;
        let [width, height] = drawing.size_px.map(|side| side as i32);
        let Some(window) = window(draw.scissor_px, width, [0, height]) else {
            return self.covers.extend(iter::repeat_n(Cover::default(), triangles.len()));
        };
        let at = Placement { window, transform: &drawing.transforms[draw.place as usize] };
        let of_draw = of_draw(draw, at, textures);
        let used = &mesh.vertices[least as usize..=most as usize];
        self.vertices.clear();
        self.vertices.extend(used.iter().map(Corner::hash));
        let columns = self.columns();
        for corners in triangles {
            let places = corners.map(|corner| mesh.vertices[corner as usize].at());
            let cover = at.triangle(places).map_or(Cover::default(), |it| self.cover(&it));
            let [a, b, c] = corners.map(|corner| self.vertices[(corner - least) as usize]);
            let of_triangle = xxh3_64(bytes_of(&[of_draw, a, b, c]));
            for row in cover.rows.clone() {
                let first = usize::from(row) * columns;
                for column in ones(cover.columns).flatten() {
                    let tile = &mut self.hashes[first + column];
                    *tile = xxh3_64(bytes_of(&[*tile, of_triangle]));
                }
            }
            self.covers.push(cover);
        }
    }

    /// Pixels of a tile from left to right.
    fn width(&self) -> usize {
        MIN_WIDTH.max((self.size_px[0] as usize).div_ceil(u64::BITS as usize))
    }

    /// Tiles in a row.
    fn columns(&self) -> usize {
        (self.size_px[0] as usize).div_ceil(self.width())
    }

    fn cover(&self, triangle: &Triangle) -> Cover {
        let Range { start, end } = &triangle.rows;
        let rows = (*start as usize / HEIGHT) as u16..(*end as usize).div_ceil(HEIGHT) as u16;
        let Range { start, end } = &triangle.columns;
        Cover { rows, columns: self.bits(*start as usize..*end as usize) }
    }

    /// A bit for each column of tiles that has one of these pixels. They are one at least.
    fn bits(&self, pixels: Range<usize>) -> u64 {
        let [first, last] = [pixels.start, pixels.end - 1].map(|pixel| pixel / self.width());
        u64::MAX >> (63 - (last - first)) << first
    }

    /// Whether a triangle, counted from the first that was compared, may cover a tile that has changed.
    pub(super) fn is_changed(&self, triangle: usize) -> bool {
        let Cover { rows, columns } = &self.covers[triangle];
        let rows = usize::from(rows.start)..usize::from(rows.end);
        self.changed[rows].iter().any(|changed| changed & columns != 0)
    }

    /// The parts of a row of pixels that lie in tiles that have changed. `xs` are one at least.
    pub(super) fn changed(&self, y: usize, xs: Range<usize>) -> impl Iterator<Item = Range<usize>> {
        let width = self.width();
        ones(self.changed[y / HEIGHT] & self.bits(xs.clone())).map(move |columns| {
            (columns.start * width).max(xs.start)..(columns.end * width).min(xs.end)
        })
    }

    /// The tiles that have changed, as rectangles: left, top, width and height, in pixels.
    pub(super) fn rects(&self) -> impl Iterator<Item = [u32; 4]> {
        let [width, height] = self.size_px.map(|side| side as usize);
        self.changed.iter().enumerate().flat_map(move |(row, _)| {
            let top = row * HEIGHT;
            let rows = HEIGHT.min(height - top);
            self.changed(top, 0..width)
                .map(move |columns| [columns.start, top, columns.len(), rows].map(|px| px as u32))
        })
    }
}

/// The runs of ones of a mask, from the lowest bit on.
fn ones(mut mask: u64) -> impl Iterator<Item = Range<usize>> {
    iter::from_fn(move || {
        let start = (mask != 0).then(|| mask.trailing_zeros())?;
        let end = start + (mask >> start).trailing_ones();
        mask &= u64::MAX.checked_shl(end).unwrap_or(0);
        Some(start as usize..end as usize)
    })
}

/// A vertex of either kind.
trait Corner: Pod {
    fn at(&self) -> [f32; 2];

    fn hash(&self) -> u64 {
        xxh3_64(bytes_of(self))
    }
}

impl Corner for Vertex {
    fn at(&self) -> [f32; 2] {
        self.pos.into()
    }
}

impl Corner for StrokeVertex {
    fn at(&self) -> [f32; 2] {
        self.at
    }
}

/// The hash that all triangles of a draw have in common.
fn of_draw(draw: &Draw, at: Placement<'_>, textures: &Textures) -> u64 {
    let kind = match draw.kind {
        DrawKind::OpaqueFill => 0,
        DrawKind::Stroke => 1,
        // Changes are counted from 1 on.
        DrawKind::Textured(id) => textures.present.get(&id).map_or(2, |texture| 2 + texture.change),
    };
    let &ScreenTransform { origin_px: [x, y], px_per_point, .. } = at.transform;
    let [x, y, px] = [x, y, px_per_point].map(f32::to_bits);
    let [left, top, width, height] = draw.scissor_px;
    xxh3_64(bytes_of(&[kind as u32, (kind >> 32) as u32, x, y, px, left, top, width, height]))
}
