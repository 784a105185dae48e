// Written by generator/generate.py of foretouch/solid_world.h. Change that, not this.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  /// <summary>How far solid avatars reach in all that the world is asked and reports.</summary>
  public static partial class FtSolidReach {
    /// <summary>To their surface: they are found to touch nothing but what crushes them.</summary>
    public const int Skin = 0;
    public const int Surface = 1;
  }
  /// <summary>Where the tracker says that a solid avatar is at the end of a tick.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtSolidTarget {
    public int body;
    /// <summary>0</summary>
    public int reserved;
    public FtPose* pose;
    /// <summary>as of ft_solid_follow(); may be NULL</summary>
    public byte* isTracked;
  }
  /// <summary>A moving body that holds or pushes a solid avatar.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtSolidBodyContact {
    public uint size;
    public int body;
    /// <summary>the avatar's</summary>
    public int link;
    /// <summary>of the link; those of tools in its hand come after its own</summary>
    public int lss;
    /// <summary>of a mesh; -1: none</summary>
    public int triangle;
    /// <summary>the triangle's; -1: none</summary>
    public int @object;
    /// <summary>on the body's surface, W</summary>
    public FtVector point;
    /// <summary>unit, from it to the avatar, W</summary>
    public FtVector normal;
    public double gap;
    /// <summary>as ft_solid_contact.push; what the body's own motion adds is in it</summary>
    public double push;
    /// <summary>of the link's point along that surface, which moves, m/s</summary>
    public double slipSpeed;
  }
  /// <summary>A body that nothing holds back has left the avatar no proven way: between the two nothing
  /// is claimed from `since_us` on. Everything else stays proven.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtSolidCrush {
    public uint size;
    public int body;
    /// <summary>where it was met; while they overlap, the link that is deepest</summary>
    public int link;
    /// <summary>1: it ended at the tick's begin, where the two are proven apart, or where the body is no
    /// longer asked about (silent: is_assumed); reported once.</summary>
    public int isOver;
    public long sinceUs;
    /// <summary>At the tick's end: the largest depth of a link's axis below the body's surface, its radius
    /// at most. To part them takes at least as much. 0: they do not overlap there.</summary>
    public double depth;
  }
  public static partial class FtSolidHolds {
    /// <summary>solid with it</summary>
    public const int Tool = 0;
    public const int Loose = 1;
    /// <summary>not held any more, but still touched: not asked until apart</summary>
    public const int LetGo = 2;
  }
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtSolidHeld {
    public uint size;
    public int body;
    /// <summary>FT_SOLID_HOLDS_*</summary>
    public int state;
    /// <summary>0</summary>
    public int reserved;
  }
  public sealed unsafe partial class FtWorld {
    public void SolidShown(int body, FtPoseBuffer into) {
      ulong count;
      Ft.Must(FtNative.ft_solid_world_shown(this, body, into.Native->rotations, into.Native->translations, (ulong)into.JointCount, out count));
      GC.KeepAlive(into);
    }
    readonly FtBuffer<FtSolidJoint> solidJointsBuffer = new FtBuffer<FtSolidJoint>();
    public ReadOnlySpan<FtSolidJoint> SolidJoints(int body) {
      ulong count;
      int status;
      do {
        fixed (FtSolidJoint* first = solidJointsBuffer.Items) {
          first->size = (uint)sizeof(FtSolidJoint);
          status = FtNative.ft_solid_world_joints(this, body, first, solidJointsBuffer.Capacity, out count);
        }
      } while (solidJointsBuffer.HasGrown(status, count));
      return solidJointsBuffer.First(count);
    }
    readonly FtBuffer<FtSolidContact> solidContactsBuffer = new FtBuffer<FtSolidContact>();
    public ReadOnlySpan<FtSolidContact> SolidContacts(int body) {
      ulong count;
      int status;
      do {
        fixed (FtSolidContact* first = solidContactsBuffer.Items) {
          first->size = (uint)sizeof(FtSolidContact);
          status = FtNative.ft_solid_world_contacts(this, body, first, solidContactsBuffer.Capacity, out count);
        }
      } while (solidContactsBuffer.HasGrown(status, count));
      return solidContactsBuffer.First(count);
    }
    readonly FtBuffer<FtSolidBodyContact> solidBodyContactsBuffer = new FtBuffer<FtSolidBodyContact>();
    /// <summary>All of the last tick; what its hands hold is sorted by state. In arrays, the first
    /// element's size applies to all. O(n).</summary>
    public ReadOnlySpan<FtSolidBodyContact> SolidBodyContacts(int body) {
      ulong count;
      int status;
      do {
        fixed (FtSolidBodyContact* first = solidBodyContactsBuffer.Items) {
          first->size = (uint)sizeof(FtSolidBodyContact);
          status = FtNative.ft_solid_world_body_contacts(this, body, first, solidBodyContactsBuffer.Capacity, out count);
        }
      } while (solidBodyContactsBuffer.HasGrown(status, count));
      return solidBodyContactsBuffer.First(count);
    }
    readonly FtBuffer<FtSolidCrush> solidCrushesBuffer = new FtBuffer<FtSolidCrush>();
    public ReadOnlySpan<FtSolidCrush> SolidCrushes(int body) {
      ulong count;
      int status;
      do {
        fixed (FtSolidCrush* first = solidCrushesBuffer.Items) {
          first->size = (uint)sizeof(FtSolidCrush);
          status = FtNative.ft_solid_world_crushes(this, body, first, solidCrushesBuffer.Capacity, out count);
        }
      } while (solidCrushesBuffer.HasGrown(status, count));
      return solidCrushesBuffer.First(count);
    }
    readonly FtBuffer<FtSolidHeld> solidHeldBuffer = new FtBuffer<FtSolidHeld>();
    public ReadOnlySpan<FtSolidHeld> SolidHeld(int body) {
      ulong count;
      int status;
      do {
        fixed (FtSolidHeld* first = solidHeldBuffer.Items) {
          first->size = (uint)sizeof(FtSolidHeld);
          status = FtNative.ft_solid_world_held(this, body, first, solidHeldBuffer.Capacity, out count);
        }
      } while (solidHeldBuffer.HasGrown(status, count));
      return solidHeldBuffer.First(count);
    }
  }
  public static unsafe partial class FtNative {
    /// <summary>A solid world is an ft_world: all that world.h, events.h and triggers.h have is for it,
    /// too. Add what moves by itself (doors, lifts, balls), push its poses, attach what hands hold. It is
    /// followed from `begin_us` on, where its first tick begins: after each tick, ft_world_follow() until
    /// there, then ft_world_events(). `options` may be NULL. Errors: as ft_world_create(), no scene, an
    /// instant out of range.</summary>
    [DllImport(Library)] public static extern int ft_solid_world_create(FtScene still, long beginUs, int reach, FtWorldOptions* options, out FtWorld world);
    /// <summary>Adds a solid avatar, which is there from its first target on. Ticks push its poses, and
    /// nothing else does. Either of the options may be NULL. It reaches to its surface, whatever `reach`
    /// was, if it has own links or touches by its triangles (ft_body_options). Errors: as ft_solid_create()
    /// and ft_world_add_avatar(), `may_snap`, and FT_ERROR_MISMATCH if the world is not a solid world, as
    /// for the next two.</summary>
    [DllImport(Library)] public static extern int ft_solid_world_add(FtWorld world, FtAvatar avatar, FtSolidOptions* options, FtBodyOptions* body, out int number);
    /// <summary>One tick, from where the last one ended to `utime_us`. Avatars without a target in it keep
    /// their last one. What is not a solid avatar moves as the world knows it. Allocates nothing once
    /// memory has grown, as long as no hand takes or lets go. Errors, each of which names its body and
    /// changes nothing: an instant that is not 1 us to 10 s after the last one; a target that is none, of
    /// no solid avatar, or two of one; a body that waits for its poses and is not known until then; a solid
    /// avatar that is carried; what moves in its hand (ft_carrier.moves_in_frame), or changes hands within
    /// the tick; a tick that begins where the world has forgotten. If memory runs out in a tick, all later
    /// ones are FT_ERROR_OUT_OF_MEMORY: the world is to be made anew.</summary>
    [DllImport(Library)] public static extern int ft_solid_world_tick(FtWorld world, long utimeUs, FtSolidTarget* targets, ulong count);
    /// <summary>Where the last tick ended, or `begin_us`.</summary>
    [DllImport(Library)] public static extern int ft_solid_world_at(FtWorld world, out long utimeUs);
    /// <summary>The last tick of a solid avatar that has had a target; else FT_ERROR_NO_STEP. Otherwise as
    /// ft_solid_follow(), ft_solid_shown(), ft_solid_joints(), ft_solid_contacts() and ft_solid_way() have
    /// them, with these differences. What is proven is proven of moving bodies, too: is_certified and
    /// clearance are 0 while something crushes it. The contacts are those with what is still and with own
    /// links. The times of the way are those of the world's poses: whole microseconds. Stores 1 in
    /// *is_assumed if a body around it was silent, and was taken to hold still or to be nowhere; it may be
    /// NULL.</summary>
    [DllImport(Library)] public static extern int ft_solid_world_get_tick(FtWorld world, int body, FtSolidTick* tick, out int isAssumed);
    [DllImport(Library)] public static extern int ft_solid_world_shown(FtWorld world, int body, double* rotations, double* translations, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern int ft_solid_world_joints(FtWorld world, int body, FtSolidJoint* joints, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern int ft_solid_world_contacts(FtWorld world, int body, FtSolidContact* contacts, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern int ft_solid_world_way(FtWorld world, int body, ulong index, double* time, double* rotations, double* translations, ulong capacity, out ulong required);
    /// <summary>All of the last tick; what its hands hold is sorted by state. In arrays, the first
    /// element's size applies to all. O(n).</summary>
    [DllImport(Library)] public static extern int ft_solid_world_body_contacts(FtWorld world, int body, FtSolidBodyContact* contacts, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern int ft_solid_world_crushes(FtWorld world, int body, FtSolidCrush* crushes, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern int ft_solid_world_held(FtWorld world, int body, FtSolidHeld* held, ulong capacity, out ulong required);
  }
}
