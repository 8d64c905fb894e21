#include "motion/motion_belief.hpp"

#include <algorithm>
#include <cmath>

namespace stdc {
namespace {

constexpr float kUnseen = -0.6F;  ///< of a surface that has just come into view
constexpr float kMax = 4;         ///< log-odds; a surface that changes its mind must not take too long

/// The cell that lies `offset` further on in a list of all cells.
std::size_t neighbour(std::size_t cell, int offset) {
  return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) + offset);
}

}  // namespace

void MotionBelief::reset() {
  log_odds_.clear();
  unknown_.clear();
}

void MotionBelief::carry(const DepthGrid& last, const DepthGrid& now, const Pose& last_from_now,
                         const std::vector<CellSource>& sources, bool little_known) {
  little_known_ = little_known;
  constexpr float kFade = 0.95F, kSameSurface = 0.05F, kSameSurfaceGrowth = 0.01F;
  const std::vector<float> before = std::move(log_odds_);
  const std::vector<std::uint8_t> unknown_before = std::move(unknown_);
  log_odds_.assign(now.depth.size(), kUnseen);
  unknown_.assign(now.depth.size(), 1);
  if (before.size() != log_odds_.size() || unknown_before.size() != log_odds_.size()) return;
  const auto still_unknown = [&](std::uint8_t state) {
    return static_cast<std::uint8_t>(little_known && state != 0 ? 1 : 0);
  };
  const Eigen::Matrix3f rotation = last_from_now.rotation_matrix().cast<float>();
  const Eigen::Vector3f translation = last_from_now.translation.cast<float>();
  const int width = geometry_.width(), height = geometry_.height();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto cell = geometry_.index(x, y);
      const float depth = now.depth[cell];
      const float assumed = depth > 0 ? depth : 3;
      const Eigen::Vector3f point =
          rotation * (assumed * Eigen::Vector3f(geometry_.ray_x(x), geometry_.ray_y(y), 1)) + translation;
      float belief = kUnseen;
      Eigen::Vector2f at_rest = Eigen::Vector2f::Zero();  // shift of a thing at rest
      if (point.z() > 0.1F) {
        const float from_x = geometry_.focal_x() * point.x() / point.z() + geometry_.centre_x();
        const float from_y = geometry_.focal_y() * point.y() / point.z() + geometry_.centre_y();
        at_rest = Eigen::Vector2f(static_cast<float>(x) - from_x, static_cast<float>(y) - from_y);
        const int u = static_cast<int>(std::lround(from_x)), v = static_cast<int>(std::lround(from_y));
        if (u >= 0 && v >= 0 && u < width && v < height) {
          const auto from = geometry_.index(u, v);
          const float known = last.depth[from];
          const float tolerated = kSameSurface + kSameSurfaceGrowth * point.z() * point.z();
          const bool same = depth != 0 && known != 0 && std::abs(known - point.z()) < tolerated;
          // A hole, often in the shadow of what moves, tells nothing about what is seen in it afterwards.
          belief = same ? before[from] : std::min(before[from], 0.0F);
          if (same) unknown_[cell] = still_unknown(unknown_before[from]);
          if (depth != 0 && known != 0 && !same) belief = kUnseen;
        }
      }
      const CellSource& source = sources[cell];
      float evidence = 0;
      if (source.cell >= 0) {
        const auto from = static_cast<std::size_t>(source.cell);
        const float known = last.depth[from];
        const bool fits = depth == 0 || known == 0 || std::abs(known - depth) < 0.2F;
        if (fits && before[from] >= belief) {
          belief = before[from];
          unknown_[cell] = still_unknown(unknown_before[from]);
          const float apart = (source.shift - at_rest).norm();
          const bool moved = depth > 0 && source.measured && apart > 0.5F + 0.15F * at_rest.norm();
          evidence = moved ? static_cast<float>(settings_.evidence) : 0;
        }
      }
      log_odds_[cell] = kFade * belief + evidence;
    }
  }
}

