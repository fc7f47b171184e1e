// Seas: night water or chart paper under a grid, in a cell with round corners.
//
// A cell is cut into parts. All but its corners are opaque, and so are the lines laid over them, which
// have the colour of the sea there with some of their own: no pixel has to ask whether it is on a line.

const CHART = vec3(0.043, 0.075, 0.118);
const WATER = vec3(0.035, 0.080, 0.133);
const SWELL = vec3(0.006, 0.016, 0.025);
// How much lighter than its middle the top of a cell is, as under a sky.
const SKY = 0.14;
// Steps from still water to a crest. Each is two levels of a byte, which nobody sees, and neighbours
// that are alike make a frame's file smaller and sooner written.
const STEPS = 3.2;
const TAU = 6.2831853;

struct Part {
    // Left, top, right and bottom: of the cell, and of the part.
    @location(0) cell_px: vec4<f32>,
    @location(1) part_px: vec4<f32>,
    // Origin, step.
    @location(2) grid_px: vec3<f32>,
    // How much, phase.
    @location(3) waves: vec2<f32>,
    // The colour of the line that the part is, or of the border of the corner that it is.
    @location(4) line: vec4<f32>,
    // The corner's radius and the border's width. Both are 0 where the part is no corner.
    @location(5) corner_px: vec2<f32>,
}

struct Varying {
    @builtin(position) position: vec4<f32>,
    // The colour in the middle of the cell, and how much darker a pixel is than the one above.
    @location(0) @interpolate(flat) colour: vec3<f32>,
    @location(1) @interpolate(flat) darker: vec3<f32>,
    @location(2) @interpolate(flat) swell: vec3<f32>,
    // The middle of the cell, half its size.
    @location(3) @interpolate(flat) cell_px: vec4<f32>,
    // Origin of the grid, grid steps in a pixel, phase in turns.
    @location(4) @interpolate(flat) waves: vec4<f32>,
    @location(5) @interpolate(flat) line: vec4<f32>,
    @location(6) @interpolate(flat) corner_px: vec2<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, part: Part) -> Varying {
    let half_px = 0.5 * (part.cell_px.zw - part.cell_px.xy);
    let sea = mix(CHART, WATER, part.waves.x);
    let line_alpha = select(part.line.a, 0.0, part.corner_px.x > 0.0);
    var out: Varying;
    out.position = clip_from_px(mix(part.part_px.xy, part.part_px.zw, corner_of(index)));
    out.colour = mix(sea, part.line.rgb, line_alpha);
    out.darker = sea * (1.0 - line_alpha) * SKY / max(half_px.y, 1.0);
    out.swell = SWELL * (1.0 - line_alpha) * part.waves.x;
    out.cell_px = vec4(part.cell_px.xy + half_px, half_px);
    out.waves = vec4(part.grid_px.xy, 1.0 / part.grid_px.z, part.waves.y / TAU);
    out.line = part.line;
    out.corner_px = part.corner_px;
    return out;
}

// The sine of an angle in turns, to a thousandth: a software adapter feels every true one.
fn wave(turns: vec3<f32>) -> vec3<f32> {
    let arch = roughly_wave(turns);
    return arch * (0.775 + 0.225 * abs(arch));
}

// The same to a twentieth.
fn roughly_wave(turns: vec3<f32>) -> vec3<f32> {
    let turn = turns - round(turns);
    return turn * (8.0 - 16.0 * abs(turn));
}

// Whole numbers of waves in a grid cell: the sea does not jump when the grid's origin does.
fn swell(turn: vec2<f32>, phase: f32) -> f32 {
    let bends = roughly_wave(vec3(turn.yx + vec2(0.111, phase), 0.0)).xy;
    let bent = turn + vec2(0.143, 0.0716) * bends;
    let waves = wave(vec3(
        bent.y + bent.x + phase,
        2.0 * bent.y - bent.x + 2.0 * phase,
        4.0 * bent.y + bent.x - phase,
    ));
    return round(STEPS * dot(waves, vec3(0.45, 0.35, 0.20))) / STEPS;
}

fn still(in: Varying) -> vec3<f32> {
    return in.colour - in.darker * (in.position.y - in.cell_px.y);
}

fn moving(in: Varying) -> vec3<f32> {
    let turn = (in.position.xy - in.waves.xy) * in.waves.z;
    return still(in) + in.swell * swell(turn, in.waves.w);
}

@fragment
fn water(in: Varying) -> @location(0) vec4<f32> {
    return vec4(moving(in), 1.0);
}

@fragment
fn chart(in: Varying) -> @location(0) vec4<f32> {
    return vec4(still(in), 1.0);
}

@fragment
fn corner(in: Varying) -> @location(0) vec4<f32> {
    let radius_px = in.corner_px.x;
    let beyond_px = abs(in.position.xy - in.cell_px.xy) - in.cell_px.zw + radius_px;
    let edge_px = length(max(beyond_px, vec2(0.0))) + min(max(beyond_px.x, beyond_px.y), 0.0)
        - radius_px;
    let border = clamp(edge_px + in.corner_px.y + 0.5, 0.0, 1.0);
    let coverage = clamp(0.5 - edge_px, 0.0, 1.0);
    return vec4(mix(moving(in), in.line.rgb, in.line.a * border), 1.0) * coverage;
}
