// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "support/diagnostic.h"

namespace gmsim::io {

/// Writes a whole file. Failure is reported as file-error with the reason and false.
bool write_file(const std::filesystem::path& path, std::string_view text,
                support::Diagnostics& diagnostics);

/// Text as it may stand in an attribute of XML.
[[nodiscard]] std::string xml_escaped(std::string_view text);

}  // namespace gmsim::io
