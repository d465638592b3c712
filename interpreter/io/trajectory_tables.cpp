// SPDX-License-Identifier: MIT
#include "io/trajectory_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "io/sha256.h"

namespace gmsim::io {

namespace {

constexpr hsize_t kTableChunk = 512;     // tables with a row per frame, epoch, event or report
constexpr hsize_t kWideTableChunk = 32;  // extents: hundreds of bytes a row
constexpr hsize_t kSmallestChunk = 256, kLargestChunk = 16384;
constexpr std::size_t kExtentNameSize = 64;

hsize_t chunk_rows(std::size_t rows_per_frame) {
  return std::clamp(std::bit_ceil(hsize_t{std::max<std::size_t>(rows_per_frame, 1)}),
                    kSmallestChunk, kLargestChunk);
}

struct Member {
  const char* name;
  std::size_t offset;
  hid_t type;
  hsize_t count = 1;
};

Hdf5Handle compound(std::size_t size, const std::vector<Member>& members) {
  Hdf5Handle type(H5Tcreate(H5T_COMPOUND, size), H5Tclose, "make a record type");
  for (const Member& member : members) {
    Hdf5Handle array;
    if (member.count > 1) {
      array = Hdf5Handle(H5Tarray_create2(member.type, 1, &member.count), H5Tclose,
                         "make an array type");
    }
    require(H5Tinsert(type.get(), member.name, member.offset,
                      array.is_open() ? array.get() : member.type),
            "make a record type");
  }
  return type;
}

/// The type of the record in the file: without the gaps that memory has.
Hdf5Handle packed(const Hdf5Handle& memory) {
  Hdf5Handle type(H5Tcopy(memory.get()), H5Tclose, "make a record type");
  require(H5Tpack(type.get()), "pack a record type");
  return type;
}

/// Makes the datasets and groups of a file in order.
class Creator {
 public:
  Creator(hid_t file, const RunDescription& run, TrajectoryTables& tables)
      : file_(file),
        run_(run),
        tables_(tables),
        point_chunk_(chunk_rows(run.expected_points)),
        cell_chunk_(chunk_rows(run.expected_cells)) {}

  void create() {
    create_vtkhdf();
    create_steps();
    create_gmsim();
    create_fields();
    create_series();
    create_extents();
  }

 private:
  GrowingDataset table(const std::string& path, hid_t type = H5T_STD_I64LE, hsize_t width = 1) {
    return {file_, path, type, width, kTableChunk};
  }

