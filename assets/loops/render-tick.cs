// A fixed tick, drawn as a copy that is stepped on by the time since the last one and dropped: smooth and not late,
// but wrong after each kick, and a step must leave nothing behind but its state.
//
//     var gameLoop = new GameLoop(60);
//     // Each frame, with the duration of the last one:
//     for (int due = gameLoop.Frame(durationNs); due > 0; due--)
//     {
//         world.Step(1.0 / 60);
//     }
//     World ahead = world.Copy();
//     ahead.Step(gameLoop.OwedS);
//     Draw(ahead);

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

    // The step of the copy that is drawn, in seconds: the time since the last tick.
    public double OwedS => owed / (double)SecondNs / tickHz;
}
