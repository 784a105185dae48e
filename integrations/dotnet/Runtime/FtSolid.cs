// FtSolid.cs: tracked poses in, shown poses out; what is shown passes through nothing.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  /// <summary>For one thread at a time. What it returns stays as it is until the same is asked again.</summary>
  public sealed unsafe partial class FtSolid {
    public static FtSolid Create(FtScene scene, FtAvatar avatar, FtSolidOptions? options = null) {
      Ft.CheckLibrary();
      var given = options.GetValueOrDefault();
      FtSolid solid;
      Ft.Must(FtNative.ft_solid_create(scene, avatar, options.HasValue ? &given : null, out solid));
      return solid;
    }

    /// <summary>One tick, to where the joints are tracked. `isTracked`: 0 per joint whose tracker is lost;
    /// empty: none is.</summary>
    public FtSolidTick Follow(FtPoseBuffer tracked, double seconds,
                              ReadOnlySpan<byte> isTracked = default(ReadOnlySpan<byte>)) {
      if (isTracked.Length != 0 && isTracked.Length != tracked.JointCount)
        throw new ArgumentException("isTracked: expected one per joint, " + tracked.JointCount + ", found " + isTracked.Length);
      var tick = new FtSolidTick { size = (uint)sizeof(FtSolidTick) };
      fixed (byte* flags = &MemoryMarshal.GetReference(isTracked))
        Ft.Must(FtNative.ft_solid_follow(this, tracked.Native, isTracked.Length == 0 ? null : flags, seconds, &tick));
      GC.KeepAlive(tracked);
      return tick;
    }

    /// <summary>The pose that piece `index` of the last tick's way ends with, and when in (0, 1] of it.</summary>
    public double Way(int index, FtPoseBuffer into) {
      double time;
      ulong count;
      Ft.Must(FtNative.ft_solid_way(this, (ulong)index, &time, into.Native->rotations, into.Native->translations,
                                    (ulong)into.JointCount, out count));
      GC.KeepAlive(into);
      return time;
    }

    /// <summary>A teleport, or trackers were gone for long: the next pose is the first again.</summary>
    public void Reset() { Ft.Must(FtNative.ft_solid_reset(this)); }
    public void ResetAt(FtPoseBuffer place) {
      Ft.Must(FtNative.ft_solid_reset_at(this, place.Native));
      GC.KeepAlive(place);
    }
    public void ChangeScene(FtScene scene) { Ft.Must(FtNative.ft_solid_change_scene(this, scene)); }
  }
}
