// Foretouch.cs: Foretouch in C#, for Unity on Linux: scene and avatar of arrays, a step, its contacts;
// and Follow(), to show a body that passes through nothing.
// Arrays are Unity's: metres, left-handed, +Y up, quaternions x, y, z, w. Copy libforetouch.so into
// Assets/Plugins/x86_64 and tick "Allow 'unsafe' Code" in the player's settings.
// Without Unity: mcs -unsafe -define:FORETOUCH_TRY Foretouch.cs && mono Foretouch.exe
// Worlds in which things move, and solid bodies among them: ForetouchWorld.cs, beside this file.
using System;
using System.Runtime.InteropServices;
using System.Text;

public unsafe sealed partial class Foretouch : IDisposable {
  [StructLayout(LayoutKind.Sequential)]
  public struct Lss { public fixed double a[3]; public fixed double b[3]; public double radius; }
  [StructLayout(LayoutKind.Sequential)]
  struct SceneArrays {
    public uint size, reserved;
    public double* positions; public ulong vertexCount;
    public uint* indices; public ulong triangleCount;
    public int* objects; public byte** objectNames; public ulong objectCount;
  }
  [StructLayout(LayoutKind.Sequential)]
  struct AvatarArrays {
    public uint size, reserved;
    public ulong jointCount; public byte** names; public int* parents;
    public double* offsets, rotations;
    public Lss* lss; public int* lssLinks; public ulong lssCount;
    public double* triangles; public int* triangleLinks; public ulong triangleCount;
  }
  [StructLayout(LayoutKind.Sequential)]
  struct Pose { public uint size, jointCount; public double* rotations, translations; }
  [StructLayout(LayoutKind.Sequential)]
  public struct Contact {
    public uint size; public int link, verdict, reason;
    public double toi, freeUntil, separation, penetration;
    public fixed double pointScene[3];
    public fixed double pointLink[3];
    public fixed double normal[3];
    public int triangle, obj, lss, linkTriangle, linkFeature, sceneFeature;
  }
  [StructLayout(LayoutKind.Sequential)]
  public struct SolidTick {
    public uint size; public int state, limit, isCertified, hasAppeared, reserved;
    public double deviation, lift, clearance, snapInS;
    public ulong jointCount, contactCount, wayCount;
    public uint queries, iterations, features, rows, aroundQueries, placingQueries;
    public ulong work;
  }
  [StructLayout(LayoutKind.Sequential)]
  public struct SolidContact {
    public uint size; public int link, lss, triangle, obj, other;
    public fixed double point[3];
    public fixed double normal[3];
    public double gap, push, slipSpeed;
  }
  public const int Placing = 0, Equal = 1, Following = 2, Sliding = 3, Held = 4, Around = 5, Snapped = 6;
  public const int Clear = 0, Touches = 1, StartsInContact = 2, Undecided = 3;

  const string Lib = "foretouch";
  const int UnityAxes = 1;  // FT_AXES_Y_UP_LEFT
  [DllImport(Lib)] static extern int ft_check_abi(uint headerVersion);
  [DllImport(Lib)] static extern byte* ft_last_error();
  [DllImport(Lib)] static extern int ft_positions_from_floats(float[] xyz, ulong count, int axes, double[] positions);
  [DllImport(Lib)] static extern int ft_positions_to_floats(double* positions, ulong count, int axes, float[] xyz);
  [DllImport(Lib)] static extern int ft_rotations_from_floats(float[] xyzw, ulong count, int axes, double[] wxyz);
  [DllImport(Lib)] static extern int ft_scene_create(ref SceneArrays arrays, out IntPtr scene);
  [DllImport(Lib)] static extern void ft_scene_destroy(IntPtr scene);
  [DllImport(Lib)] static extern int ft_avatar_create(ref AvatarArrays arrays, out IntPtr avatar);
  [DllImport(Lib)] static extern void ft_avatar_destroy(IntPtr avatar);
  [DllImport(Lib)] static extern int ft_query_create(IntPtr scene, IntPtr avatar, IntPtr options, out IntPtr query);
  [DllImport(Lib)] static extern int ft_query_step(IntPtr query, Pose* from, Pose* to);
  [DllImport(Lib)] static extern int ft_query_contacts(IntPtr query, [In, Out] Contact[] contacts, ulong capacity, out ulong required);
  [DllImport(Lib)] static extern void ft_query_destroy(IntPtr query);
  [DllImport(Lib)] static extern int ft_rotations_to_floats(double[] wxyz, ulong count, int axes, float[] xyzw);
  [DllImport(Lib, EntryPoint = "ft_positions_to_floats")]
  static extern int ft_array_to_floats(double[] positions, ulong count, int axes, float[] xyz);
  [DllImport(Lib)] static extern int ft_solid_create(IntPtr scene, IntPtr avatar, IntPtr options, out IntPtr solid);
  [DllImport(Lib)] static extern int ft_solid_follow(IntPtr solid, Pose* tracked, byte* isTracked, double dtS, ref SolidTick tick);
  [DllImport(Lib)] static extern int ft_solid_shown(IntPtr solid, double[] rotations, double[] translations, ulong capacity, out ulong required);
  [DllImport(Lib)] static extern int ft_solid_contacts(IntPtr solid, [In, Out] SolidContact[] contacts, ulong capacity, out ulong required);
  [DllImport(Lib)] static extern int ft_solid_reset(IntPtr solid);
  [DllImport(Lib)] static extern void ft_solid_destroy(IntPtr solid);

