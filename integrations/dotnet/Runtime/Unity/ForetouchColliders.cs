// ForetouchColliders.cs: an avatar's capsules as Unity's colliders, from the file that
// `foretouch avatar colliders BODY.json -o FILE.json` writes (docs/colliders.md).
#if UNITY_5_3_OR_NEWER
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Foretouch {
  public static class ForetouchColliders {
    // What JsonUtility fills.
    [Serializable]
    sealed class Colliders {
      public string format = "";
      public int version = 0;
      public One[] colliders = new One[0];
    }
    [Serializable]
    sealed class One {
      public string joint = "";
      public Vector3 center = new Vector3(0, 0, 0);
      public Quaternion rotation = new Quaternion(0, 0, 0, 1);
      public float radius = 0, height = 0;
    }

    /// <summary>Puts a child with a collider below each transform that the file names, at or below `skeleton`, and
    /// returns these children. Nothing is added where a name is not there. Call it once: it does not look for
    /// colliders that are there already.</summary>
    public static Transform[] Add(Transform skeleton, string json) {
      var file = JsonUtility.FromJson<Colliders>(json);
      if (file == null || file.format != "foretouch-unity-colliders" || file.version != 1)
        throw new HostProblem("expected a file of foretouch avatar colliders -o FILE.json, format foretouch-unity-colliders 1");
      var named = new Dictionary<string, Transform>();
      foreach (Transform one in skeleton.GetComponentsInChildren<Transform>())
        if (!named.ContainsKey(one.name)) named.Add(one.name, one);  // the nearest to the root
      foreach (One one in file.colliders)
        if (!named.ContainsKey(one.joint))
          throw new HostProblem("'" + skeleton.name + "' has no transform called '" + one.joint + "', of which the file has a collider");
      var added = new Transform[file.colliders.Length];
      for (int i = 0; i < added.Length; ++i) added[i] = Place(named[file.colliders[i].joint], file.colliders[i]);
      return added;
    }

    static Transform Place(Transform joint, One one) {
      var made = new GameObject(joint.name + " collider");
      Transform place = made.transform;
      place.SetParent(joint, false);
      place.localPosition = one.center;
      place.localRotation = one.rotation;
      if (one.height > 2 * one.radius) {
        var capsule = made.AddComponent<CapsuleCollider>();
        capsule.direction = 1;  // along y
        capsule.radius = one.radius;
        capsule.height = one.height;
      } else {
        made.AddComponent<SphereCollider>().radius = one.radius;
      }
      return place;
    }
  }
}
#endif
