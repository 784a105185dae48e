// Written by generator/generate.py of foretouch/world.h. Change that, not this.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  /// <summary>Bodies, where they are known to be, and the last window's answer. For one thread at a time;
  /// any number of worlds may share scenes and avatars, which they keep alive. Answers depend on the
  /// poses alone: not on the order in which bodies' poses came, nor on time or threads.</summary>
  public sealed unsafe partial class FtWorld : FtHandle {
    /// <summary>In place of one that is not there: NULL in C.</summary>
    public static readonly FtWorld None = new FtWorld();
    protected override bool ReleaseHandle() { FtNative.ft_world_destroy(handle); return true; }
  }
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtWorldOptions {
    public uint size;
    /// <summary>1: two meshes are asked whether they meet, and a mesh and what is still</summary>
    public int asksMeshes;
    /// <summary>metres, of every contact: 1e-8 to 1e7; default 1e-3</summary>
    public double tolerance;
    /// <summary>Work, counted as ft_query_options.work_budget, that two bodies may cost in one window, and
    /// a body by itself in one span between its poses; default 100,000,000. Beyond it: undecided.</summary>
    public ulong workPerPair;
    /// <summary>Work that all pairs of a window may cost together, shared by bodies; default
    /// UINT64_MAX.</summary>
    public ulong workPerWindow;
    /// <summary>A body that may meet more than so many others in a window is crowded; two crowded ones are
    /// not asked about each other, and each is listed as silent. Default UINT64_MAX.</summary>
    public ulong mostNear;
  }
  /// <summary>What a body is taken to do after its last known pose.</summary>
  public static partial class FtSilent {
    /// <summary>nothing: windows beyond it are refused until the next pose is there</summary>
    public const int Wait = 0;
    /// <summary>it stays in that pose: a guess, and no proof</summary>
    public const int HoldStill = 1;
    /// <summary>unknown: nothing is claimed of it from then on</summary>
    public const int Undecided = 2;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtBodyOptions {
    public uint size;
    /// <summary>0 to 31, for ft_world_ask(); default 0</summary>
    public int group;
    /// <summary>default FT_SILENT_WAIT</summary>
    public int whenSilent;
    /// <summary>FT_FIDELITY_LINK, or _EXACT: it touches by the avatar's triangles</summary>
    public int fidelity;
    /// <summary>asks whether own links touch, too; NULL: not asked. Not kept</summary>
    public IntPtr self;
  }
  /// <summary>What carries a body.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtCarrier {
    public uint size;
    public int body;
    public int link;
    /// <summary>0: what it carries keeps the place that it is attached at, and needs no poses until it is
    /// detached. 1: its poses are in the frame of that link, and are pushed like all others.</summary>
    public int movesInFrame;
  }
  /// <summary>One of two that meet.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtWorldSide {
    /// <summary>or FT_STILL_SCENE</summary>
    public int body;
    /// <summary>0 for a mesh and for what is still; or FT_EVERY_LINK</summary>
    public int link;
    /// <summary>which of the link's LSS; -1: none</summary>
    public int lss;
    /// <summary>of the mesh, of what is still, or of the link; -1: none</summary>
    public int triangle;
    /// <summary>of a mesh's triangle, or of what is still; -1: none</summary>
    public int @object;
    /// <summary>0</summary>
    public int reserved;
    /// <summary>witness point on its surface, W</summary>
    public FtVector point;
  }
  /// <summary>The first contact of two links in a window. Sound: its time is never later than their first
  /// touch there. FT_VERDICT_CONTACT: their separation is then at most the tolerance.
  /// FT_VERDICT_STARTS_IN_CONTACT: they touch where the window begins, or where one of them appears or is
  /// attached. FT_VERDICT_UNDECIDED: free until then, nothing claimed after it.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtWorldContact {
    public uint size;
    public int verdict;
    /// <summary>for FT_VERDICT_UNDECIDED</summary>
    public int reason;
    /// <summary>1: it rests on a body that was silent, and was taken to hold still</summary>
    public int isAssumed;
    /// <summary>whole microseconds, rounded down,</summary>
    public long timeUs;
    /// <summary>and a fraction of one more, in [0, 1)</summary>
    public double timeFraction;
    /// <summary>metres, then</summary>
    public double separation;
    /// <summary>metres, for FT_VERDICT_STARTS_IN_CONTACT; NaN: not known</summary>
    public double penetration;
    /// <summary>unit, from b to a, W</summary>
    public FtVector normal;
    /// <summary>a: the lower body, or of one body the lower link; what is still is b</summary>
    public FtWorldSide a;
    /// <summary>a: the lower body, or of one body the lower link; what is still is b</summary>
    public FtWorldSide b;
  }
  /// <summary>A body of which nothing was known in the rest of the window.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtSilentBody {
    public uint size;
    public int body;
    /// <summary>its last pose, or the window's begin</summary>
    public long sinceUs;
    /// <summary>FT_SILENT_HOLD_STILL or _UNDECIDED</summary>
    public int takenTo;
    /// <summary>0</summary>
    public int reserved;
  }
  /// <summary>Work of the last window, independent of machine load.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtWorldCounters {
    public uint size;
    /// <summary>0</summary>
    public uint reserved;
    /// <summary>whose swept boxes were found</summary>
    public ulong bodies;
    /// <summary>of bodies, asked, whose boxes meet</summary>
    public ulong pairs;
    /// <summary>of these, with two LSS whose boxes meet</summary>
    public ulong nearPairs;
    /// <summary>asked, of a pair or of a body alone, from pose to pose</summary>
    public ulong spans;
    public ulong nodes;
    public ulong leaves;
    public ulong candidates;
    public ulong clusterSteps;
    public ulong laneSteps;
    public ulong partSteps;
    public ulong advancements;
    /// <summary>as ft_counters</summary>
    public ulong hierarchyTests;
    /// <summary>as ft_counters</summary>
    public ulong planeTests;
    /// <summary>as ft_counters</summary>
    public ulong leafTests;
    /// <summary>as ft_counters</summary>
    public ulong states;
    /// <summary>as ft_counters</summary>
    public ulong rungTests;
  }
  public static partial class Ft {
    /// <summary>In contacts, in place of a body: what is still. In place of a link, of a body that is
    /// undecided: every link that has no contact of its own listed.</summary>
    public const int StillScene = -1;
  }
  public unsafe partial struct FtWorldOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtWorldOptions Usual {
      get {
        FtWorldOptions usual;
        Ft.Must(FtNative.ft_world_options_init(&usual, (ulong)sizeof(FtWorldOptions)));
        return usual;
      }
    }
  }
  public unsafe partial struct FtBodyOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtBodyOptions Usual {
      get {
        FtBodyOptions usual;
        Ft.Must(FtNative.ft_body_options_init(&usual, (ulong)sizeof(FtBodyOptions)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtWorld {
    readonly FtBuffer<FtWorldContact> contactsBuffer = new FtBuffer<FtWorldContact>();
    /// <summary>All contacts of the last window, earliest first; at equal times by a's body and link, then
    /// by b's. Every pair that was asked and is not listed is proven clear while both are there; but
    /// nothing is claimed of a silent body that is taken to be undecided, nor of what it carries. In
    /// arrays, the first element's size applies to all. FT_ERROR_NO_STEP before the first answer, as for
    /// the next two. O(n).</summary>
    public ReadOnlySpan<FtWorldContact> Contacts() {
      ulong count;
      int status;
      do {
        fixed (FtWorldContact* first = contactsBuffer.Items) {
          first->size = (uint)sizeof(FtWorldContact);
          status = FtNative.ft_world_contacts(this, first, contactsBuffer.Capacity, out count);
        }
      } while (contactsBuffer.HasGrown(status, count));
      return contactsBuffer.First(count);
    }
    readonly FtBuffer<FtSilentBody> silentBuffer = new FtBuffer<FtSilentBody>();
    /// <summary>Those of the last window, by body.</summary>
    public ReadOnlySpan<FtSilentBody> Silent() {
      ulong count;
      int status;
      do {
        fixed (FtSilentBody* first = silentBuffer.Items) {
          first->size = (uint)sizeof(FtSilentBody);
          status = FtNative.ft_world_silent(this, first, silentBuffer.Capacity, out count);
        }
      } while (silentBuffer.HasGrown(status, count));
      return silentBuffer.First(count);
    }
    /// <summary>Fills as much of `counters` as counters-&gt;size covers.</summary>
    public FtWorldCounters GetCounters() {
      var answer = new FtWorldCounters { size = (uint)sizeof(FtWorldCounters) };
      Ft.Must(FtNative.ft_world_get_counters(this, &answer));
      return answer;
    }
  }
  public static unsafe partial class FtNative {
    [DllImport(Library)] public static extern int ft_world_options_init(FtWorldOptions* options, ulong size);
    /// <summary>`still`: what never moves; NULL: nothing. `options` may be NULL.</summary>
    [DllImport(Library)] public static extern int ft_world_create(FtScene still, FtWorldOptions* options, out FtWorld world);
    [DllImport(Library)] public static extern int ft_body_options_init(FtBodyOptions* options, ulong size);
    /// <summary>An avatar, or a prop made of LSS: the LSS of its links touch, or its triangles. Stores the
    /// body's number in *body: 0, 1, 2, ... in the order of adding. `options` may be NULL. Errors: options
    /// out of range, rules of another avatar, FT_FIDELITY_EXACT of an avatar without triangles or beside
    /// rules with pair radii, more than 100,000 bodies.</summary>
    [DllImport(Library)] public static extern int ft_world_add_avatar(FtWorld world, FtAvatar avatar, FtBodyOptions* options, out int body);
    /// <summary>A rigid prop: its triangles touch, in its own frame. It has one joint, 0, as poses and
    /// contacts count. It meets avatars, and whatever ft_world_options.asks_meshes says besides.</summary>
    [DllImport(Library)] public static extern int ft_world_add_mesh(FtWorld world, FtScene mesh, FtBodyOptions* options, out int body);
    [DllImport(Library)] public static extern int ft_world_body_count(FtWorld world, out ulong count);
    /// <summary>Sets whether bodies of two groups are asked if they meet, 0 or 1; at first all
    /// are.</summary>
    [DllImport(Library)] public static extern int ft_world_ask(FtWorld world, int group, int other, int isAsked);
    /// <summary>The same for bodies of a group and what is still.</summary>
    [DllImport(Library)] public static extern int ft_world_ask_still(FtWorld world, int group, int isAsked);
    /// <summary>The body's next pose: in W, or in the frame of what carries it and lets it move. A body is
    /// there from its first pose on; before, nothing touches it. Allocates nothing once memory has grown,
    /// if ft_world_forget_before() is called now and then. Errors: an unknown body (ft_last_error_index()),
    /// an instant that is not after the last one or that is forgotten, not a pose of the body, a body that
    /// is held fast; then nothing has changed.</summary>
    [DllImport(Library)] public static extern int ft_world_push(FtWorld world, int body, long utimeUs, FtPose* pose);
    /// <summary>From `utime_us` on, the body is carried; `pose` is its pose there, in the frame of the
    /// carrier's link. The body and that link are not asked whether they meet. Errors: unknown bodies and
    /// links, a body that would carry itself (FT_ERROR_BAD_HIERARCHY), an instant at which one of the two
    /// is not known, or that is not after the last change.</summary>
    [DllImport(Library)] public static extern int ft_world_attach(FtWorld world, int body, FtCarrier* carrier, long utimeUs, FtPose* pose);
    /// <summary>From `utime_us` on, nothing carries it; `pose` is its pose there, in W. Errors: the same,
    /// and a body that is not carried.</summary>
    [DllImport(Library)] public static extern int ft_world_detach(FtWorld world, int body, long utimeUs, FtPose* pose);
    /// <summary>Stores in *utime_us until when all is known, or taken to be: the earliest last pose of the
    /// bodies that wait for theirs; if none waits, the latest pose of all. In *waits_for the body with that
    /// pose; -1: none waits. Either may be NULL. FT_ERROR_EMPTY if no body has a pose. O(bodies).</summary>
    [DllImport(Library)] public static extern int ft_world_known_until(FtWorld world, out long utimeUs, out int waitsFor);
    /// <summary>Lets go of what no window from `utime_us` on needs. Earlier poses and windows are refused
    /// from now on.</summary>
    [DllImport(Library)] public static extern int ft_world_forget_before(FtWorld world, long utimeUs);
    /// <summary>The same by memory: lets go of the oldest poses of all until ft_world_pose_bytes() is at
    /// most `bytes`, or nothing is left before ft_world_known_until(). Stores in *utime_us the instant
    /// before which it has forgotten; may be NULL.</summary>
    [DllImport(Library)] public static extern int ft_world_forget_beyond(FtWorld world, ulong bytes, out long utimeUs);
    /// <summary>The bytes that kept poses take: 56 n + 256 for a pose of n joints.</summary>
    [DllImport(Library)] public static extern int ft_world_pose_bytes(FtWorld world, out ulong bytes);
    /// <summary>Lets go of poses before `utime_us` between others that say nearly the same: no point of any
    /// body, of what it carries included, is ever farther than `metres` from where all poses that were
    /// pushed have it, however often this is called. Answers about instants from `utime_us` on stay as they
    /// are, to the bit. Nothing can be attached before it any more. Errors: metres that are not finite, or
    /// below 0.</summary>
    [DllImport(Library)] public static extern int ft_world_thin_before(FtWorld world, long utimeUs, double metres);
    /// <summary>Finds the first contact, in the window, of every two links of different bodies that are
    /// asked, of every link and what is still, and of own links where a body has rules. Allocates nothing
    /// once memory has grown, as long as no body is added or carried in another way. Errors: a window
    /// without length, that begins where the world has forgotten, or ends after ft_world_known_until();
    /// carriers whose chains are too deep together. After an error the last answer stays.</summary>
    [DllImport(Library)] public static extern int ft_world_answer(FtWorld world, long fromUs, long toUs);
    /// <summary>All contacts of the last window, earliest first; at equal times by a's body and link, then
    /// by b's. Every pair that was asked and is not listed is proven clear while both are there; but
    /// nothing is claimed of a silent body that is taken to be undecided, nor of what it carries. In
    /// arrays, the first element's size applies to all. FT_ERROR_NO_STEP before the first answer, as for
    /// the next two. O(n).</summary>
    [DllImport(Library)] public static extern int ft_world_contacts(FtWorld world, FtWorldContact* contacts, ulong capacity, out ulong required);
    /// <summary>Those of the last window, by body.</summary>
    [DllImport(Library)] public static extern int ft_world_silent(FtWorld world, FtSilentBody* bodies, ulong capacity, out ulong required);
    /// <summary>Fills as much of `counters` as counters-&gt;size covers.</summary>
    [DllImport(Library)] public static extern int ft_world_get_counters(FtWorld world, FtWorldCounters* counters);
    [DllImport(Library)] public static extern void ft_world_destroy(IntPtr world);
  }
}
