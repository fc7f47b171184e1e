// Semi-fixed steps: the frame in equal parts, none longer than a tick unless there are too many.
//
//     const Steps steps = frame(duration_ns, 60);
//     for (int i = 0; i < steps.count; ++i) world.step(steps.step_s);
//     world.draw();

#pragma once
#include <algorithm>
#include <cstdint>

struct Steps {
    int count;
    double step_s;  // The length of each, in seconds.
};

// The steps to make. A clock that went back counts as no time.
inline Steps frame(std::int64_t duration_ns, int tick_hz) {
    const std::int64_t most_steps = 6, second_ns = 1'000'000'000;
    duration_ns = std::max<std::int64_t>(duration_ns, 0);
    // Rounded up, but for the nanosecond by which a clock rounds: in nanoseconds times ticks per second a tick is a
    // whole number.
    const std::int64_t fewest = ((duration_ns - 1) * tick_hz + second_ns - 1) / second_ns;
    const std::int64_t least = std::min<std::int64_t>(duration_ns, 1);
    const std::int64_t count = std::min(std::max(fewest, least), most_steps);
    const double parts = static_cast<double>(std::max<std::int64_t>(count, 1));
    return {static_cast<int>(count), static_cast<double>(duration_ns) / 1e9 / parts};
}
