// A variable step: one step a frame, as long as the last frame was.
//
//     world.Step(GameLoop.Frame(durationNs));
//     world.Draw();

using System;

public static class GameLoop
{
    // The length in seconds of the step to make. A clock that went back counts as no time, and no time needs no step.
    public static double Frame(long durationNs)
    {
        return Math.Max(durationNs, 0) / 1e9;
    }
}
