// A variable step with a longest one: a hitch slows the game down, and blows nothing up.
//
//     world.step(frame(duration_ns));
//     world.draw();

#pragma once
#include <algorithm>
#include <cstdint>

// The length in seconds of the step to make. A clock that went back counts as no time, and no time needs no step.
inline double frame(std::int64_t duration_ns) {
    const std::int64_t max_frame_ns = 1'000'000'000 / 30;
    const std::int64_t step_ns = std::min(std::max<std::int64_t>(duration_ns, 0), max_frame_ns);
    return static_cast<double>(step_ns) / 1e9;
}
