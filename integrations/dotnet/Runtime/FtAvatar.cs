// FtAvatar.cs: joints, and the LSS (capsules) that move with them; and clips of their poses.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  public partial struct FtLss {
    public FtLss(FtVector a, FtVector b, double radius) { this.a = a; this.b = b; this.radius = radius; }
  }

  public sealed unsafe partial class FtAvatar {
    string[] names;
    int count;

    /// <summary>`parents`: an earlier joint's, or -1. `offsets`: x, y, z per joint in its parent's frame;
    /// empty `rotations` (w, x, y, z): none. `lssLinks`: the joint that each LSS moves with.</summary>
    public static FtAvatar Create(string[] names, ReadOnlySpan<int> parents, ReadOnlySpan<double> offsets,
                                  ReadOnlySpan<double> rotations, ReadOnlySpan<FtLss> lss, ReadOnlySpan<int> lssLinks) {
      Ft.CheckLibrary();
      var texts = new FtTexts(names);
      MustFit(names.Length, parents.Length, offsets.Length, rotations.Length, lss.Length, lssLinks.Length);
      fixed (byte* text = texts.Bytes) fixed (IntPtr* places = texts.Places(text))
      fixed (int* parent = &MemoryMarshal.GetReference(parents), link = &MemoryMarshal.GetReference(lssLinks))
      fixed (double* offset = &MemoryMarshal.GetReference(offsets), rotation = &MemoryMarshal.GetReference(rotations))
      fixed (FtLss* first = &MemoryMarshal.GetReference(lss)) {
        var arrays = new FtAvatarArrays {
          size = (uint)sizeof(FtAvatarArrays), jointCount = (ulong)names.Length, names = (byte**)places, parents = parent,
          offsets = offset, rotations = rotations.Length == 0 ? null : rotation, lss = first, lssLinks = link,
          lssCount = (ulong)lss.Length
        };
        FtAvatar avatar;
        Ft.Must(FtNative.ft_avatar_create(&arrays, out avatar));
        return avatar;
      }
    }

    static void MustFit(int names, int parents, int offsets, int rotations, int lss, int links) {
      if (parents != names || offsets != 3 * names || (rotations != 0 && rotations != 4 * names) || links != lss)
        throw new ArgumentException("expected per joint a parent, 3 numbers of offsets and 4 of rotations, or none, and a " +
                                    "link per LSS; found " + names + " names, " + parents + " parents, " + offsets + ", " +
                                    rotations + ", and " + links + " links of " + lss + " LSS");
    }

    /// <summary>An avatar file. With `meshes`, the triangles that it refers to are read, too.</summary>
    public static FtAvatar Load(string path, FtImportOptions? meshes = null) {
      Ft.CheckLibrary();
      var given = meshes.GetValueOrDefault();
      FtAvatar avatar;
      fixed (byte* text = Ft.Utf8(path))
        Ft.Must(FtNative.ft_avatar_create_from_file(text, meshes.HasValue ? &given : null, out avatar));
      return avatar;
    }

    /// <summary>The same from a text in memory, a TextAsset, say; errors call it `name`.</summary>
    public static FtAvatar Parse(string json, string name) {
      Ft.CheckLibrary();
      byte[] bytes = Ft.Utf8(json);
      FtAvatar avatar;
      fixed (byte* text = bytes) fixed (byte* called = Ft.Utf8(name))
        Ft.Must(FtNative.ft_avatar_create_from_text(text, (ulong)bytes.Length - 1, called, out avatar));
      return avatar;
    }

    public int JointCount {
      get {
        if (count == 0) {
          ulong joints;
          Ft.Must(FtNative.ft_avatar_joint_count(this, out joints));
          count = (int)joints;
        }
        return count;
      }
    }

    /// <summary>Makes a text the first time, and none after that.</summary>
    public string JointName(int joint) {
      if (names == null) names = new string[JointCount];
      if (joint >= 0 && joint < names.Length && names[joint] != null) return names[joint];
      byte* text;
      Ft.Must(FtNative.ft_avatar_joint_name(this, joint, &text));
      return names[joint] = Ft.TextAt(text);
    }

    /// <summary>-1: a root.</summary>
    public int JointParent(int joint) {
      int parent;
      Ft.Must(FtNative.ft_avatar_joint_parent(this, joint, out parent));
      return parent;
    }

    public int FindJoint(string name) {
      int joint;
      fixed (byte* text = Ft.Utf8(name)) Ft.Must(FtNative.ft_avatar_find_joint(this, text, out joint));
      return joint;
    }
  }

  public sealed unsafe partial class FtClip {
    /// <summary>BVH, or the first animation of a model.</summary>
    public static FtClip Load(string path, FtAvatar avatar, FtClipOptions? options = null) {
      Ft.CheckLibrary();
      var given = options.GetValueOrDefault();
      FtClip clip;
      fixed (byte* text = Ft.Utf8(path))
        Ft.Must(FtNative.ft_clip_create_from_file(text, avatar, options.HasValue ? &given : null, out clip));
      return clip;
    }
  }
}
