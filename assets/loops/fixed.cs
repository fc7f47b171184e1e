// A fixed tick: whole ticks for the time that has passed. The picture shows the last one.
//
//     var gameLoop = new GameLoop(60);
//     // Each frame, with the duration of the last one:
//     for (int due = gameLoop.Frame(durationNs); due > 0; due--)
//     {
//         world.Step(1.0 / 60);
//     }
//     world.Draw();

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
}
