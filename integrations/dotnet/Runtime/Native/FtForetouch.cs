// Written by generator/generate.py of foretouch/foretouch.h. Change that, not this.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  public sealed unsafe partial class FtScene : FtHandle {
    /// <summary>In place of one that is not there: NULL in C.</summary>
    public static readonly FtScene None = new FtScene();
    protected override bool ReleaseHandle() { FtNative.ft_scene_destroy(handle); return true; }
  }
  public sealed unsafe partial class FtAvatar : FtHandle {
    /// <summary>In place of one that is not there: NULL in C.</summary>
    public static readonly FtAvatar None = new FtAvatar();
    protected override bool ReleaseHandle() { FtNative.ft_avatar_destroy(handle); return true; }
  }
  public sealed unsafe partial class FtClip : FtHandle {
    /// <summary>In place of one that is not there: NULL in C.</summary>
    public static readonly FtClip None = new FtClip();
    protected override bool ReleaseHandle() { FtNative.ft_clip_destroy(handle); return true; }
  }
  public sealed unsafe partial class FtPairRules : FtHandle {
    /// <summary>In place of one that is not there: NULL in C.</summary>
    public static readonly FtPairRules None = new FtPairRules();
    protected override bool ReleaseHandle() { FtNative.ft_pair_rules_destroy(handle); return true; }
  }
  public sealed unsafe partial class FtQuery : FtHandle {
    /// <summary>In place of one that is not there: NULL in C.</summary>
    public static readonly FtQuery None = new FtQuery();
    protected override bool ReleaseHandle() { FtNative.ft_query_destroy(handle); return true; }
  }
  public sealed unsafe partial class FtNear : FtHandle {
    /// <summary>In place of one that is not there: NULL in C.</summary>
    public static readonly FtNear None = new FtNear();
    protected override bool ReleaseHandle() { FtNative.ft_near_destroy(handle); return true; }
  }
  public static partial class FtStatus {
    /// <summary>Errors of the call itself.</summary>
    public const int Ok = 0;
    /// <summary>NULL for a required pointer.</summary>
    public const int ErrorNullArgument = 1;
    /// <summary>Not a handle of this kind.</summary>
    public const int ErrorWrongHandle = 2;
    /// <summary>A size that no version of the struct has, or its newer fields.</summary>
    public const int ErrorStructSize = 3;
    /// <summary>The library is older than the header.</summary>
    public const int ErrorAbiVersion = 4;
    /// <summary>required is the room needed.</summary>
    public const int ErrorBufferTooSmall = 5;
    /// <summary>No step has been answered yet.</summary>
    public const int ErrorNoStep = 6;
    public const int ErrorOutOfMemory = 7;
    /// <summary>A bug in Foretouch.</summary>
    public const int ErrorInternal = 8;
    public const int ErrorFileNotFound = 100;
    public const int ErrorFileUnreadable = 101;
    public const int ErrorFileUnwritable = 102;
    /// <summary>The text breaks the format's grammar.</summary>
    public const int ErrorSyntax = 103;
    /// <summary>Larger, deeper or longer than the stated limit.</summary>
    public const int ErrorLimitExceeded = 104;
    /// <summary>NaN or infinity instead of a number.</summary>
    public const int ErrorNonFinite = 105;
    /// <summary>A finite number outside its legal range.</summary>
    public const int ErrorOutOfRange = 106;
    public const int ErrorUnknownName = 107;
    public const int ErrorDuplicateName = 108;
    /// <summary>A parent after its child.</summary>
    public const int ErrorBadHierarchy = 109;
    /// <summary>No joints, no frames, no triangles.</summary>
    public const int ErrorEmpty = 110;
    /// <summary>Two inputs do not fit each other.</summary>
    public const int ErrorMismatch = 111;
    /// <summary>The importer refused the file.</summary>
    public const int ErrorImportFailed = 112;
    /// <summary>The importer died or ran into its limits.</summary>
    public const int ErrorImportCrashed = 113;
    /// <summary>Embree refused to work.</summary>
    public const int ErrorDeviceFailed = 114;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtSceneArrays {
    public uint size;
    /// <summary>0</summary>
    public uint reserved;
    /// <summary>x, y, z per vertex, W, metres, |coordinate| &lt;= 1e7</summary>
    public double* positions;
    public ulong vertexCount;
    /// <summary>3 per triangle; NULL: three vertices per triangle, in order</summary>
    public uint* indices;
    /// <summary>1 to 50,000,000</summary>
    public ulong triangleCount;
    /// <summary>the object of each triangle; NULL: object 0</summary>
    public int* objects;
    /// <summary>UTF-8; NULL: "object 0" and so on</summary>
    public byte** objectNames;
    /// <summary>0 counts as 1 if `objects` is NULL</summary>
    public ulong objectCount;
  }
  /// <summary>FT_UP_FILE: as the file itself says, else Y.</summary>
  public static partial class FtUp {
    public const int File = -1;
    public const int Y = 0;
    public const int Z = 1;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtImportOptions {
    public uint size;
    /// <summary>The up axis, in place of what the file says; default FT_UP_FILE. Z: (x, y, z) becomes (x,
    /// z, -y).</summary>
    public int up;
    /// <summary>metres per unit, in place of the file's; default 0: as the file says, else 1</summary>
    public double scale;
    /// <summary>The importing process' limit; default 8 GiB. It uses at most half of the machine's
    /// memory.</summary>
    public ulong memoryLimitBytes;
    /// <summary>that process' limit, too; default 60</summary>
    public double timeLimitS;
    /// <summary>Path of the program foretouch-import. NULL: $FORETOUCH_IMPORTER; else in the library's
    /// folder; else in libexec/foretouch of the library's prefix, beside the running program, and where
    /// Foretouch was installed.</summary>
    public byte* importer;
  }
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtSceneInfo {
    public uint size;
    public int objectCount;
    /// <summary>kept</summary>
    public ulong triangles;
    /// <summary>dropped: a vertex with NaN or infinity</summary>
    public ulong droppedNonFinite;
    /// <summary>kept</summary>
    public ulong zeroArea;
    /// <summary>kept</summary>
    public ulong duplicates;
    public FtVector boxMin;
    public FtVector boxMax;
  }
  /// <summary>A line-swept sphere in its link's frame, metres. a = b: a sphere.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtLss {
    public FtVector a;
    public FtVector b;
    public double radius;
  }
  /// <summary>A triangle of a link's surface, in the link's frame, metres.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtTriangle {
    public FtMatrix vertices;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtAvatarArrays {
    public uint size;
    /// <summary>0</summary>
    public uint reserved;
    /// <summary>1 to 4096</summary>
    public ulong jointCount;
    /// <summary>unique UTF-8</summary>
    public byte** names;
    /// <summary>index of an earlier joint; -1: a root, placed in W</summary>
    public int* parents;
    /// <summary>rest translation in the parent's frame, x, y, z per joint</summary>
    public double* offsets;
    /// <summary>rest rotation, w, x, y, z per joint; NULL: none</summary>
    public double* rotations;
    /// <summary>at least one</summary>
    public FtLss* lss;
    /// <summary>the joint that each LSS moves with</summary>
    public int* lssLinks;
    public ulong lssCount;
    /// <summary>For FT_FIDELITY_EXACT: each triangle within one of its link's LSS. NULL: none.</summary>
    public FtTriangle* triangles;
    public int* triangleLinks;
    public ulong triangleCount;
  }
  /// <summary>Every joint in its parent's frame; roots in W.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtPose {
    public uint size;
    /// <summary>the avatar's</summary>
    public uint jointCount;
    /// <summary>w, x, y, z per joint, norm within 1e-3 of 1; replace the rest rotations</summary>
    public double* rotations;
    /// <summary>x, y, z per joint; replace the offsets; NULL: the offsets</summary>
    public double* translations;
  }
  /// <summary>Axes and units of an engine's floats, and their conversion; quaternions in the order x, y,
  /// z, w.</summary>
  public static partial class FtAxes {
    /// <summary>metres, as here: Godot, OpenXR, glTF</summary>
    public const int YUpRight = 0;
    /// <summary>metres, left-handed: Unity. Negates z</summary>
    public const int YUpLeft = 1;
    /// <summary>centimetres, left-handed: Unreal. (x, y, z) becomes (x, z, y) / 100</summary>
    public const int ZUpLeft = 2;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtClipOptions {
    public uint size;
    /// <summary>the file's, as in ft_import_options</summary>
    public int up;
    /// <summary>as in ft_import_options</summary>
    public double scale;
    /// <summary>then turned about +Y,</summary>
    public double yawDeg;
    /// <summary>then moved.</summary>
    public FtVector origin;
    /// <summary>Since FT_ABI_VERSION 11. for an .amc: its .asf; NULL: the one beside it. For others:
    /// NULL</summary>
    public byte* skeleton;
    /// <summary>poses per second of an .amc or a WebXR session; 0: as the file has it</summary>
    public double rowRateHz;
  }
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtClipInfo {
    public uint size;
    /// <summary>joints of the avatar that the clip drives</summary>
    public int matchedJoints;
    public ulong frameCount;
    public double frameTimeS;
  }
  public static partial class FtPair {
    public const int Asked = 0;
    /// <summary>one moves the other: between the two is no other link with LSS</summary>
    public const int Adjacent = 1;
    /// <summary>their LSS overlap in the rest pose</summary>
    public const int RestOverlap = 2;
    /// <summary>they touch in nearly all usual poses</summary>
    public const int Always = 3;
    /// <summary>the user wants it so</summary>
    public const int User = 4;
  }
  /// <summary>Two links, in either order.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtLinkPair {
    public int a;
    public int b;
  }
  /// <summary>A pair that is left out: a hole in the proof, so it has a reason.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtLeftOutPair {
    public int a;
    public int b;
    /// <summary>FT_PAIR_ADJACENT to FT_PAIR_USER</summary>
    public int reason;
  }
  /// <summary>Two LSS whose sum of radii counts as `radius`: less than it is.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtPairRadius {
    public int a;
    public int lssA;
    public int b;
    public int lssB;
    /// <summary>metres, &gt; 0</summary>
    public double radius;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtPairRuleOptions {
    public uint size;
    /// <summary>1: LSS that overlap at rest count with smaller radii, if they can</summary>
    public int usePairRadii;
    /// <summary>metres that these are then apart at rest; default 2e-3</summary>
    public double restSkin;
    /// <summary>of the usual poses, for FT_PAIR_ALWAYS; default 0.95</summary>
    public double alwaysShare;
    /// <summary>w, x, y, z per joint and pose, pose by pose</summary>
    public double* usualRotations;
    /// <summary>x, y, z per joint and pose; NULL: the offsets</summary>
    public double* usualTranslations;
    /// <summary>poses that the avatar usually takes; 0: none</summary>
    public ulong usualCount;
    /// <summary>by the user</summary>
    public FtLinkPair* leftOut;
    public ulong leftOutCount;
  }
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtPairRulesInfo {
    public uint size;
    /// <summary>0</summary>
    public uint reserved;
    /// <summary>pairs of different links that both have LSS</summary>
    public ulong pairs;
    /// <summary>how many of these are asked</summary>
    public ulong asked;
    public ulong leftOut;
    public ulong radii;
  }
  /// <summary>In how many of the usual poses two links touch: every pair of links with LSS, by a, then by
  /// b. Rules that were not derived from poses have none.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtPairTouches {
    public int a;
    public int b;
    public long touches;
  }
  /// <summary>What counts as a link's surface. 1, 2 and 3 were LIMB, AVATAR and ELLIPSOID, volumes around
  /// several links: they are refused, and the error says why.</summary>
  public static partial class FtFidelity {
    /// <summary>its LSS</summary>
    public const int Link = 0;
    /// <summary>its triangles, and LSS that contain no triangle</summary>
    public const int Exact = 4;
  }
  public static partial class FtScope {
    /// <summary>every link's own first contact</summary>
    public const int EveryLink = 0;
    /// <summary>the links that touch first; others: undecided, after_first</summary>
    public const int FirstOfAvatar = 1;
    /// <summary>also every link's own first contact with each object (ft_query_objects); FT_FIDELITY_LINK
    /// or _EXACT, no budget</summary>
    public const int EveryObject = 2;
  }
  /// <summary>A link, or a link and one object, whose contacts the query ignores.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtIgnoredPair {
    /// <summary>FT_EVERY_OBJECT: ignores the link altogether</summary>
    public int link;
    /// <summary>FT_EVERY_OBJECT: ignores the link altogether</summary>
    public int @object;
  }
  /// <summary>One link's own tolerance and fidelity, if links differ.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtLinkPolicy {
    public double tolerance;
    /// <summary>FT_FIDELITY_LINK or FT_FIDELITY_EXACT</summary>
    public int fidelity;
    /// <summary>0</summary>
    public int reserved;
  }
  /// <summary>A link's policy for one object, if objects differ. Later policies win; what one leaves out
  /// stays as earlier ones set it, or else as for all links. A link's tolerance is the least of those
  /// that it has with the objects that it does not ignore.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtObjectPolicy {
    /// <summary>or FT_EVERY_LINK</summary>
    public int link;
    /// <summary>or FT_EVERY_OBJECT</summary>
    public int @object;
    /// <summary>metres, 1e-9 to 1e7; 0: unchanged</summary>
    public double tolerance;
    /// <summary>FT_FIDELITY_LINK or _EXACT, only for FT_EVERY_OBJECT; or FT_UNCHANGED</summary>
    public int fidelity;
    /// <summary>1: ignores contacts; 0: no longer ignores them; or FT_UNCHANGED</summary>
    public int ignore;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtQueryOptions {
    public uint size;
    /// <summary>default FT_FIDELITY_LINK</summary>
    public int fidelity;
    /// <summary>metres, 1e-9 to 1e7; default 1e-3</summary>
    public double tolerance;
    /// <summary>per step, in evaluations of a pair (about 10 ns); default UINT64_MAX</summary>
    public ulong workBudget;
    /// <summary>per step, by the clock, &gt;= 0; default infinity. Not reproducible</summary>
    public double deadlineUs;
    /// <summary>default FT_SCOPE_EVERY_LINK</summary>
    public int scope;
    /// <summary>0</summary>
    public int reserved;
    public FtIgnoredPair* ignored;
    public ulong ignoredCount;
    /// <summary>one per link, replace tolerance and fidelity; or none</summary>
    public FtLinkPolicy* policies;
    public ulong policyCount;
    /// <summary>in order, over all options above; or none</summary>
    public FtObjectPolicy* objectPolicies;
    /// <summary>with tolerance or fidelity: not beside policies</summary>
    public ulong objectPolicyCount;
    /// <summary>1: a link that begins within the tolerance of the scene without touching it, and does not
    /// approach it, goes on; its first contact is the next one within a quarter of the separation that it
    /// began with. So an avatar that was stopped at `toi` can leave again. FT_FIDELITY_LINK or
    /// _EXACT.</summary>
    public int passSeparating;
    /// <summary>0</summary>
    public int reservedEnd;
  }
  public static partial class FtVerdict {
    /// <summary>proven: touches nothing on [0, 1]</summary>
    public const int Clear = 0;
    /// <summary>free on [0, toi); at toi within the tolerance</summary>
    public const int Contact = 1;
    /// <summary>touches at t = 0; toi is 0</summary>
    public const int StartsInContact = 2;
    /// <summary>free on [0, free_until), nothing claimed after it</summary>
    public const int Undecided = 3;
  }
  public static partial class FtReason {
    public const int None = 0;
    /// <summary>or the deadline</summary>
    public const int WorkBudget = 1;
    /// <summary>doubles cannot resolve the tolerance at these coordinates</summary>
    public const int Resolution = 2;
    /// <summary>in events only: a body is silent, and where it is is unknown</summary>
    public const int Gap = 4;
    /// <summary>FT_SCOPE_FIRST_OF_AVATAR: another link's contact is earlier</summary>
    public const int AfterFirst = 3;
  }
  public static partial class FtFeature {
    public const int Vertex = 0;
    public const int Edge = 1;
    public const int Face = 2;
  }
  /// <summary>What one link meets first. Sound: toi and free_until never exceed the true time of contact.
  /// In arrays, the first element's size applies to all, and the library sets the others'. Triangles have
  /// no inside, so how deep they are at the start is not known: penetration is NaN then, here and in
  /// ft_world_contact and ft_event.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtContact {
    public uint size;
    public int link;
    public int verdict;
    /// <summary>for FT_VERDICT_UNDECIDED</summary>
    public int reason;
    /// <summary>time of impact, [0, 1], rounded down; valid for contacts</summary>
    public double toi;
    /// <summary>toi for contacts, 1 for clear</summary>
    public double freeUntil;
    /// <summary>metres at toi</summary>
    public double separation;
    /// <summary>metres, for FT_VERDICT_STARTS_IN_CONTACT; NaN: not known</summary>
    public double penetration;
    /// <summary>witness point on the triangle, W</summary>
    public FtVector pointScene;
    /// <summary>witness point on the link's surface, W</summary>
    public FtVector pointLink;
    /// <summary>unit, from the scene to the link, W</summary>
    public FtVector normal;
    /// <summary>-1: none</summary>
    public int triangle;
    /// <summary>the triangle's; -1: none</summary>
    public int @object;
    /// <summary>which of the link's LSS; -1: none</summary>
    public int lss;
    /// <summary>at exact fidelity, which of the link's triangles; else -1</summary>
    public int linkTriangle;
    /// <summary>at exact fidelity</summary>
    public int linkFeature;
    /// <summary>at exact fidelity</summary>
    public int sceneFeature;
  }
  /// <summary>The own link that takes the place of the scene in a contact of two own links.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtOtherLink {
    /// <summary>above the contact's</summary>
    public int link;
    /// <summary>which of its LSS; -1: none</summary>
    public int lss;
  }
  /// <summary>Two points, one of each side, that are near when a contact is made.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtContactPoint {
    /// <summary>W; on the other link, in a contact of two own links</summary>
    public FtVector pointScene;
    public FtVector pointLink;
    /// <summary>metres, as computed; below 0 where the two overlap</summary>
    public double separation;
    /// <summary>-1: none, as for the next two</summary>
    public int triangle;
    /// <summary>which of the link's LSS</summary>
    public int lss;
    /// <summary>at exact fidelity, which of the link's triangles</summary>
    public int linkTriangle;
    /// <summary>0</summary>
    public int reserved;
  }
  /// <summary>More about one contact, at its toi. Velocities in metres per unit of t: divide by the
  /// step's seconds.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtContactDetails {
    public uint size;
    public int pointCount;
    /// <summary>of the material points at the two witness points; 0 for the scene</summary>
    public FtVector velocityScene;
    public FtVector velocityLink;
    /// <summary>along the normal, above 0 while the two approach; 0 without a normal</summary>
    public double approachSpeed;
    /// <summary>If these two points touch in the rest of the step, within the tolerance from here, they do
    /// so at a speed between these along this normal. A lower bound below 0: perhaps they never
    /// touch.</summary>
    public double approachLower;
    /// <summary>If these two points touch in the rest of the step, within the tolerance from here, they do
    /// so at a speed between these along this normal. A lower bound below 0: perhaps they never
    /// touch.</summary>
    public double approachUpper;
    /// <summary>Points of what is within the tolerance: the nearest first, then others far from it and from
    /// each other. At FT_FIDELITY_LINK and _EXACT; elsewhere there are none.</summary>
    public FtContactPointOf4 points;
  }
  [StructLayout(LayoutKind.Sequential)]
  public struct FtContactPointOf4 {
    public FtContactPoint item0, item1, item2, item3;
    public FtContactPoint this[int index] {
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
  /// <summary>The last step's lists of contacts.</summary>
  public static partial class FtList {
    /// <summary>ft_query_links()</summary>
    public const int Links = 0;
    /// <summary>ft_query_contacts()</summary>
    public const int Contacts = 1;
    /// <summary>ft_query_objects()</summary>
    public const int Objects = 2;
    /// <summary>ft_query_pairs()</summary>
    public const int Pairs = 3;
  }
  /// <summary>A link's place and velocity at one t, in W; velocities per unit of t.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtTransform {
    /// <summary>w, x, y, z; metres</summary>
    public FtRotation rotation;
    /// <summary>w, x, y, z; metres</summary>
    public FtVector translation;
    public FtVector angularVelocity;
    public FtVector velocity;
  }
  /// <summary>Work of the last step, independent of machine load (middleware/contact.h).</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtCounters {
    public uint size;
    /// <summary>0</summary>
    public uint reserved;
    public ulong nodes;
    public ulong leaves;
    public ulong candidates;
    public ulong clusterSteps;
    public ulong laneSteps;
    public ulong partSteps;
    public ulong advancements;
    public ulong hierarchyTests;
    public ulong planeTests;
    public ulong leafTests;
    public ulong states;
    /// <summary>always 0: the volumes that it counted are gone</summary>
    public ulong rungTests;
  }
  public sealed partial class FtNear {
    /// <summary>what a solver of contacts needs: at most 256 features per link</summary>
    public const int Reduced = 0;
    /// <summary>every LSS and triangle within reach</summary>
    public const int All = 1;
    /// <summary>the nearest feature of each link</summary>
    public const int Nearest = 2;
  }
  [StructLayout(LayoutKind.Sequential)]
  public unsafe partial struct FtNearOptions {
    public uint size;
    /// <summary>default FT_NEAR_REDUCED</summary>
    public int detail;
    public FtIgnoredPair* ignored;
    public ulong ignoredCount;
  }
  /// <summary>One place where an LSS of a link is near the scene. In arrays, the first element's size
  /// applies to all, and the library sets the others'.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtNearFeature {
    public uint size;
    public int link;
    public int lss;
    public int triangle;
    public int @object;
    /// <summary>which part of the triangle: FT_FEATURE_*</summary>
    public int feature;
    /// <summary>where the axis' nearest point is, from its end a (0) to b (1)</summary>
    public double along;
    /// <summary>lower bound on the separation, metres; below 0 where they overlap</summary>
    public double gap;
    /// <summary>on the triangle, W</summary>
    public FtVector pointScene;
    /// <summary>on the LSS's surface, W</summary>
    public FtVector pointLink;
    /// <summary>unit, from the scene to the link, W; 0 if the two meet without one</summary>
    public FtVector normal;
  }
  /// <summary>Where a link's features are among all.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtNearRange {
    public ulong first;
    public ulong count;
    /// <summary>1: more were near than FT_NEAR_REDUCED keeps; these are the nearest</summary>
    public int hadMore;
    /// <summary>0</summary>
    public int reserved;
  }
  public static partial class Ft {
    /// <summary>The version of this header and those beside it. Every new function or field increments it;
    /// programs built with an older header still work. A change that would break them changes the library's
    /// soname instead.</summary>
    public const int AbiVersion = 11;
    public const int EveryObject = -1;
    public const int EveryLink = -1;
    public const int Unchanged = -1;
    public const int MostContactPoints = 4;
  }
  public unsafe partial struct FtSceneArrays {
    /// <summary>As the library has it by default.</summary>
    public static FtSceneArrays Usual {
      get {
        FtSceneArrays usual;
        Ft.Must(FtNative.ft_scene_arrays_init(&usual, (ulong)sizeof(FtSceneArrays)));
        return usual;
      }
    }
  }
  public unsafe partial struct FtImportOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtImportOptions Usual {
      get {
        FtImportOptions usual;
        Ft.Must(FtNative.ft_import_options_init(&usual, (ulong)sizeof(FtImportOptions)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtScene {
    /// <summary>Fills as much of `info` as info-&gt;size covers.</summary>
    public FtSceneInfo GetInfo() {
      var answer = new FtSceneInfo { size = (uint)sizeof(FtSceneInfo) };
      Ft.Must(FtNative.ft_scene_get_info(this, &answer));
      return answer;
    }
  }
  public unsafe partial struct FtAvatarArrays {
    /// <summary>As the library has it by default.</summary>
    public static FtAvatarArrays Usual {
      get {
        FtAvatarArrays usual;
        Ft.Must(FtNative.ft_avatar_arrays_init(&usual, (ulong)sizeof(FtAvatarArrays)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtAvatar {
    /// <summary>Rotations (4 per joint) and translations (3 per joint) of the rest pose; either may be
    /// NULL. `capacity` and `required` are in joints.</summary>
    public void RestPose(FtPoseBuffer into) {
      ulong count;
      Ft.Must(FtNative.ft_avatar_rest_pose(this, into.Native->rotations, into.Native->translations, (ulong)into.JointCount, out count));
      GC.KeepAlive(into);
    }
  }
  public unsafe partial struct FtPose {
    /// <summary>As the library has it by default.</summary>
    public static FtPose Usual {
      get {
        FtPose usual;
        Ft.Must(FtNative.ft_pose_init(&usual, (ulong)sizeof(FtPose)));
        return usual;
      }
    }
  }
  public unsafe partial struct FtClipOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtClipOptions Usual {
      get {
        FtClipOptions usual;
        Ft.Must(FtNative.ft_clip_options_init(&usual, (ulong)sizeof(FtClipOptions)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtClip {
    public FtClipInfo GetInfo() {
      var answer = new FtClipInfo { size = (uint)sizeof(FtClipInfo) };
      Ft.Must(FtNative.ft_clip_get_info(this, &answer));
      return answer;
    }
    /// <summary>Frame `frame` as a pose of the avatar; otherwise like ft_avatar_rest_pose().</summary>
    public void Pose(int frame, FtPoseBuffer into) {
      ulong count;
      Ft.Must(FtNative.ft_clip_pose(this, (ulong)frame, into.Native->rotations, into.Native->translations, (ulong)into.JointCount, out count));
      GC.KeepAlive(into);
    }
  }
  public unsafe partial struct FtPairRuleOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtPairRuleOptions Usual {
      get {
        FtPairRuleOptions usual;
        Ft.Must(FtNative.ft_pair_rule_options_init(&usual, (ulong)sizeof(FtPairRuleOptions)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtPairRules {
    public FtPairRulesInfo GetInfo() {
      var answer = new FtPairRulesInfo { size = (uint)sizeof(FtPairRulesInfo) };
      Ft.Must(FtNative.ft_pair_rules_get_info(this, &answer));
      return answer;
    }
    readonly FtBuffer<FtLeftOutPair> leftOutBuffer = new FtBuffer<FtLeftOutPair>();
    /// <summary>Sorted by a, then by b; a &lt; b.</summary>
    public ReadOnlySpan<FtLeftOutPair> LeftOut() {
      ulong count;
      int status;
      do {
        fixed (FtLeftOutPair* first = leftOutBuffer.Items) {
          status = FtNative.ft_pair_rules_left_out(this, first, leftOutBuffer.Capacity, out count);
        }
      } while (leftOutBuffer.HasGrown(status, count));
      return leftOutBuffer.First(count);
    }
    readonly FtBuffer<FtPairRadius> radiiBuffer = new FtBuffer<FtPairRadius>();
    public ReadOnlySpan<FtPairRadius> Radii() {
      ulong count;
      int status;
      do {
        fixed (FtPairRadius* first = radiiBuffer.Items) {
          status = FtNative.ft_pair_rules_radii(this, first, radiiBuffer.Capacity, out count);
        }
      } while (radiiBuffer.HasGrown(status, count));
      return radiiBuffer.First(count);
    }
    readonly FtBuffer<FtPairTouches> touchesBuffer = new FtBuffer<FtPairTouches>();
    public ReadOnlySpan<FtPairTouches> Touches() {
      ulong count;
      int status;
      do {
        fixed (FtPairTouches* first = touchesBuffer.Items) {
          status = FtNative.ft_pair_rules_touches(this, first, touchesBuffer.Capacity, out count);
        }
      } while (touchesBuffer.HasGrown(status, count));
      return touchesBuffer.First(count);
    }
  }
  public unsafe partial struct FtQueryOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtQueryOptions Usual {
      get {
        FtQueryOptions usual;
        Ft.Must(FtNative.ft_query_options_init(&usual, (ulong)sizeof(FtQueryOptions)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtQuery {
    readonly FtBuffer<FtContact> linksBuffer = new FtBuffer<FtContact>();
    /// <summary>All links of the last step, in order. O(links).</summary>
    public ReadOnlySpan<FtContact> Links() {
      ulong count;
      int status;
      do {
        fixed (FtContact* first = linksBuffer.Items) {
          first->size = (uint)sizeof(FtContact);
          status = FtNative.ft_query_links(this, first, linksBuffer.Capacity, out count);
        }
      } while (linksBuffer.HasGrown(status, count));
      return linksBuffer.First(count);
    }
    readonly FtBuffer<FtContact> contactsBuffer = new FtBuffer<FtContact>();
    /// <summary>The links of the last step that are not clear, earliest first (undecided ones at their
    /// free_until); at equal times, the lowest link first. O(links log links).</summary>
    public ReadOnlySpan<FtContact> Contacts() {
      ulong count;
      int status;
      do {
        fixed (FtContact* first = contactsBuffer.Items) {
          first->size = (uint)sizeof(FtContact);
          status = FtNative.ft_query_contacts(this, first, contactsBuffer.Capacity, out count);
        }
      } while (contactsBuffer.HasGrown(status, count));
      return contactsBuffer.First(count);
    }
    readonly FtBuffer<FtContact> objectsBuffer = new FtBuffer<FtContact>();
    /// <summary>With FT_SCOPE_EVERY_OBJECT: the first contact of every link with every object in the last
    /// step, in the order of ft_query_contacts(). A link and an object that it does not list never touch,
    /// unless it lists the link as undecided: then only before that. FT_ERROR_MISMATCH at other
    /// scopes.</summary>
    public ReadOnlySpan<FtContact> Objects() {
      ulong count;
      int status;
      do {
        fixed (FtContact* first = objectsBuffer.Items) {
          first->size = (uint)sizeof(FtContact);
          status = FtNative.ft_query_objects(this, first, objectsBuffer.Capacity, out count);
        }
      } while (objectsBuffer.HasGrown(status, count));
      return objectsBuffer.First(count);
    }
    /// <summary>Fills as much of `details` as details-&gt;size covers, about the contact that `list` has at
    /// `index`. Not meant for every contact of every step: it looks at the near pairs once more.
    /// FT_ERROR_MISMATCH if the step has no such list, or if nothing is touched there.</summary>
    public FtContactDetails Details(int list, int index) {
      var answer = new FtContactDetails { size = (uint)sizeof(FtContactDetails) };
      Ft.Must(FtNative.ft_query_details(this, list, (ulong)index, &answer));
      return answer;
    }
    readonly FtBuffer<FtTransform> motionTransformsBuffer = new FtBuffer<FtTransform>();
    /// <summary>All links at `t` in [0, 1] of the last step's motion; at toi, the avatar's pose as it
    /// touches. O(joints).</summary>
    public ReadOnlySpan<FtTransform> MotionTransforms(double t) {
      ulong count;
      int status;
      do {
        fixed (FtTransform* first = motionTransformsBuffer.Items) {
          status = FtNative.ft_motion_transforms(this, t, first, motionTransformsBuffer.Capacity, out count);
        }
      } while (motionTransformsBuffer.HasGrown(status, count));
      return motionTransformsBuffer.First(count);
    }
    /// <summary>The pose at `t` in [0, 1] of the last step's motion, to begin the next step with: from toi
    /// on, say. The given poses at both ends; otherwise like ft_avatar_rest_pose().</summary>
    public void MotionPose(double t, FtPoseBuffer into) {
      ulong count;
      Ft.Must(FtNative.ft_motion_pose(this, t, into.Native->rotations, into.Native->translations, (ulong)into.JointCount, out count));
      GC.KeepAlive(into);
    }
    public FtCounters Counters() {
      var answer = new FtCounters { size = (uint)sizeof(FtCounters) };
      Ft.Must(FtNative.ft_query_counters(this, &answer));
      return answer;
    }
  }
  public unsafe partial struct FtNearOptions {
    /// <summary>As the library has it by default.</summary>
    public static FtNearOptions Usual {
      get {
        FtNearOptions usual;
        Ft.Must(FtNative.ft_near_options_init(&usual, (ulong)sizeof(FtNearOptions)));
        return usual;
      }
    }
  }
  public sealed unsafe partial class FtNear {
    readonly FtBuffer<FtNearFeature> featuresBuffer = new FtBuffer<FtNearFeature>();
    /// <summary>The last ft_near_ask()'s features, by link, LSS, gap and triangle. FT_ERROR_NO_STEP before
    /// it.</summary>
    public ReadOnlySpan<FtNearFeature> Features() {
      ulong count;
      int status;
      do {
        fixed (FtNearFeature* first = featuresBuffer.Items) {
          first->size = (uint)sizeof(FtNearFeature);
          status = FtNative.ft_near_features(this, first, featuresBuffer.Capacity, out count);
        }
      } while (featuresBuffer.HasGrown(status, count));
      return featuresBuffer.First(count);
    }
    readonly FtBuffer<FtNearRange> rangesBuffer = new FtBuffer<FtNearRange>();
    /// <summary>One per link, in order.</summary>
    public ReadOnlySpan<FtNearRange> Ranges() {
      ulong count;
      int status;
      do {
        fixed (FtNearRange* first = rangesBuffer.Items) {
          status = FtNative.ft_near_ranges(this, first, rangesBuffer.Capacity, out count);
        }
      } while (rangesBuffer.HasGrown(status, count));
      return rangesBuffer.First(count);
    }
  }
  public static unsafe partial class FtNative {
    /// <summary>The running library's version, "0.1.0", a text that lives for ever, and its
    /// FT_ABI_VERSION.</summary>
    [DllImport(Library)] public static extern byte* ft_version();
    [DllImport(Library)] public static extern uint ft_abi_version();
    /// <summary>The status as a stable word, "file-not-found"; "unknown" for any other number. Never
    /// fails.</summary>
    [DllImport(Library)] public static extern byte* ft_status_name(int status);
    /// <summary>One line about this thread's last call that failed, with file, place and expectation; "" if
    /// none has. UTF-8, at most 1023 bytes. The text lives until the thread's next call that
    /// fails.</summary>
    [DllImport(Library)] public static extern byte* ft_last_error();
    /// <summary>The joint, link, frame, triangle or body at fault in that call; -1 if none.</summary>
    [DllImport(Library)] public static extern long ft_last_error_index();
    /// <summary>FT_ERROR_ABI_VERSION if `header_version` is newer than the library.</summary>
    [DllImport(Library)] public static extern int ft_check_abi(uint headerVersion);
    /// <summary>Writes the defaults, here zeroes, and the size, at most `size` bytes. So do all
    /// ft_*_init().</summary>
    [DllImport(Library)] public static extern int ft_scene_arrays_init(FtSceneArrays* arrays, ulong size);
    /// <summary>Triangles are two-sided. Keeps those without area; drops and counts those that are not
    /// finite (ft_scene_info). O(n log n). Errors: bad arrays, no finite triangle.</summary>
    [DllImport(Library)] public static extern int ft_scene_create(FtSceneArrays* arrays, out FtScene scene);
    [DllImport(Library)] public static extern int ft_import_options_init(FtImportOptions* options, ulong size);
    /// <summary>Reads OBJ, PLY, STL, glTF, FBX, Collada, 3DS, OFF, X or IQM, in a caged child process: a
    /// file that crashes the importer is an error here. Or a scene that `foretouch scene bake` wrote: in
    /// milliseconds, without that process. `options` may be NULL.</summary>
    [DllImport(Library)] public static extern int ft_scene_create_from_file(byte* path, FtImportOptions* options, out FtScene scene);
    /// <summary>Fills as much of `info` as info-&gt;size covers.</summary>
    [DllImport(Library)] public static extern int ft_scene_get_info(FtScene scene, FtSceneInfo* info);
    /// <summary>Stores an object's name in *name; it lives as long as the scene.</summary>
    [DllImport(Library)] public static extern int ft_scene_object_name(FtScene scene, int @object, byte** name);
    /// <summary>NULL is legal. Do not call while another thread uses this handle.</summary>
    [DllImport(Library)] public static extern void ft_scene_destroy(IntPtr scene);
    [DllImport(Library)] public static extern int ft_avatar_arrays_init(FtAvatarArrays* arrays, ulong size);
    /// <summary>O(joints + LSS + triangles). Errors: bad arrays; ft_last_error_index() is the
    /// joint.</summary>
    [DllImport(Library)] public static extern int ft_avatar_create(FtAvatarArrays* arrays, out FtAvatar avatar);
    /// <summary>Reads an avatar file (docs/formats.md). `meshes`: how to read the triangles that it refers
    /// to, scale and up included; NULL: does not read them, and queries refuse exact fidelity.</summary>
    [DllImport(Library)] public static extern int ft_avatar_create_from_file(byte* path, FtImportOptions* meshes, out FtAvatar avatar);
    /// <summary>The same from text in memory, without meshes; errors name `name` as the file.</summary>
    [DllImport(Library)] public static extern int ft_avatar_create_from_text(byte* text, ulong length, byte* name, out FtAvatar avatar);
    [DllImport(Library)] public static extern int ft_avatar_joint_count(FtAvatar avatar, out ulong count);
    /// <summary>Stores the name in *name; it lives as long as the avatar.</summary>
    [DllImport(Library)] public static extern int ft_avatar_joint_name(FtAvatar avatar, int joint, byte** name);
    /// <summary>-1: a root.</summary>
    [DllImport(Library)] public static extern int ft_avatar_joint_parent(FtAvatar avatar, int joint, out int parent);
    /// <summary>FT_ERROR_UNKNOWN_NAME if no joint has this name. O(joints).</summary>
    [DllImport(Library)] public static extern int ft_avatar_find_joint(FtAvatar avatar, byte* name, out int joint);
    /// <summary>Rotations (4 per joint) and translations (3 per joint) of the rest pose; either may be
    /// NULL. `capacity` and `required` are in joints.</summary>
    [DllImport(Library)] public static extern int ft_avatar_rest_pose(FtAvatar avatar, double* rotations, double* translations, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern void ft_avatar_destroy(IntPtr avatar);
    [DllImport(Library)] public static extern int ft_pose_init(FtPose* pose, ulong size);
    /// <summary>`count` triples or quadruples; NULL with count 0 is legal. Passes non-finite numbers on.
    /// O(n).</summary>
    [DllImport(Library)] public static extern int ft_positions_from_floats(float* xyz, ulong count, int axes, double* positions);
    [DllImport(Library)] public static extern int ft_positions_to_floats(double* positions, ulong count, int axes, float* xyz);
    [DllImport(Library)] public static extern int ft_rotations_from_floats(float* xyzw, ulong count, int axes, double* wxyz);
    [DllImport(Library)] public static extern int ft_rotations_to_floats(double* wxyz, ulong count, int axes, float* xyzw);
    [DllImport(Library)] public static extern int ft_clip_options_init(FtClipOptions* options, ulong size);
    /// <summary>Reads a BVH clip, the first animation of a model (.glb, .gltf, .fbx, .dae, .x) at 30 poses
    /// per second, or motions of Acclaim (.amc), Xsens (.mvnx) and WebXR (.json). Its joints drive those of
    /// the avatar that have the same name; the others keep their rest pose. Error if no name matches.
    /// `options` may be NULL.</summary>
    [DllImport(Library)] public static extern int ft_clip_create_from_file(byte* path, FtAvatar avatar, FtClipOptions* options, out FtClip clip);
    [DllImport(Library)] public static extern int ft_clip_get_info(FtClip clip, FtClipInfo* info);
    /// <summary>Frame `frame` as a pose of the avatar; otherwise like ft_avatar_rest_pose().</summary>
    [DllImport(Library)] public static extern int ft_clip_pose(FtClip clip, ulong frame, double* rotations, double* translations, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern void ft_clip_destroy(IntPtr clip);
    [DllImport(Library)] public static extern int ft_pair_rule_options_init(FtPairRuleOptions* options, ulong size);
    /// <summary>Leaves out what the enumeration above names; `options` may be NULL. Rules belong to this
    /// avatar. Errors: bad options, and rules that leave no pair to ask. O(LSS^2) per pose.</summary>
    [DllImport(Library)] public static extern int ft_pair_rules_create(FtAvatar avatar, FtPairRuleOptions* options, out FtPairRules rules);
    /// <summary>All pairs are asked but these, which are left out, and only these LSS have radii of their
    /// own.</summary>
    [DllImport(Library)] public static extern int ft_pair_rules_create_exactly(FtAvatar avatar, FtLeftOutPair* leftOut, ulong leftOutCount, FtPairRadius* radii, ulong radiusCount, out FtPairRules rules);
    /// <summary>The other way round: only these pairs are asked, all others are left out (FT_PAIR_USER).
    /// Errors: no pair, links that are not there or have no LSS; the index is the link.</summary>
    [DllImport(Library)] public static extern int ft_pair_rules_create_asking(FtAvatar avatar, FtLinkPair* asked, ulong askedCount, out FtPairRules rules);
    /// <summary>Reads a file of pair rules (docs/formats.md).</summary>
    [DllImport(Library)] public static extern int ft_pair_rules_create_from_file(byte* path, FtAvatar avatar, out FtPairRules rules);
    [DllImport(Library)] public static extern int ft_pair_rules_get_info(FtPairRules rules, FtPairRulesInfo* info);
    /// <summary>Sorted by a, then by b; a &lt; b.</summary>
    [DllImport(Library)] public static extern int ft_pair_rules_left_out(FtPairRules rules, FtLeftOutPair* pairs, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern int ft_pair_rules_radii(FtPairRules rules, FtPairRadius* radii, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern int ft_pair_rules_touches(FtPairRules rules, FtPairTouches* pairs, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern void ft_pair_rules_destroy(IntPtr rules);
    [DllImport(Library)] public static extern int ft_query_options_init(FtQueryOptions* options, ulong size);
    /// <summary>A query of one avatar in one scene; `options` may be NULL. Checks the options.</summary>
    [DllImport(Library)] public static extern int ft_query_create(FtScene scene, FtAvatar avatar, FtQueryOptions* options, out FtQuery query);
    /// <summary>Changes the options and forgets the last step's answer, but not its pose.</summary>
    [DllImport(Library)] public static extern int ft_query_set_options(FtQuery query, FtQueryOptions* options);
    /// <summary>Asks whether own links touch, too; NULL: no longer. The rules stay when options change,
    /// which must then be FT_FIDELITY_LINK or _EXACT (without radii), and not FT_SCOPE_FIRST_OF_AVATAR.
    /// Forgets the last step's answer, but not its pose. The query keeps no handle of the rules.</summary>
    [DllImport(Library)] public static extern int ft_query_set_pair_rules(FtQuery query, FtPairRules rules);
    /// <summary>Answers the motion from one pose to another: every joint turns at constant rate on the
    /// shorter arc, translations are linear, links follow down the chain. `from` NULL: from where the last
    /// step ended (FT_ERROR_NO_STEP if there was none). Allocates nothing once memory has grown to the
    /// scene's needs. A step that fails leaves the query unchanged. Cost: docs/performance.md.</summary>
    [DllImport(Library)] public static extern int ft_query_step(FtQuery query, FtPose* @from, FtPose* to);
    /// <summary>All links of the last step, in order. O(links).</summary>
    [DllImport(Library)] public static extern int ft_query_links(FtQuery query, FtContact* links, ulong capacity, out ulong required);
    /// <summary>The links of the last step that are not clear, earliest first (undecided ones at their
    /// free_until); at equal times, the lowest link first. O(links log links).</summary>
    [DllImport(Library)] public static extern int ft_query_contacts(FtQuery query, FtContact* contacts, ulong capacity, out ulong required);
    /// <summary>With FT_SCOPE_EVERY_OBJECT: the first contact of every link with every object in the last
    /// step, in the order of ft_query_contacts(). A link and an object that it does not list never touch,
    /// unless it lists the link as undecided: then only before that. FT_ERROR_MISMATCH at other
    /// scopes.</summary>
    [DllImport(Library)] public static extern int ft_query_objects(FtQuery query, FtContact* contacts, ulong capacity, out ulong required);
    /// <summary>All asked pairs of own links of the last step that are not clear, in the order of
    /// ft_query_contacts(), then of the other link; every other asked pair is proven clear. In each
    /// contact, `point_scene`, `triangle` and `scene_feature` belong to the other link and its mesh, and
    /// `object` is -1. FT_ERROR_MISMATCH without pair rules.</summary>
    [DllImport(Library)] public static extern int ft_query_pairs(FtQuery query, FtContact* contacts, FtOtherLink* others, ulong capacity, out ulong required);
    /// <summary>Fills as much of `details` as details-&gt;size covers, about the contact that `list` has at
    /// `index`. Not meant for every contact of every step: it looks at the near pairs once more.
    /// FT_ERROR_MISMATCH if the step has no such list, or if nothing is touched there.</summary>
    [DllImport(Library)] public static extern int ft_query_details(FtQuery query, int list, ulong index, FtContactDetails* details);
    /// <summary>All links at `t` in [0, 1] of the last step's motion; at toi, the avatar's pose as it
    /// touches. O(joints).</summary>
    [DllImport(Library)] public static extern int ft_motion_transforms(FtQuery query, double t, FtTransform* transforms, ulong capacity, out ulong required);
    /// <summary>The pose at `t` in [0, 1] of the last step's motion, to begin the next step with: from toi
    /// on, say. The given poses at both ends; otherwise like ft_avatar_rest_pose().</summary>
    [DllImport(Library)] public static extern int ft_motion_pose(FtQuery query, double t, double* rotations, double* translations, ulong capacity, out ulong required);
    /// <summary>What a discrete check sees: stores 1 in *touches if the link's surface touches the scene at
    /// `t` of the last step's motion, else 0. Uses computed distances, without the promise.</summary>
    [DllImport(Library)] public static extern int ft_touches_at(FtQuery query, int link, double t, out int touches);
    [DllImport(Library)] public static extern int ft_query_counters(FtQuery query, FtCounters* counters);
    [DllImport(Library)] public static extern void ft_query_destroy(IntPtr query);
    [DllImport(Library)] public static extern int ft_near_options_init(FtNearOptions* options, ulong size);
    /// <summary>Asks about the links' LSS; `options` may be NULL. For one thread. A scene's first ft_near
    /// finds the edges over which its surfaces go on flat: they are not features.</summary>
    [DllImport(Library)] public static extern int ft_near_create(FtScene scene, FtAvatar avatar, FtNearOptions* options, out FtNear nearQuery);
    /// <summary>Finds what is within `reach` of the links at `pose`: metres, one per link, at most 1e7;
    /// below 0: the link is left out. Allocates nothing once memory has grown. A call that fails leaves the
    /// last answer, if its arguments were wrong.</summary>
    [DllImport(Library)] public static extern int ft_near_ask(FtNear nearQuery, FtPose* pose, double* reach, ulong reachCount);
    /// <summary>The last ft_near_ask()'s features, by link, LSS, gap and triangle. FT_ERROR_NO_STEP before
    /// it.</summary>
    [DllImport(Library)] public static extern int ft_near_features(FtNear nearQuery, FtNearFeature* features, ulong capacity, out ulong required);
    /// <summary>One per link, in order.</summary>
    [DllImport(Library)] public static extern int ft_near_ranges(FtNear nearQuery, FtNearRange* ranges, ulong capacity, out ulong required);
    [DllImport(Library)] public static extern void ft_near_destroy(IntPtr nearQuery);
  }
}
