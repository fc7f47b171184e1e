// A fixed tick, at most one a frame: where frames are too long, the game is slower.
//
//     GameLoop game_loop(60);
//     // Each frame, with the duration of the last one:
//     for (int due = game_loop.frame(duration_ns); due > 0; --due) {
//         world.step(1.0 / 60);
//     }
//     world.draw();

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
        const int due = owed >= second_ns ? 1 : 0;
        // One tick is kept, so that timer noise costs nothing; the others are never caught up.
        const std::int64_t left = owed - due * second_ns;
        owed = left < second_ns ? left : second_ns;
        return due;
    }

private:
    static constexpr std::int64_t second_ns = 1'000'000'000;
    int tick_hz;
    std::int64_t owed = 0;  // The time since the last tick.
};
