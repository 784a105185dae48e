// EventTeller.cs: bodies and props that move, and which enters and leaves which. For TouchEvents.
using System;
using System.Collections.Generic;

namespace Foretouch {
  public sealed class EventTeller : IDisposable {
    readonly FtScene still;
    readonly FtWorld world;
    readonly int axes;
    readonly string owner;
    readonly List<Skeleton> skeletons = new List<Skeleton>();
    readonly List<FtPoseBuffer> poses = new List<FtPoseBuffer>();
    readonly List<FtScene> props = new List<FtScene>();
    bool hasBegun;
    long us;

    /// <summary>`still`: FtScene.None, or what never moves.</summary>
    public EventTeller(string owner, FtScene still, int axes) {
      this.owner = owner;
      this.still = still;
      this.axes = axes;
      world = FtWorld.Create(still);
    }

    public FtWorld World { get { return world; } }

    public int AddBody(Skeleton skeleton) {
      int body = world.AddAvatar(skeleton.Avatar);
      Follow(skeleton, null);
      return body;
    }

    /// <summary>A mesh that moves with a bone; in its own frame, as SceneMaker has it with isWorld false.</summary>
    public int AddProp(FtScene mesh, IBone bone) {
      int body = world.AddMesh(mesh);
      // A skeleton of one, whose capsule does not count.
      var capsule = new BodyCapsule { joint = 0, radius = 1 };
      Follow(new Skeleton(owner, new IBone[] { new Unscaled(owner, bone) }, new[] { -1 }, new[] { capsule }, axes), mesh);
      return body;
    }

    void Follow(Skeleton skeleton, FtScene mesh) {
      if (hasBegun) throw new HostProblem(owner + ": bodies and props are added before the first update");
      skeletons.Add(skeleton);
      props.Add(mesh);
      poses.Add(new FtPoseBuffer(skeleton.JointCount));
    }

    /// <summary>All that happened since the last call, `seconds` ago, in the order of time. The first call
    /// only begins.</summary>
    public void Tick(double seconds, Action<TouchEvent> tell) {
      if (hasBegun) us += Math.Max(1, (long)Math.Round(1e6 * seconds));
      for (int i = 0; i < skeletons.Count; ++i) skeletons[i].Read(poses[i]);
      for (int i = 0; i < skeletons.Count; ++i) world.Push(i, us, poses[i]);
      if (!hasBegun) {
        world.FollowFrom(us);
        hasBegun = true;
        return;
      }
      world.Follow(us);
      ReadOnlySpan<FtEvent> events = world.Events();
      for (int i = 0; i < events.Length && !world.IsClosed; ++i) tell(Told(events[i]));
      if (!world.IsClosed) world.ForgetBefore(us);
    }

    TouchEvent Told(FtEvent e) {
      return new TouchEvent {
        kind = e.kind, time = 1e-6 * (e.timeUs + e.timeFraction), body = e.a.body, otherBody = e.b.body, jointName = NameOf(e.a),
        otherName = NameOf(e.b), point = FtAxes.ToFloats(e.b.point, axes), normal = FtAxes.ToFloats(e.normal, axes),
        approachSpeed = e.approachSpeed
      };
    }

    string NameOf(FtWorldSide side) {
      if (side.body == Ft.StillScene) return side.@object < 0 ? null : still.ObjectName(side.@object);
      if (side.body < 0) return null;
      if (props[side.body] != null) return side.@object < 0 ? null : props[side.body].ObjectName(side.@object);
      return side.link < 0 ? null : skeletons[side.body].Avatar.JointName(side.link);
    }

    public void Dispose() {
      world.Dispose();
      for (int i = 0; i < poses.Count; ++i) {
        poses[i].Dispose();
        if (props[i] != null) skeletons[i].Dispose();
      }
    }

    /// A prop's scale is in its mesh already, and need not be the same along all axes; but it stays.
    sealed class Unscaled : IBone {
      readonly string owner;
      readonly IBone bone;
      readonly Float3 scale;
      internal Unscaled(string owner, IBone bone) {
        Float3 position;
        Float4 rotation;
        this.owner = owner;
        this.bone = bone;
        bone.Read(out position, out rotation, out scale);
      }
      public bool IsAlive { get { return bone.IsAlive; } }
      public string Name { get { return bone.Name; } }
      public void Read(out Float3 position, out Float4 rotation, out Float3 one) {
        bone.Read(out position, out rotation, out one);
        if (Differs(one.x, scale.x) || Differs(one.y, scale.y) || Differs(one.z, scale.z))
          throw new HostProblem(owner + ": the scale of the prop '" + bone.Name + "' changed from " + scale + " to " + one +
                                " at run time: disable and enable the component to take the new one");
        one = new Float3(1, 1, 1);
      }
      static bool Differs(float a, float b) { return !(Math.Abs(a - b) <= 2e-3f * Math.Abs(b)); }
      public void Write(Float3 position, Float4 rotation) { bone.Write(position, rotation); }
    }
  }
}
