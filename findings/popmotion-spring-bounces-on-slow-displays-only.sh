#!/bin/sh
# popmotion 11.0.5: one spring from 0 to 1 swings to 1.73 on a display of 60 Hz, and stops dead at 1 on one of 120 Hz.
#
# Here stiffness 4 and damping 0.4, as for a slow sway of an opacity or a scale. One expects the same motion on both, since the
# spring is a closed form of the time, and an end when the swing has died down, after 22 s.
#
# It ends at the first frame whose value is within a hundredth of the way and whose speed is at most restSpeed. The first scales
# with the way, restSpeed does not: it is 2 units a second, and from 0 to 1 such a spring never moves faster. So it ends at the
# first frame that happens to fall near the target, which frames that are closer together sooner do. From 0 to 100 all is well, and
# so with restSpeed: 0.02. (popmotion/dist/es/animations/generators/spring.mjs)
#
# Needs node and npm. Prints end and widest place by display, and fails if they change.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
npm install --silent --no-audit --no-fund --prefix "$here" popmotion@11.0.5 >/dev/null
cat > run.cjs <<'JS'
const { spring } = require("popmotion");
function watch(hz, to, more) {
  const motion = spring({ from: 0, to, stiffness: 4, damping: 0.4, ...more });
  let widest = 0;
  for (let frame = 0; frame < 60 * hz; frame++) {
    const { done, value } = motion.next(frame * 1000 / hz);
    widest = Math.max(widest, value / to);
    if (done) return [frame / hz, widest];
  }
  return [Infinity, widest];
}
const rows = [
  [30, 1, {}, 4.0, 1.729], [60, 1, {}, 2.42, 1.729], [120, 1, {}, 0.84, 1], [240, 1, {}, 0.84, 1],
  [60, 100, {}, 22.98, 1.729], [120, 100, {}, 22.98, 1.729], [120, 1, { restSpeed: 0.02 }, 21.68, 1.729],
];
let wrong = 0;
for (const [hz, to, more, time, width] of rows) {
  const [end, widest] = watch(hz, to, more);
  const name = more.restSpeed ? `, restSpeed ${more.restSpeed}` : "";
  console.log(`0 to ${to} at ${hz} Hz${name}: at most ${widest.toFixed(3)} of the way, ends at ${end.toFixed(2)} s`);
  if (!(Math.abs(end - time) < 0.05 && Math.abs(widest - width) < 0.002)) wrong = 1;
}
process.exit(wrong);
JS
node run.cjs
