// ForetouchBody.cs: a skeleton, and what its links meet first between two fixed updates.
#if UNITY_5_3_OR_NEWER
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Foretouch {
  [AddComponentMenu("Foretouch/Foretouch Body")]
  [DefaultExecutionOrder(-50)]
  public sealed class ForetouchBody : ForetouchComponent {
    [Tooltip("What it touches. None: it is for SolidHand or TouchEvents alone.")]
    public ForetouchScene scene;
    [Tooltip("Parents first. Empty: this transform and all below it that have a capsule or sphere collider.")]
    public Transform[] joints = new Transform[0];
    [Tooltip("Metres, 1e-9 to 1e7: a touch is told at most so far before it happens, and never after.")]
    public double tolerance = 1e-3;

    /// <summary>Each touch of a fixed update, the earliest first.</summary>
    public event Action<BodyTouch> Touched;

    Skeleton skeleton;
    BodyStepper stepper;
    Action step;
    int sceneVersion;
    bool hadScene;

    public Skeleton Skeleton { get { return skeleton; } }
    /// <summary>The joints in the order of their numbers.</summary>
    public Transform[] Joints { get; private set; }

    /// <summary>After a teleport: what lies between is not swept through.</summary>
    public void Restart() {
      if (stepper != null) stepper.Restart();
    }

    /// What the body did while the program slept is unknown.
    void OnApplicationPause(bool isPaused) { Restart(); }

    protected override void Build() {
      Joints = joints.Length > 0 ? joints : WithColliders();
      var capsules = new List<BodyCapsule>();
      UnityHost.AddColliders(Joints, capsules);
      skeleton = new Skeleton(Owner, UnityHost.Bones(Joints), UnityHost.Parents(Joints), capsules.ToArray(), FtAxes.YUpLeft);
      if (step == null) step = Step;
    }

    Transform[] WithColliders() {
      var found = new List<Transform>();
      foreach (Transform one in GetComponentsInChildren<Transform>()) {
        if (one.GetComponents<CapsuleCollider>().Length + one.GetComponents<SphereCollider>().Length > 0) found.Add(one);
      }
      return found.ToArray();
    }

    void FixedUpdate() {
      hadScene |= scene != null;  // one that was destroyed since is reported
      if (IsReady && hadScene) Try(step);
    }

    void Step() {
      FtScene at = SceneOf(scene);
      if (stepper == null || sceneVersion != scene.Version) {
        Drop(ref stepper);
        stepper = new BodyStepper(at, skeleton, tolerance);
        sceneVersion = scene.Version;
      }
      stepper.Step(Touched);
    }

    protected override void Release() {
      hadScene = false;
      Drop(ref stepper);
      Drop(ref skeleton);
    }
  }
}
#endif
