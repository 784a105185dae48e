// tools/feet/npz_file.h: arrays in numpy's own format: .npy files (version 1.0) in a zip that only
// stores. https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace foretouch::tools {

/// Rows before columns (C order), little-endian.
class NpzFile {
 public:
  /// `shape`: has as many elements as `values`.
  void add(const std::string& name, const std::vector<float>& values,
           const std::vector<std::size_t>& shape);
  void add(const std::string& name, const std::vector<double>& values);
  void add(const std::string& name, const std::vector<std::int64_t>& values);
  /// 0 or 1.
  void addBools(const std::string& name, const std::vector<std::uint8_t>& values,
                const std::vector<std::size_t>& shape);
  /// UTF-8 texts as numpy's bytes: of fixed length, padded by zeros.
  void add(const std::string& name, const std::vector<std::string>& texts);

  /// An array's file as it is, header and values.
  void addContent(const std::string& name, const std::string& content);

  /// The whole file. It must be below 4 GiB: a larger one needs zip64, and is refused (empty).
  [[nodiscard]] std::string bytes() const;

 private:
  void addArray(const std::string& name, const std::string& type,
                const std::vector<std::size_t>& shape, const std::string& data);

  struct Entry {
    std::string name;
    std::uint32_t crc = 0, size = 0;
    std::uint64_t offset = 0;
  };
  std::vector<Entry> entries_;
  std::string file_;
};

}  // namespace foretouch::tools
