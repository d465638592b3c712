// SPDX-License-Identifier: MIT
#include "io/growing_dataset.h"

#include <fmt/format.h>

namespace gmsim::io {

GrowingDataset::GrowingDataset(hid_t file, std::string path, hid_t type, hsize_t width,
                               hsize_t chunk_rows)
    : path_(std::move(path)), width_(width), flat_(width == 1) {
  std::vector<hsize_t> size = {0}, limit = {H5S_UNLIMITED}, chunk = {chunk_rows};
  if (!flat_) {
    size.push_back(width);
    limit.push_back(width);
    chunk.push_back(width);
  }
  const Hdf5Handle space = simple_space(size, limit);
  const Hdf5Handle settings(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make dataset settings");
  require(H5Pset_chunk(settings.get(), static_cast<int>(chunk.size()), chunk.data()),
          "choose chunks");
  dataset_ = {
      H5Dcreate2(file, path_.c_str(), type, space.get(), H5P_DEFAULT, settings.get(), H5P_DEFAULT),
      H5Dclose, fmt::format("make {}", path_)};
}

void GrowingDataset::append(const void* data, hsize_t rows, hid_t type) {
  if (rows == 0) return;
  const std::vector<hsize_t> size = {rows_ + rows, width_};
  require(H5Dset_extent(dataset_.get(), size.data()), fmt::format("extend {}", path_));
  write(rows_, data, rows, type);
  rows_ += rows;
}

void GrowingDataset::overwrite_last(const void* row, hid_t type) {
  write(rows_ - 1, row, 1, type);
}

void GrowingDataset::write(hsize_t begin, const void* data, hsize_t rows, hid_t type) {
  const Hdf5Handle space(H5Dget_space(dataset_.get()), H5Sclose, "read a dataspace");
  const std::vector<hsize_t> start = {begin, 0}, count = {rows, width_};
  require(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                              nullptr),
          "choose rows");
  const Hdf5Handle memory = simple_space(flat_ ? std::vector{rows} : count);
  require(H5Dwrite(dataset_.get(), type, memory.get(), space.get(), H5P_DEFAULT, data),
          fmt::format("write {}", path_));
}

}  // namespace gmsim::io
