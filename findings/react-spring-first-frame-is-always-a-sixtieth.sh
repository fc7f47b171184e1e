#!/bin/sh
# @react-spring/core 10.1.2: the first frame of an animation is always 1/60 s, on displays of 30 and of 120 Hz too.
#
# So one spring is at another place at the same moment on each of these displays.
#
# Needs node and npm. Prints the first value of each, which is that of 17 steps of 1 ms, and fails if they differ.
set -eu
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
npm install --silent --no-audit --no-fund --prefix "$here" @react-spring/core@10.1.2 @react-spring/rafz@10.1.2 react@19 react-dom@19 >/dev/null
cat > run.cjs <<'JS'
const { Controller, Globals } = require("@react-spring/core");
const { raf } = require("@react-spring/rafz");
async function seen(hz) {
  let now = 1000, due = [];
  Globals.assign({ now: () => now, requestAnimationFrame: (callback) => due.push(callback), frameLoop: "always" });
  raf.use((callback) => due.push(callback));
  raf.now = () => now;
  const controller = new Controller({ x: 0 });
  controller.start({ x: 1, config: { tension: 180, friction: 12 } });
  await Promise.resolve();
  const values = [];
  for (let frame = 0; frame < hz / 2; frame++) {
    const callbacks = due;
    due = [];
    now = 1000 + frame * 1000 / hz;
    callbacks.forEach((callback) => callback(now));
    await Promise.resolve();
    values.push(controller.springs.x.get());
  }
  return values.filter((value) => value > 0);
}
seen(Number(process.argv[2])).then((values) => console.log(values[0].toFixed(5)));
JS
failed=0
for hz in 30 60 120; do
    first=$(node run.cjs $hz)
    echo "$hz Hz: first value $first"
    [ "$first" = "${before:=$first}" ] || failed=1
done
[ "$before" = 0.02574 ] || failed=1
exit $failed
