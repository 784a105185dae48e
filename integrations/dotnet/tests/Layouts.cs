// Layouts.cs: how the structs and functions are declared in C#, by reflection, in the words of C: for
// comparison with what the C compiler says (generator/c_tests.py) and with tests/prototypes.py.
using System;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Text;
using Foretouch;

static class Layouts {
  static string SnakeCase(string name) {
    var words = new StringBuilder();
    for (int i = 0; i < name.Length; ++i) {
      if (i > 0 && (char.IsUpper(name[i]) || char.IsDigit(name[i]))) words.Append('_');
      words.Append(char.ToLowerInvariant(name[i]));
    }
    return words.ToString();
  }

  /// An array of C is a struct of as many here: what they are, and how many.
  static Type Element(Type type, out int count) {
    count = 1;
    bool isArray = type == typeof(FtVector) || type == typeof(FtRotation) || type == typeof(FtMatrix) || type.Name.Contains("Of");
    if (!isArray) return type;
    FieldInfo[] fields = type.GetFields(BindingFlags.Public | BindingFlags.Instance);
    count = fields.Length;
    return fields[0].FieldType;
  }

  static string Word(Type type) {
    if (type.IsPointer || type == typeof(IntPtr)) return "pointer";
    if (type == typeof(int)) return "int";
    if (type == typeof(uint)) return "uint";
    if (type == typeof(long)) return "long";
    if (type == typeof(ulong)) return "ulong";
    if (type == typeof(double)) return "double";
    if (type == typeof(float)) return "float";
    if (type == typeof(byte)) return "byte";
    return SnakeCase(type.Name);
  }

  static int SizeOf(Type type) { return type.IsPointer ? IntPtr.Size : Marshal.SizeOf(type); }

  static void PrintStruct(Type type) {
    string name = SnakeCase(type.Name);
    Console.WriteLine("{0} size {1}", name, Marshal.SizeOf(type));
    foreach (FieldInfo field in type.GetFields(BindingFlags.Public | BindingFlags.Instance)) {
      int count;
      Type element = Element(field.FieldType, out count);
      Console.WriteLine("{0}.{1} {2} {3} x{4} {5}", name, SnakeCase(field.Name), Marshal.OffsetOf(type, field.Name),
                        SizeOf(field.FieldType), count, Word(element));
    }
  }

  /// A handle is one, also in ft_*_destroy(); the address of a number or handle, or of a struct, is a pointer.
  static string Parameter(ParameterInfo parameter) {
    Type type = parameter.ParameterType;
    if (type.IsByRef || type.IsPointer) return "pointer";
    if (type == typeof(IntPtr) || typeof(FtHandle).IsAssignableFrom(type)) return "handle";
    return Word(type);
  }

  static int Main(string[] arguments) {
    if (arguments[0] == "structs") {
      foreach (Type type in typeof(FtNative).Assembly.GetTypes())
        if (type.IsValueType && type.IsPublic && type.Name.StartsWith("Ft") && type.GetField("size") != null || IsPlain(type))
          PrintStruct(type);
      return 0;
    }
    foreach (MethodInfo method in typeof(FtNative).GetMethods(BindingFlags.Public | BindingFlags.Static | BindingFlags.DeclaredOnly))
      Console.WriteLine("{0} {1}({2})", Word(method.ReturnType) == "void" ? "void" : Word(method.ReturnType), method.Name,
                        string.Join(", ", method.GetParameters().Select(Parameter).ToArray()));
    return 0;
  }

  /// Of the library's structs without a size: all but those that are arrays in C.
  static bool IsPlain(Type type) {
    int count;
    return type.IsValueType && type.IsPublic && type.Name.StartsWith("Ft") && type.GetField("size") == null &&
           Element(type, out count) == type;
  }
}
