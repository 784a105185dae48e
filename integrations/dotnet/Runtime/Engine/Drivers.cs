// Drivers.cs: what the components do each fixed update, without an engine.
using System;

namespace Foretouch {
  /// <summary>What a body meets between two updates. For ForetouchBody.</summary>
  public sealed class BodyStepper : IDisposable {
    readonly FtScene scene;
    readonly Skeleton skeleton;
    readonly FtQuery query;
    readonly FtPoseBuffer pose;
    bool hasBegun;

    /// <summary>Keeps neither: the maker of scene and skeleton disposes of them, in any order.</summary>
    public BodyStepper(FtScene scene, Skeleton skeleton, double tolerance) {
      this.scene = scene;
      this.skeleton = skeleton;
      pose = new FtPoseBuffer(skeleton.JointCount);
      var options = FtQueryOptions.Usual;
      options.tolerance = tolerance;
      query = FtQuery.Create(scene, skeleton.Avatar, options);
    }

    /// <summary>From where the bones were at the last call to where they are. The first call only begins.
    /// After a problem the next one begins anew: what happened in between is not known.</summary>
    public void Step(Action<BodyTouch> tell) {
      bool goesOn = hasBegun;
      hasBegun = false;
      skeleton.Read(pose);
      if (goesOn) query.Step(pose);
      else query.Begin(pose);
      hasBegun = true;
      if (!goesOn || tell == null) return;
      ReadOnlySpan<FtContact> contacts = query.Contacts();
      // A listener may destroy what reports to it.
      for (int i = 0; i < contacts.Length && !query.IsClosed; ++i)
        tell(BodyTouch.Of(contacts[i], skeleton.Avatar, scene, skeleton.Axes));
    }

    /// <summary>After a teleport, or a gap in tracking.</summary>
    public void Restart() { hasBegun = false; }

    /// <summary>For more about the last step.</summary>
    public FtQuery Query { get { return query; } }

    public void Dispose() {
      query.Dispose();
      pose.Dispose();
    }
  }

  /// <summary>Bones that are shown, and pass through nothing. For SolidHand.</summary>
  public sealed class HandFollower : IDisposable {
    /// <summary>What the library takes in one tick: after a longer gap it begins anew.</summary>
    const double LongestTick = 10;

    readonly Skeleton tracked;
    readonly IBone[] shown;
    readonly FtSolid solid;
    readonly FtPoseBuffer pose;
    FtScene scene;

    public HandFollower(string owner, FtScene scene, Skeleton tracked, IBone[] shown, FtSolidOptions? options = null) {
      if (shown.Length != tracked.JointCount)
        throw new HostProblem(owner + " shows " + shown.Length + " transforms and " + tracked.JointCount + " joints are tracked: " +
                              "list one per joint, in the same order");
      this.scene = scene;
      this.tracked = tracked;
      this.shown = shown;
      pose = new FtPoseBuffer(tracked.JointCount);
      solid = FtSolid.Create(scene, tracked.Avatar, options);
    }

    public FtSolidTick Follow(double seconds) {
      tracked.Read(pose);
      if (!(seconds > 0)) seconds = 1e-3;  // twice in one frame
      if (seconds > LongestTick) {
        solid.Reset();
        seconds = LongestTick;
      }
      FtSolidTick tick = solid.Follow(pose, seconds);
      solid.Shown(pose);
      tracked.Write(pose, shown);
      return tick;
    }

    /// <summary>Reports the presses of the last Follow().</summary>
    public void TellPresses(Action<HandPress> tell) {
      ReadOnlySpan<FtSolidContact> contacts = solid.Contacts();
      for (int i = 0; i < contacts.Length && !solid.IsClosed; ++i)
        tell(HandPress.Of(contacts[i], tracked.Avatar, scene, tracked.Axes));
    }

    public void Reset() { solid.Reset(); }
    public void ChangeScene(FtScene to) {
      solid.ChangeScene(to);
      scene = to;
    }

    public void Dispose() {
      solid.Dispose();
      pose.Dispose();
    }
  }
}
