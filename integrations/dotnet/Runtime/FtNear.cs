// FtNear.cs: what a body is near to at one pose.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  public sealed unsafe partial class FtNear {
    public static FtNear Create(FtScene scene, FtAvatar avatar, FtNearOptions? options = null) {
      Ft.CheckLibrary();
      var given = options.GetValueOrDefault();
      FtNear near;
      Ft.Must(FtNative.ft_near_create(scene, avatar, options.HasValue ? &given : null, out near));
      return near;
    }

    /// <summary>`reach`: metres, one per link; below 0: not asked. Features() and Ranges() have the answer.</summary>
    public void Ask(FtPoseBuffer pose, ReadOnlySpan<double> reach) {
      fixed (double* first = &MemoryMarshal.GetReference(reach))
        Ft.Must(FtNative.ft_near_ask(this, pose.Native, first, (ulong)reach.Length));
      GC.KeepAlive(pose);
    }
  }
}
