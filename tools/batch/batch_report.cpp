#include "tools/batch/batch_report.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "tools/html_text.h"

namespace foretouch::tools {
namespace {

constexpr char kHead[] = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{0}</title><style>
body {{ font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 76em; padding: 0 1em; }}
table {{ border-collapse: collapse; width: 100%; }}
th, td {{ border-bottom: 1px solid #ccc; padding: .25em .6em; text-align: left; }}
th {{ position: sticky; top: 0; background: #fff; }}
td.n, th.n {{ text-align: right; font-variant-numeric: tabular-nums; }}
tr.failed td {{ background: #fde8e8; }} tr.absent td {{ background: #f3f3f3; }}
td.o {{ color: #555; }}
@media (prefers-color-scheme: dark) {{ body, th {{ background: #16181c; color: #e6e6e6; }}
a {{ color: #8ab4ff; }} td.o {{ color: #aaa; }} th, td {{ border-color: #444; }}
tr.failed td {{ background: #4a2020; }} tr.absent td {{ background: #26292f; }} }}
</style></head><body><h1>{0}</h1>
<p>{1} jobs: {2} done, {3} failed, {4} not done.</p>
)";

/// The text on one line.
std::string forPage(std::string_view text) {
  std::string safe = inHtml(text);
  std::replace_if(
      safe.begin(), safe.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return safe;
}

double touchesOf(const BatchRow& row) {
  return row.numberOf("touches");
}

double shareOf(const BatchRow& row) {
  const double steps = row.numberOf("steps");
  return steps > 0.0 ? row.numberOf("steps_with_contact") / steps : 0.0;
}

/// Less: earlier on the page.
auto rankOf(const BatchRow& row, BatchKind kind) {
  const int group = !row.record ? 1 : (row.record->isDone ? 2 : 0);
  const bool isOfFeet = kind == BatchKind::Feet;
  const double worst = std::max(row.numberOf("worst_slide"), row.numberOf("deepest"));
  return std::make_tuple(group, isOfFeet ? -worst : -touchesOf(row),
                         isOfFeet ? -row.numberOf("slides") : -shareOf(row), -row.numberOf("kept"),
                         row.number);
}

/// A column of numbers: what it is called, and where it is in the summary.
struct Column {
  const char *title, *key;
  double factor = 1.0;  ///< Other than 1: metres, shown in millimetres.
};

const std::vector<Column>& columnsOf(BatchKind kind) {
  static const std::vector<Column> replays{{"steps", "steps"},
                                           {"with contact", "steps_with_contact"},
                                           {"touches", "touches"},
                                           {"missed by poses", "touches_missed"},
                                           {"of the ground", "touches_ground"},
                                           {"start in contact", "starts_in_contact"},
                                           {"undecided", "undecided"}};
  static const std::vector<Column> feet{{"poses", "poses"},
                                        {"touches", "touches"},
                                        {"slide", "slides"},
                                        {"worst slide, mm", "worst_slide", 1e3},
                                        {"sink in", "sinks"},
                                        {"deepest, mm", "deepest", 1e3},
                                        {"skating ratio", "skating_ratio"}};
  return kind == BatchKind::Feet ? feet : replays;
}

std::string cellOf(const BatchRow& row, const Column& column) {
  if (column.factor == 1.0) return forPage(row.value(column.key));
  return fmt::format("{:.1f}", column.factor * row.numberOf(column.key));
}

std::string fileOfOption(const BatchRow& row, const char* name) {
  const JobOption* const option = row.job->find(name);
  return option == nullptr || option->texts.empty() ? "" : option->texts.front();
}

std::string otherOptions(const BatchRow& row) {
  std::string all;
  for (const auto& option : row.job->options) {
    if (option->name == "--scene" || option->name == "--avatar" || option->name == "--motion") {
      continue;
    }
    all += (all.empty() ? "" : " ") + option->name;
    for (const std::string& text : option->texts) all += " " + text;
  }
  return all;
}

std::string linkTo(const BatchRow& row, const BatchReportPlaces& places, const char* ending,
                   const char* word) {
  return fmt::format("<a href=\"{}/{}\">{}</a>", forPage(places.results),
                     ResultFolder::placeOf(row.name, ending), word);
}

std::string rowOf(const BatchRow& row, const BatchReportPlaces& places, BatchKind kind) {
  const bool isDone = row.record && row.record->isDone;
  std::string text =
      fmt::format("<tr class=\"{}\"><td class=\"n\">{}</td><td>{}</td><td>{}</td><td>{}</td>",
                  row.state(), row.number, forPage(fileOfOption(row, "--motion")),
                  forPage(fileOfOption(row, "--scene")), forPage(fileOfOption(row, "--avatar")));
  if (isDone) {
    for (const Column& column : columnsOf(kind)) {
      text += fmt::format("<td class=\"n\">{}</td>", cellOf(row, column));
    }
  } else {
    text += fmt::format("<td colspan=\"7\">{}</td>",
                        forPage(row.record ? row.record->error : std::string("not done")));
  }
  text += fmt::format("<td class=\"o\">{}</td><td>", forPage(otherOptions(row)));
  if (isDone) text += linkTo(row, places, endingOf(kind), "results");
  if (row.hasReport)
    text += " " + linkTo(row, places, ".html", kind == BatchKind::Feet ? "plot" : "report");
  return text + "</td></tr>\n";
}

}  // namespace

std::string batchReport(const BatchTable& table, const BatchReportPlaces& places, BatchKind kind) {
  std::vector<const BatchRow*> rows;
  for (const BatchRow& row : table.rows) rows.push_back(&row);
  std::sort(rows.begin(), rows.end(), [&](const BatchRow* x, const BatchRow* y) {
    return rankOf(*x, kind) < rankOf(*y, kind);
  });
  std::string page = fmt::format(kHead, forPage(places.manifest), rows.size(), table.done,
                                 table.failed, table.absent);
  page += "<table><thead><tr><th class=\"n\">job</th><th>motion</th><th>scene</th><th>avatar</th>";
  for (const Column& column : columnsOf(kind)) {
    page += fmt::format("<th class=\"n\">{}</th>", column.title);
  }
  page += "<th>options</th><th></th></tr></thead><tbody>\n";
  for (const BatchRow* const row : rows) page += rowOf(*row, places, kind);
  return page + "</tbody></table></body></html>\n";
}

}  // namespace foretouch::tools
