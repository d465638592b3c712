// SPDX-License-Identifier: MIT
#include "io/trajectory_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace gmsim::io {

namespace {

std::optional<std::string> field_problem(const FieldDescription& field) {
  if (!is_field_name(field.name)) {
    return fmt::format("`{}` cannot be the name of a field; `{}` can", field.name,
                       field_name(field.name));
  }
  if (field.components == 0) return fmt::format("the field `{}` has no components", field.name);
  const bool one_number = field.components == 1 &&
                          (field.type == NumberType::Float64 || field.type == NumberType::Int64);
  if (field.place == FieldPlace::Frame && !one_number) {
    return fmt::format("the field `{}` of the whole frame must be one float64 or int64",
                       field.name);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_problem(const RunDescription& run) {
  if (run.dimension < 1 || run.dimension > 3) return "the dimension must be 1, 2 or 3";
  if (run.alpha.size() % static_cast<std::size_t>(run.dimension + 1) != 0) {
    return "the table of links has half a row";
  }
  std::set<std::pair<FieldPlace, std::string>> names;
  for (const FieldDescription& field : run.fields) {
    if (auto problem = field_problem(field)) return problem;
    if (!names.emplace(field.place, field.name).second) {
      return fmt::format("two fields are called `{}`", field.name);
    }
  }
  std::set<std::string> modules;
  for (const RuleSource& rule : run.rules) {
    if (rule.module.empty() || rule.module.find('/') != std::string::npos) {
      return fmt::format("`{}` cannot be the name of a module of rules", rule.module);
    }
    if (!modules.insert(rule.module).second) {
      return fmt::format("two modules of rules are called `{}`", rule.module);
    }
  }
  std::set<std::string> series;
  for (const SeriesDescription& column : run.series) {
    if (!is_field_name(column.name) || column.components == 0) {
      return fmt::format("`{}` cannot be a column of the series", column.name);
    }
    if (!series.insert(column.name).second) {
      return fmt::format("two columns of the series are called `{}`", column.name);
    }
  }
  return std::nullopt;
}

}  // namespace gmsim::io
