// tools/inputs/npz_arrays.h: arrays of numbers and texts in numpy's own format: .npy files in a
// zip, stored or deflated, as numpy.savez() and savez_compressed() write them. Safe on hostile
// bytes. https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

struct NpzArray {
  std::vector<std::size_t> shape;  ///< Empty: a single value.
  std::vector<double> numbers;  ///< Rows before columns (C order), finite; empty if it has texts.
  std::vector<std::string> texts;  ///< UTF-8.
};

/// What is in a file. It decodes an array only when asked for it.
class NpzArrays {
 public:
  /// Errors say what a zip should not have; they name no file.
  static Result<NpzArrays> of(std::string bytes);

  [[nodiscard]] bool has(const std::string& name) const { return find(name) != nullptr; }
  [[nodiscard]] std::vector<std::string> names() const;
  /// Errors name the array: there is none, it is damaged or encrypted, of a type other than floats
  /// of 4 or 8 bytes, integers of 4 or 8 or texts, in the byte order of other machines, not finite,
  /// or larger than kMaxTableValues.
  [[nodiscard]] Result<NpzArray> array(const std::string& name) const;
  /// An array's file, header and values. Errors: those of array() that are about the zip.
  [[nodiscard]] Result<std::string> content(const std::string& name) const;
  /// Writes numbers, in C order, in place of those of an array's file, in its own type and order.
  /// Errors: its type is not a float.
  [[nodiscard]] static Result<Done> replaceNumbers(const std::vector<double>& numbers,
                                                   std::string& content);

 private:
  struct Entry {
    std::string name;  ///< Without ".npy".
    std::size_t begin = 0, packed = 0, unpacked = 0;
    std::uint32_t crc = 0;
    bool isDeflated = false, isEncrypted = false, isOtherwisePacked = false;
  };
  [[nodiscard]] const Entry* find(const std::string& name) const;
  [[nodiscard]] Result<std::string> contentOf(const Entry& entry) const;

  std::string bytes_;
  std::vector<Entry> entries_;
};

}  // namespace foretouch::tools
