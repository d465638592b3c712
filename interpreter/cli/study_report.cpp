// SPDX-License-Identifier: MIT
#include "cli/study_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/json_text.h"
#include "cli/version.h"

namespace gmsim::cli {
namespace {

/// An error counts when it is so many times the floor of the reference.
constexpr double kAboveFloor = 10;
constexpr double kNoisy = 0.05;  // relative median deviation

struct Errors {
  double end = 0, rms = 0;
};

Errors errors_between(const std::vector<double>& x, const std::vector<double>& reference,
                      double diagonal) {
  Errors errors;
  const std::size_t count = std::min(x.size(), reference.size()) / 3;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double distance =
        std::hypot(x[3 * i] - reference[3 * i], x[3 * i + 1] - reference[3 * i + 1],
                   x[3 * i + 2] - reference[3 * i + 2]);
    errors.end = std::max(errors.end, distance);
    sum += distance * distance;
  }
  if (count == 0 || diagonal == 0) return errors;
  return {errors.end / diagonal, std::sqrt(sum / static_cast<double>(count)) / diagonal};
}

std::string parameter(const StudyPoint& point) {
  return point.adaptive ? fmt::format("rtol {:.3g}", point.rtol) : fmt::format("{:.4g} s", point.dt);
}

std::string remarks(const StudyPoint& point) {
  std::string text;
  if (!point.resolved) text += "not resolved ";
  if (point.disturbed) text += "disturbed ";
  if (!text.empty()) text.pop_back();
  return text;
}

std::string csv_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

JsonObject json_of(const StudyPoint& point) {
  JsonObject object;
  object.add("method", point.method);
  if (point.adaptive) object.add("rtol", point.rtol);
  else object.add("dt", point.dt);
  object.add("dt_over_limit", point.dt_over_limit);
  if (!point.has_result()) return object.add("problem", point.problem);
  object.add("steps", point.steps).add("evaluations", point.evaluations);
  object.add("e_end", point.e_end).add("e_rms", point.e_rms).add("resolved", point.resolved);
  object.add("wall", std::span(point.wall)).add("wall_median", median(point.wall));
  object.add("cpu_over_wall", point.cpu_over_wall).add("disturbed", point.disturbed);
  return object.add("state_hash", fmt::format("{:016x}", point.state_hash));
}

}  // namespace

void StudyReport::compare() {
  const Errors floor = errors_between(coarser.positions, reference.positions, diagonal);
  floor_end = floor.end;
  floor_rms = floor.rms;
  for (StudyPoint& point : points) {
    if (!point.has_result()) continue;
    const Errors errors = errors_between(point.positions, reference.positions, diagonal);
    point.e_end = errors.end;
    point.e_rms = errors.rms;
    point.resolved = errors.end >= kAboveFloor * floor_end;
  }
}

bool StudyReport::is_noisy() const {
  return std::any_of(points.begin(), points.end(), [](const StudyPoint& point) {
    return point.has_result() && median_deviation(point.wall) > kNoisy * median(point.wall);
  });
}

std::string study_table(const StudyReport& report) {
  std::string text = fmt::format(
      "{}: {} points, {} s; {} with {} cores, load {:.2f}, {} build\n"
      "reference {} at {}: floor {:.2g} (E_end), {:.2g} (E_rms), from a run at {}\n\n",
      report.scene, report.points_of_mesh, report.duration, report.machine.processor,
      report.machine.cores, report.machine.load, report.machine.build, report.reference.method,
      parameter(report.reference), report.floor_end, report.floor_rms, parameter(report.coarser));
  text += fmt::format("{:<18} {:>11} {:>9} {:>12} {:>11} {:>9} {:>9}\n", "method", "step",
                      "of limit", "evaluations", "wall s", "E_end", "E_rms");
  for (const StudyPoint& point : report.points) {
    if (!point.has_result()) continue;
    text += fmt::format("{:<18} {:>11} {:>9.3g} {:>12} {:>11.4g} {:>9.2e} {:>9.2e}", point.method,
                        parameter(point), point.dt_over_limit, point.evaluations,
                        median(point.wall), point.e_end, point.e_rms);
    const std::string remark = remarks(point);
    text += (remark.empty() ? "" : "  " + remark) + "\n";
  }
  for (const StudyPoint& point : report.points)
    if (!point.has_result())
      text += fmt::format("{:<18} {:>11} {:>9.3g}  no result: {}\n", point.method,
                          parameter(point), point.dt_over_limit, point.problem);
  text += "\nErrors are in diagonals of the mesh at the start; wall times are medians.\n";
  if (report.is_noisy())
    text += "Timings are noisy (spread above 5 %): do not rank methods that are close.\n";
  return text;
}

std::string study_csv(const StudyReport& report) {
  std::string text =
      "method,dt,rtol,dt_over_limit,steps,evaluations,wall_median,wall_min,wall_deviation,"
      "cpu_over_wall,e_end,e_rms,resolved,disturbed,state_hash,problem\n";
  for (const StudyPoint& point : report.points) {
    text += point.method;
    text += point.adaptive ? fmt::format(",,{}", point.rtol) : fmt::format(",{},", point.dt);
    text += fmt::format(",{}", point.dt_over_limit);
    if (point.has_result())
      text += fmt::format(",{},{},{},{},{},{},{},{},{},{},{:016x},\n", point.steps,
                          point.evaluations, median(point.wall),
                          *std::min_element(point.wall.begin(), point.wall.end()),
                          median_deviation(point.wall), point.cpu_over_wall, point.e_end,
                          point.e_rms, point.resolved ? 1 : 0, point.disturbed ? 1 : 0,
                          point.state_hash);
    else
      text += ",,,,,,,,,,,," + csv_text(point.problem) + "\n";
  }
  return text;
}

std::string study_json(const StudyReport& report) {
  JsonArray points;
  for (const StudyPoint& point : report.points) points.add_text(json_of(point).text());
  JsonObject machine;
  machine.add("processor", report.machine.processor).add("cores", report.machine.cores);
  machine.add("load", report.machine.load).add("compiler", report.machine.compiler);
  machine.add("build", report.machine.build);
  JsonObject reference;
  reference.add("method", report.reference.method).add("dt", report.reference.dt);
  reference.add("evaluations", report.reference.evaluations);
  reference.add("floor_end", report.floor_end).add("floor_rms", report.floor_rms);
  return JsonObject()
             .add("scene", report.scene)
             .add("scene_sha256", report.scene_hash)
             .add("command", report.command_line)
             .add("program_version", version())
             .add("commit", commit())
             .add("duration", report.duration)
             .add("diagonal", report.diagonal)
             .add("mesh_points", report.points_of_mesh)
             .add("threads", report.threads)
             .add_text("machine", machine.text())
             .add_text("reference", reference.text())
             .add("noisy", report.is_noisy())
             .add_text("points", points.text())
             .text() +
         "\n";
}

}  // namespace gmsim::cli
