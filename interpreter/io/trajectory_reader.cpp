// SPDX-License-Identifier: MIT
#include "io/trajectory_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <stdexcept>

#include "io/trajectory_metadata.h"
#include "io/trajectory_tables.h"
#include "support/check.h"

namespace gmsim::io {

using support::DiagnosticKind;
using support::Diagnostics;

struct TrajectoryReader::Implementation {
  std::filesystem::path path;
  Hdf5Handle file;
  RunDescription run;
  TrajectorySummary summary;
  std::vector<double> times;
  std::vector<std::int64_t> steps, epoch_of;

  void load();

  template <class Number>
  [[nodiscard]] std::vector<Number> rows(const std::string& dataset, std::int64_t begin,
                                         std::int64_t count) const {
    if (begin < 0 || count < 0) throw Hdf5Error{fmt::format("{} has negative offsets", dataset)};
    return io::read_rows<Number>(open_dataset(file.get(), dataset), static_cast<hsize_t>(begin),
                                 static_cast<hsize_t>(count));
  }
  [[nodiscard]] std::int64_t number(const std::string& dataset, std::int64_t row) const {
    const auto values = rows<std::int64_t>(dataset, row, 1);
    if (values.size() != 1)
      throw Hdf5Error{fmt::format("{} is no table of single numbers", dataset)};
    return values.front();
  }
  /// Rows that a table has, as far as they are safe.
  [[nodiscard]] std::int64_t safe_rows(const std::string& dataset) const;

  [[nodiscard]] std::int64_t point_count(std::int64_t frame) const;
  [[nodiscard]] std::int64_t cell_count(std::int64_t frame) const;
  [[nodiscard]] MeshTopology topology(std::int64_t frame) const;
  void read_polyhedra(std::int64_t frame, MeshTopology& mesh) const;
  [[nodiscard]] DataArray field(std::size_t number, std::int64_t frame) const;
  [[nodiscard]] OrbitValues orbit_field(std::size_t number, std::int64_t frame) const;
  [[nodiscard]] std::vector<StoredEvent> events() const;
  [[nodiscard]] std::vector<StoredEpoch> epochs() const;

  void check_frame(std::int64_t frame) const {
    GMSIM_CHECK(frame >= 0 && frame < summary.frames, "a frame that is not in the trajectory");
  }
  template <class Read>
  auto guarded(Read&& read, Diagnostics& diagnostics) const -> std::optional<decltype(read())>;
};

namespace {

void report(const std::filesystem::path& path, const std::string& what, Diagnostics& diagnostics) {
  diagnostics.report(
      {.kind = DiagnosticKind::FileError, .message = fmt::format("{}: {}", path.string(), what)});
}

/// Throws unless `offsets` climb from 0 to `end`.
void check_offsets(const std::vector<std::int32_t>& offsets, std::size_t end) {
  const bool ok = !offsets.empty() && offsets.front() == 0 &&
                  std::is_sorted(offsets.begin(), offsets.end()) &&
                  static_cast<std::size_t>(offsets.back()) == end;
  if (!ok) throw Hdf5Error{"the mesh of a frame is damaged: offsets"};
}

void check_numbers(const std::vector<std::int32_t>& numbers, std::int64_t end) {
  const auto inside = [&](std::int32_t number) { return number >= 0 && number < end; };
  if (!std::all_of(numbers.begin(), numbers.end(), inside)) {
    throw Hdf5Error{"the mesh of a frame is damaged: numbers"};
  }
}

/// The corners a cell of this type has; 0: any number.
std::size_t corner_count(VtkCell type) {
  switch (type) {
    case VtkCell::Vertex:
      return 1;
    case VtkCell::Line:
      return 2;
    case VtkCell::Triangle:
      return 3;
    case VtkCell::Quad:
    case VtkCell::Tetrahedron:
      return 4;
    case VtkCell::Pyramid:
      return 5;
    case VtkCell::Wedge:
      return 6;
    case VtkCell::Hexahedron:
      return 8;
    case VtkCell::Polygon:
    case VtkCell::Polyhedron:
      return 0;
  }
  throw Hdf5Error{"the mesh of a frame is damaged: cell types"};
}

void check_cells(const MeshTopology& mesh) {
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    const std::size_t wanted = corner_count(mesh.types[cell]);
    if (wanted != 0 && mesh.corners(cell).size() != wanted) {
      throw Hdf5Error{"the mesh of a frame is damaged: corners"};
    }
  }
}

}  // namespace

