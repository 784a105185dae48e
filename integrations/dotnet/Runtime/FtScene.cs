// FtScene.cs: static triangles, from arrays or from a file.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  public sealed unsafe partial class FtScene {
    string[] names;

    /// <summary>Of x, y, z per vertex in W, and three indices per triangle; empty `objects`: all are of
    /// object 0; `objectNames` may be null.</summary>
    public static FtScene Create(ReadOnlySpan<double> positions, ReadOnlySpan<int> indices,
                                 ReadOnlySpan<int> objects = default(ReadOnlySpan<int>), string[] objectNames = null) {
      Ft.CheckLibrary();
      var texts = new FtTexts(objectNames);
      if (positions.Length % 3 != 0 || indices.Length % 3 != 0)
        throw new ArgumentException("expected three numbers per vertex and three indices per triangle, found " +
                                    positions.Length + " and " + indices.Length);
      if (objects.Length != 0 && objects.Length != indices.Length / 3)
        throw new ArgumentException("expected an object per triangle, " + indices.Length / 3 + ", found " + objects.Length);
      fixed (double* position = &MemoryMarshal.GetReference(positions))
      fixed (int* index = &MemoryMarshal.GetReference(indices), one = &MemoryMarshal.GetReference(objects))
      fixed (byte* text = texts.Bytes) fixed (IntPtr* places = texts.Places(text)) {
        var arrays = new FtSceneArrays {
          size = (uint)sizeof(FtSceneArrays), positions = position, vertexCount = (ulong)(positions.Length / 3),
          indices = (uint*)index, triangleCount = (ulong)(indices.Length / 3), objects = objects.Length == 0 ? null : one,
          objectNames = (byte**)places, objectCount = objectNames == null ? 0 : (ulong)objectNames.Length
        };
        if (objects.Length != 0 && objectNames == null) {
          foreach (int each in objects) arrays.objectCount = Math.Max(arrays.objectCount, (ulong)Math.Max(0, each) + 1);
        }
        FtScene scene;
        Ft.Must(FtNative.ft_scene_create(&arrays, out scene));
        return scene;
      }
    }

    /// <summary>OBJ, PLY, STL, glTF, FBX, ...: where foretouch-import is beside the library (Linux).</summary>
    public static FtScene Load(string path, FtImportOptions? options = null) {
      Ft.CheckLibrary();
      var given = options.GetValueOrDefault();
      FtScene scene;
      fixed (byte* text = Ft.Utf8(path))
        Ft.Must(FtNative.ft_scene_create_from_file(text, options.HasValue ? &given : null, out scene));
      return scene;
    }

    /// <summary>Makes a text the first time, and none after that.</summary>
    public string ObjectName(int index) {
      if (names == null) names = new string[GetInfo().objectCount];
      if (index >= 0 && index < names.Length && names[index] != null) return names[index];
      byte* text;
      Ft.Must(FtNative.ft_scene_object_name(this, index, &text));
      return names[index] = Ft.TextAt(text);
    }
  }
}
