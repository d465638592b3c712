// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "io/trajectory_reader.h"
#include "support/diagnostic.h"

namespace gmsim::io {

struct HtmlViewOptions {
  std::int64_t frames = 150;  ///< at most; taken evenly, the first and the last among them
  std::string field = {};     ///< colours the mesh when the page opens; empty: none does
  std::string title = {};
};

struct HtmlView {
  std::string text;         ///< the page
  std::int64_t frames = 0;  ///< that it shows
};

/// A page that shows a run in a browser: the viewer and the data in one file that needs no other
/// (docs/viewing.md says what it can do, interpreter/io/viewer/README.md how the data are laid
/// out). Coordinates are stored in 65534 steps of the run's bounding box, values of fields in 254
/// steps of their range.
///
/// Nothing after an error, which is reported: usage (no frames; an unknown field, or one that is
/// neither on points nor on cells) or file-error. Points that are not finite are a warning.
[[nodiscard]] std::optional<HtmlView> html_view(const TrajectoryReader& reader,
                                                const HtmlViewOptions& options,
                                                support::Diagnostics& diagnostics);

}  // namespace gmsim::io
