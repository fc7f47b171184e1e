// Runs every C++ snippet over the durations on standard input. Arguments: the ticks per second, and the display's rate
// as a fraction.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace variable {
#include "variable.hpp"
}
namespace clamped_variable {
#include "clamped-variable.hpp"
}
namespace semi_fixed {
#include "semi-fixed.hpp"
}
namespace fixed {
#include "fixed.hpp"
}
namespace fixed_linear {
#include "fixed-linear.hpp"
}
namespace fixed_hermite {
#include "fixed-hermite.hpp"
}
namespace fixed_extrapolated {
#include "fixed-extrapolated.hpp"
}
namespace render_tick {
#include "render-tick.hpp"
}
namespace whole_refresh {
#include "whole-refresh.hpp"
}
namespace slow_down {
#include "slow-down.hpp"
}

static double tick_s;
static std::vector<std::int64_t> durations;

static void print(const char* id, int steps, double step_s, double shown_s) {
    std::printf("%s %d %.17g %.17g\n", id, steps, step_s, shown_s);
}

template <class GameLoop, class Shown>
static void whole_ticks(const char* id, GameLoop game_loop, Shown shown) {
    int ticks = 0;
    for (const std::int64_t duration_ns : durations) {
        const int steps = game_loop.frame(duration_ns);
        ticks += steps;
        print(id, steps, steps > 0 ? tick_s : 0, shown(game_loop, ticks * tick_s));
    }
}

template <class Frame>
static void one_step(const char* id, Frame frame) {
    double shown_s = 0;
    for (const std::int64_t duration_ns : durations) {
        const double step_s = frame(duration_ns);
        shown_s += step_s;
        print(id, step_s > 0, step_s, shown_s);
    }
}

int main(int, char** arguments) {
    const int tick_hz = std::atoi(arguments[1]);
    const int numerator = std::atoi(arguments[2]), denominator = std::atoi(arguments[3]);
    tick_s = 1.0 / tick_hz;
    long long duration_ns;
    while (std::scanf("%lld", &duration_ns) == 1) durations.push_back(duration_ns);

    one_step("variable", variable::frame);
    one_step("clamped-variable", clamped_variable::frame);
    double shown_s = 0;
    for (const std::int64_t duration : durations) {
        const semi_fixed::Steps steps = semi_fixed::frame(duration, tick_hz);
        shown_s += steps.count * steps.step_s;
        print("semi-fixed", steps.count, steps.step_s, shown_s);
    }

    const auto last = [](const auto&, double t) { return t; };
    const auto between = [](const auto& game_loop, double t) { return game_loop.drawn(t - tick_s, t); };
    whole_ticks("fixed", fixed::GameLoop(tick_hz), last);
    whole_ticks("slow-down", slow_down::GameLoop(tick_hz), last);
    whole_ticks("fixed-linear", fixed_linear::GameLoop(tick_hz), between);
    whole_ticks("fixed-hermite", fixed_hermite::GameLoop(tick_hz),
                [](const auto& game_loop, double t) { return game_loop.drawn(t - tick_s, t, 1, 1); });
    whole_ticks("fixed-extrapolated", fixed_extrapolated::GameLoop(tick_hz),
                [](const auto& game_loop, double t) { return game_loop.drawn(t, 1); });
    whole_ticks("render-tick", render_tick::GameLoop(tick_hz),
                [](const auto& game_loop, double t) { return t + game_loop.owed_s(); });
    whole_ticks("whole-refresh", whole_refresh::GameLoop(tick_hz, numerator, denominator), between);
}