  void create_vtkhdf() {
    const Hdf5Handle group = create_group(file_, "/VTKHDF");
    const Hdf5Handle space = simple_space({2});
    const Hdf5Handle version(
        H5Acreate2(group.get(), "Version", H5T_STD_I64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose, "make the attribute Version");
    const std::int64_t number[2] = {2, 0};
    require(H5Awrite(version.get(), H5T_NATIVE_INT64, number), "write the attribute Version");
    write_text_attribute(group.get(), "Type",
                         "UnstructuredGrid");  // must take exactly its 16 bytes
    for (const char* name : {"/VTKHDF/PointData", "/VTKHDF/CellData", "/VTKHDF/FieldData"}) {
      create_group(file_, name);
    }
    tables_.point_counts = table("/VTKHDF/NumberOfPoints");
    tables_.cell_counts = table("/VTKHDF/NumberOfCells");
    tables_.id_counts = table("/VTKHDF/NumberOfConnectivityIds");
    tables_.points = {file_, "/VTKHDF/Points", H5T_IEEE_F64LE, 3, point_chunk_};
    const hsize_t id_chunk = std::min(4 * cell_chunk_, kLargestChunk);
    tables_.connectivity = {file_, "/VTKHDF/Connectivity", H5T_STD_I32LE, 1, id_chunk};
    tables_.offsets = {file_, "/VTKHDF/Offsets", H5T_STD_I32LE, 1, cell_chunk_};
    tables_.types = {file_, "/VTKHDF/Types", H5T_STD_U8LE, 1, cell_chunk_};
    if (run_.polyhedra) create_polyhedra(id_chunk);
  }

  void create_polyhedra(hsize_t id_chunk) {
    tables_.face_counts = table("/VTKHDF/NumberOfFaces");
    tables_.face_id_counts = table("/VTKHDF/NumberOfFaceConnectivityIds");
    tables_.polyhedron_id_counts = table("/VTKHDF/NumberOfPolyhedronToFaceIds");
    tables_.face_connectivity = {file_, "/VTKHDF/FaceConnectivity", H5T_STD_I32LE, 1, id_chunk};
    tables_.face_offsets = {file_, "/VTKHDF/FaceOffsets", H5T_STD_I32LE, 1, id_chunk};
    tables_.polyhedron_faces = {file_, "/VTKHDF/PolyhedronToFaces", H5T_STD_I32LE, 1, id_chunk};
    tables_.polyhedron_offsets = {file_, "/VTKHDF/PolyhedronOffsets", H5T_STD_I32LE, 1,
                                  cell_chunk_};
  }

  void create_steps() {
    const Hdf5Handle group = create_group(file_, "/VTKHDF/Steps");
    write_number_attribute(group.get(), "NSteps", 0);
    for (const char* name :
         {"PointDataOffsets", "CellDataOffsets", "FieldDataOffsets", "FieldDataSizes"}) {
      create_group(group.get(), name);
    }
    tables_.times = table("/VTKHDF/Steps/Values", H5T_IEEE_F64LE);
    tables_.part_offsets = table("/VTKHDF/Steps/PartOffsets");
    tables_.part_counts = table("/VTKHDF/Steps/NumberOfParts");
    tables_.point_offsets = table("/VTKHDF/Steps/PointOffsets");
    tables_.cell_offsets = table("/VTKHDF/Steps/CellOffsets");
    tables_.id_offsets = table("/VTKHDF/Steps/ConnectivityIdOffsets");
    if (!run_.polyhedra) return;
    tables_.face_id_offsets = table("/VTKHDF/Steps/FaceConnectivityOffsets");
    tables_.polyhedron_id_offsets = table("/VTKHDF/Steps/PolyhedronToFaceIdOffsets");
    tables_.face_offset_offsets = table("/VTKHDF/Steps/FaceOffsetsOffsets");
  }

  void create_gmsim() {
    const Hdf5Handle group = create_group(file_, "/gmsim");
    write_run_attributes(group.get());
    write_text_dataset(group.get(), "scene", run_.scene);
    write_rules();
    write_names("/gmsim/rule_names", run_.rule_names);
    write_names("/gmsim/criterion_names", run_.criterion_names);
    tables_.frame_steps = table("/gmsim/frame_steps");
    const Hdf5Handle event = packed(event_memory_type());
    tables_.events = table("/gmsim/events", event.get());
    tables_.event_cells = table("/gmsim/event_cells", H5T_STD_I32LE);
    const Hdf5Handle epoch = packed(epoch_memory_type());
    tables_.epochs = table("/gmsim/epochs", epoch.get());
    create_group(file_, "/gmsim/gmap");
    write_alpha();
    const auto width = static_cast<hsize_t>(run_.dimension + 2);
    tables_.changes = table("/gmsim/gmap/changes", H5T_STD_I32LE, width);
  }

  void write_run_attributes(hid_t group) {
    write_text_attribute(group, "format", kTrajectoryFormat);
    write_number_attribute(group, "format_version", kTrajectoryVersion, NumberType::Int32);
    const Hdf5Handle space = scalar_space();
    const Hdf5Handle complete(
        H5Acreate2(group, "complete", H5T_STD_U8LE, space.get(), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose, "make the attribute complete");
    const std::uint8_t no = 0;
    require(H5Awrite(complete.get(), H5T_NATIVE_UINT8, &no), "write the attribute complete");
    write_number_attribute(group, "dimension", run_.dimension, NumberType::Int32);
    write_text_attribute(group, "program_version", run_.program_version);
    write_text_attribute(group, "commit", run_.commit);
    write_text_attribute(group, "hdf5_version",
                         fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE));
    write_text_attribute(group, "command", run_.command);
    write_text_attribute(group, "started", run_.started);
    write_number_attribute(group, "seed", static_cast<std::int64_t>(run_.seed));
    write_text_attribute(group, "state_hash", "", kShortText);
    write_text_attribute(group, "ending", "", kShortText);
  }

  void write_rules() {
    const Hdf5Handle group = create_group(file_, "/gmsim/rules");
    for (const RuleSource& rule : run_.rules) {
      write_text_dataset(group.get(), rule.module, rule.text);
      const Hdf5Handle dataset = open_dataset(group.get(), rule.module);
      write_text_attribute(dataset.get(), "path", rule.path);
      write_text_attribute(dataset.get(), "sha256", sha256(rule.text));
    }
  }

  void write_names(const std::string& path, const std::vector<std::string>& names) {
    std::size_t size = 1;
    for (const std::string& name : names) size = std::max(size, name.size());
    std::string padded;
    for (std::string name : names) {
      name.resize(size, '\0');
      padded += name;
    }
    const Hdf5Handle type = text_type(size);
    const Hdf5Handle space = simple_space({names.size()});
    const Hdf5Handle dataset(H5Dcreate2(file_, path.c_str(), type.get(), space.get(), H5P_DEFAULT,
                                        H5P_DEFAULT, H5P_DEFAULT),
                             H5Dclose, fmt::format("make {}", path));
    if (names.empty()) return;
    require(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()),
            fmt::format("write {}", path));
  }

