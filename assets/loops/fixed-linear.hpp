// A fixed tick, drawn on a line between the last two: smooth, and one tick late.
//
//     GameLoop game_loop(60);
//     // Each frame, with the duration of the last one:
//     for (int due = game_loop.frame(duration_ns); due > 0; --due) {
//         previous = current;
//         current.step(1.0 / 60);
//     }
//     draw(game_loop.drawn(previous.x, current.x));

#pragma once
#include <algorithm>
#include <cstdint>

// Time is counted in nanoseconds times ticks per second, in which a tick is whole: nothing is rounded.
class GameLoop {
public:
    explicit GameLoop(int tick_hz) : tick_hz(tick_hz) {}

    // The ticks to make now. A clock that went back counts as no time.
    int frame(std::int64_t duration_ns) {
        owed += std::max<std::int64_t>(duration_ns, 0) * tick_hz;
        const int due = static_cast<int>(owed / second_ns);
        owed %= second_ns;
        // More is not caught up: a machine that is too slow would have ever more to do.
        const int max_frame_ms = 250;
        return std::min(due, (tick_hz * max_frame_ms + 999) / 1000);
    }

    // How far it is from the last tick to the next, from 0 to 1.
    double alpha() const { return static_cast<double>(owed) / second_ns; }

    // A coordinate to draw, from those at the last two ticks.
    double drawn(double previous, double current) const {
        return previous + (current - previous) * alpha();
    }

private:
    static constexpr std::int64_t second_ns = 1'000'000'000;
    int tick_hz;
    std::int64_t owed = 0;  // The time since the last tick.
};
