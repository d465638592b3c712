// SPDX-License-Identifier: MIT
#include "support/rule_mutants.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "support/scheme_text.h"

namespace gmsim::tests {
namespace {

using check::kBlank;
using check::LabelEntry;
using check::NodeIndex;
using check::Pattern;
using check::PatternArc;
using check::PatternNode;
using check::Rule;

enum Sides { kLeft = 1, kRight = 2, kBoth = 3 };

class Mutation {
 public:
  Mutation(Rule rule, Random& random) : rule_(std::move(rule)), random_(random) {}

  Mutant run() {
    std::string how;
    const int count = 1 + (chance(random_, 0.35) ? 1 : 0) + (chance(random_, 0.15) ? 1 : 0);
    for (int k = 0; k < count; ++k) {
      const Change& change =
          kChanges[static_cast<std::size_t>(below(random_, static_cast<int>(std::size(kChanges))))];
      if (!(this->*change.apply)()) continue;
      how += (how.empty() ? "" : ", ") + std::string(change.name);
    }
    pair_nodes_by_name(rule_);
    for (NodeIndex node = 0; node < rule_.left.nodes.size(); ++node)
      rule_.left.nodes[node].slot = types::Slot{node};
    return {std::move(rule_), how.empty() ? "nothing" : how};
  }

 private:
  struct Change {
    const char* name;
    bool (Mutation::*apply)();
  };
  static const std::array<Change, 21> kChanges;

  int dimension() const { return rule_.dimension; }
  std::size_t positions() const {
    return rule_.left.nodes.empty() ? 0 : rule_.left.nodes.front().label.size();
  }
  Sides random_sides() { return static_cast<Sides>(1 + below(random_, 3)); }
  int pick(std::size_t size) { return below(random_, static_cast<int>(size)); }
  std::vector<Pattern*> sides(Sides which) {
    std::vector<Pattern*> result;
    if (which & kLeft) result.push_back(&rule_.left);
    if (which & kRight) result.push_back(&rule_.right);
    return result;
  }
  static std::optional<NodeIndex> find(const Pattern& side, const std::string& name) {
    for (NodeIndex node = 0; node < side.nodes.size(); ++node)
      if (side.nodes[node].name == name) return node;
    return std::nullopt;
  }
  std::string fresh_name() {
    for (int k = 0;; ++k) {
      const std::string name = "z" + std::to_string(k);
      if (!find(rule_.left, name) && !find(rule_.right, name)) return name;
    }
  }
  /// A node of a random side, or none when there are no nodes.
  std::optional<std::string> random_node() {
    const Pattern& side = *sides(chance(random_, 0.5) ? kLeft : kRight).front();
    if (side.nodes.empty()) return std::nullopt;
    return side.nodes[static_cast<std::size_t>(pick(side.nodes.size()))].name;
  }

