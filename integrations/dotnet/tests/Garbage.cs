// Garbage.cs: no step makes garbage: 100,000 of each kind, and the bytes that this thread allocated.
using System;
using Foretouch;
using UnityEngine;

static class Garbage {
  const int Steps = 100000;

  static long told;
  static readonly Action<BodyTouch> TellTouch = touch => ++told;
  static readonly Action<HandPress> TellPress = press => ++told;
  static readonly Action<TouchEvent> TellEvent = happened => ++told;

  /// Bytes per `steps` calls, after a tenth as many have grown what grows.
  static void Measure(string what, int steps, Action<int> step, bool isClean = true) {
    for (int i = 0; i < steps / 10; ++i) step(i);
    GC.Collect();
    long before = GC.GetAllocatedBytesForCurrentThread();
    int collections = GC.CollectionCount(0);
    told = 0;
    for (int i = 0; i < steps; ++i) step(i);
    long bytes = GC.GetAllocatedBytesForCurrentThread() - before;
    collections = GC.CollectionCount(0) - collections;
    Console.WriteLine("{0,-34} {1,7} steps {2,9} bytes {3,3} collections {4,8} told", what, steps, bytes, collections, told);
    Check.Equal(bytes == 0 && collections == 0, isClean, what);
    if (isClean) Check.That(told > steps / 100, what + " tells something");
  }

  static FtScene Floor() {
    return FtScene.Create(new double[] { -9, 0, -9, 9, 0, -9, 9, 0, 9, -9, 0, 9 }, new[] { 0, 1, 2, 0, 2, 3 });
  }

  // Five links that dip into the floor and out of it.
  static Transform[] Arm() {
    var joints = new Transform[5];
    for (int i = 0; i < joints.Length; ++i) {
      joints[i] = new Transform("joint " + i, i == 0 ? null : joints[i - 1]) { localPosition = new Vector3(0.2f, 0, 0) };
      joints[i].AddComponent<SphereCollider>().radius = 0.05f;
    }
    return joints;
  }
  static float Height(int i) { return 0.1f * Math.Abs(i % 40 - 20) / 20; }

  static IBone[] BonesOf(Transform[] joints) {
    var bones = new IBone[joints.Length];
    for (int i = 0; i < bones.Length; ++i) bones[i] = new Bone(joints[i]);
    return bones;
  }

  sealed class Bone : IBone {
    readonly Transform transform;
    internal Bone(Transform transform) { this.transform = transform; }
    public bool IsAlive { get { return true; } }
    public string Name { get { return transform.name; } }
    public void Read(out Float3 position, out Float4 rotation, out Float3 scale) {
      position = UnityHost.Of(transform.position);
      Quaternion turn = transform.rotation;
      rotation = new Float4(turn.x, turn.y, turn.z, turn.w);
      scale = UnityHost.Of(transform.lossyScale);
    }
    public void Write(Float3 position, Float4 rotation) {}
  }

  static Skeleton SkeletonOf(Transform[] joints) {
    var capsules = new BodyCapsule[joints.Length];
    var parents = new int[joints.Length];
    for (int i = 0; i < joints.Length; ++i) {
      capsules[i] = new BodyCapsule { joint = i, radius = 0.05f };
      parents[i] = i - 1;
    }
    return new Skeleton("arm", BonesOf(joints), parents, capsules, FtAxes.YUpLeft);
  }

  static int Main() {
    Transform[] joints = Arm();
    using (FtScene floor = Floor())
    using (Skeleton skeleton = SkeletonOf(joints))
    using (FtQuery query = FtQuery.Create(floor, skeleton.Avatar))
    using (var pose = new FtPoseBuffer(skeleton.Avatar))
    using (var stepper = new BodyStepper(floor, skeleton, 1e-3))
    using (var hand = new HandFollower("hand", floor, skeleton, BonesOf(joints)))
    using (var teller = new EventTeller("events", floor, FtAxes.YUpLeft)) {
      teller.AddBody(skeleton);
      query.Begin(pose);
      Action<int> move = i => {
        joints[0].localPosition = new Vector3(0, Height(i), 0);
      };
      Measure("a control, which allocates", Steps, i => told += new object().GetHashCode() & 1, false);
      Measure("FtQuery.Step and Contacts", Steps, i => {
        pose.SetPosition(0, new FtVector(0, Height(i), 0));
        query.Step(pose);
        told += query.Contacts().Length;
      });
      Measure("BodyStepper (ForetouchBody)", Steps, i => {
        move(i);
        stepper.Step(TellTouch);
      });
      Measure("HandFollower (SolidHand)", Steps, i => {
        move(i);
        hand.Follow(0.02);
        hand.TellPresses(TellPress);
      });
      Measure("EventTeller (TouchEvents)", Steps, i => {
        move(i);
        teller.Tick(0.02, TellEvent);
      });
    }
    return Check.Done("garbage");
  }
}
