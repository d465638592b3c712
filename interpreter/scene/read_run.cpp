// SPDX-License-Identifier: MIT
#include "scene/read_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/integrators.h"

namespace gmsim::scene {
namespace {

using support::DiagnosticKind;

class RunReader {
 public:
  RunReader(support::SourceMap& sources, support::Diagnostics& diagnostics, Scene& scene)
      : sources_(sources), diagnostics_(diagnostics), scene_(scene) {}

  void read(const YamlNode& tree) {
    const YamlNode* duration = tree.find("duration");
    if (duration != nullptr) scene_.duration = number(*duration);
    scene_.seed = static_cast<std::uint64_t>(number(*tree.find("seed")));
    scene_.stop_at = times(*tree.find("stop_at"), duration != nullptr);
    read_integrator(*tree.find("integrator"));
    const YamlNode& output = *tree.find("output");
    if (const YamlNode* file = output.find("file")) scene_.output.file = file->text;
    scene_.output.every = number(*output.find("every"));
    scene_.output.at = times(*output.find("at"), duration != nullptr);
    scene_.output.report_every = number(*output.find("report_every"));
    scene_.output.sync = output.find("sync")->text == "true";
  }

 private:
  [[nodiscard]] double number(const YamlNode& node) { return number_of(node, sources_); }

  /// Ascending, each once.
  std::vector<double> times(const YamlNode& list, bool bounded) {
    std::vector<double> result;
    for (const YamlNode& item : list.items) {
      result.push_back(number(item));
      if (bounded && result.back() > scene_.duration)
        diagnostics_.report({.kind = DiagnosticKind::OutOfRange,
                             .message = fmt::format("this is after the end, {} s", scene_.duration),
                             .place = item.span});
    }
    std::ranges::sort(result);
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  void read_integrator(const YamlNode& section) {
    engine::IntegratorSettings& settings = scene_.integrator;
    settings.method = section.find("method")->text;
    const YamlNode& dt = *section.find("dt");
    settings.dt = dt.text == "auto" ? 0.0 : number(dt);
    const std::string& unstable = section.find("on_unstable")->text;
    settings.on_unstable = unstable == "warn"      ? engine::OnUnstable::Warn
                           : unstable == "substep" ? engine::OnUnstable::Substep
                                                   : engine::OnUnstable::Error;
    settings.rtol = number(*section.find("rtol"));
    settings.atol_position = number(*section.find("atol_position"));
    settings.atol_velocity = number(*section.find("atol_velocity"));
    settings.dt_min = number(*section.find("dt_min"));
    settings.dt_max = number(*section.find("dt_max"));
    settings.span = section.find("method")->span;
    if (auto problem = engine::settings_problem(settings)) diagnostics_.report(std::move(*problem));
    settings.span.reset();
    for (const YamlNode* node : {section.find("method"), &dt})
      if (!node->is_default) settings.span = node->span;
    if (settings.dt_max > 0 && settings.dt_min > settings.dt_max)
      diagnostics_.report(
          {.kind = DiagnosticKind::OutOfRange,
           .message = fmt::format("`dt_min` is above `dt_max`, {} s", settings.dt_max),
           .place = section.find("dt_min")->span});
  }

  support::SourceMap& sources_;
  support::Diagnostics& diagnostics_;
  Scene& scene_;
};

}  // namespace

void read_run(const YamlNode& tree, support::SourceMap& sources, support::Diagnostics& diagnostics,
              Scene& scene) {
  RunReader(sources, diagnostics, scene).read(tree);
}

}  // namespace gmsim::scene
