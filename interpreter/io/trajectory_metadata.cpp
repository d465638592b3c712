// SPDX-License-Identifier: MIT
#include "io/trajectory_metadata.h"

#include <fmt/format.h>

namespace gmsim::io {

namespace {

NumberType number_type(const Hdf5Handle& dataset, const std::string& path) {
  const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose, "read a type");
  for (NumberType candidate :
       {NumberType::Float64, NumberType::Float32, NumberType::Int64, NumberType::Int32}) {
    if (H5Tequal(type.get(), file_type(candidate)) > 0) return candidate;
  }
  throw Hdf5Error{fmt::format("{} has numbers of an unexpected type", path)};
}

/// Empty when the attribute is missing, as in files of other programs.
std::string text_of(hid_t file, const std::string& path, const std::string& name) {
  return attribute_exists(file, path, name) ? read_text_attribute(file, path, name) : std::string{};
}

void read_fields(hid_t file, FieldPlace place, const std::string& group,
                 std::vector<FieldDescription>& fields) {
  for (const std::string& name : links_in(file, group)) {
    FieldDescription field;
    field.name = name;
    field.place = place;
    const std::string path = paths_of(field).values;
    const Hdf5Handle dataset = open_dataset(file, path);
    field.components = static_cast<std::uint32_t>(shape_of(dataset).width);
    field.type = number_type(dataset, path);
    field.expression = text_of(file, path, "expression");
    field.orbit = text_of(file, path, "orbit");
    field.unit = text_of(file, path, "unit");
    fields.push_back(std::move(field));
  }
}

std::vector<std::string> read_names(hid_t file, const std::string& path) {
  const Hdf5Handle dataset = open_dataset(file, path);
  const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose, "read a type");
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0) {
    throw Hdf5Error{fmt::format("{} is no table of names", path)};
  }
  const std::size_t size = H5Tget_size(type.get());
  const DatasetShape shape = shape_of(dataset);
  std::string padded(shape.rows * shape.width * size, '\0');
  read_rows(dataset, 0, shape.rows, type.get(), padded.data());
  std::vector<std::string> names;
  for (std::size_t at = 0; at < padded.size(); at += size)
    names.emplace_back(padded.substr(at, size).c_str());
  return names;
}

void read_series(hid_t file, RunDescription& run) {
  for (const std::string& name : links_in(file, "/gmsim/series")) {
    const std::string path = "/gmsim/series/" + name;
    const Hdf5Handle dataset = open_dataset(file, path);
    run.series.push_back({name, static_cast<std::uint32_t>(shape_of(dataset).width),
                          number_type(dataset, path), text_of(file, path, "unit")});
  }
}

void read_rules(hid_t file, RunDescription& run) {
  for (const std::string& module : links_in(file, "/gmsim/rules")) {
    const std::string path = "/gmsim/rules/" + module;
    run.rules.push_back({module, text_of(file, path, "path"), read_text_dataset(file, path)});
  }
}

std::vector<std::int32_t> read_alpha(hid_t file) {
  const Hdf5Handle dataset = open_dataset(file, "/gmsim/gmap/alpha");
  return read_rows<std::int32_t>(dataset, 0, shape_of(dataset).rows);
}

}  // namespace

FieldPaths paths_of(const FieldDescription& field) {
  const std::string steps = "/VTKHDF/Steps/", &name = field.name;
  switch (field.place) {
    case FieldPlace::Point:
      return {"/VTKHDF/PointData/" + name, steps + "PointDataOffsets/" + name, "", ""};
    case FieldPlace::Cell:
      return {"/VTKHDF/CellData/" + name, steps + "CellDataOffsets/" + name, "", ""};
    case FieldPlace::Frame:
      return {"/VTKHDF/FieldData/" + name, steps + "FieldDataOffsets/" + name,
              steps + "FieldDataSizes/" + name, ""};
    case FieldPlace::Orbit: {
      const std::string group = "/gmsim/fields/" + name;
      return {group + "/values", group + "/offsets", group + "/counts", group + "/darts"};
    }
  }
  return {};
}

void check_format(hid_t file) {
  if (!link_exists(file, "/gmsim") || text_of(file, "/gmsim", "format") != kTrajectoryFormat) {
    throw Hdf5Error{"this is no trajectory of gmsim"};
  }
  const std::int64_t version = read_number_attribute(file, "/gmsim", "format_version");
  if (version != kTrajectoryVersion) {
    throw Hdf5Error{
        fmt::format("the trajectory has version {} of the format, this program reads {}", version,
                    kTrajectoryVersion)};
  }
}

RunDescription read_run_description(hid_t file) {
  RunDescription run;
  run.dimension = static_cast<int>(read_number_attribute(file, "/gmsim", "dimension"));
  run.scene = read_text_dataset(file, "/gmsim/scene");
  read_rules(file, run);
  run.rule_names = read_names(file, "/gmsim/rule_names");
  run.criterion_names = read_names(file, "/gmsim/criterion_names");
  run.program_version = text_of(file, "/gmsim", "program_version");
  run.commit = text_of(file, "/gmsim", "commit");
  run.command = text_of(file, "/gmsim", "command");
  run.started = text_of(file, "/gmsim", "started");
  run.seed = static_cast<std::uint64_t>(read_number_attribute(file, "/gmsim", "seed"));
  read_fields(file, FieldPlace::Point, "/VTKHDF/PointData", run.fields);
  read_fields(file, FieldPlace::Cell, "/VTKHDF/CellData", run.fields);
  read_fields(file, FieldPlace::Frame, "/VTKHDF/FieldData", run.fields);
  read_fields(file, FieldPlace::Orbit, "/gmsim/fields", run.fields);
  read_series(file, run);
  run.polyhedra = link_exists(file, "/VTKHDF/NumberOfFaces");
  run.alpha = read_alpha(file);
  return run;
}

}  // namespace gmsim::io
