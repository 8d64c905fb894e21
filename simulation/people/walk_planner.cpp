#include "simulation/people/walk_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "simulation/people/person_motion.hpp"
#include "simulation/scene/room.hpp"
#include "simulation/scene/shapes.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector2d;

/// Waypoints round the desks; the first five lie between the desks and the camera of the walking presets.
const std::array<Vector2d, 14> kRing{{{-1.7, -0.85},
                                      {-0.75, -0.92},
                                      {-0.3, -1.0},
                                      {0.22, -1.02},
                                      {0.68, -0.97},
                                      {1.6, -1.05},
                                      {2.15, -0.55},
                                      {2.15, 1.0},
                                      {2.05, 2.25},
                                      {1.3, 2.58},
                                      {0.0, 2.56},
                                      {-1.3, 2.5},
                                      {-2.05, 2.2},
                                      {-2.1, 0.8}}};
constexpr int kRingSize = static_cast<int>(kRing.size());
constexpr int kFirstSeen = 1, kLastSeen = 4;  // the points of the ring in the middle of the view
constexpr int kNearChair = 4;                 // the point of the ring next to the visitors' chair
constexpr double kMinDistance = 0.62;         // between two people [m]
constexpr double kBeforeChair = 0.44;  // from the centre of the chair to a person about to sit down [m]

int ring_index(int i) { return (i % kRingSize + kRingSize) % kRingSize; }

/// Plans the two walkers together: the one whose route ends first gets the next piece, checked against the
/// other route.
class Walkers {
 public:
  explicit Walkers(std::uint64_t seed) : random_(seed, 71) {
    add(4, std::numbers::pi - 0.3);
    add(1, 0.4);
    routes_[0].wait(1.2);
    routes_[1].wait(0.5);
  }

  std::vector<Route> plan(double seconds) {
    while (std::min(routes_[0].end(), routes_[1].end()) < seconds) {
      plan_piece(routes_[0].end() <= routes_[1].end() ? 0 : 1);
    }
    return std::move(routes_);
  }

 private:
  void add(int place, double yaw) {
    routes_.emplace_back(Stance{kRing[place], yaw});
    places_.push_back(place);
  }

  bool collides(int who, double from) const {
    const Route &a = routes_[who], &b = routes_[1 - who];
    const double until = std::max(a.end(), b.end());
    for (double t = from; t <= until; t += 0.05) {
      if ((a.at(t).position - b.at(t).position).norm() < kMinDistance) return true;
    }
    return false;
  }

  void plan_piece(int who) {
    Route& route = routes_[who];
    const double begin = route.end();
    const int place = places_[who];
    constexpr int kTries = 6;
    for (int i = 0; i < kTries; ++i) {
      const bool sit = place >= kFirstSeen && place <= kNearChair && random_.uniform() < 0.14;
      if (sit) {
        sit_down(who);
      } else {
        stroll(who);
      }
      if (!collides(who, begin)) return;
      route.cut(begin);
      places_[who] = place;
    }
    route.wait(random_.uniform(0.4, 0.9));
  }

  void follow_ring(int who, int to, int direction, double speed) {
    std::vector<Vector2d> points;
    for (int i = places_[who]; i != to;) {
      i = ring_index(i + direction);
      points.push_back(kRing[i] + Vector2d(random_.uniform(-0.06, 0.06), random_.uniform(-0.06, 0.06)));
    }
    routes_[who].walk(points, speed);
    places_[who] = to;
  }

  void stroll(int who) {
    // Mostly to and fro before the desks, sometimes all the way round.
    const bool seen = random_.uniform() < 0.86;
    const int to = seen ? kFirstSeen + static_cast<int>(random_.below(kLastSeen - kFirstSeen + 1))
                        : static_cast<int>(random_.below(kRingSize));
    if (to == places_[who]) return pause(who);
    const int steps = ring_index(to - places_[who]);
    const int direction = steps <= kRingSize / 2 ? 1 : -1;
    follow_ring(who, to, random_.uniform() < 0.1 ? -direction : direction, random_.uniform(0.75, 1.15));
    if (random_.uniform() < 0.55) pause(who);
  }

  void pause(int who) {
    Route& route = routes_[who];
    // Facing the desks, the camera, the other person, or any direction.
    const Vector2d to_other = routes_[1 - who].at(route.end()).position - route.last().position;
    const double yaws[] = {std::numbers::pi, 0, yaw_towards(to_other), random_.uniform(-3, 3)};
    route.turn(yaws[random_.below(4)] + random_.uniform(-0.4, 0.4));
    const double begin = route.end();
    route.wait(random_.uniform(1.4, 3.0));
    const Act acts[] = {Act::idle, Act::talk, Act::phone, Act::talk};
    const Act act = acts[random_.below(4)];
    if (act != Act::idle) route.note(act, begin);
  }

  void sit_down(int who) {
    Route& route = routes_[who];
    if (places_[who] != kNearChair) {
      follow_ring(who, kNearChair, places_[who] < kNearChair ? 1 : -1, random_.uniform(0.75, 1.0));
    }
    const Pose chair = visitor_chair_pose();
    const Eigen::Vector3d before = chair * Eigen::Vector3d(0, -kBeforeChair, 0);
    const Eigen::Vector3d axis = chair.rotation * Eigen::Vector3d(0, -1, 0);
    route.walk({Vector2d(0.62, -0.55), before.head<2>()}, 0.7);
    route.turn(yaw_towards(axis.head<2>()));
    route.wait(0.4);
    const double begin = route.end();
    route.wait(random_.uniform(4.5, 7));
    route.note(Act::sit, begin, chair);
    route.wait(0.3);
    route.walk({Vector2d(0.62, -0.55), kRing[kNearChair]}, 0.7);
  }

  Random random_;
  std::vector<Route> routes_;
  std::vector<int> places_;  ///< on the ring
};

}  // namespace

std::vector<Route> plan_walks(double seconds, std::uint64_t seed) { return Walkers(seed).plan(seconds); }

}  // namespace stdc::simulation
