// SceneMaker.cs: an engine's meshes as one scene, each an object of its own.
using System;
using System.Collections.Generic;

namespace Foretouch {
  public static class SceneMaker {
    /// <summary>Meshes as they stand now. `warn` hears of those that have nothing to touch; they are left out.
    /// For a prop that moves, `isWorld` is false: then it is in its own frame, with its scale.</summary>
    public static FtScene Make(string owner, IReadOnlyList<IMesh> meshes, int axes, Action<string> warn, bool isWorld = true) {
      var positions = new List<double>();
      var indices = new List<int>();
      var objects = new List<int>();
      var names = new List<string>();
      foreach (IMesh mesh in meshes) Add(owner, mesh, axes, warn, isWorld, positions, indices, objects, names);
      if (indices.Count == 0)
        throw new HostProblem(owner + " has no triangles: put objects with meshes below it");
      return FtScene.Create(positions.ToArray(), indices.ToArray(), objects.ToArray(), names.ToArray());
    }

    static void Add(string owner, IMesh mesh, int axes, Action<string> warn, bool isWorld,
                    List<double> positions, List<int> indices, List<int> objects, List<string> names) {
      Float3[] vertices = mesh.Vertices;
      int[] triangles = mesh.Triangles;
      if (vertices == null || triangles == null)
        throw new HostProblem(owner + ": the mesh of '" + mesh.Name + "' cannot be read by scripts, so it would be a hole: tick " +
                              "Read/Write in its import settings");
      if (vertices.Length == 0 || triangles.Length == 0) {
        warn(owner + ": the mesh of '" + mesh.Name + "' has no " + (vertices.Length == 0 ? "vertices" : "triangles") +
             ": nothing touches it");
        return;
      }
      foreach (int index in triangles) {
        if (index < 0 || index >= vertices.Length)
          throw new HostProblem(owner + ": the mesh of '" + mesh.Name + "' names vertex " + index + " and has " + vertices.Length);
        indices.Add(positions.Count / 3 + index);
      }
      for (int i = 0; i < triangles.Length / 3; ++i) objects.Add(names.Count);
      AddVertices(vertices, Place(owner, mesh, isWorld), axes, positions);
      names.Add(mesh.Name);
    }

    /// Axes are linear: converted before they are multiplied, they cost no rounding.
    static void AddVertices(Float3[] vertices, Float3[] place, int axes, List<double> positions) {
      FtVector x = FtAxes.Position(place[0], axes), y = FtAxes.Position(place[1], axes), z = FtAxes.Position(place[2], axes),
               origin = FtAxes.Position(place[3], axes);
      foreach (Float3 v in vertices) {
        positions.Add(v.x * x.x + v.y * y.x + v.z * z.x + origin.x);
        positions.Add(v.x * x.y + v.y * y.y + v.z * z.y + origin.y);
        positions.Add(v.x * x.z + v.y * y.z + v.z * z.z + origin.z);
      }
    }

    /// Where the axes and the origin of a mesh go. In its own frame, they keep their lengths alone: the rest
    /// of its place comes with poses, which can neither mirror nor skew.
    static Float3[] Place(string owner, IMesh mesh, bool isWorld) {
      Float3 x, y, z, origin;
      mesh.Place(out x, out y, out z, out origin);
      if (isWorld) return new[] { x, y, z, origin };
      float a = Length(x), b = Length(y), c = Length(z);
      double volume = x.x * ((double)y.y * z.z - (double)y.z * z.y) + x.y * ((double)y.z * z.x - (double)y.x * z.z) +
                      x.z * ((double)y.x * z.y - (double)y.y * z.x);
      if (!(volume > 0.999 * a * b * c))
        throw new HostProblem(owner + ": the prop '" + mesh.Name + "' is mirrored, flat or skewed by the scales above it, and it " +
                              "moves: make those scales equal along all axes and above zero");
      return new[] { new Float3(a, 0, 0), new Float3(0, b, 0), new Float3(0, 0, c), new Float3(0, 0, 0) };
    }

    static float Length(Float3 v) { return (float)Math.Sqrt((double)v.x * v.x + (double)v.y * v.y + (double)v.z * v.z); }
  }
}
