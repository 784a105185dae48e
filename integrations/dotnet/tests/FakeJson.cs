// FakeJson.cs: UnityEngine.JsonUtility, as far as Runtime/Unity uses it: public fields by their names, of classes,
// structs, arrays, texts and numbers; what the text does not have keeps its value, and what no field has is passed over.
using System;
using System.Collections.Generic;
using System.Globalization;
using System.Reflection;
using System.Text;

namespace UnityEngine {
  public static class JsonUtility {
    public static T FromJson<T>(string json) { return (T)Filled(typeof(T), new FakeJson(json).Whole()); }

    static object Filled(Type type, object said) {
      if (type == typeof(string)) return said;
      if (type.IsPrimitive) return Convert.ChangeType(said, type, CultureInfo.InvariantCulture);
      if (type.IsArray) {
        var list = (List<object>)said;
        Array array = Array.CreateInstance(type.GetElementType(), list.Count);
        for (int i = 0; i < list.Count; ++i) array.SetValue(Filled(type.GetElementType(), list[i]), i);
        return array;
      }
      object made = Activator.CreateInstance(type);
      foreach (KeyValuePair<string, object> one in (Dictionary<string, object>)said) {
        FieldInfo field = type.GetField(one.Key);
        if (field != null) field.SetValue(made, Filled(field.FieldType, one.Value));
      }
      return made;
    }
  }

  /// JSON as dictionaries, lists, texts and doubles; null for null.
  public sealed class FakeJson {
    readonly string text;
    int at;
    public FakeJson(string text) { this.text = text; }

    public object Whole() {
      object value = Value();
      if (Next() != '\0') throw new FormatException("more than one value");
      return value;
    }

    char Next() {
      while (at < text.Length && char.IsWhiteSpace(text[at])) ++at;
      return at < text.Length ? text[at] : '\0';
    }
    void Take(char expected) {
      if (Next() != expected) throw new FormatException("expected '" + expected + "' at " + at);
      ++at;
    }

    object Value() {
      switch (Next()) {
        case '{': return Members();
        case '[': return Elements();
        case '"': return Text();
        default: return Word();
      }
    }

    Dictionary<string, object> Members() {
      var members = new Dictionary<string, object>();
      Take('{');
      while (Next() != '}') {
        string key = Text();
        Take(':');
        members.Add(key, Value());
        if (Next() != '}') Take(',');
      }
      ++at;
      return members;
    }

    List<object> Elements() {
      var elements = new List<object>();
      Take('[');
      while (Next() != ']') {
        elements.Add(Value());
        if (Next() != ']') Take(',');
      }
      ++at;
      return elements;
    }

    string Text() {
      Take('"');
      var found = new StringBuilder();
      for (; text[at] != '"'; ++at) {
        if (text[at] == '\\') ++at;  // quotes and backslashes alone
        found.Append(text[at]);
      }
      ++at;
      return found.ToString();
    }

    object Word() {
      int begin = at;
      while (at < text.Length && ",]} \n\t\r".IndexOf(text[at]) < 0) ++at;
      string word = text.Substring(begin, at - begin);
      return word == "null" ? null : (object)double.Parse(word, CultureInfo.InvariantCulture);
    }
  }
}
