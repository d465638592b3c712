// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ostream>
#include <utility>

#include "cli/commands.h"
#include "cli/json_text.h"
#include "cli/run_cli.h"
#include "cli/trajectory_overview.h"

namespace gmsim::cli {
namespace {

using io::TrajectoryReader;

std::string counted(std::int64_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// Text in a column of its own, behind the name of what it says.
void line(std::ostream& out, std::string_view name, std::string_view text) {
  out << fmt::format("{:<10} {}\n", name, text);
}

bool is_part(const Session& session) {
  return session.options.file.file.extension() == ".part";
}

std::string state_of(const Session& session, const TrajectoryReader& reader) {
  const std::string& ending = reader.summary().ending;
  if (reader.summary().complete && (ending.empty() || ending == "finished")) return "complete";
  if (reader.summary().complete) return ending;
  return is_part(session) ? "going on, or cut short" : "recovered from a run that was cut short";
}

void print_frames(Session& session, const TrajectoryReader& reader) {
  const auto times = reader.times();
  const auto steps = reader.steps();
  line(session.out, "run", state_of(session, reader));
  line(session.out, "frames",
       times.empty() ? "none"
                     : fmt::format("{}, from {:.6g} s to {:.6g} s (steps {} to {})", times.size(),
                                   times.front(), times.back(), steps.front(), steps.back()));
}

std::string mesh_text(const TrajectoryOverview::Counts& counts) {
  std::vector<std::string> kinds;
  for (const auto& [kind, count] : counts.kinds)
    kinds.push_back(fmt::format("{} {}", count, cell_name(kind, count)));
  return fmt::format("{}, {}", counted(counts.points, "point", "points"),
                     kinds.empty() ? "no cells" : fmt::format("{}", fmt::join(kinds, ", ")));
}

void print_meshes(Session& session, int dimension, const TrajectoryOverview& overview) {
  if (overview.epochs.empty()) return;
  line(session.out, "mesh",
       fmt::format("{}D, {}", dimension, mesh_text(overview.epochs.front())));
  if (overview.epochs.size() > 1)
    line(session.out, "",
         fmt::format("changes {}; at the end {}",
                     counted(std::ssize(overview.epochs) - 1, "time", "times"),
                     mesh_text(overview.epochs.back())));
  const auto& box = overview.box;
  line(session.out, "box",
       fmt::format("x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z {:.6g} to {:.6g} m (all frames)",
                   box[0].low, box[0].high, box[1].low, box[1].high, box[2].low, box[2].high));
}

const char* place_text(io::FieldPlace place) {
  switch (place) {
    case io::FieldPlace::Point: return "point";
    case io::FieldPlace::Cell: return "cell";
    case io::FieldPlace::Frame: return "frame";
    case io::FieldPlace::Orbit: return "orbit";
  }
  return "";
}

std::string range_text(const TrajectoryOverview::Field& field) {
  if (!field.range) return field.not_finite > 0 ? "no finite value" : "no values";
  return fmt::format("{}{:.6g} to {:.6g}", field.description.components == 3 ? "length " : "",
                     field.range->low, field.range->high);
}

void print_fields(Session& session, const TrajectoryOverview& overview) {
  std::size_t width = 0;
  for (const auto& field : overview.fields) width = std::max(width, field.description.name.size());
  const char* heading = "fields";
  for (const auto& field : overview.fields) {
    const io::FieldDescription& about = field.description;
    const std::string unit = about.unit.empty() ? "" : " " + about.unit;
    std::string text = fmt::format("{:<{}}  {:<5}  {}{}", about.name, width,
                                   place_text(about.place), range_text(field), unit);
    if (field.not_finite > 0)
      text += fmt::format(", {} not finite", counted(field.not_finite, "value", "values"));
    if (!about.expression.empty() && about.expression != about.name)
      text += fmt::format("  = {}", about.expression);
    line(session.out, std::exchange(heading, ""), text);
  }
}

void print_series(Session& session, const TrajectoryOverview& overview, std::int64_t reports) {
  const char* heading = "series";
  std::size_t width = 0;
  for (const auto& column : overview.series)
    width = std::max(width, column.description.name.size());
  for (const auto& column : overview.series) {
    if (column.first.empty() || column.description.name == "step" ||
        column.description.name == "time")
      continue;
    const bool vector = column.first.size() > 1;
    const auto text = [&](const std::vector<double>& values) {
      return vector ? fmt::format("({:.4g})", fmt::join(values, ", "))
                    : fmt::format("{:.6g}", values[0]);
    };
    line(session.out, std::exchange(heading, ""),
         fmt::format("{:<{}}  {} at first, {} at last{}", column.description.name, width,
                     text(column.first), text(column.last),
                     column.description.unit.empty() ? "" : " " + column.description.unit));
  }
  if (reports > 0) line(session.out, "", counted(reports, "report", "reports"));
}

void print_origin(Session& session, const TrajectoryReader& reader) {
  const io::RunDescription& run = reader.run();
  line(session.out, "made by",
       fmt::format("gmsim {} (commit {}), started {}", run.program_version, run.commit,
                   run.started));
  line(session.out, "with", fmt::format("{}   seed {}", run.command, run.seed));
  if (!reader.summary().state_hash.empty())
    line(session.out, "state", fmt::format("{} (hash of the end)", reader.summary().state_hash));
  line(session.out, "inside",
       fmt::format("the scene (--scene), {} (--rules)",
                   counted(std::ssize(run.rules), "rule file", "rule files")));
}

void print_text(Session& session, const TrajectoryReader& reader,
                const TrajectoryOverview& overview) {
  print_frames(session, reader);
  print_meshes(session, reader.run().dimension, overview);
  if (reader.summary().events > 0)
    line(session.out, "tears", fmt::format("{} (--events)", reader.summary().events));
  print_fields(session, overview);
  print_series(session, overview, reader.summary().reports);
  print_origin(session, reader);
}

JsonObject json_of(const TrajectoryOverview::Counts& counts) {
  JsonObject kinds;
  for (const auto& [kind, count] : counts.kinds) kinds.add(cell_name(kind, 2), count);
  return JsonObject().add("points", counts.points).add("cells", counts.cells).add_text("kinds", kinds.text());
}

JsonObject json_of(const TrajectoryOverview::Field& field) {
  const io::FieldDescription& about = field.description;
  JsonObject object;
  object.add("name", about.name).add("on", place_text(about.place)).add("orbit", about.orbit);
  object.add("components", about.components).add("unit", about.unit);
  object.add("expression", about.expression).add("not_finite", field.not_finite);
  if (field.range) object.add("low", field.range->low).add("high", field.range->high);
  return object;
}

JsonObject json_of(const TrajectoryOverview::Series& series) {
  return JsonObject()
      .add("name", series.description.name)
      .add("unit", series.description.unit)
      .add("first", std::span(series.first))
      .add("last", std::span(series.last));
}

template <class Items>
std::string json_list(const Items& items) {
  JsonArray array;
  for (const auto& item : items) array.add_text(json_of(item).text());
  return array.text();
}

void print_json(Session& session, const TrajectoryReader& reader,
                const TrajectoryOverview& overview) {
  const io::RunDescription& run = reader.run();
  const auto times = reader.times();
  JsonObject object;
  object.add("file", session.options.file.file.string());
  object.add("complete", reader.summary().complete).add("ending", reader.summary().ending);
  object.add("frames", reader.summary().frames);
  object.add("events", reader.summary().events).add("reports", reader.summary().reports);
  object.add("times", times).add("dimension", run.dimension);
  object.add_text("meshes", json_list(overview.epochs));
  object.add_text("fields", json_list(overview.fields));
  object.add_text("series", json_list(overview.series));
  object.add("program_version", run.program_version).add("commit", run.commit);
  object.add("command", run.command).add("started", run.started).add("seed", run.seed);
  object.add("state_hash", reader.summary().state_hash);
  session.out << object.text() << '\n';
}

void print_rules(Session& session, const TrajectoryReader& reader) {
  for (const io::RuleSource& rule : reader.run().rules) {
    session.out << fmt::format("// ---- {} ({})\n{}", rule.module, rule.path, rule.text);
    if (!rule.text.ends_with('\n')) session.out << '\n';
  }
}

/// "atomic_facet_force": entry `number` of a list of names.
std::string name_at(const std::vector<std::string>& names, std::int32_t number) {
  const bool known = number >= 0 && static_cast<std::size_t>(number) < names.size();
  return known ? names[static_cast<std::size_t>(number)] : "?";
}

/// A line for each change, in the order in which they were made.
void print_events(Session& session, const TrajectoryReader& reader) {
  const auto events = reader.read_events(session.diagnostics);
  if (!events) return;
  if (events->empty()) {
    session.out << "nothing tore\n";
    return;
  }
  session.out << fmt::format("{:>7}  {:>10}  {:>7}  {:<24}  {:>10}  {:>10}  {:<22}  {}\n", "step",
                             "time", "frame", "criterion", "value", "threshold", "change",
                             "at");
  for (const auto& [event, frame] : *events)
    session.out << fmt::format(
        "{:>7}  {:>10.6g}  {:>7}  {:<24}  {:>10.6g}  {:>10.6g}  {:<22}  ({:.4g}, {:.4g}, {:.4g}), "
        "dart {}, {} new\n",
        event.step, event.time, frame, name_at(reader.run().criterion_names, event.criterion),
        event.value, event.threshold, name_at(reader.run().rule_names, event.rule),
        event.position[0], event.position[1], event.position[2], event.dart,
        counted(event.new_vertices, "vertex", "vertices"));
}

}  // namespace

int run_info(Session& session) {
  const FileOptions& options = session.options.file;
  const auto reader = TrajectoryReader::open(options.file, session.diagnostics);
  if (!reader) return session.finish();
  if (options.show_scene) {
    session.out << reader->run().scene;
  } else if (options.show_rules) {
    print_rules(session, *reader);
  } else if (options.show_events) {
    print_events(session, *reader);
  } else if (const auto overview = read_overview(*reader, session.diagnostics)) {
    if (options.json) print_json(session, *reader, *overview);
    else print_text(session, *reader, *overview);
  }
  return session.finish();
}

}  // namespace gmsim::cli
