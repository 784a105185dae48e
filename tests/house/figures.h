// tests/house/figures.h: compares the figures in documents with the measurement files
// (docs/measurements/). A document marks a figure right after it, and a table right before it:
//
//   64,116<!-- figure: oracle-contacts -->            a name in docs/measurements/figures.json
//   3.7 | 0.9 | 42 <!-- figures: mean p50 p99 -->     the last three numbers before the mark
//   <!-- table: accuracy/link -->                     all columns of table "link" in accuracy.json
//   <!-- table: view/view viewers added_p50_us -->    some columns
//
// figures.json gives the place of a name's value: a file, a table, the row whose columns match
// `where` (absent: the table has one row), a column; then value * factor / over, where `over` is
// another column of the row.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace foretouch::test {

class Measurements {
 public:
  /// `folder` has figures.json and the files it names.
  explicit Measurements(const std::string& folder);
  ~Measurements();

  /// Disagreements of a document with the measurements, one sentence each; counts the figures
  /// checked.
  std::vector<std::string> complaintsAbout(const std::string& text);

  /// Tables without a command that reproduces them, and names of figures.json that no checked
  /// document uses.
  [[nodiscard]] std::vector<std::string> complaintsAboutItself() const;

  [[nodiscard]] int figures() const { return figures_; }
  [[nodiscard]] int tables() const { return tables_; }

 private:
  struct Files;
  std::unique_ptr<Files> files_;
  std::set<std::string> used_;
  int figures_ = 0, tables_ = 0;
};

}  // namespace foretouch::test