  IntPtr scene, avatar, query, solid;
  readonly int joints;
  readonly double[] rotations, translations;
  bool hasBegun;
  /// Of the last step, the earliest first; Step() says how many count.
  public readonly Contact[] contacts;
  /// Of the last Follow(): localRotation and localPosition of each joint, to draw; and where surfaces
  /// hold the body, of which contactCount of the tick count.
  public readonly float[] shownRotations, shownPositions;
  public SolidContact[] pushes = new SolidContact[16];

  static string TextAt(byte* text) {
    int length = 0;
    while (text[length] != 0) ++length;
    return Encoding.UTF8.GetString(text, length);
  }
  static void Must(int status) {
    if (status != 0) throw new InvalidOperationException(TextAt(ft_last_error()));
  }
  static double[] Positions(float[] xyz) {
    var positions = new double[xyz.Length];
    Must(ft_positions_from_floats(xyz, (ulong)(xyz.Length / 3), UnityAxes, positions));
    return positions;
  }

  /// vertices, triangles: of a level's collision mesh. parents: an earlier joint, or -1. offsets: the
  /// joints' localPosition at rest, x, y, z. One capsule per entry of lss, as Capsule() makes them,
  /// moving with joint lssLinks[i].
  public Foretouch(float[] vertices, int[] triangles, string[] names, int[] parents, float[] offsets,
                   Lss[] lss, int[] lssLinks) {
    joints = names.Length;
    rotations = new double[4 * joints];
    translations = new double[3 * joints];
    contacts = new Contact[joints];
    shownRotations = new float[4 * joints];
    shownPositions = new float[3 * joints];
    Must(ft_check_abi(2));
    try {
      MakeScene(vertices, triangles);
      MakeAvatar(names, parents, offsets, lss, lssLinks);
      Must(ft_query_create(scene, avatar, IntPtr.Zero, out query));
    } catch {
      Dispose();
      throw;
    }
  }

  void MakeScene(float[] vertices, int[] triangles) {
    fixed (double* positions = Positions(vertices)) fixed (int* indices = triangles) {
      var arrays = new SceneArrays {
        size = (uint)sizeof(SceneArrays), positions = positions, vertexCount = (ulong)(vertices.Length / 3),
        indices = (uint*)indices, triangleCount = (ulong)(triangles.Length / 3)
      };
      Must(ft_scene_create(ref arrays, out scene));
    }
  }

  void MakeAvatar(string[] names, int[] parents, float[] offsets, Lss[] lss, int[] lssLinks) {
    byte** texts = stackalloc byte*[joints];
    fixed (byte* text = Encoding.UTF8.GetBytes(string.Join("\0", names) + "\0"))
    fixed (double* offset = Positions(offsets)) fixed (int* parent = parents)
    fixed (Lss* capsule = lss) fixed (int* link = lssLinks) {
      byte* next = text;
      for (int j = 0; j < joints; ++j) {
        texts[j] = next;
        while (*next++ != 0) {}
      }
      var arrays = new AvatarArrays {
        size = (uint)sizeof(AvatarArrays), jointCount = (ulong)joints, names = texts, parents = parent,
        offsets = offset, lss = capsule, lssLinks = link, lssCount = (ulong)lss.Length
      };
      Must(ft_avatar_create(ref arrays, out avatar));
    }
  }

  /// From one end of a capsule's axis to the other, in its joint's frame.
  public static Lss Capsule(float[] fromXyz, float[] toXyz, double radius) {
    double[] from = Positions(fromXyz), to = Positions(toXyz);
    var lss = new Lss { radius = radius };
    for (int i = 0; i < 3; ++i) { lss.a[i] = from[i]; lss.b[i] = to[i]; }
    return lss;
  }

  void ReadPose(float[] xyzw, float[] xyz) {
    Must(ft_rotations_from_floats(xyzw, (ulong)joints, UnityAxes, rotations));
    Must(ft_positions_from_floats(xyz, (ulong)joints, UnityAxes, translations));
  }

  /// To where the joints are now (their localRotation and localPosition; roots: in the world) from
  /// where the last step ended. Returns how many of contacts there are. The first call only begins.
  public int Step(float[] xyzw, float[] xyz) {
    ReadPose(xyzw, xyz);
    fixed (double* rotation = rotations) fixed (double* translation = translations) {
      var pose = new Pose {
        size = (uint)sizeof(Pose), jointCount = (uint)joints, rotations = rotation, translations = translation
      };
      Must(ft_query_step(query, hasBegun ? null : &pose, &pose));
      hasBegun = true;
    }
    contacts[0].size = (uint)sizeof(Contact);
    Must(ft_query_contacts(query, contacts, (ulong)joints, out ulong count));
    return (int)count;
  }

