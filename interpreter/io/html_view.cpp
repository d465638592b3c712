// SPDX-License-Identifier: MIT
#include "io/html_view.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "io/text_file.h"
#include "io/view_frames.h"
#include "io/viewer/viewer.h"
#include "support/check.h"
#include "support/suggest.h"

namespace gmsim::io {

namespace {

using support::DiagnosticKind;
using support::Diagnostics;

/// A JSON string that may stand in a <script>: no `<`, which could end it.
std::string json(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += {'\\', c};
    else if (c == '<' || static_cast<unsigned char>(c) < 0x20) result += fmt::format("\\u{:04x}", c);
    else result += c;
  }
  return result + "\"";
}

std::string json(const FieldDescription& field, const ValueRange& range) {
  return fmt::format(
      R"({{"name": {}, "on": "{}", "components": {}, "unit": {}, "expression": {}, )"
      R"("low": {}, "high": {}, "not_finite": {}}})",
      json(field.name), field.place == FieldPlace::Point ? "point" : "cell", field.components,
      json(field.unit), json(field.expression), range.low.value_or(0), range.high.value_or(0),
      range.not_finite);
}

/// The tables of a mesh, one after another from `at` on.
std::string json(const ViewMesh& mesh, ViewBlock& block) {
  const std::size_t at = block.add_numbers(mesh.points);
  for (const auto* table : {&mesh.cells, &mesh.triangles, &mesh.triangle_cells, &mesh.edges,
                            &mesh.lines, &mesh.line_cells, &mesh.dots, &mesh.dot_cells})
    block.add_numbers(*table);
  return fmt::format(
      R"({{"at": {}, "all_points": {}, "all_cells": {}, "points": {}, "cells": {}, )"
      R"("triangles": {}, "edges": {}, "outline": {}, "lines": {}, "dots": {}}})",
      at, mesh.all_points, mesh.all_cells, mesh.points.size(), mesh.cells.size(),
      mesh.triangle_cells.size(), mesh.edges.size() / 2, mesh.outline_edges,
      mesh.line_cells.size(), mesh.dot_cells.size());
}

/// Tears before the end of each frame of the page.
std::optional<std::vector<std::size_t>> tears_so_far(const TrajectoryReader& reader,
                                                     const std::vector<std::int64_t>& frames,
                                                     Diagnostics& diagnostics) {
  const auto events = reader.read_events(diagnostics);
  if (!events) return std::nullopt;
  std::vector<std::size_t> tears;
  for (const std::int64_t frame : frames)
    tears.push_back(static_cast<std::size_t>(
        std::count_if(events->begin(), events->end(),
                      [&](const StoredEvent& event) { return event.frame <= frame; })));
  return tears;
}

/// A row for a frame of the page.
std::string json(const TrajectoryReader& reader, const ViewScale& scale, std::size_t i,
                 const ViewFrame& frame, std::size_t tears) {
  const auto number = static_cast<std::size_t>(scale.frames[i]);
  return fmt::format(
      R"({{"number": {}, "time": {}, "step": {}, "mesh": {}, "tears": {}, "positions": {}, )"
      R"("fields": [{}]}})",
      number, reader.times()[number], reader.steps()[number], scale.mesh_of[i], tears,
      frame.positions, fmt::join(frame.fields, ", "));
}

/// A field to begin with must be one that can be shown.
bool check_field(const RunDescription& run, const std::string& name, Diagnostics& diagnostics) {
  if (name.empty()) return true;
  std::vector<std::string> shown;
  for (const FieldDescription& field : run.fields) {
    const bool can_be_shown = field.place == FieldPlace::Point || field.place == FieldPlace::Cell;
    if (field.name == name) {
      if (can_be_shown) return true;
      diagnostics.report({.kind = DiagnosticKind::Usage,
                          .message = fmt::format("the field `{}` is neither on points nor on cells; "
                                                 "it cannot colour the mesh",
                                                 name)});
      return false;
    }
    const bool is_new = std::find(shown.begin(), shown.end(), field.name) == shown.end();
    if (can_be_shown && is_new) shown.push_back(field.name);
  }
  std::string help = support::did_you_mean(name, shown);
  if (help.empty() && !shown.empty())
    help = fmt::format("there are `{}`", fmt::join(shown, "`, `"));
  diagnostics.report({.kind = DiagnosticKind::Usage,
                      .message = fmt::format("the file has no field `{}`", name),
                      .help = help});
  return false;
}

bool check_frames(const TrajectoryReader& reader, const HtmlViewOptions& options,
                  Diagnostics& diagnostics) {
  if (reader.summary().frames > 0 && options.frames > 0) return true;
  const bool empty = reader.summary().frames == 0;
  diagnostics.report(
      {.kind = DiagnosticKind::Usage,
       .message = empty ? "the file has no frames yet" : "a page of no frames shows nothing",
       .help = empty ? "the first one is written when the run begins to compute" : ""});
  return false;
}

void warn_of_lost_points(const ViewScale& scale, Diagnostics& diagnostics) {
  std::size_t lost = 0;
  for (const ValueRange& range : scale.box) lost = std::max(lost, range.not_finite);
  if (lost == 0) return;
  diagnostics.report({.kind = DiagnosticKind::NonFinite,
                      .message = fmt::format("{} position{} not finite and not drawn, nor is what "
                                             "hangs on them",
                                             lost, lost == 1 ? " is" : "s are"),
                      .severity = support::Severity::Warning});
}

std::string head_json(const TrajectoryReader& reader, const HtmlViewOptions& options,
                      const ViewScale& scale, const std::vector<ViewFrame>& frames,
                      const std::vector<std::size_t>& tears, ViewBlock& block) {
  std::vector<std::string> fields, meshes, rows;
  for (std::size_t i = 0; i < scale.fields.size(); ++i)
    fields.push_back(json(reader.run().fields[scale.fields[i]], scale.ranges[i]));
  for (const ViewMesh& mesh : scale.meshes) meshes.push_back(json(mesh, block));
  for (std::size_t i = 0; i < frames.size(); ++i)
    rows.push_back(json(reader, scale, i, frames[i], tears[i]));
  std::vector<double> low, high;
  for (const ValueRange& range : scale.box) {
    low.push_back(range.low.value_or(0));
    high.push_back(range.high.value_or(0));
  }
  return fmt::format(
      "{{\"title\": {},\n\"frames_in_file\": {}, \"complete\": {}, \"field\": {},\n"
      "\"low\": {}, \"high\": {},\n\"fields\": [{}],\n\"meshes\": [\n{}],\n\"frames\": [\n{}]}}",
      json(options.title), reader.summary().frames, reader.summary().complete,
      json(options.field), low, high, fmt::join(fields, ",\n"), fmt::join(meshes, ",\n"),
      fmt::join(rows, ",\n"));
}

/// Puts texts in the places of the page that are marked by `@NAME@`.
std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string_view>>& texts) {
  std::string result;
  std::size_t at = 0;
  for (const auto& [mark, text] : texts) {
    const std::size_t found = page.find(mark, at);
    GMSIM_CHECK(found != std::string_view::npos, "the page lacks a mark");
    result.append(page.substr(at, found - at)).append(text);
    at = found + mark.size();
  }
  return result.append(page.substr(at));
}

}  // namespace

std::optional<HtmlView> html_view(const TrajectoryReader& reader, const HtmlViewOptions& options,
                                  Diagnostics& diagnostics) {
  if (!check_frames(reader, options, diagnostics) ||
      !check_field(reader.run(), options.field, diagnostics))
    return std::nullopt;
  const auto scale =
      view_scale(reader, even_frames(reader.summary().frames, options.frames), diagnostics);
  if (!scale) return std::nullopt;
  warn_of_lost_points(*scale, diagnostics);
  ViewBlock block;
  const auto frames = add_frames(reader, *scale, block, diagnostics);
  const auto tears = tears_so_far(reader, scale->frames, diagnostics);
  if (!frames || !tears) return std::nullopt;
  const std::string head = head_json(reader, options, *scale, *frames, *tears, block);
  return HtmlView{filled(viewer_page(), {{"@TITLE@", xml_escaped(options.title)},
                                         {"@HEAD@", head},
                                         {"@BLOCK@", block.deflated_base64()},
                                         {"@VIEWER@", viewer_script()}}),
                  std::ssize(scale->frames)};
}

}  // namespace gmsim::io
