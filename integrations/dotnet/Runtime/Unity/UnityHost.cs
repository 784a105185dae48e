// UnityHost.cs: Unity's transforms and meshes, as the seam has them.
#if UNITY_5_3_OR_NEWER
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Foretouch {
  sealed class UnityBone : IBone {
    readonly Transform transform;
    readonly string name;
    internal UnityBone(Transform transform) {
      this.transform = transform;
      name = transform == null ? null : transform.name;  // asking later makes a text each time
    }
    public bool IsAlive { get { return transform != null; } }
    public string Name { get { return name; } }
    public void Read(out Float3 position, out Float4 rotation, out Float3 scale) {
      position = UnityHost.Of(transform.position);
      Quaternion turn = transform.rotation;
      rotation = new Float4(turn.x, turn.y, turn.z, turn.w);
      scale = UnityHost.Of(transform.lossyScale);
    }
    public void Write(Float3 position, Float4 rotation) {
      transform.SetPositionAndRotation(UnityHost.To(position), new Quaternion(rotation.x, rotation.y, rotation.z, rotation.w));
    }
  }

  sealed class UnityMesh : IMesh {
    readonly MeshFilter filter;
    internal UnityMesh(MeshFilter filter) { this.filter = filter; }
    public string Name { get { return filter.name; } }
    bool IsEmpty { get { return filter.sharedMesh == null; } }
    bool IsClosed { get { return !IsEmpty && !filter.sharedMesh.isReadable; } }
    public Float3[] Vertices {
      get {
        if (IsClosed) return null;
        if (IsEmpty) return new Float3[0];
        Vector3[] from = filter.sharedMesh.vertices;
        var to = new Float3[from.Length];
        for (int i = 0; i < from.Length; ++i) to[i] = UnityHost.Of(from[i]);
        return to;
      }
    }
    public int[] Triangles { get { return IsClosed ? null : IsEmpty ? new int[0] : filter.sharedMesh.triangles; } }
    public void Place(out Float3 x, out Float3 y, out Float3 z, out Float3 origin) {
      Matrix4x4 m = filter.transform.localToWorldMatrix;
      x = UnityHost.Of(m.MultiplyVector(new Vector3(1, 0, 0)));
      y = UnityHost.Of(m.MultiplyVector(new Vector3(0, 1, 0)));
      z = UnityHost.Of(m.MultiplyVector(new Vector3(0, 0, 1)));
      origin = UnityHost.Of(m.MultiplyPoint3x4(new Vector3(0, 0, 0)));
    }
  }

  /// <summary>From Unity's structs and back.</summary>
  public static class UnityHost {
    public static Float3 Of(Vector3 v) { return new Float3(v.x, v.y, v.z); }
    public static Vector3 To(Float3 v) { return new Vector3(v.x, v.y, v.z); }

    internal static IBone[] Bones(Transform[] transforms) {
      var bones = new IBone[transforms.Length];
      for (int i = 0; i < bones.Length; ++i) bones[i] = new UnityBone(transforms[i]);
      return bones;
    }

    /// For each joint, the nearest one above it in Unity's tree; -1: none.
    internal static int[] Parents(Transform[] joints) {
      var parents = new int[joints.Length];
      for (int i = 0; i < joints.Length; ++i) {
        parents[i] = -1;
        if (joints[i] == null) continue;
        for (Transform above = joints[i].parent; above != null && parents[i] < 0; above = above.parent)
          parents[i] = Array.IndexOf(joints, above);
      }
      return parents;
    }

    internal static IReadOnlyList<IMesh> Meshes(IEnumerable<MeshFilter> filters) {
      var meshes = new List<IMesh>();
      foreach (MeshFilter filter in filters) meshes.Add(new UnityMesh(filter));
      return meshes;
    }

    /// Capsule and sphere colliders that lie on joints.
    internal static void AddColliders(Transform[] joints, List<BodyCapsule> capsules) {
      for (int i = 0; i < joints.Length; ++i) {
        if (joints[i] == null) continue;
        foreach (CapsuleCollider c in joints[i].GetComponents<CapsuleCollider>())
          capsules.Add(BodyCapsule.OfHeight(i, Of(c.center), c.radius, c.height, c.direction));
        foreach (SphereCollider c in joints[i].GetComponents<SphereCollider>())
          capsules.Add(BodyCapsule.OfHeight(i, Of(c.center), c.radius, 0, 1));
      }
    }
  }
}
#endif
