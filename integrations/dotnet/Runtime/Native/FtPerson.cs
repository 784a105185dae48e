// Written by generator/generate.py of foretouch/person.h. Change that, not this.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  /// <summary>What a body is taken to do between two poses.</summary>
  public static partial class FtBetween {
    /// <summary>each joint at a constant rate, as ft_query_step() has it</summary>
    public const int ConstantRate = 0;
    /// <summary>a curve that needs no later pose</summary>
    public const int Cubic = 1;
    /// <summary>a curve that needs the pose after the step</summary>
    public const int CubicLate = 2;
  }
  /// <summary>A claim of yours about one link. INFINITY: nothing is claimed.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtLinkBound {
    /// <summary>of a pose, m</summary>
    public double error;
    /// <summary>of person minus model within a step, m/s^2</summary>
    public double acceleration;
    /// <summary>Instead, if less: a length, m, and a share of how much the poses around the step
    /// bend.</summary>
    public double followFloor;
    /// <summary>Instead, if less: a length, m, and a share of how much the poses around the step
    /// bend.</summary>
    public double followShare;
    /// <summary>of the person where poses were lost, m/s</summary>
    public double speed;
    /// <summary>After the last pose, of person minus model: m/s and m/s^2.</summary>
    public double aheadSpeed;
    /// <summary>After the last pose, of person minus model: m/s and m/s^2.</summary>
    public double aheadAcceleration;
  }
  public sealed unsafe partial class FtBrackets : FtHandle {
    /// <summary>In place of one that is not there: NULL in C.</summary>
    public static readonly FtBrackets None = new FtBrackets();
    protected override bool ReleaseHandle() { FtNative.ft_brackets_destroy(handle); return true; }
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtBracketOptions {
    public uint size;
    /// <summary>default FT_FIDELITY_LINK; _EXACT: of triangles, which are never certain</summary>
    public int fidelity;
    /// <summary>instants are as near to the true ones as this, m; default 1e-5</summary>
    public double resolution;
    public FtIgnoredPair* ignored;
    public ulong ignoredCount;
    /// <summary>own links; NULL, the default: not asked</summary>
    public IntPtr self;
    /// <summary>Per answer, as ft_query_options has it: once it is spent, what is open is possible. Default
    /// UINT64_MAX: without limit.</summary>
    public ulong workBudget;
  }
  /// <summary>The two poses of a step of `seconds`, above 0, and those around them: NULL where there is
  /// none before or after, or it is not known yet.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtPosedStep {
    public uint size;
    /// <summary>FT_BETWEEN_*</summary>
    public int between;
    public FtPose* before;
    public FtPose* @from;
    public FtPose* to;
    public FtPose* after;
    public double secondsBefore;
    public double seconds;
    public double secondsAfter;
  }
  public static partial class FtBracket {
    /// <summary>no bound holds: nothing is claimed</summary>
    public const int Unclaimed = 0;
    /// <summary>proven: the person touched nothing with it</summary>
    public const int Excluded = 1;
    public const int Possible = 2;
    /// <summary>proven: the person touched something with it</summary>
    public const int Certain = 3;
  }
  /// <summary>Nothing was touched on [0, possible_from) and (possible_until, 1]. If certain, something
  /// was touched at certain_from and at certain_until, or, where certain_until comes first, at an instant
  /// between the two, at which the link passed through a surface.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtLinkBracket {
    public uint size;
    public int link;
    /// <summary>an own link above `link`; -1: the scene</summary>
    public int other;
    /// <summary>FT_BRACKET_*</summary>
    public int verdict;
    /// <summary>the scene's that is, or may be, touched first; -1: none, or not known</summary>
    public int triangle;
    /// <summary>the triangle's; -1: none</summary>
    public int @object;
    public double possibleFrom;
    public double possibleUntil;
    public double certainFrom;
    public double certainUntil;
    /// <summary>the largest distance between person and model, m</summary>
    public double growth;
  }
  public unsafe partial struct FtLinkBound {
    /// <summary>As the library has it by default.</summary>
    public static FtLinkBound Usual {
      get {
        FtLinkBound usual;
        Ft.Must(FtNative.ft_link_bound_init(&usual));
        return usual;
      }
    }
  }
  public unsafe partial struct FtBracketOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtBracketOptions Usual {
      get {
        FtBracketOptions usual;
        Ft.Must(FtNative.ft_bracket_options_init(&usual, (ulong)sizeof(FtBracketOptions)));
        return usual;
      }
    }
  }
  public unsafe partial struct FtPosedStep {
    /// <summary>As the library has it by default.</summary>
    public static FtPosedStep Usual {
      get {
        FtPosedStep usual;
        Ft.Must(FtNative.ft_posed_step_init(&usual, (ulong)sizeof(FtPosedStep)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtBrackets {
    readonly FtBuffer<FtLinkBracket> linksBuffer = new FtBuffer<FtLinkBracket>();
    /// <summary>One per link, in order. FT_ERROR_NO_STEP before the first answer.</summary>
    public ReadOnlySpan<FtLinkBracket> Links() {
      ulong count;
      int status;
      do {
        fixed (FtLinkBracket* first = linksBuffer.Items) {
          first->size = (uint)sizeof(FtLinkBracket);
          status = FtNative.ft_brackets_links(this, first, linksBuffer.Capacity, out count);
        }
      } while (linksBuffer.HasGrown(status, count));
      return linksBuffer.First(count);
    }
    readonly FtBuffer<FtLinkBracket> pairsBuffer = new FtBuffer<FtLinkBracket>();
    /// <summary>Every asked pair of own links that is not excluded.</summary>
    public ReadOnlySpan<FtLinkBracket> Pairs() {
      ulong count;
      int status;
      do {
        fixed (FtLinkBracket* first = pairsBuffer.Items) {
          first->size = (uint)sizeof(FtLinkBracket);
          status = FtNative.ft_brackets_pairs(this, first, pairsBuffer.Capacity, out count);
        }
      } while (pairsBuffer.HasGrown(status, count));
      return pairsBuffer.First(count);
    }
  }
  public static unsafe partial class FtNative {
    /// <summary>Claims nothing, and no error.</summary>
    [DllImport(Library)] public static extern int ft_link_bound_init(FtLinkBound* bound);
    /// <summary>Reads one bound per link from a file of format "foretouch-bounds", or takes those of a
    /// preset of docs/person.md, as "preset:optical", for one way between poses of this rate. Errors: those
    /// of the file; a name that is not a link's; no entry for that way and rate.</summary>
    [DllImport(Library)] public static extern int ft_bounds_read(byte* path, FtAvatar avatar, int between, double rateHz, FtLinkBound* bounds, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern int ft_bracket_options_init(FtBracketOptions* options, ulong size);
    /// <summary>`options` may be NULL. For one thread; keeps scene and avatar alive, the rules are
    /// copied.</summary>
    [DllImport(Library)] public static extern int ft_brackets_create(FtScene scene, FtAvatar avatar, FtBracketOptions* options, out FtBrackets brackets);
    [DllImport(Library)] public static extern int ft_posed_step_init(FtPosedStep* step, ulong size);
    /// <summary>Finds what follows from each link's bound. `bounds`: one per link. Allocates nothing once
    /// memory has grown. A call that fails leaves the last answer, if its arguments were wrong.</summary>
    [DllImport(Library)] public static extern int ft_brackets_answer(FtBrackets brackets, FtPosedStep* step, FtLinkBound* bounds, ulong count);
    /// <summary>Poses were lost between `from` and `to`: only `speed` and `error` of the bounds
    /// count.</summary>
    [DllImport(Library)] public static extern int ft_brackets_answer_gap(FtBrackets brackets, FtPosedStep* step, FtLinkBound* bounds, ulong count);
    /// <summary>Looks ahead: t is 0 at the step's `to` and 1 after `horizon` seconds, at most 1e6. The
    /// model goes on as it went. Links are excluded, or possible from `possible_from` on.</summary>
    [DllImport(Library)] public static extern int ft_brackets_look_ahead(FtBrackets brackets, FtPosedStep* step, double horizon, FtLinkBound* bounds, ulong count);
    /// <summary>One per link, in order. FT_ERROR_NO_STEP before the first answer.</summary>
    [DllImport(Library)] public static extern int ft_brackets_links(FtBrackets brackets, FtLinkBracket* links, ulong capacity, out ulong required);
    /// <summary>Every asked pair of own links that is not excluded.</summary>
    [DllImport(Library)] public static extern int ft_brackets_pairs(FtBrackets brackets, FtLinkBracket* pairs, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern void ft_brackets_destroy(IntPtr brackets);
  }
}
