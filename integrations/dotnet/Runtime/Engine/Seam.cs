// Seam.cs: all that Foretouch asks of an engine: bones that have a place, and meshes. With these two
// implemented it has bodies, solid hands and events; for Unity, Runtime/Unity does so.
using System;

namespace Foretouch {
  /// <summary>One transform of a skeleton, or of a prop that moves.</summary>
  public interface IBone {
    /// <summary>False once its object was destroyed.</summary>
    bool IsAlive { get; }
    string Name { get; }
    /// <summary>In the world, in the engine's own axes; the scale in its world, too.</summary>
    void Read(out Float3 position, out Float4 rotation, out Float3 scale);
    void Write(Float3 position, Float4 rotation);
  }

  /// <summary>A mesh, where it stands.</summary>
  public interface IMesh {
    string Name { get; }
    /// <summary>In the mesh's own frame; three indices per triangle. Null: the engine keeps them from scripts.</summary>
    Float3[] Vertices { get; }
    int[] Triangles { get; }
    /// <summary>From that frame to the world's: where the three axes and the origin go.</summary>
    void Place(out Float3 x, out Float3 y, out Float3 z, out Float3 origin);
  }

  /// <summary>A capsule that moves with a joint, in the joint's frame before its scale.</summary>
  public struct BodyCapsule {
    public int joint;
    public Float3 a, b;
    public float radius;

    /// <summary>Of an engine's capsule: its whole height, along x (0), y (1) or z (2).</summary>
    public static BodyCapsule OfHeight(int joint, Float3 center, float radius, float height, int direction) {
      float half = Math.Max(0, 0.5f * height - radius);
      var axis = new Float3(direction == 0 ? half : 0, direction == 1 ? half : 0, direction == 2 ? half : 0);
      return new BodyCapsule {
        joint = joint, radius = radius, a = new Float3(center.x - axis.x, center.y - axis.y, center.z - axis.z),
        b = new Float3(center.x + axis.x, center.y + axis.y, center.z + axis.z)
      };
    }
  }

  /// <summary>What is wrong with what the engine gave, in the engine's words. Nothing is claimed until it is
  /// mended.</summary>
  public sealed class HostProblem : Exception {
    public HostProblem(string message) : base(message) {}
  }
}
