// Skeleton.cs: an engine's bones and capsules as an avatar, and their places as its poses.
using System;
using System.Collections.Generic;

namespace Foretouch {
  /// <summary>Bones are read where they are in the world, so it does not matter what lies between two of
  /// them in the engine's tree, nor whether it is hung elsewhere.</summary>
  public sealed class Skeleton : IDisposable {
    /// <summary>By so much, of itself, may the scale of one bone differ along its axes, and from what it was.</summary>
    const float ScaleSlack = 1e-3f;

    readonly string owner;
    readonly IBone[] bones;
    readonly int[] parents;
    readonly int axes;
    readonly float[] scales;
    readonly Float3[] positions;
    readonly Float4[] rotations;
    readonly Rigid[] places;
    readonly FtPoseBuffer world;
    public readonly FtAvatar Avatar;

    /// <summary>`parents`: an earlier bone's, or -1. `owner` begins what is said about problems.</summary>
    public Skeleton(string owner, IBone[] bones, int[] parents, BodyCapsule[] capsules, int axes) {
      this.owner = owner;
      this.bones = bones;
      this.parents = parents;
      this.axes = axes;
      MustBeTree();
      scales = new float[bones.Length];
      positions = new Float3[bones.Length];
      rotations = new Float4[bones.Length];
      places = new Rigid[bones.Length];
      world = new FtPoseBuffer(bones.Length);
      for (int i = 0; i < bones.Length; ++i) scales[i] = ScaleOf(i);
      Avatar = Make(capsules);
    }

    public int JointCount { get { return bones.Length; } }
    public int Axes { get { return axes; } }

    void MustBeTree() {
      if (bones.Length == 0) throw new HostProblem(owner + " has no joints: assign the transforms of its skeleton");
      for (int i = 0; i < bones.Length; ++i) {
        MustLive(i);
        if (parents[i] >= i)
          throw new HostProblem(owner + ": joint '" + bones[i].Name + "' is listed before its parent '" +
                                bones[parents[i]].Name + "': list parents first");
      }
    }

    void MustLive(int i) {
      if (bones[i] == null || !bones[i].IsAlive)
        throw new HostProblem(owner + ": the transform of joint " + i + " is missing or was destroyed: assign it again, or take " +
                              "it out of the joints, and enable the component anew");
    }

    float ScaleOf(int i) {
      Float3 scale;
      bones[i].Read(out positions[i], out rotations[i], out scale);
      float slack = ScaleSlack * Math.Abs(scale.x);
      if (!(scale.x > 0) || !(Math.Abs(scale.y - scale.x) <= slack) || !(Math.Abs(scale.z - scale.x) <= slack))
        throw new HostProblem(owner + ": transform '" + bones[i].Name + "' has the scale " + scale + " in the world: capsules " +
                              "need one scale above zero along all axes. Set it, and those above it, to equal numbers, and scale " +
                              "the mesh in its import settings instead");
      return scale.x;
    }

    FtAvatar Make(BodyCapsule[] capsules) {
      if (capsules.Length == 0)
        throw new HostProblem(owner + " has no capsules: add a CapsuleCollider or SphereCollider to a joint, or list capsules");
      var lss = new FtLss[capsules.Length];
      var links = new int[capsules.Length];
      for (int i = 0; i < capsules.Length; ++i) {
        BodyCapsule one = capsules[i];
        if (one.joint < 0 || one.joint >= bones.Length)
          throw new HostProblem(owner + ": capsule " + i + " belongs to no joint of the list");
        if (!(one.radius > 0))
          throw new HostProblem(owner + ": capsule " + i + ", of '" + bones[one.joint].Name + "', has the radius " + one.radius +
                                ": expected one above 0");
        float scale = scales[one.joint];
        lss[i] = new FtLss(FtAxes.Position(Scaled(one.a, scale), axes), FtAxes.Position(Scaled(one.b, scale), axes),
                           FtAxes.Length(one.radius * scale, axes));
        links[i] = one.joint;
      }
      using (var rest = new FtPoseBuffer(bones.Length)) {
        Read(rest);
        return FtAvatar.Create(Names(), parents, rest.Translations, rest.Rotations, lss, links);
      }
    }

    static Float3 Scaled(Float3 v, float scale) { return new Float3(scale * v.x, scale * v.y, scale * v.z); }

    /// Engines allow one name many times; avatars do not.
    string[] Names() {
      var names = new string[bones.Length];
      var taken = new HashSet<string>();
      for (int i = 0; i < names.Length; ++i) {
        names[i] = string.IsNullOrEmpty(bones[i].Name) ? "joint" : bones[i].Name;
        if (!taken.Add(names[i])) taken.Add(names[i] += " #" + i);
      }
      return names;
    }

    /// <summary>Where the bones are now. Makes no garbage.</summary>
    public void Read(FtPoseBuffer into) {
      for (int i = 0; i < bones.Length; ++i) {
        MustLive(i);
        float scale = ScaleOf(i);
        if (!(Math.Abs(scale - scales[i]) <= 2 * ScaleSlack * scales[i]))
          throw new HostProblem(owner + ": the scale of '" + bones[i].Name + "' changed from " + scales[i] + " to " + scale +
                                " at run time: its capsules are still those of " + scales[i] + ". Disable and enable the component " +
                                "to take the new one");
      }
      world.FromFloats(rotations, positions, axes);
      for (int i = 0; i < bones.Length; ++i) {
        places[i] = At(world, i);
        Put(parents[i] < 0 ? places[i] : places[parents[i]].Local(places[i]), into, i);
      }
    }

    /// <summary>Puts bones, as many as this has, where a pose of this skeleton has them.</summary>
    public void Write(FtPoseBuffer from, IBone[] to) {
      for (int i = 0; i < bones.Length; ++i) {
        Rigid local = At(from, i);
        places[i] = parents[i] < 0 ? local : places[parents[i]].Times(local);
        Put(places[i], world, i);
      }
      world.ToFloats(rotations, positions, axes);
      for (int i = 0; i < bones.Length; ++i) {
        if (to[i] == null || !to[i].IsAlive)
          throw new HostProblem(owner + ": the transform that shows joint '" + bones[i].Name + "' is missing or was destroyed");
        to[i].Write(positions[i], rotations[i]);
      }
    }

    static Rigid At(FtPoseBuffer pose, int i) {
      return new Rigid { rotation = pose.Rotation(i), position = pose.Position(i) };
    }
    static void Put(Rigid place, FtPoseBuffer pose, int i) {
      pose.SetRotation(i, place.rotation);
      pose.SetPosition(i, place.position);
    }

    public void Dispose() {
      if (Avatar != null) Avatar.Dispose();
      world.Dispose();
    }
  }
}