template <class Read>
auto TrajectoryReader::Implementation::guarded(Read&& read, Diagnostics& diagnostics) const
    -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const Hdf5Error& error) {
    report(path, error.message, diagnostics);
  } catch (const std::bad_alloc&) {
    report(path, "tables too large for the memory", diagnostics);
  } catch (const std::length_error&) {
    report(path, "tables too large for the memory", diagnostics);
  }
  return std::nullopt;
}

std::unique_ptr<TrajectoryReader> TrajectoryReader::open(const std::filesystem::path& path,
                                                         Diagnostics& diagnostics) {
  auto implementation = std::make_unique<Implementation>();
  implementation->path = path;
  const auto loaded = implementation->guarded(
      [&] {
        implementation->load();
        return true;
      },
      diagnostics);
  if (!loaded) return nullptr;
  return std::unique_ptr<TrajectoryReader>(new TrajectoryReader(std::move(implementation)));
}

TrajectoryReader::TrajectoryReader(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
TrajectoryReader::~TrajectoryReader() = default;

const RunDescription& TrajectoryReader::run() const {
  return implementation_->run;
}
const TrajectorySummary& TrajectoryReader::summary() const {
  return implementation_->summary;
}
std::span<const double> TrajectoryReader::times() const {
  return implementation_->times;
}
std::span<const std::int64_t> TrajectoryReader::steps() const {
  return implementation_->steps;
}
std::span<const std::int64_t> TrajectoryReader::epoch_of() const {
  return implementation_->epoch_of;
}

void TrajectoryReader::Implementation::load() {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw Hdf5Error{"there is no such file"};
  file = open_for_reading(path);
  check_format(file.get());
  summary.frames = read_number_attribute(file.get(), "/VTKHDF/Steps", "NSteps");
  if (summary.frames < 1) throw Hdf5Error{"no frame of this run was finished"};
  run = read_run_description(file.get());
  summary.complete = read_number_attribute(file.get(), "/gmsim", "complete") != 0;
  summary.state_hash = read_text_attribute(file.get(), "/gmsim", "state_hash");
  if (attribute_exists(file.get(), "/gmsim", "ending"))
    summary.ending = read_text_attribute(file.get(), "/gmsim", "ending");
  times = rows<double>("/VTKHDF/Steps/Values", 0, summary.frames);
  steps = rows<std::int64_t>("/gmsim/frame_steps", 0, summary.frames);
  epoch_of = rows<std::int64_t>("/VTKHDF/Steps/PartOffsets", 0, summary.frames);
  if (times.size() != epoch_of.size() || steps.size() != epoch_of.size()) {
    throw Hdf5Error{"the tables of the steps are damaged"};
  }
  summary.epochs = epoch_of.back() + 1;
  summary.events = safe_rows("gmsim/events");
  if (!run.series.empty()) summary.reports = safe_rows("gmsim/series/" + run.series.front().name);
}

std::int64_t TrajectoryReader::Implementation::safe_rows(const std::string& dataset) const {
  const auto names = read_extent_names(file.get());
  const auto found = std::find(names.begin(), names.end(), dataset);
  if (found == names.end()) throw Hdf5Error{fmt::format("/gmsim/extents lacks {}", dataset)};
  const auto row = rows<std::int64_t>("/gmsim/extents", summary.frames - 1, 1);
  if (row.size() != names.size()) throw Hdf5Error{"/gmsim/extents does not fit its names"};
  return row[static_cast<std::size_t>(found - names.begin())];
}

std::int64_t TrajectoryReader::Implementation::point_count(std::int64_t frame) const {
  return number("/VTKHDF/NumberOfPoints", epoch_of[static_cast<std::size_t>(frame)]);
}

std::int64_t TrajectoryReader::Implementation::cell_count(std::int64_t frame) const {
  return number("/VTKHDF/NumberOfCells", epoch_of[static_cast<std::size_t>(frame)]);
}

MeshTopology TrajectoryReader::Implementation::topology(std::int64_t frame) const {
  const std::int64_t epoch = epoch_of[static_cast<std::size_t>(frame)];
  const std::int64_t cells = cell_count(frame);
  const std::int64_t ids = number("/VTKHDF/NumberOfConnectivityIds", epoch);
  const std::int64_t first_cell = number("/VTKHDF/Steps/CellOffsets", frame);
  const std::int64_t first_id = number("/VTKHDF/Steps/ConnectivityIdOffsets", frame);
  MeshTopology mesh;
  mesh.connectivity = rows<std::int32_t>("/VTKHDF/Connectivity", first_id, ids);
  // Every epoch before left one row more than it has cells.
  mesh.offsets = rows<std::int32_t>("/VTKHDF/Offsets", first_cell + epoch, cells + 1);
  for (std::uint8_t type : rows<std::uint8_t>("/VTKHDF/Types", first_cell, cells)) {
    mesh.types.push_back(static_cast<VtkCell>(type));
  }
  if (mesh.types.size() + 1 != mesh.offsets.size())
    throw Hdf5Error{"the mesh of a frame is damaged: tables"};
  check_offsets(mesh.offsets, mesh.connectivity.size());
  check_numbers(mesh.connectivity, point_count(frame));
  check_cells(mesh);
  mesh.polyhedron_offsets.assign(mesh.offsets.size(), 0);
  if (run.polyhedra) read_polyhedra(frame, mesh);
  return mesh;
}

void TrajectoryReader::Implementation::read_polyhedra(std::int64_t frame,
                                                      MeshTopology& mesh) const {
  const std::int64_t epoch = epoch_of[static_cast<std::size_t>(frame)];
  const std::int64_t faces = number("/VTKHDF/NumberOfFaces", epoch);
  mesh.face_connectivity = rows<std::int32_t>(
      "/VTKHDF/FaceConnectivity", number("/VTKHDF/Steps/FaceConnectivityOffsets", frame),
      number("/VTKHDF/NumberOfFaceConnectivityIds", epoch));
  mesh.face_offsets = rows<std::int32_t>(
      "/VTKHDF/FaceOffsets", number("/VTKHDF/Steps/FaceOffsetsOffsets", frame) + epoch, faces + 1);
  mesh.polyhedron_faces = rows<std::int32_t>(
      "/VTKHDF/PolyhedronToFaces", number("/VTKHDF/Steps/PolyhedronToFaceIdOffsets", frame),
      number("/VTKHDF/NumberOfPolyhedronToFaceIds", epoch));
  mesh.polyhedron_offsets =
      rows<std::int32_t>("/VTKHDF/PolyhedronOffsets",
                         number("/VTKHDF/Steps/CellOffsets", frame) + epoch, cell_count(frame) + 1);
  check_offsets(mesh.face_offsets, mesh.face_connectivity.size());
  check_numbers(mesh.face_connectivity, point_count(frame));
  check_offsets(mesh.polyhedron_offsets, mesh.polyhedron_faces.size());
  check_numbers(mesh.polyhedron_faces, faces);
}

DataArray TrajectoryReader::Implementation::field(std::size_t number_of_field,
                                                  std::int64_t frame) const {
  const FieldDescription& description = run.fields[number_of_field];
  const FieldPaths paths = paths_of(description);
  std::int64_t count = 1;
  if (description.place == FieldPlace::Point) count = point_count(frame);
  if (description.place == FieldPlace::Cell) count = cell_count(frame);
  if (description.place == FieldPlace::Orbit) count = number(paths.sizes, frame);
  return {description.name, description.components, description.type,
          rows<double>(paths.values, number(paths.offsets, frame), count)};
}

OrbitValues TrajectoryReader::Implementation::orbit_field(std::size_t number_of_field,
                                                          std::int64_t frame) const {
  const FieldPaths paths = paths_of(run.fields[number_of_field]);
  OrbitValues values{field(number_of_field, frame), {}};
  values.darts =
      rows<std::int32_t>(paths.darts, number(paths.offsets, frame), number(paths.sizes, frame));
  return values;
}

std::vector<StoredEvent> TrajectoryReader::Implementation::events() const {
  std::vector<EventRecord> records(static_cast<std::size_t>(summary.events));
  const Hdf5Handle type = event_memory_type();
  io::read_rows(open_dataset(file.get(), "/gmsim/events"), 0, records.size(), type.get(),
                records.data());
  std::vector<StoredEvent> events;
  for (const EventRecord& record : records) {
    TearEvent event{
        record.step,         record.time,
        record.rule,         record.criterion,
        record.value,        record.threshold,
        record.dart,         {record.position[0], record.position[1], record.position[2]},
        record.new_vertices, {}};
    event.cells = rows<std::int32_t>("/gmsim/event_cells", record.cells_begin, record.cells_count);
    events.push_back({std::move(event), record.frame});
  }
  return events;
}

std::vector<StoredEpoch> TrajectoryReader::Implementation::epochs() const {
  std::vector<EpochRecord> records(static_cast<std::size_t>(summary.epochs));
  const Hdf5Handle type = epoch_memory_type();
  io::read_rows(open_dataset(file.get(), "/gmsim/epochs"), 0, records.size(), type.get(),
                records.data());
  const std::int64_t changes = safe_rows("gmsim/gmap/changes");
  std::vector<StoredEpoch> epochs;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const EpochRecord& record = records[i];
    const std::int64_t end = i + 1 < records.size() ? records[i + 1].changes_begin : changes;
    epochs.push_back({record.step, record.time, record.first_event, record.darts,
                      rows<std::int32_t>("/gmsim/gmap/changes", record.changes_begin,
                                         end - record.changes_begin)});
  }
  return epochs;
}