  bool change_label_entry() {
    const std::optional<std::string> name = random_node();
    if (!name || positions() == 0) return false;
    const std::size_t p = static_cast<std::size_t>(pick(positions()));
    const auto entry = static_cast<LabelEntry>(below(random_, dimension() + 2) - 1);
    for (Pattern* side : sides(random_sides()))
      if (const std::optional<NodeIndex> node = find(*side, *name))
        side->nodes[*node].label[p] = entry;
    return true;
  }
  bool swap_label_entries() {
    const std::optional<std::string> name = random_node();
    if (!name || positions() < 2) return false;
    const std::size_t p = static_cast<std::size_t>(pick(positions()));
    const std::size_t q = static_cast<std::size_t>(pick(positions()));
    for (Pattern* side : sides(random_sides()))
      if (const std::optional<NodeIndex> node = find(*side, *name))
        std::swap(side->nodes[*node].label[p], side->nodes[*node].label[q]);
    return true;
  }
  /// Permutes positions in the labels of one side (a relocation) or of both (another spelling).
  bool permute_positions() {
    if (positions() < 2) return false;
    std::vector<std::size_t> order(positions());
    for (std::size_t p = 0; p < order.size(); ++p) order[p] = p;
    std::shuffle(order.begin(), order.end(), random_);
    for (Pattern* side : sides(chance(random_, 0.5) ? kBoth : kRight))
      for (PatternNode& node : side->nodes) {
        const std::vector<LabelEntry> label = node.label;
        if (label.size() == order.size())
          for (std::size_t p = 0; p < order.size(); ++p) node.label[p] = label[order[p]];
      }
    return true;
  }
  bool permute_dimensions() {
    std::vector<int> image(static_cast<std::size_t>(dimension()) + 1);
    for (std::size_t i = 0; i < image.size(); ++i) image[i] = static_cast<int>(i);
    // Turning the dimensions round keeps what commutes; another order rarely does.
    if (chance(random_, 0.7)) {
      std::reverse(image.begin(), image.end());
    } else {
      std::shuffle(image.begin(), image.end(), random_);
    }
    for (Pattern* side : sides(chance(random_, 0.7) ? kBoth : random_sides())) {
      for (PatternNode& node : side->nodes)
        for (LabelEntry& entry : node.label)
          if (entry != kBlank)
            entry = static_cast<LabelEntry>(image[static_cast<std::size_t>(entry)]);
      for (PatternArc& arc : side->arcs)
        arc.dimension = image[static_cast<std::size_t>(arc.dimension)];
    }
    return true;
  }
  bool drop_arc() {
    const Pattern& from = *sides(chance(random_, 0.5) ? kLeft : kRight).front();
    if (from.arcs.empty()) return false;
    const PatternArc arc = from.arcs[static_cast<std::size_t>(pick(from.arcs.size()))];
    const std::string a = from.nodes[arc.a].name, b = from.nodes[arc.b].name;
    for (Pattern* side : sides(random_sides()))
      std::erase_if(side->arcs, [&](const PatternArc& other) {
        const std::string &c = side->nodes[other.a].name, &d = side->nodes[other.b].name;
        return other.dimension == arc.dimension && ((c == a && d == b) || (c == b && d == a));
      });
    return true;
  }
  bool add_arc() {
    const std::optional<std::string> a = random_node(), b = random_node();
    if (!a) return false;
    const int i = below(random_, dimension() + 1);
    for (Pattern* side : sides(random_sides())) {
      const std::optional<NodeIndex> from = find(*side, *a);
      const std::optional<NodeIndex> to = b && chance(random_, 0.5) ? find(*side, *b) : from;
      if (from && to) side->arcs.push_back({i, *from, *to, {}});
    }
    return true;
  }
  /// Cuts an arc of `right` into loops, or joins two loops to an arc.
  bool cut_or_join() {
    Pattern& right = rule_.right;
    if (right.arcs.empty()) return false;
    PatternArc& arc = right.arcs[static_cast<std::size_t>(pick(right.arcs.size()))];
    if (arc.a != arc.b) {
      const PatternArc loop{arc.dimension, arc.b, arc.b, {}};
      arc.b = arc.a;
      right.arcs.push_back(loop);
      return true;
    }
    for (PatternArc& other : right.arcs)
      if (&other != &arc && other.a == other.b && other.dimension == arc.dimension) {
        arc.b = other.a;
        right.arcs.erase(right.arcs.begin() + (&other - right.arcs.data()));
        return true;
      }
    return false;
  }
  /// Makes one end of an arc of `right` free and forgets the other.
  bool cut_one_end() {
    Pattern& right = rule_.right;
    if (right.arcs.empty()) return false;
    PatternArc& arc = right.arcs[static_cast<std::size_t>(pick(right.arcs.size()))];
    if (chance(random_, 0.5)) std::swap(arc.a, arc.b);
    arc.b = arc.a;
    return true;
  }
  /// Exchanges the ends of two arcs of one dimension in `right`.
  bool cross_arcs() {
    Pattern& right = rule_.right;
    if (right.arcs.size() < 2) return false;
    PatternArc& first = right.arcs[static_cast<std::size_t>(pick(right.arcs.size()))];
    PatternArc& second = right.arcs[static_cast<std::size_t>(pick(right.arcs.size()))];
    if (first.dimension != second.dimension) return false;
    std::swap(first.b, second.b);
    return true;
  }
  bool change_arc_dimension() {
    Pattern& side = *sides(chance(random_, 0.5) ? kLeft : kRight).front();
    if (side.arcs.empty()) return false;
    side.arcs[static_cast<std::size_t>(pick(side.arcs.size()))].dimension =
        below(random_, dimension() + 1);
    return true;
  }
  bool swap_sides() {
    if (rule_.right.nodes.empty()) return false;
    std::swap(rule_.left, rule_.right);
    pair_nodes_by_name(rule_);
    // A node of the old hook's name may serve, else any with a full label.
    std::vector<NodeIndex> hooks;
    for (NodeIndex node = 0; node < rule_.left.nodes.size() && hooks.empty(); ++node)
      if (std::count(rule_.left.nodes[node].label.begin(), rule_.left.nodes[node].label.end(),
                     kBlank) == 0)
        hooks.push_back(node);
    rule_.hooks = hooks;
    return true;
  }
  bool remove_node() {
    const std::optional<std::string> name = random_node();
    if (!name) return false;
    for (Pattern* side : sides(random_sides())) {
      const std::optional<NodeIndex> gone = find(*side, *name);
      if (!gone) continue;
      const bool left = side == &rule_.left;
      if (left && std::count(rule_.hooks.begin(), rule_.hooks.end(), *gone) > 0) continue;
      std::erase_if(side->arcs,
                    [&](const PatternArc& arc) { return arc.a == *gone || arc.b == *gone; });
      for (PatternArc& arc : side->arcs) {
        arc.a -= arc.a > *gone ? 1 : 0;
        arc.b -= arc.b > *gone ? 1 : 0;
      }
      if (left)
        for (NodeIndex& hook : rule_.hooks) hook -= hook > *gone ? 1 : 0;
      side->nodes.erase(side->nodes.begin() + *gone);
    }
    return true;
  }
  bool duplicate_node() {
    const std::optional<std::string> name = random_node();
    if (!name) return false;
    const std::string copy = fresh_name();
    for (Pattern* side : sides(random_sides())) {
      const std::optional<NodeIndex> node = find(*side, *name);
      if (!node) continue;
      const auto added = static_cast<NodeIndex>(side->nodes.size());
      PatternNode twin = side->nodes[*node];
      twin.name = copy;
      side->nodes.push_back(twin);
      const std::vector<PatternArc> arcs = side->arcs;
      for (const PatternArc& arc : arcs)
        if (arc.a == *node && arc.b == *node)
          side->arcs.push_back({arc.dimension, added, added, {}});
    }
    return true;
  }
  /// A node of `right` under another name: the old one is removed, a new one made in its place.
  bool rename_right_node() {
    if (rule_.right.nodes.empty()) return false;
    rule_.right.nodes[static_cast<std::size_t>(pick(rule_.right.nodes.size()))].name = fresh_name();
    return true;
  }
  bool swap_right_names() {
    std::vector<PatternNode>& nodes = rule_.right.nodes;
    if (nodes.size() < 2) return false;
    std::swap(nodes[static_cast<std::size_t>(pick(nodes.size()))].name,
              nodes[static_cast<std::size_t>(pick(nodes.size()))].name);
    return true;
  }
  /// Writes a label position out as two copies of every node: fewer maps match, nothing else
  /// changes.
  bool unfold_position() {
    if (positions() == 0 || rule_.left.nodes.size() + rule_.right.nodes.size() > 12) return false;
    const std::size_t p = static_cast<std::size_t>(pick(positions()));
    for (Pattern* side : sides(kBoth)) unfold(*side, p);
    return true;
  }
  static void unfold(Pattern& side, std::size_t p) {
    const auto count = static_cast<NodeIndex>(side.nodes.size());
    for (NodeIndex node = 0; node < count; ++node) {
      std::vector<LabelEntry>& label = side.nodes[node].label;
      const LabelEntry entry = label[p];
      label.erase(label.begin() + static_cast<std::ptrdiff_t>(p));
      PatternNode copy = side.nodes[node];
      copy.name += "u";
      side.nodes.push_back(std::move(copy));
      if (entry != kBlank) side.arcs.push_back({entry, node, node + count, {}});
    }
    const std::vector<PatternArc> arcs = side.arcs;
    for (const PatternArc& arc : arcs)
      if (arc.a < count && arc.b < count)
        side.arcs.push_back({arc.dimension, arc.a + count, arc.b + count, {}});
  }
  /// Requires a kept node to be free in a dimension that nothing mentions.
  bool require_free() {
    const std::optional<std::string> name = random_node();
    if (!name) return false;
    const int i = below(random_, dimension() + 1);
    for (Pattern* side : sides(kBoth)) {
      const std::optional<NodeIndex> node = find(*side, *name);
      if (!node || mentions(*side, *node, i)) return false;
    }
    for (Pattern* side : sides(kBoth)) {
      const NodeIndex node = *find(*side, *name);
      side->arcs.push_back({i, node, node, {}});
    }
    return true;
  }
  static bool mentions(const Pattern& side, NodeIndex node, int i) {
    const std::vector<LabelEntry>& label = side.nodes[node].label;
    return std::count(label.begin(), label.end(), i) > 0 ||
           std::any_of(side.arcs.begin(), side.arcs.end(), [&](const PatternArc& arc) {
             return arc.dimension == i && (arc.a == node || arc.b == node);
           });
  }
  /// Writes the fourth side of a square of `left`, in `right` too where it is free to stand.
  bool write_implied_arc() {
    struct End {
      NodeIndex node;
      int i;
    };
    const Pattern& left = rule_.left;
    const auto over = [&](NodeIndex node, int i) -> std::optional<NodeIndex> {
      for (const PatternArc& arc : left.arcs) {
        if (arc.dimension == i && arc.a == node) return arc.b;
        if (arc.dimension == i && arc.b == node) return arc.a;
      }
      return std::nullopt;
    };
    for (NodeIndex r = 0; r < left.nodes.size(); ++r)
      for (int i = 0; i <= dimension(); ++i)
        for (int j = 0; j <= dimension(); ++j) {
          if (i - j < 2 && j - i < 2) continue;
          const std::optional<NodeIndex> s = over(r, i), t = over(r, j);
          if (!s || !t) continue;
          const std::optional<NodeIndex> u = over(*s, j);
          if (!u || mentions(left, *t, i) || mentions(left, *u, i)) continue;
          const std::string a = left.nodes[*t].name, b = left.nodes[*u].name;
          rule_.left.arcs.push_back({i, *t, *u, {}});
          const std::optional<NodeIndex> ra = find(rule_.right, a), rb = find(rule_.right, b);
          if (ra && rb && !mentions(rule_.right, *ra, i) && !mentions(rule_.right, *rb, i))
            rule_.right.arcs.push_back({i, *ra, *rb, {}});
          return true;
        }
    return false;
  }
  /// The same operation in a map of one dimension more, for every label.
  bool lift() {
    if (dimension() == 3 || positions() > 3) return false;
    rule_.dimension += 1;
    for (Pattern* side : sides(kBoth))
      for (PatternNode& node : side->nodes)
        node.label.push_back(static_cast<LabelEntry>(rule_.dimension));
    return true;
  }
  bool toggle_hook() {
    if (rule_.left.nodes.empty()) return false;
    const auto node = static_cast<NodeIndex>(pick(rule_.left.nodes.size()));
    const auto found = std::find(rule_.hooks.begin(), rule_.hooks.end(), node);
    if (found != rule_.hooks.end()) {
      rule_.hooks.erase(found);
    } else if (rule_.hooks.empty() || chance(random_, 0.2)) {
      rule_.hooks.push_back(node);
    } else {
      rule_.hooks.front() = node;
    }
    return true;
  }

