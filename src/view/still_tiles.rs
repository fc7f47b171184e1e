//! What of the panels stays the same from frame to frame: drawn once into a texture, tile by tile, and copied from there.
//!
//! A tile shows the triangles that touch it, in their order. As long as these are the same to the bit, so are its pixels. A
//! graphics card draws them all in less time than it takes to compare them, so that only a software adapter keeps tiles: a
//! frame of a race with panels takes an eighth less of the processors' time.

use std::hash::Hash;

use super::gpu::Gpu;
use super::textures::{takes_copies, texture};

/// The side of a tile, in pixels: a word that changes takes a few of them along.
const SIDE_PX: u32 = 32;
/// A tile is kept once it has been the same as in the frame before so many times.
const WORTH_KEEPING: u32 = 4;

/// A rectangle of tiles: the first column and row, and those beyond the last. One without an area has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TileRect {
    from: [u32; 2],
    to: [u32; 2],
}

impl TileRect {
    /// All tiles of any target.
    pub(super) const ALL: Self = Self { from: [0; 2], to: [u32::MAX / SIDE_PX; 2] };

    /// The tiles that a rectangle touches, of which only a part shows; both in pixels, the part as left, top, width and
    /// height.
    pub(super) fn touched(px: egui::Rect, [left, top, width, height]: [u32; 4]) -> Self {
        if !px.is_positive() {
            return Self { from: [0; 2], to: [0; 2] };
        }
        let [low, high] = [[left, top], [left + width, top + height]];
        let within = |at: f32, axis: usize| (at as u32).clamp(low[axis], high[axis]);
        let from = [within(px.min.x.floor(), 0), within(px.min.y.floor(), 1)];
        let to = [within(px.max.x.ceil(), 0), within(px.max.y.ceil(), 1)];
        Self { from: from.map(|at| at / SIDE_PX), to: to.map(|at| at.div_ceil(SIDE_PX)) }
    }

    /// Whether both have a tile in common.
    pub(super) fn meets(self, other: Self) -> bool {
        (0..2).all(|axis| self.from[axis] < other.to[axis] && other.from[axis] < self.to[axis])
    }

    /// Its part of a rectangle of pixels: left, top, width and height.
    pub(super) fn part(self, [left, top, width, height]: [u32; 4]) -> [u32; 4] {
        let [low, high] = [[left, top], [left + width, top + height]];
        let [from, to] = [self.from, self.to].map(|corner| {
            std::array::from_fn::<u32, 2, _>(|axis| {
                (corner[axis] * SIDE_PX).clamp(low[axis], high[axis])
            })
        });
        [from[0], from[1], to[0] - from[0], to[1] - from[1]]
    }
}

/// A tile of the frame before.
#[derive(Clone, Copy, Debug, Default)]
struct Tile {
    /// What touches it, as a hash.
    shows: u64,
    /// In how many frames that has been the same as in the frame before.
    frames: u32,
    /// Whether the texture shows it.
    is_kept: bool,
}

/// What is to be done with the tiles of a frame.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Tiling {
    /// To be drawn on the target.
    pub(super) live: Vec<TileRect>,
    /// To be drawn on the texture.
    pub(super) new: Vec<TileRect>,
    /// To be copied from the texture.
    still: Vec<TileRect>,
}

/// Finds which tiles stay the same, and keeps them.
#[derive(Debug)]
pub(super) struct StillTiles {
    is_worth_it: bool,
    format: wgpu::TextureFormat,
    size_px: [u32; 2],
    /// What touches each tile of the frame that is looked at, row by row.
    shown: Vec<u64>,
    tiles: Vec<Tile>,
    texture: Option<wgpu::Texture>,
}

