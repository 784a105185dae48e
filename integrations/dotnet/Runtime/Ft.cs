// Ft.cs: the library at hand, its errors as exceptions, and texts across the border.
using System;
using System.Text;

namespace Foretouch {
  /// <summary>What the library refuses, in its own words: file, place and expectation.</summary>
  public sealed class ForetouchException : Exception {
    /// <summary>One of FtStatus, and its word: "file-not-found".</summary>
    public readonly int Status;
    public readonly string StatusName;
    /// <summary>The joint, link, frame, triangle or body at fault; -1: none.</summary>
    public readonly long Index;
    internal ForetouchException(int status, string name, string message, long index) : base(message) {
      Status = status;
      StatusName = name;
      Index = index;
    }
  }

  public static unsafe partial class FtNative {
    /// <summary>libforetouch.so, or foretouch.dll.</summary>
    const string Library = "foretouch";
  }

  public static unsafe partial class Ft {
    static bool isChecked;

    /// <summary>The running library's: "0.1.0".</summary>
    public static string Version {
      get { CheckLibrary(); return TextAt(FtNative.ft_version()); }
    }

    /// <summary>Is the library there, for this machine, and not older than these sources? All that makes
    /// a handle asks.</summary>
    public static void CheckLibrary() {
      if (isChecked) return;
      if (IntPtr.Size != 8) throw new PlatformNotSupportedException("Foretouch needs a process of 64 bits, found 32");
      try {
        Must(FtNative.ft_check_abi(AbiVersion));
      } catch (DllNotFoundException reason) {
        throw new DllNotFoundException("Foretouch's native library was not found: expected libforetouch.so (Linux) or " +
            "foretouch.dll (Windows) where plugins are (Unity: Plugins/ of the package; else beside the program, or " +
            "in LD_LIBRARY_PATH). " + reason.Message, reason);
      }
      isChecked = true;
    }

    /// <summary>Throws what the last call of this thread says, unless it worked.</summary>
    public static void Must(int status) {
      if (status != FtStatus.Ok) Throw(status);
    }

    static void Throw(int status) {
      throw new ForetouchException(status, TextAt(FtNative.ft_status_name(status)), TextAt(FtNative.ft_last_error()),
                                   FtNative.ft_last_error_index());
    }

    /// <summary>A text of the library: UTF-8 up to its zero.</summary>
    public static string TextAt(byte* text) {
      if (text == null) return null;
      int length = 0;
      while (text[length] != 0) ++length;
      return Encoding.UTF8.GetString(text, length);
    }

    /// <summary>A text for the library, with its zero; null stays null.</summary>
    public static byte[] Utf8(string text) {
      if (text == null) return null;
      if (text.IndexOf('\0') >= 0) throw new ArgumentException("expected a text without NUL, found one in '" + text + "'");
      return Encoding.UTF8.GetBytes(text + "\0");
    }
  }

  /// <summary>Texts for a function that takes `const char* const*`: pinned while it runs.</summary>
  unsafe struct FtTexts {
    readonly byte[] bytes;
    readonly int[] begins;
    internal FtTexts(string[] texts) {
      bytes = null;
      begins = null;
      if (texts == null) return;
      begins = new int[texts.Length];
      var all = new System.IO.MemoryStream();
      for (int i = 0; i < texts.Length; ++i) {
        if (texts[i] == null) throw new ArgumentNullException("name " + i);
        begins[i] = (int)all.Length;
        byte[] one = Ft.Utf8(texts[i]);
        all.Write(one, 0, one.Length);
      }
      if (all.Length == 0) all.WriteByte(0);
      bytes = all.ToArray();
    }
    internal byte[] Bytes { get { return bytes; } }
    /// <summary>Where each begins, if the first one does at `first`.</summary>
    internal IntPtr[] Places(byte* first) {
      if (begins == null) return null;
      var places = new IntPtr[Math.Max(1, begins.Length)];
      for (int i = 0; i < begins.Length; ++i) places[i] = (IntPtr)(first + begins[i]);
      return places;
    }
  }
}
