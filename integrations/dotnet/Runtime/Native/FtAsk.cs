// Written by generator/generate.py of foretouch/ask.h. Change that, not this.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  /// <summary>Triangles that bend with several links. Vertex v is at the sum of weight times (the link's
  /// pose applied to the point), over the shares from first_share[v] to before first_share[v + 1]; the
  /// weights of a vertex add up to 1.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtSkin {
    public uint size;
    /// <summary>0</summary>
    public uint reserved;
    public ulong vertexCount;
    /// <summary>one more than vertices; 0 first</summary>
    public int* firstShare;
    public int* shareLinks;
    /// <summary>above 0</summary>
    public double* shareWeights;
    /// <summary>the vertex in the link's frame, where it was bound; metres</summary>
    public double* sharePoints;
    /// <summary>three vertices each</summary>
    public int* triangles;
    /// <summary>the link whose hit each is</summary>
    public int* triangleLinks;
    public ulong triangleCount;
  }
  /// <summary>A body, one of its links, or an object of it: of a mesh, or of what is still
  /// (FT_STILL_SCENE).</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtAskPart {
    public int body;
    /// <summary>or FT_EVERY_LINK</summary>
    public int link;
    /// <summary>or FT_EVERY_OBJECT</summary>
    public int @object;
  }
  /// <summary>A body that is asked about at an instant of its own, with all that carries it: for what a
  /// player saw who sees others late.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtAskInstant {
    public int body;
    /// <summary>0</summary>
    public int reserved;
    public long timeUs;
    /// <summary>of one more microsecond, in [0, 1)</summary>
    public double timeFraction;
  }
  /// <summary>What a question is about: everything, unless it says less.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtAskWhom {
    public uint size;
    /// <summary>bit g: bodies of group g; default all</summary>
    public uint groups;
    /// <summary>1, the default: what is still, too; 0: not</summary>
    public int asksStill;
    /// <summary>0</summary>
    public int reserved;
    /// <summary>nothing but these; none: everything</summary>
    public FtAskPart* only;
    public ulong onlyCount;
    /// <summary>not these</summary>
    public FtAskPart* without;
    public ulong withoutCount;
  }
  public static partial class FtAsk {
    /// <summary>the shape moves along `direction`, up to `reach`: where does it touch?</summary>
    public const int Cast = 0;
    /// <summary>what does the shape touch where it is?</summary>
    public const int Overlap = 1;
    /// <summary>what is near the shape, up to `reach`?</summary>
    public const int Nearest = 2;
  }
  public static partial class FtAsk {
    /// <summary>the first one along the way, or the nearest one</summary>
    public const int Closest = 0;
    /// <summary>whether there is one: some hit</summary>
    public const int Any = 1;
    /// <summary>each LSS and each triangle that is touched or near, nearest first</summary>
    public const int All = 2;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtQuestion {
    public uint size;
    /// <summary>FT_ASK_CAST, _OVERLAP or _NEAREST; default FT_ASK_CAST</summary>
    public int what;
    /// <summary>FT_ASK_CLOSEST, _ANY or _ALL; default FT_ASK_CLOSEST</summary>
    public int which;
    /// <summary>0</summary>
    public int reserved;
    /// <summary>Where it begins; solid. Both ends alike: a sphere. No radius either: a point, whose cast is
    /// a ray.</summary>
    public FtLss shape;
    /// <summary>a cast's: any length but zero</summary>
    public FtVector direction;
    /// <summary>how far a cast moves, or nearest looks; up to 1e8 m</summary>
    public double reach;
    /// <summary>the instant,</summary>
    public long timeUs;
    public double timeFraction;
    /// <summary>NULL: everything</summary>
    public FtAskWhom* whom;
    /// <summary>these bodies at these instants, all others at time_us</summary>
    public FtAskInstant* instants;
    public ulong instantCount;
    /// <summary>Three numbers each, from shape.a: corners of the convex solid that takes the place of the
    /// axis, whose ends are alike then; the radius is around it. None: the axis. Up to 1024.</summary>
    public double* hull;
    public ulong hullCount;
    /// <summary>1: closed objects of meshes and of what is still are solid: what begins inside one touches
    /// it, and an object that is not closed is unknown where its box holds the shape's place (a, or the
    /// middle of the corners). 0, the default: surfaces count.</summary>
    public int solids;
    /// <summary>0</summary>
    public int reservedEnd;
  }
  public static partial class FtAsk {
    /// <summary>nothing is hit or near, proven</summary>
    public const int Clear = 0;
    /// <summary>something is; what is unknown may be nearer</summary>
    public const int Hit = 1;
    /// <summary>nothing that is known is; nothing is claimed of what is unknown</summary>
    public const int Unknown = 2;
  }
  /// <summary>An LSS or a triangle that was hit or is near; or, without either, an object that is solid
  /// and holds the shape's place, which is its point then.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtWorldHit {
    public uint size;
    /// <summary>1: it rests on a body that was silent, and was taken to hold still</summary>
    public int isAssumed;
    /// <summary>its point: on its surface</summary>
    public FtWorldSide what;
    /// <summary>a cast's: along the way, free before; else how far apart; rounded down</summary>
    public double distance;
    /// <summary>unit, to the shape, W; zero if none is reported</summary>
    public FtVector normal;
    /// <summary>a triangle's: the point as a sum of its corners; else zero</summary>
    public FtVector weights;
  }
  /// <summary>What one of many questions found: its hits are the next hit_count of ft_world_hits(), after
  /// those of the questions before it; so are its unknown ones of ft_world_unknown().</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtProbed {
    public int verdict;
    public uint hitCount;
    public uint unknownCount;
    /// <summary>0</summary>
    public int reserved;
  }
  public static partial class FtAsk {
    /// <summary>silent, and taken to hold still: hits of it are assumed</summary>
    public const int Assumed = 0;
    /// <summary>nothing is known after its last pose; it was left out</summary>
    public const int Silent = 1;
    /// <summary>before its first pose; it was left out</summary>
    public const int NotThere = 2;
    /// <summary>in a flight: more triangles, or steps, than are followed in motion</summary>
    public const int Unresolved = 3;
    /// <summary>with solids: an object of it, or of what is still, has no inside: it is not
    /// closed</summary>
    public const int Open = 4;
  }
  /// <summary>A body that was asked about and is not known then; or an object that has no
  /// inside.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtUnknownBody {
    public uint size;
    /// <summary>or FT_STILL_SCENE</summary>
    public int body;
    /// <summary>FT_ASK_ASSUMED to FT_ASK_OPEN</summary>
    public int why;
    /// <summary>for FT_ASK_OPEN, unless it is a link's surface; else FT_EVERY_OBJECT</summary>
    public int @object;
  }
  /// <summary>A sphere, capsule or convex solid on its way, at constant speed and without a
  /// turn.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtFlight {
    public uint size;
    /// <summary>0</summary>
    public uint reserved;
    /// <summary>where it is at from_us</summary>
    public FtLss shape;
    /// <summary>to where it is at to_us; zero: it waits</summary>
    public FtVector way;
    public long fromUs;
    public long toUs;
    /// <summary>NULL: everything</summary>
    public FtAskWhom* whom;
    /// <summary>as in ft_question</summary>
    public double* hull;
    public ulong hullCount;
  }
  /// <summary>The first hit of all.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtFlightHit {
    public uint size;
    /// <summary>FT_ASK_CLEAR, _HIT or _UNKNOWN: the rest is zero unless FT_ASK_HIT</summary>
    public int verdict;
    /// <summary>rounded down: nothing is hit before</summary>
    public long timeUs;
    public double timeFraction;
    /// <summary>as in ft_world_hit, as all that follows</summary>
    public int isAssumed;
    /// <summary>0</summary>
    public int reserved;
    public FtWorldSide what;
    /// <summary>along the way</summary>
    public double distance;
    public FtVector normal;
    public FtVector weights;
  }
  public unsafe partial struct FtAskWhom {
    /// <summary>As the library has it by default.</summary>
    public static FtAskWhom Usual {
      get {
        FtAskWhom usual;
        Ft.Must(FtNative.ft_ask_whom_init(&usual, (ulong)sizeof(FtAskWhom)));
        return usual;
      }
    }
  }
  public unsafe partial struct FtQuestion {
    /// <summary>As the library has it by default.</summary>
    public static FtQuestion Usual {
      get {
        FtQuestion usual;
        Ft.Must(FtNative.ft_question_init(&usual, (ulong)sizeof(FtQuestion)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtWorld {
    readonly FtBuffer<FtWorldHit> hitsBuffer = new FtBuffer<FtWorldHit>();
    /// <summary>The last ft_world_probe()'s hits, by distance, then by body, link, LSS and triangle; those
    /// of the last ft_world_probe_many(), question after question. In arrays, the first element's size
    /// applies to all. FT_ERROR_NO_STEP before the first answer. O(n).</summary>
    public ReadOnlySpan<FtWorldHit> Hits() {
      ulong count;
      int status;
      do {
        fixed (FtWorldHit* first = hitsBuffer.Items) {
          first->size = (uint)sizeof(FtWorldHit);
          status = FtNative.ft_world_hits(this, first, hitsBuffer.Capacity, out count);
        }
      } while (hitsBuffer.HasGrown(status, count));
      return hitsBuffer.First(count);
    }
    readonly FtBuffer<FtUnknownBody> unknownBuffer = new FtBuffer<FtUnknownBody>();
    /// <summary>What was unknown to the last ft_world_probe(), ft_world_probe_many() or ft_world_fly(),
    /// whichever came last; by body, question after question.</summary>
    public ReadOnlySpan<FtUnknownBody> Unknown() {
      ulong count;
      int status;
      do {
        fixed (FtUnknownBody* first = unknownBuffer.Items) {
          first->size = (uint)sizeof(FtUnknownBody);
          status = FtNative.ft_world_unknown(this, first, unknownBuffer.Capacity, out count);
        }
      } while (unknownBuffer.HasGrown(status, count));
      return unknownBuffer.First(count);
    }
  }
  public unsafe partial struct FtFlight {
    /// <summary>As the library has it by default.</summary>
    public static FtFlight Usual {
      get {
        FtFlight usual;
        Ft.Must(FtNative.ft_flight_init(&usual, (ulong)sizeof(FtFlight)));
        return usual;
      }
    }
  }
  public static unsafe partial class FtNative {
    /// <summary>Questions meet bodies of this avatar by the skin, as it is bent at the instant, if the
    /// bodies are added after this call; links without triangles of it as they touch. First contacts and
    /// events go on by LSS or triangles. The arrays are not kept. Errors: bad arrays; ft_last_error_index()
    /// is the vertex or triangle.</summary>
    [DllImport(Library)] public static extern int ft_avatar_set_skin(FtAvatar avatar, FtSkin* skin);
    [DllImport(Library)] public static extern int ft_ask_whom_init(FtAskWhom* whom, ulong size);
    [DllImport(Library)] public static extern int ft_question_init(FtQuestion* question, ulong size);
    /// <summary>Answers, and stores FT_ASK_CLEAR, _HIT or _UNKNOWN in *verdict, which may be NULL. Never
    /// missed, never late: what the shape hits, where everything truly is at the instant, has a hit, no
    /// farther than it is, and at most 1e-9 m nearer where doubles resolve it. Questions at the instant of
    /// the last one, while nothing changes the world, are cheapest. Allocates nothing once memory has
    /// grown. Errors name the field: a shape, direction or reach that is not finite, out of range, or
    /// without length; unknown bodies and links; an instant that was forgotten. After an error the last
    /// answer stays.</summary>
    [DllImport(Library)] public static extern int ft_world_probe(FtWorld world, FtQuestion* question, out int verdict);
    /// <summary>Many questions in one call, each answered as ft_world_probe() answers it, to the bit,
    /// whatever their order; cheaper where they are at the same instants. All have the same size. If one is
    /// refused, none is answered, and the message names it. `probed` has room for `count`.</summary>
    [DllImport(Library)] public static extern int ft_world_probe_many(FtWorld world, FtQuestion* questions, ulong count, FtProbed* probed);
    /// <summary>The last ft_world_probe()'s hits, by distance, then by body, link, LSS and triangle; those
    /// of the last ft_world_probe_many(), question after question. In arrays, the first element's size
    /// applies to all. FT_ERROR_NO_STEP before the first answer. O(n).</summary>
    [DllImport(Library)] public static extern int ft_world_hits(FtWorld world, FtWorldHit* hits, ulong capacity, out ulong required);
    /// <summary>What was unknown to the last ft_world_probe(), ft_world_probe_many() or ft_world_fly(),
    /// whichever came last; by body, question after question.</summary>
    [DllImport(Library)] public static extern int ft_world_unknown(FtWorld world, FtUnknownBody* bodies, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern int ft_flight_init(FtFlight* flight, ulong size);
    /// <summary>By the bodies' true motion and the shape's own, not a cast against where they were. Never
    /// missed, never late, in time as in place. Errors: as ft_world_probe(); a time without
    /// length.</summary>
    [DllImport(Library)] public static extern int ft_world_fly(FtWorld world, FtFlight* flight, FtFlightHit* hit);
  }
}
