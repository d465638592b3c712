// SPDX-License-Identifier: MIT
#include "io/recover.h"

#include <fmt/format.h>
#include <unistd.h>

#include "io/trajectory_metadata.h"
#include "io/trajectory_tables.h"

namespace gmsim::io {

namespace {

using support::DiagnosticKind;
using support::Diagnostics;

/// Cuts every dataset down to the rows it had when frame `frames` - 1 was finished.
void cut_to_extents(hid_t file, std::int64_t frames) {
  const auto names = read_extent_names(file);
  const auto rows = read_rows<std::int64_t>(open_dataset(file, "/gmsim/extents"),
                                            static_cast<hsize_t>(frames - 1), 1);
  if (rows.size() != names.size()) throw Hdf5Error{"/gmsim/extents does not fit its names"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Hdf5Handle dataset = open_dataset(file, "/" + names[i]);
    const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose, "read a dataspace");
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank < 1 || rows[i] < 0) throw Hdf5Error{fmt::format("{} is no table", names[i])};
    std::vector<hsize_t> size(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.get(), size.data(), nullptr);
    if (size[0] < static_cast<hsize_t>(rows[i]))
      throw Hdf5Error{fmt::format("{} has lost rows", names[i])};
    size[0] = static_cast<hsize_t>(rows[i]);
    require(H5Dset_extent(dataset.get(), size.data()), fmt::format("cut {}", names[i]));
  }
}

/// Writes the copy of the first `frames` frames.
void copy_frames(const Hdf5Handle& source, std::int64_t frames,
                 const std::filesystem::path& target) {
  Hdf5Handle copy = create_file(target);
  for (const char* group : {"VTKHDF", "gmsim"}) {
    require(H5Ocopy(source.get(), group, copy.get(), group, H5P_DEFAULT, H5P_DEFAULT),
            fmt::format("copy the group {}", group));
  }
  cut_to_extents(copy.get(), frames);
  // The source may have gone on since its number of steps was read.
  overwrite_attribute(copy.get(), "/VTKHDF/Steps", "NSteps", H5T_NATIVE_INT64, &frames);
  require(H5Fflush(copy.get(), H5F_SCOPE_GLOBAL), "store the copy");
}

/// A name beside the target that no other process uses.
std::filesystem::path temporary_path(const std::filesystem::path& target) {
  std::filesystem::path temporary = target;
  temporary += fmt::format(".{}.tmp", getpid());
  return temporary;
}

std::int64_t recover_or_throw(const std::filesystem::path& source,
                              const std::filesystem::path& target,
                              const std::filesystem::path& temporary) {
  std::error_code error;
  if (!std::filesystem::exists(source, error)) throw Hdf5Error{"there is no such file"};
  if (std::filesystem::equivalent(source, target, error))
    throw Hdf5Error{"source and target are one file"};
  const Hdf5Handle file = open_for_reading(source);
  check_format(file.get());
  const std::int64_t frames = read_number_attribute(file.get(), "/VTKHDF/Steps", "NSteps");
  if (frames < 1) throw Hdf5Error{"no frame of this run was finished: there is nothing to recover"};
  copy_frames(file, frames, temporary);
  std::filesystem::rename(temporary, target, error);
  if (error)
    throw Hdf5Error{
        fmt::format("the copy cannot be named {}: {}", target.string(), error.message())};
  return frames;
}

}  // namespace

std::optional<std::int64_t> recover(const std::filesystem::path& source,
                                    const std::filesystem::path& target, Diagnostics& diagnostics) {
  const std::filesystem::path temporary = temporary_path(target);
  try {
    return recover_or_throw(source, target, temporary);
  } catch (const Hdf5Error& error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    diagnostics.report({.kind = DiagnosticKind::FileError,
                        .message = fmt::format("{}: {}", source.string(), error.message)});
    return std::nullopt;
  }
}

std::filesystem::path recovered_path(const std::filesystem::path& source) {
  std::filesystem::path target = source;
  if (source.extension() == ".part") return target.replace_extension();
  return target.replace_filename("recovered-" + source.filename().string());
}

}  // namespace gmsim::io
