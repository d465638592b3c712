// SPDX-License-Identifier: MIT
#include "io/hdf5_handles.h"

#include <fmt/format.h>

#include <algorithm>

namespace gmsim::io {

namespace {

/// What the innermost call on the error stack says, where the operating system's reason stands.
herr_t note_error(unsigned, const H5E_error2_t* error, void* data) {
  auto& text = *static_cast<std::string*>(data);
  if (text.empty() && error->desc != nullptr) text = error->desc;
  return 0;
}

std::string innermost_error() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, note_error, &text);
  if (text.empty()) return "the library gives no reason";
  // "file write failed: time = …, error message = 'No space left on device', buf = …"
  constexpr std::string_view kReason = "error message = '";
  const std::size_t begin = text.find(kReason);
  if (begin == std::string::npos) return text;
  const std::size_t end = text.find('\'', begin + kReason.size());
  return text.substr(begin + kReason.size(), end - begin - kReason.size());
}

}  // namespace

void prepare_hdf5() {
  static const bool done = [] {
    H5dont_atexit();
    H5open();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return true;
  }();
  static_cast<void>(done);
}

Hdf5Handle::Hdf5Handle(hid_t id, herr_t (*close)(hid_t), std::string_view what)
    : id_(id), close_(close) {
  if (id < 0) throw Hdf5Error{fmt::format("cannot {}: {}", what, innermost_error())};
}

Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  if (this != &other) {
    reset();
    id_ = std::exchange(other.id_, H5I_INVALID_HID);
    close_ = other.close_;
  }
  return *this;
}

void Hdf5Handle::reset() noexcept {
  if (is_open()) close_(std::exchange(id_, H5I_INVALID_HID));
}

void require(herr_t status, std::string_view what) {
  if (status < 0) throw Hdf5Error{fmt::format("cannot {}: {}", what, innermost_error())};
}

Hdf5Handle file_access() {
  prepare_hdf5();
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make file settings");
  require(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110),
          "choose the file format");
  require(H5Pset_file_locking(access.get(), false, true), "switch file locks off");
  // While a program writes, one that reads may have to look again; the library waits twice as long
  // each time, so with the 100 times of its own a damaged file would be waited for without end.
  constexpr unsigned kLooks = 20;  // about 1 ms
  require(H5Pset_metadata_read_attempts(access.get(), kLooks), "choose how often to look");
  return access;
}

Hdf5Handle create_file(const std::filesystem::path& path) {
  const Hdf5Handle access = file_access();
  // A process that is killed while it writes stops between two pages of memory: what is changed in
  // place must not lie on both sides, or it is left half new, with a checksum that is wrong.
  constexpr hsize_t kPage = 4096;
  const Hdf5Handle settings(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "make file settings");
  require(H5Pset_file_space_strategy(settings.get(), H5F_FSPACE_STRATEGY_PAGE, false, 1),
          "choose how the file is filled");
  require(H5Pset_file_space_page_size(settings.get(), kPage), "choose the page size of the file");
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, settings.get(), access.get()), H5Fclose,
          "create the file"};
}

Hdf5Handle open_for_reading(const std::filesystem::path& path) {
  const Hdf5Handle access = file_access();
  const hid_t live = H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access.get());
  if (live >= 0) return {live, H5Fclose, "open the file"};
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose, "open the file"};
}

