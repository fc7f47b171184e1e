// Runs every C# snippet over the durations on standard input. Arguments: the ticks per second, and the display's rate
// as a fraction.

using System;
using System.Collections.Generic;
using System.Globalization;

static class Driver
{
    static double tickSeconds;
    static readonly List<long> durations = new List<long>();

    static void Print(string id, int steps, double stepSeconds, double shownSeconds)
    {
        var culture = CultureInfo.InvariantCulture;
        Console.Write("{0} {1} {2} {3}\n", id, steps, stepSeconds.ToString("R", culture), shownSeconds.ToString("R", culture));
    }

    static void WholeTicks(string id, Func<long, int> frame, Func<double, double> shown)
    {
        int ticks = 0;
        foreach (long durationNs in durations)
        {
            int steps = frame(durationNs);
            ticks += steps;
            Print(id, steps, steps > 0 ? tickSeconds : 0, shown(ticks * tickSeconds));
        }
    }

    static void OneStep(string id, Func<long, double> frame)
    {
        double shown = 0;
        foreach (long durationNs in durations)
        {
            double step = frame(durationNs);
            shown += step;
            Print(id, step > 0 ? 1 : 0, step, shown);
        }
    }

    static void Main(string[] arguments)
    {
        int tickHz = int.Parse(arguments[0]);
        int numerator = int.Parse(arguments[1]), denominator = int.Parse(arguments[2]);
        tickSeconds = 1.0 / tickHz;
        string line;
        while ((line = Console.ReadLine()) != null) durations.Add(long.Parse(line));

        OneStep("variable", In_variable.GameLoop.Frame);
        OneStep("clamped-variable", In_clamped_variable.GameLoop.Frame);
        double total = 0;
        foreach (long durationNs in durations)
        {
            double step;
            int steps = In_semi_fixed.GameLoop.Frame(durationNs, tickHz, out step);
            total += steps * step;
            Print("semi-fixed", steps, step, total);
        }

        var whole = new In_fixed.GameLoop(tickHz);
        WholeTicks("fixed", whole.Frame, t => t);
        var linear = new In_fixed_linear.GameLoop(tickHz);
        WholeTicks("fixed-linear", linear.Frame, t => linear.Drawn(t - tickSeconds, t));
        var ahead = new In_fixed_extrapolated.GameLoop(tickHz);
        WholeTicks("fixed-extrapolated", ahead.Frame, t => ahead.Drawn(t, 1));
        var copied = new In_render_tick.GameLoop(tickHz);
        WholeTicks("render-tick", copied.Frame, t => t + copied.OwedS);
        var refreshes = new In_whole_refresh.GameLoop(tickHz, numerator, denominator);
        WholeTicks("whole-refresh", refreshes.Frame, t => refreshes.Drawn(t - tickSeconds, t));
    }
}
