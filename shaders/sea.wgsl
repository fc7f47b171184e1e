// Seas: night water or chart paper under a grid, in a cell with round corners.

const CHART = vec3(0.043, 0.075, 0.118);
const WATER = vec3(0.035, 0.080, 0.133);
const SWELL = vec3(0.006, 0.016, 0.025);
const GRID = vec3(0.45, 0.65, 0.85);
const GRID_ALPHA = 0.085;
const BORDER = vec3(0.40, 0.58, 0.76);
const BORDER_ALPHA = 0.22;
const CORNER_POINTS = 5.0;
// Lines closer than the first are a grey wash, so they are left out; from the second on they are full.
const GRID_FADE_PX = vec2(4.0, 14.0);
// How much lighter than its middle the top of a cell is, as under a sky.
const SKY = 0.14;
const TAU = 6.2831853;

struct Instance {
    @location(0) rect: vec4<f32>,
    @location(1) grid_origin: vec2<f32>,
    @location(2) grid_step: f32,
    // How much, phase.
    @location(3) waves: vec2<f32>,
}

struct Varying {
    @builtin(position) position: vec4<f32>,
    // Middle, half size.
    @location(0) @interpolate(flat) cell_px: vec4<f32>,
    // Radius of the corners, how much lighter a pixel is than the one below, opacity of the grid.
    @location(1) @interpolate(flat) look: vec3<f32>,
    // Origin, step, steps in a pixel.
    @location(2) @interpolate(flat) grid_px: vec4<f32>,
    // How much, phase in turns.
    @location(3) @interpolate(flat) waves: vec2<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, sea: Instance) -> Varying {
    // On whole pixels, so that neighbours neither overlap nor leave a seam.
    let low_px = round(px_from_points(sea.rect.xy));
    let high_px = round(px_from_points(sea.rect.zw));
    let half_px = 0.5 * (high_px - low_px);
    let corner_px = min(CORNER_POINTS * stage.px_per_point, min(half_px.x, half_px.y));
    let step_px = max(sea.grid_step * stage.px_per_point, 1.0);
    let grid_alpha = GRID_ALPHA * smoothstep(GRID_FADE_PX.x, GRID_FADE_PX.y, step_px);
    var out: Varying;
    out.position = clip_from_px(mix(low_px, high_px, corner_of(index)));
    out.cell_px = vec4(0.5 * (low_px + high_px), half_px);
    out.look = vec3(corner_px, SKY / max(half_px.y, 1.0), grid_alpha);
    out.grid_px = vec4(px_from_points(sea.grid_origin), step_px, 1.0 / step_px);
    out.waves = vec2(sea.waves.x, sea.waves.y / TAU);
    return out;
}

// The sine of an angle in turns, to a thousandth: a software adapter feels every true one.
fn wave(turns: vec3<f32>) -> vec3<f32> {
    let turn = turns - round(turns);
    let arch = turn * (8.0 - 16.0 * abs(turn));
    return arch * (0.775 + 0.225 * abs(arch));
}

// Whole numbers of waves in a grid cell: the sea does not jump when the grid's origin does.
fn swell(turn: vec2<f32>, phase: f32) -> f32 {
    let bends = wave(vec3(turn.yx + vec2(0.111, phase), 0.0)).xy;
    let bent = turn + vec2(0.143, 0.0716) * bends;
    let waves = wave(vec3(
        bent.y + bent.x + phase,
        2.0 * bent.y - bent.x + 2.0 * phase,
        4.0 * bent.y + bent.x - phase,
    ));
    return dot(waves, vec3(0.45, 0.35, 0.20));
}

// A cell in the colour of its middle, lighter by `swell`.
fn cell(in: Varying, turn: vec2<f32>, middle: vec3<f32>, swell: vec3<f32>) -> vec4<f32> {
    let from_middle_px = in.position.xy - in.cell_px.xy;
    let beyond_px = abs(from_middle_px) - in.cell_px.zw + in.look.x;
    let edge_px = length(max(beyond_px, vec2(0.0))) + min(max(beyond_px.x, beyond_px.y), 0.0)
        - in.look.x;

    let line_px = max(1.0, round(stage.px_per_point));
    // On whole pixels: a line that lies across two of them is half as bright.
    let line_low_px = round(in.grid_px.xy + round(turn) * in.grid_px.z - 0.5 * line_px);
    let into_line_px = in.position.xy - line_low_px;
    let on_line = (into_line_px > vec2(0.0)) & (into_line_px < vec2(line_px));
    let grid_alpha = select(0.0, in.look.z, any(on_line));

    var colour = middle * (1.0 - in.look.y * from_middle_px.y) + swell;
    colour = mix(colour, GRID, grid_alpha);
    let border = clamp(edge_px + line_px + 0.5, 0.0, 1.0);
    colour = mix(colour, BORDER, BORDER_ALPHA * border);
    let coverage = clamp(0.5 - edge_px, 0.0, 1.0);
    return vec4(colour, 1.0) * coverage;
}

fn grid_turn(in: Varying) -> vec2<f32> {
    return (in.position.xy - in.grid_px.xy) * in.grid_px.w;
}

@fragment
fn water(in: Varying) -> @location(0) vec4<f32> {
    let turn = grid_turn(in);
    let height = in.waves.x * swell(turn, in.waves.y);
    return cell(in, turn, mix(CHART, WATER, in.waves.x), SWELL * height);
}

@fragment
fn chart(in: Varying) -> @location(0) vec4<f32> {
    return cell(in, grid_turn(in), CHART, vec3(0.0));
}
