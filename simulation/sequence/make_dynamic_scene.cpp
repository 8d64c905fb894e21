#include "simulation/sequence/make_dynamic_scene.hpp"

#include "simulation/people/box_errand.hpp"
#include "simulation/people/box_script.hpp"
#include "simulation/people/crowd.hpp"
#include "simulation/people/person_props.hpp"
#include "simulation/people/walk_planner.hpp"
#include "simulation/scene/loose_objects.hpp"
#include "simulation/sequence/movers.hpp"

namespace stdc::simulation {
namespace {

constexpr double kPlannedSeconds = 600;  // people stand still after that

struct Cast {
  std::vector<Person> people;
  std::vector<Prop> props;
};

Person make_person(int number, std::uint64_t seed, Route route) {
  const PersonAppearance appearance = random_appearance(number, seed);
  return {appearance, Skeleton(appearance.measures), std::move(route)};
}

void add_people(Cast& cast, std::vector<Route> routes, std::uint64_t seed) {
  int number = 0;
  for (Route& route : routes) cast.people.push_back(make_person(number++, seed, std::move(route)));
}

void add_box_carrier(Cast& cast, const Room& room, std::uint64_t seed) {
  BoxScript script = plan_box_carrier(kPlannedSeconds, seed);
  cast.people.push_back(make_person(0, seed, std::move(script.route)));
  cast.props.push_back(carried_box(room, cast.people[0].motion));
  cast.props.push_back(pushed_chair(room, cast.people[0].motion, script.chair_start));
}

void add_errand(Cast& cast, const Room& room, std::uint64_t seed, BoxErrand errand) {
  cast.people.push_back(make_person(0, seed, plan_box_errand(errand)));
  cast.props.push_back(carried_box(room, cast.people[0].motion));
}

void add_balloon(Cast& cast, const Room& room, std::uint64_t seed) {
  BalloonScript script = plan_balloon(kPlannedSeconds);
  cast.props.push_back(floating_balloon(room, script, kPlannedSeconds));
  cast.people.push_back(make_person(0, seed, std::move(script.route)));
}

/// Two people of the same build, in other clothes, who move alike.
void add_twins(Cast& cast, std::uint64_t seed) {
  const BodyMeasures build = random_appearance(0, seed).measures;
  int number = 0;
  for (Route& route : plan_side_by_side(kPlannedSeconds)) {
    PersonAppearance appearance = random_appearance(number++, seed);
    appearance.measures = build;
    cast.people.emplace_back(appearance, Skeleton(build), std::move(route), seed);
  }
}

void add_movers(Cast& cast, Preset preset, const Room& room, std::uint64_t seed) {
  switch (preset) {
    case Preset::static_desk:
    case Preset::static_room:
      break;
    case Preset::walking_xyz:
    case Preset::walking_halfsphere:
    case Preset::walking_rpy:
    case Preset::walking_static:
      return add_people(cast, plan_walks(kPlannedSeconds, seed), seed);
    case Preset::moving_box:
      return add_box_carrier(cast, room, seed);
    case Preset::board:
      cast.props.push_back(sliding_board(room));
      break;
    case Preset::balloon:
    case Preset::balloon_tracking:
      return add_balloon(cast, room, seed);
    case Preset::box_kidnapped:
      return add_errand(cast, room, seed, BoxErrand::kidnap);
    case Preset::box_placed:
      return add_errand(cast, room, seed, BoxErrand::place);
    case Preset::box_removed:
      return add_errand(cast, room, seed, BoxErrand::remove);
    case Preset::crowd:
      return add_people(cast, plan_crowd(kPlannedSeconds, seed), seed);
    case Preset::synchronous:
      return add_twins(cast, seed);
    case Preset::door:
      break;  // see add_furniture
    case Preset::trolley:
      cast.props.push_back(rolling_trolley(room));
      break;
    case Preset::camera_blocked:
      cast.props.push_back(lens_cover(room, CameraPath(motion_of(preset), seed)));
      break;
  }
}

/// What stands in the room in this preset only.
void add_furniture(Cast& cast, Preset preset, const Room& room, bool with_movers) {
  const bool table =
      preset == Preset::box_kidnapped || preset == Preset::box_placed || preset == Preset::box_removed;
  if (table) cast.props.push_back({side_table_mesh(room), side_table_pose(), {}, 0.15});
  if (preset == Preset::door) {
    cast.props.push_back({cupboard_mesh(room), cupboard_pose(), {}, 0.3});
    cast.props.push_back(cupboard_door(room, with_movers));
  }
}

}  // namespace

std::optional<DynamicScene> make_dynamic_scene(Preset preset, std::uint64_t seed, bool with_movers,
                                               const Room& room, const BakedLight& light) {
  Cast cast;
  add_furniture(cast, preset, room, with_movers);
  if (with_movers) add_movers(cast, preset, room, seed);
  if (cast.people.empty() && cast.props.empty()) return std::nullopt;
  return std::optional<DynamicScene>(std::in_place, room.world, light, std::move(cast.people),
                                     std::move(cast.props));
}

}  // namespace stdc::simulation
