// FtRobot.cs: robots that move by joint coordinates, and edges of their plans.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  public sealed unsafe partial class FtRobot {
    /// <summary>One joint per joint of the avatar; `names`, the coordinates', may be null.</summary>
    public static FtRobot Create(FtAvatar avatar, ReadOnlySpan<FtRobotJoint> joints, string[] names = null) {
      Ft.CheckLibrary();
      var texts = new FtTexts(names);
      FtRobot robot;
      fixed (FtRobotJoint* first = &MemoryMarshal.GetReference(joints))
      fixed (byte* text = texts.Bytes) fixed (IntPtr* places = texts.Places(text))
        Ft.Must(FtNative.ft_robot_create(avatar, first, (ulong)joints.Length, (byte**)places, out robot));
      return robot;
    }

    public static FtRobot LoadUrdf(string path, FtUrdfOptions? options = null) {
      Ft.CheckLibrary();
      var given = options.GetValueOrDefault();
      FtRobot robot;
      fixed (byte* text = Ft.Utf8(path))
        Ft.Must(FtNative.ft_robot_create_from_urdf(text, options.HasValue ? &given : null, out robot));
      return robot;
    }

    /// <summary>Its links, as an avatar.</summary>
    public FtAvatar Avatar() {
      FtAvatar avatar;
      Ft.Must(FtNative.ft_robot_avatar(this, out avatar));
      return avatar;
    }

    public int CoordinateCount {
      get {
        ulong count;
        Ft.Must(FtNative.ft_robot_coordinate_count(this, out count));
        return (int)count;
      }
    }

    public void Pose(ReadOnlySpan<double> q, FtPoseBuffer into) {
      ulong joints;
      fixed (double* first = &MemoryMarshal.GetReference(q))
        Ft.Must(FtNative.ft_robot_pose(this, first, (ulong)q.Length, into.Native->rotations, into.Native->translations,
                                       (ulong)into.JointCount, out joints));
      GC.KeepAlive(into);
    }

    /// <summary>Which own links are asked, by configurations within the limits.</summary>
    public FtPairRules PairRules(FtRobotPairOptions? options = null) {
      var given = options.GetValueOrDefault();
      FtPairRules rules;
      Ft.Must(FtNative.ft_pair_rules_create_of_robot(this, options.HasValue ? &given : null, out rules));
      return rules;
    }
  }

  public sealed unsafe partial class FtEdges {
    int coordinates;

    public static FtEdges Create(FtRobot robot, FtScene scene, FtEdgeOptions? options = null) {
      var given = options.GetValueOrDefault();
      FtEdges edges;
      Ft.Must(FtNative.ft_edges_create(robot, scene, options.HasValue ? &given : null, out edges));
      edges.coordinates = robot.CoordinateCount;
      return edges;
    }

    /// <summary>From each configuration of q0 to that of q1, one after the other; an answer per edge.</summary>
    public void Answer(ReadOnlySpan<double> q0, ReadOnlySpan<double> q1, Span<FtEdge> answers) {
      if (q0.Length != answers.Length * coordinates || q1.Length != q0.Length)
        throw new ArgumentException("expected " + coordinates + " numbers per edge in q0 and q1, and " + answers.Length +
                                    " edges; found " + q0.Length + " and " + q1.Length);
      if (answers.Length == 0) return;
      answers[0].size = (uint)sizeof(FtEdge);
      fixed (double* from = &MemoryMarshal.GetReference(q0), to = &MemoryMarshal.GetReference(q1))
      fixed (FtEdge* first = &MemoryMarshal.GetReference(answers))
        Ft.Must(FtNative.ft_edges_answer(this, from, to, (ulong)answers.Length, (ulong)coordinates, first));
    }

    /// <summary>How far the way from each configuration to the next is free.</summary>
    public FtPath AnswerPath(ReadOnlySpan<double> q) {
      if (q.Length % coordinates != 0)
        throw new ArgumentException("q: expected " + coordinates + " numbers per configuration, found " + q.Length);
      var path = new FtPath { size = (uint)sizeof(FtPath) };
      fixed (double* first = &MemoryMarshal.GetReference(q))
        Ft.Must(FtNative.ft_edges_answer_path(this, first, (ulong)(q.Length / coordinates), (ulong)coordinates, &path));
      return path;
    }

    /// <summary>What edge `index` of the last list meets first; other.link -1: no own link.</summary>
    public FtContact Contact(int index, out FtOtherLink other) {
      var contact = new FtContact { size = (uint)sizeof(FtContact) };
      FtOtherLink own = new FtOtherLink();
      Ft.Must(FtNative.ft_edges_contact(this, (ulong)index, &contact, &own));
      other = own;
      return contact;
    }
  }
}
