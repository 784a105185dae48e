// Written by generator/generate.py of foretouch/events.h. Change that, not this.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtFollowOptions {
    public uint size;
    /// <summary>1 to 256, the calling one among them; default 1</summary>
    public int threads;
    /// <summary>Where time is cut. 0, the default: at every pose of any body. Else at the multiples of so
    /// many microseconds, up to 10^7: less work for many bodies with clocks of their own; what is after the
    /// last multiple waits.</summary>
    public long cutUs;
  }
  public partial struct FtEvent {
    /// <summary>a contact ends</summary>
    public const int Leave = 0;
    /// <summary>it is known again what the two do</summary>
    public const int UnresolvedTo = 1;
    /// <summary>they are in contact where they are known first</summary>
    public const int StartsInside = 2;
    /// <summary>they were free, and are in contact from here on</summary>
    public const int Enter = 3;
    /// <summary>nothing is claimed of the two from here on; a contact ends, too</summary>
    public const int UnresolvedFrom = 4;
  }
  /// <summary>Why a contact ends.</summary>
  public static partial class FtLeave {
    /// <summary>they are apart: proven</summary>
    public const int Apart = 0;
    /// <summary>they are not asked any more: one carries the other, or ft_world_ask()</summary>
    public const int NotAsked = 1;
    /// <summary>one of them, or what carries it, is put elsewhere there, with a jump</summary>
    public const int Moved = 2;
  }
  /// <summary>Two points, one of each side, that are near then.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtEventPoint {
    /// <summary>W</summary>
    public FtVector pointA;
    /// <summary>W</summary>
    public FtVector pointB;
    /// <summary>metres; below zero where the two overlap</summary>
    public double separation;
  }
  /// <summary>One thing that happens to two links, or to a link and an object of a mesh or of what is
  /// still. In FT_EVENT_UNRESOLVED_* the points are zero, links may be FT_EVERY_LINK, and b.body may be
  /// FT_EVERY_BODY: a body that is silent, and taken to be undecided.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtEvent {
    public uint size;
    public int kind;
    /// <summary>for FT_EVENT_LEAVE</summary>
    public int cause;
    /// <summary>for FT_EVENT_UNRESOLVED_*: FT_REASON_*</summary>
    public int reason;
    /// <summary>whole microseconds; begins are rounded down, ends up,</summary>
    public long timeUs;
    /// <summary>and a fraction of one more, in [0, 1)</summary>
    public double timeFraction;
    /// <summary>when what ends here began; else as the time</summary>
    public long sinceUs;
    /// <summary>as time_fraction</summary>
    public double sinceFraction;
    /// <summary>metres, then</summary>
    public double separation;
    /// <summary>metres: how deep the axis lies if it starts inside, or NaN</summary>
    public double penetration;
    /// <summary>unit, from b to a, W; zero if none is reported</summary>
    public FtVector normal;
    /// <summary>of a's material point less b's, m/s in W</summary>
    public FtVector velocity;
    /// <summary>m/s along the normal, above zero while the two approach</summary>
    public double approachSpeed;
    /// <summary>If these two points touch before the next pose of any body that they depend on, they do so
    /// at a speed between these along this normal. A lower one below zero: a graze, perhaps.</summary>
    public double approachLower;
    /// <summary>If these two points touch before the next pose of any body that they depend on, they do so
    /// at a speed between these along this normal. A lower one below zero: a graze, perhaps.</summary>
    public double approachUpper;
    /// <summary>kg along the normal; infinite if neither body was weighed</summary>
    public double effectiveMass;
    /// <summary>as ft_world_contact has them</summary>
    public FtWorldSide a;
    /// <summary>as ft_world_contact has them</summary>
    public FtWorldSide b;
    /// <summary>as ft_world_contact has it</summary>
    public int isAssumed;
    /// <summary>of `points`: 0 to 4, the nearest first</summary>
    public int pointCount;
    public FtEventPointOf4 points;
  }
  [StructLayout(LayoutKind.Sequential)]
  public struct FtEventPointOf4 {
    public FtEventPoint item0, item1, item2, item3;
    public FtEventPoint this[int index] {
      get {
        switch (index) {
          case 0: return item0;
          case 1: return item1;
          case 2: return item2;
          case 3: return item3;
          default: throw new IndexOutOfRangeException();
        }
      }
    }
  }
  /// <summary>What two do in a part of the time. Everything else is free: their separation is above zero
  /// throughout. Contact: it is at most twice the tolerance throughout.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtPart {
    public uint size;
    /// <summary>1; 0: unresolved</summary>
    public int isContact;
    /// <summary>why it is unresolved: FT_REASON_*</summary>
    public int reason;
    /// <summary>1: some of it, since it began, rests on a motion that is assumed</summary>
    public int isAssumed;
    /// <summary>1: it goes on from before the last call's time</summary>
    public int beganBefore;
    /// <summary>1: it ends where that time does</summary>
    public int goesOn;
    public long fromUs;
    public double fromFraction;
    public long toUs;
    public double toFraction;
    /// <summary>when it began: at its `from` or before</summary>
    public long sinceUs;
    public double sinceFraction;
    /// <summary>where it began; points as known then</summary>
    public FtWorldSide a;
    /// <summary>where it began; points as known then</summary>
    public FtWorldSide b;
  }
  public static partial class Ft {
    /// <summary>In an event of a body as a whole, in place of the other one: everything it is asked
    /// about.</summary>
    public const int EveryBody = -2;
  }
  public unsafe partial struct FtFollowOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtFollowOptions Usual {
      get {
        FtFollowOptions usual;
        Ft.Must(FtNative.ft_follow_options_init(&usual, (ulong)sizeof(FtFollowOptions)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtWorld {
    readonly FtBuffer<FtEvent> eventsBuffer = new FtBuffer<FtEvent>();
    /// <summary>All events of the last call, earliest first. In arrays, the first element's size applies to
    /// all. FT_ERROR_NO_STEP before the first ft_world_follow(), as for the next one. O(n).</summary>
    public ReadOnlySpan<FtEvent> Events() {
      ulong count;
      int status;
      do {
        fixed (FtEvent* first = eventsBuffer.Items) {
          first->size = (uint)sizeof(FtEvent);
          status = FtNative.ft_world_events(this, first, eventsBuffer.Capacity, out count);
        }
      } while (eventsBuffer.HasGrown(status, count));
      return eventsBuffer.First(count);
    }
    readonly FtBuffer<FtPart> partsBuffer = new FtBuffer<FtPart>();
    /// <summary>The parts of the last call's time in which two are not free, by pair, then by time.
    /// O(n).</summary>
    public ReadOnlySpan<FtPart> Parts() {
      ulong count;
      int status;
      do {
        fixed (FtPart* first = partsBuffer.Items) {
          first->size = (uint)sizeof(FtPart);
          status = FtNative.ft_world_parts(this, first, partsBuffer.Capacity, out count);
        }
      } while (partsBuffer.HasGrown(status, count));
      return partsBuffer.First(count);
    }
    readonly FtBuffer<FtPart> openPartsBuffer = new FtBuffer<FtPart>();
    /// <summary>The parts that have not ended, by pair: what is in contact now, and since when.
    /// O(n).</summary>
    public ReadOnlySpan<FtPart> OpenParts() {
      ulong count;
      int status;
      do {
        fixed (FtPart* first = openPartsBuffer.Items) {
          first->size = (uint)sizeof(FtPart);
          status = FtNative.ft_world_open_parts(this, first, openPartsBuffer.Capacity, out count);
        }
      } while (openPartsBuffer.HasGrown(status, count));
      return openPartsBuffer.First(count);
    }
  }
  public static unsafe partial class FtNative {
    [DllImport(Library)] public static extern int ft_follow_options_init(FtFollowOptions* options, ulong size);
    /// <summary>Follows the world from `from_us` on: nothing before is reported, and what is in contact
    /// there starts inside. Called again, it begins anew: weigh the bodies again then. `options` may be
    /// NULL. Errors: options or an instant out of range.</summary>
    [DllImport(Library)] public static extern int ft_world_follow_from(FtWorld world, long fromUs, FtFollowOptions* options);
    /// <summary>What a rigid body weighs, for the effective mass: `center[3]` (metres) and `inertia[9]` (kg
    /// m2, row after row, about the centre) in the body's frame. Nothing moves a body that is not weighed.
    /// FT_ERROR_NO_STEP before ft_world_follow_from(), as for all that follow. Errors: an unknown body, one
    /// of several joints, a mass that nothing can have.</summary>
    [DllImport(Library)] public static extern int ft_world_weigh(FtWorld world, int body, double kg, double* center, double* inertia);
    /// <summary>The same for an avatar that is a ragdoll: its LSS weigh `kg` in all, at one
    /// density.</summary>
    [DllImport(Library)] public static extern int ft_world_weigh_avatar(FtWorld world, int body, double kg);
    /// <summary>Finds everything that happens from where the last call ended until `until_us`; nothing if
    /// that is not later. What it reports depends on the poses alone: not on threads, the order in which
    /// poses came, or the calls, as long as each ends where time is cut (ft_world_known_until() is a pose).
    /// Errors: as ft_world_answer(), a world that asks_meshes (FT_ERROR_MISMATCH), and more than 10^7 cuts
    /// in one call; then nothing has been followed.</summary>
    [DllImport(Library)] public static extern int ft_world_follow(FtWorld world, long untilUs);
    /// <summary>Stores from where and until where the last call followed. Either may be NULL.</summary>
    [DllImport(Library)] public static extern int ft_world_followed(FtWorld world, out long fromUs, out long untilUs);
    /// <summary>All events of the last call, earliest first. In arrays, the first element's size applies to
    /// all. FT_ERROR_NO_STEP before the first ft_world_follow(), as for the next one. O(n).</summary>
    [DllImport(Library)] public static extern int ft_world_events(FtWorld world, FtEvent* events, ulong capacity, out ulong required);
    /// <summary>The parts of the last call's time in which two are not free, by pair, then by time.
    /// O(n).</summary>
    [DllImport(Library)] public static extern int ft_world_parts(FtWorld world, FtPart* parts, ulong capacity, out ulong required);
    /// <summary>The parts that have not ended, by pair: what is in contact now, and since when.
    /// O(n).</summary>
    [DllImport(Library)] public static extern int ft_world_open_parts(FtWorld world, FtPart* parts, ulong capacity, out ulong required);
  }
}
