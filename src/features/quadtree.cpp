#include "features/quadtree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace stdc {
namespace {

bool may_split(int points, int high, Selection selection) {
  return points > 1 && (selection == Selection::orb_slam3 || high >= 1);
}

// The better of two candidates comes first when the overshoot is dropped.
bool is_better(const Candidate& a, const Candidate& b) {
  if (a.quality != b.quality) return a.quality > b.quality;
  return a.response > b.response;
}

}  // namespace

void Quadtree::append_node(std::span<const Candidate> candidates, const Cell& cell, int begin, int end) {
  if (begin == end) return;  // case 2: an empty node is removed
  Node node{cell, begin, end, 0};
  for (int i = begin; i < end; ++i) {
    const Candidate& candidate = candidates[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
    node.high += candidate.quality == KeypointQuality::high ? 1 : 0;
  }
  next_.push_back(node);
}

// Appends the children of a node that are not empty to next_; keeps the order of the points in each.
void Quadtree::split(std::span<const Candidate> candidates, const Node& node) {
  const Cell& c = node.cell;
  const int middle_x = (c.left + c.right) / 2, middle_y = (c.top + c.bottom) / 2;
  std::array<int, 4> counts{};
  const auto quadrant = [&](int index) {
    const Candidate& p = candidates[static_cast<std::size_t>(index)];
    return static_cast<std::size_t>((p.x >= middle_x ? 1 : 0) + (p.y >= middle_y ? 2 : 0));
  };
  for (int i = node.begin; i < node.end; ++i) {
    scratch_[static_cast<std::size_t>(i)] = order_[static_cast<std::size_t>(i)];
    ++counts[quadrant(order_[static_cast<std::size_t>(i)])];
  }
  std::array<int, 5> begins{node.begin};
  for (std::size_t q = 0; q < 4; ++q) begins[q + 1] = begins[q] + counts[q];
  std::array<int, 4> next{begins[0], begins[1], begins[2], begins[3]};
  for (int i = node.begin; i < node.end; ++i) {
    const int index = scratch_[static_cast<std::size_t>(i)];
    order_[static_cast<std::size_t>(next[quadrant(index)]++)] = index;
  }
  append_node(candidates, {c.left, c.top, middle_x, middle_y}, begins[0], begins[1]);
  append_node(candidates, {middle_x, c.top, c.right, middle_y}, begins[1], begins[2]);
  append_node(candidates, {c.left, middle_y, middle_x, c.bottom}, begins[2], begins[3]);
  append_node(candidates, {middle_x, middle_y, c.right, c.bottom}, begins[3], begins[4]);
}

void Quadtree::make_roots(std::span<const Candidate> candidates, const Cell& area) {
  const int width = area.right - area.left, height = area.bottom - area.top;
  // Twice as many each way as near-square roots: the first split of each is taken at once.
  const int columns = 2 * std::max(1, static_cast<int>(std::lround(static_cast<double>(width) / height)));
  const int rows = 2 * std::max(1, static_cast<int>(std::lround(static_cast<double>(height) / width)));
  const auto root_of = [&](const Candidate& p) {
    return (p.y - area.top) * rows / height * columns + (p.x - area.left) * columns / width;
  };
  order_.resize(candidates.size());
  scratch_.resize(candidates.size());
  std::vector<int> begins(static_cast<std::size_t>(rows * columns) + 1);
  for (const Candidate& p : candidates) ++begins[static_cast<std::size_t>(root_of(p)) + 1];
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<int> next(begins.begin(), begins.end() - 1);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    order_[static_cast<std::size_t>(next[static_cast<std::size_t>(root_of(candidates[i]))]++)] =
        static_cast<int>(i);
  }
  const auto edge = [](int origin, int size, int i, int parts) {
    return origin + (i * size + parts - 1) / parts;
  };
  for (int i = 0; i < rows * columns; ++i) {
    const int row = i / columns, column = i % columns;
    append_node(candidates,
                {edge(area.left, width, column, columns), edge(area.top, height, row, rows),
                 edge(area.left, width, column + 1, columns), edge(area.top, height, row + 1, rows)},
                begins[static_cast<std::size_t>(i)], begins[static_cast<std::size_t>(i) + 1]);
  }
}

void Quadtree::collect_winners(std::span<const Candidate> candidates, int budget) {
  winners_.clear();
  const auto candidate = [&](int i) -> const Candidate& { return candidates[static_cast<std::size_t>(i)]; };
  for (const Node& node : nodes_) {
    int best = order_[static_cast<std::size_t>(node.begin)];
    for (int i = node.begin + 1; i < node.end; ++i) {
      const int index = order_[static_cast<std::size_t>(i)];
      if (candidate(index).response > candidate(best).response) best = index;
    }
    winners_.push_back({best, node.cell});
  }
  if (winners_.size() > static_cast<std::size_t>(budget)) {
    std::stable_sort(winners_.begin(), winners_.end(), [&](const Winner& a, const Winner& b) {
      return is_better(candidate(a.candidate), candidate(b.candidate));
    });
    winners_.resize(static_cast<std::size_t>(budget));
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
  next_.clear();
  if (candidates.empty() || budget <= 0) return selected_;
  make_roots(candidates, area);
  nodes_.swap(next_);
  const auto points = [&](int i) {
    const Node& node = nodes_[static_cast<std::size_t>(i)];
    return node.end - node.begin;
  };
  const auto rank = [&](int i) {
    return selection == Selection::improved ? nodes_[static_cast<std::size_t>(i)].high : 0;
  };
  while (nodes_.size() < static_cast<std::size_t>(budget)) {
    queue_.clear();
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
      if (may_split(points(i), nodes_[static_cast<std::size_t>(i)].high, selection)) queue_.push_back(i);
    }
    if (queue_.empty()) break;
    std::stable_sort(queue_.begin(), queue_.end(), [&](int a, int b) {
      return std::pair(rank(a), points(a)) > std::pair(rank(b), points(b));
    });
    next_.clear();
    std::size_t untouched = nodes_.size();  // nodes of this depth that are not split (yet)
    for (const int i : queue_) {
      Node& node = nodes_[static_cast<std::size_t>(i)];
      split(candidates, node);
      node.end = node.begin;  // replaced by its children
      --untouched;
      if (untouched + next_.size() >= static_cast<std::size_t>(budget)) break;
    }
    for (const Node& node : nodes_) {
      if (node.begin != node.end) next_.push_back(node);
    }
    nodes_.swap(next_);
  }
  collect_winners(candidates, budget);
  return selected_;
}

}  // namespace stdc
