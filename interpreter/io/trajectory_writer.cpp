// SPDX-License-Identifier: MIT
#include "io/trajectory_writer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "io/trajectory_tables.h"
#include "support/check.h"

namespace gmsim::io {

using support::Diagnostic;
using support::DiagnosticKind;
using support::Diagnostics;

std::filesystem::path part_path(const std::filesystem::path& path) {
  std::filesystem::path part = path;
  part += ".part";
  return part;
}

struct TrajectoryWriter::Implementation {
  std::filesystem::path path;
  RunDescription run;
  TrajectoryOptions options;
  Hdf5Handle file;
  TrajectoryTables tables;
  std::vector<double> reports;  ///< rows that wait for the next frame
  std::size_t report_width = 0;

  std::int64_t frames = 0, epochs = 0;
  std::int64_t cells_before = 0, ids_before = 0;  ///< of the epochs before the current one
  std::int64_t face_ids_before = 0, polyhedron_ids_before = 0, faces_before = 0;
  std::size_t point_count = 0, cell_count = 0;  ///< of the current epoch
  bool version_raised = false;
  bool failed = false, closed = false;
  /// For each field the first row and the number of rows it had last.
  struct Stored {
    std::int64_t first = 0, rows = -1;
  };
  std::vector<Stored> stored;