impl StillTiles {
    /// For frames that are drawn in this format.
    pub(super) fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        Self {
            is_worth_it: gpu.info.device_type == wgpu::DeviceType::Cpu,
            format,
            size_px: [0; 2],
            shown: Vec::new(),
            tiles: Vec::new(),
            texture: None,
        }
    }

    /// Forgets all tiles.
    fn forget(&mut self) {
        self.tiles.clear();
    }

    /// Begins to look at a frame of this size.
    pub(super) fn begin(&mut self, size_px: [u32; 2]) {
        if self.size_px != size_px {
            self.forget();
            self.texture = None;
        }
        self.size_px = size_px;
        let [columns, rows] = self.counts();
        self.shown.clear();
        self.shown.resize((columns * rows) as usize, 0);
    }

    /// Takes in what touches the tiles of a rectangle in pixels, of which only this part shows, and says which these are; all of
    /// them where no tiles are kept.
    pub(super) fn take_in(&mut self, px: egui::Rect, part: [u32; 4], what: impl Hash) -> TileRect {
        if !self.is_worth_it {
            return TileRect::ALL;
        }
        let touched = TileRect::touched(px, part);
        let hash = egui::util::hash(what);
        let [columns, _] = self.counts();
        for row in touched.from[1]..touched.to[1] {
            let [from, to] =
                [touched.from[0], touched.to[0]].map(|at| (row * columns + at) as usize);
            for tile in &mut self.shown[from..to] {
                *tile = egui::util::hash((*tile, hash));
            }
        }
        touched
    }

    /// What is to be done with the frame on a target, on which the stage, as left, top, width and height in pixels, shows what
    /// it likes.
    pub(super) fn tiling(
        &mut self,
        gpu: &Gpu,
        target: &wgpu::Texture,
        stage_px: [u32; 4],
    ) -> Tiling {
        let all = TileRect { from: [0; 2], to: self.counts() };
        if !self.is_worth_it || !takes_copies(target, self.format) {
            self.forget();
            return Tiling { live: vec![all], ..Tiling::default() };
        }
        self.tiles.resize(self.shown.len(), Tile::default());
        let columns = self.counts()[0];
        let [left, top, width, height] = stage_px.map(|px| px as f32);
        let rect = egui::Rect::from_min_size(egui::pos2(left, top), egui::vec2(width, height));
        let stage = TileRect::touched(rect, [0, 0, self.size_px[0], self.size_px[1]]);
        let mut fates = Vec::with_capacity(self.tiles.len());
        for (index, (tile, shows)) in (0..).zip(self.tiles.iter_mut().zip(&self.shown)) {
            if tile.shows == *shows {
                tile.frames += 1;
            } else {
                *tile = Tile { shows: *shows, ..Tile::default() };
            }
            let from = [index % columns, index / columns];
            let is_staged = stage.meets(TileRect { from, to: from.map(|at| at + 1) });
            fates.push(match () {
                () if is_staged => Fate::Live,
                () if tile.is_kept => Fate::Still,
                () if tile.frames >= WORTH_KEEPING => Fate::New,
                () => Fate::Live,
            });
            tile.is_kept |= fates[fates.len() - 1] == Fate::New;
        }
        if fates.contains(&Fate::New) && self.texture.is_none() {
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
            self.texture = Some(texture(gpu, "panels", self.size_px, self.format, usage));
        }
        let rects = |is: fn(Fate) -> bool| rects(&fates, columns, is);
        Tiling {
            live: rects(|fate| fate == Fate::Live),
            new: rects(|fate| fate == Fate::New),
            still: rects(|fate| fate != Fate::Live),
        }
    }

    /// What to draw new tiles on.
    pub(super) fn view(&self) -> Option<wgpu::TextureView> {
        let texture = self.texture.as_ref()?;
        Some(texture.create_view(&wgpu::TextureViewDescriptor::default()))
    }

    /// Copies the tiles that are kept to the target.
    pub(super) fn copy(
        &self,
        tiling: &Tiling,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::Texture,
    ) {
        let Some(texture) = &self.texture else { return };
        for rect in &tiling.still {
            let [x, y, width, height] = rect.part([0, 0, self.size_px[0], self.size_px[1]]);
            let origin = wgpu::Origin3d { x, y, z: 0 };
            let [from, to] = [texture, target]
                .map(|texture| wgpu::TexelCopyTextureInfo { origin, ..texture.as_image_copy() });
            let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
            encoder.copy_texture_to_texture(from, to, size);
        }
    }

    /// Columns and rows.
    fn counts(&self) -> [u32; 2] {
        self.size_px.map(|side| side.div_ceil(SIDE_PX))
    }
}

