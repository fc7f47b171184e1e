// A variable step: one step a frame, as long as the last frame was.
//
//     world.step(frame(duration_ns));
//     world.draw();

#pragma once
#include <algorithm>
#include <cstdint>

// The length in seconds of the step to make. A clock that went back counts as no time, and no time needs no step.
inline double frame(std::int64_t duration_ns) {
    return static_cast<double>(std::max<std::int64_t>(duration_ns, 0)) / 1e9;
}