  Rule rule_;
  Random& random_;
};

const std::array<Mutation::Change, 21> Mutation::kChanges{{
    {"change label entry", &Mutation::change_label_entry},
    {"swap label entries", &Mutation::swap_label_entries},
    {"permute positions", &Mutation::permute_positions},
    {"permute dimensions", &Mutation::permute_dimensions},
    {"drop arc", &Mutation::drop_arc},
    {"add arc", &Mutation::add_arc},
    {"cut or join", &Mutation::cut_or_join},
    {"cut one end", &Mutation::cut_one_end},
    {"cross arcs", &Mutation::cross_arcs},
    {"change arc dimension", &Mutation::change_arc_dimension},
    {"swap sides", &Mutation::swap_sides},
    {"remove node", &Mutation::remove_node},
    {"duplicate node", &Mutation::duplicate_node},
    {"rename right node", &Mutation::rename_right_node},
    {"swap right names", &Mutation::swap_right_names},
    {"unfold position", &Mutation::unfold_position},
    {"unfold position", &Mutation::unfold_position},
    {"require free", &Mutation::require_free},
    {"write implied arc", &Mutation::write_implied_arc},
    {"lift", &Mutation::lift},
    {"move hook", &Mutation::toggle_hook},
}};

}  // namespace

Mutant mutate(const Rule& rule, Random& random) {
  return Mutation(rule, random).run();
}

}  // namespace gmsim::tests
