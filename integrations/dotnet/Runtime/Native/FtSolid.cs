// Written by generator/generate.py of foretouch/solid.h. Change that, not this.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  /// <summary>One avatar's shown pose in one scene, and what it remembers. For one thread at a time; any
  /// number of them may share a scene and an avatar, which it keeps alive. The answers depend on the
  /// sequence of targets and on the options, not on time or threads.</summary>
  public sealed unsafe partial class FtSolid : FtHandle {
    /// <summary>In place of one that is not there: NULL in C.</summary>
    public static readonly FtSolid None = new FtSolid();
    protected override bool ReleaseHandle() { FtNative.ft_solid_destroy(handle); return true; }
  }
  /// <summary>What to do about tracked feet below the floor: calibration is often off by
  /// centimetres.</summary>
  public static partial class FtSolidFloor {
    /// <summary>lifts the whole target, slowly, as far as the feet ask for</summary>
    public const int Lift = 0;
    /// <summary>a floor is a surface like all others</summary>
    public const int Hold = 1;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtSolidOptions {
    public uint size;
    /// <summary>default FT_SOLID_FLOOR_LIFT</summary>
    public int floor;
    /// <summary>gap that it keeps to surfaces where it can: 1e-5 to 0.1; default 2e-3</summary>
    public double skin;
    /// <summary>of the proofs: 1e-6 to half the skin; default 5e-4</summary>
    public double tolerance;
    /// <summary>How much faster than the tracked pose it may move to catch up (m/s, any point); default
    /// 2.</summary>
    public double catchUp;
    /// <summary>unit; default +Y</summary>
    public FtVector up;
    /// <summary>of FT_SOLID_FLOOR_LIFT: 0 to 1; default 0.1</summary>
    public double mostLift;
    /// <summary>farther off than this, whole or by a limb, for longer than</summary>
    public double mostDeviation;
    /// <summary>`patience` (seconds), it may snap if `may_snap`;</summary>
    public double mostLimbDeviation;
    /// <summary>defaults 0.5, 0.35 and 0.7</summary>
    public double patience;
    /// <summary>seconds that a snap is announced before; default 0.25</summary>
    public double snapNotice;
    /// <summary>how far off a free place may be; default 2</summary>
    public double placingReach;
    /// <summary>1: it may appear at the tracked pose if that is free: a break of what is shown. Default
    /// 0.</summary>
    public int maySnap;
    /// <summary>Motions tried for a way around, per tick and per target; 0: never. Defaults 64 and
    /// 2000.</summary>
    public int aroundPerTick;
    /// <summary>Motions tried for a way around, per tick and per target; 0: never. Defaults 64 and
    /// 2000.</summary>
    public int aroundInAll;
    /// <summary>0</summary>
    public int reserved;
    /// <summary>per tick, in evaluations of a pair: &gt;= 1; default 200,000</summary>
    public ulong workBudget;
    /// <summary>one per link, 0 to 1e6: how much its error counts beyond its area;</summary>
    public double* visibility;
    /// <summary>none: hands 4, trunk and head 100, all others 1, by their names</summary>
    public ulong visibilityCount;
    /// <summary>one per link: 1 for those that FT_SOLID_FLOOR_LIFT listens to;</summary>
    public byte* feet;
    /// <summary>none: by their names</summary>
    public ulong feetCount;
    /// <summary>what touches nothing: a hole in the promise</summary>
    public FtIgnoredPair* ignored;
    public ulong ignoredCount;
    /// <summary>own links stop each other, too; NULL: they do not. Not kept</summary>
    public IntPtr self;
  }
  public sealed partial class FtSolid {
    /// <summary>no free place found yet: shown is tracked, and nothing is proven</summary>
    public const int Placing = 0;
    /// <summary>shown is tracked, bit for bit (lost joints and the lift apart)</summary>
    public const int Equal = 1;
    /// <summary>touches nothing, and catches up</summary>
    public const int Following = 2;
    /// <summary>surfaces keep it from the tracked pose, and it moved</summary>
    public const int Sliding = 3;
    /// <summary>surfaces keep it from the tracked pose, and it stays</summary>
    public const int Held = 4;
    /// <summary>on a proven way around what is in between</summary>
    public const int Around = 5;
    /// <summary>appeared here, although no way leads there</summary>
    public const int Snapped = 6;
  }
  public partial struct FtSolidJoint {
    /// <summary>no contact moves it from its tracked place</summary>
    public const int Free = 0;
    /// <summary>in contact, and moved</summary>
    public const int Sliding = 1;
    /// <summary>in contact, and did not move</summary>
    public const int Held = 2;
    /// <summary>not tracked: keeps its place on its parent, if surfaces let it</summary>
    public const int Lost = 3;
  }
  /// <summary>Why a tick ended before it was as near to its target as surfaces let it.</summary>
  public static partial class FtSolidLimit {
    public const int None = 0;
    /// <summary>work_budget</summary>
    public const int Budget = 1;
    /// <summary>catch_up</summary>
    public const int CatchUp = 2;
    /// <summary>the scene was changed around it: it stays, unproven</summary>
    public const int Inside = 3;
  }
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtSolidTick {
    public uint size;
    /// <summary>FT_SOLID_PLACING to _SNAPPED</summary>
    public int state;
    public int limit;
    /// <summary>1: on the whole way from the pose shown before, the avatar touches nothing but what is
    /// ignored. 0: while placing, or where the scene was changed around it.</summary>
    public int isCertified;
    /// <summary>1: it appeared where its way begins, which is free, but no way leads there: its first
    /// place, one after it was inside, or a snap. The only breaks of what is shown.</summary>
    public int hasAppeared;
    /// <summary>0</summary>
    public int reserved;
    /// <summary>of shown from tracked, the largest of all links</summary>
    public double deviation;
    /// <summary>how far the target was lifted</summary>
    public double lift;
    /// <summary>Lower bound on the separation on the whole way; infinite if it did not move, 0 if not
    /// certified.</summary>
    public double clearance;
    /// <summary>seconds until it snaps, if nothing changes; below 0: it does not</summary>
    public double snapInS;
    /// <summary>ft_solid_joints()</summary>
    public ulong jointCount;
    /// <summary>ft_solid_contacts()</summary>
    public ulong contactCount;
    /// <summary>ft_solid_way(); 0: it did not move</summary>
    public ulong wayCount;
    /// <summary>Work done, independent of the machine's load.</summary>
    public uint queries;
    /// <summary>Work done, independent of the machine's load.</summary>
    public uint iterations;
    /// <summary>Work done, independent of the machine's load.</summary>
    public uint features;
    /// <summary>Work done, independent of the machine's load.</summary>
    public uint rows;
    /// <summary>Work done, independent of the machine's load.</summary>
    public uint aroundQueries;
    /// <summary>Work done, independent of the machine's load.</summary>
    public uint placingQueries;
    public ulong work;
  }
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtSolidJoint {
    public uint size;
    /// <summary>FT_SOLID_JOINT_*</summary>
    public int state;
    /// <summary>largest distance of its link's axes from where they are tracked</summary>
    public double deviation;
  }
  /// <summary>A place where a surface holds the shown pose from the tracked one.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtSolidContact {
    public uint size;
    public int link;
    /// <summary>which of the link's LSS</summary>
    public int lss;
    /// <summary>of the scene; -1: another own link is touched</summary>
    public int triangle;
    /// <summary>the triangle's; -1: none</summary>
    public int @object;
    /// <summary>that own link; -1: none</summary>
    public int other;
    /// <summary>on the surface that is touched, W</summary>
    public FtVector point;
    /// <summary>unit, from that surface to the link, W</summary>
    public FtVector normal;
    public double gap;
    /// <summary>How hard the tracked pose presses: metres, &gt;= 0. Times a stiffness (N/m) it is the force
    /// along the normal with which a haptic device holds the hand.</summary>
    public double push;
    /// <summary>of the link's point along the surface, m/s</summary>
    public double slipSpeed;
  }
  public unsafe partial struct FtSolidOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtSolidOptions Usual {
      get {
        FtSolidOptions usual;
        Ft.Must(FtNative.ft_solid_options_init(&usual, (ulong)sizeof(FtSolidOptions)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtSolid {
    /// <summary>The last tick's shown pose, to draw; otherwise like ft_avatar_rest_pose(). FT_ERROR_NO_STEP
    /// before the first tick, as for the next three.</summary>
    public void Shown(FtPoseBuffer into) {
      ulong count;
      Ft.Must(FtNative.ft_solid_shown(this, into.Native->rotations, into.Native->translations, (ulong)into.JointCount, out count));
      GC.KeepAlive(into);
    }
    readonly FtBuffer<FtSolidJoint> jointsBuffer = new FtBuffer<FtSolidJoint>();
    /// <summary>The last tick's joints, in order, and its contacts, by link, LSS, triangle, other. In
    /// arrays, the first element's size applies to all, and the library sets the others'. O(n).</summary>
    public ReadOnlySpan<FtSolidJoint> Joints() {
      ulong count;
      int status;
      do {
        fixed (FtSolidJoint* first = jointsBuffer.Items) {
          first->size = (uint)sizeof(FtSolidJoint);
          status = FtNative.ft_solid_joints(this, first, jointsBuffer.Capacity, out count);
        }
      } while (jointsBuffer.HasGrown(status, count));
      return jointsBuffer.First(count);
    }
    readonly FtBuffer<FtSolidContact> contactsBuffer = new FtBuffer<FtSolidContact>();
    public ReadOnlySpan<FtSolidContact> Contacts() {
      ulong count;
      int status;
      do {
        fixed (FtSolidContact* first = contactsBuffer.Items) {
          first->size = (uint)sizeof(FtSolidContact);
          status = FtNative.ft_solid_contacts(this, first, contactsBuffer.Capacity, out count);
        }
      } while (contactsBuffer.HasGrown(status, count));
      return contactsBuffer.First(count);
    }
  }
  public static unsafe partial class FtNative {
    [DllImport(Library)] public static extern int ft_solid_options_init(FtSolidOptions* options, ulong size);
    /// <summary>`options` may be NULL. Errors: options out of range; arrays, pairs or rules that do not fit
    /// the avatar; ft_last_error() names the option. O(links^2).</summary>
    [DllImport(Library)] public static extern int ft_solid_create(FtScene scene, FtAvatar avatar, FtSolidOptions* options, out FtSolid solid);
    /// <summary>One tick: the shown pose goes as near to `tracked` as surfaces let it. Fills as much of
    /// `tick` as tick-&gt;size covers. `is_tracked`: per joint 0 if its tracker lost it, so that its place
    /// in `tracked` means nothing (but must be legal); NULL: none is lost. A lost joint keeps its place on
    /// its parent, a lost root where it is. `dt_s`: since the last tick, above 0 and at most 10. The first
    /// pose is where the avatar begins; if it touches something there, at the nearest free place. Allocates
    /// nothing once memory has grown to the scene's needs. After an error the shown pose and the last tick
    /// stay.</summary>
    [DllImport(Library)] public static extern int ft_solid_follow(FtSolid solid, FtPose* tracked, byte* isTracked, double dtS, FtSolidTick* tick);
    /// <summary>The last tick's shown pose, to draw; otherwise like ft_avatar_rest_pose(). FT_ERROR_NO_STEP
    /// before the first tick, as for the next three.</summary>
    [DllImport(Library)] public static extern int ft_solid_shown(FtSolid solid, double* rotations, double* translations, ulong capacity, out ulong required);
    /// <summary>The last tick's joints, in order, and its contacts, by link, LSS, triangle, other. In
    /// arrays, the first element's size applies to all, and the library sets the others'. O(n).</summary>
    [DllImport(Library)] public static extern int ft_solid_joints(FtSolid solid, FtSolidJoint* joints, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern int ft_solid_contacts(FtSolid solid, FtSolidContact* contacts, ulong capacity, out ulong required);
    /// <summary>The way of the last tick, piece by piece: the pose that piece `index` ends with, otherwise
    /// like ft_avatar_rest_pose(), and in *time (may be NULL) when it is reached, in (0, 1] of the tick (0:
    /// it appeared there). Each piece is a motion as ft_query_step() answers them, from the pose before it
    /// (the first: the one shown before); the last ends with the shown pose. FT_ERROR_OUT_OF_RANGE if there
    /// are not as many.</summary>
    [DllImport(Library)] public static extern int ft_solid_way(FtSolid solid, ulong index, double* time, double* rotations, double* translations, ulong capacity, out ulong required);
    /// <summary>Forgets the shown pose: the game teleported its user, or trackers were gone for long. The
    /// next tracked pose is the first again.</summary>
    [DllImport(Library)] public static extern int ft_solid_reset(FtSolid solid);
    /// <summary>The same, but the avatar begins at `place`, which must be outside of everything, say a
    /// spawn point: the next tracked pose must be reached from there. Errors: not a pose of the avatar;
    /// FT_ERROR_MISMATCH if it touches something; then nothing has changed.</summary>
    [DllImport(Library)] public static extern int ft_solid_reset_at(FtSolid solid, FtPose* place);
    /// <summary>Goes on in another scene: a door has opened. Forgets the last tick's answer, but not the
    /// shown pose. If that is inside something now, it stays there (FT_SOLID_LIMIT_INSIDE) until a tick
    /// finds the nearest free place. Errors: as ft_solid_create(), and nothing has changed.</summary>
    [DllImport(Library)] public static extern int ft_solid_change_scene(FtSolid solid, FtScene scene);
    [DllImport(Library)] public static extern void ft_solid_destroy(IntPtr solid);
  }
}