std::optional<MeshFrame> TrajectoryReader::read_frame(std::int64_t frame, bool with_fields,
                                                      Diagnostics& diagnostics) const {
  const Implementation& reader = *implementation_;
  reader.check_frame(frame);
  return reader.guarded(
      [&] {
        MeshFrame mesh;
        mesh.time = reader.times[static_cast<std::size_t>(frame)];
        const std::int64_t first = reader.number("/VTKHDF/Steps/PointOffsets", frame);
        const auto flat = reader.rows<double>("/VTKHDF/Points", first, reader.point_count(frame));
        for (std::size_t i = 0; i + 2 < flat.size(); i += 3) {
          mesh.points.push_back({flat[i], flat[i + 1], flat[i + 2]});
        }
        mesh.topology = reader.topology(frame);
        for (std::size_t i = 0; with_fields && i < reader.run.fields.size(); ++i) {
          const FieldPlace place = reader.run.fields[i].place;
          if (place == FieldPlace::Point) mesh.point_data.push_back(reader.field(i, frame));
          if (place == FieldPlace::Cell) mesh.cell_data.push_back(reader.field(i, frame));
        }
        return mesh;
      },
      diagnostics);
}

std::optional<DataArray> TrajectoryReader::read_field(std::size_t field, std::int64_t frame,
                                                      Diagnostics& diagnostics) const {
  implementation_->check_frame(frame);
  return implementation_->guarded([&] { return implementation_->field(field, frame); },
                                  diagnostics);
}

std::optional<OrbitValues> TrajectoryReader::read_orbit_field(std::size_t field, std::int64_t frame,
                                                              Diagnostics& diagnostics) const {
  implementation_->check_frame(frame);
  GMSIM_CHECK(run().fields[field].place == FieldPlace::Orbit, "not a field on orbits");
  return implementation_->guarded([&] { return implementation_->orbit_field(field, frame); },
                                  diagnostics);
}

std::optional<std::vector<double>> TrajectoryReader::read_series(std::size_t column,
                                                                 Diagnostics& diagnostics) const {
  const Implementation& reader = *implementation_;
  return reader.guarded(
      [&] {
        return reader.rows<double>("/gmsim/series/" + reader.run.series[column].name, 0,
                                   reader.summary.reports);
      },
      diagnostics);
}

std::optional<std::vector<StoredEvent>> TrajectoryReader::read_events(
    Diagnostics& diagnostics) const {
  return implementation_->guarded([&] { return implementation_->events(); }, diagnostics);
}

std::optional<std::vector<StoredEpoch>> TrajectoryReader::read_epochs(
    Diagnostics& diagnostics) const {
  return implementation_->guarded([&] { return implementation_->epochs(); }, diagnostics);
}

}  // namespace gmsim::io
