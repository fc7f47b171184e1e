// A fixed tick whose time comes in whole refreshes of the display, drawn on a line between the last two ticks: the
// timer's noise does not show.
//
//     GameLoop game_loop(60, 2997, 50);
//     // Each frame, with the duration of the last one:
//     for (int due = game_loop.frame(duration_ns); due > 0; --due) {
//         previous = current;
//         current.step(1.0 / 60);
//     }
//     draw(game_loop.drawn(previous.x, current.x));

#pragma once
#include <algorithm>
#include <cstdint>

// Time is counted in nanoseconds times ticks per second times the numerator of the refresh rate, in which a tick and a
// refresh are whole: nothing is rounded.
class GameLoop {
public:
    // The display's rate is a fraction of small numbers: 60 and 1, or 2997 and 50 for 59.94 Hz.
    GameLoop(int tick_hz, int refresh_numerator, int refresh_denominator)
        : tick_hz(tick_hz),
          nanosecond(std::int64_t{tick_hz} * refresh_numerator),
          tick(second_ns * refresh_numerator),
          refresh(second_ns * refresh_denominator * tick_hz) {}

    // The ticks to make now. A clock that went back counts as no time.
    int frame(std::int64_t duration_ns) {
        const std::int64_t time = std::max<std::int64_t>(duration_ns, 0) * nanosecond + debt;
        // A picture stays for a refresh at least, unless frames do not wait for the display.
        const bool a_refresh_ahead = 2 * time <= -refresh;
        const std::int64_t nearest = (2 * time + refresh) / (2 * refresh);
        const std::int64_t refreshes = a_refresh_ahead ? 0 : std::max<std::int64_t>(nearest, 1);
        debt = time - refreshes * refresh;
        owed += refreshes * refresh;
        const int due = static_cast<int>(owed / tick);
        owed %= tick;
        // More is not caught up: a machine that is too slow would have ever more to do.
        const int max_frame_ms = 250;
        return std::min(due, (tick_hz * max_frame_ms + 999) / 1000);
    }

    // A coordinate to draw, from those at the last two ticks.
    double drawn(double previous, double current) const {
        const double alpha = static_cast<double>(owed) / static_cast<double>(tick);
        return previous + (current - previous) * alpha;
    }

private:
    static constexpr std::int64_t second_ns = 1'000'000'000;
    int tick_hz;
    std::int64_t nanosecond, tick, refresh;
    std::int64_t debt = 0;  // The time that has not been counted yet; negative where more has been.
    std::int64_t owed = 0;  // The time since the last tick.
};
