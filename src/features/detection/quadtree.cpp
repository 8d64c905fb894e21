#include "features/detection/quadtree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace stdc {
namespace {

template <typename T>
std::size_t at(T index) {
  return static_cast<std::size_t>(index);
}

// The better of two candidates stays when the overshoot is dropped.
bool is_better(const Candidate& a, const Candidate& b) {
  if (a.quality != b.quality) return a.quality > b.quality;
  return a.response > b.response;
}

}  // namespace

// Appends the children of a node that are not empty (case 2) to next_; keeps the order of the points in each.
void Quadtree::split(const Node& node) {
  const Cell& c = node.cell;
  const int x = (c.left + c.right) / 2, y = (c.top + c.bottom) / 2;
  const auto quadrant = [x, y](const Point& p) { return at((p.x >= x ? 1 : 0) + (p.y >= y ? 2 : 0)); };
  std::array<int, 4> counts{}, high{};
  for (std::size_t i = at(node.begin); i < at(node.end); ++i) {
    const Point p = points_[i];
    scratch_[i] = p;
    ++counts[quadrant(p)];
    high[quadrant(p)] += static_cast<int>(p.high);
  }
  const Cell cells[4] = {
      {c.left, c.top, x, y}, {x, c.top, c.right, y}, {c.left, y, x, c.bottom}, {x, y, c.right, c.bottom}};
  std::array<int, 4> next{};
  int begin = node.begin;
  for (std::size_t q = 0; q < 4; ++q) {
    next[q] = begin;
    if (counts[q] > 0) next_.push_back({cells[q], begin, begin + counts[q], high[q]});
    begin += counts[q];
  }
  for (std::size_t i = at(node.begin); i < at(node.end); ++i) {
    points_[at(next[quadrant(scratch_[i])]++)] = scratch_[i];
  }
}

void Quadtree::make_roots(std::span<const Candidate> candidates, const Cell& area) {
  const int width = area.right - area.left, height = area.bottom - area.top;
  // Twice as many each way as near-square roots: the first split of each is taken at once.
  const int columns = 2 * std::max(1, static_cast<int>(std::lround(static_cast<double>(width) / height)));
  const int rows = 2 * std::max(1, static_cast<int>(std::lround(static_cast<double>(height) / width)));
  const auto root_of = [&](const Candidate& p) {
    return at((p.y - area.top) * rows / height * columns + (p.x - area.left) * columns / width);
  };
  const auto edge = [](int origin, int size, int i, int parts) {
    return origin + (i * size + parts - 1) / parts;
  };
  std::vector<Node> roots(at(rows * columns));
  for (const Candidate& p : candidates) {
    Node& root = roots[root_of(p)];
    ++root.end;
    root.high += p.quality == KeypointQuality::high ? 1 : 0;
  }
  std::vector<int> next;
  int begin = 0;
  for (int i = 0; i < rows * columns; ++i) {
    Node& root = roots[at(i)];
    const int row = i / columns, column = i % columns;
    root.cell = {edge(area.left, width, column, columns), edge(area.top, height, row, rows),
                 edge(area.left, width, column + 1, columns), edge(area.top, height, row + 1, rows)};
    root.begin = begin;
    next.push_back(begin);
    begin += root.end;
    root.end = begin;
    if (root.size() > 0) nodes_.push_back(root);
  }
  points_.resize(candidates.size());
  scratch_.resize(candidates.size());
  for (std::uint32_t i = 0; i < candidates.size(); ++i) {
    const Candidate& p = candidates[i];
    points_[at(next[root_of(p)]++)] = {p.x, p.y, i, p.quality == KeypointQuality::high ? 1U : 0U};
  }
}

// Splits the nodes of one depth until there are `budget` nodes. False if there is nothing to split.
bool Quadtree::split_nodes(int budget, Selection selection) {
  const bool improved = selection == Selection::improved;
  queue_.clear();
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
    const Node& node = nodes_[at(i)];
    if (node.size() > 1 && (!improved || node.high >= 1)) queue_.push_back(i);
  }
  if (queue_.empty()) return false;
  const auto rank = [&](int i) {
    const Node& node = nodes_[at(i)];
    return std::pair(improved ? node.high : 0, node.size());
  };
  std::stable_sort(queue_.begin(), queue_.end(), [&](int a, int b) { return rank(a) > rank(b); });
  next_.clear();
  std::size_t untouched = nodes_.size();
  for (const int i : queue_) {
    Node& node = nodes_[at(i)];
    split(node);
    node.end = node.begin;  // replaced by its children
    --untouched;
    if (untouched + next_.size() >= at(budget)) break;
  }
  std::copy_if(nodes_.begin(), nodes_.end(), std::back_inserter(next_),
               [](const Node& n) { return n.size() > 0; });
  nodes_.swap(next_);
  return true;
}

void Quadtree::collect_winners(std::span<const Candidate> candidates, int budget) {
  winners_.clear();
  for (const Node& node : nodes_) {
    std::uint32_t best = points_[at(node.begin)].index;
    for (int i = node.begin + 1; i < node.end; ++i) {
      const std::uint32_t index = points_[at(i)].index;
      if (candidates[index].response > candidates[best].response) best = index;
    }
    winners_.push_back({static_cast<int>(best), node.cell});
  }
  if (winners_.size() > at(budget)) {
    std::stable_sort(winners_.begin(), winners_.end(), [&](const Winner& a, const Winner& b) {
      return is_better(candidates[at(a.candidate)], candidates[at(b.candidate)]);
    });
    winners_.resize(at(budget));
  }
  std::sort(winners_.begin(), winners_.end(),
            [](const Winner& a, const Winner& b) { return a.candidate < b.candidate; });
  for (const Winner& winner : winners_) {
    selected_.push_back(winner.candidate);
    cells_.push_back(winner.cell);
  }
}

const std::vector<int>& Quadtree::select(std::span<const Candidate> candidates, const Cell& area, int budget,
                                         Selection selection) {
  selected_.clear();
  cells_.clear();
  nodes_.clear();
  if (candidates.empty() || budget <= 0) return selected_;
  make_roots(candidates, area);
  while (nodes_.size() < at(budget) && split_nodes(budget, selection)) {
  }
  collect_winners(candidates, budget);
  return selected_;
}

}  // namespace stdc