  /// Shows the body as near to where its joints are tracked as surfaces let it: shownRotations,
  /// shownPositions and pushes. seconds: since the last call. Nothing that is shown passes through
  /// anything. tracked: per joint, false if its tracker is lost; null: none is.
  public SolidTick Follow(float[] xyzw, float[] xyz, double seconds, bool[] tracked = null) {
    if (solid == IntPtr.Zero) Must(ft_solid_create(scene, avatar, IntPtr.Zero, out solid));
    ReadPose(xyzw, xyz);
    var tick = new SolidTick { size = (uint)sizeof(SolidTick) };
    byte* flags = stackalloc byte[joints];
    for (int j = 0; j < joints; ++j) flags[j] = (byte)(tracked == null || tracked[j] ? 1 : 0);
    fixed (double* rotation = rotations) fixed (double* translation = translations) {
      var pose = new Pose {
        size = (uint)sizeof(Pose), jointCount = (uint)joints, rotations = rotation, translations = translation
      };
      Must(ft_solid_follow(solid, &pose, flags, seconds, ref tick));
    }
    ReadShown((int)tick.contactCount);
    return tick;
  }

  void ReadShown(int count) {
    Must(ft_solid_shown(solid, rotations, translations, (ulong)joints, out ulong all));
    Must(ft_rotations_to_floats(rotations, (ulong)joints, UnityAxes, shownRotations));
    Must(ft_array_to_floats(translations, (ulong)joints, UnityAxes, shownPositions));
    if (count > pushes.Length) pushes = new SolidContact[2 * count];
    pushes[0].size = (uint)sizeof(SolidContact);
    Must(ft_solid_contacts(solid, pushes, (ulong)pushes.Length, out all));
  }

  /// After tracking was lost, or a teleport: the next pose begins anew.
  public void Restart() {
    hasBegun = false;
    if (solid != IntPtr.Zero) Must(ft_solid_reset(solid));
  }

  /// Unity's coordinates of contact.pointScene, pointLink or normal.
  public static float[] ToUnity(double* xyz) {
    var converted = new float[3];
    Must(ft_positions_to_floats(xyz, 1, UnityAxes, converted));
    return converted;
  }

  public void Dispose() {
    ft_solid_destroy(solid);
    ft_query_destroy(query);
    ft_avatar_destroy(avatar);
    ft_scene_destroy(scene);
    solid = query = avatar = scene = IntPtr.Zero;
  }
}

#if FORETOUCH_TRY
static class Program {
  // The forearm of swing.c, a quarter turn towards the pole, which is at +z for Unity.
  static unsafe int Main() {
    var capsules = new[] { Foretouch.Capsule(new float[] { 0, 0, 0 }, new float[] { 0.3f, 0, 0 }, 0.04) };
    using (var body = new Foretouch(
               new float[] { 0.2f, 0, 0.2f, 0.2f, 2, 0.2f, 0.4f, 1, 0.4f }, new[] { 0, 1, 2 },
               new[] { "forearm" }, new[] { -1 }, new float[] { 0, 1, 0 }, capsules, new[] { 0 })) {
      float half = 0.5f * 1.5708f;
      var elbow = new float[] { 0, 1, 0 };
      body.Step(new float[] { 0, 0, 0, 1 }, elbow);
      int count = body.Step(new float[] { 0, -(float)Math.Sin(half), 0, (float)Math.Cos(half) }, elbow);
      if (count != 1 || body.contacts[0].verdict != Foretouch.Touches) return 1;
      fixed (double* normal = body.contacts[0].normal) {
        float[] n = Foretouch.ToUnity(normal);
        Console.WriteLine("contact at t = {0:F4}, {1:F2} mm from pole", body.contacts[0].toi,
                          1000 * body.contacts[0].separation);
        // From the pole, which is at +z, to the forearm.
        if (n[0] <= 0 || n[2] >= 0) return 1;
      }
      return StaysAtThePole(body, elbow) ? 0 : 1;
    }
  }

  // Into the pole, beyond it and back: it presses somewhere, and is back in the end.
  static bool StaysAtThePole(Foretouch body, float[] elbow) {
    var tick = new Foretouch.SolidTick();
    bool pressed = false, proven = true;
    for (int frame = 0; frame <= 180; ++frame) {
      float half = 0.5f * 1.5708f * (1 - Math.Abs(frame / 90f - 1));
      tick = body.Follow(new float[] { 0, -(float)Math.Sin(half), 0, (float)Math.Cos(half) }, elbow, 1 / 90.0);
      proven &= tick.isCertified == 1;
      pressed |= tick.state != Foretouch.Equal && tick.contactCount > 0 && body.pushes[0].push > 0;
    }
    return proven && pressed && tick.state == Foretouch.Equal;
  }
}
#endif
