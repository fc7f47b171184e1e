// Semi-fixed steps: the frame in equal parts, none longer than a tick unless there are too many.
//
//     double stepSeconds;
//     int count = GameLoop.Frame(durationNs, 60, out stepSeconds);
//     for (int i = 0; i < count; i++) world.Step(stepSeconds);
//     world.Draw();

using System;

public static class GameLoop
{
    const long MostSteps = 6;
    const long SecondNs = 1000000000;

    // The steps to make and the length of each in seconds. A clock that went back counts as no time.
    public static int Frame(long durationNs, int tickHz, out double stepSeconds)
    {
        durationNs = Math.Max(durationNs, 0);
        // Rounded up, but for the nanosecond by which a clock rounds: in nanoseconds times ticks per second a tick is a
        // whole number.
        long fewest = ((durationNs - 1) * tickHz + SecondNs - 1) / SecondNs;
        long count = Math.Min(Math.Max(fewest, Math.Min(durationNs, 1)), MostSteps);
        stepSeconds = durationNs / 1e9 / Math.Max(count, 1);
        return (int)count;
    }
}
