// FtNumbers.cs: numbers as the library has them: metres, right-handed, +Y up; and their conversion.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  [StructLayout(LayoutKind.Sequential)]
  public struct FtVector {
    public double x, y, z;
    public FtVector(double x, double y, double z) { this.x = x; this.y = y; this.z = z; }
    public override string ToString() { return "(" + x + ", " + y + ", " + z + ")"; }
  }

  /// <summary>A unit quaternion, in the library's order.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct FtRotation {
    public double w, x, y, z;
    public FtRotation(double w, double x, double y, double z) { this.w = w; this.x = x; this.y = y; this.z = z; }
  }

  /// <summary>Row after row.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct FtMatrix {
    public double m00, m01, m02, m10, m11, m12, m20, m21, m22;
  }

  /// <summary>Three and four floats, as an engine has them: position, and quaternion x, y, z, w.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public struct Float3 {
    public float x, y, z;
    public Float3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    public override string ToString() { return "(" + x + ", " + y + ", " + z + ")"; }
  }
  [StructLayout(LayoutKind.Sequential)]
  public struct Float4 {
    public float x, y, z, w;
    public Float4(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }
  }

  /// <summary>From an engine's axes (FtAxes.YUpLeft: Unity's) and back, by the library itself.</summary>
  public static unsafe partial class FtAxes {
    public static FtVector Position(Float3 position, int axes) {
      var converted = new FtVector();
      Ft.Must(FtNative.ft_positions_from_floats(&position.x, 1, axes, &converted.x));
      return converted;
    }
    /// <summary>For a position or a velocity in W. For a unit normal, too, where axes are in metres.</summary>
    public static Float3 ToFloats(FtVector position, int axes) {
      var converted = new Float3();
      Ft.Must(FtNative.ft_positions_to_floats(&position.x, 1, axes, &converted.x));
      return converted;
    }
    public static FtRotation Rotation(Float4 xyzw, int axes) {
      var converted = new FtRotation();
      Ft.Must(FtNative.ft_rotations_from_floats(&xyzw.x, 1, axes, &converted.w));
      return converted;
    }
    /// <summary>Metres, from a length in the engine's unit.</summary>
    public static double Length(float length, int axes) { return Position(new Float3(length, 0, 0), axes).x; }
  }
}
