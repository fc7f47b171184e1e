// A variable step with a longest one: a hitch slows the game down, and blows nothing up.
//
//     world.Step(GameLoop.Frame(durationNs));
//     world.Draw();

using System;

public static class GameLoop
{
    const long MaxFrameNs = 1000000000 / 30;

    // The length in seconds of the step to make. A clock that went back counts as no time, and no time needs no step.
    public static double Frame(long durationNs)
    {
        return Math.Min(Math.Max(durationNs, 0), MaxFrameNs) / 1e9;
    }
}