void MotionBelief::add(const std::vector<CellFinding>& findings) {
  constexpr float kPresumed = -0.1F;  // what nobody has seen before mostly rests
  const auto weight = static_cast<float>(settings_.evidence);
  const auto rest_time = static_cast<float>(settings_.rest_time);
  if (log_odds_.size() != findings.size()) log_odds_.assign(findings.size(), 0);
  if (unknown_.size() != findings.size()) unknown_.assign(findings.size(), 1);
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const CellFinding& finding = findings[i];
    const int views = finding.fresh + finding.known;
    const bool rested = finding.seen && finding.rest >= rest_time;
    if (views > 0 || rested || finding.recedes) unknown_[i] = 0;
    if (finding.recedes) log_odds_[i] += weight;
    if (rested) {
      log_odds_[i] -= finding.fresh > finding.known ? 0.5F * weight : weight;
    } else if (views > 0) {
      const float vote = static_cast<float>(finding.fresh - finding.known) / static_cast<float>(views);
      log_odds_[i] += vote > 0 ? weight * vote : 0.5F * weight * vote;
    } else {
      log_odds_[i] += kPresumed;
    }
  }
}

void MotionBelief::add_opinion(const std::vector<std::uint8_t>& dynamic, float weight, bool whole) {
  if (log_odds_.size() != dynamic.size()) log_odds_.assign(dynamic.size(), 0);
  for (std::size_t i = 0; i < dynamic.size(); ++i) {
    if (dynamic[i] == 0) continue;
    log_odds_[i] += weight;
    if (i >= unknown_.size() || unknown_[i] == 0) continue;
    unknown_[i] = whole ? kOpinion : 0;
  }
}

/// A part of a surface that no view tells anything about moves as a whole if much of what it is joined to
/// moves: where the rest of it touches something at rest, such as a board the desk that it passes, that must
/// not decide.
void MotionBelief::join_unknown(const DepthGrid& now) {
  constexpr float kLink = 0.02F, kLinkGrowth = 0.02F, kMinLink = 0.3F;
  constexpr float kMinShare = 0.4F;  // of its joints with what is known
  constexpr float kMinSum = 8;       // of joints; and as many as the part is wide: it must not only touch
  const int width = geometry_.width(), height = geometry_.height();
  std::vector<std::size_t> part;
  for (std::size_t seed = 0; seed < unknown_.size(); ++seed) {
    if (unknown_[seed] != 1 || now.depth[seed] == 0) continue;
    part.assign(1, seed);
    unknown_[seed] = kVisited;
    float moving = 0, all = 0, belief = 0;
    for (std::size_t next = 0; next < part.size(); ++next) {
      const std::size_t i = part[next];
      const float depth = now.depth[i], reach = 1 / (kLink + kLinkGrowth * depth);
      const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height) continue;
        const std::size_t other = geometry_.index(x + dx, y + dy);
        const float link = 1 - std::abs(now.depth[other] - depth) * reach;
        if (now.depth[other] == 0 || link < kMinLink || unknown_[other] == kVisited) continue;
        if (unknown_[other] == 1) {
          unknown_[other] = kVisited;
          part.push_back(other);
        } else if (unknown_[other] == 0) {
          all += link;
          if (log_odds_[other] <= kWeak) continue;
          moving += link;
          belief += link * log_odds_[other];
        }
      }
    }
    const float wide = std::sqrt(static_cast<float>(part.size()));
    if (moving < std::max(kMinSum, wide) || moving < kMinShare * all) continue;
    for (const std::size_t i : part) {
      log_odds_[i] = belief / moving;
      unknown_[i] = kTakenOver;
    }
  }
  for (std::uint8_t& state : unknown_) state = state == kVisited ? 1 : state;
}

