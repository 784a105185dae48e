// Prints how the structs of Foretouch.cs and ForetouchWorld.cs lie in memory, as layout_test.cpp
// writes it down of those of C.
using System;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Text;

static class Layouts {
  static string SnakeCase(string name) {
    var words = new StringBuilder();
    foreach (char c in name) {
      if (char.IsUpper(c) && words.Length > 0) words.Append('_');
      words.Append(char.ToLowerInvariant(c));
    }
    return words.ToString() == "obj" ? "object" : words.ToString();
  }

  static void Main() {
    const BindingFlags all = BindingFlags.Public | BindingFlags.NonPublic;
    foreach (Type type in typeof(Foretouch).GetNestedTypes(all)) {
      if (!type.IsValueType || type.IsEnum) continue;
      string name = "ft_" + SnakeCase(type.Name);
      Console.WriteLine("static_assert(sizeof({0}) == {1});", name, Marshal.SizeOf(type));
      foreach (FieldInfo field in type.GetFields(all | BindingFlags.Instance)) {
        if (char.IsDigit(field.Name[field.Name.Length - 1])) continue;  // of an array, but the first
        if (field.Name == "size") continue;
        Console.WriteLine("AT({0}, {1}, {2});", name, SnakeCase(field.Name), Marshal.OffsetOf(type, field.Name));
      }
    }
  }
}