impl Tiling {
    /// Whether a part of the target comes from the texture.
    pub(super) fn has_still(&self) -> bool {
        !self.still.is_empty()
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Fate {
    Live,
    New,
    Still,
}

/// The tiles of which `is` holds, as few rectangles: runs of a row, with those below that are as wide.
fn rects(fates: &[Fate], columns: u32, is: fn(Fate) -> bool) -> Vec<TileRect> {
    let mut rects: Vec<TileRect> = Vec::new();
    for (row, fates) in (0..).zip(fates.chunks(columns as usize)) {
        let mut from = 0;
        for run in fates.chunk_by(|a, b| is(*a) == is(*b)) {
            let to = from + run.len() as u32;
            if is(run[0]) {
                let above = |rect: &&mut TileRect| {
                    [rect.from[0], rect.to[0], rect.to[1]] == [from, to, row]
                };
                match rects.iter_mut().rev().find(above) {
                    Some(rect) => rect.to[1] = row + 1,
                    None => rects.push(TileRect { from: [from, row], to: [to, row + 1] }),
                }
            }
            from = to;
        }
    }
    rects
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::Offscreen;
    use crate::view::testing::gpu_or_skip;

    const SIZE_PX: [u32; 2] = [100, 70];

    fn rect(from: [u32; 2], to: [u32; 2]) -> TileRect {
        TileRect { from, to }
    }

    fn touched(min: [f32; 2], max: [f32; 2]) -> TileRect {
        let px = egui::Rect::from_min_max(min.into(), max.into());
        TileRect::touched(px, [0, 0, SIZE_PX[0], SIZE_PX[1]])
    }

    #[test]
    fn a_rectangle_touches_the_tiles_of_its_pixels_that_show() {
        assert_eq!(touched([31.9, 32.0], [64.0, 64.1]), rect([0, 1], [2, 3]));
        assert_eq!(touched([-1e9, -5.0], [f32::INFINITY, 1.0]), rect([0, 0], [4, 1]));
        let cut = TileRect::touched(egui::Rect::EVERYTHING, [40, 0, 20, 70]);
        assert_eq!(cut, rect([1, 0], [2, 3]));
        assert_eq!(cut.part([0, 0, 100, 70]), [32, 0, 32, 70]);
        assert_eq!(cut.part([0, 0, 32, 70])[2], 0);
        assert_eq!(TileRect::touched(egui::Rect::NOTHING, [10, 10, 80, 20]), rect([0; 2], [0; 2]));
        assert!(cut.meets(rect([1, 2], [4, 3])) && !cut.meets(rect([2, 0], [4, 3])));
    }

    #[test]
    fn a_tile_off_the_stage_is_kept_after_some_frames_until_it_changes() {
        let test = "a_tile_off_the_stage_is_kept_after_some_frames_until_it_changes";
        let Some(gpu) = gpu_or_skip(test) else { return };
        let target = Offscreen::new(&gpu, SIZE_PX).unwrap().texture;
        let mut still =
            StillTiles { is_worth_it: true, ..StillTiles::new(&gpu, Offscreen::FORMAT) };
        let stage_px = [64, 0, 36, 70];
        let mut tiling = |number: u64| {
            still.begin(SIZE_PX);
            let all = [0, 0, SIZE_PX[0], SIZE_PX[1]];
            let of =
                |min: [f32; 2], max: [f32; 2]| egui::Rect::from_min_max(min.into(), max.into());
            assert_eq!(still.take_in(of([0.0; 2], [100.0, 70.0]), all, 7), rect([0, 0], [4, 3]));
            still.take_in(of([2.0, 40.0], [9.0, 60.0]), all, number);
            // Nothing at all, in a part that is wide and low.
            still.take_in(egui::Rect::NOTHING, [10, 10, 80, 20], number);
            still.tiling(&gpu, &target, stage_px)
        };
        let (panel, stage) = (rect([0, 0], [2, 3]), rect([2, 0], [4, 3]));
        let [first, .., last] =
            std::array::from_fn::<_, { WORTH_KEEPING as usize + 1 }, _>(|_| tiling(1));
        assert_eq!(first, Tiling { live: vec![rect([0, 0], [4, 3])], ..Tiling::default() });
        assert_eq!(last, Tiling { live: vec![stage], new: vec![panel], still: vec![panel] });
        assert_eq!(tiling(1), Tiling { live: vec![stage], new: vec![], still: vec![panel] });
        let changed = tiling(2);
        assert!(changed.live.contains(&rect([0, 1], [1, 2])), "{changed:?}");
        assert!(changed.new.is_empty() && changed.has_still());
        let tiles = |rects: &[TileRect]| -> u32 {
            rects
                .iter()
                .map(|rect| (0..2).map(|i| rect.to[i] - rect.from[i]).product::<u32>())
                .sum()
        };
        assert_eq!([tiles(&changed.live), tiles(&changed.still)], [7, 5]);
    }

    #[test]
    fn a_target_that_takes_no_copies_is_all_live() {
        let Some(gpu) = gpu_or_skip("a_target_that_takes_no_copies_is_all_live") else { return };
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let target = texture(&gpu, "plain", SIZE_PX, Offscreen::FORMAT, usage);
        let mut still =
            StillTiles { is_worth_it: true, ..StillTiles::new(&gpu, Offscreen::FORMAT) };
        for _ in 0..9 {
            still.begin(SIZE_PX);
            let all = Tiling { live: vec![rect([0, 0], [4, 3])], ..Tiling::default() };
            assert_eq!(still.tiling(&gpu, &target, [0; 4]), all);
        }
    }
}