  void write_alpha() {
    const auto width = static_cast<hsize_t>(run_.dimension + 1);
    const Hdf5Handle space = simple_space({run_.alpha.size() / width, width});
    const Hdf5Handle dataset(H5Dcreate2(file_, "/gmsim/gmap/alpha", H5T_STD_I32LE, space.get(),
                                        H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Dclose, "make /gmsim/gmap/alpha");
    if (run_.alpha.empty()) return;
    require(
        H5Dwrite(dataset.get(), H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, run_.alpha.data()),
        "write /gmsim/gmap/alpha");
  }

  void create_fields() {
    create_group(file_, "/gmsim/fields");
    for (const FieldDescription& field : run_.fields) {
      FieldTables& tables = tables_.fields.emplace_back();
      const hid_t type = file_type(field.type);
      const std::string& name = field.name;
      switch (field.place) {
        case FieldPlace::Point:
          tables.values = {file_, "/VTKHDF/PointData/" + name, type, field.components,
                           point_chunk_};
          tables.offsets = table("/VTKHDF/Steps/PointDataOffsets/" + name);
          break;
        case FieldPlace::Cell:
          tables.values = {file_, "/VTKHDF/CellData/" + name, type, field.components, cell_chunk_};
          tables.offsets = table("/VTKHDF/Steps/CellDataOffsets/" + name);
          break;
        case FieldPlace::Frame:
          tables.values = table("/VTKHDF/FieldData/" + name, type);
          tables.offsets = table("/VTKHDF/Steps/FieldDataOffsets/" + name);
          tables.sizes = table("/VTKHDF/Steps/FieldDataSizes/" + name, H5T_STD_I64LE, 2);
          break;
        case FieldPlace::Orbit:
          create_orbit_field(field, tables);
          break;
      }
      write_text_attribute(tables.values.id(), "expression", field.expression);
      write_text_attribute(tables.values.id(), "orbit", field.orbit);
      write_text_attribute(tables.values.id(), "unit", field.unit);
    }
  }

  void create_orbit_field(const FieldDescription& field, FieldTables& tables) {
    const std::string group = "/gmsim/fields/" + field.name;
    const Hdf5Handle handle = create_group(file_, group);
    write_text_attribute(handle.get(), "orbit", field.orbit);
    tables.values = {file_, group + "/values", file_type(field.type), field.components,
                     cell_chunk_};
    tables.darts = {file_, group + "/darts", H5T_STD_I32LE, 1, cell_chunk_};
    tables.offsets = table(group + "/offsets");
    tables.sizes = table(group + "/counts");
  }

  void create_series() {
    create_group(file_, "/gmsim/series");
    for (const SeriesDescription& column : run_.series) {
      GrowingDataset& dataset = tables_.series.emplace_back(
          table("/gmsim/series/" + column.name, file_type(column.type), column.components));
      write_text_attribute(dataset.id(), "unit", column.unit);
    }
  }

  void create_extents() {
    std::vector<std::string> names;
    for (const GrowingDataset* dataset : tables_.all()) names.push_back(dataset->path().substr(1));
    names.emplace_back("gmsim/extents");
    std::size_t size = kExtentNameSize;
    for (const std::string& name : names) size = std::max(size, name.size());
    tables_.extents = {file_, "/gmsim/extents", H5T_STD_I64LE, names.size(), kWideTableChunk};
    std::string padded;
    for (std::string name : names) {
      name.resize(size, '\0');
      padded += name;
    }
    const Hdf5Handle type = text_type(size);
    const Hdf5Handle space = simple_space({names.size()});
    const Hdf5Handle attribute(H5Acreate2(tables_.extents.id(), "names", type.get(), space.get(),
                                          H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose, "make the attribute names");
    require(H5Awrite(attribute.get(), type.get(), padded.data()), "write the attribute names");
  }

  hid_t file_;
  const RunDescription& run_;
  TrajectoryTables& tables_;
  hsize_t point_chunk_, cell_chunk_;
};

}  // namespace

Hdf5Handle event_memory_type() {
  const hid_t i32 = H5T_NATIVE_INT32, i64 = H5T_NATIVE_INT64, f64 = H5T_NATIVE_DOUBLE;
  return compound(sizeof(EventRecord),
                  {{"step", offsetof(EventRecord, step), i64},
                   {"frame", offsetof(EventRecord, frame), i64},
                   {"time", offsetof(EventRecord, time), f64},
                   {"rule", offsetof(EventRecord, rule), i32},
                   {"criterion", offsetof(EventRecord, criterion), i32},
                   {"value", offsetof(EventRecord, value), f64},
                   {"threshold", offsetof(EventRecord, threshold), f64},
                   {"dart", offsetof(EventRecord, dart), i32},
                   {"position", offsetof(EventRecord, position), f64, 3},
                   {"cells_begin", offsetof(EventRecord, cells_begin), i64},
                   {"cells_count", offsetof(EventRecord, cells_count), i32},
                   {"new_vertices", offsetof(EventRecord, new_vertices), i32}});
}

Hdf5Handle epoch_memory_type() {
  const hid_t i64 = H5T_NATIVE_INT64, f64 = H5T_NATIVE_DOUBLE;
  return compound(sizeof(EpochRecord),
                  {{"step", offsetof(EpochRecord, step), i64},
                   {"time", offsetof(EpochRecord, time), f64},
                   {"first_event", offsetof(EpochRecord, first_event), i64},
                   {"darts", offsetof(EpochRecord, darts), i64},
                   {"changes_begin", offsetof(EpochRecord, changes_begin), i64}});
}

void TrajectoryTables::create(hid_t file, const RunDescription& run) {
  Creator(file, run, *this).create();
}

std::vector<GrowingDataset*> TrajectoryTables::all() {
  std::vector<GrowingDataset*> candidates = {&point_counts,
                                             &cell_counts,
                                             &id_counts,
                                             &connectivity,
                                             &offsets,
                                             &types,
                                             &face_counts,
                                             &face_id_counts,
                                             &polyhedron_id_counts,
                                             &face_connectivity,
                                             &face_offsets,
                                             &polyhedron_faces,
                                             &polyhedron_offsets,
                                             &points,
                                             &times,
                                             &part_offsets,
                                             &part_counts,
                                             &point_offsets,
                                             &cell_offsets,
                                             &id_offsets,
                                             &face_id_offsets,
                                             &polyhedron_id_offsets,
                                             &face_offset_offsets,
                                             &frame_steps,
                                             &events,
                                             &event_cells,
                                             &epochs,
                                             &changes};
  for (FieldTables& field : fields) {
    candidates.insert(candidates.end(),
                      {&field.values, &field.offsets, &field.sizes, &field.darts});
  }
  for (GrowingDataset& column : series) candidates.push_back(&column);
  candidates.push_back(&extents);
  std::erase_if(candidates, [](const GrowingDataset* dataset) { return !dataset->exists(); });
  return candidates;
}

std::vector<std::string> read_extent_names(hid_t file) {
  const Hdf5Handle attribute(
      H5Aopen_by_name(file, "/gmsim/extents", "names", H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      "open the names of /gmsim/extents");
  const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose, "read a type");
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0) {
    throw Hdf5Error{"the names of /gmsim/extents are no fixed-length text"};
  }
  const std::size_t size = H5Tget_size(type.get());
  std::string padded(static_cast<std::size_t>(H5Aget_storage_size(attribute.get())), '\0');
  require(H5Aread(attribute.get(), type.get(), padded.data()), "read the names of /gmsim/extents");
  std::vector<std::string> names;
  for (std::size_t at = 0; at + size <= padded.size(); at += size) {
    names.emplace_back(padded.substr(at, size).c_str());
  }
  return names;
}

}  // namespace gmsim::io