/// What no view tells anything about, as it has come in at the edge of the image or from behind something, is
/// taken for what the rest of its surface is: else the part of a large thing that has just entered would pass
/// for new background. In every frame anew, since its edge may be found to move only after a while.
void MotionBelief::fill_unknown(const DepthGrid& now) {
  constexpr float kLink = 0.02F, kLinkGrowth = 0.02F, kMinLinks = 0.3F;
  const float passed_on = little_known_ ? 0.99F : 0.95F;
  const int rim = little_known_ ? 0 : 1;
  const int width = geometry_.width(), height = geometry_.height();
  struct Offset {
    int x, y;
  };
  const auto fill = [&](int x, int y, std::initializer_list<Offset> offsets) {
    const std::size_t i = geometry_.index(x, y);
    const float depth = now.depth[i];
    if ((unknown_[i] != 1 && unknown_[i] != kFilled) || depth == 0) return;
    const float reach = 1 / (kLink + kLinkGrowth * depth);
    float sum = 0, links = 0;
    for (const Offset& offset : offsets) {
      if (x + offset.x < 0 || y + offset.y < 0 || x + offset.x >= width || y + offset.y >= height) continue;
      const std::size_t other = geometry_.index(x + offset.x, y + offset.y);
      if (unknown_[other] == 1 || unknown_[other] == kOpinion || now.depth[other] == 0) continue;
      const float link = std::max(0.0F, 1 - std::abs(now.depth[other] - depth) * reach);
      sum += link * log_odds_[other];
      links += link;
    }
    if (links < kMinLinks) return;
    log_odds_[i] = passed_on * sum / links;
    unknown_[i] = kFilled;
  };
  for (int round = 0; round < 2; ++round) {
    for (int y = rim; y < height - rim; ++y) {
      for (int x = rim; x < width - rim; ++x) fill(x, y, {{-1, 0}, {-1, -1}, {0, -1}, {1, -1}});
      for (int x = width - 1 - rim; x >= rim; --x) fill(x, y, {{1, 0}, {-1, -1}, {0, -1}, {1, -1}});
    }
    for (int y = height - 1 - rim; y >= rim; --y) {
      for (int x = rim; x < width - rim; ++x) fill(x, y, {{-1, 0}, {-1, 1}, {0, 1}, {1, 1}});
      for (int x = width - 1 - rim; x >= rim; --x) fill(x, y, {{1, 0}, {-1, 1}, {0, 1}, {1, 1}});
    }
  }
}

void MotionBelief::smooth(const DepthGrid& now) {
  if (unknown_.size() == log_odds_.size()) {
    if (little_known_) join_unknown(now);
    fill_unknown(now);
  }
  constexpr int kRounds = 4;
  constexpr float kLink = 0.02F, kLinkGrowth = 0.02F;
  const int width = geometry_.width(), height = geometry_.height();
  const auto share = static_cast<float>(settings_.smoothing);
  std::vector<float> before(log_odds_.size());
  for (int round = 0; round < kRounds; ++round) {
    before = log_odds_;
    for (int y = 1; y + 1 < height; ++y) {
      for (int x = 1; x + 1 < width; ++x) {
        const std::size_t i = geometry_.index(x, y);
        const float depth = now.depth[i];
        if (depth == 0) continue;
        const float reach = 1 / (kLink + kLinkGrowth * depth);
        float sum = 0, links = 0;
        for (const int offset : {-width - 1, -width, -width + 1, -1, 1, width - 1, width, width + 1}) {
          const std::size_t other = neighbour(i, offset);
          const float there = now.depth[other];
          const float link = there == 0 ? 0 : std::max(0.0F, 1 - std::abs(there - depth) * reach);
          sum += link * before[other];
          links += link;
        }
        if (links > 0.1F) log_odds_[i] += share * (sum / links - before[i]);
      }
    }
  }
  for (float& value : log_odds_) value = std::clamp(value, -kMax, kMax);
}

}  // namespace stdc