Hdf5Handle create_group(hid_t parent, const std::string& path) {
  return {H5Gcreate2(parent, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
          fmt::format("make the group {}", path)};
}

Hdf5Handle open_dataset(hid_t file, const std::string& path) {
  return {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, fmt::format("open {}", path)};
}

bool link_exists(hid_t file, const std::string& path) {
  // H5Lexists wants every group on the way to exist.
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos;
       slash = path.find('/', slash + 1)) {
    if (H5Lexists(file, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0;
}

bool attribute_exists(hid_t file, const std::string& path, const std::string& name) {
  return H5Aexists_by_name(file, path.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> links_in(hid_t file, const std::string& group) {
  const Hdf5Handle handle(H5Gopen2(file, group.c_str(), H5P_DEFAULT), H5Gclose,
                          fmt::format("open the group {}", group));
  std::vector<std::string> names;
  const auto note = [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  require(H5Literate(handle.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, note, &names),
          fmt::format("list the group {}", group));
  return names;
}

Hdf5Handle scalar_space() {
  return {H5Screate(H5S_SCALAR), H5Sclose, "make a dataspace"};
}

Hdf5Handle simple_space(const std::vector<hsize_t>& size, const std::vector<hsize_t>& limit) {
  return {H5Screate_simple(static_cast<int>(size.size()), size.data(),
                           limit.empty() ? nullptr : limit.data()),
          H5Sclose, "make a dataspace"};
}

Hdf5Handle text_type(std::size_t size) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  require(H5Tset_size(type.get(), size), "size a text type");
  require(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), "pad a text type");
  return type;
}

hid_t file_type(NumberType type) {
  switch (type) {
    case NumberType::Float64:
      return H5T_IEEE_F64LE;
    case NumberType::Float32:
      return H5T_IEEE_F32LE;
    case NumberType::Int64:
      return H5T_STD_I64LE;
    case NumberType::Int32:
      return H5T_STD_I32LE;
  }
  return H5I_INVALID_HID;
}

template <>
hid_t memory_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t memory_type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t memory_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t memory_type<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t memory_type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

void write_text_attribute(hid_t object, const std::string& name, std::string_view text,
                          std::size_t size) {
  const std::size_t length = std::max({size, text.size(), std::size_t{1}});
  std::string padded(text);
  padded.resize(length, '\0');
  const Hdf5Handle type = text_type(length);
  const bool ascii = std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 128; });
  if (!ascii) require(H5Tset_cset(type.get(), H5T_CSET_UTF8), "mark text as UTF-8");
  const Hdf5Handle space = scalar_space();
  const Hdf5Handle attribute(
      H5Acreate2(object, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      fmt::format("make the attribute {}", name));
  require(H5Awrite(attribute.get(), type.get(), padded.data()),
          fmt::format("write the attribute {}", name));
}

void write_number_attribute(hid_t object, const std::string& name, std::int64_t value,
                            NumberType type) {
  const Hdf5Handle space = scalar_space();
  const Hdf5Handle attribute(
      H5Acreate2(object, name.c_str(), file_type(type), space.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose, fmt::format("make the attribute {}", name));
  require(H5Awrite(attribute.get(), H5T_NATIVE_INT64, &value),
          fmt::format("write the attribute {}", name));
}

void overwrite_attribute(hid_t file, const std::string& path, const std::string& name, hid_t type,
                         const void* value) {
  // Not H5Aopen_by_name: 1.10.8 cannot write through it once SWMR writing has begun.
  const Hdf5Handle object(H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose,
                          fmt::format("open {}", path));
  const Hdf5Handle attribute(H5Aopen(object.get(), name.c_str(), H5P_DEFAULT), H5Aclose,
                             fmt::format("open the attribute {}", name));
  require(H5Awrite(attribute.get(), type, value), fmt::format("write the attribute {}", name));
}

namespace {

Hdf5Handle utf8_type() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  require(H5Tset_size(type.get(), H5T_VARIABLE), "size a text type");
  require(H5Tset_cset(type.get(), H5T_CSET_UTF8), "mark text as UTF-8");
  return type;
}

}  // namespace

namespace {

/// For data that are converted on their way: HDF5 clears a megabyte for each of them, unless it is
/// told that less will do.
Hdf5Handle small_transfer() {
  constexpr std::size_t kBuffer = 4096;  // bytes; one element must fit
  Hdf5Handle list(H5Pcreate(H5P_DATASET_XFER), H5Pclose, "make a list of transfer properties");
  require(H5Pset_buffer(list.get(), kBuffer, nullptr, nullptr), "set the size of a buffer");
  return list;
}

}  // namespace

void write_text_dataset(hid_t parent, const std::string& name, const std::string& text) {
  const Hdf5Handle type = utf8_type();
  const Hdf5Handle space = scalar_space();
  const Hdf5Handle dataset(H5Dcreate2(parent, name.c_str(), type.get(), space.get(), H5P_DEFAULT,
                                      H5P_DEFAULT, H5P_DEFAULT),
                           H5Dclose, fmt::format("make {}", name));
  const Hdf5Handle transfer = small_transfer();
  const char* pointer = text.c_str();
  require(H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, transfer.get(), &pointer),
          fmt::format("write {}", name));
}

std::string read_text_attribute(hid_t file, const std::string& path, const std::string& name) {
  const Hdf5Handle attribute(
      H5Aopen_by_name(file, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      fmt::format("open the attribute {} of {}", name, path));
  const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose, "read a type");
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0) {
    throw Hdf5Error{fmt::format("the attribute {} of {} is no fixed-length text", name, path)};
  }
  std::string text(static_cast<std::size_t>(H5Aget_storage_size(attribute.get())), '\0');
  require(H5Aread(attribute.get(), type.get(), text.data()),
          fmt::format("read the attribute {}", name));
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

std::int64_t read_number_attribute(hid_t file, const std::string& path, const std::string& name) {
  const Hdf5Handle attribute(
      H5Aopen_by_name(file, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      fmt::format("open the attribute {} of {}", name, path));
  const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose, "read a dataspace");
  if (H5Sget_simple_extent_npoints(space.get()) != 1) {
    throw Hdf5Error{fmt::format("the attribute {} of {} is no single number", name, path)};
  }
  std::int64_t value = 0;
  require(H5Aread(attribute.get(), H5T_NATIVE_INT64, &value),
          fmt::format("read the attribute {}", name));
  return value;
}

std::string read_text_dataset(hid_t file, const std::string& path) {
  const Hdf5Handle dataset = open_dataset(file, path);
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose, "read a dataspace");
  if (H5Sget_simple_extent_npoints(space.get()) != 1) {
    throw Hdf5Error{fmt::format("{} is no single text", path)};
  }
  const Hdf5Handle type = utf8_type();
  char* pointer = nullptr;
  require(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &pointer),
          fmt::format("read {}", path));
  std::string text = pointer != nullptr ? pointer : "";
  H5free_memory(pointer);
  return text;
}

DatasetShape shape_of(const Hdf5Handle& dataset) {
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose, "read a dataspace");
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 1) throw Hdf5Error{"a table of the file has no rows"};
  std::vector<hsize_t> size(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), size.data(), nullptr);
  DatasetShape shape{size[0], 1};
  for (std::size_t i = 1; i < size.size(); ++i) shape.width *= size[i];
  return shape;
}

void read_rows(const Hdf5Handle& dataset, hsize_t begin, hsize_t count, hid_t type, void* out) {
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose, "read a dataspace");
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 1) throw Hdf5Error{"a table of the file has no rows"};
  std::vector<hsize_t> size(static_cast<std::size_t>(rank)), start(size.size(), 0);
  H5Sget_simple_extent_dims(space.get(), size.data(), nullptr);
  if (begin > size[0] || count > size[0] - begin) {
    throw Hdf5Error{"the file refers to rows that it does not have"};
  }
  if (count == 0) return;
  start[0] = begin;
  size[0] = count;
  require(
      H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr),
      "choose rows");
  const Hdf5Handle memory = simple_space(size);
  require(H5Dread(dataset.get(), type, memory.get(), space.get(), H5P_DEFAULT, out), "read rows");
}

}  // namespace gmsim::io
