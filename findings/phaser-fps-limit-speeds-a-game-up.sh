#!/bin/sh
# Phaser 4.2.1 with `fps: { limit: 60 }` plays a game too fast on every display that is not much slower: at 1.2 times its speed on
# 144 Hz, 1.4 times on 75 Hz, and up to twice on 60 Hz.
#
# Phaser.Core.TimeStep.stepLimitFPS hands out all time since the last frame that it let through, and keeps `delta % limit` of it for
# the next one, so that this remainder is handed out twice.
#
# Needs node and npm. Prints the time handed out over 60 s, relative to real time, and fails if that changes.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
npm install --silent --no-audit --no-fund --prefix "$here" phaser@4.2.1 >/dev/null
cat > run.cjs <<'JS'
globalThis.window = { requestAnimationFrame: () => 0, cancelAnimationFrame: () => {} };
const TimeStep = require("./node_modules/phaser/src/core/TimeStep");
// Frames of a display whose moments have noise of a twentieth of a millisecond, from a generator with a fixed seed.
let seed = 1;
const noise = () => (seed = (seed * 48271) % 2147483647) / 2147483647 * 0.1 - 0.05;
let wrong = 0;
for (const [hz, [least, most]] of [[60, [1.2, 2.01]], [62, [1.4, 1.55]], [75, [1.3, 1.5]], [144, [1.15, 1.3]]]) {
  const clock = new TimeStep({}, { limit: 60 });
  let handed = 0, before = 0, first = 0, last = 0;
  clock.callback = (_, delta) => { handed += delta; };
  clock.deltaHistory = Array(clock.deltaSmoothingMax).fill(1000 / hz);
  clock.lastTime = 1000;
  for (let frame = 1; frame <= 70 * hz; frame++) {
    last = 1000 + frame * 1000 / hz + noise();
    clock.stepLimitFPS(last);
    if (frame === 10 * hz) [before, first] = [handed, last];
  }
  const speed = (handed - before) / (last - first);
  console.log(`limit 60 on ${hz} Hz: ${speed.toFixed(2)} of real time`);
  if (!(speed >= least && speed <= most)) wrong = 1;
}
process.exit(wrong);
JS
node run.cjs
