// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace gmsim::fuzz {

/// Reads a text in every way the parser offers. Whatever the text is, there must be a tree or
/// messages with places inside of the text, and what was read must survive being reprinted.
/// Stops the program where that does not hold.
void check_parsing(const std::string& text);

}  // namespace gmsim::fuzz
