// Written by generator/generate.py of foretouch/robots.h. Change that, not this.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  /// <summary>for any number of threads</summary>
  public sealed unsafe partial class FtRobot : FtHandle {
    /// <summary>In place of one that is not there: NULL in C.</summary>
    public static readonly FtRobot None = new FtRobot();
    protected override bool ReleaseHandle() { FtNative.ft_robot_destroy(handle); return true; }
  }
  /// <summary>for one</summary>
  public sealed unsafe partial class FtEdges : FtHandle {
    /// <summary>In place of one that is not there: NULL in C.</summary>
    public static readonly FtEdges None = new FtEdges();
    protected override bool ReleaseHandle() { FtNative.ft_edges_destroy(handle); return true; }
  }
  public static partial class FtJoint {
    public const int Fixed = 0;
    /// <summary>an angle between limits: beyond a turn it goes as q says</summary>
    public const int Revolute = 1;
    /// <summary>an angle without limits</summary>
    public const int Continuous = 2;
    public const int Prismatic = 3;
    /// <summary>a mobile base: x, y across the axis, and the angle about it</summary>
    public const int Planar = 4;
  }
  /// <summary>How a joint moves against its parent: T_rest * T_joint(q). For a fixed one only the kind
  /// counts.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtRobotJoint {
    public int kind;
    /// <summary>a joint that this one follows; -1: none</summary>
    public int mimicOf;
    /// <summary>in the joint's frame; any length but 0</summary>
    public FtVector axis;
    /// <summary>of revolute and prismatic ones; may be infinite</summary>
    public double lower;
    /// <summary>of revolute and prismatic ones; may be infinite</summary>
    public double upper;
    /// <summary>its coordinate is factor * (the other's) + offset</summary>
    public double mimicFactor;
    public double mimicOffset;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtUrdfOptions {
    public uint size;
    /// <summary>around a link's meshes; default 4</summary>
    public int maxLssPerLink;
    /// <summary>NULL: the defaults</summary>
    public FtImportOptions* import;
    /// <summary>where package://NAME/ is; besides, above the file</summary>
    public byte** packagePaths;
    public ulong packageCount;
    /// <summary>1: the visual geometry; 0, the default: the collision one</summary>
    public int useVisual;
    /// <summary>0</summary>
    public int reserved;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtRobotCoordinate {
    public uint size;
    public int joint;
    /// <summary>lives as long as the robot</summary>
    public byte* name;
    public double lower;
    public double upper;
    /// <summary>rad; else m</summary>
    public int isAngle;
    /// <summary>a whole turn leads to the same place</summary>
    public int isPeriodic;
  }
  /// <summary>How to judge own links, by configurations drawn within the robot's limits.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtRobotPairOptions {
    public uint size;
    /// <summary>at least 1; default 10,000</summary>
    public int samples;
    /// <summary>the same configurations on every machine; default 1</summary>
    public ulong seed;
    /// <summary>of these, for FT_PAIR_ALWAYS; default 0.95</summary>
    public double alwaysShare;
    /// <summary>by the user</summary>
    public FtLinkPair* leftOut;
    public ulong leftOutCount;
  }
  /// <summary>A rigid obstacle whose place may change between questions: ft_edges_place().</summary>
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtEdgeProp {
    /// <summary>in the prop's own frame</summary>
    public IntPtr scene;
    /// <summary>of that frame in W: w, x, y, z; metres</summary>
    public FtRotation rotation;
    /// <summary>of that frame in W: w, x, y, z; metres</summary>
    public FtVector translation;
    /// <summary>1: it is not there, and has no place</summary>
    public int isAbsent;
    /// <summary>0</summary>
    public int reserved;
    /// <summary>links and objects of this prop's scene</summary>
    public FtIgnoredPair* ignored;
    public ulong ignoredCount;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtEdgeOptions {
    public uint size;
    /// <summary>for lists, the calling one among them; default 1, at most 256</summary>
    public int threads;
    /// <summary>metres; default 1e-3</summary>
    public double tolerance;
    /// <summary>metres, default 0: clear proves that the robot keeps more away</summary>
    public double clearance;
    /// <summary>own links, of ft_robot_avatar(); NULL: not asked</summary>
    public IntPtr self;
    public FtIgnoredPair* ignored;
    public ulong ignoredCount;
    /// <summary>obstacles beside the scene; default none</summary>
    public FtEdgeProp* props;
    public ulong propCount;
    /// <summary>For ft_edges_clearance(), metres: how far its bounds may be apart, default 1e-3; how far it
    /// looks, default infinity.</summary>
    public double clearanceTolerance;
    /// <summary>For ft_edges_clearance(), metres: how far its bounds may be apart, default 1e-3; how far it
    /// looks, default infinity.</summary>
    public double clearanceWithin;
  }
  /// <summary>Sound: free_until is never late. In arrays, the first element's size applies to
  /// all.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtEdge {
    public uint size;
    /// <summary>FT_VERDICT_*</summary>
    public int verdict;
    /// <summary>for FT_VERDICT_UNDECIDED</summary>
    public int reason;
    /// <summary>1: clear, and both ends within limits</summary>
    public int isUsable;
    /// <summary>the robot keeps its clearance on [0, free_until); 1: clear</summary>
    public double freeUntil;
    /// <summary>a joint beyond its limits at that end; -1: none</summary>
    public int breachAt0;
    /// <summary>a joint beyond its limits at that end; -1: none</summary>
    public int breachAt1;
  }
  /// <summary>How near an edge comes to the scene and to the props that are there. Metres, W.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtClearance {
    public uint size;
    /// <summary>what comes nearest; -1: nothing comes within clearance_within</summary>
    public int link;
    /// <summary>what comes nearest; -1: nothing comes within clearance_within</summary>
    public int lss;
    /// <summary>what comes nearest; -1: nothing comes within clearance_within</summary>
    public int triangle;
    /// <summary>whose scene has the triangle; -1: the scene</summary>
    public int prop;
    /// <summary>1: no other place that was looked at is as near</summary>
    public int isAlone;
    /// <summary>never nearer than `lower`; at `t` no farther than `upper`</summary>
    public double lower;
    /// <summary>never nearer than `lower`; at `t` no farther than `upper`</summary>
    public double upper;
    public double t;
    public FtVector pointOnLink;
    public FtVector pointOnScene;
    /// <summary>unit, from the scene to the link; 0: they meet</summary>
    public FtVector normal;
  }
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtPath {
    public uint size;
    /// <summary>of the first edge that is not clear, or clear</summary>
    public int verdict;
    /// <summary>which that is; the number of edges: all are clear</summary>
    public ulong edge;
    /// <summary>`edge` plus how far that one is free; never late</summary>
    public double freeUntil;
  }
  public unsafe partial struct FtUrdfOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtUrdfOptions Usual {
      get {
        FtUrdfOptions usual;
        Ft.Must(FtNative.ft_urdf_options_init(&usual, (ulong)sizeof(FtUrdfOptions)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtRobot {
    readonly FtBuffer<FtRobotCoordinate> coordinatesBuffer = new FtBuffer<FtRobotCoordinate>();
    public ReadOnlySpan<FtRobotCoordinate> Coordinates() {
      ulong count;
      int status;
      do {
        fixed (FtRobotCoordinate* first = coordinatesBuffer.Items) {
          first->size = (uint)sizeof(FtRobotCoordinate);
          status = FtNative.ft_robot_coordinates(this, first, coordinatesBuffer.Capacity, out count);
        }
      } while (coordinatesBuffer.HasGrown(status, count));
      return coordinatesBuffer.First(count);
    }
  }
  public unsafe partial struct FtRobotPairOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtRobotPairOptions Usual {
      get {
        FtRobotPairOptions usual;
        Ft.Must(FtNative.ft_robot_pair_options_init(&usual, (ulong)sizeof(FtRobotPairOptions)));
        return usual;
      }
    }
  }
  public unsafe partial struct FtEdgeOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtEdgeOptions Usual {
      get {
        FtEdgeOptions usual;
        Ft.Must(FtNative.ft_edge_options_init(&usual, (ulong)sizeof(FtEdgeOptions)));
        return usual;
      }
    }
  }
  public static unsafe partial class FtNative {
    /// <summary>One joint per joint of the avatar, in order. `names`: the coordinates'; NULL: the joints'.
    /// Errors: another number of joints, limits the wrong way round, an axis that is zero, a joint that
    /// follows itself, or one that itself follows or does not move.</summary>
    [DllImport(Library)] public static extern int ft_robot_create(FtAvatar avatar, FtRobotJoint* joints, ulong jointCount, byte** names, out FtRobot robot);
    [DllImport(Library)] public static extern int ft_urdf_options_init(FtUrdfOptions* options, ulong size);
    /// <summary>A URDF, or MuJoCo's MJCF where the importer reads it (docs/robots.md). Refuses by name
    /// floating joints, limits the wrong way round, equal or absent, missing meshes and mimics of joints
    /// that are not there. W is the frame of the root link, or MuJoCo's world. `options` may be
    /// NULL.</summary>
    [DllImport(Library)] public static extern int ft_robot_create_from_urdf(byte* path, FtUrdfOptions* options, out FtRobot robot);
    /// <summary>Makes another robot: this one with a tool, a link of its own that is fixed to `link`, with
    /// these LSS in the frame of `link`.</summary>
    [DllImport(Library)] public static extern int ft_robot_create_with_tool(FtRobot robot, int link, byte* name, FtLss* lss, ulong lssCount, out FtRobot tooled);
    /// <summary>Makes an avatar of the robot's links: for pair rules, names and queries by poses. Destroy
    /// it.</summary>
    [DllImport(Library)] public static extern int ft_robot_avatar(FtRobot robot, out FtAvatar avatar);
    [DllImport(Library)] public static extern int ft_robot_coordinate_count(FtRobot robot, out ulong count);
    [DllImport(Library)] public static extern int ft_robot_coordinates(FtRobot robot, FtRobotCoordinate* coordinates, ulong capacity, out ulong required);
    /// <summary>The pose at q, as ft_avatar_rest_pose() has it.</summary>
    [DllImport(Library)] public static extern int ft_robot_pose(FtRobot robot, double* q, ulong coordinateCount, double* rotations, double* translations, ulong capacity, out ulong required);
    /// <summary>The poses at `count` configurations, one after the other in q, and between two of them as
    /// many as it takes to keep every joint's turn below a half turn: a step takes the shorter arc, which
    /// is then the way that q says, as in an edge. `capacity` and `required` count poses, each as from
    /// ft_robot_pose(). `at`: where each lies, i + t on the edge from configuration i to i + 1. Any of the
    /// three arrays may be NULL.</summary>
    [DllImport(Library)] public static extern int ft_robot_path(FtRobot robot, double* q, ulong count, ulong coordinateCount, double* rotations, double* translations, double* at, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern int ft_robot_pair_options_init(FtRobotPairOptions* options, ulong size);
    /// <summary>Rules of ft_robot_avatar(). Leaves out adjacent links and links that touch in nearly all
    /// samples. Zeros may lie outside the limits, so touching there is no reason; that no sample touched
    /// proves nothing, so such pairs are asked: ft_pair_rules_touches() has the counts. `options` may be
    /// NULL.</summary>
    [DllImport(Library)] public static extern int ft_pair_rules_create_of_robot(FtRobot robot, FtRobotPairOptions* options, out FtPairRules rules);
    [DllImport(Library)] public static extern void ft_robot_destroy(IntPtr robot);
    [DllImport(Library)] public static extern int ft_edge_options_init(FtEdgeOptions* options, ulong size);
    /// <summary>Keeps what it needs of all that it is given. `options` may be NULL.</summary>
    [DllImport(Library)] public static extern int ft_edges_create(FtRobot robot, FtScene scene, FtEdgeOptions* options, out FtEdges edges);
    /// <summary>Moves a prop, by its place in ft_edge_options; nothing is built anew. A NULL rotation: it
    /// is not there. Errors: no such prop, a rotation that is not unit, a place that is not finite or
    /// beyond 10 km along an axis; then it is where it was.</summary>
    [DllImport(Library)] public static extern int ft_edges_place(FtEdges edges, ulong prop, double* rotation, double* translation);
    /// <summary>q0 and q1 hold `count` configurations of `coordinate_count` numbers each, one after the
    /// other; `answers` has room for `count`. An edge from q to q asks whether q is free. The answers are
    /// the same for any number of threads. Errors, before any edge is asked: a coordinate_count that is not
    /// the robot's, numbers that are not finite or beyond 1,000; the index is the edge's.</summary>
    [DllImport(Library)] public static extern int ft_edges_answer(FtEdges edges, double* q0, double* q1, ulong count, ulong coordinateCount, FtEdge* answers);
    /// <summary>q0, q1 and errors are as for ft_edges_answer(). The options' clearance and own links have
    /// no part in it. `slopes0` and `slopes1`, which may be NULL, have room for count * coordinate_count
    /// numbers: how `upper` changes with q0 and q1; one way of several where is_alone is 0.</summary>
    [DllImport(Library)] public static extern int ft_edges_clearance(FtEdges edges, double* q0, double* q1, ulong count, ulong coordinateCount, FtClearance* clearances, double* slopes0, double* slopes1);
    /// <summary>How far the list of `count` configurations is free, at least two, an edge from each to the
    /// next. Asks no edge behind the first that is not clear, but for those that other threads have
    /// begun.</summary>
    [DllImport(Library)] public static extern int ft_edges_answer_path(FtEdges edges, double* q, ulong count, ulong coordinateCount, FtPath* path);
    /// <summary>What the edge `index` of the last list meets first, or the first edge of the last path that
    /// is not clear, with index 0. `toi` is the edge's; separation and points are of the robot grown by the
    /// clearance. `other`, which may be NULL: an own link in the place of the scene; link -1: none.
    /// FT_ERROR_NO_STEP before; FT_ERROR_MISMATCH if that edge is clear.</summary>
    [DllImport(Library)] public static extern int ft_edges_contact(FtEdges edges, ulong index, FtContact* contact, FtOtherLink* other);
    /// <summary>Stores the prop whose scene has that contact's triangle and object; -1: none. Errors as
    /// above.</summary>
    [DllImport(Library)] public static extern int ft_edges_contact_prop(FtEdges edges, ulong index, out int prop);
    [DllImport(Library)] public static extern void ft_edges_destroy(IntPtr edges);
  }
}
