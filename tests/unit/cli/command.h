// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gmsim::test {

/// What a command line did.
struct Command {
  int exit_code = 0;
  std::string out, err;
};
[[nodiscard]] Command run_command(const std::vector<std::string>& arguments);

[[nodiscard]] bool has(const std::string& text, const std::string& part);

/// A folder that lives as long as one test.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const;
  [[nodiscard]] bool has(const std::string& name) const;

 private:
  std::filesystem::path path_;
};

}  // namespace gmsim::test
