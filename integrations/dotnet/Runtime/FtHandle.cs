// FtHandle.cs: what the library makes and releases; and memory that answers are read into.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  /// <summary>A handle of the library. Dispose() releases it; a forgotten one is released when it is
  /// collected, or when its domain is unloaded, as Unity's editor does. Used after Dispose(), it throws
  /// ObjectDisposedException.</summary>
  public abstract class FtHandle : SafeHandle {
    protected FtHandle() : base(IntPtr.Zero, true) {}
    public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
  }

  /// <summary>Answers of one kind, in memory that grows and is kept: reading them makes no garbage.</summary>
  sealed class FtBuffer<T> where T : struct {
    internal T[] Items = new T[1];
    internal ulong Capacity { get { return (ulong)Items.Length; } }
    /// <summary>Did the array have too little room? Then it has enough now. Throws other errors.</summary>
    internal bool HasGrown(int status, ulong required) {
      if (status != FtStatus.ErrorBufferTooSmall) {
        Ft.Must(status);
        return false;
      }
      Items = new T[checked((int)Math.Max(required, 2 * Capacity))];
      return true;
    }
    internal ReadOnlySpan<T> First(ulong count) { return new ReadOnlySpan<T>(Items, 0, (int)count); }
  }
}
