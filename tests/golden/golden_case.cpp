// SPDX-License-Identifier: MIT
#include "golden/golden_case.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace gmsim::golden {
namespace {

namespace fs = std::filesystem;

bool is_case(const fs::path& file) {
  const fs::path extension = file.extension();
  return extension == ".rule" || extension == ".yaml" || extension == ".cmd";
}

bool is_expectation(const fs::path& file) {
  return file.extension() == ".out" || file.extension() == ".err";
}

/// The files that lie directly in one of the areas, sorted.
std::vector<fs::path> area_files(const fs::path& root) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& area : fs::directory_iterator(root)) {
    if (!area.is_directory()) continue;
    for (const fs::directory_entry& entry : fs::directory_iterator(area.path()))
      if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool is_wanted(const fs::path& file, const std::vector<std::string>& filters) {
  const std::string area = file.parent_path().filename().string();
  const std::string name = area + "/" + file.stem().string();
  return filters.empty() || std::any_of(filters.begin(), filters.end(), [&](const auto& filter) {
           return filter == area || filter == name;
         });
}

void replace_all(std::string& text, std::string_view from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
}

/// What follows `args:` in the comment that opens a rule or YAML file; empty when there is none.
std::string_view args_comment(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  for (std::string_view opening : {"// args:", "# args:"})
    if (line.starts_with(opening)) return line.substr(opening.size());
  return {};
}

std::vector<std::string> raw_lines(const Case& which, std::string_view text) {
  if (which.file.extension() != ".cmd") {
    const std::string_view args = args_comment(text);
    return {args.empty() ? "check %s" : std::string(args)};
  }
  std::vector<std::string> lines;
  std::istringstream in{std::string(text)};
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line.front() != '#') lines.push_back(line);
  return lines;
}

}  // namespace

fs::path Case::expected_out() const {
  return fs::path(file).replace_extension(".out");
}
fs::path Case::expected_err() const {
  return fs::path(file).replace_extension(".err");
}

std::vector<Case> find_cases(const fs::path& root, const std::vector<std::string>& filters) {
  std::vector<Case> cases;
  for (const fs::path& file : area_files(root))
    if (is_case(file) && is_wanted(file, filters)) cases.push_back({file});
  return cases;
}

std::vector<fs::path> find_orphans(const fs::path& root) {
  const std::vector<fs::path> files = area_files(root);
  std::set<fs::path> stems;
  for (const fs::path& file : files)
    if (is_case(file)) stems.insert(fs::path(file).replace_extension());
  std::vector<fs::path> orphans;
  for (const fs::path& file : files)
    if (is_expectation(file) && !stems.contains(fs::path(file).replace_extension()))
      orphans.push_back(file);
  return orphans;
}

std::vector<std::string> split_arguments(std::string_view line) {
  std::vector<std::string> arguments;
  bool inside = false;  // of an argument, which may be empty when quoted
  char quote = '\0';
  for (char c : line) {
    const bool blank = c == ' ' || c == '\t' || c == '\r';
    if (quote != '\0' && c == quote) {
      quote = '\0';
    } else if (quote == '\0' && blank) {
      inside = false;
    } else {
      if (!inside) arguments.emplace_back();
      inside = true;
      if (quote == '\0' && (c == '"' || c == '\'')) {
        quote = c;
      } else {
        arguments.back() += c;
      }
    }
  }
  return arguments;
}

std::vector<std::vector<std::string>> command_lines(const Case& which, std::string_view text,
                                                    const fs::path& scratch) {
  std::vector<std::vector<std::string>> commands;
  for (const std::string& line : raw_lines(which, text)) {
    std::vector<std::string> arguments = split_arguments(line);
    for (std::string& argument : arguments) {
      replace_all(argument, "%s", which.file.generic_string());
      replace_all(argument, "%d", which.file.parent_path().generic_string());
      replace_all(argument, "%t", scratch.generic_string());
    }
    commands.push_back(std::move(arguments));
  }
  return commands;
}

}  // namespace gmsim::golden
