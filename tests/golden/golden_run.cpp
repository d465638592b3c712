// SPDX-License-Identifier: MIT
#include "golden/golden_run.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <unistd.h>

#include <exception>
#include <fstream>
#include <ostream>
#include <sstream>

namespace gmsim::golden {
namespace {

namespace fs = std::filesystem;

/// The program's own mistakes never pass for an expected failure.
constexpr int kInternalError = 70;

/// A folder that lives as long as one case.
class Scratch {
 public:
  Scratch() : path_(fs::temp_directory_path() / fmt::format("gmsim-golden-{}", ::getpid())) {
    fs::create_directories(path_);
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string read_or_empty(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Prints the lines between the common beginning and the common end.
void print_difference(const std::string& expected, const std::string& actual,
                      std::ostream& report) {
  const std::vector<std::string> old_lines = lines_of(expected);
  const std::vector<std::string> new_lines = lines_of(actual);
  const std::size_t shorter = std::min(old_lines.size(), new_lines.size());
  std::size_t head = 0;
  while (head < shorter && old_lines[head] == new_lines[head]) ++head;
  std::size_t tail = 0;
  while (tail < shorter - head &&
         old_lines[old_lines.size() - 1 - tail] == new_lines[new_lines.size() - 1 - tail])
    ++tail;
  fmt::print(report, "  @@ line {}\n", head + 1);
  for (std::size_t i = head; i < old_lines.size() - tail; ++i)
    fmt::print(report, "  - {}\n", old_lines[i]);
  for (std::size_t i = head; i < new_lines.size() - tail; ++i)
    fmt::print(report, "  + {}\n", new_lines[i]);
  if (old_lines == new_lines) report << "  (the last line end differs)\n";
}

/// Compares or rewrites one expectation; an empty one has no file.
bool settle(const fs::path& file, const std::string& actual, Mode mode, std::ostream& report) {
  const std::string expected = read_or_empty(file);
  if (expected == actual) return true;
  if (mode == Mode::Compare) {
    fmt::print(report, "{}: the output differs\n", file.generic_string());
    print_difference(expected, actual, report);
    return false;
  }
  if (actual.empty()) {
    fs::remove(file);
  } else {
    std::ofstream(file, std::ios::binary) << actual;
  }
  fmt::print(report, "{}: updated\n", file.generic_string());
  return true;
}

struct Outcome {
  int exit_code = 0;
  std::string out;
  std::string err;
};

std::string without_scratch(std::string text, const fs::path& scratch) {
  const std::string path = scratch.generic_string();
  for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path, at))
    text.replace(at, path.size(), "%t");
  return text;
}

Outcome run_commands(const Case& which, const Cli& cli) {
  const Scratch scratch;
  std::ostringstream out;
  std::ostringstream err;
  Outcome outcome;
  for (const std::vector<std::string>& arguments :
       command_lines(which, read_or_empty(which.file), scratch.path())) {
    try {
      outcome.exit_code = cli(arguments, out, err);
    } catch (const std::exception& error) {
      err << "exception: " << error.what() << '\n';
      outcome.exit_code = kInternalError;
    }
    if (outcome.exit_code != 0) break;
  }
  outcome.out = without_scratch(out.str(), scratch.path());
  outcome.err = without_scratch(err.str(), scratch.path());
  return outcome;
}

}  // namespace

bool run_case(const Case& which, const Cli& cli, Mode mode, std::ostream& report) {
  const Outcome outcome = run_commands(which, cli);
  const bool failed = outcome.exit_code != 0;
  const bool as_named = failed == which.should_fail() && outcome.exit_code != kInternalError;
  if (!as_named)
    fmt::print(report, "{}: exit code {}, but the name asks for {}\n", which.file.generic_string(),
               outcome.exit_code, which.should_fail() ? "a failure" : "0");
  const bool same_out = settle(which.expected_out(), outcome.out, mode, report);
  const bool same_err = settle(which.expected_err(), outcome.err, mode, report);
  return as_named && same_out && same_err;
}

}  // namespace gmsim::golden
