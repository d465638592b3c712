// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/hdf5_handles.h"

namespace gmsim::io {

/// A dataset whose first dimension grows by appending; the others, its width, are fixed.
class GrowingDataset {
 public:
  GrowingDataset() = default;
  /// `width` 1 makes a one-dimensional dataset. `chunk_rows`: rows per chunk.
  GrowingDataset(hid_t file, std::string path, hid_t type, hsize_t width, hsize_t chunk_rows);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] hsize_t rows() const { return rows_; }
  [[nodiscard]] hid_t id() const { return dataset_.get(); }
  [[nodiscard]] bool exists() const { return dataset_.is_open(); }

  /// Appends whole rows of numbers of memory type `type`.
  void append(const void* data, hsize_t rows, hid_t type);
  template <class Number>
  void append(std::span<const Number> values) {
    append(values.data(), values.size() / width_, memory_type<Number>());
  }
  void append_one(std::int64_t value) { append(std::span<const std::int64_t>(&value, 1)); }
  /// Replaces the last row.
  void overwrite_last(const void* row, hid_t type);

  void close() { dataset_.reset(); }
  void abandon() { dataset_.abandon(); }

 private:
  void write(hsize_t begin, const void* data, hsize_t rows, hid_t type);

  std::string path_;
  Hdf5Handle dataset_;
  hsize_t rows_ = 0;
  hsize_t width_ = 1;
  bool flat_ = true;
};

}  // namespace gmsim::io
