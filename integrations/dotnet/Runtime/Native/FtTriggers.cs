// Written by generator/generate.py of foretouch/triggers.h. Change that, not this.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  /// <summary>A trigger is a body of the world: it is there from its first pose on, may move, and may be
  /// carried (ft_world_push(), ft_world_attach()). Its events come with those of
  /// ft_world_follow().</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtTriggerOptions {
    public uint size;
    /// <summary>default 31. Triggers of one group do not meet each other, nor the scene</summary>
    public int group;
    /// <summary>default FT_SILENT_HOLD_STILL</summary>
    public int whenSilent;
    /// <summary>0, the default: a body is inside while any of its links is. 1: each link enters and leaves
    /// by itself</summary>
    public int byLink;
  }
  /// <summary>A body is inside if a point of its volume is in the trigger's: also if it passes through
  /// between two poses, and if all of it is inside. Sound: no body is inside, at any instant, unless it
  /// is reported to be, or to be unresolved. Tight: one reported to be is, but for twice the
  /// tolerance.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtTriggerEvent {
    public uint size;
    /// <summary>FT_EVENT_*</summary>
    public int kind;
    public int trigger;
    public int body;
    /// <summary>the one that enters or leaves; or FT_EVERY_LINK</summary>
    public int link;
    /// <summary>as ft_world_contact has it</summary>
    public int isAssumed;
    public long timeUs;
    public double timeFraction;
    /// <summary>when what ends here began; else as the time</summary>
    public long sinceUs;
    public double sinceFraction;
  }
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtOccupant {
    public uint size;
    public int trigger;
    public int body;
    /// <summary>FT_EVERY_LINK, unless the trigger looks at each link by itself</summary>
    public int link;
    /// <summary>1: nothing is known of whether it is inside</summary>
    public int isUnresolved;
    /// <summary>0</summary>
    public int reserved;
    public long sinceUs;
    public double sinceFraction;
  }
  /// <summary>What is moved, and out of what.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtDepthQuestion {
    public uint size;
    /// <summary>the one that is moved</summary>
    public int body;
    /// <summary>or FT_EVERY_LINK</summary>
    public int link;
    /// <summary>or FT_STILL_SCENE</summary>
    public int fromBody;
    /// <summary>or FT_EVERY_LINK</summary>
    public int fromLink;
    /// <summary>0</summary>
    public int reserved;
    public long timeUs;
    /// <summary>in [0, 1)</summary>
    public double timeFraction;
  }
  /// <summary>No translation shorter than `lower` clears the body; moved by `way_out` it is proven clear,
  /// and that is not longer than `upper`. Two that are apart: all zero, and certified.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtDepth {
    public uint size;
    /// <summary>0: no way out could be certified; then `upper` is infinite</summary>
    public int isCertified;
    /// <summary>metres</summary>
    public double lower;
    /// <summary>metres</summary>
    public double upper;
    /// <summary>W</summary>
    public FtVector wayOut;
    /// <summary>of pieces that have, or may have, a point in common</summary>
    public int pairCount;
    /// <summary>as ft_world_contact has it</summary>
    public int isAssumed;
    /// <summary>of the deepest pair; -1: none</summary>
    public int link;
    /// <summary>of the deepest pair; -1: none</summary>
    public int lss;
    /// <summary>the other side of that pair; -1: none</summary>
    public int fromLink;
    /// <summary>the other side of that pair; -1: none</summary>
    public int fromLss;
    /// <summary>the other side of that pair; -1: none</summary>
    public int fromTriangle;
    /// <summary>0</summary>
    public int reserved;
  }
  public unsafe partial struct FtTriggerOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtTriggerOptions Usual {
      get {
        FtTriggerOptions usual;
        Ft.Must(FtNative.ft_trigger_options_init(&usual, (ulong)sizeof(FtTriggerOptions)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtWorld {
    readonly FtBuffer<FtTriggerEvent> triggerEventsBuffer = new FtBuffer<FtTriggerEvent>();
    /// <summary>The last ft_world_follow()'s, earliest first; at one instant what ends before what begins.
    /// In arrays, the first element's size applies to all. FT_ERROR_NO_STEP before it. O(n).</summary>
    public ReadOnlySpan<FtTriggerEvent> TriggerEvents() {
      ulong count;
      int status;
      do {
        fixed (FtTriggerEvent* first = triggerEventsBuffer.Items) {
          first->size = (uint)sizeof(FtTriggerEvent);
          status = FtNative.ft_world_trigger_events(this, first, triggerEventsBuffer.Capacity, out count);
        }
      } while (triggerEventsBuffer.HasGrown(status, count));
      return triggerEventsBuffer.First(count);
    }
    readonly FtBuffer<FtOccupant> occupantsBuffer = new FtBuffer<FtOccupant>();
    /// <summary>What is inside, or may be, where the last ft_world_follow() ended: by trigger, body and
    /// link.</summary>
    public ReadOnlySpan<FtOccupant> Occupants() {
      ulong count;
      int status;
      do {
        fixed (FtOccupant* first = occupantsBuffer.Items) {
          first->size = (uint)sizeof(FtOccupant);
          status = FtNative.ft_world_occupants(this, first, occupantsBuffer.Capacity, out count);
        }
      } while (occupantsBuffer.HasGrown(status, count));
      return occupantsBuffer.First(count);
    }
  }
  public static unsafe partial class FtNative {
    [DllImport(Library)] public static extern int ft_trigger_options_init(FtTriggerOptions* options, ulong size);
    /// <summary>Around the origin of the trigger's frame, along its axes. Stores the trigger's number, 0,
    /// 1, 2, ..., in *trigger and that of its body in *body; either may be NULL, and so may `options`.
    /// Errors: an extent that is not above 0 and within 10^7 m, options out of range, too many bodies; for
    /// a mesh also (FT_ERROR_MISMATCH) an open edge, with its object, its ends and a triangle of
    /// it.</summary>
    [DllImport(Library)] public static extern int ft_world_add_trigger_box(FtWorld world, double* halfExtents, FtTriggerOptions* options, out int trigger, out int body);
    [DllImport(Library)] public static extern int ft_world_add_trigger_sphere(FtWorld world, double radius, FtTriggerOptions* options, out int trigger, out int body);
    /// <summary>What is inside some object of a mesh. Each object is closed: every edge, by exact
    /// coordinates, belongs to an even number of the object's triangles, turned any way.</summary>
    [DllImport(Library)] public static extern int ft_world_add_trigger_mesh(FtWorld world, FtScene closed, FtTriggerOptions* options, out int trigger, out int body);
    /// <summary>Looks at this body, or at this link of it, instead of at all bodies; called again, at
    /// several. `link` may be FT_EVERY_LINK. Before the trigger's first ft_world_follow().</summary>
    [DllImport(Library)] public static extern int ft_world_watch(FtWorld world, int trigger, int body, int link);
    /// <summary>Puts a trigger that has no pose where it stays, from an instant on: known for eleven days,
    /// and then as `when_silent` says. The one joint of `pose` is the trigger's.</summary>
    [DllImport(Library)] public static extern int ft_world_stand_trigger(FtWorld world, int trigger, long fromUs, FtPose* pose);
    /// <summary>The last ft_world_follow()'s, earliest first; at one instant what ends before what begins.
    /// In arrays, the first element's size applies to all. FT_ERROR_NO_STEP before it. O(n).</summary>
    [DllImport(Library)] public static extern int ft_world_trigger_events(FtWorld world, FtTriggerEvent* events, ulong capacity, out ulong required);
    /// <summary>What is inside, or may be, where the last ft_world_follow() ended: by trigger, body and
    /// link.</summary>
    [DllImport(Library)] public static extern int ft_world_occupants(FtWorld world, FtOccupant* occupants, ulong capacity, out ulong required);
    /// <summary>The depth at an instant, of bodies where they are then. One of two must be made of LSS.
    /// Errors: unknown bodies and links, two links that are one, a body that is not there or silent
    /// then.</summary>
    [DllImport(Library)] public static extern int ft_world_depth(FtWorld world, FtDepthQuestion* question, FtDepth* depth);
  }
}
