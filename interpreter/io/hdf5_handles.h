// SPDX-License-Identifier: MIT
#pragma once

// Internal to this module: nobody else includes HDF5.
#include <hdf5.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/mesh_frame.h"

namespace gmsim::io {

/// A failed call of the library with what its error stack says. Thrown inside this module only.
struct Hdf5Error {
  std::string message;
};

/// Sets the library up for this process; every use of it begins here. Its exit handler is switched
/// off: it would finish a file whose writing has failed and so spoil it. Errors are not printed.
void prepare_hdf5();

/// Owns an identifier of the library.
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  /// Takes over `id`, to be closed by `close`; throws when the call that gave it failed.
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t), std::string_view what);
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;
  ~Hdf5Handle() { reset(); }

  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] bool is_open() const { return id_ >= 0; }
  void reset() noexcept;
  /// Forgets the identifier without closing it.
  void abandon() { id_ = H5I_INVALID_HID; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  herr_t (*close_)(hid_t) = nullptr;
};

/// Throws when a call failed; `what` completes "cannot …".
void require(herr_t status, std::string_view what);

/// Settings for files that are written: format of 1.10 as SWMR needs it, no file locks.
[[nodiscard]] Hdf5Handle file_access();
[[nodiscard]] Hdf5Handle create_file(const std::filesystem::path& path);
/// Opens for reading, also a file that is being written or whose writer was killed.
[[nodiscard]] Hdf5Handle open_for_reading(const std::filesystem::path& path);

Hdf5Handle create_group(hid_t parent, const std::string& path);
[[nodiscard]] Hdf5Handle open_dataset(hid_t file, const std::string& path);
[[nodiscard]] bool link_exists(hid_t file, const std::string& path);
[[nodiscard]] bool attribute_exists(hid_t file, const std::string& path, const std::string& name);
/// Names of the links in a group, ascending.
[[nodiscard]] std::vector<std::string> links_in(hid_t file, const std::string& group);

[[nodiscard]] Hdf5Handle scalar_space();
[[nodiscard]] Hdf5Handle simple_space(const std::vector<hsize_t>& size,
                                      const std::vector<hsize_t>& limit = {});
/// Fixed-length text, padded with nulls; `size` at least 1.
[[nodiscard]] Hdf5Handle text_type(std::size_t size);

/// Little-endian type in a file.
[[nodiscard]] hid_t file_type(NumberType type);
template <class Number>
[[nodiscard]] hid_t memory_type();
template <>
[[nodiscard]] hid_t memory_type<double>();
template <>
[[nodiscard]] hid_t memory_type<float>();
template <>
[[nodiscard]] hid_t memory_type<std::int64_t>();
template <>
[[nodiscard]] hid_t memory_type<std::int32_t>();
template <>
[[nodiscard]] hid_t memory_type<std::uint8_t>();

void write_text_attribute(hid_t object, const std::string& name, std::string_view text,
                          std::size_t size = 0);
void write_number_attribute(hid_t object, const std::string& name, std::int64_t value,
                            NumberType type = NumberType::Int64);
/// Overwrites the value of an attribute that exists.
void overwrite_attribute(hid_t file, const std::string& path, const std::string& name, hid_t type,
                         const void* value);
/// A scalar dataset of UTF-8 text of any length.
void write_text_dataset(hid_t parent, const std::string& name, const std::string& text);

[[nodiscard]] std::string read_text_attribute(hid_t file, const std::string& path,
                                              const std::string& name);
[[nodiscard]] std::int64_t read_number_attribute(hid_t file, const std::string& path,
                                                 const std::string& name);
[[nodiscard]] std::string read_text_dataset(hid_t file, const std::string& path);

/// Rows and width of a dataset (its first dimension and the product of the others).
struct DatasetShape {
  hsize_t rows = 0;
  hsize_t width = 1;
};
[[nodiscard]] DatasetShape shape_of(const Hdf5Handle& dataset);
/// Reads rows into `out`, which has room for them; refuses rows that are not there.
void read_rows(const Hdf5Handle& dataset, hsize_t begin, hsize_t count, hid_t type, void* out);

template <class Number>
[[nodiscard]] std::vector<Number> read_rows(const Hdf5Handle& dataset, hsize_t begin,
                                            hsize_t count) {
  const DatasetShape shape = shape_of(dataset);
  if (begin > shape.rows || count > shape.rows - begin) {
    throw Hdf5Error{"the file refers to rows that it does not have"};
  }
  std::vector<Number> values(count * shape.width);
  read_rows(dataset, begin, count, memory_type<Number>(), values.data());
  return values;
}

}  // namespace gmsim::io
