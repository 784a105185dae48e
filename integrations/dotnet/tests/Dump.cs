// Dump.cs: every field of a struct as text, doubles as their bits: as generator/c_tests.py writes it in C.
using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Reflection;
using System.Text;
using Foretouch;

sealed class Dump {
  readonly TextWriter to;
  readonly Dictionary<Type, FieldInfo[]> fields = new Dictionary<Type, FieldInfo[]>();
  readonly Dictionary<Type, string> names = new Dictionary<Type, string>();
  internal readonly Dictionary<string, int> Counts = new Dictionary<string, int>();

  internal Dump(TextWriter to) { this.to = to; }

  static string SnakeCase(string name) {
    var words = new StringBuilder();
    foreach (char c in name) {
      if (char.IsUpper(c) && words.Length > 0) words.Append('_');
      words.Append(char.ToLowerInvariant(c));
    }
    return words.ToString();
  }

  internal void Each<T>(ReadOnlySpan<T> list) where T : struct {
    for (int i = 0; i < list.Length; ++i) One(list[i]);
  }

  internal void One<T>(T value) where T : struct {
    string name;
    if (!names.TryGetValue(typeof(T), out name)) names[typeof(T)] = name = SnakeCase(typeof(T).Name);
    int count;
    Counts.TryGetValue(name, out count);
    Counts[name] = count + 1;
    to.Write(name);
    Fields(value);
    to.Write('\n');
  }

  internal void Pose(FtPoseBuffer pose) {
    to.Write("pose");
    foreach (double number in pose.Rotations) Bits(number);
    foreach (double number in pose.Translations) Bits(number);
    to.Write('\n');
  }

  void Fields(object value) {
    FieldInfo[] own;
    Type type = value.GetType();
    if (!fields.TryGetValue(type, out own))
      fields[type] = own = type.GetFields(BindingFlags.Public | BindingFlags.Instance);
    foreach (FieldInfo field in own) {
      object one = field.GetValue(value);
      if (one is double) Bits((double)one);
      else if (field.FieldType.IsPrimitive) to.Write(" " + Convert.ToString(one, CultureInfo.InvariantCulture));
      else Fields(one);
    }
  }

  void Bits(double number) {
    to.Write(' ');
    to.Write(BitConverter.DoubleToInt64Bits(number).ToString("x16", CultureInfo.InvariantCulture));
  }
}
