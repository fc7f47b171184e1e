// A fixed tick, drawn as a copy that is stepped on by the time since the last one and dropped: smooth and not late,
// but wrong after each kick, and a step must leave nothing behind but its state.
//
//     GameLoop game_loop(60);
//     // Each frame, with the duration of the last one:
//     for (int due = game_loop.frame(duration_ns); due > 0; --due) {
//         world.step(1.0 / 60);
//     }
//     World ahead = world;
//     ahead.step(game_loop.owed_s());
//     draw(ahead);

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

    // The step of the copy that is drawn, in seconds: the time since the last tick.
    double owed_s() const { return static_cast<double>(owed) / second_ns / tick_hz; }

private:
    static constexpr std::int64_t second_ns = 1'000'000'000;
    int tick_hz;
    std::int64_t owed = 0;  // The time since the last tick.
};