  void start();
  void append_frame(const FrameData& frame);
  void append_topology(const FrameData& frame);
  void append_polyhedra(const MeshTopology& mesh);
  void append_steps(const FrameData& frame);
  void append_field(std::size_t number, const FrameField& field, std::size_t points);
  std::int64_t append_values(std::size_t number, const FrameField& field);
  void append_events(std::span<const TearEvent> events);
  void append_reports();
  [[nodiscard]] std::vector<std::int64_t> extents(std::int64_t extents_rows);
  void flush();
  void commit();
  void finish(std::string_view state_hash, std::string_view ending);
  void set_text(const char* attribute, std::string_view text);
  void abandon();
};

namespace {

/// Reports a failure with the frame it happened in. What was safe stays safe.
bool report_failure(const std::filesystem::path& path, std::int64_t frame, const std::string& what,
                    Diagnostics& diagnostics) {
  diagnostics.report(
      {.kind = DiagnosticKind::FileError,
       .message = fmt::format("{}: frame {} could not be written: {}", part_path(path).string(),
                              frame, what),
       .help = frame > 0 ? fmt::format("the {} frames before it are safe: `gmsim recover {}`",
                                       frame, part_path(path).string())
                         : std::string{}});
  return false;
}

bool may_begin(const std::filesystem::path& path, const RunDescription& run, bool force,
               Diagnostics& diagnostics) {
  if (const auto problem = find_problem(run)) {
    diagnostics.report({.kind = DiagnosticKind::Usage, .message = *problem});
    return false;
  }
  std::error_code error;
  if (!path.has_filename() || std::filesystem::is_directory(path, error)) {
    diagnostics.report({.kind = DiagnosticKind::FileError,
                        .message = fmt::format("{}: this is a folder", path.string()),
                        .help = "name the file in it"});
    return false;
  }
  if (force || !std::filesystem::exists(part_path(path), error)) return true;
  const std::string part = part_path(path).string();
  diagnostics.report(
      {.kind = DiagnosticKind::Usage,
       .message = fmt::format(
           "{} is there already: a run that was cut short, or one that is still going on", part),
       .help =
           fmt::format("`gmsim recover {}` gets its frames back; `--force` writes over it", part)});
  return false;
}

}  // namespace

std::unique_ptr<TrajectoryWriter> TrajectoryWriter::create(const std::filesystem::path& path,
                                                           const RunDescription& run,
                                                           const TrajectoryOptions& options,
                                                           Diagnostics& diagnostics) {
  if (!may_begin(path, run, options.force, diagnostics)) return nullptr;
  auto implementation = std::make_unique<Implementation>();
  implementation->path = path;
  implementation->run = run;
  implementation->options = options;
  try {
    implementation->start();
  } catch (const Hdf5Error& error) {
    implementation->abandon();
    diagnostics.report({.kind = DiagnosticKind::FileError,
                        .message = fmt::format("{}: {}", part_path(path).string(), error.message)});
    return nullptr;
  }
  return std::unique_ptr<TrajectoryWriter>(new TrajectoryWriter(std::move(implementation)));
}

TrajectoryWriter::TrajectoryWriter(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}

TrajectoryWriter::~TrajectoryWriter() {
  if (implementation_->failed) implementation_->abandon();
}

std::int64_t TrajectoryWriter::frames() const {
  return implementation_->frames;
}

void TrajectoryWriter::add_report(std::span<const double> row) {
  GMSIM_CHECK(row.size() == implementation_->report_width, "a report does not fit the series");
  implementation_->reports.insert(implementation_->reports.end(), row.begin(), row.end());
}

bool TrajectoryWriter::write_frame(const FrameData& frame, Diagnostics& diagnostics) {
  Implementation& writer = *implementation_;
  GMSIM_CHECK(!writer.failed && !writer.closed, "a frame for a trajectory that has ended");
  try {
    writer.append_frame(frame);
    writer.commit();
    return true;
  } catch (const Hdf5Error& error) {
    writer.failed = true;
    return report_failure(writer.path, writer.frames, error.message, diagnostics);
  }
}

bool TrajectoryWriter::close(std::string_view state_hash, Diagnostics& diagnostics,
                             std::string_view ending) {
  Implementation& writer = *implementation_;
  GMSIM_CHECK(!writer.failed && !writer.closed, "a trajectory is closed twice");
  try {
    writer.finish(state_hash, ending);
  } catch (const Hdf5Error& error) {
    writer.failed = true;
    return report_failure(writer.path, writer.frames, error.message, diagnostics);
  }
  std::error_code error;
  if (writer.frames == 0) {
    std::filesystem::remove(part_path(writer.path), error);
    diagnostics.report({.kind = DiagnosticKind::FileError,
                        .message = fmt::format("{}: nothing is kept of a run without frames",
                                               writer.path.string()),
                        .severity = support::Severity::Warning});
    return true;
  }
  std::filesystem::rename(part_path(writer.path), writer.path, error);
  if (!error) return true;
  diagnostics.report({.kind = DiagnosticKind::FileError,
                      .message = fmt::format("{}: the finished file cannot get its name: {}",
                                             part_path(writer.path).string(), error.message())});
  return false;
}

void TrajectoryWriter::Implementation::start() {
  for (const SeriesDescription& column : run.series) report_width += column.components;
  stored.resize(run.fields.size());
  file = create_file(part_path(path));
  tables.create(file.get(), run);
  flush();
  require(H5Fstart_swmr_write(file.get()), "begin to write so that the file can be read meanwhile");
}

void TrajectoryWriter::Implementation::append_frame(const FrameData& frame) {
  GMSIM_CHECK(frame.fields.size() == run.fields.size(), "a frame needs every field");
  GMSIM_CHECK(frame.topology || frames > 0, "the first frame needs a mesh");
  if (frame.topology) append_topology(frame);
  GMSIM_CHECK(frame.points.size() == point_count,
              "the number of points changes with the mesh only");
  append_steps(frame);
  for (std::size_t i = 0; i < run.fields.size(); ++i)
    append_field(i, frame.fields[i], frame.points.size());
  append_events(frame.events);
  append_reports();
  tables.extents.append(std::span<const std::int64_t>(extents(frames + 1)));
}

void TrajectoryWriter::Implementation::append_topology(const FrameData& frame) {
  const MeshTopology& mesh = *frame.topology->mesh;
  if (epochs > 0) {
    cells_before = static_cast<std::int64_t>(tables.types.rows());
    ids_before = static_cast<std::int64_t>(tables.connectivity.rows());
    face_ids_before = static_cast<std::int64_t>(tables.face_connectivity.rows());
    polyhedron_ids_before = static_cast<std::int64_t>(tables.polyhedron_faces.rows());
    faces_before = static_cast<std::int64_t>(tables.face_offsets.rows()) - epochs;
  }
  point_count = frame.points.size();
  cell_count = mesh.cell_count();
  tables.point_counts.append_one(static_cast<std::int64_t>(frame.points.size()));
  tables.cell_counts.append_one(static_cast<std::int64_t>(mesh.cell_count()));
  tables.id_counts.append_one(static_cast<std::int64_t>(mesh.connectivity.size()));
  tables.connectivity.append(std::span(mesh.connectivity));
  tables.offsets.append(std::span(mesh.offsets));
  static_assert(sizeof(VtkCell) == 1);
  tables.types.append(mesh.types.data(), mesh.types.size(), H5T_NATIVE_UINT8);
  GMSIM_CHECK(run.polyhedra || !mesh.has_polyhedra(), "polyhedra in a run that was to have none");
  if (run.polyhedra) append_polyhedra(mesh);

  const std::int64_t changes_begin = static_cast<std::int64_t>(tables.changes.rows());
  tables.changes.append(frame.topology->changes);
  const EpochRecord epoch{frame.step, frame.time, static_cast<std::int64_t>(tables.events.rows()),
                          frame.topology->darts, changes_begin};
  const Hdf5Handle type = epoch_memory_type();
  tables.epochs.append(&epoch, 1, type.get());
  ++epochs;
}

void TrajectoryWriter::Implementation::append_polyhedra(const MeshTopology& mesh) {
  tables.face_counts.append_one(static_cast<std::int64_t>(mesh.face_count()));
  tables.face_id_counts.append_one(static_cast<std::int64_t>(mesh.face_connectivity.size()));
  tables.polyhedron_id_counts.append_one(static_cast<std::int64_t>(mesh.polyhedron_faces.size()));
  tables.face_connectivity.append(std::span(mesh.face_connectivity));
  tables.face_offsets.append(std::span(mesh.face_offsets));
  tables.polyhedron_faces.append(std::span(mesh.polyhedron_faces));
  tables.polyhedron_offsets.append(std::span(mesh.polyhedron_offsets));
  if (!mesh.has_polyhedra() || version_raised) return;
  const std::int64_t version[2] = {2, 5};
  overwrite_attribute(file.get(), "/VTKHDF", "Version", H5T_NATIVE_INT64, version);
  version_raised = true;
}

void TrajectoryWriter::Implementation::append_steps(const FrameData& frame) {
  tables.times.append(std::span<const double>(&frame.time, 1));
  tables.part_offsets.append_one(epochs - 1);
  tables.part_counts.append_one(1);
  tables.point_offsets.append_one(static_cast<std::int64_t>(tables.points.rows()));
  tables.cell_offsets.append_one(cells_before);
  tables.id_offsets.append_one(ids_before);
  tables.frame_steps.append_one(frame.step);
  if (run.polyhedra) {
    tables.face_id_offsets.append_one(face_ids_before);
    tables.polyhedron_id_offsets.append_one(polyhedron_ids_before);
    tables.face_offset_offsets.append_one(faces_before);
  }
  tables.points.append(frame.points.data(), frame.points.size(), H5T_NATIVE_DOUBLE);
}

void TrajectoryWriter::Implementation::append_field(std::size_t number, const FrameField& field,
                                                    std::size_t points) {
  FieldTables& table = tables.fields[number];
  Stored& last = stored[number];
  if (!std::holds_alternative<Unchanged>(field.values)) {
    last.first = static_cast<std::int64_t>(table.values.rows());
    last.rows = append_values(number, field);
  }
  GMSIM_CHECK(last.rows >= 0, "the first values of a field cannot be unchanged");
  const auto rows = static_cast<std::size_t>(last.rows);
  switch (run.fields[number].place) {
    case FieldPlace::Point:
      GMSIM_CHECK(rows == points, "a field needs a row for every point");
      break;
    case FieldPlace::Cell:
      GMSIM_CHECK(rows == cell_count, "a field needs a row for every cell");
      break;
    case FieldPlace::Frame: {
      GMSIM_CHECK(rows == 1, "a field of the frame is one number");
      const std::int64_t size[2] = {1, 1};  // components, tuples
      table.sizes.append(std::span<const std::int64_t>(size));
      break;
    }
    case FieldPlace::Orbit:
      table.sizes.append_one(last.rows);
      break;
  }
  table.offsets.append_one(last.first);
}

std::int64_t TrajectoryWriter::Implementation::append_values(std::size_t number,
                                                             const FrameField& field) {
  FieldTables& table = tables.fields[number];
  const std::size_t components = run.fields[number].components;
  const std::size_t count = std::visit(
      [&](const auto& values) -> std::size_t {
        if constexpr (std::is_same_v<std::decay_t<decltype(values)>, Unchanged>) {
          return 0;
        } else {
          GMSIM_CHECK(values.size() % components == 0, "a field has half a row");
          table.values.append(values);
          return values.size();
        }
      },
      field.values);
  const auto rows = static_cast<std::int64_t>(count / components);
  if (run.fields[number].place == FieldPlace::Orbit) {
    GMSIM_CHECK(static_cast<std::int64_t>(field.darts.size()) == rows,
                "a field needs a dart for every row");
    table.darts.append(field.darts);
  }
  return rows;
}

void TrajectoryWriter::Implementation::append_events(std::span<const TearEvent> events) {
  if (events.empty()) return;
  std::vector<EventRecord> records;
  std::vector<std::int32_t> cells;
  const auto cells_begin = static_cast<std::int64_t>(tables.event_cells.rows());
  for (const TearEvent& event : events) {
    const auto begin = cells_begin + static_cast<std::int64_t>(cells.size());
    records.push_back({event.step,
                       frames,
                       event.time,
                       event.rule,
                       event.criterion,
                       event.value,
                       event.threshold,
                       event.dart,
                       {event.position[0], event.position[1], event.position[2]},
                       begin,
                       static_cast<std::int32_t>(event.cells.size()),
                       event.new_vertices});
    cells.insert(cells.end(), event.cells.begin(), event.cells.end());
  }
  const Hdf5Handle type = event_memory_type();
  tables.event_cells.append(std::span<const std::int32_t>(cells));
  tables.events.append(records.data(), records.size(), type.get());
}

void TrajectoryWriter::Implementation::append_reports() {
  if (reports.empty()) return;
  const std::size_t rows = reports.size() / report_width;
  std::size_t begin = 0;
  for (std::size_t column = 0; column < run.series.size(); ++column) {
    const std::size_t width = run.series[column].components;
    std::vector<double> values;
    values.reserve(rows * width);
    for (std::size_t row = 0; row < rows; ++row) {
      const double* first = reports.data() + row * report_width + begin;
      values.insert(values.end(), first, first + width);
    }
    tables.series[column].append(std::span<const double>(values));
    begin += width;
  }
  reports.clear();
}

std::vector<std::int64_t> TrajectoryWriter::Implementation::extents(std::int64_t extents_rows) {
  std::vector<std::int64_t> row;
  for (const GrowingDataset* dataset : tables.all())
    row.push_back(static_cast<std::int64_t>(dataset->rows()));
  row.back() = extents_rows;  // the table of extents itself stands last
  return row;
}

void TrajectoryWriter::Implementation::flush() {
  require(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), "store the file");
}

