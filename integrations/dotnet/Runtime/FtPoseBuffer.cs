// FtPoseBuffer.cs: a pose in its own memory, which the collector does not move: code that steps 90
// times per second pins nothing and makes no garbage.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  public sealed unsafe class FtPoseBuffer : FtHandle {
    readonly int joints;

    /// <summary>A pose of as many joints, each at the origin of its parent, not turned.</summary>
    public FtPoseBuffer(int jointCount) {
      if (jointCount < 1) throw new ArgumentOutOfRangeException("jointCount", "expected 1 or more, found " + jointCount);
      joints = jointCount;
      SetHandle(Marshal.AllocHGlobal(sizeof(FtPose) + 7 * sizeof(double) * jointCount));
      FtPose* pose = (FtPose*)handle;
      double* numbers = (double*)(pose + 1);
      *pose = new FtPose { size = (uint)sizeof(FtPose), jointCount = (uint)jointCount, rotations = numbers,
                           translations = numbers + 4 * jointCount };
      for (int i = 0; i < 7 * jointCount; ++i) numbers[i] = i < 4 * jointCount && i % 4 == 0 ? 1 : 0;
    }

    public FtPoseBuffer(FtAvatar avatar) : this(avatar.JointCount) { avatar.RestPose(this); }

    public int JointCount { get { return joints; } }
    /// <summary>For FtNative only, and only as long as this is held.</summary>
    public FtPose* Native {
      get {
        if (IsClosed) throw new ObjectDisposedException("FtPoseBuffer");
        return (FtPose*)handle;
      }
    }
    /// <summary>w, x, y, z per joint, in its parent's frame; roots in W.</summary>
    public Span<double> Rotations { get { return new Span<double>(Native->rotations, 4 * joints); } }
    /// <summary>x, y, z per joint, metres.</summary>
    public Span<double> Translations { get { return new Span<double>(Native->translations, 3 * joints); } }

    /// <summary>Sets one joint, in its parent's frame; a root in W.</summary>
    public void SetPosition(int joint, FtVector to) {
      Span<double> position = Translations.Slice(3 * joint, 3);
      position[0] = to.x;
      position[1] = to.y;
      position[2] = to.z;
    }
    public void SetRotation(int joint, FtRotation to) {
      Span<double> rotation = Rotations.Slice(4 * joint, 4);
      rotation[0] = to.w;
      rotation[1] = to.x;
      rotation[2] = to.y;
      rotation[3] = to.z;
    }
    public FtVector Position(int joint) {
      Span<double> at = Translations.Slice(3 * joint, 3);
      return new FtVector(at[0], at[1], at[2]);
    }
    public FtRotation Rotation(int joint) {
      Span<double> at = Rotations.Slice(4 * joint, 4);
      return new FtRotation(at[0], at[1], at[2], at[3]);
    }

    public void CopyFrom(FtPoseBuffer other) {
      other.Rotations.CopyTo(Rotations);
      other.Translations.CopyTo(Translations);
    }

    /// <summary>Takes all joints from an engine: FtAxes.YUpLeft is Unity's localRotation and
    /// localPosition.</summary>
    public void FromFloats(ReadOnlySpan<Float4> rotations, ReadOnlySpan<Float3> positions, int axes) {
      MustFit(rotations.Length, positions.Length);
      fixed (Float4* rotation = &MemoryMarshal.GetReference(rotations))
        Ft.Must(FtNative.ft_rotations_from_floats(&rotation->x, (ulong)joints, axes, Native->rotations));
      fixed (Float3* position = &MemoryMarshal.GetReference(positions))
        Ft.Must(FtNative.ft_positions_from_floats(&position->x, (ulong)joints, axes, Native->translations));
    }

    public void ToFloats(Span<Float4> rotations, Span<Float3> positions, int axes) {
      MustFit(rotations.Length, positions.Length);
      fixed (Float4* rotation = &MemoryMarshal.GetReference(rotations))
        Ft.Must(FtNative.ft_rotations_to_floats(Native->rotations, (ulong)joints, axes, &rotation->x));
      fixed (Float3* position = &MemoryMarshal.GetReference(positions))
        Ft.Must(FtNative.ft_positions_to_floats(Native->translations, (ulong)joints, axes, &position->x));
    }

    void MustFit(int rotations, int positions) {
      if (rotations != joints || positions != joints)
        throw new ArgumentException("expected " + joints + " rotations and positions, one per joint, found " + rotations +
                                    " and " + positions);
    }

    protected override bool ReleaseHandle() {
      Marshal.FreeHGlobal(handle);
      return true;
    }
  }
}
