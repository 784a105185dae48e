// Check.cs: a test says what it expects; the number of those that fail is the exit status.
using System;

static class Check {
  static int failed, held;
  internal static void That(bool holds, string what) {
    if (holds) {
      ++held;
      return;
    }
    ++failed;
    Console.WriteLine("FAILED: " + what);
  }
  internal static void Equal<T>(T found, T expected, string what) {
    That(Equals(found, expected), what + ": expected " + expected + ", found " + found);
  }
  internal static void Has(string text, string part) {
    That(text != null && text.Contains(part), "expected \"" + part + "\" in \"" + text + "\"");
  }
  internal static T Throws<T>(Action action, string part) where T : Exception {
    try {
      action();
    } catch (T reason) {
      Has(reason.Message, part);
      return reason;
    }
    That(false, "expected " + typeof(T).Name + " with \"" + part + "\"");
    return null;
  }
  internal static int Done(string name) {
    Console.WriteLine("{0}: {1} checks hold, {2} fail", name, held, failed);
    return failed == 0 && held > 0 ? 0 : 1;
  }
}
