// TouchEvents.cs: what enters and leaves what, among bodies, props that move and what is still.
#if UNITY_5_3_OR_NEWER
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Foretouch {
  [AddComponentMenu("Foretouch/Touch Events")]
  public sealed class TouchEvents : ForetouchComponent {
    [Tooltip("What never moves. None: nothing.")]
    public ForetouchScene still;
    public ForetouchBody[] bodies = new ForetouchBody[0];
    [Tooltip("Meshes that move as their transforms do: doors, lifts, balls.")]
    public MeshFilter[] props = new MeshFilter[0];

    /// <summary>Each event once, at its own instant, in the order of time. Of `body` and `otherBody`, the
    /// bodies come first, then the props, in the order of the lists above.</summary>
    public event Action<TouchEvent> Happened;

    EventTeller teller;
    Action tick;
    Action<TouchEvent> tell;
    readonly List<FtScene> meshes = new List<FtScene>();
    readonly List<Skeleton> followed = new List<Skeleton>();
    bool hasStill;
    int stillVersion;

    protected override void Build() {
      hasStill = still != null;
      teller = new EventTeller(Owner, hasStill ? SceneOf(still) : FtScene.None, FtAxes.YUpLeft);
      stillVersion = hasStill ? still.Version : 0;
      foreach (ForetouchBody body in bodies) {
        followed.Add(SkeletonOf(body));
        teller.AddBody(followed[followed.Count - 1]);
      }
      foreach (MeshFilter prop in props) {
        if (prop == null) throw new HostProblem(Owner + ": a prop is missing or was destroyed: take it out of the list");
        meshes.Add(SceneMaker.Make(Owner, UnityHost.Meshes(new[] { prop }), FtAxes.YUpLeft, Warn, false));
        teller.AddProp(meshes[meshes.Count - 1], new UnityBone(prop.transform));
      }
      if (tick == null) tick = TellAll;
      if (tell == null) tell = Tell;
    }

    Skeleton SkeletonOf(ForetouchBody body) {
      if (body == null || !body.IsReady)
        throw new HostProblem(Owner + ": a ForetouchBody is missing, was destroyed or disabled, or has said what is wrong");
      return body.Skeleton;
    }

    void Warn(string message) { Debug.LogWarning(message, this); }

    void FixedUpdate() {
      if (IsReady) Try(tick);
    }

    void TellAll() {
      bool isAnew = false;  // what it follows was: so is this, and what is in contact then starts inside
      if (hasStill) SceneOf(still);
      if (hasStill && still.Version != stillVersion) isAnew = true;
      for (int i = 0; i < bodies.Length; ++i) isAnew |= SkeletonOf(bodies[i]) != followed[i];
      if (isAnew) {
        Release();
        Build();
      }
      teller.Tick(Time.fixedDeltaTime, tell);
    }

    /// What happened while the program slept is unknown: it begins anew.
    void OnApplicationPause(bool isPaused) { OnDisable(); }

    void Tell(TouchEvent happened) {
      if (Happened != null) Happened(happened);
    }

    protected override void Release() {
      Drop(ref teller);
      foreach (FtScene mesh in meshes) mesh.Dispose();
      meshes.Clear();
      followed.Clear();
    }
  }
}
#endif
