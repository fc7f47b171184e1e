#!/bin/sh
# matter-js 0.20.0: its Runner answers a hitch of 50 ms with one tick at once, and with a double tick a good half second later.
#
# Runner.tick smooths frame times by the mean of the last hundred, sorted, without the ten shortest and the ten longest, and
# rounds the result to a whole frame rate. A long frame is left out of that mean, but its time stays in the buffer, from which a
# tick is only taken when 1.5 ticks are there. So a game that is smooth before and after a hitch jumps once more later.
# On a display of 59.94 Hz the same rounding makes it lose 1 ms a second for ever.
#
# Needs node and npm. Prints the frames without one tick around a hitch, and the time lost at 59.94 Hz; fails if they change.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
npm install --silent --no-audit --no-fund --prefix "$here" matter-js@0.20.0 >/dev/null
cat > run.cjs <<'JS'
globalThis.window = { requestAnimationFrame: () => 1, cancelAnimationFrame: () => {} };
const { Engine, Events, Runner } = require("matter-js");
function ticks(times) {
  const engine = Engine.create(), runner = Runner.create();
  let now = 0;
  const seen = [];
  Events.on(engine, "afterUpdate", () => { now += 1; });
  for (const time of times) {
    now = 0;
    Runner.tick(runner, engine, time);
    seen.push(now);
  }
  return seen;
}
const hitch = [];
let t = 1000;
for (let frame = 0; frame < 600; frame++) hitch.push(t += frame === 300 ? 50 : 1000 / 60);
const seen = ticks(hitch);
const odd = seen.map((n, frame) => [frame, n]).filter(([frame, n]) => frame > 5 && n !== 1);
const told = odd.map(([frame, n]) => `${n} ticks ${((hitch[frame] - hitch[300]) / 1000).toFixed(2)} s after the hitch`);
console.log(`ticks in the frame of 50 ms: ${seen[300]}; then ${told.join(", ") || "one in every frame"}`);
const slow = Array.from({ length: 3597 }, (_, n) => 1000 + n * 1001 / 60);
const made = ticks(slow).reduce((sum, n) => sum + n, 0);
const lost = (slow.at(-1) - slow[0]) - made * 1000 / 60;
console.log(`at 59.94 Hz: ${lost.toFixed(1)} ms lost in 60 s`);
const late = odd.filter(([frame, n]) => frame > 300 && n === 2);
const after = late.length === 1 ? hitch[late[0][0]] - hitch[300] : NaN;
process.exit(seen[300] === 1 && after > 300 && after < 1000 && lost > 20 && lost < 100 ? 0 : 1);
JS
node run.cjs
