// A fixed tick, drawn on a line between the last two: smooth, and one tick late.
//
//     var gameLoop = new GameLoop(60);
//     // Each frame, with the duration of the last one:
//     for (int due = gameLoop.Frame(durationNs); due > 0; due--)
//     {
//         previous = current;
//         current = current.Stepped(1.0 / 60);
//     }
//     Draw(gameLoop.Drawn(previous.X, current.X));

using System;

// Time is counted in nanoseconds times ticks per second, in which a tick is whole: nothing is rounded.
public class GameLoop
{
    const long SecondNs = 1000000000;
    const long MaxFrameMs = 250;

    readonly long tickHz;
    long owed; // The time since the last tick.

    public GameLoop(int tickHz)
    {
        this.tickHz = tickHz;
    }

    // The ticks to make now. A clock that went back counts as no time.
    public int Frame(long durationNs)
    {
        owed += Math.Max(durationNs, 0) * tickHz;
        long due = owed / SecondNs;
        owed %= SecondNs;
        // More is not caught up: a machine that is too slow would have ever more to do.
        return (int)Math.Min(due, (tickHz * MaxFrameMs + 999) / 1000);
    }

    // How far it is from the last tick to the next, from 0 to 1.
    public double Alpha
    {
        get { return owed / (double)SecondNs; }
    }

    // A coordinate to draw, from those at the last two ticks.
    public double Drawn(double previous, double current)
    {
        return previous + (current - previous) * Alpha;
    }
}
