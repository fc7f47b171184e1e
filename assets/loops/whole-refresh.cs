// A fixed tick whose time comes in whole refreshes of the display, drawn on a line between the last two ticks: the
// timer's noise does not show.
//
//     var gameLoop = new GameLoop(60, 2997, 50);
//     // Each frame, with the duration of the last one:
//     for (int due = gameLoop.Frame(durationNs); due > 0; due--)
//     {
//         previous = current;
//         current = current.Stepped(1.0 / 60);
//     }
//     Draw(gameLoop.Drawn(previous.X, current.X));

using System;

// Time is counted in nanoseconds times ticks per second times the numerator of the refresh rate, in which a tick and a
// refresh are whole: nothing is rounded.
public class GameLoop
{
    const long SecondNs = 1000000000;
    const long MaxFrameMs = 250;

    readonly long nanosecond, tick, refresh, mostTicks;
    long debt; // The time that has not been counted yet; negative where more has been.
    long owed; // The time since the last tick.

    // The display's rate is a fraction of small numbers: 60 and 1, or 2997 and 50 for 59.94 Hz.
    public GameLoop(int tickHz, int refreshNumerator, int refreshDenominator)
    {
        nanosecond = (long)tickHz * refreshNumerator;
        tick = SecondNs * refreshNumerator;
        refresh = SecondNs * refreshDenominator * tickHz;
        mostTicks = (tickHz * MaxFrameMs + 999) / 1000;
    }

    // The ticks to make now. A clock that went back counts as no time.
    public int Frame(long durationNs)
    {
        long time = Math.Max(durationNs, 0) * nanosecond + debt;
        // A picture stays for a refresh at least, unless frames do not wait for the display.
        bool aRefreshAhead = 2 * time <= -refresh;
        long nearest = (2 * time + refresh) / (2 * refresh);
        long refreshes = aRefreshAhead ? 0 : Math.Max(nearest, 1);
        debt = time - refreshes * refresh;
        owed += refreshes * refresh;
        long due = owed / tick;
        owed %= tick;
        // More is not caught up: a machine that is too slow would have ever more to do.
        return (int)Math.Min(due, mostTicks);
    }

    // A coordinate to draw, from those at the last two ticks.
    public double Drawn(double previous, double current)
    {
        double alpha = owed / (double)tick;
        return previous + (current - previous) * alpha;
    }
}