/// The data first, then the number of steps that says that they are there: were both to go to the
/// disk together, the number might come first.
void TrajectoryWriter::Implementation::commit() {
  flush();
  const std::int64_t steps = frames + 1;
  overwrite_attribute(file.get(), "/VTKHDF/Steps", "NSteps", H5T_NATIVE_INT64, &steps);
  flush();
  if (options.sync) {
    int* descriptor = nullptr;
    require(H5Fget_vfd_handle(file.get(), H5P_DEFAULT, reinterpret_cast<void**>(&descriptor)),
            "find the file");
    if (fdatasync(*descriptor) != 0) throw Hdf5Error{"the disk cannot store the file"};
  }
  ++frames;
}

void TrajectoryWriter::Implementation::set_text(const char* attribute, std::string_view text) {
  std::string padded(text);
  GMSIM_CHECK(padded.size() <= kShortText, "a text is too long for its attribute");
  padded.resize(kShortText, '\0');
  const Hdf5Handle type = text_type(kShortText);
  overwrite_attribute(file.get(), "/gmsim", attribute, type.get(), padded.data());
}

void TrajectoryWriter::Implementation::finish(std::string_view state_hash,
                                              std::string_view ending) {
  if (frames > 0 && !reports.empty()) {
    // Reports behind the last frame: the last row of extents is to count them too.
    append_reports();
    flush();
    const auto row = extents(frames);
    tables.extents.overwrite_last(row.data(), H5T_NATIVE_INT64);
    flush();
  }
  set_text("state_hash", state_hash);
  set_text("ending", ending);
  const std::uint8_t yes = 1;
  overwrite_attribute(file.get(), "/gmsim", "complete", H5T_NATIVE_UINT8, &yes);
  flush();
  for (GrowingDataset* dataset : tables.all()) dataset->close();
  const hid_t id = file.get();
  file.abandon();
  closed = true;
  require(H5Fclose(id), "close the file");
}

void TrajectoryWriter::Implementation::abandon() {
  for (GrowingDataset* dataset : tables.all()) dataset->abandon();
  file.abandon();
}

}  // namespace gmsim::io
