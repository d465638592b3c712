// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "support/diagnostic.h"

namespace gmsim::io {

/// Copies the frames that are safe in a `.part` (of a run that was killed, failed, or is still
/// going on) to a file that every reader opens. The source is only read, never touched; `target`
/// appears when it is whole. Returns the number of frames; nothing after an error, which is
/// reported as file-error.
[[nodiscard]] std::optional<std::int64_t> recover(const std::filesystem::path& source,
                                                  const std::filesystem::path& target,
                                                  support::Diagnostics& diagnostics);

/// What `recover` writes unless told otherwise: NAME for NAME.part, else NAME with "recovered-"
/// before.
[[nodiscard]] std::filesystem::path recovered_path(const std::filesystem::path& source);

}  // namespace gmsim::io
