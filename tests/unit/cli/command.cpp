// SPDX-License-Identifier: MIT
#include "unit/cli/command.h"

#include <stdlib.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "cli/run_cli.h"

namespace gmsim::test {

Command run_command(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int exit_code = cli::run_cli(arguments, out, err);
  return {exit_code, out.str(), err.str()};
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TestFolder::TestFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "gmsim-cli-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TestFolder::~TestFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string TestFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return file(name);
}

bool TestFolder::has(const std::string& name) const {
  return std::filesystem::exists(path_ / name);
}

}  // namespace gmsim::test
