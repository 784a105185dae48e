// SolidHand.cs: shows a tracked skeleton by transforms that pass through nothing.
#if UNITY_5_3_OR_NEWER
using System;
using UnityEngine;

namespace Foretouch {
  [AddComponentMenu("Foretouch/Solid Hand")]
  public sealed class SolidHand : ForetouchComponent {
    [Tooltip("What stops it.")]
    public ForetouchScene scene;
    [Tooltip("The skeleton that is tracked. It is not changed, so hide it.")]
    public ForetouchBody tracked;
    [Tooltip("What is shown: a transform per joint of the tracked body, in its order, in another object.")]
    public Transform[] shown = new Transform[0];

    /// <summary>Each surface that holds it back, each fixed update.</summary>
    public event Action<HandPress> Pressed;
    /// <summary>The last fixed update's tick: FtSolid.Equal, .Sliding, .Held and so on in `state`.</summary>
    public FtSolidTick Tick { get; private set; }

    HandFollower follower;
    Skeleton followed;
    Action follow;
    int sceneVersion;

    /// <summary>After a teleport, or when trackers were gone for long.</summary>
    public void Reset() {
      if (follower != null) follower.Reset();
    }

    protected override void Build() {
      FtScene at = SceneOf(scene);
      if (tracked == null || !tracked.IsReady)
        throw new HostProblem(Owner + ": its ForetouchBody is missing, disabled, or has said what is wrong");
      foreach (Transform one in shown) {
        if (one != null && Array.IndexOf(tracked.Joints, one) >= 0)
          throw new HostProblem(Owner + ": '" + one.name + "' is tracked and shown: show another object, a copy, and hide this one");
      }
      followed = tracked.Skeleton;
      follower = new HandFollower(Owner, at, followed, UnityHost.Bones(shown));
      sceneVersion = scene.Version;
      if (follow == null) follow = Follow;
    }

    void FixedUpdate() {
      if (IsReady) Try(follow);
    }

    void Follow() {
      FtScene at = SceneOf(scene);
      if (tracked == null || !tracked.IsReady)
        throw new HostProblem(Owner + ": its ForetouchBody was destroyed or disabled: enable both again");
      if (followed != tracked.Skeleton) {  // it was enabled anew
        Release();
        Build();
      }
      if (sceneVersion != scene.Version) follower.ChangeScene(at);
      sceneVersion = scene.Version;
      Tick = follower.Follow(Time.fixedDeltaTime);
      if (Pressed != null) follower.TellPresses(Pressed);
    }

    protected override void Release() { Drop(ref follower); }
  }
}
#endif
