#!/bin/sh
# Excalibur 0.32.0: a frame of more than 200 ms counts as 1 ms. At 5.1 frames a second a game runs at full speed, at 4.9 it stands.
#
# One expects a long frame to be cut to some longest one, as in most loops, so that the game slows down. Clock.update puts 1 ms in
# its place: a frame of 199 ms moves a body of 100 px/s by 19.9 px, one of 201 ms by 0.1 px. It is meant for a window that was in the
# background, but a device that is a little too slow meets it in each frame, and its game stands, while frames go on to be drawn.
# A fixedUpdateFps does not help, for it divides what the clock hands out.
#
# Needs node and npm. Prints the time handed out over real time; fails if that changes.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
npm install --silent --no-audit --no-fund --prefix "$here" excalibur@0.32.0 >/dev/null
cat > run.cjs <<'JS'
globalThis.window = globalThis;
const { StandardClock } = require("excalibur");
class Handed extends StandardClock {
  now() { return this.time; }
}
function speed(fps) {
  let handed = 0;
  const clock = new Handed({ tick: (ms) => { handed += ms; } });
  clock.time = clock._lastTime = 1000;
  for (let frame = 0; frame < 100; frame++) {
    clock.time += 1000 / fps;
    clock.update();
  }
  return handed / (clock.time - 1000);
}
let wrong = 0;
for (const [fps, expected] of [[60, 1], [10, 1], [5.1, 1], [4.9, 0.0049], [2, 0.002]]) {
  const ratio = speed(fps);
  console.log(`${fps} frames a second: the game runs at ${(100 * ratio).toFixed(2)} % of real time`);
  if (!(Math.abs(ratio / expected - 1) < 0.01)) wrong = 1;
}
process.exit(wrong);
JS
node run.cjs
